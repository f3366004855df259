//! Lists variables by their descriptions, and dynamic parameters by their names.

use ads_cnc::address::Channel;
use ads_cnc::dynamic::{DynamicCount, DynamicKind, DynamicName};
use ads_cnc::operation::{CountDynamic, CountVariables, DescribeByIndex, DynamicNameByIndex};
use ads_cnc::{Description, VariableCount};

use super::super::{ListedValue, ValueList};
use super::{KINDS, OBJECTS_MAX, Walk, Walker as _};
use crate::number::to_usize;
use crate::session::ToolError;

impl Walk<'_> {
    pub(super) fn variables(&mut self, channels: &[Channel]) -> Result<(), ToolError> {
        for &channel in channels {
            let number = channel.number();
            for (name, kind) in KINDS {
                let list = ValueList::Variables { kind: name, channel: number, axis: None };
                if !self.enter(list) {
                    continue;
                }
                let count: Option<VariableCount> =
                    self.decoded(CountVariables::new(channel, kind))?;
                self.by_index(list, count.map(|count| count.0), 0, |walk, index| {
                    let variable: Option<Description> =
                        walk.decoded(DescribeByIndex::new(channel, index, kind))?;
                    Ok(variable
                        .map(|variable| ListedValue::of_description(list, channel, variable)))
                })?;
            }
            for kind in DynamicKind::ALL {
                let list = ValueList::Parameters { kind, channel: number };
                if !self.enter(list) {
                    continue;
                }
                let count: Option<DynamicCount> = self.decoded(CountDynamic::new(channel, kind))?;
                self.by_index(list, count.map(|count| count.0), 1, |walk, index| {
                    let request = DynamicNameByIndex::new(channel, kind, index);
                    let name: Option<DynamicName> =
                        walk.decoded(request.map_err(ToolError::Unsendable)?)?;
                    Ok(name.map(|name| ListedValue::of_parameter(channel, kind, name.name.text)))
                })?;
            }
        }
        Ok(())
    }

    /// Adds the entries of a list by index, starting at `first`.
    fn by_index(
        &mut self,
        list: ValueList,
        count: Option<u32>,
        first: u32,
        mut object: impl FnMut(&mut Self, u32) -> Result<Option<ListedValue>, ToolError>,
    ) -> Result<(), ToolError> {
        let Some(count) = count else {
            self.note(list, "the CNC rejects the request for their number");
            return Ok(());
        };
        let most = count.min(OBJECTS_MAX);
        let requested = self.each((first..).take(to_usize(most)), |walk, index| {
            let Some(object) = object(walk, index)? else { return Ok(false) };
            if walk.is_named(&object.name) {
                walk.add(object)?;
            }
            Ok(true)
        })?;
        self.note_missing(list, count, most, requested);
        Ok(())
    }
}
