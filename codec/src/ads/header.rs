//! The AMS/TCP header and the AMS header (ADS-5).

use zerocopy::little_endian::U16;

use super::{AdsError, AmsAddr, AmsNetId, AmsPort, Command, StateFlags};
use crate::bytes::{Reader, Writer};
use crate::declare::stream;
use crate::error::Error;
use crate::layout::Stream;
use crate::limits::AMS_HEADER_LEN;
use crate::stream::{Decode, Encode};

stream! {
    /// The header of AMS over TCP.
    ///
    /// Source: the vendors' public help pages; the manuals do not describe it.
    ///
    /// `decode` can fail with [`Truncated`](crate::ErrorKind::Truncated) or
    /// [`Trailing`](crate::ErrorKind::Trailing).
    ///
    /// ```
    /// use ads_cnc::{Decode, ads::AmsTcpHeader};
    ///
    /// let header = AmsTcpHeader::decode(&[0, 0, 44, 0, 0, 0])?;
    /// assert_eq!(header, AmsTcpHeader { reserved: 0, length: 44 });
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    AmsTcpHeader "ams-tcp-header", "AMS/TCP header", "ADS-5", max 6;
    struct AmsTcpHeader {
        @0 reserved: UNS16, "ADS-5", "0 for AMS commands";
        @2 length: UNS32,   "ADS-5", "bytes that follow: AMS header and data";
    }
}

#[doc = include_str!("../../doc/ams-header.md")]
///
/// Source: the vendors' public help pages; the manuals do not describe it.
///
/// `decode` can fail with [`Truncated`](crate::ErrorKind::Truncated) or
/// [`Trailing`](crate::ErrorKind::Trailing).
///
/// ```
/// use ads_cnc::ads::{AdsError, AmsAddr, AmsHeader, AmsNetId, AmsPort, Command, StateFlags};
/// use ads_cnc::{Decode, Encode};
///
/// let header = AmsHeader {
///     target: AmsAddr { net_id: AmsNetId([127, 0, 0, 1, 1, 1]), port: AmsPort::COM },
///     source: AmsAddr { net_id: AmsNetId([127, 0, 0, 1, 1, 2]), port: AmsPort(0x8001) },
///     command: Command::READ,
///     state_flags: StateFlags::REQUEST,
///     data_length: 12,
///     error: AdsError::NO_ERROR,
///     invoke_id: 7,
/// };
/// let mut buf = [0; 32];
/// assert_eq!(AmsHeader::decode(header.encode(&mut buf)?)?, header);
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(try_from = "HeaderLayout", into = "HeaderLayout")
)]
pub struct AmsHeader {
    /// The receiver of the frame.
    pub target: AmsAddr,
    /// The sender of the frame.
    pub source: AmsAddr,
    /// The ADS command that the frame requests or answers.
    pub command: Command,
    /// Whether the frame is a request or a response.
    pub state_flags: StateFlags,
    /// Bytes that follow the header.
    pub data_length: u32,
    /// AMS error; a response with an error may have no data (ADS-6).
    pub error: AdsError,
    /// Pairs a response with its request.
    pub invoke_id: u32,
}

stream! {
    /// The bytes of [`AmsHeader`].
    AmsHeader "ams-header", "AMS header", "ADS-5", max 32;
    packed HeaderLayout {
        @0  target_net_id: NETID, "ADS-5", "NetId of the receiver";
        @6  target_port: UNS16,   "ADS-5", "AMS port of the receiver";
        @8  source_net_id: NETID, "ADS-5", "NetId of the sender";
        @14 source_port: UNS16,   "ADS-5", "AMS port of the sender";
        @16 command: UNS16,       "ADS-5", "2 Read, 3 Write, 9 ReadWrite, …";
        @18 state_flags: UNS16,   "ADS-5", "0x0004 request, 0x0005 response";
        @20 data_length: UNS32,   "ADS-5", "bytes after this header";
        @24 error: UNS32,         "ADS-5", "AMS error number, 0 for none";
        @28 invoke_id: UNS32,     "ADS-5", "pairs a response with its request";
    }
}

