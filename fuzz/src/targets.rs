//! Every target.

#[cfg(feature = "alloc")]
use crate::bodies::checker;
#[cfg(feature = "arbitrary")]
use crate::bodies::values;
use crate::bodies::{bytes, frames, names, operation, shapes, streaming, text};
#[cfg(feature = "tools")]
use crate::bodies::{ends, service, tools};
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
         agree, errors included; what they accept encodes to the same bytes, as many as announced, \
         into no smaller buffer";
    COM_BYTES: "com_bytes", |data, defect| bytes::check(bytes::COM, data, defect), bytes::DEFECTS,
        "object counts, descriptors, contents: the same";
    VARIABLE_BYTES: "variable_bytes", |data, defect| bytes::check(bytes::VARIABLE, data, defect),
        bytes::VARIABLE_DEFECTS, "kinds, names, descriptions, handles and values of variables: the \
         same; values of up to 128 bytes also as any type, in one dimension and in two";
    SDA_BYTES: "sda_bytes", |data, defect| bytes::check(bytes::SDA, data, defect), bytes::DEFECTS,
        "object addresses, attributes of elements: the same";
    DYNAMIC_BYTES: "dynamic_bytes", |data, defect| bytes::check(bytes::DYNAMIC, data, defect),
        bytes::DEFECTS, "dynamic parameters: the same";
    STREAMING_BYTES: "streaming_bytes",
        |data, defect| bytes::check(bytes::STREAMING, data, defect), bytes::STREAMING_DEFECTS,
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
         it takes encodes to a call with the same service, address and data, into no smaller buffer, \
         and that is dispatched to the same request";
    OPERATION_REQUEST: "operation_request", operation::request, operation::REQUEST_DEFECTS,
        "an operation of any function, made of any parameters, is encoded to a call that a server \
         dispatches to that operation, or is refused; within the documented ranges it is refused \
         only where another function is";
    OPERATION_REPLY: "operation_reply", operation::reply, operation::REPLY_DEFECTS,
        "a request takes for a reply what its function's stream takes, no more than the request \
         has room for, and encodes it to the same bytes, into no smaller buffer";
    ADS_FRAMES: "ads_frames", frames::frames, frames::DEFECTS,
        "a stream of AMS frames, whole or damaged, cut anywhere, gives the frames that it gives \
         uncut, one by one, and then the same fault or rest; each shows with its last byte and \
         stays";
    STREAMING_PACKETS: "streaming_packets", streaming::packets, streaming::PACKETS_DEFECTS,
        "of any bytes the first fault is found, or the packets together are the text with CR LF \
         behind each line, each legal and as full as can be";
    #[cfg(feature = "tools")]
    STREAMING_SENDER: "streaming_sender", ends::check, ends::DEFECTS,
        "whatever is acknowledged, repeated, read and reset: a sender loses and repeats nothing \
         and counts right, the interface is a bounded queue, and what comes out is the text";
    #[cfg(feature = "alloc")]
    STREAMING_CHECKER: "streaming_checker", checker::lots, checker::DEFECTS,
        "a program that comes in any lots of lines: in each is found what is found there in the \
         whole, in the text's order, however lines end; any bytes can be checked";
    #[cfg(feature = "tools")]
    SERVICE_HOST: "service_host", service::world, service::WORLD_DEFECTS,
        "a program, one host or two, and the Service Interface in any order of steps, whatever \
         fails: each request is served once and gets the answer to itself, after chaos too; but with \
         two hosts, a write of RESPONSE_STATE that fails has not arrived";
    #[cfg(feature = "tools")]
    SERVICE_MACHINES: "service_machines", service::machines, service::MACHINES_DEFECTS,
        "a host, a program's request and the five variables, told anything: no request is served \
         that was not found twice, writes keep their order, errors change nothing but that a host \
         may wait";
    TEXT_CP1252: "text_cp1252", text::cp1252, text::DEFECTS,
        "text of any bytes and of any characters is what encoding_rs makes of it, faults \
         included, and comes back both ways";
    VARIABLE_PATH: "variable_path", names::path, names::DEFECTS,
        "a name has the parts that splitting the string finds, from CP1252 and from UTF-8, is put \
         together again, and is refused where it is wrong";
    VARIABLE_TYPED: "variable_typed", shapes::typed, shapes::DEFECTS,
        "type, dimensions and size are taken for a shape if they agree; an element is where nested \
         arrays have it, and what was read is written back as it was";
    #[cfg(feature = "tools")]
    TOOLS_EXPLAIN: "tools_explain", tools::explain::check, tools::explain::DEFECTS,
        "bytes of anything are explained without a panic: all of them are shown, none twice where \
         nothing is wrong; a stream is faulty if and only if the codec refuses it; a terminal gets \
         nothing to act on; hex is read as what it says";
    #[cfg(feature = "tools")]
    TOOLS_CAPTURE: "tools_capture", tools::capture::check, tools::capture::DEFECTS,
        "any file is read as a capture to its end, or it is said that it is cut; out of segments in \
         any order, several times or in other pieces comes what was sent, and what is missing is told";
    #[cfg(feature = "tools")]
    TOOLS_TESTEE: "tools_testee", tools::testee::check, tools::testee::DEFECTS,
        "whatever a testee says is lines of a bounded length, each of which is one answer to the \
         case it was asked or none";
    #[cfg(feature = "tools")]
    TOOLS_WAIVER: "tools_waiver", tools::toml::waiver, tools::toml::WAIVER_DEFECTS,
        "any file is waivers or an error with its line, wherever in the file it stands";
    #[cfg(feature = "tools")]
    TOOLS_PROFILE: "tools_profile", tools::toml::profile, tools::toml::PROFILE_DEFECTS,
        "any file is a profile or an error with its line; a profile that is shown is read as the \
         same, and claims nothing at a port that does not answer";
    #[cfg(feature = "tools")]
    TOOLS_ALLOW: "tools_allow", tools::toml::allow, tools::toml::ALLOW_DEFECTS,
        "any file allows something or is an error with its line; its entries are read as they are \
         shown";
    #[cfg(feature = "tools")]
    TOOLS_MODEL: "tools_model", tools::model::check, tools::model::DEFECTS,
        "any file is a model or an error with its line; a CNC that is made of it answers what the \
         codec reads, as often as it is asked the same";
    #[cfg(feature = "tools")]
    TOOLS_GATE: "tools_gate", tools::gate::check, tools::gate::DEFECTS,
        "nothing passes the gate that does not only ask, is not named by the file for this target \
         and time, or is never sent; what only asks passes whatever else is allowed";
    #[cfg(feature = "tools")]
    CNC_SESSION: "cnc_session", tools::session::check, tools::session::DEFECTS,
        "of whatever comes over a connection each good frame is answered once, with its invoke ID \
         and what the codec reads, in bounded buffers; a write that is refused changes nothing, \
         another is read back";
}
