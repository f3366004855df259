//! Which function is at an address: by tables that the compiler makes from the rows of all
//! functions, by their rules.
//!
//! Groups of the same functions are alike, and so are offsets. A table has a number for each sort of
//! groups, one for each sort of offsets, and one the function that a service reaches where a sort
//! of each meet.

use super::sorts::{Functions, NOTHING, ROOM, Sorts};
use super::{Function, Service};
use crate::address::{IndexGroup, IndexOffset};
use crate::ads::AmsPort;
use crate::bytes::to_len;

const LOGICAL: u32 = 0x10_0000;
const CLASSES: u32 = 0x02_0000;

/// Of a table of COM, without an instance and with one. None depends on which instance it is, nor
/// on the addressing.
const fn of_com(group: u32) -> [Functions; 2] {
    let of = Functions::OF_COM;
    [Functions::in_group(group, of), Functions::in_group(group | 1, of)]
}

/// Of a table of a class, by index and logical, without an instance and with one.
const fn of_class(group: u32) -> [Functions; 4] {
    let of = Functions::OF_OTHERS;
    [
        Functions::in_group(group, of),
        Functions::in_group(group | 1, of),
        Functions::in_group(group | LOGICAL, of),
        Functions::in_group(group | LOGICAL | 1, of),
    ]
}

const OF_COM: [[Functions; 2]; 4] =
    [of_com(0x02_0100), of_com(0x02_0200), of_com(0x03_0100), of_com(0x03_0200)];

const OF_CLASSES: [[Functions; 4]; 0x5A] = {
    let mut tables = [[Functions::NONE; 4]; 0x5A];
    let (mut left, mut group): (&mut [_], _) = (&mut tables, CLASSES);
    while let [table, rest @ ..] = left {
        *table = of_class(group);
        (left, group) = (rest, group.saturating_add(0x100));
    }
    tables
};

/// Of the elements of a channel and of axes as [`element`] counts them.
const OF_ELEMENTS: [[Functions; 1]; 0x99] = {
    let mut elements = [[Functions::NONE]; 0x99];
    let (mut left, mut offset): (&mut [_], _) = (&mut elements, 0_u32);
    while let [element, rest @ ..] = left {
        *element = [Functions::at(offset)];
        (left, offset) = match offset {
            LAST_OF_CHANNEL => (rest, 0x1_0000),
            _ => (rest, offset.saturating_add(1)),
        };
    }
    elements
};

const LAST_OF_CHANNEL: u32 = 0x90;

/// Elements of a channel, then those of any axis, the last of which stands for all that follow,
/// those of a channel too.
#[inline]
fn element(offset: IndexOffset) -> usize {
    let offset = to_len(offset.get());
    match (offset, offset & 0xFFFF) {
        (element @ 0..=0x90, _) => element,
        (0x1_0000.., element @ 0..=6) => element.wrapping_add(0x91),
        _ => 0x98,
    }
}

/// The first is that of none.
const GROUPS: Sorts = Sorts::EMPTY.with(&[[Functions::NONE]]).with(&OF_COM).with(&OF_CLASSES);
const OFFSETS: Sorts = Sorts::EMPTY.with(&OF_ELEMENTS);

const _: () = assert!(
    GROUPS.len() < ROOM && OFFSETS.len() < ROOM,
    "one more sort of groups or of offsets would be left out: `ROOM` has to be larger"
);

const GROUPS_OF_COM: [[u8; 2]; 4] = GROUPS.numbers(&OF_COM, 1);
static GROUPS_OF_CLASSES: [[u8; 4]; 0x5A] = GROUPS.numbers(&OF_CLASSES, 1);
static OFFSETS_OF_ELEMENTS: [[u8; 1]; 0x99] = OFFSETS.numbers(&OF_ELEMENTS, 3);

/// By sort of group, sort of offset and service: the function's place in the table of functions.
static REACHED: [[[u8; 3]; OFFSETS.len()]; GROUPS.len()] = {
    let mut reached = [[[NOTHING; 3]; OFFSETS.len()]; GROUPS.len()];
    let (mut left, mut groups): (&mut [_], &[_]) = (&mut reached, &GROUPS.0);
    while let ([of_group, rest @ ..], [Some(group), others @ ..]) = (left, groups) {
        let (mut of_group, mut offsets): (&mut [_], &[_]) = (of_group, &OFFSETS.0);
        while let ([at_offset, below @ ..], [Some(offset), more @ ..]) = (of_group, offsets) {
            let here = group.and(*offset);
            *at_offset = [
                here.reached(Functions::TAKING_READ),
                here.reached(Functions::TAKING_WRITE),
                here.reached(Functions::TAKING_READ_WRITE),
            ];
            (of_group, offsets) = (below, more);
        }
        (left, groups) = (rest, others);
    }
    reached
};

/// Which sorts of group and offset meet at an address.
#[derive(Clone, Copy)]
#[cfg_attr(test, derive(Debug))]
pub(super) struct Place {
    group: usize,
    /// Times three, one for each service.
    offset: usize,
}

impl Place {
    /// That of a port, a group and an offset. SDA and GEO stand in for each other, COM for none.
    #[inline]
    pub(super) fn of(port: AmsPort, group: IndexGroup, offset: IndexOffset) -> Self {
        let group = match port {
            AmsPort::COM => group_of_com(group),
            AmsPort::SDA | AmsPort::GEO => group_of_classes(group),
            _ => 0,
        };
        Self { group, offset: sort_of_offset(offset) }
    }

    /// Whether the port has functions in this group.
    pub(super) const fn has_group(self) -> bool {
        self.group > 0
    }

