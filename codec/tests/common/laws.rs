//! Laws of streams, of their values, of calls and of replies. The bytes of a stream, the data of a
//! call and the bytes of a reply may be valid or invalid.

use std::fmt::Debug;

use ads_cnc::ads::{AmsAddr, AmsHeader, AmsNetId, FrameRef};
use ads_cnc::layout::{Field, FieldSpec, Size, Stream};
use ads_cnc::limits::DESCRIPTOR_LEN;
use ads_cnc::operation::{AdsService, Call, DispatchError, Function, Request, Task};
use ads_cnc::{Decode, Encode, Error, ErrorKind, NoData};

#[cfg(feature = "binrw")]
use super::subjects::ReadAndWritten;
use super::{Fault, StreamType, Subject};

/// The initial value of the bytes of a buffer whose changes are checked. A byte with any other
/// value was written.
const UNTOUCHED: u8 = 0x55;

/// The length of a decoded stream in bytes, or the error of the decoder.
type Length = Result<usize, Error>;

/// A fault added to a correct codec, to verify that the laws detect it.
#[derive(Clone, Copy)]
pub(crate) struct Mutation {
    /// Changes the result of `encoded_len` of a value or reply, or the error of the decoder.
    pub(crate) len: fn(Length) -> Length,
    /// Changes the parts of an error.
    pub(crate) fault: fn(Fault) -> Fault,
    /// Changes the bytes that `encode` writes; in [`check_value_bent`], also those of
    /// `encode_to_vec`.
    pub(crate) written: fn(&mut [u8]),
    /// Changes a buffer after `encode` rejected it because it is too small.
    pub(crate) small: fn(&mut [u8]),
    /// Changes the bytes that `encode_to_vec` returns for a decoded value.
    pub(crate) vec: fn(&mut Vec<u8>),
    /// Changes the length of each segment that `Stream::walk` reports.
    pub(crate) segment: fn(usize) -> usize,
    /// Changes the bytes that `Stream::join` joins from segments.
    pub(crate) joined: fn(&mut Vec<u8>),
    /// Changes the result of comparing the borrowed and the owned value.
    pub(crate) same: fn(&[u8], bool) -> bool,
    /// Changes the result of `decode_prefix`: the length of the stream, or the error.
    pub(crate) prefix: fn(&[u8], Length) -> Length,
    /// Changes the bytes that `BinWrite` writes after `BinRead`, or the position of the reader.
    #[cfg(feature = "binrw")]
    pub(crate) binrw: fn(&[u8], ReadAndWritten) -> ReadAndWritten,
    /// Changes the bytes of a value that are written element by element.
    pub(crate) typed: fn(&mut [u8]),
}

impl Mutation {
    /// No fault.
    pub(crate) const NONE: Self = Self {
        len: |len| len,
        fault: |fault| fault,
        written: |_| (),
        small: |_| (),
        vec: |_| (),
        segment: |len| len,
        joined: |_| (),
        same: |_, same| same,
        prefix: |_, prefix| prefix,
        #[cfg(feature = "binrw")]
        binrw: |_, read| read,
        typed: |_| (),
    };

    /// Drops the value of a result, and converts an error to the parts that are compared, which
    /// `self.fault` changes.
    fn told<T>(&self, told: Result<T, Error>) -> Result<(), (Fault, Field)> {
        told.map(drop).map_err(|error| ((self.fault)(Fault::of(error)), error.field()))
    }
}

/// Checks, among other laws, that the borrowed type, the owned type (with `alloc`) and the walk of
/// a stream have the same result, including errors, and that accepted bytes encode to the same
/// bytes. Returns the result.
pub(crate) fn check(stream: Stream, bytes: &[u8]) -> Result<(), Error> {
    check_bent(stream, bytes, &Mutation::NONE)
}

