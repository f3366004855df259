//! The requests that a walk sends, and the conditions at which its lists end.

use ads_cnc::address::{Channel, Class, ElementAddress};
use ads_cnc::operation::{
    CountElements, CountObjects, FindInstance, ObjectList, ReadDescriptors, Request,
};
use ads_cnc::sda::{ElementCount, ElementLength, ObjectAddress};
use ads_cnc::{Decode, Descriptors, Kind, ObjectCount};

use super::super::ListedValue;
use crate::number::to_u32;

/// A list ends after the requests for this many consecutive numbers are rejected.
pub const GAP: u32 = 8;

/// The last channel number, axis index and spindle index that are requested.
pub(super) const NUMBER_MAX: u32 = 255;

/// The kinds of variables that can be listed by index.
pub(crate) const KINDS: [(&str, Kind<'static>); 3] =
    [("V.G", Kind::V_G), ("V.E", Kind::V_E), ("V.A", Kind::V_A)];

/// The classes, in the order of a walk.
pub(crate) const CLASSES: [Class; 6] = [
    Class::PositionController,
    Class::Interpolator,
    Class::Decoder,
    Class::PathPreparation,
    Class::Hld,
    Class::Spindle,
];

/// Decodes a number of elements. No manual documents the size of this number, so data of 1 or 2
/// bytes is also decoded, like the length of an element.
pub(crate) fn decode_element_count(data: &[u8]) -> Option<u32> {
    let count = ElementCount::decode(data).map(|count| count.0);
    count.or_else(|_| ElementLength::decode(data).map(ElementLength::get)).ok()
}

/// The number of entries of a list that were requested, and that were rejected.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Requested {
    pub(super) sent: u32,
    pub(super) rejected: u32,
}

/// Sends the requests of a walk: a tool through its session, a case of the suite through its probe.
pub(crate) trait Walker: Sized {
    /// The reason why a walk ends early.
    type Error;

    /// Sends a request and returns the data of the reply; `None` if the target rejects the request.
    /// A tool also returns `None` if the task GEO sends no answer or an AMS error.
    fn request<'r>(
        &mut self,
        request: impl Into<Request<'r>>,
    ) -> Result<Option<Vec<u8>>, Self::Error>;

    /// Like [`request`](Self::request), but also returns `None` if the data does not decode as `T`.
    fn decoded<'r, T>(&mut self, request: impl Into<Request<'r>>) -> Result<Option<T>, Self::Error>
    where
        T: for<'b> Decode<'b>,
    {
        Ok(self.request(request)?.and_then(|data| T::decode(&data).ok()))
    }

    /// The number of objects of a list; `None` if the target does not have the list, or if the list
    /// is empty.
    fn count_objects(&mut self, list: impl Into<ObjectList>) -> Result<Option<u32>, Self::Error> {
        let count: Option<ObjectCount> = self.decoded(CountObjects::new(list))?;
        Ok(count.map(|count| count.0).filter(|&count| count > 0))
    }

    /// Whether the target has an instance.
    fn is_instance(&mut self, query: FindInstance) -> Result<bool, Self::Error> {
        let found: Option<ObjectAddress> = self.decoded(query)?;
        Ok(found.is_some_and(|found| matches!(found.first_element(), Ok(Some(_)))))
    }

    /// Calls `is_there` for each number, until [`GAP`] consecutive numbers are rejected.
    fn each(
        &mut self,
        numbers: impl IntoIterator<Item = u32>,
        mut is_there: impl FnMut(&mut Self, u32) -> Result<bool, Self::Error>,
    ) -> Result<Requested, Self::Error> {
        let (mut requested, mut gap) = (Requested::default(), 0_u32);
        for number in numbers {
            requested.sent = requested.sent.saturating_add(1);
            if is_there(self, number)? {
                gap = 0;
            } else {
                requested.rejected = requested.rejected.saturating_add(1);
                gap = gap.saturating_add(1);
            }
            if gap >= GAP {
                break;
            }
        }
        Ok(requested)
    }

    /// Reads the descriptors of a list with `count` objects: up to `range` descriptors per request.
    /// A request fails if it is rejected, or returns no valid or too many descriptors. After a
    /// failed request for several, reads one per request, and ends after [`GAP`] consecutive failed
    /// requests for one.
    fn objects_of(
        &mut self,
        list: ObjectList,
        count: u32,
        mut range: u32,
    ) -> Result<Vec<ListedValue>, Self::Error> {
        let (mut all, mut first, mut gap) = (Vec::new(), 1_u32, 0_u32);
        while first <= count && gap < GAP {
            let most = range.min(count.saturating_sub(first).saturating_add(1));
            let given: Option<Descriptors> = match ReadDescriptors::new(list, first, most) {
                Ok(read) => self.decoded(read)?,
                Err(_) => None,
            };
            let given = given.unwrap_or_default();
            match to_u32(given.len()) {
                len if (1..=most).contains(&len) => {
                    let objects =
                        given.iter().map(|one| ListedValue::of_descriptor(list.into(), one));
                    all.extend(objects);
                    (first, gap) = (first.saturating_add(len), 0);
                }
                _ if range > 1 => range = 1,
                _ => (first, gap) = (first.saturating_add(1), gap.saturating_add(1)),
            }
        }
        Ok(all)
    }

    /// Visits the instances of a class by channel and axis: `is_there` checks whether the target
    /// has an instance, and the first missing axis or spindle ends a list. With `aliases`, the axes
    /// of the platform are also visited in the HLD of every channel. Otherwise, they are visited in
    /// the HLD of the first channel if the HLD of the platform has no axes (E-30).
    fn instances_of(
        &mut self,
        class: Class,
        channels: &[Channel],
        aliases: bool,
        is_there: &mut impl FnMut(&mut Self, u32, u32) -> Result<bool, Self::Error>,
    ) -> Result<(), Self::Error> {
        let mut numbers = channels.iter().map(|channel| u32::from(channel.number()));
        match class {
            Class::PositionController => self.axes_of(0, 1, is_there).map(drop),
            Class::Interpolator | Class::Decoder | Class::PathPreparation => {
                numbers.try_for_each(|channel| self.axes_of(channel, 0, is_there).map(drop))
            }
            Class::Hld => {
                let first = numbers.clone().next();
                for channel in numbers {
                    if aliases {
                        self.axes_of(channel, 0, is_there)?;
                    } else {
                        is_there(self, channel, 0)?;
                    }
                }
                match (self.axes_of(0, 1, is_there)?, first) {
                    (0, Some(first)) if !aliases => self.axes_of(first, 1, is_there).map(drop),
                    _ => Ok(()),
                }
            }
            Class::Spindle => {
                for index in 0..=NUMBER_MAX {
                    if !is_there(self, index, 0)? {
                        break;
                    }
                }
                Ok(())
            }
        }
    }

    /// Visits the axes of a channel from the index `first` on, until one is missing; index 0 is the
    /// channel itself. Returns the number of indices that are not missing.
    fn axes_of(
        &mut self,
        channel: u32,
        first: u32,
        is_there: &mut impl FnMut(&mut Self, u32, u32) -> Result<bool, Self::Error>,
    ) -> Result<u32, Self::Error> {
        let mut count = 0_u32;
        for axis in first..=NUMBER_MAX {
            if !is_there(self, channel, axis)? {
                break;
            }
            count = count.saturating_add(1);
        }
        Ok(count)
    }

    /// The number of elements that the target reports for an instance; `None` if it reports none
    /// that can be decoded.
    fn count_elements(&mut self, first: ElementAddress) -> Result<Option<u32>, Self::Error> {
        // The address that the target returned may be that of a function, which has no elements.
        let data = match CountElements::new(first) {
            Ok(count) => self.request(count)?,
            Err(_) => None,
        };
        Ok(data.and_then(|data| decode_element_count(&data)))
    }
}
