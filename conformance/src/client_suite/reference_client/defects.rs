//! Defects and valid variants of this project's client.

use std::fmt;

use ads_cnc_vectors::ids::*;

use crate::judge::CLIENT;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ClientDefect {
    /// The ID, for example `client.no-nul`.
    pub id: &'static str,
    /// The requirement that must fail; empty for a valid variant.
    pub requirement: &'static str,
    /// What the client does differently.
    pub what: &'static str,
    pub fault: ClientFault,
}

impl fmt::Display for ClientDefect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a client that {}", self.what)
    }
}

macro_rules! client_faults {
    (@id CLIENT) => {
        CLIENT
    };
    (@id $requirement:tt) => {
        $requirement.as_str()
    };
    (
        defects { $( $fault:ident $id:literal $requirement:tt $what:literal; )+ }
        variants { $( $variant:ident $habit_id:literal $other:literal; )+ }
    ) => {
        /// A defect or valid variant; its [`ClientDefect`] describes it.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        #[non_exhaustive]
        pub enum ClientFault { $( $fault, )+ $( $variant, )+ }

        const ALL: &[ClientDefect] = &[$(
            ClientDefect {
                id: $id, requirement: client_faults!(@id $requirement), what: $what, fault: ClientFault::$fault,
            },
        )+];

        const VARIANTS: &[ClientDefect] = &[$(
            ClientDefect { id: $habit_id, requirement: "", what: $other, fault: ClientFault::$variant },
        )+];
    };
}

