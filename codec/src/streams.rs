//! The types of all streams, for code that is the same for each of them.

use crate::layout::Stream;
use crate::stream::Decode;

/// Calls a macro with all streams: for each its name in [`Stream`](crate::layout::Stream), the type that
/// borrows and, if that is another, the type that owns its data, which needs the feature `alloc`.
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
        $then! {
            AmsTcpHeader: $crate::ads::AmsTcpHeader;
            AmsHeader: $crate::ads::AmsHeader;
            ReadRequest: $crate::ads::ReadRequest;
            ReadReply: $crate::ads::ReadReplyRef<'_>, $crate::ads::ReadReply;
            WriteRequest: $crate::ads::WriteRequestRef<'_>, $crate::ads::WriteRequest;
            WriteReply: $crate::ads::WriteReply;
            ReadWriteRequest: $crate::ads::ReadWriteRequestRef<'_>, $crate::ads::ReadWriteRequest;
            ReadWriteReply: $crate::ads::ReadWriteReplyRef<'_>, $crate::ads::ReadWriteReply;
            DeviceInfoReply: $crate::ads::DeviceInfoReply;
            DeviceStateReply: $crate::ads::DeviceStateReply;
            ObjectCount: $crate::ObjectCount;
            ObjectDescriptor: $crate::DescriptorRef<'_>, $crate::Descriptor;
            ObjectDescriptors: $crate::DescriptorsRef<'_>, $crate::Descriptors;
            VariableKind: $crate::VariableKindRef<'_>, $crate::VariableKind;
            VariableCount: $crate::VariableCount;
            VariableIndexKind: $crate::VariableIndexKindRef<'_>, $crate::VariableIndexKind;
            VariableDescription: $crate::DescriptionRef<'_>, $crate::Description;
            VariableName: $crate::VariableNameRef<'_>, $crate::VariableName;
            VariableHandle: $crate::Handle;
            VariableHandleRead: $crate::HandleReadRef<'_>, $crate::HandleRead;
            VariableValue: $crate::ValueRef<'_>, $crate::Value;
            VariableHandleWrite: $crate::HandleWriteRef<'_>, $crate::HandleWrite;
            VariableNameWrite: $crate::NameWriteRef<'_>, $crate::NameWrite;
            VariableExtendedDescription: $crate::ExtendedReply;
            Content: $crate::ContentRef<'_>, $crate::Content;
            ObjectAddressQuery: $crate::sda::ObjectAddressQuery;
            ObjectAddress: $crate::sda::ObjectAddress;
            ElementCount: $crate::sda::ElementCount;
            ElementText: $crate::sda::ElementTextRef<'_>, $crate::sda::ElementText;
            ElementLength: $crate::sda::ElementLength;
            ElementWriteFlag: $crate::sda::ElementWriteFlag;
            DynamicCount: $crate::dynamic::DynamicCount;
            DynamicIndex: $crate::dynamic::DynamicIndex;
            DynamicName: $crate::dynamic::DynamicNameRef<'_>, $crate::dynamic::DynamicName;
            DynamicNameRequest: $crate::dynamic::DynamicNameRequestRef<'_>, $crate::dynamic::DynamicNameRequest;
            DynamicValue: $crate::dynamic::DynamicValue;
            VariableDescriptionByName: $crate::DescriptionByNameRef<'_>, $crate::DescriptionByName;
            ProgramStream: $crate::streaming::ProgramStreamRef<'_>, $crate::streaming::ProgramStream;
        }
    };
}

/// Each type reads the stream that it is listed for.
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
