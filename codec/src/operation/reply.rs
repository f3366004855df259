//! The replies of the functions.

use crate::com::{DescriptorsRef, ObjectCount};
use crate::content::ContentRef;
use crate::dynamic::{DynamicCount, DynamicNameRef, DynamicValue};
use crate::error::Error;
use crate::sda::{ElementCount, ElementLength, ElementTextRef, ElementWriteFlag, ObjectAddress};
use crate::stream::{Encode, NoData};
use crate::variable::{
    DescriptionByNameRef, DescriptionRef, ExtendedReply, Handle, ValueRef, VariableCount,
};

/// Declares [`Reply`], with the encoding and the conversion for each variant.
macro_rules! replies {
    (
        $(#[$doc:meta])*
        enum Reply { $( $(#[$variant_doc:meta])* $variant:ident($reply:ty), )+ }
    ) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[non_exhaustive]
        pub enum Reply<'a> { $( $(#[$variant_doc])* $variant($reply), )+ }

        impl Encode for Reply<'_> {
            fn encoded_len(&self) -> usize {
                match self { $( Self::$variant(reply) => reply.encoded_len(), )+ }
            }

            fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Error> {
                match self { $( Self::$variant(reply) => reply.encode(buf), )+ }
            }
        }

        $(
            impl<'a> From<$reply> for Reply<'a> {
                fn from(reply: $reply) -> Self {
                    Self::$variant(reply)
                }
            }
        )+
    };
}

replies! {
    /// The reply of any function, for servers that send it and tools that show it.
    ///
    /// ```
    /// use ads_cnc::operation::Reply;
    /// use ads_cnc::{Encode, Handle};
    ///
    /// let mut buf = [0; 4];
    /// assert_eq!(Reply::from(Handle(0x2000004)).encode(&mut buf)?, [4, 0, 0, 2]);
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    enum Reply {
        /// Number of objects.
        ObjectCount(ObjectCount),
        /// Object descriptors.
        Descriptors(DescriptorsRef<'a>),
        /// Number of variables.
        VariableCount(VariableCount),
        /// Description of a variable.
        Description(DescriptionRef<'a>),
        /// Description of a variable, without its name.
        DescriptionByName(DescriptionByNameRef<'a>),
        /// Handle of a variable.
        Handle(Handle),
        /// Value of a variable.
        Value(ValueRef<'a>),
        /// Extended description of a variable, which may be empty.
        Extended(ExtendedReply),
        /// Number of dynamic parameters.
        DynamicCount(DynamicCount),
        /// Name of a dynamic parameter.
        DynamicName(DynamicNameRef<'a>),
        /// Value of a dynamic parameter.
        DynamicValue(DynamicValue),
        /// Address of an instance, or [`ObjectAddress::NONE`].
        ObjectAddress(ObjectAddress),
        /// Number of element types.
        ElementCount(ElementCount),
        /// Name, type or unit of an element.
        ElementText(ElementTextRef<'a>),
        /// Length of an element's content.
        ElementLength(ElementLength),
        /// Whether an element may be written.
        ElementWriteFlag(ElementWriteFlag),
        /// Content of an object or element.
        Content(ContentRef<'a>),
        /// The reply to a write, which has no data.
        NoData(NoData),
    }
}
