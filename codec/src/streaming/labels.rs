//! The labels of lines that are gone, in bounded memory.

use alloc::collections::BTreeMap;
use alloc::vec::Vec;

use super::scan::Label;

/// So many labels, the latest, are known at least …
pub(super) const LABELS: usize = 8192;

/// … if all of them together have no more characters than this.
pub(super) const CHARACTERS: usize = 256 * 1024;

/// The last line of each label of the present program, and of those before it that came with the
/// same lines.
#[derive(Clone, Debug, Default)]
pub(super) struct Labels {
    recent: Generation,
    /// Full; forgotten when the recent one is.
    before: Generation,
}

#[derive(Clone, Debug, Default)]
struct Generation {
    /// By program and name.
    lines: BTreeMap<(u32, Vec<u8>), u32>,
    characters: usize,
}

impl Labels {
    /// The scan comes by a label.
    pub(super) fn pass(&mut self, label: &Label<'_>, line: u32) {
        let recent = &mut self.recent;
        if recent.lines.len() >= LABELS || recent.characters >= CHARACTERS {
            self.before = core::mem::take(recent);
        }
        let name = label.key();
        let characters = name.len();
        if recent.lines.insert((label.program(), name), line).is_none() {
            recent.characters = recent.characters.saturating_add(characters);
        }
    }

    /// The last line with the label.
    pub(super) fn last(&self, label: &Label<'_>) -> Option<u32> {
        let key = (label.program(), label.key());
        self.recent.lines.get(&key).or_else(|| self.before.lines.get(&key)).copied()
    }

    /// Forgets other programs: no jump goes there any more.
    pub(super) fn keep(&mut self, program: u32) {
        for generation in [&mut self.recent, &mut self.before] {
            let first = generation.lines.first_key_value().map(|((program, _), _)| *program);
            if first.is_some_and(|first| first != program) {
                generation.lines.retain(|(of, _), _| *of == program);
                generation.characters = generation.lines.keys().map(|(_, name)| name.len()).sum();
            }
        }
    }
}
