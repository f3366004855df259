//! The function table.

use super::places::Place;
use super::{GroupRule, OffsetRule, Service, Task};
use crate::address::{Attribute, Class, IndexGroup, IndexOffset};
use crate::dynamic::DynamicKind;
use crate::layout::Stream;

/// What the table says of a function.
///
/// ```
/// use ads_cnc::layout::Stream;
/// use ads_cnc::operation::Function;
///
/// let spec = Function::DescribeByIndex.spec();
/// assert_eq!((spec.name, spec.section), ("variable description by index", "4.3.2"));
/// assert_eq!(spec.request, Some(Stream::VariableIndexKind));
/// assert_eq!(spec.reply, Some(Stream::VariableDescription));
/// assert!(!spec.is_content());
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct FunctionSpec {
    /// The function's name in reports.
    pub name: &'static str,
    /// Which ADS service it takes.
    pub service: Service,
    /// Which task serves it.
    pub task: Task,
    /// In which index groups.
    pub group: GroupRule,
    /// At which index offsets.
    pub offset: OffsetRule,
    /// What it does to the machine.
    pub effect: Effect,
    /// What goes in, if anything.
    pub request: Option<Stream>,
    /// What comes out, if anything.
    pub reply: Option<Stream>,
    /// The requirement that defines it.
    pub clause: &'static str,
    /// Section of `ads-en` 1.05 and of `ads-de` 1.051; another document is named.
    pub section: &'static str,
}

impl FunctionSpec {
    /// Whether the function is access to content, which is at any offset that no other function
    /// has (SDA-12).
    pub const fn is_content(&self) -> bool {
        matches!(self.request, Some(Stream::Content)) || matches!(self.reply, Some(Stream::Content))
    }
}

/// What a function does to the machine.
///
/// ```
/// use ads_cnc::operation::{Effect, Function};
///
/// assert_eq!(Function::ReadByName.spec().effect, Effect::Query);
/// assert_eq!(Function::WriteByName.spec().effect, Effect::Write);
/// assert_eq!(Function::WriteProgramStream.spec().effect, Effect::Motion);
/// assert!(Effect::Query < Effect::Write && Effect::Write < Effect::Motion);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Effect {
    /// Nothing.
    Query,
    /// Changes a value.
    Write,
    /// May move an axis.
    Motion,
}

