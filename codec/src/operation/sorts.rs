//! Sets of functions, by their rules, and numbers for them; all of it made by the compiler.

use super::{Function, Service, Task};
use crate::address::{IndexGroup, IndexOffset};

/// Some of the functions: a bit for each, in the order of the table.
#[derive(Clone, Copy)]
#[cfg_attr(test, derive(Debug, PartialEq, Eq))]
pub(super) struct Functions(pub(super) u32);

/// For all functions, one more that stands for none, and all sorts. A power of two.
pub(super) const ROOM: usize = 32;

const _: () = assert!(
    Function::ALL.len() < ROOM,
    "more than 31 functions: `ROOM` has to be larger, and `Functions` to have more bits"
);

/// Those of which something is so.
macro_rules! those_where {
    (|$spec:ident| $is_so:expr) => {{
        let (mut found, mut bit, mut left) = (0, 1_u32, Function::ALL);
        while let [function, rest @ ..] = left {
            let $spec = function.spec();
            if $is_so {
                found |= bit;
            }
            (bit, left) = (bit << 1, rest);
        }
        Functions(found)
    }};
}

impl Functions {
    pub(super) const NONE: Self = Self(0);
    pub(super) const OF_COM: Self = those_where!(|spec| matches!(spec.task, Task::Com));
    pub(super) const OF_OTHERS: Self = those_where!(|spec| !matches!(spec.task, Task::Com));
    const EXCLUSIVE: Self = those_where!(|spec| !spec.is_content());
    pub(super) const TAKING_READ: Self = those_where!(|spec| matches!(spec.service, Service::Read));
    pub(super) const TAKING_WRITE: Self =
        those_where!(|spec| matches!(spec.service, Service::Write));
    pub(super) const TAKING_READ_WRITE: Self =
        those_where!(|spec| matches!(spec.service, Service::ReadWrite));

    pub(super) const fn in_group(number: u32, of: Self) -> Self {
        match IndexGroup::new(number).parts() {
            Some(parts) => those_where!(|spec| spec.group.holds(parts)).and(of),
            None => Self::NONE,
        }
    }

    pub(super) const fn at(offset: u32) -> Self {
        those_where!(|spec| spec.offset.holds(IndexOffset::new(offset)))
    }

    pub(super) const fn and(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }

    /// Where these are, the one that a service reaches. No content is where a function is, whatever
    /// that takes (SDA-12).
    pub(super) const fn reached(self, taking: Self) -> u8 {
        let here = self.0 & (taking.0 | Self::EXCLUSIVE.0);
        let first = here & here.wrapping_neg();
        match (first & taking.0, first.trailing_zeros().to_le_bytes()) {
            (0, _) => NOTHING,
            (_, [place, ..]) => place,
        }
    }
}

/// No function's place in the table of functions.
pub(super) const NOTHING: u8 = {
    let [nothing, ..] = ROOM.wrapping_sub(1).to_le_bytes();
    nothing
};

/// Sets of functions, each once.
pub(super) struct Sorts(pub(super) [Option<Functions>; ROOM]);

impl Sorts {
    pub(super) const EMPTY: Self = Self([const { None }; ROOM]);

    pub(super) const fn with<const N: usize>(mut self, rows: &[[Functions; N]]) -> Self {
        let mut rows = rows;
        while let [row, below @ ..] = rows {
            let mut sets: &[_] = row;
            while let [set, more @ ..] = sets {
                let mut left: &mut [_] = &mut self.0;
                while let [Some(known), rest @ ..] = left {
                    if known.0 == set.0 {
                        break;
                    }
                    left = rest;
                }
                // There is a place: the tables assert it.
                if let [place, ..] = left {
                    *place = Some(*set);
                }
                sets = more;
            }
            rows = below;
        }
        self
    }

    pub(super) const fn len(&self) -> usize {
        let (mut len, mut left): (usize, &[_]) = (0, &self.0);
        while let [Some(_), rest @ ..] = left {
            (len, left) = (len.saturating_add(1), rest);
        }
        len
    }

    /// The number of a set, `each` from that of the next.
    pub(super) const fn number(&self, set: Functions, each: u8) -> u8 {
        let (mut number, mut left): (u8, &[_]) = (0, &self.0);
        while let [Some(known), rest @ ..] = left {
            if known.0 == set.0 {
                break;
            }
            (number, left) = (number.saturating_add(each), rest);
        }
        number
    }

    pub(super) const fn numbers<const N: usize, const M: usize>(
        &self,
        rows: &[[Functions; N]; M],
        each: u8,
    ) -> [[u8; N]; M] {
        let mut numbers = [[0; N]; M];
        let (mut left, mut rows): (&mut [_], &[_]) = (&mut numbers, rows);
        while let ([of_row, rest @ ..], [row, below @ ..]) = (left, rows) {
            let (mut of_row, mut sets): (&mut [_], &[_]) = (of_row, row);
            while let ([number, others @ ..], [set, more @ ..]) = (of_row, sets) {
                *number = self.number(*set, each);
                (of_row, sets) = (others, more);
            }
            (left, rows) = (rest, below);
        }
        numbers
    }
}
