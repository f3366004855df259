//! Defects and valid variants of this project's client.

use std::fmt;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ClientDefect {
    /// For example `client.no-nul`.
    pub id: &'static str,
    /// The requirement that has to fail; empty for a valid variant.
    pub requirement: &'static str,
    /// What the client does differently.
    pub what: &'static str,
    pub flaw: Flaw,
}

impl fmt::Display for ClientDefect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a client that {}", self.what)
    }
}

macro_rules! flaws {
    (
        defects { $( $flaw:ident $id:literal $requirement:literal $what:literal; )+ }
        habits { $( $habit:ident $habit_id:literal $other:literal; )+ }
    ) => {
        /// A defect or valid variant; its [`ClientDefect`] describes it.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        #[non_exhaustive]
        pub enum Flaw { $( $flaw, )+ $( $habit, )+ }

        const ALL: &[ClientDefect] = &[$(
            ClientDefect { id: $id, requirement: $requirement, what: $what, flaw: Flaw::$flaw },
        )+];

        const HABITS: &[ClientDefect] = &[$(
            ClientDefect { id: $habit_id, requirement: "", what: $other, flaw: Flaw::$habit },
        )+];
    };
}

flaws! {
    defects {
    // Frames it sends.
    TcpLength "client.tcp-length" "ADS-5" "says one byte more in the AMS/TCP header";
    AmsLength "client.ams-length" "ADS-5" "says one byte less in the AMS header";
    ResponseFlag "client.response-flag" "ADS-5" "marks its requests as responses";
    ErrorSet "client.error-set" "ADS-5" "sends an error number in its requests";
    OtherNetId "client.other-net-id" "ADS-5" "asks another NetId than it was told";
    ReadTrailing "client.read-trailing" "ADS-1" "puts four more bytes behind a Read";
    ReadShort "client.read-short" "ADS-1" "asks for two bytes of four in a Read";
    WriteLength "client.write-length" "ADS-2" "says one byte more in a Write";
    BothLength "client.read-write-length" "ADS-3" "says one byte less written in a ReadWrite";
    ReadForBoth "client.read-for-read-write" "ADS-3" "reads where a ReadWrite is taken";
    // Addresses it uses.
    Port "client.port" "GEN-4" "asks the COM task for what the SDA task has";
    NoChannel "client.no-channel" "ADR-5" "leaves the channel out of the group";
    OtherChannel "client.other-channel" "ADR-5" "asks channel 1 for what is of another";
    ElementAccess "client.element-access" "ADR-4" "asks for descriptors where contents are";
    ComGroup "client.com-group" "ADR-3" "looks for a channel's contents at a platform axis";
    SpindleLogical "client.spindle-logical" "ADR-2" "addresses spindles logically";
    AxisStride "client.axis-stride" "ADR-7" "takes 0x1000 for the stride of the decoder's axes";
    Attribute "client.attribute" "ADR-6" "asks for the unit where the name is";
    CountAtOne "client.count-at-one" "COM-1" "asks for the number of objects at offset 1";
    FromZero "client.descriptors-from-zero" "COM-2" "counts descriptors from 0";
    DescriptorLength "client.descriptor-length" "COM-3" "takes a descriptor for 80 bytes long";
    ContentOffset "client.content-offset" "COM-5" "looks for a content one beside its place";
    SwappedQuery "client.swapped-query" "SDA-1" "asks for axis and channel";
    ElementZero "client.element-zero" "SDA-4" "looks for the number of elements at the first";
    ElementName "client.element-name" "SDA-6" "asks for the type instead of the name";
    ElementType "client.element-type" "SDA-7" "asks for the length instead of the type";
    ElementLength "client.element-length" "SDA-8" "asks for the unit instead of the length";
    ElementFlag "client.element-flag" "SDA-9" "asks for the unit instead of the flag";
    ParameterCount "client.parameter-count" "DYN-1" "counts V.L where P is meant";
    ParameterName "client.parameter-name" "DYN-2" "asks for names where the values are";
    ParameterValue "client.parameter-value" "DYN-3" "asks for values where the names are";
    ParameterIndex "client.parameter-by-index" "DYN-4" "asks by index where names are taken";
    ParameterZero "client.parameter-from-zero" "DYN-5" "counts parameters from 0";
    ParameterCut "client.parameter-cut" "DYN-6" "leaves the last character of a parameter's name out";
    CountPlace "client.count-place" "VAR-2" "counts variables one place beside";
    DescribePlace "client.describe-place" "VAR-4" "asks for descriptions one place beside";
    HandlePlace "client.handle-place" "VAR-10" "asks for handles one place beside";
    ValuePlace "client.value-place" "VAR-14" "reads by name where handles are taken";
    ExtendedPlace "client.extended-place" "VAR-15" "asks for what is extended one place beside";
    AxisFromZero "client.axis-from-zero" "VAR-26" "counts axes from 0";
    // Data it sends.
    NoNul "client.no-nul" "VAR-9" "sends names without NUL";
    KindOpen "client.kind-open" "VAR-1" "sends kinds without NUL";
    KindDot "client.kind-dot" "VAR-1" "sends kinds with a final dot";
    IndexSwapped "client.index-swapped" "VAR-3" "sends the index of a description in big-endian";
    Utf8 "client.utf-8" "GEN-3" "sends names in UTF-8";
    NoCount "client.no-count" "VAR-11" "leaves the number of indices out where there is none";
    WriteNoCount "client.write-no-count" "VAR-12" "leaves it out of writes";
    NoSeparator "client.no-separator" "VAR-13" "sends no NUL between name and value";
    ValueSwapped "client.value-swapped" "GEN-1" "writes contents in big-endian";
    // Replies it accepts.
    AnyInvokeId "client.any-invoke-id" "ADS-5" "takes replies to any invoke ID";
    AnyCommand "client.any-command" "ADS-5" "takes replies to any command";
    AnyFlags "client.any-flags" "ADS-5" "takes requests for replies";
    OneRead "client.one-read" "ADS-5" "takes what one read of its socket gives for a frame";
    AmsLengthLie "client.believes-tcp" "ADS-5" "does not look at the length of the AMS header";
    CutFrame "client.cut-frame" "ADS-5" "takes a frame that was cut for a whole one";
    DataLengthLie "client.believes-frame" "ADS-3" "does not look at the length before the data";
    ReadLengthLie "client.believes-frame-read" "ADS-1" "does not look at it in a Read";
    NoResult "client.no-result" "ADS-4" "does not look at the result";
    NoError "client.no-error" "ADS-5" "does not look at the error of the AMS header";
    FillsUp "client.fills-up" "VAR-2" "fills up what is too short with zeros";
    FillsUpHandle "client.fills-up-handle" "VAR-10" "fills up a handle";
    FillsUpValue "client.fills-up-value" "VAR-14" "fills up a value with zeros, and cuts it";
    FillsUpParameter "client.fills-up-parameter" "DYN-3" "fills up a parameter's value";
    CutsOff "client.cuts-off" "COM-1" "cuts off what is too long";
    TornList "client.torn-list" "COM-2" "fills up what is not a whole descriptor";
    Dimensions "client.dimensions" "VAR-24" "takes dimensions that are not there for none";
    Unsigned "client.unsigned" "VAR-14" "reads numbers with a sign as if they had none";
    NoneIsZero "client.none-is-zero" "SDA-2" "takes index group 0 for a place";
    NothingIsError "client.nothing-is-error" "VAR-16" "takes no extended description for an error";
    Dies "client.dies" "ADS-3" "dies of a length that is too much";
    DiesOfError "client.dies-of-error" "ADS-6" "dies of a reply without payload";
    Hangs "client.hangs" "CLIENT" "waits for ever for a reply";
    Garbles "client.garbles" "CLIENT" "answers the suite in something that is no JSON";
    // NC programs.
    StreamPlace "client.stream-place" "STM-1" "streams one place beside";
    StreamLong "client.stream-long" "STM-2" "sends packets of 1000 bytes";
    StreamSplit "client.stream-split" "STM-4" "splits lines between packets";
    StreamLineFeed "client.stream-line-feed" "STM-4" "ends lines by LF";
    StreamUnended "client.stream-unended" "STM-4" "does not end the last line";
    StreamSkips "client.stream-skips" "STM-6" "goes on behind a packet that could not be taken";
    StreamNul "client.stream-nul" "STM-7" "ends packets by NUL";
    StreamAny "client.stream-any" "STM-7" "streams what is not ASCII";
    StreamOrder "client.stream-order" "STM-15" "sends the second packet first";
    StreamLine "client.stream-line" "STM-20" "splits a line that is too long";
    // Services.
    ServiceText "client.service-text" "SVC-1" "fills its response up to 200 bytes";
    ServiceAny "client.service-any" "SVC-2" "answers requests to other services";
    ServiceIdle "client.service-idle" "SVC-2" "answers what is no request";
    ServiceClears "client.service-clears" "SVC-3.1" "takes the request back behind its answer";
    ServiceOrder "client.service-order" "SVC-5" "writes RESPONSE_STATE before RESPONSE";
    ServiceZero "client.service-zero" "SVC-5" "answers with a response state of 0";
    CallerWaits "client.caller-waits" "SVC-6" "reads RESPONSE at once";
    CallerOrder "client.caller-order" "SVC-12" "writes REQUEST_STATE first";
    }
    habits {
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
/// use ads_cnc_conformance::clients::{defects, find_defect};
///
/// assert!(defects().iter().all(|one| one.id.starts_with("client.")));
/// assert_eq!(find_defect("client.no-nul").unwrap().requirement, "VAR-9");
/// ```
pub const fn defects() -> &'static [ClientDefect] {
    ALL
}

/// Valid variants: the client acts differently, but no requirement may fail.
pub const fn habits() -> &'static [ClientDefect] {
    HABITS
}

/// The defect or valid variant with this ID.
pub fn find_defect(id: &str) -> Option<&'static ClientDefect> {
    ALL.iter().chain(HABITS).find(|one| one.id == id)
}
