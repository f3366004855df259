//! The function table.

use core::fmt;

use crate::address::AxisStride;
use crate::address::{
    Access, Addressing, Attribute, Class, ComTable, Group, IndexGroup, IndexOffset,
};
use crate::ads::{AmsPort, Command};
use crate::layout::Stream;

/// A documented function.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Function {
    /// Number of objects of a COM list.
    CountObjects,
    /// Descriptors of objects of a COM list.
    ReadDescriptors,
    /// Number of variable elements, 0x44.
    CountVariables,
    /// Variable description by index, 0x45.
    DescribeByIndex,
    /// Variable handle by name, 0x46.
    HandleByName,
    /// Read variable value by handle, 0x47.
    ReadByHandle,
    /// Read variable value by name, 0x48.
    ReadByName,
    /// Write variable value by handle, 0x49.
    WriteByHandle,
    /// Write variable value by name, 0x4A.
    WriteByName,
    /// Extended variable description by index, 0x4B.
    DescribeExtended,
    /// Variable handle by name, on the axis interface, 0x4.
    AxisHandleByName,
    /// Read variable value by name, on the axis interface, 0x5.
    AxisReadByName,
    /// Write variable value by name, on the axis interface, 0x6.
    AxisWriteByName,
}

/// What the table says of a function.
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
    /// Section of `ads-en` 1.05 and of `ads-de` 1.051.
    pub section: &'static str,
}

/// An ADS service.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Service {
    /// ADS Read.
    Read,
    /// ADS Write.
    Write,
    /// ADS ReadWrite.
    ReadWrite,
}

impl Service {
    /// The AMS command that carries it.
    pub const fn command(self) -> Command {
        match self {
            Self::Read => Command::READ,
            Self::Write => Command::WRITE,
            Self::ReadWrite => Command::READ_WRITE,
        }
    }
}

impl fmt::Display for Service {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(self, f)
    }
}

/// A task of the CNC, each with its AMS port (GEN-4).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Task {
    /// Port 551.
    Geo,
    /// Port 552.
    Sda,
    /// Port 553.
    Com,
}

impl Task {
    /// The task's port.
    pub const fn port(self) -> AmsPort {
        match self {
            Self::Geo => AmsPort::GEO,
            Self::Sda => AmsPort::SDA,
            Self::Com => AmsPort::COM,
        }
    }

    /// The task behind a port.
    pub fn from_port(port: AmsPort) -> Option<Self> {
        [Self::Geo, Self::Sda, Self::Com].into_iter().find(|task| task.port() == port)
    }
}

/// What a function does to the machine.
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

/// The index groups of a function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum GroupRule {
    /// COM with object access, of the platform, a channel or a platform axis.
    ComObjects,
    /// The content of a class, of a channel.
    ChannelOf(Class),
}

impl GroupRule {
    /// Whether the function has an instance in this group.
    pub fn holds(self, group: Group) -> bool {
        match (self, group) {
            (Self::ComObjects, Group::Com(com)) => {
                // Platform axes are counted from 1.
                com.access == Access::Object && (com.table == ComTable::Channel || com.instance > 0)
            }
            (Self::ChannelOf(class), Group::Class(parts)) => {
                parts.class == class && parts.attribute == Attribute::Content && parts.instance > 0
            }
            _ => false,
        }
    }

    /// The group of the first channel, as the manuals print it.
    pub fn example(self) -> IndexGroup {
        match self {
            Self::ComObjects => IndexGroup::new(0x13_0101),
            Self::ChannelOf(class) => {
                let addressing = match class {
                    Class::Spindle => Addressing::Index,
                    _ => Addressing::Logical,
                };
                let parts = crate::address::ClassGroup {
                    addressing,
                    class,
                    attribute: Attribute::Content,
                    instance: 1,
                };
                parts.index_group()
            }
        }
    }
}

/// The index offsets of a function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum OffsetRule {
    /// This one.
    At(u32),
    /// Every one from here on.
    From(u32),
    /// This element of every axis from 1 on, 0x10000 apart (VAR-26).
    OfAxis(u32),
}

impl OffsetRule {
    /// Whether the function has this offset.
    pub const fn holds(self, offset: IndexOffset) -> bool {
        match self {
            Self::At(at) => offset.get() == at,
            Self::From(first) => offset.get() >= first,
            Self::OfAxis(element) => match offset.axis_and_element(AxisStride::X10000) {
                Ok((axis, found)) => axis > 0 && found == element,
                Err(_) => false,
            },
        }
    }
}

/// A function of the channel interface: ReadWrite on the decoder, a query.
const fn channel_interface(
    name: &'static str,
    offset: u32,
    request: Stream,
    reply: Stream,
    clause: &'static str,
    section: &'static str,
) -> FunctionSpec {
    FunctionSpec {
        name,
        service: Service::ReadWrite,
        task: Task::Sda,
        group: GroupRule::ChannelOf(Class::Decoder),
        offset: OffsetRule::At(offset),
        effect: Effect::Query,
        request: Some(request),
        reply: Some(reply),
        clause,
        section,
    }
}

