//! [`Stream`], and the tables that are not declared by `stream!`.

use super::head;
use super::spec::{ADS_DATA, Declared, FieldSpec, Layout, Size, Type};
use crate::ads::{
    AmsHeader, DeviceInfoReply, HeaderLayout, InfoLayout, ReadReplyRef, ReadWriteReplyRef,
};
use crate::com::{DescriptorLayout, DescriptorRef, DescriptorsRef};
use crate::dynamic::DynamicValue;
use crate::sda::ElementLength;
use crate::stream::NoData;
use crate::variable::{ExtendedDescription, ExtendedReply};

/// Declares [`Stream`] and its access to the table of each stream.
macro_rules! tables {
    ($( $(#[$doc:meta])* $stream:ident: $view:ty $( , $owned:ty )?; )+) => {
        /// A stream: the bytes of a request, a reply or a header, which a table of fields
        /// describes.
        ///
        /// ```
        /// use ads_cnc::layout::Stream;
        ///
        /// let stream = Stream::by_name("variable-index-kind").unwrap();
        /// assert_eq!(stream, Stream::VariableIndexKind);
        /// assert_eq!(stream.layout().max, 260);
        /// ```
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        #[non_exhaustive]
        pub enum Stream {
            $( $(#[$doc])* $stream, )+
            /// The empty stream: the reply of a function that returns no data.
            NoData,
        }

        impl Stream {
            /// All streams except [`NoData`](Self::NoData), which has no bytes.
            pub(super) const ALL: &[Self] = &[$( Self::$stream, )+];

            /// The table of the stream.
            pub const fn layout(self) -> &'static Layout {
                match self {
                    $( Self::$stream => const { &<$view as Declared>::LAYOUT }, )+
                    Self::NoData => const { &<NoData as Declared>::LAYOUT },
                }
            }

            /// The sizes of the fixed fields at the start of a record.
            pub(crate) const fn head_sizes(self) -> &'static [u8] {
                match self {
                    $( Self::$stream => {
                        const FIELDS: &[FieldSpec] = <$view as Declared>::LAYOUT.fields;
                        static HEAD: [u8; head::count(FIELDS)] = head::sizes(FIELDS);
                        &HEAD
                    } )+
                    Self::NoData => {
                        // The match only compiles to a lookup table if each arm is a static.
                        static HEAD: [u8; 0] = [];
                        &HEAD
                    }
                }
            }
        }
    };
}

crate::streams! { @documented tables }

/// Declares the tables that `stream!` does not declare. Their types are written by hand: src/io.rs
/// lists the reasons, except for `NoData`, which has no rows.
macro_rules! by_hand {
    ($(
        $type:ty: $stream:ident $name:literal, $title:literal, $clause:literal, $(repeats $repeats:literal,)? max $max:expr,
        $fields:expr;
    )+) => { $(
        impl Declared for $type {
            const STREAM: Stream = Stream::$stream;
            const LAYOUT: Layout = Layout {
                name: $name,
                title: $title,
                clause: $clause,
                max: $max,
                repeats: false $(|| $repeats)?,
                fields: $fields,
            };
        }
    )+ };
}

by_hand! {
    ReadReplyRef<'_>: ReadReply "read-reply", "ADS Read, reply", "ADS-1", max ADS_DATA + 8,
        &reply("ADS-1");
    ReadWriteReplyRef<'_>: ReadWriteReply "read-write-reply", "ADS ReadWrite, reply", "ADS-3", max ADS_DATA + 8,
        &reply("ADS-3");
    DescriptorsRef<'_>: ObjectDescriptors "object-descriptors", "Object descriptors in sequence, reply", "COM-3", repeats true, max ADS_DATA,
        DescriptorLayout::LAYOUT.fields;
    ElementLength: ElementLength "element-length", "Length of an element, reply", "SDA-8", max 4,
        &[row("length", 0, Size::Uns8To32, Type::Unsigned, "SDA-8", "bytes of the content")];
    DynamicValue: DynamicValue "dynamic-value", "Value of a dynamic parameter, reply", "DYN-3", max 8,
        &[row("value", 0, Size::Fixed(8), Type::Real64, "DYN-3", "value of the parameter")];
    NoData: NoData "no-data", "No data", "VAR-17", max 0, &[];
}

/// The rows of a reply to Read or ReadWrite.
const fn reply(clause: &'static str) -> [FieldSpec; 3] {
    [
        row("result", 0, Size::Fixed(4), Type::Uns32, "ADS-4", "ADS error number, 0 for success"),
        row("length", 4, Size::FixedOnSuccess(4), Type::Uns32, clause, "bytes of data"),
        row("data", 8, Size::Items { each: 1, max: ADS_DATA }, Type::Bytes, clause, "the data"),
    ]
}

const fn row(
    name: &'static str,
    offset: u32,
    size: Size,
    ty: Type,
    clause: &'static str,
    meaning: &'static str,
) -> FieldSpec {
    FieldSpec { name, offset, per_item: 0, size, ty, meaning, clause }
}

/// Types whose table is declared for another type.
macro_rules! tables_of {
    ($( $type:ty: $declared:ty; )+) => { $(
        impl Declared for $type {
            const STREAM: Stream = <$declared>::STREAM;
            const LAYOUT: Layout = <$declared>::LAYOUT;
        }
    )+ };
}

tables_of! {
    AmsHeader: HeaderLayout;
    DeviceInfoReply: InfoLayout;
    DescriptorRef<'_>: DescriptorLayout;
    ExtendedReply: ExtendedDescription;
}
