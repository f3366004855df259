//! The tables themselves: one per stream, in the manual's order of fields.

use super::field::Field;
use super::head;
use super::spec::{FieldSpec, Layout, Size, Type};
use super::subject::Subject;
use crate::declare::Declared;

const FIXED_4: Size = Size::Fixed(4);

/// Declares [`Stream`], its layouts and, per stream, its rows and a constant for each field.
/// A stream of records names the module of the record instead of rows.
macro_rules! layouts {
    ($(
        $(#[$doc:meta])*
        $stream:ident, $module:ident:
        $( => $type:ty; )?
        $( $name:literal, $title:literal, $clause:literal, max $max:literal )?
        $( , records of $record:ident; )?
        $( {
            $( $field:ident $field_name:literal @ $offset:literal $(+ $per_item:literal m)?,
               $size:expr, $ty:ident, $field_clause:literal, $meaning:literal; )*
        } )?
    )+) => {
        /// A stream: bytes that the manuals describe by a table.
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
        pub enum Stream { $( $(#[$doc])* $stream, )+ }

        pub(super) const TABLES: &[Stream] = &[$( Stream::$stream, )+];

        impl Stream {
            /// The stream's table.
            pub const fn layout(self) -> &'static Layout {
                match self { $( Self::$stream => &fields::$module::LAYOUT, )+ }
            }

            /// The sizes of the fixed fields that a record begins with.
            pub(crate) const fn head_sizes(self) -> &'static [u8] {
                match self { $( Self::$stream => &fields::$module::HEAD, )+ }
            }
        }

        /// A constant for each field, so that no decoder spells a name.
        pub(crate) mod fields { $(
            #[allow(dead_code, reason = "tables name every field, decoders not all of them")]
            pub(crate) mod $module {
                use super::super::*;

                const REPEATS: bool = false $( | { _ = super::$record::LAYOUT; true } )?;
                $( pub(crate) const LAYOUT: Layout = <$type as Declared>::LAYOUT;
                pub(crate) const FIELDS: &[FieldSpec] = LAYOUT.fields; )?
                $( pub(crate) const LAYOUT: Layout = Layout {
                    name: $name,
                    title: $title,
                    clause: $clause,
                    max: $max,
                    repeats: REPEATS,
                    fields: FIELDS,
                }; )?
                pub(crate) static HEAD: [u8; head::count(FIELDS)] = head::sizes(FIELDS);
                $( pub(crate) const FIELDS: &[FieldSpec] = super::$record::LAYOUT.fields; )?
                $(
                    pub(crate) const FIELDS: &[FieldSpec] = &[$( FieldSpec {
                        name: $field_name,
                        offset: $offset,
                        per_item: 0 $(+ $per_item)?,
                        size: $size,
                        ty: Type::$ty,
                        meaning: $meaning,
                        clause: $field_clause,
                    }, )*];
                    #[allow(non_camel_case_types, clippy::upper_case_acronyms)]
                    enum Index { $( $field, )* }
                    $(
                        #[allow(clippy::as_conversions, reason = "a discriminant, no input")]
                        pub(crate) const $field: Field =
                            Field::new(Subject::Stream(Stream::$stream), Index::$field as u8);
                    )*
                )?
            }
        )+ }
    };
}

layouts! {
    /// AMS/TCP header.
    AmsTcpHeader, ams_tcp_header: => crate::ads::AmsTcpHeader;
    /// AMS header.
    AmsHeader, ams_header: => crate::ads::HeaderLayout;
    /// ADS Read, request.
    ReadRequest, read_request: => crate::ads::ReadRequest;
    /// ADS Read, reply.
    ReadReply, read_reply: "read-reply", "ADS Read, reply", "ADS-1", max 0x40_0008 {
        RESULT "result" @ 0, FIXED_4, Uns32, "ADS-4", "ADS error number, 0 for success";
        LENGTH "length" @ 4, Size::FixedOnSuccess(4), Uns32, "ADS-1", "bytes of data";
        DATA "data" @ 8, Size::Items { each: 1, max: 0x40_0000 }, Bytes, "ADS-1", "the data";
    }
    /// ADS Write, request.
    WriteRequest, write_request: => crate::ads::WriteRequestRef<'static>;
    /// ADS Write, reply.
    WriteReply, write_reply: => crate::ads::WriteReply;
    /// ADS ReadWrite, request.
    ReadWriteRequest, read_write_request: => crate::ads::ReadWriteRequestRef<'static>;
    /// ADS ReadWrite, reply.
    ReadWriteReply, read_write_reply: "read-write-reply", "ADS ReadWrite, reply", "ADS-3", max 0x40_0008 {
        RESULT "result" @ 0, FIXED_4, Uns32, "ADS-4", "ADS error number, 0 for success";
        LENGTH "length" @ 4, Size::FixedOnSuccess(4), Uns32, "ADS-3", "bytes of data";
        DATA "data" @ 8, Size::Items { each: 1, max: 0x40_0000 }, Bytes, "ADS-3", "the data";
    }
    /// ADS ReadDeviceInfo, reply.
    DeviceInfoReply, device_info_reply: => crate::ads::InfoLayout;
    /// ADS ReadState, reply.
    DeviceStateReply, device_state_reply: => crate::ads::DeviceStateReply;
    /// Number of objects of a COM list.
    ObjectCount, object_count: => crate::ObjectCount;
    /// One object descriptor.
    ObjectDescriptor, object_descriptor: => crate::com::DescriptorLayout;
    /// Object descriptors in sequence.
    ObjectDescriptors, object_descriptors: "object-descriptors", "Object descriptors in sequence, reply", "COM-3", max 0x40_0000,
        records of object_descriptor;
    /// Request of the number of variables.
    VariableKind, variable_kind: => crate::VariableKindRef<'static>;
    /// Number of variables.
    VariableCount, variable_count: => crate::VariableCount;
    /// Request of a description.
    VariableIndexKind, variable_index_kind: => crate::VariableIndexKindRef<'static>;
    /// Description of a variable.
    VariableDescription, variable_description: => crate::DescriptionRef<'static>;
    /// Request by a variable's name.
    VariableName, variable_name: => crate::VariableNameRef<'static>;
    /// Handle of a variable.
    VariableHandle, variable_handle: => crate::Handle;
    /// Request of a value by handle.
    VariableHandleRead, variable_handle_read: => crate::HandleReadRef<'static>;
    /// Value of a variable.
    VariableValue, variable_value: => crate::ValueRef<'static>;
    /// Request to write a value by handle.
    VariableHandleWrite, variable_handle_write: => crate::HandleWriteRef<'static>;
    /// Request to write a value by name.
    VariableNameWrite, variable_name_write: => crate::NameWriteRef<'static>;
    /// Extended description of a variable.
    VariableExtendedDescription, variable_extended_description: => crate::ExtendedDescription;
    /// Content of a COM object, or of an element of a class.
    Content, content: => crate::ContentRef<'static>;
    /// Query of the address of an instance of a class.
    ObjectAddressQuery, object_address_query: => crate::sda::ObjectAddressQuery;
    /// Address of an instance of a class.
    ObjectAddress, object_address: => crate::sda::ObjectAddress;
    /// Number of element types of an instance.
    ElementCount, element_count: => crate::sda::ElementCount;
    /// Name, type or unit of an element.
    ElementText, element_text: => crate::sda::ElementTextRef<'static>;
    /// Length of an element's content.
    ElementLength, element_length: "element-length", "Length of an element, reply", "SDA-8", max 4 {
        LENGTH "length" @ 0, Size::Uns8To32, Unsigned, "SDA-8", "bytes of the content";
    }
    /// Whether an element may be written.
    ElementWriteFlag, element_write_flag: => crate::sda::ElementWriteFlag;
    /// Number of dynamic parameters of a kind.
    DynamicCount, dynamic_count: => crate::dynamic::DynamicCount;
    /// Request of a dynamic parameter by its index.
    DynamicIndex, dynamic_index: => crate::dynamic::DynamicIndex;
    /// Name of a dynamic parameter.
    DynamicName, dynamic_name: => crate::dynamic::DynamicNameRef<'static>;
    /// Request of a dynamic parameter by its name.
    DynamicNameRequest, dynamic_name_request: => crate::dynamic::DynamicNameRequestRef<'static>;
    /// Value of a dynamic parameter.
    DynamicValue, dynamic_value: "dynamic-value", "Value of a dynamic parameter, reply", "DYN-3", max 8 {
        VALUE "value" @ 0, Size::Fixed(8), Real64, "DYN-3", "value of the parameter";
    }
    /// Description of a variable that was asked for by its name.
    VariableDescriptionByName, variable_description_by_name: => crate::DescriptionByNameRef<'static>;
    /// NC text in one write to the stream.
    ProgramStream, program_stream: => crate::streaming::ProgramStreamRef<'static>;
    /// The empty stream: what a CNC returns for a request without result data.
    NoData, no_data: "no-data", "No data", "VAR-17", max 0 {}
}
