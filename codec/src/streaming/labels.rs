//! The labels of checked lines.

use alloc::collections::BTreeMap;
use alloc::vec::Vec;

use super::scan::Label;

/// The maximum number of labels of a generation of a `Checker`. The checker therefore remembers at
/// least this number of recent different labels if their keys have at most [`CHARACTERS`] bytes
/// together, except those that [`Labels::keep`] removes.
pub(super) const LABELS: usize = 8192;

/// The number of bytes of the keys of a generation of a `Checker` at which the generation is full.
pub(super) const CHARACTERS: usize = 256 * 1024;

/// The last line of each recent label: of the programs in the part of the text that is being
/// checked, and, from earlier parts, of the program that continues in this part.
#[derive(Clone, Debug)]
pub(super) struct Labels {
    recent: Generation,
    /// The previous generation. The recent generation replaces it when a label is recorded while
    /// the recent generation is full.
    before: Generation,
    /// The maximum number of labels of a generation.
    labels: usize,
    /// The maximum number of characters of the keys of a generation, without its last label.
    characters: usize,
}

#[derive(Clone, Debug)]
struct Generation {
    /// The last line of each label, by the program and the name of the label.
    lines: BTreeMap<(u32, Vec<u8>), u32>,
    characters: usize,
}

impl Generation {
    const EMPTY: Self = Self { lines: BTreeMap::new(), characters: 0 };
}

impl Labels {
    pub(super) const fn with_limits(labels: usize, characters: usize) -> Self {
        Self { recent: Generation::EMPTY, before: Generation::EMPTY, labels, characters }
    }

    /// Records the line of a label.
    pub(super) fn record(&mut self, label: &Label<'_>, line: u32) {
        let recent = &mut self.recent;
        if recent.lines.len() >= self.labels || recent.characters >= self.characters {
            self.before = core::mem::replace(recent, Generation::EMPTY);
        }
        let name = label.key();
        let characters = name.len();
        if recent.lines.insert((label.program(), name), line).is_none() {
            recent.characters = recent.characters.saturating_add(characters);
        }
    }

    /// The last recorded line of the label.
    pub(super) fn last(&self, label: &Label<'_>) -> Option<u32> {
        let key = (label.program(), label.key());
        self.recent.lines.get(&key).or_else(|| self.before.lines.get(&key)).copied()
    }

    /// Removes the labels of other programs, which cannot be targets of jumps in later lines.
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
