//! Dispatch of ADS requests to functions.

use core::fmt;

use super::{AdsService, Function, Request, Task};
use crate::address::{IndexGroup, IndexOffset};
use crate::ads::{AdsError, AmsPort};
use crate::bytes::to_u32;
use crate::error::{Error, ErrorKind};
use crate::layout::{Field, Stream};

/// An ADS request to a CNC: its port, service, address, read length and data.
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 4.3.1 and 5.
///
/// ```
/// use ads_cnc::address::{IndexGroup, IndexOffset};
/// use ads_cnc::ads::AmsPort;
/// use ads_cnc::operation::{AdsService, Call, Function};
///
/// let call = Call {
///     port: AmsPort::SDA,
///     service: AdsService::ReadWrite,
///     index_group: IndexGroup::new(0x12_2301),
///     index_offset: IndexOffset::new(0x44),
///     read_length: 4,
///     data: b"V.E\0",
/// };
/// assert_eq!(call.dispatch().unwrap().function(), Function::CountVariables);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Call<'a> {
    /// The AMS port of the receiver.
    pub port: AmsPort,
    /// The service.
    pub service: AdsService,
    /// Index group.
    pub index_group: IndexGroup,
    /// Index offset.
    pub index_offset: IndexOffset,
    /// The maximum length of the reply in bytes; 0 for a Write.
    pub read_length: u32,
    /// The data of the request; empty for a Read.
    pub data: &'a [u8],
}

/// The reason why a request cannot be dispatched.
///
/// ```
/// use ads_cnc::address::{IndexGroup, IndexOffset};
/// use ads_cnc::ads::{AdsError, AmsPort};
/// use ads_cnc::operation::{AdsService, Call, DispatchError};
///
/// // The offset 0x4E is reserved.
/// let index_offset = IndexOffset::new(0x4E);
/// let call = Call {
///     port: AmsPort::SDA,
///     service: AdsService::ReadWrite,
///     index_group: IndexGroup::new(0x12_2301),
///     index_offset,
///     read_length: 4,
///     data: &[],
/// };
/// let error = call.dispatch().unwrap_err();
/// assert_eq!(error, DispatchError::Offset(index_offset));
/// assert_eq!(error.ads_error(), AdsError::INVALID_OFFSET);
/// assert_eq!(error.to_string(), "no function has index offset 0x4e");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum DispatchError {
    /// No task has this port.
    Port(AmsPort),
    /// No function of the task has this index group.
    Group(IndexGroup),
    /// No function of the index group has this offset, or only access to content by a different
    /// service has it.
    Offset(IndexOffset),
    /// The function requires another service.
    Service {
        /// The service that the function requires.
        expected: AdsService,
        /// The service of the request.
        found: AdsService,
    },
    /// The data is not a valid request for the function, or the read length is too short.
    Stream(Error),
}

impl DispatchError {
    /// The ADS error number for the response. The numbers that a CNC returns are not documented; these
    /// are assumed (ADS-7).
    pub const fn ads_error(self) -> AdsError {
        match self {
            Self::Port(_) => AdsError::TARGET_PORT_NOT_FOUND,
            Self::Group(_) => AdsError::INVALID_GROUP,
            Self::Offset(_) => AdsError::INVALID_OFFSET,
            Self::Service { .. } => AdsError::SERVICE_NOT_SUPPORTED,
            Self::Stream(_) => AdsError::INVALID_SIZE,
        }
    }
}

impl fmt::Display for DispatchError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Port(port) => write!(f, "no task has port {port}"),
            Self::Group(group) => write!(f, "no function has index group {group}"),
            Self::Offset(offset) => write!(f, "no function has index offset {offset}"),
            Self::Service { expected, found } => {
                write!(f, "the function takes {expected}, not {found}")
            }
            Self::Stream(error) => fmt::Display::fmt(error, f),
        }
    }
}

// Without `source`: `Display` contains the error of the stream, so a report with sources would repeat it.
impl core::error::Error for DispatchError {}

impl<'a> Call<'a> {
    /// Finds the function of the call by the port, index group, index offset and service, and
    /// decodes its arguments.
    ///
    /// A function of the SDA task is also found at the port of the GEO task, because both tasks
    /// serve the classes of the CNC (ADR-10, assumed). The server must check that its reply fits
    /// the read length.
    ///
    /// ```
    /// use ads_cnc::address::{IndexGroup, IndexOffset};
    /// use ads_cnc::ads::AmsPort;
    /// use ads_cnc::operation::{AdsService, Call, DispatchError, Request};
    ///
    /// let call = Call {
    ///     port: AmsPort::SDA,
    ///     service: AdsService::ReadWrite,
    ///     index_group: IndexGroup::new(0x12_2301),
    ///     index_offset: IndexOffset::new(0x46),
    ///     read_length: 4,
    ///     data: b"V.E.vartest\0",
    /// };
    /// let Ok(Request::HandleByName(request)) = call.dispatch() else { panic!() };
    /// assert_eq!(request.name.text(), "V.E.vartest");
    ///
    /// let read = Call { service: AdsService::Read, ..call };
    /// let error = DispatchError::Service { expected: AdsService::ReadWrite, found: AdsService::Read };
    /// assert_eq!(read.dispatch(), Err(error));
    /// ```
    ///
    /// # Errors
    /// The first fault; port, group, offset, service, data and read length are checked in this
    /// order.
    pub fn dispatch(&self) -> Result<Request<'a>, DispatchError> {
        let task = Task::from_port(self.port).ok_or(DispatchError::Port(self.port))?;
        let mut error = DispatchError::Group(self.index_group);
        let group = self.index_group.parts().ok_or(error)?;
        for function in Function::ALL.iter().copied() {
            let spec = function.spec();
            if !spec.is_in(task, group) {
                continue;
            }
            error = DispatchError::Offset(self.index_offset);
            if !spec.offset.contains(self.index_offset) {
                continue;
            }
            if spec.service == self.service {
                return match spec.service {
                    AdsService::Read if !self.data.is_empty() => {
                        Err(DispatchError::Stream(self.read_with_data()))
                    }
                    _ => Request::decode(function, group, self),
                };
            }
            // After a row of access to content, a later row may match with this service. Any other
            // function excludes access to content at its offset (SDA-12).
            if !spec.is_content() {
                return Err(DispatchError::Service { expected: spec.service, found: self.service });
            }
        }
        Err(error)
    }

    /// The error for a Read with data: its stream has no field for data.
    #[cold]
    pub(super) fn read_with_data(&self) -> Error {
        let whole = Field::whole(Stream::ReadRequest);
        let found = to_u32(self.data.len()).saturating_add(READ_REQUEST_LEN);
        let len = READ_REQUEST_LEN;
        Error::new(ErrorKind::Trailing, whole, len, len, found)
    }
}

const READ_REQUEST_LEN: u32 = Stream::ReadRequest.layout().max;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dispatch_rejects_a_read_with_data() {
        let read = Call {
            port: AmsPort::COM,
            service: AdsService::Read,
            index_group: IndexGroup::new(0x13_0101),
            index_offset: IndexOffset::new(1),
            read_length: 84,
            data: &[],
        };
        assert!(read.dispatch().is_ok());
        let error = Call { data: &[0], ..read }.dispatch().unwrap_err();
        assert_eq!(
            std::format!("{error}"),
            "read-request: stream at offset 12: trailing bytes, expected 12 bytes, found 13"
        );
    }
}
