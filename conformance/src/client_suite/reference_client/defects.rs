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
    TcpLength "client.tcp-length" ADS_5 "states one byte too many in the AMS/TCP header";
    AmsLength "client.ams-length" ADS_5 "states one byte too few in the AMS header";
    ResponseFlag "client.response-flag" ADS_5 "marks its requests as responses";
    ErrorSet "client.error-set" ADS_5 "sends an error number in its requests";
    OtherNetId "client.other-net-id" ADS_5 "sends requests to a wrong NetId";
    ReadTrailing "client.read-trailing" ADS_1 "appends four bytes to a Read";
    ReadShort "client.read-short" ADS_1 "requests only two of four bytes in a Read";
    WriteLength "client.write-length" ADS_2 "states one byte too many in a Write";
    BothLength "client.read-write-length" ADS_3 "states one written byte too few in a ReadWrite";
    ReadForBoth "client.read-for-read-write" ADS_3 "sends a Read to a function that requires a ReadWrite";
    // Defects in the addresses that the client uses.
    Port "client.port" GEN_4 "sends requests for the SDA task to the COM task";
    NoChannel "client.no-channel" ADR_5 "omits the channel from the index group";
    OtherChannel "client.other-channel" ADR_5 "sends requests for other channels to channel 1";
    ElementAccess "client.element-access" ADR_4 "requests descriptors in the index group of contents";
    ComGroup "client.com-group" ADR_3 "requests contents of a channel from a platform axis";
    SpindleLogical "client.spindle-logical" ADR_2 "addresses spindles by a logical number";
    AxisStride "client.axis-stride" ADR_7 "uses the stride 0x1000 for the axes of the decoder";
    Attribute "client.attribute" ADR_6 "requests the unit instead of the name";
    CountAtOne "client.count-at-one" COM_1 "requests the number of objects at index offset 1";
    FromZero "client.descriptors-from-zero" COM_2 "counts descriptors from 0";
    DescriptorLength "client.descriptor-length" COM_3 "assumes that a descriptor has 80 bytes";
    ContentOffset "client.content-offset" COM_5 "requests the content at the next index offset";
    SwappedQuery "client.swapped-query" SDA_1 "sends the axis before the channel in an object address request";
    ElementZero "client.element-zero" SDA_4 "requests the number of elements at the first element";
    ElementName "client.element-name" SDA_6 "requests the type instead of the name";
    ElementType "client.element-type" SDA_7 "requests the length instead of the type";
    ElementLength "client.element-length" SDA_8 "requests the unit instead of the length";
    ElementFlag "client.element-flag" SDA_9 "requests the unit instead of the write flag";
    ParameterCount "client.parameter-count" DYN_1 "requests the number of V.L parameters instead of P";
    ParameterName "client.parameter-name" DYN_2 "requests names at the index offset of values";
    ParameterValue "client.parameter-value" DYN_3 "requests values at the index offset of names";
    ParameterIndex "client.parameter-by-index" DYN_4 "sends an index to a function that requires a name";
    ParameterZero "client.parameter-from-zero" DYN_5 "counts parameters from 0";
    ParameterCut "client.parameter-cut" DYN_6 "omits the last character of a parameter's name";
    CountPlace "client.count-place" VAR_2 "requests the number of variables at the index offset of descriptions";
    DescribePlace "client.describe-place" VAR_4 "requests descriptions at the index offset of handles";
    HandlePlace "client.handle-place" VAR_10 "requests handles at the index offset of descriptions";
    ValuePlace "client.value-place" VAR_14 "sends a name to the function that reads by handle";
    ExtendedPlace "client.extended-place" VAR_15 "requests extended descriptions at the index offset of descriptions by name";
    AxisFromZero "client.axis-from-zero" VAR_26 "counts axes from 0";
    // Defects in the data that the client sends.
    NoNul "client.no-nul" VAR_9 "sends names without NUL";
    KindOpen "client.kind-open" VAR_1 "sends kinds without NUL";
    KindDot "client.kind-dot" VAR_1 "sends kinds with a final dot";
    IndexSwapped "client.index-swapped" VAR_3 "sends the index of a description in big-endian";
    Utf8 "client.utf-8" GEN_3 "sends names in UTF-8";
    NoCount "client.no-count" VAR_11 "omits the number of indices if it is 0";
    WriteNoCount "client.write-no-count" VAR_12 "omits the number of indices in writes if it is 0";
    NoSeparator "client.no-separator" VAR_13 "sends no NUL between name and value";
    ValueSwapped "client.value-swapped" GEN_1 "writes contents in big-endian";
    // Defects in the handling of replies, and in the answers to the suite.
    AnyInvokeId "client.any-invoke-id" ADS_5 "accepts replies with any invoke ID";
    AnyCommand "client.any-command" ADS_5 "accepts replies with any command";
    AnyFlags "client.any-flags" ADS_5 "accepts requests as replies";
    OneRead "client.one-read" ADS_5 "assumes that one read of its socket returns one frame";
    AmsLengthLie "client.believes-tcp" ADS_5 "ignores the length in the AMS header";
    CutFrame "client.cut-frame" ADS_5 "accepts a truncated frame";
    DataLengthLie "client.believes-frame" ADS_3 "ignores the length before the data of a ReadWrite";
    ReadLengthLie "client.believes-frame-read" ADS_1 "ignores the length before the data of a Read";
    NoResult "client.no-result" ADS_4 "ignores the result";
    NoError "client.no-error" ADS_5 "ignores the error in the AMS header";
    FillsUp "client.fills-up" VAR_2 "fills a short number of variables with zeros";
    FillsUpHandle "client.fills-up-handle" VAR_10 "fills a short handle with zeros";
    FillsUpValue "client.fills-up-value" VAR_14 "fills a short value with zeros, and truncates a long one";
    FillsUpParameter "client.fills-up-parameter" DYN_3 "fills the short value of a parameter with zeros";
    CutsOff "client.cuts-off" COM_1 "truncates a long number of objects";
    TornList "client.torn-list" COM_2 "fills an incomplete descriptor with zeros";
    Dimensions "client.dimensions" VAR_24 "accepts the number 0xFFFFFFFF of dimensions as 0";
    Unsigned "client.unsigned" VAR_14 "reads signed numbers as unsigned";
    NoneIsZero "client.none-is-zero" SDA_2 "accepts index group 0 as an address";
    NothingIsError "client.nothing-is-error" VAR_16 "reports an empty extended description as an error";
    Dies "client.dies" ADS_3 "crashes on a length that is too large";
    DiesOfError "client.dies-of-error" ADS_6 "crashes on a reply without payload";
    Hangs "client.hangs" CLIENT "waits forever for a reply";
    Garbles "client.garbles" CLIENT "answers the suite with text that is not JSON";
    // Defects in streaming NC programs.
    StreamPlace "client.stream-place" STM_1 "streams to the next index offset";
    StreamLong "client.stream-long" STM_2 "sends packets of 1000 bytes";
    StreamSplit "client.stream-split" STM_4 "splits lines across packets";
    StreamLineFeed "client.stream-line-feed" STM_4 "ends lines with LF";
    StreamUnended "client.stream-unended" STM_4 "sends the last line without a line end";
    StreamSkips "client.stream-skips" STM_6 "continues with the next packet after a rejected one";
    StreamNul "client.stream-nul" STM_7 "ends packets with NUL";
    StreamAny "client.stream-any" STM_7 "streams characters that are not ASCII";
    StreamOrder "client.stream-order" STM_15 "sends the second packet first";
    StreamLine "client.stream-line" STM_20 "splits a line that is longer than a packet";
    // Defects of the client as a service or as an NC program that requests a service.
    ServiceText "client.service-text" SVC_1 "pads its response to 200 bytes";
    ServiceAny "client.service-any" SVC_2 "responds to requests to other services";
    ServiceIdle "client.service-idle" SVC_2 "responds while REQUEST_STATE is 0";
    ServiceClears "client.service-clears" SVC_3_1 "resets REQUEST_STATE after it writes RESPONSE_STATE";
    ServiceOrder "client.service-order" SVC_5 "writes RESPONSE_STATE before RESPONSE";
    ServiceZero "client.service-zero" SVC_5 "responds with RESPONSE_STATE 0";
    CallerWaits "client.caller-waits" SVC_6 "reads RESPONSE before RESPONSE_STATE is set";
    CallerOrder "client.caller-order" SVC_12 "writes REQUEST_STATE before the other variables";
    }
    variants {
    ByIndex "client-habit.by-index" "addresses channels by index";
    Geo "client-habit.geo" "uses the GEO task for all classes except the decoder";
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
