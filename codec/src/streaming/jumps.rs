//! Which jumps go back, in little memory.

use super::scan::{Label, Scan, Word};

/// So many labels' last places are known at a time.
const KNOWN: usize = 64;

/// So many bytes below a jump are looked at before the text is read again.
const NEAR: usize = 2048;

/// What is known of the labels of a text.
///
/// A jump whose label has not been passed, or is near below, does not go back: no more is to be
/// known, and a text in which jumps go forward and not far is read once. For another jump the
/// text is read again; that finds the last places of its label and of those of the jumps below
/// it, until the table is full.
#[derive(Clone)]
pub(super) struct Jumps<'a> {
    passed: Filter,
    known: [Option<Known<'a>>; KNOWN],
}

#[derive(Clone, Copy)]
struct Known<'a> {
    label: Label<'a>,
    /// The last line with the label; 0 if none has it.
    line: u32,
}

impl<'a> Jumps<'a> {
    pub(super) const fn new() -> Self {
        Self { passed: Filter::new(), known: [None; KNOWN] }
    }

    /// The scan comes by a label.
    pub(super) fn pass(&mut self, label: &Label<'_>) {
        self.passed.add(label.hash());
    }

    /// The line to which a jump in `line` goes back: the last one that has the label, if that is
    /// not below. `here` is right behind the jump.
    pub(super) fn back(
        &mut self,
        label: Label<'a>,
        line: u32,
        text: &'a [u8],
        here: &Scan<'a>,
    ) -> Option<u32> {
        if !self.passed.may_have(label.hash()) {
            return None;
        }
        let last = match self.find(&label) {
            Some(known) => known.line,
            None if here.clone().labels(NEAR).any(|(near, _)| near == label) => return None,
            None => {
                self.learn(label, text, here);
                self.find(&label)?.line
            }
        };
        (1..=line).contains(&last).then_some(last)
    }

    fn find(&mut self, label: &Label<'_>) -> Option<&mut Known<'a>> {
        self.known.iter_mut().map_while(Option::as_mut).find(|known| known.label == *label)
    }

    fn learn(&mut self, first: Label<'a>, text: &'a [u8], here: &Scan<'a>) {
        self.known = [None; KNOWN];
        let mut wanted = Filter::new();
        let mut below = here.clone().filter_map(|token| match token.word {
            Word::Goto(label) => Some(label),
            _ => None,
        });
        let mut next = Some(first);
        for at in 0..KNOWN {
            while next.is_some_and(|label| self.find(&label).is_some()) {
                next = below.next();
            }
            let (Some(label), Some(place)) = (next, self.known.get_mut(at)) else { break };
            *place = Some(Known { label, line: 0 });
            wanted.add(label.hash());
        }
        for (label, line) in Scan::new(text).labels(usize::MAX) {
            if wanted.may_have(label.hash()) {
                if let Some(known) = self.find(&label) {
                    known.line = line;
                }
            }
        }
    }
}

/// A set that may take one number for another.
#[derive(Clone)]
struct Filter([u64; 64]);

impl Filter {
    const fn new() -> Self {
        Self([0; 64])
    }

    /// Word and bit.
    fn place(hash: u32) -> (usize, u64) {
        let [low, high, ..] = hash.to_le_bytes();
        ((low & 63).into(), 1_u64.rotate_left((high & 63).into()))
    }

    fn add(&mut self, hash: u32) {
        let (word, bit) = Self::place(hash);
        if let Some(word) = self.0.get_mut(word) {
            *word |= bit;
        }
    }

    fn may_have(&self, hash: u32) -> bool {
        let (word, bit) = Self::place(hash);
        self.0.get(word).is_some_and(|word| word & bit != 0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A label that has not been passed is taken for one that has only if its place is taken: else
    /// a text would be read again for nothing.
    #[test]
    fn a_filter_tells_all_places_apart() {
        let rows = (0..64_u32).step_by(if cfg!(miri) { 21 } else { 1 });
        let places = || rows.clone().flat_map(|high| (0..64).map(move |low| high << 8 | low));
        for added in [0, 0x3F, 0x3F00, 0x1234, 0x2A15] {
            let mut filter = Filter::new();
            filter.add(added | 0xFFFF_C0C0);
            for place in places() {
                assert_eq!(filter.may_have(place), place == added & 0x3F3F, "{added:x} {place:x}");
            }
            filter.add(0x0102);
            assert!(filter.may_have(added) && filter.may_have(0x0102));
        }
    }
}