/// Like [`check`], for a codec to which `mutation` adds a fault.
pub(crate) fn check_bent(stream: Stream, bytes: &[u8], mutation: &Mutation) -> Result<(), Error> {
    let subject = Subject::of(stream);
    let verdict = walk(stream, bytes, mutation);
    let wanted = Mutation::NONE.told(verdict);
    for reading in subject.readings() {
        let len = (mutation.len)((reading.len)(bytes));
        assert_eq!(mutation.told(len), wanted, "{stream}: {} and walk of {bytes:x?}", reading.name);
        if let Ok(len) = len {
            assert_eq!(len, bytes.len(), "{stream}: encoded_len of {bytes:x?}");
            check_encode(reading, bytes, mutation);
        }
    }
    #[cfg(feature = "alloc")]
    {
        let same = (subject.same)(bytes).map(|same| (mutation.same)(bytes, same));
        assert_eq!(same, verdict.map(|()| true), "{stream}: view and owned of {bytes:x?}");
        let mut vec = (subject.to_vec)(bytes);
        vec.iter_mut().for_each(mutation.vec);
        assert_eq!(vec, verdict.map(|()| bytes.to_vec()), "{stream}: encode_to_vec of {bytes:x?}");
    }
    check_prefix(stream, bytes, (mutation.prefix)(bytes, (subject.prefix)(bytes)), verdict);
    if verdict.is_ok() && ends_by_its_fields(stream) {
        let longer = [bytes, &[0xFF]].concat();
        let prefix = (mutation.prefix)(&longer, (subject.prefix)(&longer));
        assert_eq!(prefix, Ok(bytes.len()), "{stream}: front of {longer:x?}");
    }
    #[cfg(feature = "binrw")]
    {
        // After an error, the reader must be at its initial position, and nothing may be written.
        let prefix = (subject.prefix)(bytes);
        let wanted = prefix.map_or((None, 0), |len| (Some(bytes[..len].to_vec()), len));
        let read = (mutation.binrw)(bytes, (subject.binrw)(bytes));
        assert_eq!(read, wanted, "{stream}: BinRead and BinWrite of {bytes:x?}");
    }
    // Longer values are left out to save time.
    if stream == Stream::VariableValue && verdict.is_ok() && bytes.len() <= 128 {
        super::check_typed(bytes, mutation.typed);
    }
    verdict
}

/// Whether the stream has fields that determine the end of every valid stream of this kind, even if
/// bytes follow it.
fn ends_by_its_fields(stream: Stream) -> bool {
    let layout = stream.layout();
    let ends = |row: &FieldSpec| {
        matches!(row.size, Size::Fixed(_) | Size::Padded(_) | Size::NonZero | Size::Items { .. })
    };
    !layout.repeats && !layout.fields.is_empty() && layout.fields.iter().all(ends)
}

/// Checks the result of `decode_prefix`. `prefix` is the length of the decoded stream or the error,
/// and `verdict` is the result for all bytes. If all bytes are a stream, it must be decoded to its
/// end; otherwise the decoded bytes, if any, must be a stream.
fn check_prefix(
    stream: Stream,
    bytes: &[u8],
    prefix: Result<usize, Error>,
    verdict: Result<(), Error>,
) {
    match (prefix, verdict) {
        (Ok(len), Ok(())) => assert_eq!(len, bytes.len(), "{stream}: the front of {bytes:x?}"),
        (Ok(len), Err(_)) => {
            let front = stream.walk(&bytes[..len], |_| ());
            assert_eq!(front, Ok(()), "{stream}: the first {len} of {bytes:x?}");
        }
        (Err(_), verdict) => assert!(verdict.is_err(), "{stream}: the front of {bytes:x?}"),
    }
}

/// Checks that a value encodes to bytes that decode to that value, and that these bytes satisfy
/// [`check`].
#[cfg(feature = "alloc")]
pub(crate) fn check_value<T>(value: &T)
where
    T: Encode + PartialEq + Debug + for<'a> Decode<'a>,
{
    check_value_bent(value, &Mutation::NONE);
}

/// Like [`check_value`], for a codec to which `mutation` adds a fault. Returns the bytes.
#[cfg(feature = "alloc")]
pub(crate) fn check_value_bent<T>(value: &T, mutation: &Mutation) -> Vec<u8>
where
    T: Encode + PartialEq + Debug + for<'a> Decode<'a>,
{
    let mut bytes = value.encode_to_vec().unwrap_or_else(|error| panic!("{value:?}: {error}"));
    (mutation.written)(&mut bytes);
    assert_eq!(Ok(bytes.len()), (mutation.len)(Ok(value.encoded_len())), "{value:?}");
    check_too_small(bytes.len(), mutation, |buf| value.encode(buf).map(drop));
    assert_eq!(T::decode(&bytes).as_ref(), Ok(value));
    assert_eq!(check_bent(T::STREAM, &bytes, mutation), Ok(()), "{value:?}");
    bytes
}

