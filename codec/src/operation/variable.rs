//! Operations of the channel interface for variables (VAR-1 … VAR-14).

use super::request::sealed::Sealed;
use super::{Call, Function, Operation, Refusal, Request};
use crate::address::{Attribute, Channel, Class, IndexGroup, IndexOffset};
use crate::error::Error;
use crate::stream::{Decode, Encode};
use crate::text::TextRef;
use crate::variable::{
    DescriptionByNameRef, DescriptionRef, ExtendedReply, Handle, HandleReadRef, Kind, Numbers,
    ValueRef, VariableCount, VariableIndexKindRef, VariableKindRef, VariableNameRef,
};

/// The channel of a group that the dispatcher has found to be one of a channel.
#[inline]
pub(super) fn channel(call: &Call<'_>) -> Channel {
    let (instance, addressing) = call.index_group.instance();
    Channel::of(instance, addressing)
}

/// Declares an operation: its fields, its stream, its function. One of an axis has the axis
/// before its fields.
macro_rules! operation {
    (
        $(#[$doc:meta])*
        $name:ident { $( #[$field_doc:meta] $field:ident: $ty:ty, )+ }
        as $stream:ident, $offset:literal $(of $axis:ident)?, reply $reply:ty, at most $most:literal
    ) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub struct $name<'a> {
            /// Which channel.
            pub channel: Channel,
            $(
                /// Which place of an axis in the channel.
                pub $axis: ChannelAxis,
            )?
            $( #[$field_doc] pub $field: $ty, )+
        }

        impl<'a> $name<'a> {
            fn stream(&self) -> $stream<'a> {
                $stream { $( $field: self.$field, )+ }
            }

            pub(super) fn dispatched(call: &Call<'a>) -> Result<Request<'a>, Refusal> {
                let $stream { $( $field, )+ } =
                    $stream::decode(call.data).map_err(Refusal::Stream)?;
                $( let $axis = ChannelAxis::of(call.index_offset); )?
                Ok(Request::$name(Self { channel: channel(call), $( $axis, )? $( $field, )+ }))
            }
        }

        impl Sealed for $name<'_> {}

        impl Operation for $name<'_> {
            const FUNCTION: Function = Function::$name;

            type Reply<'r> = $reply;

            fn index_group(&self) -> IndexGroup {
                self.channel.class(Class::Decoder, Attribute::Content)
            }

            fn index_offset(&self) -> IndexOffset {
                let offset = IndexOffset::new($offset);
                $( let offset = self.$axis.offset($offset).unwrap_or(offset); )?
                offset
            }

            fn read_length(&self) -> u32 {
                $most
            }

            fn encoded_len(&self) -> usize {
                self.stream().encoded_len()
            }

            fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Error> {
                self.stream().encode(buf)
            }
        }
    };
}

pub(super) use operation;

operation! {
    /// How many variables of a kind a channel has: ReadWrite at offset 0x44, port 552.
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 4.3.1.
    ///
    /// ```
    /// use ads_cnc::address::Channel;
    /// use ads_cnc::operation::{CountVariables, Operation};
    /// use ads_cnc::Kind;
    ///
    /// let op = CountVariables::new(Channel::new(1)?, Kind::V_E);
    /// assert_eq!(op.encode(&mut [0; 256])?, b"V.E\0");
    /// assert_eq!(op.decode_reply(&[123, 0, 0, 0])?.0, 123);
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    CountVariables {
        /// The kind; [`Kind::ALL`] for the sum of all.
        kind: Kind<'a>,
    }
    as VariableKindRef, 0x44, reply VariableCount, at most 4
}

operation! {
    /// The description of a variable: ReadWrite at offset 0x45, port 552.
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 4.3.2.
    ///
    /// ```
    /// use ads_cnc::address::Channel;
    /// use ads_cnc::operation::{DescribeByIndex, Operation};
    /// use ads_cnc::Kind;
    ///
    /// let op = DescribeByIndex::new(Channel::new(1)?, 2, Kind::V_E);
    /// assert_eq!(op.encode(&mut [0; 260])?, b"\x02\0\0\0V.E\0");
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    DescribeByIndex {
        /// Index of the variable, from 0 to one less than their number.
        index: u32,
        /// The kind.
        kind: Kind<'a>,
    }
    as VariableIndexKindRef, 0x45, reply DescriptionRef<'r>, at most 2048
}

operation! {
    /// The handle of a variable: ReadWrite at offset 0x46, port 552.
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 4.3.3.
    ///
    /// ```
    /// use ads_cnc::address::Channel;
    /// use ads_cnc::operation::{HandleByName, Operation};
    ///
    /// let op = HandleByName::new(Channel::new(1)?, "V.E.vartest")?;
    /// assert_eq!(op.decode_reply(&[4, 0, 0, 2])?.0, 0x2000004);
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    HandleByName {
        /// The variable's name; that of an axis variable ends in the axis's name.
        name: TextRef<'a>,
    }
    as VariableNameRef, 0x46, reply Handle, at most 4
}

operation! {
    /// The value of a variable by its handle: ReadWrite at offset 0x47, port 552.
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 4.3.4.
    ///
    /// ```
    /// use ads_cnc::address::Channel;
    /// use ads_cnc::operation::{Operation, ReadByHandle};
    /// use ads_cnc::{Handle, Numbers};
    ///
    /// let op = ReadByHandle::new(Channel::new(1)?, Handle(0x20012341), Numbers::from(&[4]));
    /// assert_eq!(op.decode_reply(&333_i32.to_le_bytes())?.bytes, 333_i32.to_le_bytes());
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    ReadByHandle {
        /// Handle of the variable.
        handle: Handle,
        /// Index in each dimension, from 0; none for the whole variable.
        indices: Numbers<'a>,
    }
    as HandleReadRef, 0x47, reply ValueRef<'r>, at most 2048
}

operation! {
    /// The value of a variable by its name: ReadWrite at offset 0x48, port 552.
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 4.3.5.
    ///
    /// ```
    /// use ads_cnc::address::Channel;
    /// use ads_cnc::operation::{Operation, ReadByName};
    ///
    /// let op = ReadByName::new(Channel::new(1)?, "V.E.Testvar[3]")?;
    /// assert_eq!(op.encode(&mut [0; 256])?, b"V.E.Testvar[3]\0");
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    ReadByName {
        /// The variable's name; with an index for one element of an array.
        name: TextRef<'a>,
    }
    as VariableNameRef, 0x48, reply ValueRef<'r>, at most 2048
}

operation! {
    /// The extended description of a variable: ReadWrite at offset 0x4B, port 552.
    ///
    /// Only V.E variables have one; the reply for the others is empty.
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 4.3.8.
    ///
    /// ```
    /// use ads_cnc::address::Channel;
    /// use ads_cnc::operation::{DescribeExtended, Operation};
    /// use ads_cnc::{Kind, Validity};
    ///
    /// let op = DescribeExtended::new(Channel::new(1)?, 3, Kind::V_E);
    /// assert_eq!(op.encode(&mut [0; 260])?, b"\x03\0\0\0V.E\0");
    /// let extended = op.decode_reply(&[2, 0, 0, 0, 2, 0, 0, 0])?.0;
    /// assert_eq!(extended.map(|extended| extended.validity), Some(Validity::GLOBAL));
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    DescribeExtended {
        /// Index of the variable, from 0 to one less than their number.
        index: u32,
        /// The kind.
        kind: Kind<'a>,
    }
    as VariableIndexKindRef, 0x4B, reply ExtendedReply, at most 2048
}

operation! {
    /// The description of a variable by its name: ReadWrite at offset 0x4C, port 552.
    ///
    /// Documented online only, for CNC versions from V3.1.3132.0 and V4.29.0 on; `ads-en` 1.05 and
    /// `ads-de` 1.051 reserve the offset in section 4.2.1.
    ///
    /// ```
    /// use ads_cnc::VariableType;
    /// use ads_cnc::address::Channel;
    /// use ads_cnc::operation::{DescribeByName, Operation};
    ///
    /// let op = DescribeByName::new(Channel::new(1)?, "V.E.Variable_3")?;
    /// let reply = b"\x02\0\0\x02\x01\0\0\0\x01\0\0\0\x02\0\0\0\x01\0\0\0\x02\0\0\0";
    /// assert_eq!(op.decode_reply(reply)?.var_type, VariableType::BOOLEAN);
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    DescribeByName {
        /// The variable's name.
        name: TextRef<'a>,
    }
    as VariableNameRef, 0x4C, reply DescriptionByNameRef<'r>, at most 2048
}

impl<'a> DescribeByName<'a> {
    /// For a channel and a name.
    ///
    /// # Errors
    /// Those of [`TextRef::new`].
    pub fn new(channel: Channel, name: &'a str) -> Result<Self, Error> {
        Ok(Self { channel, name: TextRef::new(name)? })
    }
}

impl<'a> DescribeExtended<'a> {
    /// For a channel, an index and a kind.
    pub const fn new(channel: Channel, index: u32, kind: Kind<'a>) -> Self {
        Self { channel, index, kind }
    }
}

impl<'a> CountVariables<'a> {
    /// For a channel and a kind.
    pub const fn new(channel: Channel, kind: Kind<'a>) -> Self {
        Self { channel, kind }
    }
}

impl<'a> DescribeByIndex<'a> {
    /// For a channel, an index and a kind.
    pub const fn new(channel: Channel, index: u32, kind: Kind<'a>) -> Self {
        Self { channel, index, kind }
    }
}

impl<'a> HandleByName<'a> {
    /// For a channel and a name.
    ///
    /// # Errors
    /// Those of [`CncStr::new`](crate::CncStr::new).
    pub fn new(channel: Channel, name: &'a str) -> Result<Self, Error> {
        Ok(Self { channel, name: TextRef::new(name)? })
    }
}

impl<'a> ReadByHandle<'a> {
    /// For a channel, a handle and indices.
    pub const fn new(channel: Channel, handle: Handle, indices: Numbers<'a>) -> Self {
        Self { channel, handle, indices }
    }
}

impl<'a> ReadByName<'a> {
    /// For a channel and a name.
    ///
    /// # Errors
    /// Those of [`CncStr::new`](crate::CncStr::new).
    pub fn new(channel: Channel, name: &'a str) -> Result<Self, Error> {
        Ok(Self { channel, name: TextRef::new(name)? })
    }
}
