//! Variables by their descriptions, and dynamic parameters.

use ads_cnc::address::Channel;
use ads_cnc::dynamic::DynamicKind;
use ads_cnc::operation::{CountDynamic, CountVariables, DescribeByIndex, DynamicNameByIndex};
use ads_cnc::value::DataType;
use ads_cnc::{CncString, DescriptionRef, Kind};

use super::super::{Access, List, Object, Place};
use super::{OBJECTS_MAX, Unanswered, Walk};
use crate::session::Trouble;
use crate::values::Type;

/// Kinds whose variables are described by index.
const KINDS: [(&str, Kind<'static>); 3] =
    [("V.E", Kind::V_E), ("V.G", Kind::V_G), ("V.A", Kind::V_A)];

impl Walk<'_> {
    pub(super) fn variables(&mut self, channels: &[Channel]) -> Result<(), Trouble> {
        for &channel in channels {
            for (name, kind) in KINDS {
                let channel_number = channel.number();
                let list = List::Variables { kind: name, channel: channel_number, axis: None };
                self.of_kind(list, channel, kind)?;
            }
            for kind in DynamicKind::ALL {
                let list = List::Parameters { kind, channel: channel.number() };
                self.parameters(list, channel, kind)?;
            }
        }
        Ok(())
    }

    fn of_kind(
        &mut self,
        list: List,
        channel: Channel,
        kind: Kind<'static>,
    ) -> Result<(), Trouble> {
        if !self.enter(list) {
            return Ok(());
        }
        let Some(count) = self.ask(&CountVariables::new(channel, kind))?.map(|count| count.0)
        else {
            self.note(list, "their number was refused");
            return Ok(());
        };
        let mut tally = Unanswered::new(count);
        for index in 0..count.min(OBJECTS_MAX) {
            let variable = self.ask(&DescribeByIndex::new(channel, index, kind))?;
            let Some(object) = variable.map(|variable| row(list, channel, &variable)) else {
                if tally.refused(index) {
                    break;
                }
                continue;
            };
            tally.answered();
            if self.is_named(&object.name) {
                self.found(object)?;
            }
        }
        tally.note(list, self);
        self.note_rest(list, count);
        Ok(())
    }

    fn parameters(
        &mut self,
        list: List,
        channel: Channel,
        kind: DynamicKind,
    ) -> Result<(), Trouble> {
        if !self.enter(list) {
            return Ok(());
        }
        let Some(count) = self.ask(&CountDynamic::new(channel, kind))?.map(|count| count.0) else {
            self.note(list, "their number was refused");
            return Ok(());
        };
        let mut tally = Unanswered::new(count);
        for index in 1..=count.min(OBJECTS_MAX) {
            let op = DynamicNameByIndex::new(channel, kind, index).map_err(Trouble::Unsendable)?;
            let name = self.ask(&op)?.map(|reply| CncString::from(reply.name.text()));
            let Some(name) = name else {
                if tally.refused(index.saturating_sub(1)) {
                    break;
                }
                continue;
            };
            tally.answered();
            if self.is_named(&name) {
                self.found(parameter(channel, kind, name))?;
            }
        }
        tally.note(list, self);
        self.note_rest(list, count);
        Ok(())
    }
}

fn row(list: List, channel: Channel, variable: &DescriptionRef<'_>) -> Object {
    let name = CncString::from(variable.name.text());
    Object {
        list,
        place: Place::Variable { channel, axis: None, name: name.clone() },
        name,
        ty: Type::of_variable(variable.var_type, variable.dimensions, variable.size),
        unit: None,
        access: Access::of_variable(variable.access),
        handle: Some(variable.handle),
    }
}

/// A dynamic parameter: one number. No function of its own writes it; V.L, V.P and V.S some CNCs
/// have among the variables too (VAR-18).
pub(crate) fn parameter(channel: Channel, kind: DynamicKind, name: CncString) -> Object {
    Object {
        list: List::Parameters { kind, channel: channel.number() },
        place: Place::Parameter { channel, kind, name: name.clone() },
        name,
        ty: Type::known(DataType::Real64, Vec::new()),
        unit: None,
        access: if kind == DynamicKind::P { Access::Read } else { Access::Unknown },
        handle: None,
    }
}
