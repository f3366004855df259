//! The tables themselves: one per stream, in the manual's order of fields.

use super::cuts::Cut;
use super::spec::{Field, FieldSpec, Layout, Size, Type};

const FIXED_4: Size = Size::Fixed(4);

/// Declares [`Stream`], its layouts and, per stream, its rows and a constant for each field.
/// A stream of records names the module of the record in place of rows.
macro_rules! layouts {
    ($(
        $(#[$doc:meta])*
        $stream:ident, $module:ident: $name:literal, $title:literal, $clause:literal, max $max:literal
        $( , records of $record:ident; )?
        $( {
            $( $field:ident $field_name:literal @ $offset:literal $(+ $per_item:literal m)?,
               $size:expr, $ty:ident, $field_clause:literal, $meaning:literal; )+
        } )?
    )+) => {
        /// A stream, or one of the tables that only name what an error is about.
        ///
        /// ```
        /// use ads_cnc::layout::Stream;
        ///
        /// let stream = Stream::by_name("variable-index-kind").unwrap();
        /// assert_eq!(stream, Stream::VariableIndexKind);
        /// assert_eq!(stream.layout().max, 260);
        /// assert!(Stream::all().all(|stream| stream.layout().is_stream()));
        /// ```
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        #[non_exhaustive]
        pub enum Stream { $( $(#[$doc])* $stream, )+ }

        pub(super) const TABLES: &[Stream] = &[$( Stream::$stream, )+];

        impl Stream {
            /// The stream's table.
            pub const fn layout(self) -> &'static Layout {
                match self { $( Self::$stream => &field::$module::LAYOUT, )+ }
            }

            /// Of each length that ends in the fixed fields a record begins with, where it does.
            pub(crate) const fn cuts(self) -> &'static [Cut] {
                match self { $( Self::$stream => &field::$module::CUTS, )+ }
            }
        }

        /// A constant for each field, so that no decoder spells a name.
        pub(crate) mod field { $(
            #[allow(dead_code, reason = "tables name every field, decoders not all of them")]
            pub(crate) mod $module {
                use super::super::*;

                pub(crate) const LAYOUT: Layout = Layout {
                    name: $name,
                    title: $title,
                    clause: $clause,
                    max: $max,
                    repeats: false $( | { _ = super::$record::LAYOUT; true } )?,
                    fields: FIELDS,
                };
                pub(crate) static CUTS: [Cut; Cut::count(FIELDS)] = Cut::all(FIELDS);
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
                    }, )+];
                    #[allow(non_camel_case_types, clippy::upper_case_acronyms)]
                    enum Place { $( $field, )+ }
                    $(
                        #[allow(clippy::as_conversions, reason = "a discriminant, no input")]
                        pub(crate) const $field: Field =
                            Field::new(Stream::$stream, Place::$field as u8);
                    )+
                )?
            }
        )+ }
    };
}

