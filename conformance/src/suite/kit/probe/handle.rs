//! Queries that confirm a handle to the gate before a write.

use ads_cnc::CncString;
use ads_cnc::operation::{DescribeByName, Function, HandleByName, Request};

use crate::exchange::ExchangeError;
use crate::gate::{Ambiguity, GateRejection, Reason};
use crate::judge::Step;
use crate::profile::Claim;
use crate::suite::kit::{Probe, RawCall};

impl Probe<'_> {
    /// Tries to confirm the handle of a write to the [gate](crate::gate). Except for a simulated
    /// CNC of this process, the gate allows the write only after HandleByName and a description
    /// have returned the handle for a name in the file of `--allow-write`. If a stored description
    /// has the handle, or the gate knows a name for it, sends the missing queries that the profile
    /// claims. Sends nothing if the request is not a write by handle, or if the gate already allows
    /// the write.
    pub(crate) fn confirm_handle(&mut self, request: &Request<'_>) -> Step {
        let Request::WriteByHandle(op) = request else { return Ok(()) };
        if self.check_gate(request)?.is_ok() {
            return Ok(());
        }
        let number = u32::from(op.channel.number());
        let is_described = self.target.variables.iter().any(|((channel, _), all)| {
            let mut described = all.read.values().flatten();
            *channel == number && described.any(|variable| variable.handle == op.handle)
        });
        if is_described && !self.target.client.gate().knows_handle(op.channel, op.handle) {
            // The descriptions were probably read on an earlier connection, perhaps before a
            // restart of the device, so they are read again.
            self.target.variables.retain(|(channel, _), _| *channel != number);
            self.variables(op.channel)?;
        }
        if let Some(name) = self.unconfirmed(request)?
            && self.claims(Function::HandleByName) != Claim::No
        {
            self.try_ask(HandleByName { channel: op.channel, name: name.as_cnc_str().into() })?;
        }
        // If the handle is still not confirmed, the gate may not have recorded the description of
        // this variable on the current connection.
        if let Some(name) = self.unconfirmed(request)?
            && self.claims(Function::DescribeByName) != Claim::No
        {
            self.try_ask(DescribeByName { channel: op.channel, name: name.as_cnc_str().into() })?;
        }
        Ok(())
    }

    /// The name for the handle of a write, if the gate rejects the write only because one of the
    /// two queries for this name is missing; otherwise `None`.
    fn unconfirmed(&self, request: &Request<'_>) -> Step<Option<CncString>> {
        Ok(match self.check_gate(request)? {
            Err(Some(GateRejection {
                reason: Reason::Ambiguous(_, Ambiguity::Unconfirmed(name)),
                ..
            })) => Some(name),
            _ => None,
        })
    }

    /// Whether the gate allows a request now. The inner error is the rejection by the gate, or
    /// `None` if the frame cannot be encoded. Sends nothing.
    pub(crate) fn check_gate(
        &self,
        request: &Request<'_>,
    ) -> Step<Result<(), Option<GateRejection>>> {
        match self.target.client.check(&RawCall::new(*request)?.call()) {
            Ok(()) => Ok(Ok(())),
            Err(ExchangeError::NotPermitted(rejection)) => Ok(Err(Some(*rejection))),
            Err(_) => Ok(Err(None)),
        }
    }
}
