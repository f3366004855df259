//! The sections of the manuals, and the modules and types that implement them. This module has no items.
//!
//! `ads-en` and `ads-de` are the English and the German edition of the manual "TF5200, ADS Access
//! on CNC"; `stream-en` is the manual "TF5200, Data streaming"; `service-en` and `service-de` are
//! the English and the German manual of the Service Interface.
//!
//! | manual (`ads-en` 1.05, `ads-de` 1.051) | implemented by |
//! |---|---|
//! | 1, code page | [`CncStr`](crate::CncStr), [`text`](crate::text) |
//! | 1, tasks and their ports | [`operation::Task`](crate::operation::Task), [`ads::AmsPort`](crate::ads::AmsPort) |
//! | 1, axes and spindles, base addresses | [`address`](crate::address) |
//! | 1, list of static objects | see 2.1.1 and 2.2.2 |
//! | 2, index groups and offsets | [`address`](crate::address) |
//! | 2.1, instances of the COM task | [`address::ComGroup`](crate::address::ComGroup), [`operation::ObjectList`](crate::operation::ObjectList) |
//! | 2.1.1, object descriptors | [`ObjectCount`](crate::ObjectCount), [`DescriptorRef`](crate::DescriptorRef), [`DescriptorsRef`](crate::DescriptorsRef) |
//! | 2.1.2, content | [`ContentRef`](crate::ContentRef) |
//! | 2.2.1, classes and attributes | [`address`](crate::address), [`sda`](crate::sda) |
//! | 2.2.2, instances and elements | [`sda`](crate::sda) |
//! | 3, 3.1 … 3.4, dynamic parameters | [`dynamic`](crate::dynamic) |
//! | 4, 4.1, kinds of variables, by edition and version | [`Kind`](crate::Kind) |
//! | 4.1, names of variables | [`VariablePath`](crate::VariablePath) |
//! | 4.2.1, 4.2.2, the interfaces of channel and axis | [`operation::Function`](crate::operation::Function), [`address::ChannelAxis`](crate::address::ChannelAxis) |
//! | 4.2.1, 0x4C, which the manual reserves and the public help pages document | [`VariableNameRef`](crate::VariableNameRef), [`DescriptionByNameRef`](crate::DescriptionByNameRef) |
//! | 4.3, streams | [`layout`](crate::layout), [`Decode`](crate::Decode), [`Encode`](crate::Encode) |
//! | 4.3.1, number of variables | [`VariableKindRef`](crate::VariableKindRef), [`VariableCount`](crate::VariableCount) |
//! | 4.3.2, description | [`VariableIndexKindRef`](crate::VariableIndexKindRef), [`DescriptionRef`](crate::DescriptionRef) |
//! | 4.3.3, handle by name | [`VariableNameRef`](crate::VariableNameRef), [`Handle`](crate::Handle) |
//! | 4.3.4, read by handle | [`HandleReadRef`](crate::HandleReadRef), [`ValueRef`](crate::ValueRef) |
//! | 4.3.5, read by name | [`VariableNameRef`](crate::VariableNameRef), [`ValueRef`](crate::ValueRef) |
//! | 4.3.6, write by handle | [`HandleWriteRef`](crate::HandleWriteRef) |
//! | 4.3.7, write by name | [`NameWriteRef`](crate::NameWriteRef) |
//! | 4.3.4 … 4.3.7, values by their types | [`value`](crate::value) |
//! | 4.3.8, extended description | [`VariableIndexKindRef`](crate::VariableIndexKindRef), [`ExtendedReply`](crate::ExtendedReply) |
//! | 4.3.9, handle by name, of an axis | [`operation::AxisHandleByName`](crate::operation::AxisHandleByName) |
//! | 4.3.10, read by name, of an axis | [`operation::AxisReadByName`](crate::operation::AxisReadByName) |
//! | 4.3.11, write by name, of an axis | [`operation::AxisWriteByName`](crate::operation::AxisWriteByName) |
//! | 5, ADS services | [`ads`](crate::ads) |
//!
//! The sections have the same numbers in both editions. The other manuals:
//!
//! | manual | implemented by |
//! |---|---|
//! | `stream-en` 2.1, 2.2, data streaming | [`streaming`](crate::streaming) |
//! | 2.3.3, 2.3.4, 2.3.6, loops, comments, jumps | `streaming::Diagnostics`, with `alloc` |
//! | 2.3.1, 2.3.2, 2.3.5, 2.3.7, flushing, subroutines, block search, contours | transferred like any other NC text |
//! | 3, parameters and object | [`limits`](crate::limits), [`streaming::OBJECT_NAME`](crate::streaming::OBJECT_NAME), [`streaming::ProgramStreamRef`](crate::streaming::ProgramStreamRef) |
//! | 4.1, line ends | [`streaming::check_line_ends`](crate::streaming::check_line_ends) |
//! | 4.2, 5, transfer and example | [`streaming::Sender`](crate::streaming::Sender), [`operation::WriteProgramStream`](crate::operation::WriteProgramStream) |
//! | `service-en`, `service-de` 1.03: 1, required versions | [`service`](crate::service) |
//! | 2, variables and process | [`service`](crate::service) |
