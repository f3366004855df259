//! Handwritten code for device information and state.

use super::{Fault, HandWritten, exactly, room, u16_at, u32_at};

#[derive(Clone, Copy, Debug)]
pub(crate) struct DeviceInfo {
    result: u32,
    major: u8,
    minor: u8,
    build: u16,
    name: [u8; 16],
}

impl<'a> HandWritten<'a> for DeviceInfo {
    fn decode(bytes: &'a [u8]) -> Result<Self, Fault> {
        let bytes: &[u8; 24] = exactly(bytes)?;
        let mut name = [0; 16];
        name.copy_from_slice(&bytes[8..]);
        let (result, build) = (u32_at(bytes, 0), u16_at(bytes, 6));
        Ok(Self { result, major: bytes[4], minor: bytes[5], build, name })
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Fault> {
        let out = room(buf, 24)?;
        out[..4].copy_from_slice(&self.result.to_le_bytes());
        out[4] = self.major;
        out[5] = self.minor;
        out[6..8].copy_from_slice(&self.build.to_le_bytes());
        out[8..].copy_from_slice(&self.name);
        Ok(out)
    }
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct DeviceState {
    result: u32,
    ads_state: u16,
    device_state: u16,
}

impl<'a> HandWritten<'a> for DeviceState {
    fn decode(bytes: &'a [u8]) -> Result<Self, Fault> {
        let bytes: &[u8; 8] = exactly(bytes)?;
        Ok(Self {
            result: u32_at(bytes, 0),
            ads_state: u16_at(bytes, 4),
            device_state: u16_at(bytes, 6),
        })
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Fault> {
        let out = room(buf, 8)?;
        out[..4].copy_from_slice(&self.result.to_le_bytes());
        out[4..6].copy_from_slice(&self.ads_state.to_le_bytes());
        out[6..].copy_from_slice(&self.device_state.to_le_bytes());
        Ok(out)
    }
}
