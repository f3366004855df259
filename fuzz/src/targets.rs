//! Every target.

#[cfg(feature = "arbitrary")]
use crate::bodies::values;
use crate::bodies::{bytes, operation};
use crate::{Defect, Outcome};

/// A target: named `<family>_<law>`, as its binary and its corpus are.
pub struct Target {
    /// Its name.
    pub name: &'static str,
    /// What holds for any input.
    pub proves: &'static str,
    /// What its seeded defects get wrong, the first being number 1.
    pub defects: &'static [&'static str],
    body: fn(&[u8], Defect) -> Outcome,
}

impl Target {
    /// The part of its name before the underscore: targets of a family share a dictionary.
    pub fn family(&self) -> &'static str {
        self.name.split('_').next().unwrap_or(self.name)
    }

    /// Runs the body.
    ///
    /// # Panics
    /// If a law is broken, be it by a defect.
    pub fn run(&self, data: &[u8], defect: Defect) -> Outcome {
        (self.body)(data, defect)
    }

    /// Runs the body for a fuzzer, with the defect that the environment names.
    ///
    /// # Panics
    /// If a law is broken.
    pub fn fuzz(&self, data: &[u8]) {
        self.run(data, Defect::from_environment());
    }
}

macro_rules! targets {
    ($(
        $(#[$cfg:meta])*
        $target:ident: $name:literal, $body:expr, $defects:expr, $proves:literal;
    )+) => {
        $(
            #[doc = $proves]
            $(#[$cfg])*
            pub static $target: Target =
                Target { name: $name, proves: $proves, defects: $defects, body: $body };
        )+

        /// All of them.
        pub static TARGETS: &[&Target] = &[$( $(#[$cfg])* &$target, )+];
    };
}

targets! {
    ADS_BYTES: "ads_bytes", |data, defect| bytes::check(bytes::ADS, data, defect), bytes::DEFECTS,
        "headers, requests and replies: borrowed reading, owned reading and walk by the field table \
         agree, errors included; what they accept encodes to the same bytes, as many as announced";
    COM_BYTES: "com_bytes", |data, defect| bytes::check(bytes::COM, data, defect), bytes::DEFECTS,
        "object counts, descriptors, contents: the same";
    VARIABLE_BYTES: "variable_bytes", |data, defect| bytes::check(bytes::VARIABLE, data, defect),
        bytes::DEFECTS, "kinds, names, descriptions, handles and values of variables: the same; \
         values also as any type, with one dimension";
    SDA_BYTES: "sda_bytes", |data, defect| bytes::check(bytes::SDA, data, defect), bytes::DEFECTS,
        "object addresses, attributes of elements: the same";
    DYNAMIC_BYTES: "dynamic_bytes", |data, defect| bytes::check(bytes::DYNAMIC, data, defect),
        bytes::DEFECTS, "dynamic parameters: the same";
    STREAMING_BYTES: "streaming_bytes",
        |data, defect| bytes::check(bytes::STREAMING, data, defect), bytes::DEFECTS,
        "data streaming: the same";
    #[cfg(feature = "arbitrary")]
    ADS_VALUE: "ads_value", |data, defect| values::check(bytes::ADS, data, defect), values::DEFECTS,
        "any value of these streams encodes to as many bytes as announced, into no smaller buffer, \
         and every reading reads it back from them";
    #[cfg(feature = "arbitrary")]
    COM_VALUE: "com_value", |data, defect| values::check(bytes::COM, data, defect), values::DEFECTS,
        "the same";
    #[cfg(feature = "arbitrary")]
    VARIABLE_VALUE: "variable_value", |data, defect| values::check(bytes::VARIABLE, data, defect),
        values::DEFECTS, "the same";
    #[cfg(feature = "arbitrary")]
    SDA_VALUE: "sda_value", |data, defect| values::check(bytes::SDA, data, defect), values::DEFECTS,
        "the same";
    #[cfg(feature = "arbitrary")]
    DYNAMIC_VALUE: "dynamic_value", |data, defect| values::check(bytes::DYNAMIC, data, defect),
        values::DEFECTS, "the same";
    #[cfg(feature = "arbitrary")]
    STREAMING_VALUE: "streaming_value",
        |data, defect| values::check(bytes::STREAMING, data, defect), values::DEFECTS, "the same";
    OPERATION_DISPATCH: "operation_dispatch", operation::dispatch, operation::DISPATCH_DEFECTS,
        "a server's dispatch of any service, index group, index offset and data never panics; what \
         it takes encodes to the same call and is dispatched to the same request";
}