impl<'a> Decode<'a> for AmsHeader {
    const STREAM: Stream = Stream::AmsHeader;

    fn decode(bytes: &'a [u8]) -> Result<Self, Error> {
        let fixed: &HeaderLayout = Reader::exact(Self::STREAM, bytes)?;
        let end =
            |net_id, port: U16| AmsAddr { net_id: AmsNetId(net_id), port: AmsPort(port.get()) };
        Ok(Self {
            target: end(fixed.target_net_id, fixed.target_port),
            source: end(fixed.source_net_id, fixed.source_port),
            command: Command(fixed.command.get()),
            state_flags: StateFlags(fixed.state_flags.get()),
            data_length: fixed.data_length.get(),
            error: AdsError(fixed.error.get()),
            invoke_id: fixed.invoke_id.get(),
        })
    }
}

impl Encode for AmsHeader {
    fn encoded_len(&self) -> usize {
        AMS_HEADER_LEN
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Error> {
        Writer::copy(Self::STREAM, &self.to_bytes(), buf)
    }
}

impl AmsHeader {
    /// The header of a request; [`FrameRef::new`](super::FrameRef::new) sets `data_length`.
    pub const fn request(
        target: AmsAddr,
        source: AmsAddr,
        command: Command,
        invoke_id: u32,
    ) -> Self {
        let (state_flags, error) = (StateFlags::REQUEST, AdsError::NO_ERROR);
        Self { target, source, command, state_flags, data_length: 0, error, invoke_id }
    }

    /// The header of the response to this request: source and target are swapped, command and invoke
    /// ID kept.
    ///
    /// ```
    /// use ads_cnc::ads::{AmsAddr, AmsHeader, AmsNetId, AmsPort, Command, StateFlags};
    ///
    /// let cnc = AmsAddr { net_id: AmsNetId([192, 0, 2, 7, 1, 1]), port: AmsPort::SDA };
    /// let client = AmsAddr { net_id: AmsNetId([192, 0, 2, 1, 1, 1]), port: AmsPort(0x8001) };
    /// let response = AmsHeader::request(cnc, client, Command::READ, 7).response();
    /// assert_eq!((response.target, response.source), (client, cnc));
    /// assert_eq!((response.state_flags, response.invoke_id), (StateFlags::RESPONSE, 7));
    /// ```
    #[must_use]
    pub const fn response(self) -> Self {
        Self {
            target: self.source,
            source: self.target,
            state_flags: StateFlags::RESPONSE,
            data_length: 0,
            error: AdsError::NO_ERROR,
            ..self
        }
    }

    /// The bytes of the stream.
    pub fn to_bytes(&self) -> [u8; AMS_HEADER_LEN] {
        zerocopy::transmute!(self.layout())
    }

    pub(super) fn layout(&self) -> HeaderLayout {
        HeaderLayout {
            target_net_id: self.target.net_id.0,
            target_port: self.target.port.0.into(),
            source_net_id: self.source.net_id.0,
            source_port: self.source.port.0.into(),
            command: self.command.0.into(),
            state_flags: self.state_flags.0.into(),
            data_length: self.data_length.into(),
            error: self.error.0.into(),
            invoke_id: self.invoke_id.into(),
        }
    }
}

#[cfg(feature = "serde")]
impl TryFrom<HeaderLayout> for AmsHeader {
    type Error = Error;

    fn try_from(layout: HeaderLayout) -> Result<Self, Error> {
        Self::decode(zerocopy::IntoBytes::as_bytes(&layout))
    }
}

#[cfg(feature = "serde")]
impl From<AmsHeader> for HeaderLayout {
    fn from(header: AmsHeader) -> Self {
        header.layout()
    }
}
