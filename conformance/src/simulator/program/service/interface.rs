//! The Service Interface of the CNC.

use ads_cnc::Error;
use ads_cnc::service::ServiceVariable;

use super::text_value;

/// The Service Interface of a channel, with the behaviour of its five variables.
///
/// - A write of any value to REQUEST_STATE sets RESPONSE_STATE to 0 (SVC-3). The manuals state this
///   for the NC program; for other writers and for the value 0, this is assumed.
/// - When the service has finished, REQUEST_STATE becomes 0 (SVC-4). The event that causes this is
///   assumed, see [`Clears`].
/// - Initially, all five variables are empty or 0 (assumed). UUID has 128 bytes like the other
///   texts (assumed).
///
/// Manual: `service-en` and `service-de` 1.03, section 2.
///
/// ```
/// use ads_cnc::service::ServiceVariable::*;
/// use ads_cnc_conformance::simulator::program::service::ServiceInterface;
///
/// let mut interface = ServiceInterface::new();
/// interface.write(Request, b"3\0")?;
/// interface.write(RequestState, &[1, 0, 0, 0])?;
/// assert_eq!(interface.read(Request), b"3\0");
///
/// interface.write(ResponseState, &[99, 0, 0, 0])?;
/// assert_eq!(interface.read(RequestState), [0; 4]);
/// interface.write(RequestState, &[1, 0, 0, 0])?;
/// assert_eq!(interface.read(ResponseState), [0; 4]);
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ServiceInterface {
    uuid: Vec<u8>,
    request: Vec<u8>,
    request_state: [u8; 4],
    response_state: [u8; 4],
    response: Vec<u8>,
    clears: Clears,
}

/// The event at which the interface sets REQUEST_STATE to 0, if any (SVC-4). The event is not
/// documented; a [`Host`] works with each of these variants.
///
/// [`Host`]: ads_cnc::service::Host
///
/// ```
/// use ads_cnc::service::ServiceVariable::*;
/// use ads_cnc_conformance::simulator::program::service::{Clears, ServiceInterface};
///
/// let mut interface = ServiceInterface::with(Clears::Never);
/// interface.write(RequestState, &[1, 0, 0, 0])?;
/// interface.write(ResponseState, &[1, 0, 0, 0])?;
/// assert_eq!(interface.read(RequestState), [1, 0, 0, 0]);
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Clears {
    /// A write to RESPONSE_STATE, which completes the response of the service.
    #[default]
    OnResponseState,
    /// Never: the interface relies on the service to write 0 to REQUEST_STATE.
    Never,
}

impl ServiceInterface {
    /// Creates an interface in its initial state.
    pub fn new() -> Self {
        Self::with(Clears::OnResponseState)
    }

    /// Creates an interface that sets REQUEST_STATE to 0 at the event `clears`.
    pub fn with(clears: Clears) -> Self {
        Self {
            uuid: vec![0],
            request: vec![0],
            request_state: [0; 4],
            response_state: [0; 4],
            response: vec![0],
            clears,
        }
    }

    /// The value of a variable: a text including its NUL, or the four bytes of a state.
    pub fn read(&self, variable: ServiceVariable) -> &[u8] {
        match variable {
            ServiceVariable::Uuid => &self.uuid,
            ServiceVariable::Request => &self.request,
            ServiceVariable::RequestState => &self.request_state,
            ServiceVariable::ResponseState => &self.response_state,
            ServiceVariable::Response => &self.response,
        }
    }

    /// Writes a variable, with the effects on other variables.
    ///
    /// # Errors
    /// [`TooLong`](ads_cnc::ErrorKind::TooLong) for a text of more than 128 bytes including its
    /// NUL; [`Truncated`](ads_cnc::ErrorKind::Truncated) or
    /// [`Trailing`](ads_cnc::ErrorKind::Trailing) for a state that does not have exactly four
    /// bytes. Then nothing is written.
    pub fn write(&mut self, variable: ServiceVariable, value: &[u8]) -> Result<(), Error> {
        match variable {
            ServiceVariable::Uuid => self.uuid = text_value(value, variable)?,
            ServiceVariable::Request => self.request = text_value(value, variable)?,
            ServiceVariable::Response => self.response = text_value(value, variable)?,
            ServiceVariable::RequestState => {
                self.request_state = variable.state(value)?.to_le_bytes();
                self.response_state = [0; 4];
            }
            ServiceVariable::ResponseState => {
                self.response_state = variable.state(value)?.to_le_bytes();
                if self.clears == Clears::OnResponseState {
                    self.request_state = [0; 4];
                }
            }
        }
        Ok(())
    }

    /// Resets all variables to their initial values; a reset of the CNC is assumed to do this.
    pub fn reset(&mut self) {
        *self = Self::with(self.clears);
    }
}

impl Default for ServiceInterface {
    fn default() -> Self {
        Self::new()
    }
}