client_faults! {
    defects {
    // Defects in the frames that the client sends.
    TcpLength "client.tcp-length" ADS_5 "says one byte more in the AMS/TCP header";
    AmsLength "client.ams-length" ADS_5 "says one byte less in the AMS header";
    ResponseFlag "client.response-flag" ADS_5 "marks its requests as responses";
    ErrorSet "client.error-set" ADS_5 "sends an error number in its requests";
    OtherNetId "client.other-net-id" ADS_5 "asks another NetId than it was told";
    ReadTrailing "client.read-trailing" ADS_1 "puts four more bytes behind a Read";
    ReadShort "client.read-short" ADS_1 "asks for two bytes of four in a Read";
    WriteLength "client.write-length" ADS_2 "says one byte more in a Write";
    BothLength "client.read-write-length" ADS_3 "says one byte less written in a ReadWrite";
    ReadForBoth "client.read-for-read-write" ADS_3 "reads where a ReadWrite is taken";
    // Defects in the addresses that the client uses.
    Port "client.port" GEN_4 "asks the COM task for what the SDA task has";
    NoChannel "client.no-channel" ADR_5 "leaves the channel out of the group";
    OtherChannel "client.other-channel" ADR_5 "asks channel 1 for what is of another";
    ElementAccess "client.element-access" ADR_4 "asks for descriptors where contents are";
    ComGroup "client.com-group" ADR_3 "looks for a channel's contents at a platform axis";
    SpindleLogical "client.spindle-logical" ADR_2 "addresses spindles logically";
    AxisStride "client.axis-stride" ADR_7 "takes 0x1000 for the stride of the decoder's axes";
    Attribute "client.attribute" ADR_6 "asks for the unit where the name is";
    CountAtOne "client.count-at-one" COM_1 "asks for the number of objects at offset 1";
    FromZero "client.descriptors-from-zero" COM_2 "counts descriptors from 0";
    DescriptorLength "client.descriptor-length" COM_3 "takes a descriptor for 80 bytes long";
    ContentOffset "client.content-offset" COM_5 "looks for a content one beside its place";
    SwappedQuery "client.swapped-query" SDA_1 "asks for axis and channel";
    ElementZero "client.element-zero" SDA_4 "looks for the number of elements at the first";
    ElementName "client.element-name" SDA_6 "asks for the type instead of the name";
    ElementType "client.element-type" SDA_7 "asks for the length instead of the type";
    ElementLength "client.element-length" SDA_8 "asks for the unit instead of the length";
    ElementFlag "client.element-flag" SDA_9 "asks for the unit instead of the flag";
    ParameterCount "client.parameter-count" DYN_1 "counts V.L where P is meant";
    ParameterName "client.parameter-name" DYN_2 "asks for names where the values are";
    ParameterValue "client.parameter-value" DYN_3 "asks for values where the names are";
    ParameterIndex "client.parameter-by-index" DYN_4 "asks by index where names are taken";
    ParameterZero "client.parameter-from-zero" DYN_5 "counts parameters from 0";
    ParameterCut "client.parameter-cut" DYN_6 "leaves the last character of a parameter's name out";
    CountPlace "client.count-place" VAR_2 "counts variables one place beside";
    DescribePlace "client.describe-place" VAR_4 "asks for descriptions one place beside";
    HandlePlace "client.handle-place" VAR_10 "asks for handles one place beside";
    ValuePlace "client.value-place" VAR_14 "reads by name where handles are taken";
    ExtendedPlace "client.extended-place" VAR_15 "asks for what is extended one place beside";
    AxisFromZero "client.axis-from-zero" VAR_26 "counts axes from 0";
    // Defects in the data that the client sends.
    NoNul "client.no-nul" VAR_9 "sends names without NUL";
    KindOpen "client.kind-open" VAR_1 "sends kinds without NUL";
    KindDot "client.kind-dot" VAR_1 "sends kinds with a final dot";
    IndexSwapped "client.index-swapped" VAR_3 "sends the index of a description in big-endian";
    Utf8 "client.utf-8" GEN_3 "sends names in UTF-8";
    NoCount "client.no-count" VAR_11 "leaves the number of indices out where there is none";
    WriteNoCount "client.write-no-count" VAR_12 "leaves it out of writes";
    NoSeparator "client.no-separator" VAR_13 "sends no NUL between name and value";
    ValueSwapped "client.value-swapped" GEN_1 "writes contents in big-endian";
    // Defects in the checks of replies: the client accepts invalid replies.
    AnyInvokeId "client.any-invoke-id" ADS_5 "takes replies to any invoke ID";
    AnyCommand "client.any-command" ADS_5 "takes replies to any command";
    AnyFlags "client.any-flags" ADS_5 "takes requests for replies";
    OneRead "client.one-read" ADS_5 "takes what one read of its socket gives for a frame";
    AmsLengthLie "client.believes-tcp" ADS_5 "does not look at the length of the AMS header";
    CutFrame "client.cut-frame" ADS_5 "takes a frame that was cut for a whole one";
    DataLengthLie "client.believes-frame" ADS_3 "does not look at the length before the data";
    ReadLengthLie "client.believes-frame-read" ADS_1 "does not look at it in a Read";
    NoResult "client.no-result" ADS_4 "does not look at the result";
    NoError "client.no-error" ADS_5 "does not look at the error of the AMS header";
    FillsUp "client.fills-up" VAR_2 "fills up what is too short with zeros";
    FillsUpHandle "client.fills-up-handle" VAR_10 "fills up a handle";
    FillsUpValue "client.fills-up-value" VAR_14 "fills up a value with zeros, and cuts it";
    FillsUpParameter "client.fills-up-parameter" DYN_3 "fills up a parameter's value";
    CutsOff "client.cuts-off" COM_1 "cuts off what is too long";
    TornList "client.torn-list" COM_2 "fills up what is not a whole descriptor";
    Dimensions "client.dimensions" VAR_24 "takes dimensions that are not there for none";
    Unsigned "client.unsigned" VAR_14 "reads numbers with a sign as if they had none";
    NoneIsZero "client.none-is-zero" SDA_2 "takes index group 0 for a place";
    NothingIsError "client.nothing-is-error" VAR_16 "takes no extended description for an error";
    Dies "client.dies" ADS_3 "dies of a length that is too much";
    DiesOfError "client.dies-of-error" ADS_6 "dies of a reply without payload";
    Hangs "client.hangs" CLIENT "waits for ever for a reply";
    Garbles "client.garbles" CLIENT "answers the suite with text that is not JSON";
    // Defects in streaming NC programs.
    StreamPlace "client.stream-place" STM_1 "streams one place beside";
    StreamLong "client.stream-long" STM_2 "sends packets of 1000 bytes";
    StreamSplit "client.stream-split" STM_4 "splits lines between packets";
    StreamLineFeed "client.stream-line-feed" STM_4 "ends lines by LF";
    StreamUnended "client.stream-unended" STM_4 "does not end the last line";
    StreamSkips "client.stream-skips" STM_6 "goes on behind a packet that could not be taken";
    StreamNul "client.stream-nul" STM_7 "ends packets by NUL";
    StreamAny "client.stream-any" STM_7 "streams what is not ASCII";
    StreamOrder "client.stream-order" STM_15 "sends the second packet first";
    StreamLine "client.stream-line" STM_20 "splits a line that is too long";
    // Defects of the client as a service or as an NC program that requests a service.
    ServiceText "client.service-text" SVC_1 "fills its response up to 200 bytes";
    ServiceAny "client.service-any" SVC_2 "answers requests to other services";
    ServiceIdle "client.service-idle" SVC_2 "answers while REQUEST_STATE is 0";
    ServiceClears "client.service-clears" SVC_3_1 "takes the request back behind its answer";
    ServiceOrder "client.service-order" SVC_5 "writes RESPONSE_STATE before RESPONSE";
    ServiceZero "client.service-zero" SVC_5 "answers with a response state of 0";
    CallerWaits "client.caller-waits" SVC_6 "reads RESPONSE at once";
    CallerOrder "client.caller-order" SVC_12 "writes REQUEST_STATE first";
    }
    variants {
    ByIndex "client-habit.by-index" "addresses channels by index";
    Geo "client-habit.geo" "asks GEO for all classes but the decoder";
    PaddedNames "client-habit.padded-names" "pads names to 256 bytes";
    OneByOne "client-habit.one-by-one" "reads one descriptor at a time";
    LineByLine "client-habit.line-by-line" "streams one line at a time";
    }
}

/// All defects of this project's client.
///
/// ```
/// use ads_cnc_conformance::client_suite::{defects, find_defect};
///
/// assert!(defects().iter().all(|one| one.id.starts_with("client.")));
/// assert_eq!(find_defect("client.no-nul").unwrap().requirement, "VAR-9");
/// ```
pub const fn defects() -> &'static [ClientDefect] {
    ALL
}

/// All valid variants: the client behaves differently, but no requirement may fail.
pub const fn variants() -> &'static [ClientDefect] {
    VARIANTS
}

/// The defect or valid variant with this ID.
pub fn find_defect(id: &str) -> Option<&'static ClientDefect> {
    ALL.iter().chain(VARIANTS).find(|one| one.id == id)
}