    /// The place in the table of functions of the one that the service reaches, or [`NOTHING`]. That
    /// there always is one, the compiler is not told: it would cost two instructions.
    #[inline]
    pub(super) fn reached(self, service: Service) -> Option<usize> {
        let service = match service {
            Service::Read => 0_usize,
            Service::Write => 1,
            Service::ReadWrite => 2,
        };
        // No sort is beyond its table, so that one check is enough for all three.
        let of_group = self.group.wrapping_mul(const { OFFSETS.len().saturating_mul(3) });
        let place = of_group.wrapping_add(self.offset).wrapping_add(service);
        let reached = REACHED.as_flattened().as_flattened().get(place);
        reached.map(|reached| usize::from(*reached))
    }

    /// The function that is here, whatever it takes; none for content.
    pub(super) fn function(self) -> Option<Function> {
        let mut services = [Service::Read, Service::Write, Service::ReadWrite].into_iter();
        services.find_map(|service| {
            let function = Function::ALL.get(self.reached(service)?).copied();
            function.filter(|function| !function.spec().is_content())
        })
    }
}

#[inline]
fn group_of_com(group: IndexGroup) -> usize {
    let [channel, axis, objects_of_channel, objects_of_axis] = GROUPS_OF_COM;
    let [without, with] = match group.get() & !(LOGICAL | 0xFF) {
        0x02_0100 => channel,
        0x02_0200 => axis,
        0x03_0100 => objects_of_channel,
        0x03_0200 => objects_of_axis,
        _ => return 0,
    };
    usize::from(if has_instance(group) { with } else { without })
}

#[inline]
fn group_of_classes(group: IndexGroup) -> usize {
    let above = group.get().wrapping_sub(CLASSES);
    // The columns of a table: by index and logical, without an instance and with one.
    let column = ((above & !(LOGICAL | 0xFF)) >> 6) | ((above & LOGICAL) >> 19);
    let column = to_len(column).wrapping_add(has_instance(group).into());
    GROUPS_OF_CLASSES.as_flattened().get(column).map_or(0, |group| usize::from(*group))
}

#[inline]
fn has_instance(group: IndexGroup) -> bool {
    let [instance, ..] = group.get().to_le_bytes();
    instance > 0
}

#[inline]
fn sort_of_offset(offset: IndexOffset) -> usize {
    OFFSETS_OF_ELEMENTS.get(element(offset)).map_or(0, |[sort]| usize::from(*sort))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn functions(sorts: &Sorts, sort: usize) -> Functions {
        sorts.0[sort].unwrap()
    }

    /// The tables say what the rules say: of every group, and of every element of a channel and of
    /// some axes.
    #[test]
    #[cfg_attr(miri, ignore = "too many numbers for an interpreter")]
    fn tables_follow_the_rules() {
        for number in (0..=0xFF_FFFF).chain([0x0112_2301, 0x1012_2301, u32::MAX]) {
            let found = |port| {
                let place = Place::of(AmsPort(port), IndexGroup::new(number), IndexOffset::new(0));
                functions(&GROUPS, place.group)
            };
            let of_com = Functions::in_group(number, Functions::OF_COM);
            let of_others = Functions::in_group(number, Functions::OF_OTHERS);
            let wanted = [Functions::NONE, of_others, of_others, of_com, Functions::NONE];
            assert_eq!([550, 551, 552, 553, 554].map(found), wanted, "{number:#x}");
        }
        for axis in [0, 1, 2, 15, 16, 0x7FFF, 0xFFFF_u32] {
            for element in 0..=0xFFFF {
                let number = (axis << 16) | element;
                let found = sort_of_offset(IndexOffset::new(number));
                assert_eq!(functions(&OFFSETS, found / 3), Functions::at(number), "{number:#x}");
            }
        }
    }

    /// Made anew, the sorts are what the compiler has made.
    #[test]
    fn sorts_come_out_the_same() {
        let of_com = [0x02_0100, 0x02_0200, 0x03_0100, 0x03_0200].map(of_com);
        let of_decoder = of_class(0x02_2300);
        let groups = Sorts::EMPTY.with(&[[Functions::NONE]]).with(&of_com).with(&OF_CLASSES);
        assert_eq!((groups.len(), groups.numbers(&of_com, 1)), (GROUPS.len(), GROUPS_OF_COM));
        assert_eq!(groups.numbers(&[of_decoder], 1), [GROUPS_OF_CLASSES[0x23]]);
    }

    /// Where two sorts meet, each service reaches the first function that is there and takes it,
    /// but no content where a function is.
    #[test]
    fn services_reach_the_first_function() {
        for (group, of_group) in (0..).zip(GROUPS.0.iter().flatten()) {
            for (offset, at_offset) in (0..).zip(OFFSETS.0.iter().flatten()) {
                let here = Function::ALL
                    .iter()
                    .zip(0_u32..)
                    .filter(|(_, place)| (of_group.0 & at_offset.0) >> place & 1 == 1);
                let here: std::vec::Vec<_> = here.map(|(function, _)| *function).collect();
                let place = Place { group, offset: 3 * offset };
                let exclusive = here.iter().find(|it| !it.spec().is_content()).copied();
                assert_eq!(place.function(), exclusive);
                let read = of_group.and(*at_offset).reached(Functions::TAKING_READ);
                assert_eq!(place.reached(Service::Read), Some(read.into()));
                for service in [Service::Read, Service::Write, Service::ReadWrite] {
                    let takes = |it: &&Function| it.spec().service == service;
                    let wanted = match here.iter().find(|it| takes(it) || !it.spec().is_content()) {
                        Some(function) if takes(&function) => Some(*function),
                        _ => None,
                    };
                    let found = Function::ALL.get(place.reached(service).unwrap()).copied();
                    assert_eq!(found, wanted, "{service} at {place:?}");
                }
            }
        }
    }
}
