//! Writes of a case. [`Probe::try_write`] sends another value than the current one, reads it back,
//! and restores the original value. [`Probe::write_rejected`] writes to a read-only address.

#![cfg_attr(
    not(test),
    deny(clippy::arithmetic_side_effects, clippy::as_conversions, clippy::indexing_slicing),
    deny(clippy::expect_used, clippy::panic, clippy::string_slice, clippy::unreachable),
    deny(clippy::unwrap_used)
)]

use ads_cnc::CncString;
use ads_cnc::operation::Request;
use ads_cnc_vectors::Hex;

use crate::judge::{Checks as _, Rule, Step, Stop};
use crate::objects::ValueAddress;
use crate::suite::kit::{Probe, RawCall};
use crate::text::plural;
use crate::values::until_nul;

/// One of the reasons why a case that writes is not applicable.
pub(crate) const NOTHING_WRITABLE: &str = "no such value may be written";

/// Whether a request can be encoded: a long value together with a long name cannot.
pub(crate) fn is_sendable(request: &Request<'_>) -> bool {
    RawCall::new(*request).is_ok()
}

/// Returns a value that differs from `value`: for a text, in its first character, otherwise in one
/// bit of its first byte. An empty value and a text of less than two bytes, which has no space for
/// a character, are returned unchanged.
pub(crate) fn changed_value(value: &[u8], is_text: bool) -> Vec<u8> {
    if is_text && value.len() < 2 {
        return value.to_vec();
    }
    let mut other = value.to_vec();
    if let Some(first) = other.first_mut() {
        *first = match (is_text, *first) {
            (true, b'a') => b'b',
            (true, _) => b'a',
            (false, byte) => byte ^ 1,
        };
    }
    // An empty text gets one character; all following bytes become NUL.
    if is_text && value.first() == Some(&0) {
        other.iter_mut().skip(1).for_each(|byte| *byte = 0);
    }
    other
}

/// Whether two values are equal; texts are compared up to their first NUL.
pub(crate) fn same(one: &[u8], other: &[u8], is_text: bool) -> bool {
    one == other || is_text && until_nul(one) == until_nul(other)
}

/// The rules of a write, the name of the value (`what`), and whether the value is a text.
pub(crate) struct WriteCheck<'t> {
    pub(crate) what: &'t str,
    pub(crate) rules: &'t [Rule],
    pub(crate) is_text: bool,
    /// The name of the variable, by which its handle can be requested again; `None` if the case
    /// does not state it.
    pub(crate) name: Option<&'t CncString>,
}