/// Declares [`Function`] and the row of each.
macro_rules! functions {
    ($(
        $(#[$doc:meta])*
        $function:ident $name:literal: $service:ident $task:ident, $group:expr, $offset:expr,
            $effect:ident [$( $request:ident )?] to [$( $reply:ident )?], $clause:literal, $section:literal;
    )+) => {
        /// A documented function.
        ///
        /// The manual's section of each is in its [row](FunctionSpec::section).
        ///
        /// ```
        /// use ads_cnc::operation::{Function, Service, Task};
        ///
        /// let spec = Function::HandleByName.spec();
        /// assert_eq!((spec.task, spec.service), (Task::Sda, Service::ReadWrite));
        /// let writes = Function::ALL.iter().filter(|it| it.spec().service == Service::Write);
        /// assert_eq!(writes.count(), 6);
        /// ```
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        #[non_exhaustive]
        pub enum Function { $( $(#[$doc])* $function, )+ }

        impl Function {
            /// All of them.
            pub const ALL: &'static [Self] = &[$( Self::$function, )+];

            /// The function's row.
            pub const fn spec(self) -> &'static FunctionSpec {
                match self { $(
                    Self::$function => const { &FunctionSpec {
                        name: $name,
                        service: Service::$service,
                        task: Task::$task,
                        group: $group,
                        offset: $offset,
                        effect: Effect::$effect,
                        request: functions!(@stream $( $request )?),
                        reply: functions!(@stream $( $reply )?),
                        clause: $clause,
                        section: $section,
                    } },
                )+ }
            }
        }
    };
    (@stream $stream:ident) => { Some(Stream::$stream) };
    (@stream) => { None };
}

const DECODER: GroupRule = GroupRule::ChannelOf(Class::Decoder);

const fn at(offset: u32) -> OffsetRule {
    OffsetRule::At(offset)
}

const ANY: OffsetRule = OffsetRule::From(0);

functions! {
    /// Number of objects of a COM list.
    CountObjects "number of objects": Read Com, GroupRule::ComObjects, at(0),
        Query [] to [ObjectCount], "COM-1", "2.1.1";
    /// Descriptors of objects of a COM list.
    ReadDescriptors "object descriptors": Read Com, GroupRule::ComObjects, OffsetRule::From(1),
        Query [] to [ObjectDescriptors], "COM-2", "2.1.1";
    /// Number of variable elements, 0x44.
    CountVariables "number of variable elements": ReadWrite Sda, DECODER, at(0x44),
        Query [VariableKind] to [VariableCount], "VAR-2", "4.3.1";
    /// Variable description by index, 0x45.
    DescribeByIndex "variable description by index": ReadWrite Sda, DECODER, at(0x45),
        Query [VariableIndexKind] to [VariableDescription], "VAR-4", "4.3.2";
    /// Variable handle by name, 0x46.
    HandleByName "variable handle by name": ReadWrite Sda, DECODER, at(0x46),
        Query [VariableName] to [VariableHandle], "VAR-10", "4.3.3";
    /// Read variable value by handle, 0x47.
    ReadByHandle "read variable value by handle": ReadWrite Sda, DECODER, at(0x47),
        Query [VariableHandleRead] to [VariableValue], "VAR-11", "4.3.4";
    /// Read variable value by name, 0x48.
    ReadByName "read variable value by name": ReadWrite Sda, DECODER, at(0x48),
        Query [VariableName] to [VariableValue], "VAR-14", "4.3.5";
    /// Write variable value by handle, 0x49.
    WriteByHandle "write variable value by handle": Write Sda, DECODER, at(0x49),
        Write [VariableHandleWrite] to [], "VAR-12", "4.3.6";
    /// Write variable value by name, 0x4A.
    WriteByName "write variable value by name": Write Sda, DECODER, at(0x4A),
        Write [VariableNameWrite] to [], "VAR-13", "4.3.7";
    /// Extended variable description by index, 0x4B.
    DescribeExtended "extended variable description by index": ReadWrite Sda, DECODER, at(0x4B),
        Query [VariableIndexKind] to [VariableExtendedDescription], "VAR-15", "4.3.8";
    /// Variable description by name, 0x4C, documented online only.
    DescribeByName "variable description by name": ReadWrite Sda, DECODER, at(0x4C),
        Query [VariableName] to [VariableDescriptionByName], "VAR-28", "online";
    /// Variable handle by name, on the axis interface, 0x4.
    AxisHandleByName "axis variable handle by name": ReadWrite Sda, DECODER, OffsetRule::OfAxis(4),
        Query [VariableName] to [VariableHandle], "VAR-26", "4.3.9";
    /// Read variable value by name, on the axis interface, 0x5.
    AxisReadByName "read axis variable value by name": ReadWrite Sda, DECODER, OffsetRule::OfAxis(5),
        Query [VariableName] to [VariableValue], "VAR-26", "4.3.10";
    /// Write variable value by name, on the axis interface, 0x6.
    AxisWriteByName "write axis variable value by name": Write Sda, DECODER, OffsetRule::OfAxis(6),
        Write [VariableNameWrite] to [], "VAR-26", "4.3.11";
    /// Number of dynamic parameters of a kind.
    CountDynamic "number of dynamic parameters": Read Sda, DECODER,
        OffsetRule::OfKind(DynamicKind::COUNT),
        Query [] to [DynamicCount], "DYN-1", "3.1 … 3.4";
    /// Name of a dynamic parameter by its index.
    DynamicNameByIndex "dynamic parameter name by index": ReadWrite Sda, DECODER,
        OffsetRule::OfKind(DynamicKind::NAME_BY_INDEX),
        Query [DynamicIndex] to [DynamicName], "DYN-2", "3.1 … 3.4";
    /// Value of a dynamic parameter by its name.
    DynamicValueByName "dynamic parameter value by name": ReadWrite Sda, DECODER,
        OffsetRule::OfKind(DynamicKind::VALUE_BY_NAME),
        Query [DynamicNameRequest] to [DynamicValue], "DYN-3", "3.1 … 3.4";
    /// Value of a dynamic parameter by its index.
    DynamicValueByIndex "dynamic parameter value by index": ReadWrite Sda, DECODER,
        OffsetRule::OfKind(DynamicKind::VALUE_BY_INDEX),
        Query [DynamicIndex] to [DynamicValue], "DYN-4", "3.1 … 3.4";
    /// Address of an instance of a class.
    FindInstance "object address": ReadWrite Sda, GroupRule::Instances, at(0),
        Query [ObjectAddressQuery] to [ObjectAddress], "SDA-1", "2.2.2";
    /// Number of element types of an instance.
    CountElements "number of element types": Read Sda, GroupRule::Elements(Attribute::Content),
        OffsetRule::FirstElement,
        Query [] to [ElementCount], "SDA-4", "2.2.2";
    /// Content of an element.
    ReadElement "element content": Read Sda, GroupRule::Elements(Attribute::Content), ANY,
        Query [] to [Content], "SDA-4", "2.2.2";
    /// Writes the content of an element.
    WriteElement "write element content": Write Sda, GroupRule::Elements(Attribute::Content), ANY,
        Motion [Content] to [], "SDA-9", "2.2.2";
    /// Name of an element.
    ReadElementName "element name": Read Sda, GroupRule::Elements(Attribute::Name), ANY,
        Query [] to [ElementText], "SDA-6", "2.2.2";
    /// Type of an element.
    ReadElementType "element type": Read Sda, GroupRule::Elements(Attribute::Type), ANY,
        Query [] to [ElementText], "SDA-7", "2.2.2";
    /// Length of an element's content.
    ReadElementLength "element length": Read Sda, GroupRule::Elements(Attribute::Length), ANY,
        Query [] to [ElementLength], "SDA-8", "2.2.2";
    /// Unit of an element.
    ReadElementUnit "element unit": Read Sda, GroupRule::Elements(Attribute::Unit), ANY,
        Query [] to [ElementText], "SDA-6", "2.2.2";
    /// Write flag of an element.
    ReadElementWriteFlag "element write flag": Read Sda, GroupRule::Elements(Attribute::WriteFlag),
        ANY,
        Query [] to [ElementWriteFlag], "SDA-9", "2.2.2";
    /// Writes NC text to the stream of a channel.
    WriteProgramStream "data streaming": Write Com, GroupRule::ComChannel, at(0x90),
        Motion [ProgramStream] to [], "STM-1", "stream-en 3.2";
    /// Content of a COM object.
    ReadObject "object content": Read Com, GroupRule::ComContent, ANY,
        Query [] to [Content], "COM-5", "2.1.2";
    /// Writes the content of a COM object.
    WriteObject "write object content": Write Com, GroupRule::ComContent, ANY,
        Motion [Content] to [], "COM-5", "2.1.2";
}

impl Function {
    /// The function whose address this is; none for content (SDA-12).
    pub(crate) fn at(task: Task, group: IndexGroup, offset: IndexOffset) -> Option<Self> {
        Place::of(task.port(), group, offset).function()
    }
}
