//! Implementations of `Arbitrary` for some of the types that `stream!` does not declare. A
//! generated value of a stream can be encoded.

use alloc::vec::Vec;

use arbitrary::{Arbitrary, Result, Unstructured};

use crate::address::{IndexGroup, IndexOffset};
use crate::ads::{AdsError, AmsAddr, AmsHeader, AmsNetId, AmsPort, ReadReply, ReadWriteReply};
use crate::limits::{ADS_DATA_MAX, DESCRIPTOR_LEN, TEXT_MAX};
use crate::rows::any::{open, text, up_to};
use crate::text::{CncString, Text};
use crate::{Descriptor, Descriptors};

/// Generates the data of a reply; `None` only for a result that is an error (ADS-6).
fn reply_data(u: &mut Unstructured<'_>, result: AdsError) -> Result<Option<Vec<u8>>> {
    if !result.is_ok() && u.arbitrary()? {
        return Ok(None);
    }
    up_to(u, ADS_DATA_MAX).map(Some)
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
    ReadReply, u => {
        let result = u.arbitrary()?;
        Self { result, data: reply_data(u, result)? }
    };
    ReadWriteReply, u => {
        let result = u.arbitrary()?;
        Self { result, data: reply_data(u, result)? }
    };
    // Generate at least one descriptor, because an empty list is not a valid stream.
    Descriptors, u => {
        let mut list: Vec<Descriptor> = up_to(u, ADS_DATA_MAX / DESCRIPTOR_LEN)?;
        if list.is_empty() {
            list.push(u.arbitrary()?);
        }
        list.into_iter().collect()
    };
    CncString, u => text(u, TEXT_MAX)?;
    Text, u => open(u, TEXT_MAX, false)?;
}