layouts! {
    /// AMS/TCP header.
    AmsTcpHeader, ams_tcp_header: "ams-tcp-header", "AMS/TCP header", "ADS-5", max 6 {
        RESERVED "reserved" @ 0, Size::Fixed(2), Uns16, "ADS-5", "0 for AMS commands";
        LENGTH "length" @ 2, FIXED_4, Uns32, "ADS-5", "bytes that follow: AMS header and data";
    }
    /// AMS header.
    AmsHeader, ams_header: "ams-header", "AMS header", "ADS-5", max 32 {
        TARGET_NET_ID "target_net_id" @ 0, Size::Fixed(6), NetId, "ADS-5", "who receives the frame";
        TARGET_PORT "target_port" @ 6, Size::Fixed(2), Uns16, "ADS-5", "AMS port of the receiver";
        SOURCE_NET_ID "source_net_id" @ 8, Size::Fixed(6), NetId, "ADS-5", "who sends the frame";
        SOURCE_PORT "source_port" @ 14, Size::Fixed(2), Uns16, "ADS-5", "AMS port of the sender";
        COMMAND "command" @ 16, Size::Fixed(2), Uns16, "ADS-5", "2 Read, 3 Write, 9 ReadWrite, …";
        STATE_FLAGS "state_flags" @ 18, Size::Fixed(2), Uns16, "ADS-5", "0x0004 request, 0x0005 response";
        DATA_LENGTH "data_length" @ 20, FIXED_4, Uns32, "ADS-5", "bytes that follow this header";
        ERROR "error" @ 24, FIXED_4, Uns32, "ADS-5", "AMS error number, 0 for none";
        INVOKE_ID "invoke_id" @ 28, FIXED_4, Uns32, "ADS-5", "pairs a response with its request";
    }
    /// ADS Read, request.
    ReadRequest, read_request: "read-request", "ADS Read, request", "ADS-1", max 12 {
        INDEX_GROUP "index_group" @ 0, FIXED_4, Uns32, "ADS-1", "index group";
        INDEX_OFFSET "index_offset" @ 4, FIXED_4, Uns32, "ADS-1", "index offset";
        LENGTH "length" @ 8, FIXED_4, Uns32, "ADS-1", "bytes to read at most";
    }
    /// ADS Read, reply.
    ReadReply, read_reply: "read-reply", "ADS Read, reply", "ADS-1", max 0x40_0008 {
        RESULT "result" @ 0, FIXED_4, Uns32, "ADS-4", "ADS error number, 0 for success";
        LENGTH "length" @ 4, Size::FixedUnlessError(4), Uns32, "ADS-1", "bytes of data";
        DATA "data" @ 8, Size::Items { each: 1, max: 0x40_0000 }, Bytes, "ADS-1", "the data";
    }
    /// ADS Write, request.
    WriteRequest, write_request: "write-request", "ADS Write, request", "ADS-2", max 0x40_000c {
        INDEX_GROUP "index_group" @ 0, FIXED_4, Uns32, "ADS-2", "index group";
        INDEX_OFFSET "index_offset" @ 4, FIXED_4, Uns32, "ADS-2", "index offset";
        LENGTH "length" @ 8, FIXED_4, Uns32, "ADS-2", "bytes of data";
        DATA "data" @ 12, Size::Items { each: 1, max: 0x40_0000 }, Bytes, "ADS-2", "the data";
    }
    /// ADS Write, reply.
    WriteReply, write_reply: "write-reply", "ADS Write, reply", "ADS-2", max 4 {
        RESULT "result" @ 0, FIXED_4, Uns32, "ADS-4", "ADS error number, 0 for success";
    }
    /// ADS ReadWrite, request.
    ReadWriteRequest, read_write_request: "read-write-request", "ADS ReadWrite, request", "ADS-3", max 0x40_0010 {
        INDEX_GROUP "index_group" @ 0, FIXED_4, Uns32, "ADS-3", "index group";
        INDEX_OFFSET "index_offset" @ 4, FIXED_4, Uns32, "ADS-3", "index offset";
        READ_LENGTH "read_length" @ 8, FIXED_4, Uns32, "ADS-3", "bytes to read at most";
        WRITE_LENGTH "write_length" @ 12, FIXED_4, Uns32, "ADS-3", "bytes of data";
        DATA "data" @ 16, Size::Items { each: 1, max: 0x40_0000 }, Bytes, "ADS-3", "the data";
    }
    /// ADS ReadWrite, reply.
    ReadWriteReply, read_write_reply: "read-write-reply", "ADS ReadWrite, reply", "ADS-3", max 0x40_0008 {
        RESULT "result" @ 0, FIXED_4, Uns32, "ADS-4", "ADS error number, 0 for success";
        LENGTH "length" @ 4, Size::FixedUnlessError(4), Uns32, "ADS-3", "bytes of data";
        DATA "data" @ 8, Size::Items { each: 1, max: 0x40_0000 }, Bytes, "ADS-3", "the data";
    }
    /// ADS ReadDeviceInfo, reply.
    DeviceInfoReply, device_info_reply: "device-info-reply", "ADS ReadDeviceInfo, reply", "ADS-8", max 24 {
        RESULT "result" @ 0, FIXED_4, Uns32, "ADS-4", "ADS error number, 0 for success";
        MAJOR "major" @ 4, Size::Fixed(1), Uns08, "ADS-8", "first number of the version";
        MINOR "minor" @ 5, Size::Fixed(1), Uns08, "ADS-8", "second number of the version";
        BUILD "build" @ 6, Size::Fixed(2), Uns16, "ADS-8", "third number of the version";
        NAME "name" @ 8, Size::Padded(16), String, "ADS-8", "name of the device";
    }
    /// ADS ReadState, reply.
    DeviceStateReply, device_state_reply: "device-state-reply", "ADS ReadState, reply", "ADS-9", max 8 {
        RESULT "result" @ 0, FIXED_4, Uns32, "ADS-4", "ADS error number, 0 for success";
        ADS_STATE "ads_state" @ 4, Size::Fixed(2), Uns16, "ADS-9", "5 RUN, 6 STOP, 15 CONFIG, …";
        DEVICE_STATE "device_state" @ 6, Size::Fixed(2), Uns16, "ADS-9", "state of the device's own";
    }
    /// Number of objects of a COM list.
    ObjectCount, object_count: "object-count", "Number of objects, reply", "COM-1", max 4 {
        COUNT "count" @ 0, FIXED_4, Uns32, "COM-1", "objects in the addressed list";
    }
    /// One object descriptor.
    ObjectDescriptor, object_descriptor: "object-descriptor", "Object descriptor, reply", "COM-2", max 84 {
        ID "id" @ 0, FIXED_4, Uns32, "COM-2", "unique internal number of the object";
        SIZE "size" @ 4, FIXED_4, Uns32, "COM-2", "bytes of the object's content";
        WRITE_ACCESS "write_access" @ 8, Size::Fixed(2), Uns16, "COM-2", "not 0: writable";
        NOT_ASSIGNED "not_assigned" @ 10, Size::Fixed(2), Uns16, "COM-2", "kept as it is, written as 0";
        INDEX_GROUP "index_group" @ 12, FIXED_4, Uns32, "COM-5", "index group of the content";
        INDEX_OFFSET "index_offset" @ 16, FIXED_4, Uns32, "COM-5", "index offset of the content";
        NAME "name" @ 20, Size::Padded(32), String, "COM-2", "name of the object";
        TYPE "type" @ 52, Size::Padded(32), String, "COM-2", "BOOL, BYTE, SINT, WORD, …";
    }
    /// Object descriptors in sequence.
    ObjectDescriptors, object_descriptors: "object-descriptors", "Object descriptors in sequence, reply", "COM-3", max 0x40_0000,
        records of object_descriptor;
    /// Request of the number of variables.
    VariableKind, variable_kind: "variable-kind", "Number of variable elements, request", "VAR-1", max 256 {
        KIND "kind" @ 0, Size::Terminated { max: 256, may_be_absent: true }, String, "VAR-1", "V.G, V.E or V.A; empty for all";
    }
    /// Number of variables.
    VariableCount, variable_count: "variable-count", "Number of variable elements, reply", "VAR-2", max 4 {
        COUNT "count" @ 0, FIXED_4, Uns32, "VAR-2", "variables of the kind; the largest index is one less";
    }
    /// Request of a description.
    VariableIndexKind, variable_index_kind: "variable-index-kind", "Variable description by index, request", "VAR-3", max 260 {
        INDEX "index" @ 0, FIXED_4, Uns32, "VAR-3", "index of the variable, from 0";
        KIND "kind" @ 4, Size::Terminated { max: 256, may_be_absent: false }, String, "VAR-3", "V.G, V.E or V.A";
    }
    /// Description of a variable.
    VariableDescription, variable_description: "variable-description", "Variable description by index, reply", "VAR-4", max 2048 {
        HANDLE "handle" @ 0, FIXED_4, Uns32, "VAR-10", "handle of the variable";
        TYPE "type" @ 4, FIXED_4, Uns32, "VAR-5", "1 BOOLEAN … 9 STRING";
        ACCESS "access" @ 8, FIXED_4, Uns32, "VAR-6", "1 READ_ONLY, 2 READ_WRITE";
        SIZE "size" @ 12, FIXED_4, Uns32, "VAR-8", "bytes of the whole variable";
        DIMENSION_COUNT "dimension_count" @ 16, FIXED_4, Uns32, "VAR-7", "array dimensions m; 0 for an elementary variable";
        DIMENSIONS "dimensions" @ 20, Size::Items { each: 4, max: 506 }, Uns32, "VAR-4", "elements in each dimension";
        NAME "name" @ 20 + 4 m, Size::Open { min: 1, max: 256 }, String, "VAR-4", "name of the variable";
    }
    /// Request by a variable's name.
    VariableName, variable_name: "variable-name", "Variable by name, request", "VAR-9", max 256 {
        NAME "name" @ 0, Size::Terminated { max: 256, may_be_absent: false }, String, "VAR-9", "name of the variable";
    }
    /// Handle of a variable.
    VariableHandle, variable_handle: "variable-handle", "Variable handle by name, reply", "VAR-10", max 4 {
        HANDLE "handle" @ 0, FIXED_4, Uns32, "VAR-10", "handle of the variable";
    }
    /// Request of a value by handle.
    VariableHandleRead, variable_handle_read: "variable-handle-read", "Read variable value by handle, request", "VAR-11", max 2048 {
        HANDLE "handle" @ 0, FIXED_4, Uns32, "VAR-11", "handle of the variable";
        INDEX_COUNT "index_count" @ 4, FIXED_4, Uns32, "VAR-11", "indices n that follow; 0 for the whole variable";
        INDICES "indices" @ 8, Size::Items { each: 4, max: 510 }, Uns32, "VAR-11", "index in each dimension, from 0";
    }
    /// Value of a variable.
    VariableValue, variable_value: "variable-value", "Variable value, reply", "VAR-14", max 2048 {
        VALUE "value" @ 0, Size::Rest { min: 0, max: 2048 }, Bytes, "VAR-14", "one element, or all of the array";
    }
    /// Request to write a value by handle.
    VariableHandleWrite, variable_handle_write: "variable-handle-write", "Write variable value by handle, request", "VAR-12", max 2048 {
        HANDLE "handle" @ 0, FIXED_4, Uns32, "VAR-12", "handle of the variable";
        INDEX_COUNT "index_count" @ 4, FIXED_4, Uns32, "VAR-12", "indices n that follow; 0 for the whole variable";
        INDICES "indices" @ 8, Size::Items { each: 4, max: 510 }, Uns32, "VAR-12", "index in each dimension, from 0";
        VALUE "value" @ 8 + 4 m, Size::Rest { min: 0, max: 2040 }, Bytes, "VAR-12", "one element, or all of the array";
    }
    /// Request to write a value by name.
    VariableNameWrite, variable_name_write: "variable-name-write", "Write variable value by name, request", "VAR-13", max 2048 {
        NAME "name" @ 0, Size::Leading { max: 256 }, String, "VAR-13", "name of the variable";
        VALUE "value" @ 1, Size::Rest { min: 0, max: 2047 }, Bytes, "VAR-13", "one element, or all of the array";
    }
    /// Extended description of a variable.
    VariableExtendedDescription, variable_extended_description: "variable-extended-description", "Extended variable description by index, reply", "VAR-15", max 8 {
        SYNCHRONISATION "synchronisation" @ 0, Size::FixedOrNothing(4), Uns32, "VAR-15", "1 NO_SYNC, 2 SYNCHRONIZED";
        VALIDITY "validity" @ 4, FIXED_4, Uns32, "VAR-15", "1 CHANNEL, 2 GLOBAL";
    }
    /// Content of a COM object, or of an element of a class.
    Content, content: "content", "Content of an object or element", "COM-5", max 0x40_0000 {
        CONTENT "content" @ 0, Size::Rest { min: 0, max: 0x40_0000 }, Bytes, "COM-5", "as descriptor or attributes say";
    }
    /// Query of the address of an instance of a class.
    ObjectAddressQuery, object_address_query: "object-address-query", "Object address, request", "SDA-1", max 8 {
        CHANNEL "channel" @ 0, FIXED_4, Uns32, "SDA-5", "channel, or index of a spindle; 0 for the platform";
        AXIS "axis" @ 4, FIXED_4, Uns32, "SDA-5", "axis; 0 for the channel itself";
    }
    /// Address of an instance of a class.
    ObjectAddress, object_address: "object-address", "Object address, reply", "SDA-1", max 8 {
        INDEX_GROUP "index_group" @ 0, FIXED_4, Uns32, "SDA-2", "index group of the content; 0 if there is none";
        INDEX_OFFSET "index_offset" @ 4, FIXED_4, Uns32, "SDA-2", "index offset of the first element";
    }
    /// Number of element types of an instance.
    ElementCount, element_count: "element-count", "Number of element types, reply", "SDA-4", max 4 {
        COUNT "count" @ 0, FIXED_4, Uns32, "SDA-4", "element types behind the first element";
    }
    /// Name, type or unit of an element.
    ElementText, element_text: "element-text", "Name, type or unit of an element, reply", "SDA-6", max 256 {
        TEXT "text" @ 0, Size::Open { min: 0, max: 256 }, String, "SDA-6", "name, type or unit";
    }
    /// Length of an element's content.
    ElementLength, element_length: "element-length", "Length of an element, reply", "SDA-8", max 4 {
        LENGTH "length" @ 0, Size::OneTwoOrFour, Unsigned, "SDA-8", "bytes of the content";
    }
    /// Whether an element may be written.
    ElementWriteFlag, element_write_flag: "element-write-flag", "Write flag of an element, reply", "SDA-9", max 1 {
        FLAG "flag" @ 0, Size::Fixed(1), Boolean, "SDA-9", "TRUE: write access is permitted";
    }
    /// Number of dynamic parameters of a kind.
    DynamicCount, dynamic_count: "dynamic-count", "Number of dynamic parameters, reply", "DYN-1", max 4 {
        COUNT "count" @ 0, FIXED_4, Uns32, "DYN-1", "parameters of the kind; also the largest index";
    }
    /// Request of a dynamic parameter by its index.
    DynamicIndex, dynamic_index: "dynamic-index", "Dynamic parameter by index, request", "DYN-5", max 4 {
        INDEX "index" @ 0, Size::FromOne, Uns32, "DYN-5", "index of the parameter, from 1";
    }
    /// Name of a dynamic parameter.
    DynamicName, dynamic_name: "dynamic-name", "Name of a dynamic parameter, reply", "DYN-2", max 96 {
        NAME "name" @ 0, Size::Open { min: 1, max: 96 }, String, "DYN-2", "name of the parameter";
    }
    /// Request of a dynamic parameter by its name.
    DynamicNameRequest, dynamic_name_request: "dynamic-name-request", "Dynamic parameter by name, request", "DYN-3", max 96 {
        NAME "name" @ 0, Size::MayTerminate { max: 96 }, String, "DYN-3", "name of the parameter";
    }
    /// Value of a dynamic parameter.
    DynamicValue, dynamic_value: "dynamic-value", "Value of a dynamic parameter, reply", "DYN-3", max 8 {
        VALUE "value" @ 0, Size::Fixed(8), Real64, "DYN-3", "value of the parameter";
    }
    /// Description of a variable that was asked for by its name.
    VariableDescriptionByName, variable_description_by_name: "variable-description-by-name", "Variable description by name, reply", "VAR-28", max 2048 {
        HANDLE "handle" @ 0, FIXED_4, Uns32, "VAR-10", "handle of the variable";
        TYPE "type" @ 4, FIXED_4, Uns32, "VAR-5", "1 BOOLEAN … 9 STRING";
        ACCESS "access" @ 8, FIXED_4, Uns32, "VAR-6", "1 READ_ONLY, 2 READ_WRITE";
        SIZE "size" @ 12, FIXED_4, Uns32, "VAR-8", "bytes of the whole variable";
        DIMENSION_COUNT "dimension_count" @ 16, FIXED_4, Uns32, "VAR-7", "array dimensions m; 0 for an elementary variable";
        DIMENSIONS "dimensions" @ 20, Size::Items { each: 4, max: 507 }, Uns32, "VAR-7", "elements in each dimension";
    }
    /// NC text in one write to the stream.
    ProgramStream, program_stream: "program-stream", "Data streaming, request", "STM-2", max 992 {
        DATA "data" @ 0, Size::Rest { min: 1, max: 992 }, Bytes, "STM-4", "whole lines of NC text";
    }
    /// What comes back where nothing does; no stream of its own.
    NoData, no_data: "no-data", "No data", "VAR-17", max 0 {
        NOTHING "nothing" @ 0, Size::Rest { min: 0, max: 0 }, Bytes, "VAR-17", "nothing";
    }
    /// An index group put together from its parts; no stream of its own.
    IndexGroup, index_group: "index-group", "Index group", "ADR-9", max 0 {
        INSTANCE "instance" @ 0, Size::Fixed(4), Uns32, "ADR-9", "channel, platform axis or spindle, 8 bits";
    }
    /// An index offset put together from its parts; no stream of its own.
    IndexOffset, index_offset: "index-offset", "Index offset", "ADR-9", max 0 {
        AXIS "axis" @ 0, Size::Fixed(4), Uns32, "ADR-9", "axis, 16 bits";
        ELEMENT "element" @ 0, Size::Fixed(4), Uns32, "ADR-9", "element, 16 or 12 bits";
    }
    /// An AMS NetId as text; no stream of its own.
    AmsNetId, ams_net_id: "ams-net-id", "AMS NetId as text", "ADS-5", max 0 {
        NUMBERS "numbers" @ 0, Size::Rest { min: 11, max: 23 }, String, "ADS-5", "six numbers with dots between";
        NUMBER "number" @ 0, Size::Rest { min: 1, max: 3 }, String, "ADS-5", "one of them, 0 to 255; the offset counts them";
    }
    /// A variable's name by its parts; no stream of its own.
    VariablePath, variable_path: "variable-path", "Name of a variable", "VAR-20", max 0 {
        KIND "kind" @ 0, Size::Rest { min: 0, max: 255 }, String, "VAR-20", "V.E, V.G, V.A, …";
        PART "part" @ 0, Size::Rest { min: 0, max: 255 }, String, "VAR-20", "name of a structure or variable";
        INDEX "index" @ 0, Size::Rest { min: 0, max: 255 }, String, "VAR-20", "number in brackets";
    }
    /// The variables of the Service Interface; each is the value of a variable, none a stream here.
    Service, service: "service", "Service Interface", "SVC-1", max 0 {
        UUID "uuid" @ 0, Size::Rest { min: 0, max: 128 }, String, "SVC-1", "which service is asked";
        REQUEST "request" @ 0, Size::Rest { min: 0, max: 128 }, String, "SVC-1", "what it is asked";
        REQUEST_STATE "request_state" @ 0, FIXED_4, Uns32, "SVC-2", "not 0: there is a request";
        RESPONSE_STATE "response_state" @ 0, FIXED_4, Uns32, "SVC-5", "not 0: there is a response";
        RESPONSE "response" @ 0, Size::Rest { min: 0, max: 128 }, String, "SVC-1", "what it answered";
    }
    /// The parameters of the cycle SysServiceWait; no stream of its own.
    SysServiceWait, sys_service_wait: "sys-service-wait", "Cycle SysServiceWait", "SVC-8", max 0 {
        KEEP_WAITING "@P1" @ 0, FIXED_4, Uns32, "SVC-8", "response state that means: keep waiting";
        LONGEST "@P2" @ 4, FIXED_4, Uns32, "SVC-8", "longest wait in milliseconds";
        TIMER "@P3" @ 8, FIXED_4, Uns32, "SVC-8", "ID of the timer";
    }
    /// The version of a CNC, as it is printed; no stream of its own.
    CncVersion, cnc_version: "cnc-version", "Version of a CNC", "VAR-19", max 0 {
        MAJOR "major" @ 0, Size::Fixed(2), Uns16, "VAR-19", "first number, behind the V";
        MINOR "minor" @ 2, Size::Fixed(2), Uns16, "VAR-19", "second number";
        BUILD "build" @ 4, Size::Fixed(2), Uns16, "VAR-19", "third number";
        PATCH "patch" @ 6, Size::Fixed(2), Uns16, "VAR-19", "fourth number; 0 if there is none";
    }
    /// A value by its type, which another stream says; no stream of its own.
    TypedValue, typed_value: "typed-value", "Value by its type", "VAR-14", max 0 {
        TYPE "type" @ 0, FIXED_4, Uns32, "VAR-5", "1 BOOLEAN … 9 STRING";
        SIZE "size" @ 0, FIXED_4, Uns32, "VAR-8", "bytes of the whole";
        DIMENSION "dimension" @ 0, FIXED_4, Uns32, "VAR-8", "elements in a dimension";
        INDEX_COUNT "index_count" @ 0, FIXED_4, Uns32, "VAR-11", "indices, one for each dimension";
        INDEX "index" @ 0, FIXED_4, Uns32, "VAR-11", "index in a dimension, from 0";
        COUNT "count" @ 0, FIXED_4, Uns32, "VAR-8", "elements";
        VALUE "value" @ 0, Size::Rest { min: 0, max: 0x40_0000 }, Bytes, "VAR-14", "one element, or all of the array";
    }
    /// A text before it stands in a stream.
    Text, text: "text", "Text in CP1252", "GEN-3", max 0 {
        TEXT "text" @ 0, Size::Rest { min: 0, max: 0xffff_ffff }, String, "GEN-3", "CP1252 without NUL";
    }
}
