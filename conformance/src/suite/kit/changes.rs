//! The values that cases have changed with `Probe::changing`, and those of them that have not been
//! restored.

#![cfg_attr(
    not(test),
    deny(clippy::arithmetic_side_effects, clippy::as_conversions, clippy::indexing_slicing),
    deny(clippy::expect_used, clippy::panic, clippy::string_slice, clippy::unreachable),
    deny(clippy::unwrap_used)
)]

use std::collections::BTreeSet;
use std::sync::{Arc, Mutex, MutexGuard};

use ads_cnc::CncString;
use ads_cnc_vectors::Hex;

use crate::judge::UnrestoredValue;
use crate::mutex::lock;
use crate::objects::ValueAddress;
use crate::text::escape;

/// Changed values that have not been restored yet, or that could not be restored. Clones share the
/// list, because the handler of an interrupt reads it, too.
#[derive(Clone, Debug, Default)]
pub struct Changes {
    all: Arc<Mutex<Vec<Change>>>,
    /// Names of all values that cases have begun to change so far.
    written: Arc<Mutex<BTreeSet<String>>>,
}

/// A value that may have been changed.
#[derive(Clone, Debug)]
pub(super) struct Change {
    pub(super) address: ValueAddress,
    /// The name of a variable, by which its handle can be requested again; `None` if the case did
    /// not state it.
    pub(super) name: Option<CncString>,
    /// The address by name of a variable that is written by handle, if its name is known.
    pub(super) by_name: Option<ValueAddress>,
    /// The name of the value in messages.
    pub(super) what: String,
    pub(super) is_text: bool,
    /// The original value.
    pub(super) was: Vec<u8>,
    /// The current value as last set by [`Changes::is_now`]; `None` if it is unknown.
    pub(super) is: Option<Vec<u8>>,
    /// Why the [gate](crate::gate) rejected the last write that was to restore the value; `None` if
    /// it did not reject this write.
    pub(super) rejected: Option<String>,
    /// Whether restoring the value was given up, because all attempts failed or a panic ended them.
    pub(super) given_up: bool,
}

impl Change {
    /// Uses the address by name, if it is known, from now on.
    pub(super) fn use_name(&mut self) {
        if let Some(by_name) = self.by_name.take() {
            self.address = by_name;
        }
    }
}

impl Changes {
    /// The values that have not been restored, including those that were given up, the first change
    /// first.
    pub fn left(&self) -> Vec<UnrestoredValue> {
        let all = self.all();
        let left = all.iter().map(|change| UnrestoredValue {
            name: escape(&change.what),
            was: Hex(change.was.clone()).to_string(),
            is: change.is.as_ref().map(|is| Hex(is.clone()).to_string()),
            rejected: change.rejected.as_deref().map(escape),
        });
        left.collect()
    }

    /// The names of all values that cases have begun to change so far, without duplicates.
    pub fn written(&self) -> Vec<String> {
        let written = lock(&self.written);
        written.iter().cloned().collect()
    }

    /// Whether a changed value is still to be restored. Values that were given up do not count.
    pub(crate) fn any_pending(&self) -> bool {
        self.last().is_some()
    }

    /// Gives up restoring all values in the list.
    pub(crate) fn give_up(&self) {
        self.all().iter_mut().for_each(|change| change.given_up = true);
    }

    /// Whether restoring any value in the list was given up.
    pub(crate) fn any_given_up(&self) -> bool {
        self.all().iter().any(|change| change.given_up)
    }

    /// The last change that is still to be restored. Changes that were given up are left out.
    pub(super) fn last(&self) -> Option<Change> {
        self.all().iter().rfind(|change| !change.given_up).cloned()
    }

    /// Records that a value may differ from its original value from now on.
    pub(super) fn begin(&self, change: Change) {
        let mut written = lock(&self.written);
        written.insert(change.what.clone());
        self.all().push(change);
    }

    /// Sets the current value in all changes at an address; `None` if the value is unknown.
    pub(crate) fn is_now(&self, address: &ValueAddress, value: Option<&[u8]>) {
        for change in self.all().iter_mut().filter(|change| change.address == *address) {
            change.is = value.map(<[u8]>::to_vec);
        }
    }

    /// Removes the changes at an address: the original value was read back, or the value changes by
    /// itself.
    pub(super) fn end(&self, address: &ValueAddress) {
        self.all().retain(|change| change.address != *address);
    }

    pub(super) fn all(&self) -> MutexGuard<'_, Vec<Change>> {
        lock(&self.all)
    }
}
