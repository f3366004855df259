//! Replies that depend on the configuration of a CNC: any valid reply is correct, if all replies to
//! the same request are equal.

use std::collections::BTreeMap;

use ads_cnc::address::{Addressing, ElementAddress, Group, IndexGroup, IndexOffset};
use ads_cnc::operation::{Call, Function, Request};
use ads_cnc::sda::{ElementLength, ElementText};
use ads_cnc::{Decode as _, ExtendedReply};

use crate::rules::element_type;
use crate::text::plural;

/// Which differences between the replies of two CNCs count.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(in crate::selftest::detection) enum Compare {
    /// All differences count.
    Bytes,
    /// Only differences that no configuration of the CNC explains. Configurable are names, types
    /// and units of elements, extended descriptions and, in a mode without writes, the write flags
    /// of elements and the contents of objects.
    Configured,
}

/// The numbers of the channels of the default model, by rank.
const NUMBERS: [u8; 3] = [1, 2, 6];

/// A request: function, index group with the number of the channel instead of its rank, index
/// offset, data.
type Key = (Function, IndexGroup, IndexOffset, Vec<u8>);

/// The first reply to each request for a configurable value, and the lengths of the elements.
#[derive(Default)]
pub(super) struct ConfigurableReplies {
    known: BTreeMap<Key, Vec<u8>>,
    lengths: BTreeMap<(IndexGroup, IndexOffset), u32>,
}

impl ConfigurableReplies {
    /// The text to compare instead of the data of a reply. `None` if the data itself must be
    /// compared: the value is not configurable, the data is invalid, or the data differs from the
    /// first reply to the same request.
    pub(super) fn marker(&mut self, call: &Call<'_>, data: &[u8], writes: bool) -> Option<String> {
        let request = call.dispatch().ok()?;
        let text = || Some(ElementText::decode(data).ok()?.text.text.to_string());
        let marker = match request {
            Request::ReadElementName(_) => format!("a name, empty: {}", text()?.is_empty()),
            Request::ReadElementUnit(_) => text().map(|_| "a unit".to_owned())?,
            Request::ReadElementType(op) => {
                let size = element_type(&text()?)?.size();
                let length = self.lengths.get(&element_key(op.element));
                let fits = length.zip(size).is_none_or(|(length, size)| *length == size);
                format!("a type, fits: {fits}")
            }
            Request::ReadElementLength(op) => {
                let length = ElementLength::decode(data).ok()?.get();
                self.lengths.insert(element_key(op.element), length);
                return None;
            }
            Request::DescribeExtended(_) => {
                ExtendedReply::decode(data).ok().map(|_| "an extended description".to_owned())?
            }
            Request::ReadElementWriteFlag(_) if !writes => {
                format!("a flag of {}", plural(data.len(), "byte"))
            }
            Request::ReadObject(_) if !writes => plural(data.len(), "byte"),
            _ => return None,
        };
        let group = by_number(call.index_group);
        let key = (request.function(), group, call.index_offset, call.data.to_vec());
        let known = self.known.entry(key).or_insert_with(|| data.to_vec());
        // The two replies are compared up to the length of the shorter one.
        let len = known.len().min(data.len());
        (known.get(..len) == data.get(..len)).then_some(marker)
    }
}

fn element_key(element: ElementAddress) -> (IndexGroup, IndexOffset) {
    (by_number(element.class_group().index_group()), element.index_offset())
}

/// The index group with the number of the channel instead of its rank.
pub(super) fn by_number(group: IndexGroup) -> IndexGroup {
    let number = |rank: u8| {
        let number = usize::from(rank).checked_sub(1).and_then(|rank| NUMBERS.get(rank));
        number.copied().unwrap_or(rank)
    };
    match group.parts() {
        Some(Group::Com(mut com)) if com.addressing == Addressing::Index => {
            (com.addressing, com.instance) = (Addressing::Logical, number(com.instance));
            com.index_group()
        }
        Some(Group::Class(mut class)) if class.addressing == Addressing::Index => {
            (class.addressing, class.instance) = (Addressing::Logical, number(class.instance));
            class.index_group()
        }
        _ => group,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simulator::Model;

    #[test]
    fn the_numbers_are_those_of_the_model() {
        assert!(Model::default_model().unwrap().channels().eq(NUMBERS));
    }
}
