//! The subject of an error: a stream, or something else, such as an index group, a name or a value.

use super::Stream;
use super::field::Field;

/// Declares [`Subject`] and a constant for each part of each subject other than a stream.
macro_rules! subjects {
    ($(
        $(#[$doc:meta])*
        $subject:ident $name:literal, $module:ident { $( $part:ident $part_name:literal, )+ }
    )+) => {
        /// The subject of an [`Error`](crate::Error): a stream, or something else, such as an index
        /// group, a name or a value.
        ///
        /// ```
        /// use ads_cnc::address::Channel;
        /// use ads_cnc::layout::{Stream, Subject};
        /// use ads_cnc::{Decode, Handle};
        ///
        /// let subject = |error: ads_cnc::Error| error.field().subject();
        /// let stream = Subject::Stream(Stream::VariableHandle);
        /// assert_eq!(Handle::decode(&[]).map_err(subject), Err(stream));
        /// assert_eq!(Channel::new(0).map_err(subject), Err(Subject::IndexGroup));
        /// assert_eq!(Subject::IndexGroup.name(), "index-group");
        /// ```
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        #[non_exhaustive]
        pub enum Subject {
            /// A stream.
            Stream(Stream),
            $( $(#[$doc])* $subject, )+
        }

        impl Subject {
            /// The name of the subject in errors and reports.
            pub const fn name(self) -> &'static str {
                match self {
                    Self::Stream(stream) => stream.layout().name,
                    $( Self::$subject => $name, )+
                }
            }

            /// The name of the part of the subject with this index; for a stream, the name of the field.
            pub(super) fn part(self, index: u8) -> Option<&'static str> {
                let index = usize::from(index);
                let parts: &[&str] = match self {
                    Self::Stream(stream) => {
                        return stream.layout().fields.get(index).map(|row| row.name);
                    }
                    $( Self::$subject => &[$( $part_name ),+], )+
                };
                parts.get(index).copied()
            }
        }

        $(
            pub(crate) mod $module {
                use super::{Field, Subject};

                #[allow(non_camel_case_types, clippy::upper_case_acronyms)]
                enum Index { $( $part, )+ }
                $(
                    #[allow(clippy::as_conversions, reason = "a discriminant, no input")]
                    pub(crate) const $part: Field =
                        Field::new(Subject::$subject, Index::$part as u8);
                )+
            }
        )+
    };
}

subjects! {
    /// An index group that is built from its parts or passed to a constructor.
    IndexGroup "index-group", index_group {
        INSTANCE "instance",
        CHANNEL "instance",
        PLATFORM_AXIS "instance",
        SPINDLE "instance",
    }
    /// An index offset that is built from its parts, divided into them or passed to a constructor.
    IndexOffset "index-offset", index_offset {
        AXIS "axis",
        CHANNEL_AXIS "axis",
        ELEMENT "element",
        OBJECT "element",
    }
    /// The text of an AMS NetId.
    AmsNetId "ams-net-id", ams_net_id {
        NUMBERS "numbers",
        NUMBER "number",
    }
    /// The name of a variable, parsed into its parts or built from them.
    VariablePath "variable-path", variable_path {
        KIND "kind",
        PART "part",
        INDEX "index",
    }
    /// The variables of the Service Interface.
    Service "service", service {
        UUID "uuid",
        REQUEST "request",
        REQUEST_STATE "request_state",
        RESPONSE_STATE "response_state",
        RESPONSE "response",
    }
    /// A value whose type is not in its bytes but, for example, in a description.
    TypedValue "typed-value", typed_value {
        TYPE "type",
        SIZE "size",
        DIMENSION "dimension",
        INDEX_COUNT "index_count",
        INDEX "index",
        COUNT "count",
        VALUE "value",
        NUMBER "number",
        NEGATIVE "number",
    }
    /// A text that must be CP1252 without a NUL.
    Text "text", text {
        TEXT "text",
    }
}
