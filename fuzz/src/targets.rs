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
        "for headers, requests and replies, the borrowed reading, the owned reading and the walk \
         by the field table agree, errors included; bytes that they accept encode to the same \
         bytes, to as many as announced, and into no smaller buffer";
    COM_BYTES: "com_bytes", |data, defect| bytes::check(bytes::COM, data, defect), bytes::DEFECTS,
        "the same for object counts, descriptors and contents";
    VARIABLE_BYTES: "variable_bytes", |data, defect| bytes::check(bytes::VARIABLE, data, defect),
        bytes::VARIABLE_DEFECTS,
        "the same for kinds, names, descriptions, handles and values of variables; values of up to \
         128 bytes are also read as any type, in one dimension and in two";
    SDA_BYTES: "sda_bytes", |data, defect| bytes::check(bytes::SDA, data, defect), bytes::DEFECTS,
        "the same for object addresses and attributes of elements";
    DYNAMIC_BYTES: "dynamic_bytes", |data, defect| bytes::check(bytes::DYNAMIC, data, defect),
        bytes::DEFECTS,
        "the same for dynamic parameters";
    STREAMING_BYTES: "streaming_bytes",
        |data, defect| bytes::check(bytes::STREAMING, data, defect), bytes::STREAMING_DEFECTS,
        "the same for data streaming";
    #[cfg(feature = "arbitrary")]
    ADS_VALUE: "ads_value", |data, defect| values::check(bytes::ADS, data, defect), values::DEFECTS,
        "any value of these streams encodes to as many bytes as announced, and into no smaller \
         buffer, and every reading of these bytes gives the value";
    #[cfg(feature = "arbitrary")]
    COM_VALUE: "com_value", |data, defect| values::check(bytes::COM, data, defect), values::DEFECTS,
        "the same";
    #[cfg(feature = "arbitrary")]
    VARIABLE_VALUE: "variable_value", |data, defect| values::check(bytes::VARIABLE, data, defect),
        values::DEFECTS,
        "the same";
    #[cfg(feature = "arbitrary")]
    SDA_VALUE: "sda_value", |data, defect| values::check(bytes::SDA, data, defect), values::DEFECTS,
        "the same";
    #[cfg(feature = "arbitrary")]
    DYNAMIC_VALUE: "dynamic_value", |data, defect| values::check(bytes::DYNAMIC, data, defect),
        values::DEFECTS,
        "the same";
    #[cfg(feature = "arbitrary")]
    STREAMING_VALUE: "streaming_value",
        |data, defect| values::check(bytes::STREAMING, data, defect), values::DEFECTS,
        "the same";
    OPERATION_DISPATCH: "operation_dispatch", operation::dispatch, operation::DISPATCH_DEFECTS,
        "a server's dispatch of any service, index group, index offset and data never panics; an \
         accepted request encodes to a call with the same service, address and data, and into no \
         smaller buffer, and this call is dispatched to the same request";
    OPERATION_REQUEST: "operation_request", operation::request, operation::REQUEST_DEFECTS,
        "an operation of any function with any parameters is encoded to a call that a server \
         dispatches to that operation, or is rejected; within the documented ranges it is rejected \
         only if another function has its address";
    OPERATION_REPLY: "operation_reply", operation::reply, operation::REPLY_DEFECTS,
        "a request accepts as a reply what the stream of its function accepts, but no more than it \
         has room for, and encodes the reply to the same bytes, and into no smaller buffer";
    ADS_FRAMES: "ads_frames", frames::frames, frames::DEFECTS,
        "a stream of AMS frames, whole or damaged, that is split anywhere gives the same frames \
         one by one as the unsplit stream, and then the same fault or rest; each frame and fault \
         is found with its last byte, and more bytes do not change it";
    STREAMING_PACKETS: "streaming_packets", streaming::packets, streaming::PACKETS_DEFECTS,
        "for any bytes, the first fault is found, or the packets together are the text with CR LF \
         after each line, and each packet is legal and as full as possible";
    #[cfg(feature = "tools")]
    STREAMING_SENDER: "streaming_sender", ends::check, ends::DEFECTS,
        "whatever is acknowledged, repeated, read and reset, a sender loses nothing, repeats \
         nothing and counts correctly, the interface is a bounded queue, and its output is the \
         text";
    #[cfg(feature = "alloc")]
    STREAMING_CHECKER: "streaming_checker", checker::lots, checker::DEFECTS,
        "if the lines of a program come in any lots, the findings in each lot are those that the \
         whole program has there, in the order of the text, whatever the line ends; any bytes can \
         be checked";
    #[cfg(feature = "tools")]
    SERVICE_HOST: "service_host", service::world, service::WORLD_DEFECTS,
        "for a program, one host or two, and the Service Interface, in any order of steps and \
         whatever fails, each request is served once and gets its own answer, after chaos too; \
         with two hosts, a failed write of RESPONSE_STATE is assumed not to have arrived";
    #[cfg(feature = "tools")]
    SERVICE_MACHINES: "service_machines", service::machines, service::MACHINES_DEFECTS,
        "whatever a host, a program's request and the five variables are told, no request is \
         served that was not found twice, writes keep their order, and errors change nothing, \
         except that a host may wait";
    TEXT_CP1252: "text_cp1252", text::cp1252, text::DEFECTS,
        "text of any bytes and of any characters is converted as encoding_rs converts it, faults \
         included, and comes back in both directions";
    VARIABLE_PATH: "variable_path", names::path, names::DEFECTS,
        "a name has the parts that splitting the string finds, from CP1252 and from UTF-8, is put \
         together again, and is rejected where it is wrong";
    VARIABLE_TYPED: "variable_typed", shapes::typed, shapes::DEFECTS,
        "type, dimensions and size are accepted as a shape if they agree; an element is where \
         nested arrays have it, and a value that was read is written back unchanged";
    #[cfg(feature = "tools")]
    TOOLS_EXPLAIN: "tools_explain", tools::explain::check, tools::explain::DEFECTS,
        "any bytes are explained without a panic: all of them are shown, none twice if nothing is \
         wrong; a stream has a fault if and only if the codec rejects it; the output has nothing \
         that a terminal would execute; hex is read as the bytes that it states";
    #[cfg(feature = "tools")]
    TOOLS_CAPTURE: "tools_capture", tools::capture::check, tools::capture::DEFECTS,
        "any file is read as a capture to its end, or is reported as cut; from segments in any \
         order, repeated or split otherwise, the bytes that were sent are reassembled, and missing \
         bytes are reported";
    #[cfg(feature = "tools")]
    TOOLS_TESTEE: "tools_testee", tools::testee::check, tools::testee::DEFECTS,
        "all output of a testee is lines of a bounded length, and each line is one answer to the \
         case that was sent, or none";
    #[cfg(feature = "tools")]
    TOOLS_WAIVER: "tools_waiver", tools::toml::waiver, tools::toml::WAIVER_DEFECTS,
        "any file is a list of waivers or an error with its line, wherever in the file it is";
    #[cfg(feature = "tools")]
    TOOLS_PROFILE: "tools_profile", tools::toml::profile, tools::toml::PROFILE_DEFECTS,
        "any file is a profile or an error with its line; a profile that is printed is read as the \
         same profile, and claims nothing at a port that does not answer";
    #[cfg(feature = "tools")]
    TOOLS_ALLOW: "tools_allow", tools::toml::allow, tools::toml::ALLOW_DEFECTS,
        "any file is a list of permissions or an error with its line; its entries are read as they \
         are printed";
    #[cfg(feature = "tools")]
    TOOLS_MODEL: "tools_model", tools::model::check, tools::model::DEFECTS,
        "any file is a model or an error with its line; a CNC of this model gives answers that the \
         codec reads, and the same answers to the same requests";
    #[cfg(feature = "tools")]
    TOOLS_GATE: "tools_gate", tools::gate::check, tools::gate::DEFECTS,
        "the gate passes a request that is not a query only if the file names it for this target \
         and time, and never one of those that are never sent; it passes queries whatever else is \
         allowed";
    #[cfg(feature = "tools")]
    CNC_SESSION: "cnc_session", tools::session::check, tools::session::DEFECTS,
        "each valid frame on a connection, whatever its bytes, is answered once, with the frame's \
         invoke ID and data that the codec reads, in bounded buffers; a rejected write changes \
         nothing, and the value of any other write is read back";
}
