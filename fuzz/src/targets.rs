//! The table of all targets.

#[cfg(feature = "alloc")]
use crate::bodies::checker;
#[cfg(feature = "arbitrary")]
use crate::bodies::values;
use crate::bodies::{bytes, frames, names, operation, shapes, streaming, text};
#[cfg(feature = "tools")]
use crate::bodies::{ends, service, tools};
use crate::{Defect, Outcome};

/// A target. Its name is `<family>_<law>`, which is also the name of its binary and its corpus.
pub struct Target {
    /// The name of the target.
    pub name: &'static str,
    /// The law that holds for any input.
    pub proves: &'static str,
    /// A description of each seeded defect; the first is number 1.
    pub defects: &'static [&'static str],
    body: fn(&[u8], Defect) -> Outcome,
}

impl Target {
    /// The family: the part of the name before the first underscore. The targets of a family share a
    /// dictionary.
    pub fn family(&self) -> &'static str {
        self.name.split('_').next().unwrap_or(self.name)
    }

    /// Runs the body on an input, with a seeded defect or [`Defect::NONE`].
    ///
    /// # Panics
    /// If the input breaks a law, whether or not a defect causes it.
    pub fn run(&self, data: &[u8], defect: Defect) -> Outcome {
        if data.len() > 8 {
            defect.panic_or_hang();
        }
        (self.body)(data, defect)
    }

    /// Runs the body for a fuzzer, with the defect of [`Defect::from_environment`].
    ///
    /// # Panics
    /// If the input breaks a law.
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

        /// All targets that the features of this build include.
        pub static TARGETS: &[&Target] = &[$( $(#[$cfg])* &$target, )+];
    };
}

targets! {
    ADS_BYTES: "ads_bytes", |data, defect| bytes::check(bytes::ADS, data, defect), bytes::DEFECTS,
        "For headers, requests and replies, the borrowed reading, the owned reading and the walk \
         by the field table have the same result or the same error. Bytes that they accept encode \
         to the same bytes. The encoder writes as many bytes as it announced, and rejects a \
         smaller buffer";
    COM_BYTES: "com_bytes", |data, defect| bytes::check(bytes::COM, data, defect), bytes::DEFECTS,
        "The law of ads_bytes for object counts, descriptors and contents";
    VARIABLE_BYTES: "variable_bytes", |data, defect| bytes::check(bytes::VARIABLE, data, defect),
        bytes::VARIABLE_DEFECTS,
        "The law of ads_bytes for kinds, names, descriptions, handles and values of variables. \
         Values of up to 128 bytes are also read as each type, in one dimension and in two";
    SDA_BYTES: "sda_bytes", |data, defect| bytes::check(bytes::SDA, data, defect), bytes::DEFECTS,
        "The law of ads_bytes for object addresses and attributes of elements";
    DYNAMIC_BYTES: "dynamic_bytes", |data, defect| bytes::check(bytes::DYNAMIC, data, defect),
        bytes::DEFECTS,
        "The law of ads_bytes for dynamic parameters";
    STREAMING_BYTES: "streaming_bytes",
        |data, defect| bytes::check(bytes::STREAMING, data, defect), bytes::STREAMING_DEFECTS,
        "The law of ads_bytes for data streaming";
    #[cfg(feature = "arbitrary")]
    ADS_VALUE: "ads_value", |data, defect| values::check(bytes::ADS, data, defect), values::DEFECTS,
        "Every value of these streams encodes to as many bytes as announced, the encoder rejects \
         a smaller buffer, and every reading of the bytes gives the value";
    #[cfg(feature = "arbitrary")]
    COM_VALUE: "com_value", |data, defect| values::check(bytes::COM, data, defect), values::DEFECTS,
        "The law of ads_value for object counts, descriptors and contents";
    #[cfg(feature = "arbitrary")]
    VARIABLE_VALUE: "variable_value", |data, defect| values::check(bytes::VARIABLE, data, defect),
        values::DEFECTS,
        "The law of ads_value for kinds, names, descriptions, handles and values of variables";
    #[cfg(feature = "arbitrary")]
    SDA_VALUE: "sda_value", |data, defect| values::check(bytes::SDA, data, defect), values::DEFECTS,
        "The law of ads_value for object addresses and attributes of elements";
    #[cfg(feature = "arbitrary")]
    DYNAMIC_VALUE: "dynamic_value", |data, defect| values::check(bytes::DYNAMIC, data, defect),
        values::DEFECTS,
        "The law of ads_value for dynamic parameters";
    #[cfg(feature = "arbitrary")]
    STREAMING_VALUE: "streaming_value",
        |data, defect| values::check(bytes::STREAMING, data, defect), values::DEFECTS,
        "The law of ads_value for data streaming";
    OPERATION_DISPATCH: "operation_dispatch", operation::dispatch, operation::DISPATCH_DEFECTS,
        "The dispatch of any service, index group, index offset and data does not panic. A \
         dispatched request encodes to a call with the same service, address and data, and this \
         call dispatches to the same request. The encoder rejects a smaller buffer";
    OPERATION_REQUEST: "operation_request", operation::request, operation::REQUEST_DEFECTS,
        "An operation of any function with any parameters either encodes to a call that \
         dispatches to the same operation, or is rejected. Within the documented ranges, it is \
         rejected only if another function has the same address";
    OPERATION_REPLY: "operation_reply", operation::reply, operation::REPLY_DEFECTS,
        "A request accepts the replies that the stream of its function accepts, up to its read \
         length, and encodes them to the same bytes. The encoder rejects a smaller buffer";
    ADS_FRAMES: "ads_frames", frames::frames, frames::DEFECTS,
        "A sequence of AMS frames, intact or damaged, gives the same frames and the same error or \
         rest when it is received in pieces of any size. Each frame and each error is found with \
         its last byte, and later bytes do not change it";
    STREAMING_PACKETS: "streaming_packets", streaming::packets, streaming::PACKETS_DEFECTS,
        "For any program text, either the first error is found, or the packets together are the \
         text with CR LF after each line, and each packet is valid and as full as possible";
    #[cfg(feature = "tools")]
    STREAMING_SENDER: "streaming_sender", ends::check, ends::DEFECTS,
        "With any acknowledgements and any repeated calls for the packet, a sender offers each \
         packet unchanged until it is accepted, offers none after a permanent rejection, and \
         counts the accepted packets, lines and bytes. The streaming interface is a bounded \
         queue; its output is the text that the sender counts as accepted, unless the interface \
         is reset, another client writes, or a packet is acknowledged without being written";
    #[cfg(feature = "alloc")]
    STREAMING_CHECKER: "streaming_checker", checker::lots, checker::DEFECTS,
        "If the lines of a program are checked in several parts, each part has the findings that \
         the whole program has in the same lines, in the order of the text, with any line ends. \
         Any bytes can be checked";
    #[cfg(feature = "tools")]
    SERVICE_HOST: "service_host", service::world, service::WORLD_DEFECTS,
        "For a program, one or two hosts and the Service Interface, in any order of steps and \
         with any failures, each request is served once and gets its own answer. With two hosts, \
         a failed write of RESPONSE_STATE is assumed not to have arrived";
    #[cfg(feature = "tools")]
    SERVICE_MACHINES: "service_machines", service::machines, service::MACHINES_DEFECTS,
        "With any values of the five variables, a host and the request of a program read each \
         request twice before it is served, write in the documented order, and do not change \
         their state after an error, except that a host may wait";
    TEXT_CP1252: "text_cp1252", text::cp1252, text::DEFECTS,
        "Text of any bytes and any characters is converted in both directions as encoding_rs \
         converts it, including errors";
    VARIABLE_PATH: "variable_path", names::path, names::DEFECTS,
        "A name in CP1252 or UTF-8 has the parts that splitting the string at its separators \
         gives, and is built from these parts again. A malformed name is rejected at its first \
         error";
    VARIABLE_TYPED: "variable_typed", shapes::typed, shapes::DEFECTS,
        "A type, dimensions and a size form a shape exactly if they agree. An element has the \
         offset that it has in nested arrays, and a value that was read encodes to the same bytes";
    #[cfg(feature = "tools")]
    TOOLS_EXPLAIN: "tools_explain", tools::explain::check, tools::explain::DEFECTS,
        "Any bytes are explained without a panic. The explanation shows all bytes, and shows none \
         twice if no error was found. A stream has an error if and only if the codec rejects it. \
         The output contains no control characters of a terminal. Hex is read as the bytes that \
         it denotes";
    #[cfg(feature = "tools")]
    TOOLS_CAPTURE: "tools_capture", tools::capture::check, tools::capture::DEFECTS,
        "Any file is read as a capture to its end, or is reported as truncated. Segments in any \
         order, repeated or overlapping, are reassembled to the sent bytes, and missing bytes are \
         reported";
    #[cfg(feature = "tools")]
    TOOLS_TESTEE: "tools_testee", tools::testee::check, tools::testee::DEFECTS,
        "The output of a testee is split into lines of a bounded length. Each line is one answer \
         to the case that was sent, or is rejected";
    #[cfg(feature = "tools")]
    TOOLS_WAIVER: "tools_waiver", tools::toml::waiver, tools::toml::WAIVER_DEFECTS,
        "Any file is a list of waivers, or an error with the line of its cause";
    #[cfg(feature = "tools")]
    TOOLS_PROFILE: "tools_profile", tools::toml::profile, tools::toml::PROFILE_DEFECTS,
        "Any file is a profile, or an error with the line of its cause. A printed profile is read \
         as the same profile, and claims nothing at a port that does not answer";
    #[cfg(feature = "tools")]
    TOOLS_ALLOW: "tools_allow", tools::toml::allow, tools::toml::ALLOW_DEFECTS,
        "Any file is a list of permissions, or an error with the line of its cause. Entries are \
         read as they are printed";
    #[cfg(feature = "tools")]
    TOOLS_MODEL: "tools_model", tools::model::check, tools::model::DEFECTS,
        "Any file is a model, or an error with the line of its cause. A CNC of this model sends \
         replies that the codec reads, and the same replies to the same requests";
    #[cfg(feature = "tools")]
    TOOLS_GATE: "tools_gate", tools::gate::check, tools::gate::DEFECTS,
        "The gate always passes queries. It passes any other request only if the file names it for \
         this target and time, and never one of the requests that are never sent";
    #[cfg(feature = "tools")]
    CNC_SESSION: "cnc_session", tools::session::check, tools::session::DEFECTS,
        "Each valid frame on a connection, with any data, is answered once, with the frame's \
         invoke ID and with data that the codec reads, and in bounded buffers. A rejected write \
         changes no value, and the value of any other write is read back";
}
