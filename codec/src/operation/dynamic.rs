//! Operations on dynamic parameters (DYN-1 … DYN-7).

use super::request::sealed::Sealed;
use super::variable::channel;
use super::{Call, Function, Operation, Refusal, Request};
use crate::address::{Attribute, Channel, Class, IndexGroup, IndexOffset};
use crate::bytes::to_u32;
use crate::dynamic::{
    DynamicCount, DynamicIndex, DynamicKind, DynamicNameRef, DynamicNameRequestRef, DynamicValue,
};
use crate::error::Error;
use crate::limits::DYNAMIC_NAME_MAX;
use crate::stream::{Decode, Encode, NoData};
use crate::text::TextRef;

/// Which channel and kind the dispatcher has found a function of.
fn place(offsets: [u32; 4], call: &Call<'_>) -> (Channel, DynamicKind) {
    let kind = DynamicKind::of_offset(offsets, call.index_offset);
    (channel(call), kind.unwrap_or(DynamicKind::P))
}

/// Declares an operation: its offsets, what it is about, the stream that says so.
macro_rules! dynamic {
    (
        $(#[$doc:meta])*
        $name:ident $(<$lifetime:lifetime>)? at $offsets:ident
        $( { $(#[$field_doc:meta])* $field:ident: $ty:ty, of $decode:expr } )?
        sends $stream:expr, reply $reply:ty, at most $most:expr
    ) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub struct $name $(<$lifetime>)? {
            /// Which channel.
            pub channel: Channel,
            /// Which kind of parameters.
            pub kind: DynamicKind,
            $( $(#[$field_doc])* pub $field: $ty, )?
        }

        impl $(<$lifetime>)? $name $(<$lifetime>)? {
            pub(super) fn dispatched<'c>(call: &Call<'c>) -> Result<Request<'c>, Refusal> {
                $( let $field = $decode(call.data).map_err(Refusal::Stream)?; )?
                let (channel, kind) = place(DynamicKind::$offsets, call);
                Ok(Request::$name($name { channel, kind $(, $field)? }))
            }
        }

        impl $(<$lifetime>)? Sealed for $name $(<$lifetime>)? {}

        impl $(<$lifetime>)? Operation for $name $(<$lifetime>)? {
            const FUNCTION: Function = Function::$name;

            type Reply<'r> = $reply;

            fn index_group(&self) -> IndexGroup {
                self.channel.class(Class::Decoder, Attribute::Content)
            }

            fn index_offset(&self) -> IndexOffset {
                self.kind.offset(DynamicKind::$offsets)
            }

            fn read_length(&self) -> u32 {
                $most
            }

            fn encoded_len(&self) -> usize {
                $stream(self).encoded_len()
            }

            fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Error> {
                $stream(self).encode(buf)
            }
        }
    };
}

fn index(data: &[u8]) -> Result<u32, Error> {
    DynamicIndex::decode(data).map(|index| index.0)
}

fn name(data: &[u8]) -> Result<TextRef<'_>, Error> {
    DynamicNameRequestRef::decode(data).map(|request| request.name)
}

dynamic! {
    /// How many parameters of a kind there are now: Read at offset 0x02 (P), 0x03 (V.L), 0x04
    /// (V.P) or 0x05 (V.S), port 552.
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 3.1 … 3.4.
    ///
    /// ```
    /// use ads_cnc::address::Channel;
    /// use ads_cnc::dynamic::DynamicKind;
    /// use ads_cnc::operation::{CountDynamic, Operation};
    ///
    /// let op = CountDynamic::new(Channel::new(1)?, DynamicKind::VS);
    /// assert_eq!((op.index_group().get(), op.index_offset().get()), (0x12_2301, 0x05));
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    CountDynamic at COUNT
    sends |_: &Self| NoData,     reply DynamicCount, at most 4
}

dynamic! {
    /// The name of a parameter by its index: ReadWrite at offset 0x1B (P), 0x1E (V.L), 0x21 (V.P)
    /// or 0x24 (V.S), port 552.
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 3.1 … 3.4.
    ///
    /// ```
    /// use ads_cnc::address::Channel;
    /// use ads_cnc::dynamic::DynamicKind;
    /// use ads_cnc::operation::{DynamicNameByIndex, Operation};
    ///
    /// let op = DynamicNameByIndex::new(Channel::new(1)?, DynamicKind::P, 1)?;
    /// assert_eq!(op.encode(&mut [0; 4])?, [1, 0, 0, 0]);
    /// assert_eq!(op.decode_reply(b"P1\0")?.name.text(), "P1");
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    DynamicNameByIndex at NAME_BY_INDEX {
        /// Index of the parameter, from 1.
        index: u32, of index
    }
    sends |op: &Self| DynamicIndex(op.index), reply DynamicNameRef<'r>, at most to_u32(DYNAMIC_NAME_MAX)
}

dynamic! {
    /// The value of a parameter by its name: ReadWrite at offset 0x1C (P), 0x1F (V.L), 0x22 (V.P)
    /// or 0x25 (V.S), port 552.
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 3.1 … 3.4.
    ///
    /// ```
    /// use ads_cnc::address::Channel;
    /// use ads_cnc::dynamic::DynamicKind;
    /// use ads_cnc::operation::{DynamicValueByName, Operation};
    ///
    /// let op = DynamicValueByName::new(Channel::new(1)?, DynamicKind::P, "P1")?;
    /// assert_eq!(op.encode(&mut [0; 96])?, b"P1\0");
    /// assert_eq!(op.decode_reply(&4711_f64.to_le_bytes())?.get(), 4711.0);
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    DynamicValueByName<'a> at VALUE_BY_NAME {
        /// The parameter's name.
        name: TextRef<'a>, of name
    }
    sends |op: &Self| DynamicNameRequestRef { name: op.name }, reply DynamicValue, at most 8
}

dynamic! {
    /// The value of a parameter by its index: ReadWrite at offset 0x1D (P), 0x20 (V.L), 0x23 (V.P)
    /// or 0x26 (V.S), port 552. The manual advises against it: indices move.
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 3 and 3.1 … 3.4.
    ///
    /// ```
    /// use ads_cnc::address::Channel;
    /// use ads_cnc::dynamic::DynamicKind;
    /// use ads_cnc::operation::{DynamicValueByIndex, Operation};
    ///
    /// let op = DynamicValueByIndex::new(Channel::new(1)?, DynamicKind::VL, 1)?;
    /// assert_eq!((op.index_offset().get(), op.encode(&mut [0; 4])?), (0x20, &[1, 0, 0, 0][..]));
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    DynamicValueByIndex at VALUE_BY_INDEX {
        /// Index of the parameter, from 1.
        index: u32, of index
    }
    sends |op: &Self| DynamicIndex(op.index), reply DynamicValue, at most 8
}

impl CountDynamic {
    /// For a channel and a kind.
    pub const fn new(channel: Channel, kind: DynamicKind) -> Self {
        Self { channel, kind }
    }
}

impl DynamicNameByIndex {
    /// For a channel, a kind and an index.
    ///
    /// # Errors
    /// [`ErrorKind::OutOfRange`](crate::ErrorKind::OutOfRange) for the index 0.
    pub fn new(channel: Channel, kind: DynamicKind, index: u32) -> Result<Self, Error> {
        DynamicIndex(index).check()?;
        Ok(Self { channel, kind, index })
    }
}

impl DynamicValueByIndex {
    /// For a channel, a kind and an index.
    ///
    /// # Errors
    /// [`ErrorKind::OutOfRange`](crate::ErrorKind::OutOfRange) for the index 0.
    pub fn new(channel: Channel, kind: DynamicKind, index: u32) -> Result<Self, Error> {
        DynamicIndex(index).check()?;
        Ok(Self { channel, kind, index })
    }
}

impl<'a> DynamicValueByName<'a> {
    /// For a channel, a kind and a name, `P1` for one.
    ///
    /// # Errors
    /// Those of [`TextRef::new`].
    pub fn new(channel: Channel, kind: DynamicKind, name: &'a str) -> Result<Self, Error> {
        Ok(Self { channel, kind, name: TextRef::new(name)? })
    }
}
