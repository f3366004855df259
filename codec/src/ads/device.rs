//! Information about a device: ReadDeviceInfo and ReadState.

use super::AdsError;
use crate::bytes::{Reader, Writer};
use crate::declare::stream;
use crate::error::Error;
use crate::layout::Stream;
use crate::limits::most;
use crate::number::code;
use crate::stream::{Decode, Encode};
use crate::text::CncStr;

/// The number of bytes of the field `name`.
const NAME_LEN: usize = most::<InfoLayout>("name");

#[doc = include_str!("../../doc/device-info-reply.md")]
///
/// The request has no data. A reply whose result is not 0 may end after the result (ADS-6): decode
/// such a reply as a [`WriteReply`](super::WriteReply).
///
/// Source: the vendors' public help pages; the manuals do not describe it.
///
/// `decode` can fail with [`Truncated`](crate::ErrorKind::Truncated) or
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
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(from = "InfoLayout", into = "InfoLayout")
)]
pub struct DeviceInfoReply {
    /// ADS error number.
    pub result: AdsError,
    /// First number of the version.
    pub major: u8,
    /// Second number of the version.
    pub minor: u8,
    /// Third number of the version.
    pub build: u16,
    /// All bytes of the name, including those after its NUL.
    pub name: [u8; NAME_LEN],
}

impl DeviceInfoReply {
    /// The bytes of the stream.
    pub fn to_bytes(&self) -> [u8; size_of::<InfoLayout>()] {
        zerocopy::transmute!(self.layout())
    }

    /// The name: the bytes before the first NUL, or all 16 bytes without a NUL.
    pub fn name(&self) -> CncStr<'_> {
        CncStr::until_nul(&self.name)
    }
}

stream! {
    /// The bytes of [`DeviceInfoReply`].
    DeviceInfoReply "device-info-reply", "ADS ReadDeviceInfo, reply", "ADS-8", max 24;
    packed InfoLayout {
        @0 result: UNS32,    "ADS-4", "ADS error number, 0 for success";
        @4 major: UNS08,     "ADS-8", "first number of the version";
        @5 minor: UNS08,     "ADS-8", "second number of the version";
        @6 build: UNS16,     "ADS-8", "third number of the version";
        @8 name: PADDED(16), "ADS-8", "name of the device";
    }
}

impl<'a> Decode<'a> for DeviceInfoReply {
    const STREAM: Stream = Stream::DeviceInfoReply;

    fn decode(bytes: &'a [u8]) -> Result<Self, Error> {
        Reader::exact(Self::STREAM, bytes).map(Self::from_layout)
    }
}

impl Encode for DeviceInfoReply {
    fn encoded_len(&self) -> usize {
        size_of::<InfoLayout>()
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Error> {
        Writer::copy(Self::STREAM, &self.to_bytes(), buf)
    }
}

impl DeviceInfoReply {
    fn from_layout(&InfoLayout { result, major, minor, build, name }: &InfoLayout) -> Self {
        Self { result: AdsError(result.get()), major, minor, build: build.get(), name }
    }

    fn layout(&self) -> InfoLayout {
        let &Self { result, major, minor, build, name } = self;
        InfoLayout { result: result.0.into(), major, minor, build: build.into(), name }
    }
}

#[cfg(feature = "serde")]
impl From<InfoLayout> for DeviceInfoReply {
    fn from(layout: InfoLayout) -> Self {
        Self::from_layout(&layout)
    }
}

#[cfg(feature = "serde")]
impl From<DeviceInfoReply> for InfoLayout {
    fn from(info: DeviceInfoReply) -> Self {
        info.layout()
    }
}

code! {
    /// The state of an ADS device; unknown numbers are kept (ADS-9).
    ///
    /// Source: the vendors' public help pages; the manuals do not describe it.
    ///
    /// ```
    /// use ads_cnc::ads::AdsState;
    ///
    /// assert_eq!(AdsState(5), AdsState::RUN);
    /// assert_ne!(AdsState(16), AdsState::CONFIG);
    /// ```
    AdsState(u16) {
        /// The device is running.
        RUN = 5;
        /// The device is stopped.
        STOP = 6;
        /// The device is being configured.
        CONFIG = 15;
    }
}

stream! {
    /// The state of an ADS device: the reply to ReadState.
    ///
    /// The request has no data. A reply whose result is not 0 may end after the result (ADS-6): decode
    /// such a reply as a [`WriteReply`](super::WriteReply).
    ///
    /// Source: the vendors' public help pages; the manuals do not describe it.
    ///
    /// `decode` can fail with [`Truncated`](crate::ErrorKind::Truncated) or
    /// [`Trailing`](crate::ErrorKind::Trailing).
    ///
    /// ```
    /// use ads_cnc::{Decode, ads::{AdsState, DeviceStateReply}};
    ///
    /// let state = DeviceStateReply::decode(&[0, 0, 0, 0, 5, 0, 1, 0])?;
    /// assert_eq!((state.ads_state, state.device_state), (AdsState::RUN, 1));
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    DeviceStateReply "device-state-reply", "ADS ReadState, reply", "ADS-9", max 8;
    struct DeviceStateReply {
        @0 result: UNS32 as AdsError,    "ADS-4", "ADS error number, 0 for success";
        @4 ads_state: UNS16 as AdsState, "ADS-9", "5 RUN, 6 STOP, 15 CONFIG, …";
        @6 device_state: UNS16,          "ADS-9", "state of the device's own";
    }
}
