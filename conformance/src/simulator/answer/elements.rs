//! Answers requests for elements of the classes of SDA and GEO (SDA).

use ads_cnc::address::{
    Addressing, Attribute, AxisStride, Class, ClassGroup, ElementAddress, IndexOffset,
};
use ads_cnc::ads::AdsError;
use ads_cnc::operation::{FindInstance, WriteElement};
use ads_cnc::sda::{ElementCount, ElementLength, ElementTextRef, ElementWriteFlag, ObjectAddress};
use ads_cnc::{CncStr, ContentRef, TextRef};

use super::{AnsweringCnc, ReplyData, encode};
use crate::number::{to_u32, to_usize};
use crate::simulator::content;
use crate::simulator::model::Item;
use crate::simulator::owner::Owner;

/// The type, length and unit of the first element of an instance, which is element 0: the number of
/// the other elements.
const COUNT_TYPE: &str = "UNS32";
const COUNT_LENGTH: u32 = 4;
const COUNT_UNIT: &str = "-";

impl AnsweringCnc<'_> {
    /// The address of an instance; (0, 0) if the instance does not exist (SDA-2).
    pub(super) fn find_instance(&self, op: &FindInstance) -> ReplyData {
        let found = self.instance(op.class_group(), op.query().channel, op.query().axis);
        encode(found.map_or(ObjectAddress::NONE, ObjectAddress::from))
    }

    fn instance(&self, group: ClassGroup, channel: u32, axis: u32) -> Option<ElementAddress> {
        let instance = u8::try_from(channel).ok()?;
        let stride = stride(group.class, instance);
        let offset = IndexOffset::for_axis(stride, axis, 0).ok()?;
        let group = ClassGroup { attribute: Attribute::Content, instance, ..group };
        let address = ElementAddress::new(group, offset);
        self.locate(address).is_ok().then_some(address)
    }

    /// The content of an element; for the first element, the number of the other elements.
    pub(super) fn read_element(&self, address: ElementAddress) -> ReplyData {
        match self.locate(address)? {
            (owner, None) => encode(ElementCount(to_u32(content::items(self.model, owner).len()))),
            (owner, Some(index)) => {
                let bytes = content::read(self.model, &self.state, owner, index)?;
                encode(ContentRef { bytes: &bytes })
            }
        }
    }

    pub(super) fn write_element(&mut self, op: &WriteElement<'_>) -> ReplyData {
        let (owner, index) = self.locate(op.element())?;
        let index = index.ok_or(AdsError::INVALID_ACCESS)?;
        content::write(self.model, &mut self.state, owner, index, op.content().bytes)?;
        Ok(Vec::new())
    }

    /// The name of an element; for the first element, the name of the instance.
    pub(super) fn element_name(&self, address: ElementAddress) -> ReplyData {
        match self.element(address)? {
            (_, Some(item)) => encode_text(item.name.as_cnc_str()),
            (owner, None) => text(&self.instance_name(owner)),
        }
    }

    pub(super) fn element_type(&self, address: ElementAddress) -> ReplyData {
        text(self.element(address)?.1.map_or(COUNT_TYPE, |item| item.type_name))
    }

    pub(super) fn element_length(&self, address: ElementAddress) -> ReplyData {
        let item = self.element(address)?.1;
        encode(ElementLength::new(item.map_or(COUNT_LENGTH, |item| to_u32(item.initial.size))))
    }

    pub(super) fn element_unit(&self, address: ElementAddress) -> ReplyData {
        match self.element(address)?.1 {
            Some(item) => encode_text(item.unit.as_cnc_str()),
            None => text(COUNT_UNIT),
        }
    }

    pub(super) fn element_write_flag(&self, address: ElementAddress) -> ReplyData {
        let writable = self.element(address)?.1.is_some_and(|item| item.writable);
        let flag = if writable { ElementWriteFlag::WRITABLE } else { ElementWriteFlag::READ_ONLY };
        encode(flag)
    }

    /// Owner and element at an address; the element is `None` for the first element of an instance.
    fn element(&self, address: ElementAddress) -> Result<(Owner, Option<&Item>), AdsError> {
        let (owner, index) = self.locate(address)?;
        let item = index.map(|index| content::items(self.model, owner).get(index));
        Ok((owner, item.map(|item| item.ok_or(AdsError::INVALID_OFFSET)).transpose()?))
    }

    /// Owner and index of the element at an address; the index is `None` for the first element of
    /// an instance.
    ///
    /// The instances of a class are those of SDA-5. It is assumed that the position controller
    /// itself has no elements, and that every HLD contains the platform axes (E-30).
    fn locate(&self, address: ElementAddress) -> Result<(Owner, Option<usize>), AdsError> {
        let ClassGroup { addressing, class, instance, .. } = address.class_group();
        let split = address.index_offset().axis_and_element(stride(class, instance));
        let (axis, element) = split.map_err(|_| AdsError::INVALID_OFFSET)?;
        let at = to_usize(axis).checked_sub(1);
        let platform = |owner: fn(Class, usize) -> Owner| match at {
            Some(axis) if axis < self.model.axes.len() => Ok(owner(class, axis)),
            _ => Err(AdsError::INVALID_OFFSET),
        };
        let owner = match (class, instance) {
            (Class::Spindle, index) => match at {
                None if usize::from(index) < self.model.spindles => Owner::Spindle(index.into()),
                None => return Err(AdsError::INVALID_GROUP),
                Some(_) => return Err(AdsError::INVALID_OFFSET),
            },
            (Class::PositionController | Class::Hld, 0) => platform(Owner::ClassAxis)?,
            (Class::PositionController, _) => return Err(AdsError::INVALID_GROUP),
            (class, number) => self.of_channel(addressing, class, number, at)?,
        };
        let count = content::items(self.model, owner).len();
        match to_usize(element).checked_sub(1) {
            Some(index) if index >= count => Err(AdsError::INVALID_OFFSET),
            index => Ok((owner, index)),
        }
    }

    fn of_channel(
        &self,
        addressing: Addressing,
        class: Class,
        number: u8,
        axis: Option<usize>,
    ) -> Result<Owner, AdsError> {
        let channel = self.state.channel(self.model, addressing, number)?;
        let places = self.model.channels.get(channel).map_or(0, |channel| channel.places.len());
        match (axis, class) {
            (None, _) => Ok(Owner::ClassChannel(class, channel)),
            (Some(axis), Class::Hld) if axis < self.model.axes.len() => {
                Ok(Owner::ClassAxis(class, axis))
            }
            (Some(place), Class::Interpolator | Class::Decoder | Class::PathPreparation)
                if place < places =>
            {
                Ok(Owner::ClassPlace { class, channel, place })
            }
            _ => Err(AdsError::INVALID_OFFSET),
        }
    }

    fn instance_name(&self, owner: Owner) -> String {
        let class = |class: Class| self.model.class(class);
        let name = match owner {
            Owner::ClassChannel(of, channel) => {
                let number = self.model.channels.get(channel).map_or(0, |channel| channel.number);
                class(of).map(|class| class.channel.name(number))
            }
            Owner::ClassAxis(of, at) | Owner::ClassPlace { class: of, place: at, .. } => {
                class(of).map(|class| class.axis.name(at.saturating_add(1)))
            }
            Owner::Spindle(index) => class(Class::Spindle).map(|class| class.channel.name(index)),
            _ => None,
        };
        name.unwrap_or_default()
    }
}

/// The printed stride: 0x1000 for the platform axes of the HLD, otherwise 0x10000 (ADR-7, E-01).
const fn stride(class: Class, instance: u8) -> AxisStride {
    match (class, instance) {
        (Class::Hld, 0) => AxisStride::X1000,
        _ => AxisStride::X10000,
    }
}

fn text(text: &str) -> ReplyData {
    // This does not fail: the text is a constant, or the name of an instance, which was checked to
    // be CP1252 when the model was built.
    encode_text(CncStr::new(text).map_err(|_| AdsError::INVALID_DATA)?)
}

fn encode_text(text: CncStr<'_>) -> ReplyData {
    encode(ElementTextRef { text: TextRef::from(text) })
}
