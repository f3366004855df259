//! Queries that confirm a handle to the gate before a write.

use ads_cnc::CncString;
use ads_cnc::operation::{DescribeByName, Function, HandleByName, Request};

use crate::exchange::ExchangeError;
use crate::gate::{Ambiguity, GateRejection, Reason};
use crate::judge::Step;
use crate::profile::Claim;
use crate::suite::kit::{Probe, RawCall};

impl Probe<'_> {
    /// Confirms the handle of a write to the gate, which allows the write only after HandleByName
    /// and a description have returned the handle for a name in the file of `--allow-write`. Sends
    /// the missing queries: HandleByName, and descriptions if they were read on an earlier
    /// connection. Sends nothing for other requests, nor if the gate already allows the write.
    pub(crate) fn confirm_handle(&mut self, request: &Request<'_>) -> Step {
        let Request::WriteByHandle(op) = request else { return Ok(()) };
        if self.check_gate(request)?.is_ok() {
            return Ok(());
        }
        let number = u32::from(op.channel.number());
        let is_described = self.target.variables.iter().any(|((channel, _), all)| {
            *channel == number && all.descriptions().any(|variable| variable.handle == op.handle)
        });
        if is_described && !self.target.client.gate().knows_handle(op.channel, op.handle) {
            // The descriptions were read on another connection, perhaps before a restart of the device.
            self.target.variables.retain(|(channel, _), _| *channel != number);
            self.variables(op.channel)?;
        }
        if let Some(name) = self.unconfirmed(request)?
            && self.claims(Function::HandleByName) != Claim::No
        {
            self.try_ask(HandleByName { channel: op.channel, name: name.as_cnc_str().into() })?;
        }
        // The handle is still not confirmed if the descriptions were read on an earlier connection, so
        // the description of this variable is requested again.
        if let Some(name) = self.unconfirmed(request)?
            && self.claims(Function::DescribeByName) != Claim::No
        {
            self.try_ask(DescribeByName { channel: op.channel, name: name.as_cnc_str().into() })?;
        }
        Ok(())
    }

    /// The name that belongs to the handle of a write; `None` if the handle needs no confirmation
    /// or no query can confirm it.
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
