//! Restores the values that cases change with [`Probe::changing`], and reads them back, however the
//! case ends.

#![cfg_attr(
    not(test),
    deny(clippy::arithmetic_side_effects, clippy::as_conversions, clippy::indexing_slicing),
    deny(clippy::expect_used, clippy::panic, clippy::string_slice, clippy::unreachable),
    deny(clippy::unwrap_used)
)]

use std::time::Duration;

use ads_cnc::operation::{CountObjects, DescribeByName, HandleByName, ReadDescriptors, Request};
use ads_cnc::{Decode as _, ObjectCount};

use crate::exchange::{Exchange, ExchangeError};
use crate::gate::{Entry, Reason};
use crate::judge::{Step, Stop};
use crate::number::to_u32;
use crate::objects::ValueAddress;
use crate::suite::kit::changes::Change;
use crate::suite::kit::{OBJECTS_MAX, Probe, RawCall, WriteCheck, same};
use crate::text::{Moment, plural};

/// Maximum number of attempts to write a value back each time that restoring is tried: at the end
/// of the change, for example, and again at the end of the run.
const WRITES_MAX: u32 = 5;

/// Pause before the third attempt; it doubles for each further attempt and for the read after the
/// last attempt. There is no pause before the first two attempts.
const PAUSE: Duration = Duration::from_millis(200);

/// Assumed maximum number of requests to restore a value, not counting lists of objects that are
/// read again on a new connection.
const REQUESTS_MAX: u32 = 60;

/// Upper limit of the sum of all pauses to restore a value, in the attempts of a case and in those
/// at the end of the run.
const PAUSES: Duration = Duration::from_secs(8);