impl Probe<'_> {
    /// The current value; `None` if it cannot be read, which other cases judge.
    pub(crate) fn value_at(&mut self, address: &ValueAddress) -> Step<Option<Vec<u8>>> {
        match address.read() {
            Ok(read) => self.try_ask(read),
            Err(_) => Ok(None),
        }
    }

    /// The current value, unless it is empty: an empty value could not be restored.
    pub(crate) fn filled_value_at(&mut self, address: &ValueAddress) -> Step<Option<Vec<u8>>> {
        Ok(self.value_at(address)?.filter(|value| !value.is_empty()))
    }

    /// Whether a value changes by itself between two reads. False if the value cannot be read.
    pub(crate) fn moves(&mut self, address: &ValueAddress, is_text: bool) -> Step<bool> {
        let values = self.value_at(address)?.zip(self.value_at(address)?);
        Ok(values.is_some_and(|(first, second)| !same(&first, &second, is_text)))
    }

    /// Whether a value equals the original one. False if the value cannot be read.
    pub(crate) fn is_as_before(
        &mut self,
        address: &ValueAddress,
        was: &[u8],
        is_text: bool,
    ) -> Step<bool> {
        Ok(self.value_at(address)?.is_some_and(|now| same(&now, was, is_text)))
    }

    /// Whether the [gate](crate::gate) and the profile permit a write at this address of the value
    /// with this name.
    pub(crate) fn may_write(&mut self, address: &ValueAddress, name: &str) -> Step<bool> {
        let left = self.target.profile.leaves(name);
        match address.write(&[]) {
            Ok(write) if !left => self.may(write),
            _ => Ok(false),
        }
    }

    /// Writes a value, and returns whether the write was accepted. Returns false without a request
    /// if the write cannot be encoded.
    pub(crate) fn write_value(&mut self, address: &ValueAddress, value: &[u8]) -> Step<bool> {
        let Some(write) = address.write(value).ok().filter(is_sendable) else { return Ok(false) };
        self.target.changes.is_now(address, Some(value));
        let exchange = self.send(write)?;
        Ok(exchange.success().is_some())
    }

    /// Writes a value, checks that the write is accepted, and returns whether it was. The case is
    /// inconclusive if the write cannot be encoded.
    pub(crate) fn write_checked(
        &mut self,
        write_check: &WriteCheck<'_>,
        address: &ValueAddress,
        value: &[u8],
    ) -> Step<bool> {
        let Some(write) = address.write(value).ok().filter(is_sendable) else {
            let why = format!(
                "{} of {} cannot be written",
                write_check.what,
                plural(value.len(), "byte")
            );
            return Err(Stop::Inconclusive(why));
        };
        self.target.changes.is_now(address, Some(value));
        let exchange = self.send(write)?;
        let passed = exchange.success().is_some();
        let expected = || format!("{} accepts {}", write_check.what, Hex(value.to_vec()));
        self.check(write_check.rules, passed, expected, &exchange);
        Ok(passed)
    }

    /// Writes the current value and, if that is accepted, another value; reads it back, and then
    /// restores the original value, also if a step fails. Writes nothing if the current value
    /// cannot be read, is empty, or does not fit into a write.
    ///
    /// Calls `then` with the original and the written value before restoring, unless a write was
    /// rejected, or the value changes by itself and was not read back as written. If the gate
    /// allows malformed requests and `then` succeeds, also changes every byte of a value that was
    /// read back as written, has at least two bytes and is not a text.
    pub(crate) fn try_write(
        &mut self,
        write_check: &WriteCheck<'_>,
        address: &ValueAddress,
        then: impl FnOnce(&mut Self, &[u8], &[u8]) -> Step,
    ) -> Step {
        self.found_subject();
        let Some(before) = self.filled_value_at(address)? else {
            return Ok(());
        };
        if !address.write(&before).is_ok_and(|write| is_sendable(&write)) {
            return Ok(());
        }
        let other = changed_value(&before, write_check.is_text);
        // The current value is written first, because this write should change nothing.
        if !self.write_checked(write_check, address, &before)? {
            return Ok(());
        }
        self.changing(
            write_check,
            address,
            &before,
            |probe| probe.change(write_check, address, &before, &other, then),
            |probe| probe.restore_checked(write_check, address, &before),
        )
    }

    fn change(
        &mut self,
        write_check: &WriteCheck<'_>,
        address: &ValueAddress,
        before: &[u8],
        other: &[u8],
        then: impl FnOnce(&mut Self, &[u8], &[u8]) -> Step,
    ) -> Step {
        if !self.write_checked(write_check, address, other)? {
            return Ok(());
        }
        let after = self.value_at(address)?.unwrap_or_default();
        let passed = same(&after, other, write_check.is_text);
        // A value that changes by itself is not judged.
        if !passed && self.moves(address, write_check.is_text)? {
            return Ok(());
        }
        let expected = || format!("{} of {}, as written", Hex(other.to_vec()), write_check.what);
        self.check(write_check.rules, passed, expected, || Hex(after.clone()));
        then(self, before, other)?;
        if passed && !write_check.is_text && self.target.client.gate().lets_malformed_pass() {
            self.change_every_byte(write_check, address, before)?;
        }
        Ok(())
    }

    /// Writes a value of at least two bytes that differs from the original one in every byte. If
    /// the CNC accepts the write, the value that is read back must have the same length, and must
    /// not be the original one nor a mixture of the bytes of both values. It may be another value
    /// than the written one, because the CNC may limit a value to its range. A value that changes
    /// by itself is not judged.
    fn change_every_byte(
        &mut self,
        write_check: &WriteCheck<'_>,
        address: &ValueAddress,
        before: &[u8],
    ) -> Step {
        let other: Vec<u8> = before.iter().map(|byte| byte ^ 1).collect();
        if other.len() < 2 || !self.write_value(address, &other)? {
            return Ok(());
        }
        // Without a successful read, the value is unknown.
        let Some(after) = self.value_at(address)? else { return Ok(()) };
        let mut bytes = after.iter().zip(before.iter().zip(&other));
        let is_mixed = bytes.all(|(byte, (old, new))| byte == old || byte == new);
        let passed = after == other || after.len() == other.len() && !is_mixed;
        if passed || !self.moves(address, false)? {
            let expected = || format!("{} of {}, as written", Hex(other.clone()), write_check.what);
            self.check(write_check.rules, passed, expected, || Hex(after));
        }
        Ok(())
    }

    /// Writes the original value and checks that it is read back. Returns whether it was; for a
    /// value that changes by itself, returns whether the write was accepted.
    fn restore_checked(
        &mut self,
        write_check: &WriteCheck<'_>,
        address: &ValueAddress,
        before: &[u8],
    ) -> Step<bool> {
        let taken = self.write_checked(write_check, address, before)?;
        // Without a successful read, the value is unknown.
        let Some(after) = self.value_at(address)? else { return Ok(false) };
        let passed = same(&after, before, write_check.is_text);
        if !passed && self.moves(address, write_check.is_text)? {
            return Ok(taken);
        }
        let expected = || format!("{} of {}, restored", Hex(before.to_vec()), write_check.what);
        self.check(write_check.rules, passed, expected, || Hex(after.clone()));
        Ok(passed)
    }

    /// Checks that a write of the current value to a read-only address is rejected. Before that,
    /// writes the current value of the `sibling`, a writable address, if there is one; if this
    /// write is not accepted, the case is inconclusive. Checks nothing if a current value cannot be
    /// read, or if the value at the read-only address is empty or does not fit into a write.
    pub(crate) fn write_rejected(
        &mut self,
        write_check: &WriteCheck<'_>,
        address: &ValueAddress,
        sibling: Option<&ValueAddress>,
    ) -> Step {
        self.found_subject();
        if let Some(sibling) = sibling {
            let Some(taken) = self.value_at(sibling)? else { return Ok(()) };
            let Some(write) = sibling.write(&taken).ok().filter(is_sendable) else {
                return Err(Stop::inconclusive(
                    "no comparable address has a value that can be written",
                ));
            };
            let exchange = self.send(write)?;
            if exchange.success().is_none() {
                // Another case judges whether writable addresses accept a value.
                let why = format!("no comparable address accepts a write: {}", exchange.result());
                return Err(Stop::Inconclusive(why));
            }
        }
        let Some(before) = self.filled_value_at(address)? else {
            return Ok(());
        };
        let Ok(write) = address.write(&before) else { return Ok(()) };
        if !is_sendable(&write) {
            return Ok(());
        }
        let exchange = self.send(write)?;
        let rejected = exchange.is_error();
        let expected = || format!("an error number for a write of {}", write_check.what);
        self.check(write_check.rules, rejected, expected, &exchange);
        Ok(())
    }
}
