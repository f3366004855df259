//! The types of all streams except `NoData`, for code that treats all streams alike.

use crate::layout::Stream;
use crate::stream::Decode;

/// Calls a macro with all streams except [`NoData`](crate::NoData): for each stream, its name in
/// [`Stream`](crate::layout::Stream), its type and, if this type borrows its data, a second type
/// that owns its data. The second types need the feature `alloc`, except
/// [`Descriptor`](crate::Descriptor).
///
/// ```
/// use ads_cnc::layout::Stream;
/// use ads_cnc::{Decode, Error};
///
/// macro_rules! decoders {
///     ($( $stream:ident: $view:ty $( , $owned:ty )?; )+) => {
///         fn check(stream: Stream, bytes: &[u8]) -> Result<(), Error> {
///             match stream {
///                 $( Stream::$stream => <$view>::decode(bytes).map(drop), )+
///                 _ => unreachable!("not a stream"),
///             }
///         }
///     };
/// }
/// ads_cnc::streams! { decoders }
///
/// assert!(check(Stream::VariableHandle, &[4, 0, 0, 2]).is_ok());
/// ```
#[macro_export]
macro_rules! streams {
    ($then:ident) => {
        $crate::streams! { @each [$crate::streams] [@undocumented $then] }
    };
    (@undocumented $then:ident $( $(#[$doc:meta])* $stream:ident: $view:ty $( , $owned:ty )?; )+) => {
        $then! { $( $stream: $view $( , $owned )?; )+ }
    };
    (@documented $then:ident) => {
        $crate::streams! { @each [$then] [] }
    };
    (@each [$($then:tt)+] [$($first:tt)*]) => {
        $($then)+! { $($first)*
            /// AMS/TCP header.
            AmsTcpHeader: $crate::ads::AmsTcpHeader;
            /// AMS header.
            AmsHeader: $crate::ads::AmsHeader;
            /// ADS Read, request.
            ReadRequest: $crate::ads::ReadRequest;
            /// ADS Read, reply.
            ReadReply: $crate::ads::ReadReplyRef<'_>, $crate::ads::ReadReply;
            /// ADS Write, request.
            WriteRequest: $crate::ads::WriteRequestRef<'_>, $crate::ads::WriteRequest;
            /// ADS Write, reply.
            WriteReply: $crate::ads::WriteReply;
            /// ADS ReadWrite, request.
            ReadWriteRequest: $crate::ads::ReadWriteRequestRef<'_>, $crate::ads::ReadWriteRequest;
            /// ADS ReadWrite, reply.
            ReadWriteReply: $crate::ads::ReadWriteReplyRef<'_>, $crate::ads::ReadWriteReply;
            /// ADS ReadDeviceInfo, reply.
            DeviceInfoReply: $crate::ads::DeviceInfoReply;
            /// ADS ReadState, reply.
            DeviceStateReply: $crate::ads::DeviceStateReply;
            /// Number of objects of a COM list.
            ObjectCount: $crate::ObjectCount;
            /// One object descriptor.
            ObjectDescriptor: $crate::DescriptorRef<'_>, $crate::Descriptor;
            /// Object descriptors in sequence.
            ObjectDescriptors: $crate::DescriptorsRef<'_>, $crate::Descriptors;
            /// Request for the number of variables.
            VariableKind: $crate::VariableKindRef<'_>, $crate::VariableKind;
            /// Number of variables.
            VariableCount: $crate::VariableCount;
            /// Request for a description or an extended description, by index.
            VariableIndexKind: $crate::VariableIndexKindRef<'_>, $crate::VariableIndexKind;
            /// Description of a variable.
            VariableDescription: $crate::DescriptionRef<'_>, $crate::Description;
            /// Request that contains only the name of a variable.
            VariableName: $crate::VariableNameRef<'_>, $crate::VariableName;
            /// Handle of a variable.
            VariableHandle: $crate::Handle;
            /// Request for a value by handle.
            VariableHandleRead: $crate::HandleReadRef<'_>, $crate::HandleRead;
            /// Value of a variable.
            VariableValue: $crate::ValueRef<'_>, $crate::Value;
            /// Request to write a value by handle.
            VariableHandleWrite: $crate::HandleWriteRef<'_>, $crate::HandleWrite;
            /// Request to write a value by name.
            VariableNameWrite: $crate::NameWriteRef<'_>, $crate::NameWrite;
            /// Extended description of a variable.
            VariableExtendedDescription: $crate::ExtendedReply;
            /// Content of a COM object, or of an element of a class.
            Content: $crate::ContentRef<'_>, $crate::Content;
            /// Query of the address of an instance of a class.
            ObjectAddressQuery: $crate::sda::ObjectAddressQuery;
            /// Address of an instance of a class.
            ObjectAddress: $crate::sda::ObjectAddress;
            /// Number of element types of an instance.
            ElementCount: $crate::sda::ElementCount;
            /// Name, type or unit of an element.
            ElementText: $crate::sda::ElementTextRef<'_>, $crate::sda::ElementText;
            /// Length of an element's content.
            ElementLength: $crate::sda::ElementLength;
            /// Whether an element may be written.
            ElementWriteFlag: $crate::sda::ElementWriteFlag;
            /// Number of dynamic parameters of a kind.
            DynamicCount: $crate::dynamic::DynamicCount;
            /// Request for a dynamic parameter by its index.
            DynamicIndex: $crate::dynamic::DynamicIndex;
            /// Name of a dynamic parameter.
            DynamicName: $crate::dynamic::DynamicNameRef<'_>, $crate::dynamic::DynamicName;
            /// Request for a dynamic parameter by its name.
            DynamicNameRequest: $crate::dynamic::DynamicNameRequestRef<'_>, $crate::dynamic::DynamicNameRequest;
            /// Value of a dynamic parameter.
            DynamicValue: $crate::dynamic::DynamicValue;
            /// Description of a variable, requested by its name.
            VariableDescriptionByName: $crate::DescriptionByNameRef<'_>, $crate::DescriptionByName;
            /// NC text in one write to the program stream.
            ProgramStream: $crate::streaming::ProgramStreamRef<'_>, $crate::streaming::ProgramStream;
        }
    };
}

/// Checks that each type decodes the stream that it is listed for.
macro_rules! checked {
    ($( $stream:ident: $view:ty $( , $owned:ty )?; )+) => { $(
        const _: () = assert!(matches!(<$view as Decode<'_>>::STREAM, Stream::$stream));
        $(
            #[cfg(feature = "alloc")]
            const _: () = assert!(matches!(<$owned as Decode<'_>>::STREAM, Stream::$stream));
        )?
    )+ };
}

streams! { checked }
