//! What functions answer.

use crate::com::{DescriptorsRef, ObjectCount};
use crate::error::Error;
use crate::stream::{Encode, NoData};
use crate::variable::{DescriptionRef, ExtendedReply, Handle, ValueRef, VariableCount};

/// Any reply: what a server answers, what a tool shows.
///
/// ```
/// use ads_cnc::operation::Reply;
/// use ads_cnc::{Encode, Handle};
///
/// let mut buf = [0; 4];
/// assert_eq!(Reply::from(Handle(0x2000004)).encode(&mut buf)?, [4, 0, 0, 2]);
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Reply<'a> {
    /// Number of objects.
    ObjectCount(ObjectCount),
    /// Object descriptors.
    Descriptors(DescriptorsRef<'a>),
    /// Number of variables.
    VariableCount(VariableCount),
    /// Description of a variable.
    Description(DescriptionRef<'a>),
    /// Handle of a variable.
    Handle(Handle),
    /// Value of a variable.
    Value(ValueRef<'a>),
    /// Extended description of a variable, or none.
    Extended(ExtendedReply),
    /// Nothing, of a write.
    NoData(NoData),
}

macro_rules! each_reply {
    ($self:expr, $reply:ident => $then:expr) => {
        match $self {
            Reply::ObjectCount($reply) => $then,
            Reply::Descriptors($reply) => $then,
            Reply::VariableCount($reply) => $then,
            Reply::Description($reply) => $then,
            Reply::Handle($reply) => $then,
            Reply::Value($reply) => $then,
            Reply::Extended($reply) => $then,
            Reply::NoData($reply) => $then,
        }
    };
}

impl Encode for Reply<'_> {
    fn encoded_len(&self) -> usize {
        each_reply!(self, reply => reply.encoded_len())
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Error> {
        each_reply!(self, reply => reply.encode(buf))
    }
}

macro_rules! from_reply {
    ($( $reply:ty => $variant:ident, )+) => { $(
        impl<'a> From<$reply> for Reply<'a> {
            fn from(reply: $reply) -> Self {
                Self::$variant(reply)
            }
        }
    )+ };
}

from_reply! {
    ObjectCount => ObjectCount,
    DescriptorsRef<'a> => Descriptors,
    VariableCount => VariableCount,
    DescriptionRef<'a> => Description,
    Handle => Handle,
    ValueRef<'a> => Value,
    ExtendedReply => Extended,
    NoData => NoData,
}
