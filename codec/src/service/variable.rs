//! The five variables.

use core::fmt;

use crate::layout::Field;
use crate::layout::service;
use crate::variable::VariableType;

/// A variable of the Service Interface (SVC-1). Each channel has its own five.
///
/// Manual: `service-en` and `service-de` 1.03, section 2. That the states are UNS32 follows from
/// the example's C code.
///
/// ```
/// use ads_cnc::VariableType;
/// use ads_cnc::address::Channel;
/// use ads_cnc::operation::{Operation, ReadByName};
/// use ads_cnc::service::ServiceVariable;
///
/// let variable = ServiceVariable::RequestState;
/// assert_eq!(variable.name(), "V.G.SERVICE.REQUEST_STATE");
/// assert_eq!(variable.var_type(), VariableType::UNS32);
///
/// let read = ReadByName::new(Channel::new(1)?, variable.name())?;
/// let mut buf = [0; 32];
/// assert_eq!(read.encode(&mut buf)?, b"V.G.SERVICE.REQUEST_STATE\0");
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum ServiceVariable {
    /// The service that is called.
    Uuid,
    /// The text of the request.
    Request,
    /// Not 0: there is a request.
    RequestState,
    /// Not 0: there is a response.
    ResponseState,
    /// The text of the response.
    Response,
}

impl ServiceVariable {
    /// The name of [`Uuid`](Self::Uuid).
    pub const UUID: &'static str = "V.G.SERVICE.UUID";
    /// The name of [`Request`](Self::Request).
    pub const REQUEST: &'static str = "V.G.SERVICE.REQUEST";
    /// The name of [`RequestState`](Self::RequestState).
    pub const REQUEST_STATE: &'static str = "V.G.SERVICE.REQUEST_STATE";
    /// The name of [`ResponseState`](Self::ResponseState).
    pub const RESPONSE_STATE: &'static str = "V.G.SERVICE.RESPONSE_STATE";
    /// The name of [`Response`](Self::Response).
    pub const RESPONSE: &'static str = "V.G.SERVICE.RESPONSE";

    /// All of them, in the manual's order.
    pub const ALL: [Self; 5] =
        [Self::Uuid, Self::Request, Self::RequestState, Self::ResponseState, Self::Response];

    /// The variable's name, for requests by name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Uuid => Self::UUID,
            Self::Request => Self::REQUEST,
            Self::RequestState => Self::REQUEST_STATE,
            Self::ResponseState => Self::RESPONSE_STATE,
            Self::Response => Self::RESPONSE,
        }
    }

    /// The variable of this name.
    pub fn by_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|variable| variable.name() == name)
    }

    /// STRING, or UNS32 of a state.
    pub const fn var_type(self) -> VariableType {
        match self {
            Self::Uuid | Self::Request | Self::Response => VariableType::STRING,
            Self::RequestState | Self::ResponseState => VariableType::UNS32,
        }
    }

    pub(super) const fn field(self) -> Field {
        match self {
            Self::Uuid => service::UUID,
            Self::Request => service::REQUEST,
            Self::RequestState => service::REQUEST_STATE,
            Self::ResponseState => service::RESPONSE_STATE,
            Self::Response => service::RESPONSE,
        }
    }
}

/// The name.
impl fmt::Display for ServiceVariable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
