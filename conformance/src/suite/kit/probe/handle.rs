//! Queries that confirm a handle to the gate before a write.

use ads_cnc::CncString;
use ads_cnc::operation::{DescribeByName, Function, HandleByName, Request};

use crate::exchange::ExchangeError;
use crate::gate::{Ambiguity, GateRejection, Reason};
use crate::judge::Step;
use crate::profile::Claim;
use crate::suite::kit::{Probe, RawCall};

impl Probe<'_> {
    /// Sends the queries that confirm the handle of a write: the handle by name, and the
    /// descriptions of the channel unless they were read on this connection.
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

    /// The name of the handle in a write, if the handle is not confirmed yet.
    fn unconfirmed(&self, request: &Request<'_>) -> Step<Option<CncString>> {
        Ok(match self.check_gate(request)? {
            Err(Some(GateRejection {
                reason: Reason::Ambiguous(_, Ambiguity::Unconfirmed(name)),
                ..
            })) => Some(name),
            _ => None,
        })
    }

    /// Whether the gate lets a request pass, and why not. Sends nothing.
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
