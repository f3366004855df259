//! `Arbitrary` for the owned readings: values that a stream can hold, so that each encodes.

use alloc::vec::Vec;

use arbitrary::{Arbitrary, Result, Unstructured};

use crate::address::{IndexGroup, IndexOffset};
use crate::ads::{
    AdsError, AmsAddr, AmsHeader, AmsNetId, AmsPort, ReadReply, ReadRequest, ReadWriteReply,
    ReadWriteRequest, WriteRequest,
};
use crate::bytes::{to_len, to_u32};
use crate::dynamic::{DynamicIndex, DynamicName, DynamicNameRequest};
use crate::limits::{
    ADS_DATA_MAX, DESCRIPTOR_LEN, DYNAMIC_NAME_MAX, INDICES_MAX, NAMELESS_DIMENSIONS_MAX,
    STREAM_PACKET_MAX, TEXT_MAX, VARIABLE_MAX,
};
use crate::sda::ElementText;
use crate::streaming::ProgramStream;
use crate::text::{CncStr, CncString, Text};
use crate::value::{DataType, Elements, Values};
use crate::{
    Content, Description, DescriptionByName, Descriptor, Descriptors, HandleRead, HandleWrite,
    NameWrite, Numbers, Value, VariableIndexKind, VariableKind, VariableName,
};

/// At most `max` of anything.
fn up_to<'a, T: Arbitrary<'a>>(u: &mut Unstructured<'a>, max: usize) -> Result<Vec<T>> {
    let len = u.arbitrary_len::<T>()?.min(max);
    (0..len).map(|_| u.arbitrary()).collect()
}

/// At most `max` bytes of text.
fn text(u: &mut Unstructured<'_>, max: usize) -> Result<CncString> {
    let mut bytes: Vec<u8> = up_to(u, max)?;
    bytes.retain(|&byte| byte != 0);
    Ok(CncStr::from_bytes(&bytes).unwrap_or(CncStr::EMPTY).into())
}

/// Text that a NUL ends, `tail` at the most behind it: `max` bytes in all.
fn ended<'a>(
    u: &mut Unstructured<'a>,
    max: usize,
    tail: impl FnOnce(&mut Unstructured<'a>, usize) -> Result<Vec<u8>>,
) -> Result<Text> {
    let text = text(u, max.saturating_sub(1))?;
    let left = max.saturating_sub(1).saturating_sub(text.as_bytes().len());
    Ok(Text { text, tail: Some(tail(u, left)?) })
}

/// At most so many NULs.
fn nuls(u: &mut Unstructured<'_>, max: usize) -> Result<Vec<u8>> {
    Ok(alloc::vec![0; u.int_in_range(0..=max)?])
}

/// Text of a request: only NULs behind the first.
fn request_text(u: &mut Unstructured<'_>) -> Result<Text> {
    ended(u, TEXT_MAX, nuls)
}

/// Text with or without its end, one byte at least: a text without a NUL has a character.
fn open<'a>(
    u: &mut Unstructured<'a>,
    max: usize,
    tail: impl FnOnce(&mut Unstructured<'a>, usize) -> Result<Vec<u8>>,
) -> Result<Text> {
    let ended = ended(u, max, tail)?;
    let open = !ended.text.as_bytes().is_empty() && u.arbitrary()?;
    Ok(Text { tail: ended.tail.filter(|_| !open), ..ended })
}

/// ADS data; a reply goes without only if its result is an error.
fn reply_data(u: &mut Unstructured<'_>, result: AdsError) -> Result<Option<Vec<u8>>> {
    if !result.is_none() && u.arbitrary()? {
        return Ok(None);
    }
    up_to(u, ADS_DATA_MAX).map(Some)
}

/// Dimensions that fit beside a name.
fn dimensions(u: &mut Unstructured<'_>, name: &Text) -> Result<Vec<u32>> {
    let left = VARIABLE_MAX.saturating_sub(20).saturating_sub(name.as_ref().field_len());
    up_to(u, left.checked_div(4).unwrap_or(0))
}

macro_rules! arbitrary {
    ($( $type:ident, $u:ident => $value:expr; )+) => { $(
        impl<'a> Arbitrary<'a> for $type {
            fn arbitrary($u: &mut Unstructured<'a>) -> Result<Self> {
                Ok($value)
            }
        }
    )+ };
}

