//! What a device says of itself: ReadDeviceInfo and ReadState.

use zerocopy::little_endian::{U16, U32};
use zerocopy::{FromBytes, Immutable, IntoBytes, KnownLayout, Unaligned};

use super::AdsError;
use crate::bytes::{Reader, Writer};
use crate::error::Error;
use crate::layout::Stream;
use crate::stream::{Decode, Encode};
use crate::text::CncStr;

/// Bytes of a device's name.
const NAME_LEN: usize = 16;

#[doc = include_str!("../../doc/device-info-reply.md")]
///
/// The request has no data. A reply whose result is not 0 may stop behind it (ADS-6): then it is a
/// [`WriteReply`](super::WriteReply).
///
/// Source: the vendors' public help pages; the manuals do not describe it.
///
/// `decode` refuses with [`Truncated`](crate::ErrorKind::Truncated) or
/// [`Trailing`](crate::ErrorKind::Trailing).
///
/// ```
/// use ads_cnc::{CncStr, Decode, ads::DeviceInfoReply};
///
/// let info = DeviceInfoReply::decode(b"\0\0\0\0\x03\x01\x39\x0cCNC\0\0\0\0\0\0\0\0\0\0\0\0\0")?;
/// assert_eq!((info.major, info.minor, info.build), (3, 1, 3129));
/// assert_eq!(info.name(), "CNC");
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
pub struct DeviceInfoReply {
    /// ADS error number.
    pub result: AdsError,
    /// First number of the version.
    pub major: u8,
    /// Second number of the version.
    pub minor: u8,
    /// Third number of the version.
    pub build: u16,
    /// All bytes of the name, those behind its NUL too.
    pub name: [u8; NAME_LEN],
}

impl DeviceInfoReply {
    /// The name, which ends at its first NUL or fills its bytes.
    pub fn name(&self) -> CncStr<'_> {
        CncStr::until_nul(&self.name)
    }
}

#[derive(FromBytes, IntoBytes, KnownLayout, Immutable, Unaligned)]
#[repr(C)]
struct InfoLayout {
    result: U32,
    major: u8,
    minor: u8,
    build: U16,
    name: [u8; NAME_LEN],
}

const _: () = assert!(size_of::<InfoLayout>() == 24);

impl<'a> Decode<'a> for DeviceInfoReply {
    const STREAM: Stream = Stream::DeviceInfoReply;

    fn decode(bytes: &'a [u8]) -> Result<Self, Error> {
        let layout = Reader::all(Self::STREAM, bytes)?;
        let &InfoLayout { result, major, minor, build, name } = layout;
        Ok(Self { result: AdsError(result.get()), major, minor, build: build.get(), name })
    }
}

impl Encode for DeviceInfoReply {
    fn encoded_len(&self) -> usize {
        size_of::<InfoLayout>()
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Error> {
        let &Self { result, major, minor, build, name } = self;
        let (result, build) = (result.0.into(), build.into());
        let layout = InfoLayout { result, major, minor, build, name };
        Writer::copy(Self::STREAM, layout.as_bytes(), buf)
    }
}

/// The state of an ADS device; unknown numbers stay what they are (ADS-9).
///
/// Source: the vendors' public help pages; the manuals do not describe it.
///
/// ```
/// use ads_cnc::ads::AdsState;
///
/// assert_eq!(AdsState(5), AdsState::RUN);
/// assert_ne!(AdsState(16), AdsState::CONFIG);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
pub struct AdsState(pub u16);

impl AdsState {
    /// It works.
    pub const RUN: Self = Self(5);
    /// It has been stopped.
    pub const STOP: Self = Self(6);
    /// It is being configured.
    pub const CONFIG: Self = Self(15);
}

#[doc = include_str!("../../doc/device-state-reply.md")]
///
/// The request has no data. A reply whose result is not 0 may stop behind it (ADS-6): then it is a
/// [`WriteReply`](super::WriteReply).
///
/// Source: the vendors' public help pages; the manuals do not describe it.
///
/// `decode` refuses with [`Truncated`](crate::ErrorKind::Truncated) or
/// [`Trailing`](crate::ErrorKind::Trailing).
///
/// ```
/// use ads_cnc::{Decode, ads::{AdsState, DeviceStateReply}};
///
/// let state = DeviceStateReply::decode(&[0, 0, 0, 0, 5, 0, 1, 0])?;
/// assert_eq!((state.ads_state, state.device_state), (AdsState::RUN, 1));
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
pub struct DeviceStateReply {
    /// ADS error number.
    pub result: AdsError,
    /// State as ADS knows it.
    pub ads_state: AdsState,
    /// State as the device knows it.
    pub device_state: u16,
}

#[derive(FromBytes, IntoBytes, KnownLayout, Immutable, Unaligned)]
#[repr(C)]
struct StateLayout {
    result: U32,
    ads_state: U16,
    device_state: U16,
}

const _: () = assert!(size_of::<StateLayout>() == 8);

impl<'a> Decode<'a> for DeviceStateReply {
    const STREAM: Stream = Stream::DeviceStateReply;

    fn decode(bytes: &'a [u8]) -> Result<Self, Error> {
        let layout = Reader::all(Self::STREAM, bytes)?;
        let StateLayout { result, ads_state, device_state } = layout;
        Ok(Self {
            result: AdsError(result.get()),
            ads_state: AdsState(ads_state.get()),
            device_state: device_state.get(),
        })
    }
}

impl Encode for DeviceStateReply {
    fn encoded_len(&self) -> usize {
        size_of::<StateLayout>()
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Error> {
        let (ads_state, device_state) = (self.ads_state.0.into(), self.device_state.into());
        let layout = StateLayout { result: self.result.0.into(), ads_state, device_state };
        Writer::copy(Self::STREAM, layout.as_bytes(), buf)
    }
}
