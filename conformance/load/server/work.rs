//! The requests, as frames of this project's codec, and the expected replies.

use std::error::Error;

use ads_cnc::address::Channel;
use ads_cnc::ads::{AdsError, AmsAddr, AmsHeader, AmsNetId, AmsPort, FrameRef};
use ads_cnc::operation::{
    AdsService, Call, Operation as _, ReadByHandle, ReadByName, ReadDescriptors, ReadObject,
    Request,
};
use ads_cnc::{Encode as _, Handle, U32List};
use ads_cnc_conformance::ads_service::{decode_reply, encode_reply};
use ads_cnc_conformance::simulator::{Cnc, DATA_MAX, NET_ID};

pub(crate) type Result<T> = std::result::Result<T, Box<dyn Error + Send + Sync>>;

/// The address of the client.
const CLIENT: AmsAddr = AmsAddr { net_id: AmsNetId([127, 0, 0, 1, 1, 2]), port: AmsPort(0x8000) };

/// A request that is sent repeatedly.
pub(crate) struct Work {
    pub(crate) name: &'static str,
    pub(crate) title: &'static str,
    pub(crate) group: u32,
    pub(crate) offset: u32,
    /// The header of the request.
    header: AmsHeader,
    service: AdsService,
    payload: Vec<u8>,
    /// The expected data of the reply.
    pub(crate) expected: Vec<u8>,
}

impl Work {
    /// All requests; the first one can be answered by any ADS server.
    pub(crate) fn all() -> Result<Vec<Self>> {
        let (cnc, channel) = (Cnc::with_default_model()?, Channel::new(1)?);
        let descriptors = ReadDescriptors::new(channel, 1, 30)?;
        let list = answer(&cnc, &descriptors.into())?;
        let object = descriptors.decode_reply(&list)?;
        let object = object.iter().find(|one| one.name() == "example_dword_r");
        let object = object.ok_or("an object is missing")?;
        let object = ReadObject::new(object.index_group(), object.index_offset(), object.size())?;
        let indices = U32List::from(&[3]);
        let works: [(_, _, Request<'_>); 5] = [
            ("read", "Read of 4 bytes", object.into()),
            (
                "by-handle",
                "an element of a variable by its handle",
                ReadByHandle { channel, handle: Handle(0x200_1234), indices }.into(),
            ),
            (
                "by-name",
                "an element of a variable by its name",
                ReadByName::new(channel, "V.E.Testvar[3]")?.into(),
            ),
            (
                "descriptor",
                "one descriptor of 84 bytes",
                ReadDescriptors::new(channel, 16, 1)?.into(),
            ),
            ("descriptors", "30 descriptors of 84 bytes", descriptors.into()),
        ];
        works.iter().map(|(name, title, request)| Self::new(&cnc, name, title, request)).collect()
    }

    fn new(
        cnc: &Cnc,
        name: &'static str,
        title: &'static str,
        request: &Request<'_>,
    ) -> Result<Self> {
        let expected = answer(cnc, request)?;
        request.decode_reply(&expected)?;
        let mut buf = vec![0; request.encoded_len()];
        let call = request.encode(&mut buf)?;
        let Call { port, service, index_group, index_offset, .. } = call;
        if service == AdsService::Write {
            return Err(format!("{name}: not a query").into());
        }
        let payload = call.encode_to_vec()?;
        let target = AmsAddr { net_id: NET_ID, port };
        let header = AmsHeader::request(target, CLIENT, service.command(), 0);
        let (group, offset) = (index_group.get(), index_offset.get());
        Ok(Self { name, title, group, offset, header, service, payload, expected })
    }

    /// Length of a request in bytes.
    pub(crate) fn request_len(&self) -> usize {
        FrameRef::HEADERS_LEN + self.payload.len()
    }

    /// Appends a request.
    pub(crate) fn request(&self, invoke_id: u32, out: &mut Vec<u8>) -> Result<()> {
        frame(AmsHeader { invoke_id, ..self.header }, &self.payload, out)
    }

    /// The bytes of the correct reply.
    pub(crate) fn reply(&self, invoke_id: u32) -> Result<Vec<u8>> {
        let (result, data) = (AdsError::NO_ERROR, Some(self.expected.as_slice()));
        let payload = encode_reply(self.service, result, data)?;
        let mut out = Vec::new();
        frame(self.answering(invoke_id, 0), &payload, &mut out)?;
        Ok(out)
    }

    /// Checks that the first received frame is the correct reply to the request with this number;
    /// returns its length, or `None` if the frame is incomplete.
    pub(crate) fn check(&self, received: &[u8], invoke_id: u32) -> Result<Option<usize>> {
        let Some((frame, len)) = FrameRef::split(received, DATA_MAX)? else { return Ok(None) };
        let (header, payload) = (frame.header(), frame.data());
        if header != self.answering(invoke_id, u32::try_from(payload.len())?) {
            return Err(
                format!("{}: no reply to request {invoke_id}: {header:?}", self.name).into()
            );
        }
        let (result, data) = decode_reply(self.service, payload)?;
        if !result.is_ok() || data != Some(self.expected.as_slice()) {
            return Err(format!("{}: a wrong reply: {result:?}, {data:?}", self.name).into());
        }
        Ok(Some(len))
    }

    const fn answering(&self, invoke_id: u32, data_length: u32) -> AmsHeader {
        AmsHeader { data_length, invoke_id, ..self.header.response() }
    }
}

/// The reply of the simulated CNC.
fn answer(cnc: &Cnc, request: &Request<'_>) -> Result<Vec<u8>> {
    let mut buf = vec![0; request.encoded_len()];
    let answer = cnc.answer(&request.encode(&mut buf)?);
    answer.map_err(|error| format!("{request:?}: {error:?}").into())
}

fn frame(header: AmsHeader, payload: &[u8], out: &mut Vec<u8>) -> Result<()> {
    let (frame, start) = (FrameRef::new(header, payload)?, out.len());
    out.resize(start + frame.encoded_len(), 0);
    frame.encode(&mut out[start..])?;
    Ok(())
}
