//! The function table: one row for each function. Macros generate the type of an operation, its
//! implementation of [`Operation`] and its dispatch from its row.
//!
//! A row contains the function, its name in reports, ADS service, task, effect, index groups, index
//! offsets, requirement and section. The origin of the constructor follows, then the parts of the
//! address and, after `;`, the fields of the request, with their [`field!`] kinds. The last parts
//! are the stream of the request, built from these fields, and the type of the reply. A row of a
//! Read has no fields and no stream of a request.
//!
//! - `plain`: the constructor is generated and cannot fail; `checked`: the constructor is generated
//!   and can fail; `by_hand`: the constructor is in `by_hand.rs`.
//! - `asks 2048`: the read length, in a row whose read length is a constant other than the maximum
//!   length of the reply.
//! - `sized length`: the constructor computes the read length from its arguments.
//!
//! Dispatch tries the rows whose task, index groups and index offsets match the call, in the order
//! of the table. If the service of a row is that of the call, dispatch selects the row. Otherwise,
//! after a row of access to content it tries the next row, and at any other row it rejects the
//! call. Access to content matches every offset of its groups, so its rows follow the other
//! functions of these groups (SDA-12).

use core::fmt;

use super::address::Address;
use super::docs::documented;
use super::table::functions;
use super::typed::{Parts, call, field, operation, sealed};
use super::{
    AdsService, Call, DispatchError, Effect, FunctionSpec, GroupRule, IntoName, ObjectList,
    OffsetRule, Operation, Reply, Task, WriteValue,
};
use crate::address::{
    Attribute, Channel, ChannelAxis, Class, ClassGroup, ComGroup, ElementAddress, Group,
    IndexGroup, IndexOffset,
};
use crate::com::{DescriptorsRef, ObjectCount};
use crate::content::ContentRef;
use crate::dynamic::{
    DynamicCount, DynamicIndex, DynamicKind, DynamicNameRef, DynamicNameRequestRef, DynamicValue,
};
use crate::error::Error;
use crate::layout::Stream;
use crate::sda::{
    ElementCount, ElementLength, ElementTextRef, ElementWriteFlag, ObjectAddress,
    ObjectAddressQuery,
};
use crate::stream::{Decode, Encode, NoData};
use crate::streaming::ProgramStreamRef;
use crate::text::{CncStr, TextRef};
use crate::variable::{
    DescriptionByNameRef, DescriptionRef, ExtendedReply, Handle, HandleReadRef, HandleWriteRef,
    Kind, NameWriteRef, U32List, ValueRef, VariableCount, VariableIndexKindRef, VariableKindRef,
    VariableNameRef,
};

use Attribute::{Content, Length, Name, Type, Unit, WriteFlag};
use Class::Decoder;
use GroupRule::{ChannelOf, ComChannel, ComContent, ComObjects, Elements, Instances};
use OffsetRule::{At, AtLeast, FirstElement, OfAxis, OfKind};

