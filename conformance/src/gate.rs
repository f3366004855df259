//! What may leave for a target. A machine may move: everything not allowed is refused.

use std::fmt;

use ads_cnc::ads::AmsPort;
use ads_cnc::operation::{Call, Effect, Function, Refusal};

/// Decides over every call before a byte of it is sent.
///
/// ```
/// use ads_cnc::address::{IndexGroup, IndexOffset};
/// use ads_cnc::ads::AmsPort;
/// use ads_cnc::operation::{Call, Service};
/// use ads_cnc_conformance::gate::Gate;
///
/// let write = Call {
///     port: AmsPort::COM,
///     service: Service::Write,
///     index_group: IndexGroup::new(0x12_0101),
///     index_offset: IndexOffset::new(1),
///     read_length: 0,
///     data: &[1],
/// };
/// assert!(Gate::queries().check(&write).is_err());
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Gate {
    malformed: bool,
}

/// A call the gate did not let through.
#[derive(Clone, Copy, Debug)]
pub enum Closed {
    /// The function changes something.
    Effect(Function),
    /// No function of the table takes this: it might be anything.
    Unknown(Refusal),
    /// The function is documented for another port.
    Port(AmsPort),
}

impl Gate {
    /// Well-formed queries of the function table only: for devices.
    pub const fn queries() -> Self {
        Self { malformed: false }
    }

    /// Anything but documented writes: for a CNC on this machine that cannot move. [`Client`]
    /// takes no other target with it.
    ///
    /// [`Client`]: crate::client::Client
    pub const fn with_malformed() -> Self {
        Self { malformed: true }
    }

    /// Whether malformed calls pass.
    pub const fn lets_malformed_pass(&self) -> bool {
        self.malformed
    }

    /// Whether this call may be sent.
    ///
    /// # Errors
    /// Why not.
    pub fn check(&self, call: &Call<'_>) -> Result<(), Closed> {
        match call.dispatch() {
            Ok(request) => {
                let spec = request.function().spec();
                match spec.effect {
                    // That the other of SDA and GEO answers too is assumed.
                    Effect::Query if call.port == spec.task.port() || self.malformed => Ok(()),
                    Effect::Query => Err(Closed::Port(call.port)),
                    _ => Err(Closed::Effect(request.function())),
                }
            }
            Err(_) if self.malformed => Ok(()),
            Err(refusal) => Err(Closed::Unknown(refusal)),
        }
    }
}

impl fmt::Display for Closed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Effect(function) => {
                write!(f, "\"{}\" is no query", function.spec().name)
            }
            Self::Unknown(refusal) => write!(f, "no documented query: {refusal}"),
            Self::Port(port) => write!(f, "not documented for port {port}"),
        }
    }
}

impl std::error::Error for Closed {}