/// Checks that the segments of accepted bytes cover them without gaps and join to the same bytes,
/// and that an error names the stream and has an offset within the bytes or at their end.
fn walk(stream: Stream, bytes: &[u8], mutation: &Mutation) -> Result<(), Error> {
    let (mut end, mut parts) = (0, Vec::new());
    let verdict = stream.walk(bytes, |segment| {
        parts.push((segment.field, segment.bytes));
        assert_eq!(segment.offset as usize, end, "{stream}: {segment:?}");
        assert_eq!(segment.bytes, &bytes[end..end + segment.bytes.len()]);
        end += (mutation.segment)(segment.bytes.len());
    });
    match verdict {
        Ok(()) => {
            assert_eq!(end, bytes.len(), "{stream}: bytes in no segment of {bytes:x?}");
            let mut room = vec![UNTOUCHED; bytes.len()];
            let mut joined = stream.join(parts, &mut room).map(<[u8]>::to_vec);
            joined.iter_mut().for_each(mutation.joined);
            assert_eq!(joined.as_deref(), Ok(bytes), "{stream}: joined from {bytes:x?}");
        }
        Err(error) => {
            assert_eq!(error.field().stream(), Some(stream));
            assert!(error.offset() as usize <= bytes.len(), "{error}");
        }
    }
    verdict
}

/// Checks that the decoded value encodes to the same bytes, that no byte after them is written, and
/// that a buffer that is too small stays unchanged.
fn check_encode(reading: StreamType, bytes: &[u8], mutation: &Mutation) {
    let mut large = vec![UNTOUCHED; bytes.len() + 3];
    assert_eq!((reading.encode)(bytes, &mut large), Ok(bytes.len()));
    (mutation.written)(&mut large[..bytes.len()]);
    assert_eq!(large[..bytes.len()], *bytes);
    assert_eq!(large[bytes.len()..], [UNTOUCHED; 3]);

    check_too_small(bytes.len(), mutation, |buf| (reading.encode)(bytes, buf));
}

/// Checks for some buffers that are too small that encoding fails with the numbers of needed and
/// available bytes, and that nothing is written to the buffer.
fn check_too_small<T: Debug>(
    len: usize,
    mutation: &Mutation,
    encode: impl Fn(&mut [u8]) -> Result<T, Error>,
) {
    for less in [0, len / 2, len.saturating_sub(1)] {
        if less < len {
            let mut small = vec![UNTOUCHED; less];
            let error = encode(&mut small).expect_err("the buffer is too small");
            (mutation.small)(&mut small);
            assert_eq!(error.kind(), ErrorKind::BufferTooSmall);
            let (expected, found) = (error.expected() as usize, error.found() as usize);
            assert_eq!((expected, found), (len, less));
            assert!(small.iter().all(|&byte| byte == UNTOUCHED));
        }
    }
}

/// Checks that a frame can carry the call, unless it is a Read with data. The dispatched request
/// must encode to a call with the same service, index group, index offset and data, and this call
/// must be dispatched to the same request. Returns the error of dispatch, if any.
pub(crate) fn check_call(call: &Call<'_>) -> Result<(), DispatchError> {
    check_call_bent(call, &Mutation::NONE, |_| ()).map(drop)
}

