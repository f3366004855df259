//! Which functions are at an address: in tables that the compiler makes from the rows of all
//! functions, by their rules.

use super::{Function, Service, Task};
use crate::address::{AxisStride, IndexGroup, IndexOffset};
use crate::bytes::to_len;

/// Some of the functions: a bit for each, in the order of the table.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) struct Functions(u32);

const _: () = assert!(Function::ALL.len() <= 32);

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
    const NONE: Self = Self(0);
    const OF_COM: Self = those_where!(|spec| matches!(spec.task, Task::Com));
    const OF_OTHERS: Self = those_where!(|spec| !matches!(spec.task, Task::Com));
    const TAKING_READ: Self = those_where!(|spec| matches!(spec.service, Service::Read));
    const TAKING_WRITE: Self = those_where!(|spec| matches!(spec.service, Service::Write));
    const TAKING_READ_WRITE: Self = those_where!(|spec| matches!(spec.service, Service::ReadWrite));

    /// Those that are no access to content.
    pub(super) const EXCLUSIVE: Self = those_where!(|spec| !spec.is_content());

    /// Those that take the service.
    pub(super) const fn taking(service: Service) -> Self {
        match service {
            Service::Read => Self::TAKING_READ,
            Service::Write => Self::TAKING_WRITE,
            Service::ReadWrite => Self::TAKING_READ_WRITE,
        }
    }

    /// Those that have an instance in the group and are answered by the task. SDA and GEO stand
    /// in for each other, COM for none.
    #[inline]
    pub(super) fn in_group(task: Task, group: IndexGroup) -> Self {
        let tables = match (task, group.get() >> 16) {
            (Task::Com, 0x12 | 0x02) => &COM_ELEMENTS[..],
            (Task::Com, 0x13 | 0x03) => &COM_OBJECTS[..],
            (Task::Sda | Task::Geo, 0x12) => &LOGICAL[..],
            (Task::Sda | Task::Geo, 0x02) => &BY_INDEX[..],
            _ => return Self::NONE,
        };
        let [instance, table, ..] = group.get().to_le_bytes();
        match tables.get(usize::from(table)) {
            Some([_, of_instances]) if instance > 0 => *of_instances,
            Some([without, _]) => *without,
            None => Self::NONE,
        }
    }

    /// Those that have the offset.
    pub(super) fn at(offset: IndexOffset) -> Self {
        match offset.axis_and_element(AxisStride::X10000) {
            Ok((0, element)) => of_element(&OF_CHANNEL, element),
            Ok((_, element)) => of_element(&OF_AXES, element),
            Err(_) => Self::NONE,
        }
    }

    pub(super) const fn and(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }

    pub(super) const fn or(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    pub(super) const fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// The first in the table, alone.
    pub(super) const fn first(self) -> Self {
        Self(self.0 & self.0.wrapping_neg())
    }

    /// The first in the table.
    pub(super) fn function(self) -> Option<Function> {
        Function::ALL.get(to_len(self.0.trailing_zeros())).copied()
    }
}

/// Of each table of a class and of COM's two, without an instance and with one. None depends on
/// which instance it is.
const fn of_tables<const TABLES: usize>(first: u32, of: Functions) -> [[Functions; 2]; TABLES] {
    let mut tables = [[Functions::NONE; 2]; TABLES];
    let (mut left, mut number): (&mut [_], _) = (&mut tables, first);
    while let [table, rest @ ..] = left {
        *table = [of_number(number).and(of), of_number(number | 1).and(of)];
        (left, number) = (rest, number.saturating_add(0x100));
    }
    tables
}

const fn of_number(group: u32) -> Functions {
    match IndexGroup::new(group).parts() {
        Some(parts) => those_where!(|spec| spec.group.holds(parts)),
        None => Functions::NONE,
    }
}

static COM_ELEMENTS: [[Functions; 2]; 3] = of_tables(0x02_0000, Functions::OF_COM);
static COM_OBJECTS: [[Functions; 2]; 3] = of_tables(0x03_0000, Functions::OF_COM);
static LOGICAL: [[Functions; 2]; 0x4A] = of_tables(0x12_0000, Functions::OF_OTHERS);
static BY_INDEX: [[Functions; 2]; 0x5A] = of_tables(0x02_0000, Functions::OF_OTHERS);

/// Of each element from 0 on; the last one stands for all that follow.
const fn of_elements<const ELEMENTS: usize>(first: u32) -> [Functions; ELEMENTS] {
    let mut elements = [Functions::NONE; ELEMENTS];
    let (mut left, mut offset): (&mut [_], _) = (&mut elements, first);
    while let [element, rest @ ..] = left {
        *element = those_where!(|spec| spec.offset.holds(IndexOffset::new(offset)));
        (left, offset) = (rest, offset.saturating_add(1));
    }
    elements
}

static OF_CHANNEL: [Functions; 0x92] = of_elements(0);
static OF_AXES: [Functions; 8] = of_elements(0x1_0000);

fn of_element(elements: &[Functions], element: u32) -> Functions {
    let last = elements.last().copied().unwrap_or(Functions::NONE);
    elements.get(to_len(element)).copied().unwrap_or(last)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The tables say what the rules say: of every group, and of every element of a channel and of
    /// some axes.
    #[test]
    #[cfg_attr(miri, ignore = "too many numbers for an interpreter")]
    fn tables_follow_the_rules() {
        for number in (0..=0xFF_FFFF).chain([0x0112_2301, 0x1012_2301, u32::MAX]) {
            let group = IndexGroup::new(number);
            let wanted = of_number(number);
            let found = |task| Functions::in_group(task, group);
            assert!(found(Task::Com) == wanted.and(Functions::OF_COM), "{group}");
            assert!(found(Task::Sda) == wanted.and(Functions::OF_OTHERS), "{group}");
            assert!(found(Task::Geo) == found(Task::Sda), "{group}");
        }
        for axis in [0, 1, 2, 15, 16, 0x7FFF, 0xFFFF_u32] {
            for element in 0..=0xFFFF {
                let offset = IndexOffset::new((axis << 16) | element);
                let wanted = those_where!(|spec| spec.offset.holds(offset));
                assert!(Functions::at(offset) == wanted, "{offset}");
            }
        }
    }
}
