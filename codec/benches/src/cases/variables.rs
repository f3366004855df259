//! The cases of the streams of variables.

use ads_cnc::layout::Stream;
use ads_cnc::*;

use super::stream::{Entry, stream};
use crate::hand::{self, HandWritten};

pub(super) const STREAMS: &[Entry] = &[
    stream!(
        "variable kind", VariableKind, VariableKindRef<'_>, by hand hand::Kind<&[u8]>,
        owned VariableKind, by hand hand::Kind<Vec<u8>>
    ),
    stream!("variable count", VariableCount, VariableCount, by hand hand::Number),
    stream!(
        "variable index and kind", VariableIndexKind,
        VariableIndexKindRef<'_>, by hand hand::IndexKind<&[u8]>,
        owned VariableIndexKind, by hand hand::IndexKind<Vec<u8>>
    ),
    stream!(
        "description", VariableDescription,
        DescriptionRef<'_>, by hand hand::Description<&[u8], &[u8]>,
        owned Description, by hand hand::Description<Vec<u8>, Vec<u32>>
    ),
    stream!(
        "variable name", VariableName, VariableNameRef<'_>, by hand hand::Name<&[u8]>,
        owned VariableName, by hand hand::Name<Vec<u8>>
    ),
    stream!("variable handle", VariableHandle, Handle, by hand hand::Number),
    stream!(
        "read by handle", VariableHandleRead, HandleReadRef<'_>, by hand hand::HandleRead<&[u8]>,
        owned HandleRead, by hand hand::HandleRead<Vec<u32>>
    ),
    stream!(
        "value", VariableValue, ValueRef<'_>, by hand hand::Bytes<&[u8], 0, 2048>,
        owned Value, by hand hand::Bytes<Vec<u8>, 0, 2048>
    ),
    stream!(
        "write by handle", VariableHandleWrite,
        HandleWriteRef<'_>, by hand hand::HandleWrite<&[u8], &[u8]>,
        owned HandleWrite, by hand hand::HandleWrite<Vec<u8>, Vec<u32>>
    ),
    stream!(
        "write by name", VariableNameWrite, NameWriteRef<'_>, by hand hand::NameWrite<&[u8]>,
        owned NameWrite, by hand hand::NameWrite<Vec<u8>>
    ),
    stream!(
        "extended description", VariableExtendedDescription,
        ExtendedReply, by hand hand::Extended
    ),
    stream!(
        "description by name", VariableDescriptionByName,
        DescriptionByNameRef<'_>, by hand hand::DescriptionByName<&[u8]>,
        owned DescriptionByName, by hand hand::DescriptionByName<Vec<u32>>
    ),
];