functions! {
    CountObjects "number of objects": Read Com Query, ComObjects, At(0), "COM-1", "2.1.1",
        plain(list: List) => ObjectCount;
    ReadDescriptors "object descriptors": Read Com Query, ComObjects, AtLeast(1), "COM-2", "2.1.1",
        by_hand(list: List, first: Number) => DescriptorsRef<'r>, sized length;
    CountVariables<'a> "number of variable elements": ReadWrite Sda Query, ChannelOf(Decoder), At(0x44), "VAR-2", "4.3.1",
        plain(channel: Channel; kind: Kind) VariableKindRef { kind } => VariableCount;
    DescribeByIndex<'a> "variable description by index": ReadWrite Sda Query, ChannelOf(Decoder), At(0x45), "VAR-4", "4.3.2",
        plain(channel: Channel; index: Index, kind: Kind) VariableIndexKindRef { index, kind } => DescriptionRef<'r>;
    HandleByName<'a> "variable handle by name": ReadWrite Sda Query, ChannelOf(Decoder), At(0x46), "VAR-10", "4.3.3",
        checked(channel: Channel; name: Name) VariableNameRef { name } => Handle;
    ReadByHandle<'a> "read variable value by handle": ReadWrite Sda Query, ChannelOf(Decoder), At(0x47), "VAR-11", "4.3.4",
        plain(channel: Channel; handle: Handle, indices: Indices) HandleReadRef { handle, indices } => ValueRef<'r>;
    ReadByName<'a> "read variable value by name": ReadWrite Sda Query, ChannelOf(Decoder), At(0x48), "VAR-14", "4.3.5",
        checked(channel: Channel; name: Name) VariableNameRef { name } => ValueRef<'r>;
    WriteByHandle<'a> "write variable value by handle": Write Sda Write, ChannelOf(Decoder), At(0x49), "VAR-12", "4.3.6",
        plain(channel: Channel; handle: Handle, indices: Indices, value: Value) HandleWriteRef { handle, indices, value } => NoData;
    WriteByName<'a> "write variable value by name": Write Sda Write, ChannelOf(Decoder), At(0x4A), "VAR-13", "4.3.7",
        checked(channel: Channel; name: CStringPrefix, value: Value) NameWriteRef { name, value } => NoData;
    DescribeExtended<'a> "extended variable description by index": ReadWrite Sda Query, ChannelOf(Decoder), At(0x4B), "VAR-15", "4.3.8",
        plain(channel: Channel; index: Index, kind: Kind) VariableIndexKindRef { index, kind } => ExtendedReply, asks 2048;
    DescribeByName<'a> "variable description by name": ReadWrite Sda Query, ChannelOf(Decoder), At(0x4C), "VAR-28", "online",
        checked(channel: Channel; name: Name) VariableNameRef { name } => DescriptionByNameRef<'r>;
    AxisHandleByName<'a> "axis variable handle by name": ReadWrite Sda Query, ChannelOf(Decoder), OfAxis(4), "VAR-26", "4.3.9",
        checked(channel: Channel, axis: Axis; name: Name) VariableNameRef { name } => Handle;
    AxisReadByName<'a> "read axis variable value by name": ReadWrite Sda Query, ChannelOf(Decoder), OfAxis(5), "VAR-26", "4.3.10",
        checked(channel: Channel, axis: Axis; name: Name) VariableNameRef { name } => ValueRef<'r>;
    AxisWriteByName<'a> "write axis variable value by name": Write Sda Write, ChannelOf(Decoder), OfAxis(6), "VAR-26", "4.3.11",
        checked(channel: Channel, axis: Axis; name: CStringPrefix, value: Value) NameWriteRef { name, value } => NoData;
    CountDynamic "number of dynamic parameters": Read Sda Query, ChannelOf(Decoder), OfKind([0x02, 0x03, 0x04, 0x05]), "DYN-1", "3.1 … 3.4",
        plain(channel: Channel, kind: Parameters) => DynamicCount;
    DynamicNameByIndex "dynamic parameter name by index": ReadWrite Sda Query, ChannelOf(Decoder), OfKind([0x1B, 0x1E, 0x21, 0x24]), "DYN-2", "3.1 … 3.4",
        checked(channel: Channel, kind: Parameters; index: NonZero) DynamicIndex(index) => DynamicNameRef<'r>;
    DynamicValueByName<'a> "dynamic parameter value by name": ReadWrite Sda Query, ChannelOf(Decoder), OfKind([0x1C, 0x1F, 0x22, 0x25]), "DYN-3", "3.1 … 3.4",
        checked(channel: Channel, kind: Parameters; name: Name) DynamicNameRequestRef { name } => DynamicValue;
    DynamicValueByIndex "dynamic parameter value by index": ReadWrite Sda Query, ChannelOf(Decoder), OfKind([0x1D, 0x20, 0x23, 0x26]), "DYN-4", "3.1 … 3.4",
        checked(channel: Channel, kind: Parameters; index: NonZero) DynamicIndex(index) => DynamicValue;
    FindInstance "object address": ReadWrite Sda Query, Instances, At(0), "SDA-1", "2.2.2",
        by_hand(class: Class; channel: Number, axis: Number) ObjectAddressQuery { channel, axis } => ObjectAddress;
    CountElements "number of element types": Read Sda Query, Elements(Content), FirstElement, "SDA-4", "2.2.2",
        by_hand(element: Element) => ElementCount;
    ReadElement "element content": Read Sda Query, Elements(Content), AtLeast(0), "SDA-4", "2.2.2",
        by_hand(element: Element) => ContentRef<'r>, sized length;
    WriteElement<'a> "write element content": Write Sda Motion, Elements(Content), AtLeast(0), "SDA-9", "2.2.2",
        by_hand(element: Element; content: Value) ContentRef { bytes: content } => NoData;
    ReadElementName "element name": Read Sda Query, Elements(Name), AtLeast(0), "SDA-6", "2.2.2",
        plain(element: Element) => ElementTextRef<'r>;
    ReadElementType "element type": Read Sda Query, Elements(Type), AtLeast(0), "SDA-7", "2.2.2",
        plain(element: Element) => ElementTextRef<'r>;
    ReadElementLength "element length": Read Sda Query, Elements(Length), AtLeast(0), "SDA-8", "2.2.2",
        plain(element: Element) => ElementLength;
    ReadElementUnit "element unit": Read Sda Query, Elements(Unit), AtLeast(0), "SDA-6", "2.2.2",
        plain(element: Element) => ElementTextRef<'r>;
    ReadElementWriteFlag "element write flag": Read Sda Query, Elements(WriteFlag), AtLeast(0), "SDA-9", "2.2.2",
        plain(element: Element) => ElementWriteFlag;
    WriteProgramStream<'a> "data streaming": Write Com Motion, ComChannel, At(0x90), "STM-1", "stream-en 3.2",
        plain(channel: Channel; packet: Lines) ProgramStreamRef { bytes: packet } => NoData;
    ReadObject "object content": Read Com Query, ComContent, AtLeast(0), "COM-5", "2.1.2",
        by_hand(object: Object) => ContentRef<'r>, sized length;
    WriteObject<'a> "write object content": Write Com Motion, ComContent, AtLeast(0), "COM-5", "2.1.2",
        by_hand(object: Object; content: Value) ContentRef { bytes: content } => NoData;
}

/// Displays the [name](FunctionSpec::name) of the function.
impl fmt::Display for Function {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.spec().name)
    }
}

impl Function {
    /// The function at this address, except access to content (SDA-12); `None` for any other address.
    pub(super) fn at(task: Task, group: IndexGroup, offset: IndexOffset) -> Option<Self> {
        let group = group.parts()?;
        Self::ALL.iter().copied().find(|function| {
            let spec = function.spec();
            !spec.is_content() && spec.is_in(task, group) && spec.offset.contains(offset)
        })
    }
}
