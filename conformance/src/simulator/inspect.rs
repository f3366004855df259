//! Reads and changes the state of a CNC directly, without ADS.

use ads_cnc::address::Class;
use ads_cnc::dynamic::DynamicKind;
use ads_cnc::{CncString, VariablePath, VariableType};

use super::Cnc;
use super::content;
use super::model::{ContentSource, Model};
use super::owner::Owner;

/// The owner of the content of an object or element. Channels are identified by their logical
/// numbers; axes and places (axis indices of a channel) are counted from 1, spindles from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ContentOwner {
    /// The platform, as the owner of COM objects.
    Platform,
    /// A channel, as the owner of COM objects.
    Channel(u8),
    /// A platform axis, as the owner of COM objects.
    PlatformAxis(u8),
    /// The axis at a place of a channel, as the owner of COM objects.
    ChannelAxis { channel: u8, place: u8 },
    /// A channel, as the owner of the elements of a class.
    OfChannel { class: Class, channel: u8 },
    /// A platform axis, as the owner of the elements of a class.
    OfAxis { class: Class, axis: u8 },
    /// The axis at a place of a channel, as the owner of the elements of a class.
    OfPlace { class: Class, channel: u8, place: u8 },
    /// A spindle.
    Spindle(u8),
}

/// The content of an object or an element at the time of the call of [`Cnc::stored_contents`].
#[derive(Clone, Debug)]
pub struct StoredContent {
    pub holder: ContentOwner,
    /// The element number; for a COM object, its index offset without the axis.
    pub element: u32,
    pub name: CncString,
    pub type_name: &'static str,
    pub unit: CncString,
    pub writable: bool,
    pub value: Vec<u8>,
    owner: Owner,
    index: usize,
}

/// A variable of a channel, with its name on the channel interface and its value at the time of the
/// call of [`Cnc::current_variables`].
#[derive(Clone, Debug)]
pub struct CurrentVariable {
    pub channel: u8,
    pub name: CncString,
    pub var_type: VariableType,
    pub value: Vec<u8>,
}

/// A dynamic parameter that existed at the time of the call of [`Cnc::current_parameters`].
#[derive(Clone, Debug)]
pub struct CurrentParameter {
    pub channel: u8,
    pub kind: DynamicKind,
    pub name: CncString,
    pub value: f64,
}

impl Cnc {
    /// The contents of all objects and elements, except axis numbers, the element 0 of each
    /// instance, and the contents of places without an axis. A write to the program stream does not
    /// change its content here.
    pub fn stored_contents(&self) -> Vec<StoredContent> {
        let mut all = Vec::new();
        for (owner, holder) in self.owners() {
            let elements = elements(self.model(), owner);
            let state = self.state();
            let values = state.values(owner).into_iter().flatten();
            let items = content::items(self.model(), owner).iter().zip(elements).zip(values);
            for (index, ((item, element), value)) in items.enumerate() {
                if item.meaning == ContentSource::Value {
                    all.push(StoredContent {
                        holder,
                        element,
                        name: item.name.clone(),
                        type_name: item.type_name,
                        unit: item.unit.clone(),
                        writable: item.writable,
                        value: value.clone(),
                        owner,
                        index,
                    });
                }
            }
        }
        all
    }

    /// Sets the value of a content. If the value does not have the size of the previous value,
    /// nothing changes.
    pub fn set_content(&self, stored: &StoredContent, value: &[u8]) {
        self.state().change(stored.owner, stored.index, |content| {
            if content.len() == value.len() {
                content.copy_from_slice(value);
            }
        });
    }

    /// The V.E, V.G and V.A variables of all channels, except those of the Service Interface and
    /// those of places without an axis.
    pub fn current_variables(&self) -> Vec<CurrentVariable> {
        let (model, state) = (self.model(), self.state());
        let mut all = Vec::new();
        for (at, one) in model.channels.iter().enumerate() {
            let channel = one.number;
            let values = state.variables(at).into_iter().flatten();
            for (variable, value) in one.variables.list.iter().zip(values) {
                if variable.service.is_none() && variable.handle.is_some() {
                    all.push(CurrentVariable {
                        channel,
                        name: variable.name.clone(),
                        var_type: variable.var_type,
                        value: value.clone(),
                    });
                }
            }
            for place in 0..one.places.len() {
                let axis = state.axis_at(at, place).and_then(|axis| model.axes.get(axis));
                let values = state.axis_variables(at, place).into_iter().flatten();
                for (variable, value) in model.axis_variables.list.iter().zip(values) {
                    let path = VariablePath::from_text(variable.name.as_cnc_str()).ok();
                    let name = path
                        .zip(axis)
                        .and_then(|(path, axis)| path.with_axis(axis.name.as_cnc_str()).ok());
                    all.extend(name.map(|name| CurrentVariable {
                        channel,
                        name,
                        var_type: variable.var_type,
                        value: value.clone(),
                    }));
                }
            }
        }
        all
    }

    /// The names of the writable variables without a handle of the channel with this logical
    /// number.
    pub fn written_by_name_only(&self, number: u8) -> Vec<CncString> {
        let channels = self.model().channels.iter().filter(|channel| channel.number == number);
        let all = channels.flat_map(|channel| channel.variables.list.iter());
        let own = all.filter(|one| one.handle.is_none() && one.is_writable());
        own.map(|one| one.name.clone()).collect()
    }