/// Like [`check_call`], for a codec to which `mutation` adds a fault; `wrong` changes the encoded
/// call. Returns the function to which the call is dispatched, or the error of dispatch.
pub(crate) fn check_call_bent(
    call: &Call<'_>,
    mutation: &Mutation,
    wrong: impl Fn(&mut Call<'_>),
) -> Result<Function, DispatchError> {
    check_frame(call, mutation);
    let request = call.dispatch()?;
    let mut buf = vec![0; request.encoded_len()];
    let mut again = request.encode(&mut buf).unwrap_or_else(|error| panic!("{request:?}: {error}"));
    wrong(&mut again);

    let address = |call: &Call<'_>| (call.service, call.index_group, call.index_offset);
    assert_eq!(address(&again), address(call), "{request:?}");
    assert_eq!(again.data, call.data, "{request:?}");
    assert_eq!(request.encoded_len(), call.data.len(), "{request:?}");
    check_too_small(call.data.len(), mutation, |buf| request.encode(buf).map(drop));
    assert_eq!(again.dispatch(), Ok(request));

    let spec = request.function().spec();
    assert_eq!(spec.service, call.service);
    assert_eq!(spec.request.is_none(), call.service == AdsService::Read);
    // The encoded call has the port of the SDA task for a function that the GEO task also serves.
    let is_com = |call: &Call<'_>| Task::from_port(call.port) == Some(Task::Com);
    assert_eq!(is_com(&again), is_com(call));
    Ok(request.function())
}

/// Checks that a call is unchanged after it was encoded to a frame and decoded from it, except for
/// the read length of a Write, which a frame does not contain. Only a Read with data may be
/// rejected.
fn check_frame(call: &Call<'_>, mutation: &Mutation) {
    let mut bytes = vec![0; call.encoded_len()];
    let data = match call.encode(&mut bytes) {
        Ok(data) => data,
        Err(error) => {
            assert_eq!((call.service, error.kind()), (AdsService::Read, ErrorKind::Trailing));
            assert!(!call.data.is_empty());
            return;
        }
    };
    assert_eq!(data.len(), call.encoded_len());
    check_too_small(data.len(), mutation, |buf| call.encode(buf).map(drop));
    let end = AmsAddr { net_id: AmsNetId([192, 0, 2, 1, 1, 1]), port: call.port };
    let header = AmsHeader::request(end, end, call.service.command(), 1);
    let frame = FrameRef::new(header, data).expect("no more data than a service has");
    let read_length = if call.service == AdsService::Write { 0 } else { call.read_length };
    assert_eq!(Call::from_frame(&frame), Ok(Some(Call { read_length, ..*call })));
}

/// Checks a call to `function` by [`check_call`], and that dispatch accepts and rejects the same
/// data as the stream of the request of `function`, if it has one.
pub(crate) fn check_request(call: &Call<'_>, function: Function) -> Result<(), DispatchError> {
    let verdict = check_call(call);
    if let Some(stream) = function.spec().request {
        let wanted = check(stream, call.data).map_err(DispatchError::Stream);
        assert_eq!(verdict, wanted, "{function:?}: {:x?}", call.data);
    }
    verdict
}

/// Checks that the request of a valid call accepts and rejects the same replies as its function's
/// stream of the reply, except for replies longer than the call permits. Accepted replies must
/// encode to the same bytes.
pub(crate) fn check_reply(call: &Call<'_>, bytes: &[u8]) -> Result<(), Error> {
    check_reply_bent(call, bytes, &Mutation::NONE).map(drop)
}

/// Like [`check_reply`], for a codec to which `mutation` adds a fault. Returns the function of the
/// call, or the error of the reply.
pub(crate) fn check_reply_bent(
    call: &Call<'_>,
    bytes: &[u8],
    mutation: &Mutation,
) -> Result<Function, Error> {
    let request = call.dispatch().expect("a call that is answered");
    let reply = request.decode_reply(bytes);
    let wanted = match request.function().spec().reply {
        Some(stream) => check(stream, bytes),
        None => NoData::decode(bytes).map(drop),
    };
    let verdict = (mutation.len)(reply.map(|reply| reply.encoded_len()));
    // A read length that is not a multiple of 84 requests one descriptor (COM-3).
    let asked = match (request, call.read_length as usize) {
        (Request::ReadDescriptors(_), length) if length % DESCRIPTOR_LEN != 0 => DESCRIPTOR_LEN,
        (_, length) => length,
    };
    // An accepted reply must not be longer than the read length of the call that the request
    // encodes to.
    let mut buf = vec![0; request.encoded_len()];
    let most = request.encode(&mut buf).map(|call| call.read_length as usize);
    if let Ok(len) = verdict {
        assert_eq!(len, bytes.len(), "{request:?}: {bytes:x?}");
        assert!(most.is_ok_and(|most| bytes.len() <= most), "{request:?}: {bytes:x?}");
    }
    if bytes.len() <= asked || verdict.is_ok() {
        assert_eq!(mutation.told(verdict), Mutation::NONE.told(wanted), "{request:?}: {bytes:x?}");
    }
    let reply = reply?;
    let mut large = vec![UNTOUCHED; bytes.len() + 3];
    assert_eq!(reply.encode(&mut large).map(<[u8]>::len), Ok(bytes.len()));
    (mutation.written)(&mut large[..bytes.len()]);
    assert_eq!(large[..bytes.len()], *bytes);
    assert_eq!(large[bytes.len()..], [UNTOUCHED; 3]);
    check_too_small(bytes.len(), mutation, |buf| reply.encode(buf).map(drop));
    Ok(request.function())
}
