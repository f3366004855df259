//! An object of the COM task, an element, a variable or a parameter.

use std::fmt;

use ads_cnc::address::{Attribute, AxisStride, Channel};
use ads_cnc::dynamic::DynamicKind;
use ads_cnc::value::DataType;
use ads_cnc::{CncString, Description, DescriptorRef, Handle, VariableAccess};

use super::{ValueAddress, ValueList};
use crate::gate::Entry;
use crate::values::Type;

/// An entry of a list, with the address of its value.
#[derive(Clone, Debug)]
pub struct ListedValue {
    pub list: ValueList,
    pub name: CncString,
    pub address: ValueAddress,
    pub ty: Type,
    /// The unit, if any.
    pub unit: Option<CncString>,
    pub access: ReportedAccess,
    /// The handle of a variable, if known; `None` for any other value.
    pub handle: Option<Handle>,
}

impl ListedValue {
    /// The object of the COM task with this descriptor.
    pub(crate) fn of_descriptor(list: ValueList, descriptor: DescriptorRef<'_>) -> Self {
        let (group, offset) = (descriptor.index_group(), descriptor.index_offset());
        Self {
            list,
            name: descriptor.name().into(),
            address: ValueAddress::Object { group, offset, size: descriptor.size() },
            ty: Type::of_content(descriptor.type_name(), descriptor.size()),
            unit: None,
            access: ReportedAccess::of_flag(descriptor.write_access().is_writable()),
            handle: None,
        }
    }

    /// The variable with this description.
    pub(crate) fn of_description(list: ValueList, channel: Channel, variable: Description) -> Self {
        let Description { var_type, dimensions, size, access, handle, name, .. } = variable;
        let name = name.text;
        Self {
            list,
            address: ValueAddress::Name { channel, name: name.clone() },
            name,
            ty: Type::of_variable(var_type, dimensions.as_slice().into(), size),
            unit: None,
            access: ReportedAccess::of_variable(access),
            handle: Some(handle),
        }
    }

    /// A dynamic parameter, which is a single number. No function for parameters writes one, so a P
    /// parameter is read-only. On some CNCs, V.L, V.P and V.S are also variables, so their access
    /// is unknown (VAR-18, VAR-19).
    pub(crate) fn of_parameter(channel: Channel, kind: DynamicKind, name: CncString) -> Self {
        Self {
            list: ValueList::Parameters { kind, channel: channel.number() },
            address: ValueAddress::Parameter { channel, kind, name: name.clone() },
            name,
            ty: Type::known(DataType::Real64, Vec::new()),
            unit: None,
            access: if kind == DynamicKind::P {
                ReportedAccess::Read
            } else {
                ReportedAccess::Unknown
            },
            handle: None,
        }
    }

    /// Size of the value in bytes; 0 if unknown.
    pub fn size(&self) -> u32 {
        self.ty.size.unwrap_or(0)
    }

    /// Whether the CNC describes the value as writable.
    pub fn is_writable(&self) -> bool {
        self.access == ReportedAccess::ReadWrite
    }

    pub(crate) fn is_text(&self) -> bool {
        self.ty.name == "STRING"
    }

    /// Whether the index offset of the content may belong to the axis with this index. The manuals
    /// contradict each other about the stride between the index offsets of two axes, so both
    /// strides are tried (ADR-8, E-01).
    pub(crate) fn is_of_axis(&self, index: u32) -> bool {
        let Some((_, offset)) = self.address.content() else { return false };
        let strides = [AxisStride::X1000, AxisStride::X10000];
        let mut split = strides.iter().filter_map(|&stride| offset.axis_and_element(stride).ok());
        split.any(|(axis, element)| axis == index && element > 0)
    }

    /// The entry in a file of `--allow-write` that allows writes to this value.
    pub fn entry(&self) -> Entry {
        let of_variable = |channel: Channel, axis| {
            let name = self.name.clone();
            Entry::Variable { channel, axis, name }
        };
        match self.address {
            ValueAddress::Object { group, offset, .. } => Entry::Content { group, offset },
            ValueAddress::Element { element, .. } => Entry::Content {
                group: element.group(Attribute::Content),
                offset: element.index_offset(),
            },
            ValueAddress::Axis { channel, axis, .. } => of_variable(channel, Some(axis)),
            ValueAddress::Handle { channel, .. }
            | ValueAddress::Name { channel, .. }
            | ValueAddress::Parameter { channel, .. } => of_variable(channel, None),
        }
    }
}

/// The access to a value, as stated in its descriptor, description or write flag.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ReportedAccess {
    /// The value may be read.
    Read,
    /// The value may be read and written.
    ReadWrite,
    /// A code that no manual documents.
    Code(u32),
    /// The CNC does not state the access.
    Unknown,
}

impl ReportedAccess {
    /// The access that a write flag states.
    pub const fn of_flag(writable: bool) -> Self {
        if writable { Self::ReadWrite } else { Self::Read }
    }

    /// The access that a variable's description states.
    pub const fn of_variable(access: VariableAccess) -> Self {
        match access {
            VariableAccess::READ_ONLY => Self::Read,
            VariableAccess::READ_WRITE => Self::ReadWrite,
            VariableAccess(code) => Self::Code(code),
        }
    }
}

impl fmt::Display for ReportedAccess {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Read => f.write_str("R"),
            Self::ReadWrite => f.write_str("RW"),
            Self::Code(code) => write!(f, "{code}"),
            Self::Unknown => Ok(()),
        }
    }
}