impl Probe<'_> {
    /// Calls `change`, which changes a value, and then `restore`, even if `change` returns an
    /// error. `restore` restores the value as a part of the case, and returns whether it is
    /// restored; if it returns false or an error, restoring is tried again. Calls neither function
    /// if the file of `--allow-write` would expire before the value could be restored.
    pub(crate) fn changing(
        &mut self,
        write_check: &WriteCheck<'_>,
        address: &ValueAddress,
        was: &[u8],
        change: impl FnOnce(&mut Self) -> Step,
        restore: impl FnOnce(&mut Self) -> Step<bool>,
    ) -> Step {
        self.found_subject();
        self.check_time_to_restore(1)?;
        let by_name = match (address, write_check.name) {
            (ValueAddress::Handle { channel, indices, .. }, Some(name)) => {
                let indices: String = indices.iter().map(|index| format!("[{index}]")).collect();
                let name = format!("{name}{indices}").parse().ok();
                name.map(|name| ValueAddress::Name { channel: *channel, name })
            }
            _ => None,
        };
        self.target.changes.begin(Change {
            address: address.clone(),
            by_name,
            name: write_check.name.cloned(),
            what: write_check.what.to_owned(),
            is_text: write_check.is_text,
            was: was.to_vec(),
            is: None,
            rejected: None,
            given_up: false,
        });
        let changed = change(self);
        let restored = match restore(self) {
            Ok(true) => {
                self.target.changes.end(address);
                Ok(())
            }
            restored => restored.map(drop),
        };
        let restored_all = self.restore_all();
        changed.and(restored).and(restored_all)
    }

    /// Ends the case if the file of `--allow-write` would expire before the changed values, and
    /// `next` more, could be restored. Called before a change with [`changing`](Self::changing),
    /// and before each request of a case while a changed value is still to be restored.
    pub(crate) fn check_time_to_restore(&self, next: usize) -> Step {
        let client = &self.target.client;
        let target = client.target();
        let values = self.target.changes.all().len().saturating_add(next);
        // Each request may have to wait for a connection and for a reply.
        let request = target.timeout.saturating_mul(2).saturating_add(target.pace);
        let each = request.saturating_mul(REQUESTS_MAX).saturating_add(PAUSES);
        let time = each.saturating_mul(to_u32(values));
        let end = Moment::now().after(time);
        client.gate().check_target(target.net_id, end).map_err(|why| {
            let (values, time) = (plural(values, "value"), time.as_secs());
            Stop::NotPermitted(format!("restoring {values} may take {time} s, and {why}"))
        })
    }

    /// Tries to restore all changed values that were not given up, the last change first, even if
    /// the run is interrupted, the deadline has passed or the target no longer answers. Values that
    /// cannot be restored are given up.
    pub(crate) fn restore_all(&mut self) -> Step {
        let mut all = Ok(());
        while let Some(change) = self.target.changes.last() {
            all = all.and(self.restore_one(change));
        }
        all
    }

    /// Tries again to restore the values that remain changed, including those that were given up.
    pub(crate) fn restore_rest(&mut self) {
        self.target.changes.all().iter_mut().for_each(|change| change.given_up = false);
        // The report lists the values that still remain changed.
        let _left = self.restore_all();
    }

    fn restore_one(&mut self, mut change: Change) -> Step {
        let (changes, address) = (self.target.changes.clone(), change.address.clone());
        let mut written = false;
        for times in 0..=WRITES_MAX {
            if times > 1 {
                let pause = PAUSE.saturating_mul(1 << times.saturating_sub(2).min(8));
                self.target.client.wait(pause);
                // The handle may have become invalid, or unconfirmed.
                change.use_name();
            }
            // The value is read first, because a write without a reply may have been executed.
            let mut now = self.present_value(&change);
            if !self.is_confirmed(&change) {
                // On a new connection, the handle or address may belong to another value, even if
                // that value is equal to the original one.
                self.request_again(&mut change);
                if !self.is_confirmed(&change) {
                    change.use_name();
                }
                now = self.is_confirmed(&change).then(|| self.present_value(&change)).flatten();
            }
            changes.is_now(&address, now.as_deref());
            let is_same = now.as_ref().is_some_and(|now| same(now, &change.was, change.is_text));
            // After an accepted write, a value that changes by itself may never equal the original
            // one; two reads detect such a value.
            let moves = !is_same && written && now.is_some() && {
                let values = now.as_ref().zip(self.present_value(&change));
                values.is_some_and(|(now, next)| !same(now, &next, change.is_text))
            };
            if is_same || moves {
                changes.end(&address);
                return Ok(());
            }
            if times < WRITES_MAX {
                written |= self.write_back(&mut change);
            }
        }
        for one in changes.all().iter_mut().filter(|one| one.address == address) {
            (one.given_up, one.rejected) = (true, change.rejected.clone());
        }
        Err(Stop::Inconclusive(format!("{} could not be restored", change.what)))
    }

    fn present_value(&mut self, change: &Change) -> Option<Vec<u8>> {
        let exchange = self.send_anyway(change.address.read().ok()?)?;
        exchange.success().map(<[u8]>::to_vec)
    }

    /// Whether the gate allows a write of the original value, or would allow it if the file of
    /// `--allow-write` had not expired.
    fn is_confirmed(&self, change: &Change) -> bool {
        let write = change.address.write(&change.was).ok();
        let Some(write) = write.and_then(|write| RawCall::new(write).ok()) else { return false };
        match self.target.client.check(&write.call()) {
            Err(ExchangeError::NotPermitted(why)) => matches!(why.reason, Reason::Expired(_)),
            checked => checked.is_ok(),
        }
    }

    /// Writes the original value; returns whether the write was accepted.
    fn write_back(&mut self, change: &mut Change) -> bool {
        let send = |probe: &mut Self, change: &Change| {
            change.address.write(&change.was).ok().and_then(|write| probe.send_anyway(write))
        };
        let mut sent = send(self, change);
        if sent
            .as_ref()
            .is_some_and(|sent| matches!(sent.outcome, Err(ExchangeError::NotPermitted(_))))
        {
            // The gate may not have recorded the handle or the list of objects that allows this
            // write, for example on a new connection.
            self.request_again(change);
            sent = send(self, change);
        }
        change.rejected = match sent.as_ref().map(|sent| &sent.outcome) {
            Some(Err(ExchangeError::NotPermitted(why))) => Some(why.to_string()),
            _ => None,
        };
        sent.is_some_and(|sent| sent.success().is_some())
    }

    /// Sends the queries whose replies show the gate that a handle, or the address of an object,
    /// belongs to a name in the file of `--allow-write`. Sends nothing for other addresses, nor for
    /// a handle whose name is unknown.
    fn request_again(&mut self, change: &mut Change) {
        match (&change.address, change.name.clone()) {
            (ValueAddress::Handle { channel, .. }, Some(name)) => {
                let (channel, name) = (*channel, name.as_cnc_str());
                self.send_anyway(HandleByName { channel, name: name.into() });
                self.send_anyway(DescribeByName { channel, name: name.into() });
            }
            (ValueAddress::Object { .. }, _) => {
                let allowed = self.target.client.gate().allowed();
                let entries = allowed.map(|allowed| allowed.entries.clone()).unwrap_or_default();
                for entry in entries {
                    let Entry::Object { list, .. } = entry else { continue };
                    let list = list.list();
                    let Some(count) = self.send_anyway(CountObjects::new(list)) else { continue };
                    let count = count.success();
                    let count = count.and_then(|data| ObjectCount::decode(data).ok());
                    for first in 1..=count.map_or(0, |count| count.0.min(OBJECTS_MAX)) {
                        let Ok(one) = ReadDescriptors::new(list, first, 1) else { break };
                        // A device that no longer answers could delay the end by the timeout of
                        // each descriptor; an incomplete list allows no write.
                        if self.send_anyway(one).is_none_or(|sent| sent.success().is_none()) {
                            break;
                        }
                    }
                }
            }
            _ => {}
        }
    }

    /// Sends a request if the gate allows it, even if the run is interrupted, the deadline has
    /// passed or the target no longer answers. `None` if the request cannot be encoded.
    fn send_anyway<'a>(&mut self, request: impl Into<Request<'a>>) -> Option<Exchange> {
        let request = RawCall::new(request).ok()?;
        self.target.frames = self.target.frames.saturating_add(1);
        Some(self.target.client.call(&request.call()))
    }
}
