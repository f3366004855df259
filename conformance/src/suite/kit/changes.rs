//! Values that cases have changed and that are not yet seen as they were.

#![cfg_attr(
    not(test),
    deny(clippy::arithmetic_side_effects, clippy::as_conversions, clippy::indexing_slicing),
    deny(clippy::expect_used, clippy::panic, clippy::string_slice, clippy::unreachable),
    deny(clippy::unwrap_used)
)]

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use ads_cnc::CncString;
use ads_cnc_vectors::Hex;

use crate::judge::LeftChanged;
use crate::objects::ValueAddress;
use crate::text::escape;

/// Values that were changed and not yet seen as they were; those that could not be restored stay.
/// Clones share them: what ends the process looks at them too.
#[derive(Clone, Debug, Default)]
pub struct Changes(Arc<Mutex<Vec<Change>>>);

/// A value that was changed.
#[derive(Clone, Debug)]
pub(super) struct Change {
    pub(super) address: ValueAddress,
    /// Of a variable: by which its handle is asked for.
    pub(super) name: Option<CncString>,
    /// Of a variable that is written by its handle: the other way to it.
    pub(super) by_name: Option<ValueAddress>,
    pub(super) what: String,
    pub(super) is_text: bool,
    pub(super) was: Vec<u8>,
    /// What it was last written or read as.
    pub(super) is: Option<Vec<u8>>,
    /// Why the gate did not let the last restoring write pass.
    pub(super) refused: Option<String>,
    /// Whether it could not be restored.
    pub(super) given_up: bool,
}

impl Changes {
    /// What is not as it was, the first change first.
    pub fn left(&self) -> Vec<LeftChanged> {
        let all = self.all();
        let left = all.iter().map(|change| LeftChanged {
            name: escape(&change.what),
            was: Hex(change.was.clone()).to_string(),
            is: change.is.as_ref().map(|is| Hex(is.clone()).to_string()),
            refused: change.refused.as_deref().map(escape),
        });
        left.collect()
    }

    /// Whether a value is changed that is still to be restored.
    pub(crate) fn any_pending(&self) -> bool {
        self.last().is_some()
    }

    /// Nothing that is changed is restored any more.
    pub(crate) fn give_up(&self) {
        self.all().iter_mut().for_each(|change| change.given_up = true);
    }

    /// Whether something could not be restored.
    pub(crate) fn any_given_up(&self) -> bool {
        self.all().iter().any(|change| change.given_up)
    }

    /// The last that is to be restored.
    pub(super) fn last(&self) -> Option<Change> {
        self.all().iter().rfind(|change| !change.given_up).cloned()
    }

    /// What is written to this place from now on is not what was there.
    pub(super) fn begin(&self, change: Change) {
        self.all().push(change);
    }

    /// What is there now, as far as anybody knows.
    pub(crate) fn is_now(&self, address: &ValueAddress, value: Option<&[u8]>) {
        for change in self.all().iter_mut().filter(|change| change.address == *address) {
            change.is = value.map(<[u8]>::to_vec);
        }
    }

    /// The value at this place was seen as it was.
    pub(super) fn end(&self, address: &ValueAddress) {
        self.all().retain(|change| change.address != *address);
    }

    pub(super) fn all(&self) -> MutexGuard<'_, Vec<Change>> {
        // A list that somebody panicked beside is whole.
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