/// A write of the channel or axis interface.
const fn writes(
    name: &'static str,
    offset: OffsetRule,
    request: Stream,
    clause: &'static str,
    section: &'static str,
) -> FunctionSpec {
    FunctionSpec {
        service: Service::Write,
        offset,
        effect: Effect::Write,
        reply: None,
        ..channel_interface(name, 0, request, Stream::NoData, clause, section)
    }
}

/// A function of the axis interface: as that of the channel interface, for one axis.
const fn axis_interface(
    name: &'static str,
    element: u32,
    reply: Stream,
    clause: &'static str,
    section: &'static str,
) -> FunctionSpec {
    FunctionSpec {
        offset: OffsetRule::OfAxis(element),
        ..channel_interface(name, 0, Stream::VariableName, reply, clause, section)
    }
}

/// A function of object access: Read on COM, a query.
const fn object_access(
    name: &'static str,
    offset: OffsetRule,
    reply: Stream,
    clause: &'static str,
) -> FunctionSpec {
    FunctionSpec {
        name,
        service: Service::Read,
        task: Task::Com,
        group: GroupRule::ComObjects,
        offset,
        effect: Effect::Query,
        request: None,
        reply: Some(reply),
        clause,
        section: "2.1.1",
    }
}

impl Function {
    /// All of them.
    pub const ALL: &'static [Self] = &[
        Self::CountObjects,
        Self::ReadDescriptors,
        Self::CountVariables,
        Self::DescribeByIndex,
        Self::HandleByName,
        Self::ReadByHandle,
        Self::ReadByName,
        Self::WriteByHandle,
        Self::WriteByName,
        Self::DescribeExtended,
        Self::AxisHandleByName,
        Self::AxisReadByName,
        Self::AxisWriteByName,
    ];

    /// The function's row.
    pub const fn spec(self) -> &'static FunctionSpec {
        use Stream as S;
        match self {
            Self::CountObjects => {
                const { &object_access("number of objects", OffsetRule::At(0), S::ObjectCount, "COM-1") }
            }
            Self::ReadDescriptors => {
                const {
                    &object_access(
                        "object descriptors",
                        OffsetRule::From(1),
                        S::ObjectDescriptors,
                        "COM-2",
                    )
                }
            }
            Self::CountVariables => {
                const {
                    &channel_interface(
                        "number of variable elements",
                        0x44,
                        S::VariableKind,
                        S::VariableCount,
                        "VAR-2",
                        "4.3.1",
                    )
                }
            }
            Self::DescribeByIndex => {
                const {
                    &channel_interface(
                        "variable description by index",
                        0x45,
                        S::VariableIndexKind,
                        S::VariableDescription,
                        "VAR-4",
                        "4.3.2",
                    )
                }
            }
            Self::HandleByName => {
                const {
                    &channel_interface(
                        "variable handle by name",
                        0x46,
                        S::VariableName,
                        S::VariableHandle,
                        "VAR-10",
                        "4.3.3",
                    )
                }
            }
            Self::ReadByHandle => {
                const {
                    &channel_interface(
                        "read variable value by handle",
                        0x47,
                        S::VariableHandleRead,
                        S::VariableValue,
                        "VAR-11",
                        "4.3.4",
                    )
                }
            }
            Self::ReadByName => {
                const {
                    &channel_interface(
                        "read variable value by name",
                        0x48,
                        S::VariableName,
                        S::VariableValue,
                        "VAR-14",
                        "4.3.5",
                    )
                }
            }
            Self::WriteByHandle => {
                const {
                    &writes(
                        "write variable value by handle",
                        OffsetRule::At(0x49),
                        S::VariableHandleWrite,
                        "VAR-12",
                        "4.3.6",
                    )
                }
            }
            Self::WriteByName => {
                const {
                    &writes(
                        "write variable value by name",
                        OffsetRule::At(0x4A),
                        S::VariableNameWrite,
                        "VAR-13",
                        "4.3.7",
                    )
                }
            }
            Self::DescribeExtended => {
                const {
                    &channel_interface(
                        "extended variable description by index",
                        0x4B,
                        S::VariableIndexKind,
                        S::VariableExtendedDescription,
                        "VAR-15",
                        "4.3.8",
                    )
                }
            }
            Self::AxisHandleByName => {
                const {
                    &axis_interface(
                        "axis variable handle by name",
                        4,
                        S::VariableHandle,
                        "VAR-26",
                        "4.3.9",
                    )
                }
            }
            Self::AxisReadByName => {
                const {
                    &axis_interface(
                        "read axis variable value by name",
                        5,
                        S::VariableValue,
                        "VAR-26",
                        "4.3.10",
                    )
                }
            }
            Self::AxisWriteByName => {
                const {
                    &writes(
                        "write axis variable value by name",
                        OffsetRule::OfAxis(6),
                        S::VariableNameWrite,
                        "VAR-26",
                        "4.3.11",
                    )
                }
            }
        }
    }
}