    /// All dynamic parameters that currently exist.
    pub fn current_parameters(&self) -> Vec<CurrentParameter> {
        let (model, state) = (self.model(), self.state());
        let mut all = Vec::new();
        for (at, one) in model.channels.iter().enumerate() {
            for kind in DynamicKind::ALL {
                all.extend(state.parameters(at, kind).map(|parameter| CurrentParameter {
                    channel: one.number,
                    kind,
                    name: parameter.parameter.name.clone(),
                    value: parameter.value.get(),
                }));
            }
        }
        all
    }

    fn owners(&self) -> Vec<(Owner, ContentOwner)> {
        let model = self.model();
        let mut all = vec![(Owner::Platform, ContentOwner::Platform)];
        let axes = || (0_usize..).zip(1_u8..).take(model.axes.len());
        all.extend(axes().map(|(at, axis)| (Owner::Axis(at), ContentOwner::PlatformAxis(axis))));
        for class in [Class::PositionController, Class::Hld] {
            let of = axes().map(|(at, axis)| {
                (Owner::ClassAxis(class, at), ContentOwner::OfAxis { class, axis })
            });
            all.extend(of);
        }
        for (at, one) in model.channels.iter().enumerate() {
            let channel = one.number;
            all.push((Owner::Channel(at), ContentOwner::Channel(channel)));
            for class in [Class::Hld, Class::Interpolator, Class::Decoder, Class::PathPreparation] {
                all.push((
                    Owner::ClassChannel(class, at),
                    ContentOwner::OfChannel { class, channel },
                ));
            }
            for (index, place) in (0_usize..).zip(1_u8..).take(one.places.len()) {
                let owner = Owner::Place { channel: at, place: index };
                all.push((owner, ContentOwner::ChannelAxis { channel, place }));
                for class in [Class::Interpolator, Class::Decoder, Class::PathPreparation] {
                    let owner = Owner::ClassPlace { class, channel: at, place: index };
                    all.push((owner, ContentOwner::OfPlace { class, channel, place }));
                }
            }
        }
        let spindles = (0_usize..).zip(0_u8..).take(model.spindles);
        all.extend(spindles.map(|(at, index)| (Owner::Spindle(at), ContentOwner::Spindle(index))));
        all
    }
}

/// The element number of each item of an owner; for a COM object, its index offset without the
/// axis.
fn elements(model: &Model, owner: Owner) -> Vec<u32> {
    let objects = match owner {
        Owner::Platform => Some(&model.platform),
        Owner::Channel(channel) => model.channels.get(channel).map(|channel| &channel.objects),
        Owner::Axis(_) => Some(&model.platform_axis),
        Owner::Place { .. } => Some(&model.channel_axis),
        _ => None,
    };
    match objects {
        Some(objects) => objects.elements.clone(),
        // Element 0 contains the number of the other elements, so the items are numbered from 1.
        None => (1..).take(content::items(model, owner).len()).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn contents_store_set_values() {
        let cnc = Cnc::with_default_model().unwrap();
        let all = cnc.stored_contents();
        let of = |holder: ContentOwner, name: &str| {
            all.iter().find(|one| one.holder == holder && one.name.as_cnc_str() == name).unwrap()
        };
        let cycle = of(ContentOwner::Platform, "example_platform_cycle_time_r");
        assert_eq!((cycle.element, &cycle.value[..]), (0x251, &[0xE8, 3, 0, 0][..]));
        let second = of(ContentOwner::ChannelAxis { channel: 1, place: 2 }, "example_position_r");
        assert_eq!((second.element, &second.value[..]), (1, &(-200.5_f64).to_le_bytes()[..]));
        let speed = of(ContentOwner::Spindle(1), "example.speed");
        assert_eq!((speed.element, speed.writable), (1, true));
        // The value belongs to the axis, so a place without an axis has no value.
        assert!(!all.iter().any(|one| {
            matches!(one.holder, ContentOwner::ChannelAxis { channel: 2, place: 2.. })
        }));

        cnc.set_content(speed, &[7; 8]);
        cnc.set_content(cycle, &[1; 3]);
        let changed: Vec<(ContentOwner, Vec<u8>)> = cnc
            .stored_contents()
            .into_iter()
            .zip(&all)
            .filter(|(new, old)| new.value != old.value)
            .map(|(new, _)| (new.holder, new.value))
            .collect();
        assert_eq!(changed, [(ContentOwner::Spindle(1), vec![7; 8])]);
    }

    #[test]
    fn current_variables_and_parameters_are_listed() {
        let cnc = Cnc::with_default_model().unwrap();
        let variables = cnc.current_variables();
        let of = |channel: u8, name: &str| {
            let mut mine = variables.iter().filter(|one| one.channel == channel);
            mine.find(|one| one.name.as_cnc_str() == name).map(|one| one.value.clone())
        };
        assert_eq!(of(6, "V.E.channel"), Some(vec![6, 0, 0, 0]));
        assert_eq!(of(1, "V.A.WCS.Y"), Some(1234.2_f64.to_le_bytes().to_vec()));
        assert_eq!(of(1, "V.G.SERVICE.REQUEST"), None);
        assert_eq!(of(1, "V.CYC.count"), None);
        let parameters = cnc.current_parameters();
        let first = &parameters[0];
        assert_eq!((first.channel, first.kind, first.value), (1, DynamicKind::P, 4711.0));
    }
}
