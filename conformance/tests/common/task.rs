//! Requests to a task of a CNC with the crate `ads`; a rejected request returns its error number.

use ads::{Device, Error};

/// Sends a ReadWrite with a read length of 2048 bytes.
pub(crate) fn ask(
    device: Device<'_>,
    group: u32,
    offset: u32,
    data: &[u8],
) -> Result<Vec<u8>, u32> {
    ask_for(device, group, offset, data, 2048)
}

pub(crate) fn ask_for(
    device: Device<'_>,
    group: u32,
    offset: u32,
    data: &[u8],
    length: usize,
) -> Result<Vec<u8>, u32> {
    let mut reply = vec![0xEE; length];
    let length = number(device.write_read(group, offset, data, &mut reply))?;
    reply.truncate(length);
    Ok(reply)
}

pub(crate) fn read(
    device: Device<'_>,
    group: u32,
    offset: u32,
    length: usize,
) -> Result<Vec<u8>, u32> {
    let mut reply = vec![0xEE; length];
    let length = number(device.read(group, offset, &mut reply))?;
    reply.truncate(length);
    Ok(reply)
}

/// Converts an ADS error to its number; any other error fails the test.
pub(crate) fn number<T>(result: ads::Result<T>) -> Result<T, u32> {
    result.map_err(|error| match error {
        Error::Ads(_, _, number) => number,
        other => panic!("{other}"),
    })
}
