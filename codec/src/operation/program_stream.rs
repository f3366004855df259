//! The operation on the program stream (STM-1).

use super::request::sealed::Sealed;
use super::{Call, Function, Operation, Refusal, Request};
use crate::address::{Access, Channel, IndexGroup, IndexOffset};
use crate::error::Error;
use crate::stream::{Decode, Encode, NoData};
use crate::streaming::{self, ProgramStreamRef};

/// Writes NC text to the stream of a channel: Write at offset 0x90 of the channel's COM group, port
/// 553. It moves the machine.
///
/// A refusal may be temporary: see [`streaming::Sender`].
///
/// Manual: `stream-en`, sections 3.2 and 5.
///
/// ```
/// use ads_cnc::address::Channel;
/// use ads_cnc::operation::{Operation, WriteProgramStream};
///
/// let op = WriteProgramStream::new(Channel::new(1)?, b"N10 G01 X200 F1000\r\n");
/// assert_eq!((op.index_group().get(), op.index_offset().get()), (0x12_0101, 0x90));
/// assert_eq!(op.encode(&mut [0; 992])?, b"N10 G01 X200 F1000\r\n");
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct WriteProgramStream<'a> {
    /// Which channel.
    pub channel: Channel,
    /// Whole lines of NC text; [`streaming::Sender`] hands them out.
    pub packet: ProgramStreamRef<'a>,
}

impl<'a> WriteProgramStream<'a> {
    /// For a channel and a packet.
    pub const fn new(channel: Channel, packet: &'a [u8]) -> Self {
        Self { channel, packet: ProgramStreamRef { bytes: packet } }
    }

    pub(super) fn dispatched(call: &Call<'a>) -> Result<Request<'a>, Refusal> {
        let packet = ProgramStreamRef::decode(call.data).map_err(Refusal::Stream)?;
        Ok(Request::WriteProgramStream(Self { channel: super::variable::channel(call), packet }))
    }
}

impl Sealed for WriteProgramStream<'_> {}

impl Operation for WriteProgramStream<'_> {
    const FUNCTION: Function = Function::WriteProgramStream;

    type Reply<'r> = NoData;

    fn index_group(&self) -> IndexGroup {
        self.channel.com(Access::Element)
    }

    fn index_offset(&self) -> IndexOffset {
        streaming::INDEX_OFFSET
    }

    fn read_length(&self) -> u32 {
        0
    }

    fn encoded_len(&self) -> usize {
        self.packet.encoded_len()
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Error> {
        self.packet.encode(buf)
    }
}
