//! Where the manuals contradict one another or themselves, what this crate does there, and how
//! the caller steers it.
//!
//! The errata, E-01 and on, are those of the register in the crate `ads-cnc-vectors`, which has
//! every reading with its section. "Both" is `ads-en` 1.05 and `ads-de` 1.051. Where a row names
//! nothing to steer by, what was received decides, or only one reading is possible.
//!
//! Two matter most, as they change what is sent or what a CNC answers: the [distance between
//! axes](#distance-between-axes) and the [editions](#editions). The others are in the order of the
//! manuals, and [here](#not-said-at-all) is what none of them says.
//!
//! # Distance between axes
//!
//! E-01. Both print `0x1000 × axis + element` for a channel axis of COM in 2.1, and `0x10001` for
//! its axis 1 in 2.1.2; `0x1000` for the first platform axis of the HLD in 2.2.2, and `0x20000` for
//! the decoder's axis 2 beside it. [`AxisStride`](crate::address::AxisStride) has both by name;
//! `0x10000` is the default, and what the axis interface (4.2.2) always has. An offset does not
//! tell which was used:
//!
//! ```
//! use ads_cnc::address::{AxisStride, IndexOffset};
//!
//! let by_example = IndexOffset::of_axis(AxisStride::X10000, 1, 1)?;
//! let by_table = IndexOffset::of_axis(AxisStride::X1000, 1, 1)?;
//! assert_eq!((by_example.get(), by_table.get()), (0x1_0001, 0x1001));
//!
//! assert_eq!(by_example.axis_and_element(AxisStride::X10000)?, (1, 1));
//! assert_eq!(by_example.axis_and_element(AxisStride::X1000)?, (16, 1));
//! # Ok::<(), ads_cnc::Error>(())
//! ```
//!
//! So a client computes neither, but takes what the CNC says: of COM the descriptor's
//! [`index_group`](crate::DescriptorRef::index_group) and
//! [`index_offset`](crate::DescriptorRef::index_offset), of SDA and GEO the
//! [reply](crate::sda::ObjectAddress) to the [query](crate::operation::FindInstance) of the object
//! address, from which elements [count on](crate::address::ElementAddress::following).
//!
//! ```
//! use ads_cnc::address::{Class, IndexGroup, IndexOffset};
//! use ads_cnc::operation::{FindInstance, Operation, ReadElementName, ReadObject};
//! use ads_cnc::{Decode, Descriptor, DescriptorRef, Encode};
//!
//! // What a CNC may say of an object of a channel axis …
//! let (group, offset) = (IndexGroup::new(0x12_0101), IndexOffset::new(0x1_0001));
//! let object = Descriptor::new("mc_example_r", "BOOL")?.with_size(1).with_content(group, offset);
//! let mut reply = [0; 84];
//! object.encode(&mut reply)?;
//!
//! // … is where to read it, whatever the stride.
//! let object = DescriptorRef::decode(&reply)?;
//! let read = ReadObject::new(object.index_group(), object.index_offset(), object.size())?;
//! assert_eq!((read.index_group(), read.index_offset()), (group, offset));
//! assert_eq!(read.read_length(), 1);
//!
//! // The printed answer for the first platform axis, and the name of an element of it.
//! let query = FindInstance::new(Class::Hld, 0, 1);
//! let found = query.decode_reply(&[0x00, 0x33, 0x12, 0, 0x00, 0x10, 0, 0])?;
//! let first = found.first_element()?.expect("the axis is configured");
//! let name = ReadElementName::new(first.following(3)?);
//! assert_eq!((name.index_group().get(), name.index_offset().get()), (0x12_3400, 0x1003));
//! # Ok::<(), ads_cnc::Error>(())
//! ```
//!
//! [`ElementAddress::of_axis`](crate::address::ElementAddress::of_axis) and
//! [`Call::dispatch`](crate::operation::Call::dispatch) have 0x10000 alone: to a server the first
//! element at 0x1000 is [`ReadElement`](crate::operation::ReadElement) of element 0x1000, not
//! [`CountElements`](crate::operation::CountElements).
//!
//! # Editions
//!
//! E-15, E-39. By name only is V.CYC in `ads-en`, and V.CYC, V.P, V.L and V.S in `ads-de`; both then
//! bar three functions, 0x46, 0x47 and 0x49. `ads-en` does not have the last three kinds on this
//! interface at all, `ads-de` has them from some version of the CNC on. Requests are built and read
//! for any kind; [`Edition`](crate::edition::Edition) and
//! [`CncVersion`](crate::edition::CncVersion) say what to expect of it:
//!
//! ```
//! use ads_cnc::address::Channel;
//! use ads_cnc::edition::{CncVersion, Edition};
//! use ads_cnc::operation::{Function, HandleByName, Operation, ReadByName};
//! use ads_cnc::{Error, VariablePath};
//!
//! /// Reads by name if that is all there is.
//! fn function(edition: Edition, cnc: CncVersion, name: &str) -> Result<Option<Function>, Error> {
//!     let kind = VariablePath::new(name)?.kind();
//!     let may = |function: &Function| edition.permits(*function, kind, Some(cnc)).yes;
//!     Ok([Function::HandleByName, Function::ReadByName].into_iter().find(may))
//! }
//!
//! let (old, new) = (CncVersion::new("V3.1.3081.06")?, CncVersion::new("V3.1.3081.07")?);
//! let handle = Some(Function::HandleByName);
//! let name = Some(Function::ReadByName);
//! assert_eq!(function(Edition::German, old, "V.E.a")?, handle);
//! assert_eq!(function(Edition::English, old, "V.CYC.a")?, name);
//! assert_eq!(function(Edition::German, old, "V.P.a")?, None);
//! assert_eq!(function(Edition::German, new, "V.P.a")?, name);
//! assert_eq!(function(Edition::English, new, "V.P.a")?, None);
//!
//! // To try all the same is up to the caller.
//! let op = HandleByName::new(Channel::new(1)?, "V.P.a")?;
//! assert_eq!(op.encode(&mut [0; 16])?, b"V.P.a\0");
//! # Ok::<(), Error>(())
//! ```
//!
//! # Addresses
//!
//! Sections 1 and 2.
//!
//! | | the editions say | here | steered by |
//! |---|---|---|---|
//! | E-02, E-06 | both, 2.2.2: base 0x20300 beside the sums 0x123900 and 0x123501, which have the logical bit | the sums; without the bit if asked | [`Addressing`](crate::address::Addressing), [`FindInstance::by_index`](crate::operation::FindInstance::by_index) |
//! | E-04 | both: platform at 0x120101 (2.1) or 0x120100 (2.1.2); platform axis at 0x120200 + axis (2.1) or 0x120200, 0x10001 (2.1.2) | 0x120101 comes apart as channel 1, which drives the platform; the descriptor tells where a content is | [`ComGroup::platform`](crate::address::ComGroup::platform), [`Channel::com`](crate::address::Channel::com), [`PlatformAxis::com`](crate::address::PlatformAxis::com), [`ReadObject`](crate::operation::ReadObject) |
//! | E-13 | spindles up to the axes − 1 (`ads-en`), to the spindle axes − 1 (`ads-de`) | from 0, any that 8 bits hold; which there are, the CNC says | [`Spindle`](crate::address::Spindle) |
//! | E-30 | both, 2.2.2: channels of the HLD from 1, yet a query with channel 0 | channel 0 with an axis is the platform's; a query takes any two numbers | [`FindInstance`](crate::operation::FindInstance), [`ClassGroup::instance`](crate::address::ClassGroup::instance); [`Channel`](crate::address::Channel) is from 1 |
//! | E-31 | both, 2.2.1: 0x120300 + 0x5000, and 0x25300 | 0x25300: spindles have no logical form | [`Class::Spindle`](crate::address::Class::Spindle) |
//! | E-36 | both, 2.1.1: offset 0 counts all objects, or channel 1's | those of the addressed list | [`ObjectList`](crate::operation::ObjectList) |
//! | E-40 | both: axes from 1 (2), from 0 (2.2.2); path preparation without axes (2.2.1), with (2.2.2) | with axes; 0 is the channel itself | [`IndexOffset::of_axis`](crate::address::IndexOffset::of_axis), [`FindInstance`](crate::operation::FindInstance); [`ChannelAxis`](crate::address::ChannelAxis) is from 1 |
//! | E-52 | both: the channel a digit behind 0x13010 (2.1.1), or added to 0x120100 (2.1) | added; channel 16 is 0x130110 | [`Channel::new`](crate::address::Channel::new) |
//! | E-53 | `ads-en`, 4.2: channel number or channel ID | the ID, since the group is logical | [`Channel::new`](crate::address::Channel::new), [`Channel::by_index`](crate::address::Channel::by_index) |
//! | E-76 | both, 4.2.2: 0x10000 × axis is added to offsets that are axis 1's already; the examples (4.3.9 … 4.3.11) have 0x10004 and 0x20004 | added to 0x4 … 0x9 | [`ChannelAxis::offset`](crate::address::ChannelAxis::offset) |
//! | E-83 | both: a spindle's index is in the index group (2), in place of the channel (2.2.2) | in the group; in the query of an object address, as the channel | [`Spindle::class`](crate::address::Spindle::class), [`ObjectAddressQuery`](crate::sda::ObjectAddressQuery) |
//! | E-84 | both, 2.2.2: axes up to `BAHN_BAVO_AXMAX`, which is not printed, or to the configured ones | any axis can be asked for; the CNC answers (0, 0) if there is none | [`ObjectAddress::NONE`](crate::sda::ObjectAddress::NONE), [`first_element`](crate::sda::ObjectAddress::first_element) |
//! | E-88 | both, 1: NetId, group and offset are an element's address, yet each task has a port | the port is part of it | [`AmsAddr`](crate::ads::AmsAddr), [`Call::port`](crate::operation::Call::port) |
//!
//! # Objects and elements
//!
//! Sections 2.1 and 2.2.
//!
//! | | the editions say | here | steered by |
//! |---|---|---|---|
//! | E-07 | both, 2.1.1: places of a descriptor's fields in a column "Bit" | bytes | |
//! | E-08 | 2.1.1: TRUE is "describable" (`ads-en`), can be written (`ads-de`) | the word is kept; any but 0 is writable | [`WriteAccess`](crate::WriteAccess): `READ_ONLY`, `WRITABLE` or any other word |
//! | E-11 | both: attribute 0x500 is whether writing is permitted (2.2.1), headed write protection (2.2.2) | TRUE is permitted; the byte is kept, any but 0 is TRUE | [`ElementWriteFlag`](crate::sda::ElementWriteFlag): `READ_ONLY`, `WRITABLE` or any other byte |
//! | E-74 | both: types of elements are integers and reals (2.2.1); one is BOOLEAN (2.2.2) | the type is a text, taken as it is | [`ElementTextRef`](crate::sda::ElementTextRef), [`ContentRef`](crate::ContentRef) |
//! | E-75 | both, 2.2.2: element 0 counts the elements of a class, of an instance | of the instance, itself left out, which is assumed | [`ElementCount`](crate::sda::ElementCount), [`ElementAddress::following`](crate::address::ElementAddress::following) |
//! | E-78 | both, 2.1.1: STRING(32), which would be 33 bytes with a NUL, in places of 32 | 32; a text of 32 characters has no NUL | [`DESCRIPTOR_TEXT_LEN`](crate::limits::DESCRIPTOR_TEXT_LEN) |
//!
//! # Dynamic parameters
//!
//! Section 3.
//!
//! | | the editions say | here | steered by |
//! |---|---|---|---|
//! | E-33 | both: names of all V. variables at most 96 bytes (3), 256 (4.3) | 96 in section 3, 256 in section 4 | [`DynamicNameRequestRef`](crate::dynamic::DynamicNameRequestRef) and [`DYNAMIC_NAME_MAX`](crate::limits::DYNAMIC_NAME_MAX), [`VariableNameRef`](crate::VariableNameRef) and [`TEXT_MAX`](crate::limits::TEXT_MAX) |
//! | E-79 | offsets 0x2 … 0x5: how many there are, or a parameter's own number | how many | [`CountDynamic`](crate::operation::CountDynamic), [`DynamicCount`](crate::dynamic::DynamicCount) |
//! | E-80 | both: a type or two, one length | in / out; a single type is read; the length is that of what comes out | [`DynamicNameByIndex`](crate::operation::DynamicNameByIndex), [`DynamicValueByName`](crate::operation::DynamicValueByName), [`DynamicValueByIndex`](crate::operation::DynamicValueByIndex) |
//! | E-82 | both, 3: read so are V.A, V.E, V.CYC and V.G too; functions only for P, V.L, V.P and V.S | those four; the others are section 4's | [`DynamicKind`](crate::dynamic::DynamicKind) |
//!
//! # Variables
//!
//! Section 4.
//!
//! | | the editions say | here | steered by |
//! |---|---|---|---|
//! | E-16 | both: only V.CYC is n-dimensional (4.2), fields of any kind are (4.1, 4.3.2) | any number of dimensions of any kind | [`DescriptionRef::dimensions`](crate::DescriptionRef::dimensions) |
//! | E-17, E-46 | both, 4.3.2: the name up to 256 bytes, the stream 276 + 4m as if it always had them; nothing of its end | one NUL is written; NULs up to 256, no NUL, and bytes behind it are read and kept | [`TextRef::with_tail`](crate::TextRef::with_tail), [`TextRef::tail`](crate::TextRef::tail) |
//! | E-23 | 4.3.8: SYNCHRONISED and SYNCHRONIZED | one code, 2 | [`Synchronisation::SYNCHRONIZED`](crate::Synchronisation::SYNCHRONIZED) |
//! | E-24, E-45 | both: a handle or number is 4 bytes, at most 4 (4.3.1, 4.3.3), or has an offset 4 too (4.3.9) | just 4 bytes | |
//! | E-25 | "Number of variable elements" and "Variable element number" | one function, 0x44 | [`Function::CountVariables`](crate::operation::Function::CountVariables) |
//! | E-26 | both: 0x4C is reserved; the public help pages: description by name, headed as handle by name | description by name (VAR-28), from the versions on that the help pages name | [`DescribeByName`](crate::operation::DescribeByName), [`DescriptionByNameRef`](crate::DescriptionByNameRef), [`Feature::DescriptionByName`](crate::edition::Feature::DescriptionByName) |
//! | E-32, E-51 | both, of a dimension: the largest index (4.2.1, and V\[n\] in 4.1), the number n of elements (4.3.2) | the number; indices go to n − 1 | [`DescriptionRef::dimensions`](crate::DescriptionRef::dimensions) |
//! | E-34 | name requests of 256 bytes (`ads-de`), at most 256 (`ads-en`) | one NUL is written, NULs up to 256 are read | [`TextRef::with_tail`](crate::TextRef::with_tail) |
//! | E-42 | both: n is the number of dimensions (4.3.4), of indices that follow (4.3.6) | of indices that follow; 0 for the whole variable | [`HandleReadRef::indices`](crate::HandleReadRef::indices), [`HandleWriteRef`](crate::HandleWriteRef) |
//! | E-47 | both: requests with index and kind up to 2048 bytes (4.2.1), 260 (4.3.2) | 260 | [`INDEX_KIND_MAX`](crate::limits::INDEX_KIND_MAX) |
//! | E-55 | both: the identifier is in the axis name (4.3.7), in the variable name (4.3.3) | the last part of the variable's name, on the channel interface | [`VariablePath::axis`](crate::VariablePath::axis) |
//! | E-56 | an array can be (`ads-en`), is (`ads-de`) one unit, 4.1 | it is: one name and handle, elements by index | [`VariablePath::variable`](crate::VariablePath::variable), [`VariablePath::elements`](crate::VariablePath::elements) |
//! | E-77 | both: an extended description is 8 bytes, at most 2048 (4.3.8), or of variable length (4.2.1) | 8 bytes or none | [`ExtendedReply`](crate::ExtendedReply) |
//! | E-81 | both: values up to 2040 bytes (4.3.6) or 2047 (4.3.7), yet header and value together up to 2048 | both limits hold, so that the smaller decides | [`HANDLE_VALUE_MAX`](crate::limits::HANDLE_VALUE_MAX), [`NAME_VALUE_MAX`](crate::limits::NAME_VALUE_MAX), [`VARIABLE_MAX`](crate::limits::VARIABLE_MAX) |
//! | E-87 | `ads-de`, 4.1: two versions of one branch each for V2.11 and V3.1 (VAR-19) | from each on in its own line of builds; between the two it is no, marked as assumed | [`CncVersion::has`](crate::edition::CncVersion::has), [`Answer::assumed`](field@crate::edition::Answer::assumed) |
//!
//! # ADS services, texts
//!
//! Sections 1 and 5.
//!
//! | | the manuals say | here | steered by |
//! |---|---|---|---|
//! | E-12, E-50 | both, 5: a Write has a read length and a write length, of data to be read | one length, that of the data to be written | [`WriteRequestRef`](crate::ads::WriteRequestRef) |
//! | E-44 | ASCII (`stream-en`, 3.2), CP1252 (both, 1) | ASCII in the data stream, CP1252 in all else | [`NcText`](crate::streaming::NcText), [`CncStr`](crate::CncStr) |
//!
//! # Data streaming
//!
//! | | `stream-en` says | here | steered by |
//! |---|---|---|---|
//! | E-29 | each line ends in CR LF (2.2, 4.1); the driver (5) can send a line without, or part of one | every line ends in CR LF, none is parted | [`NcText::new`](crate::streaming::NcText::new) for what is sent, [`StreamingInterface::read`](crate::streaming::StreamingInterface::read) for what came; [`WriteProgramStream`](crate::operation::WriteProgramStream) takes any bytes |
//! | E-43 | packets by read accesses (2.2), three first packets (2.3.6) | writes, in their order | [`Sender`](crate::streaming::Sender) |
//! | E-57 | a write is repeated if the CNC cannot take it now (4.2); the driver (5) repeats any, without end | after `Later` the same packet, as often as is asked for; after `Refused` none | [`Ack`](crate::streaming::Ack) |
//! | E-59 | 992 bytes a write (3.1); as long as is needed, a whole line at least (3.2) | 992 bytes, so that a line has at most 990 characters and CR LF | [`STREAM_PACKET_MAX`](crate::limits::STREAM_PACKET_MAX), [`NC_LINE_MAX`](crate::limits::NC_LINE_MAX) |
//! | E-64 | the channel two digits behind 0x201 (3.2), or added to 0x20100 (5); both editions of the ADS manual: added to 0x120100 | added, with the logical bit or without; channel 10 is 0x12010A or 0x2010A | [`WriteProgramStream`](crate::operation::WriteProgramStream) of [`Channel::new`](crate::address::Channel::new) or [`Channel::by_index`](crate::address::Channel::by_index) |
//! | E-65 | the object is read and written (3.2); only writing is described | it is written only | [`ReadObject::new`](crate::operation::ReadObject::new) refuses it; [`ReadRequest`](crate::ads::ReadRequest) does not |
//! | E-67 | `$BREAK` is not among the permitted words, but in the example, both 2.3.3 | permitted | `streaming::Findings`, with `alloc` |
//! | E-70 | behind a program end, wait until the interface is empty (2.2); nothing tells so | a client has to be told from outside; text behind an end is a finding | `streaming::FindingKind::BehindEnd`, [`StreamingInterface::is_empty`](crate::streaming::StreamingInterface::is_empty) of a CNC |
//! | E-71 | M17 and M29 end streaming (2.2), or a called subroutine, and the stream goes on (2.3.2) | each is taken for an end of the stream; a finding stops nothing | `streaming::ProgramEnd`, which a finding names |
//! | E-73 | 4094 bytes are the most of a stream (3.1), which goes on as long as it is written (2.1) | the most that is written and not read yet; a text may be longer | [`STREAM_MAX`](crate::limits::STREAM_MAX), [`StreamingInterface`](crate::streaming::StreamingInterface) |
//!
//! # Service Interface
//!
//! | | `service-en`, `service-de` 1.03 say | here | steered by |
//! |---|---|---|---|
//! | E-20 | both, 2: the program waits for RESPONSE, or for RESPONSE_STATE | RESPONSE_STATE | [`SysServiceWait::keep_waiting`](crate::service::SysServiceWait::keep_waiting) |
//! | E-21 | both, 2: the UUID of the example with a digit less in the NC program | refused | [`ServiceId`](crate::service::ServiceId) |
//! | E-35 | a response state must not be 0 (`service-en`), "in this example" (`service-de`) | a host refuses to answer 0; the interface takes it | [`Host::answer`](crate::service::Host::answer), [`ServiceInterface::write`](crate::service::ServiceInterface::write) |
//! | E-60 | both, 2: no length of UUID; the public help pages: 21 bytes for a STRING, 128 with an option | 128, as of the other texts, which is assumed | [`SERVICE_TEXT_MAX`](crate::limits::SERVICE_TEXT_MAX) |
//! | E-61 | both, 2: the service looks whether REQUEST_STATE is 0, or the interface does before it starts it | the service: a host reads it until it is not 0 | [`Host::poll`](crate::service::Host::poll) |
//! | E-62 | the cycle SysServiceWait is in `service-en` 3 alone | as there; without its parameters it is the wait of section 2 | [`SysServiceWait::default`](crate::service::SysServiceWait) |
//! | E-85 | both, 2: a service connects to SDA and COM; V.G variables are SDA's (both editions of the ADS manual, 3) | the five variables are read and written on 552 | [`FunctionSpec::task`](crate::operation::FunctionSpec::task), [`Call::port`](crate::operation::Call::port) |
//! | E-86 | `service-en`: waits while RESPONSE_STATE is @P1, any number (3); a request sets it to 0 (2) | with another @P1 than 0 the wait is over at once | [`SysServiceWait::keep_waiting`](crate::service::SysServiceWait::keep_waiting) |
//!
//! # No effect on the codec
//!
//! No byte and no answer here depends on these. The vectors have the examples.
//!
//! - Examples of `ads-en` and `ads-de`: E-03 (channels), E-09 (handles), E-10, E-18, E-37, E-38,
//!   E-54, E-89 (names), E-90 (NUL of a kind), E-91 (output of a read by name), E-14 (decimal
//!   sign), E-27 (contents of an array), E-28 (a missing index).
//! - Headings and names there: E-05 (column of attributes), E-41 (class of a query), E-48 (base),
//!   E-49 (name of the HLD).
//! - `stream-en`: E-19 (name of the parameter), E-92 (type of the stream), E-58 (local
//!   subroutines: a call is NC text like any other), E-66 (whether the object describes or writes), E-68 (planning across blocks), E-69
//!   (block search), E-72 (as what the program starts).
//! - The Service Interface: E-22, E-93 (comments), E-63 (heading of an example), E-94 (which program).
//!
//! # Not said at all
//!
//! Assumed, or left to the caller:
//!
//! | | here | steered by |
//! |---|---|---|
//! | bytes of a STRING value in a reply (VAR-22, VAR-25) | all there are: the text to its first NUL, and what is behind it | [`Element::String`](crate::Element::String), [`ValueRef::bytes`](crate::ValueRef::bytes) |
//! | bytes of each text in an array of STRING | the same share of all | [`Elements`](crate::value::Elements), [`ValueRef::bytes`](crate::ValueRef::bytes) |
//! | sign of BYTE, WORD, DWORD and LWORD | unsigned | [`ContentRef::get`](crate::ContentRef::get), of either sign |
//! | order of elements in more than one dimension (VAR-21) | the last index runs fastest | [`Elements::get`](crate::value::Elements::get), by places in any order |
//! | codes without a name (VAR-23) | kept as numbers | [`VariableType`](crate::VariableType), [`VariableAccess`](crate::VariableAccess), [`Validity`](crate::Validity) |
//! | which of SDA and GEO serves a class (ADR-10) | either | [`Call::port`](crate::operation::Call::port) |
//! | error numbers (ADS-7) | the server's choice | [`Refusal::ads_error`](crate::operation::Refusal::ads_error), [`AdsError`](crate::ads::AdsError) |
//! | how a full stream is told from one that refuses for good (STM-6) | the caller's choice | [`Ack`](crate::streaming::Ack) |
//! | whether the interface sets REQUEST_STATE to 0 itself (SVC-4) | it does, when RESPONSE_STATE is written | [`Clears`](crate::service::Clears) |
