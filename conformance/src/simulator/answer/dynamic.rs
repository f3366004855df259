//! Answers requests for dynamic parameters (DYN).

use ads_cnc::TextRef;
use ads_cnc::ads::AdsError;
use ads_cnc::dynamic::{DynamicCount, DynamicKind, DynamicNameRef};
use ads_cnc::operation::{
    CountDynamic, DynamicNameByIndex, DynamicValueByIndex, DynamicValueByName,
};

use super::{AnsweringCnc, ReplyData, encode};
use crate::number::{to_u32, to_usize};
use crate::simulator::parameters::ParameterState;

impl AnsweringCnc<'_> {
    pub(super) fn count_dynamic(&self, op: &CountDynamic) -> ReplyData {
        let channel = self.channel(op.channel)?;
        encode(DynamicCount(to_u32(self.state.parameters(channel, op.kind).count())))
    }

    pub(super) fn dynamic_name(&self, op: &DynamicNameByIndex) -> ReplyData {
        let channel = self.channel(op.channel)?;
        let parameter = self.parameter(channel, op.kind, op.index)?;
        encode(DynamicNameRef { name: TextRef::from(parameter.name()) })
    }

    pub(super) fn dynamic_by_index(&self, op: &DynamicValueByIndex) -> ReplyData {
        let channel = self.channel(op.channel)?;
        encode(self.parameter(channel, op.kind, op.index)?.value)
    }

    pub(super) fn dynamic_by_name(&self, op: &DynamicValueByName<'_>) -> ReplyData {
        let channel = self.channel(op.channel)?;
        let mut parameters = self.state.parameters(channel, op.kind);
        let found = parameters.find(|one| one.name() == op.name.text());
        encode(found.ok_or(AdsError::SYMBOL_NOT_FOUND)?.value)
    }

    fn parameter(
        &self,
        channel: usize,
        kind: DynamicKind,
        index: u32,
    ) -> Result<&ParameterState, AdsError> {
        let before = to_usize(index).checked_sub(1).ok_or(AdsError::INVALID_DATA)?;
        self.state.parameters(channel, kind).nth(before).ok_or(AdsError::INVALID_DATA)
    }
}