arbitrary! {
    AmsNetId, u => Self(u.arbitrary()?);
    AmsPort, u => Self(u.arbitrary()?);
    AmsAddr, u => Self { net_id: u.arbitrary()?, port: u.arbitrary()? };
    AmsHeader, u => Self {
        target: u.arbitrary()?,
        source: u.arbitrary()?,
        command: u.arbitrary()?,
        state_flags: u.arbitrary()?,
        data_length: u.arbitrary()?,
        error: u.arbitrary()?,
        invoke_id: u.arbitrary()?,
    };
    IndexGroup, u => Self::new(u.arbitrary()?);
    IndexOffset, u => Self::new(u.arbitrary()?);
    ReadRequest, u => Self {
        index_group: u.arbitrary()?,
        index_offset: u.arbitrary()?,
        length: u.arbitrary()?,
    };
    WriteRequest, u => Self {
        index_group: u.arbitrary()?,
        index_offset: u.arbitrary()?,
        data: up_to(u, ADS_DATA_MAX)?,
    };
    ReadWriteRequest, u => Self {
        index_group: u.arbitrary()?,
        index_offset: u.arbitrary()?,
        read_length: u.arbitrary()?,
        data: up_to(u, ADS_DATA_MAX)?,
    };
    ReadReply, u => {
        let result = u.arbitrary()?;
        Self { result, data: reply_data(u, result)? }
    };
    ReadWriteReply, u => {
        let result = u.arbitrary()?;
        Self { result, data: reply_data(u, result)? }
    };
    // One at least: none is no stream.
    Descriptors, u => {
        let mut list: Vec<Descriptor> = up_to(u, ADS_DATA_MAX / DESCRIPTOR_LEN)?;
        if list.is_empty() {
            list.push(u.arbitrary()?);
        }
        list.into_iter().collect()
    };
    CncString, u => text(u, TEXT_MAX)?;
    Text, u => open(u, TEXT_MAX, up_to)?;
    VariableKind, u => Self {
        kind: match u.arbitrary()? {
            true => Text { text: CncString::default(), tail: None },
            false => request_text(u)?,
        },
    };
    VariableIndexKind, u => Self { index: u.arbitrary()?, kind: request_text(u)? };
    VariableName, u => Self { name: request_text(u)? };
    HandleRead, u => Self { handle: u.arbitrary()?, indices: up_to(u, INDICES_MAX)? };
    HandleWrite, u => {
        let indices: Vec<u32> = up_to(u, INDICES_MAX)?;
        let taken = indices.len().saturating_mul(4).saturating_add(8);
        let value = up_to(u, VARIABLE_MAX.saturating_sub(taken))?;
        Self { handle: u.arbitrary()?, indices, value }
    };
    NameWrite, u => {
        let name = text(u, TEXT_MAX.saturating_sub(1))?;
        let taken = name.as_bytes().len().saturating_add(1);
        Self { name, value: up_to(u, VARIABLE_MAX.saturating_sub(taken))? }
    };
    Content, u => Self { bytes: up_to(u, ADS_DATA_MAX)? };
    ProgramStream, u => {
        let mut bytes: Vec<u8> = up_to(u, STREAM_PACKET_MAX)?;
        if bytes.is_empty() {
            bytes.push(u.arbitrary()?);
        }
        Self { bytes }
    };
    ElementText, u => {
        let text: Text = u.arbitrary()?;
        match u.arbitrary()? {
            true => Self { text: Text { text: CncString::default(), tail: None } },
            false => Self { text },
        }
    };
    DynamicName, u => Self { name: open(u, DYNAMIC_NAME_MAX, up_to)? };
    DynamicNameRequest, u => Self { name: open(u, DYNAMIC_NAME_MAX, nuls)? };
    DynamicIndex, u => Self(u.arbitrary::<u32>()?.max(1));
    DescriptionByName, u => Self {
        handle: u.arbitrary()?,
        var_type: u.arbitrary()?,
        access: u.arbitrary()?,
        size: u.arbitrary()?,
        dimensions: up_to(u, NAMELESS_DIMENSIONS_MAX)?,
    };
    Value, u => Self { bytes: up_to(u, VARIABLE_MAX)? };
    // One dimension of whatever divides the bytes: nothing else is left of dimensions.
    Values, u => {
        let (data_type, bytes): (DataType, Vec<u8>) = (u.arbitrary()?, up_to(u, VARIABLE_MAX)?);
        let count = match data_type.size() {
            Some(size) => bytes.len().checked_div(to_len(size)).unwrap_or(0),
            None => u.int_in_range(0..=bytes.len())?,
        };
        let size = bytes.len().checked_div(count).unwrap_or(0).saturating_mul(count);
        let dimension = [to_u32(count)];
        let bytes = bytes.get(..size).unwrap_or_default();
        let elements = Elements::new(data_type, Numbers::from(&dimension), bytes);
        elements.map_or_else(|_| Self::Uns08(bytes.to_vec()), Self::from)
    };
    Description, u => {
        let name = u.arbitrary()?;
        Self {
            handle: u.arbitrary()?,
            var_type: u.arbitrary()?,
            access: u.arbitrary()?,
            size: u.arbitrary()?,
            dimensions: dimensions(u, &name)?,
            name,
        }
    };
}
