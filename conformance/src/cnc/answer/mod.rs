//! From an ADS request to data or an error number.

use ads_cnc::Encode;
use ads_cnc::ads::AdsError;
use ads_cnc::layout::Stream;
use ads_cnc::operation::{Call, Reply, Request};
use ads_cnc::{
    ExtendedDescription, ExtendedReply, Kind, ObjectCount, Synchronisation, Validity, ValueRef,
    VariableCount,
};

use super::default::default_model;
use super::{ChannelModel, Model, ModelError, Variable, to_len, to_u32};
use crate::defect::Defect;

/// The simulated CNC.
#[derive(Clone, Debug)]
pub struct Cnc {
    model: Model,
    defect: Option<Defect>,
}

impl Cnc {
    /// A CNC with this data model.
    pub const fn new(model: Model) -> Self {
        Self { model, defect: None }
    }

    /// The CNC that answers what the manuals print: see [`default_model`].
    ///
    /// # Errors
    /// None: a test builds it.
    pub fn with_default_model() -> Result<Self, ModelError> {
        default_model().map(Self::new)
    }

    /// With a seeded defect: streams of the requests are changed before they are read, streams
    /// of the replies after they are encoded.
    #[must_use]
    pub fn with_defect(mut self, defect: Option<Defect>) -> Self {
        self.defect = defect;
        self
    }

    /// Its data model.
    pub const fn model(&self) -> &Model {
        &self.model
    }

    /// The data to answer with.
    ///
    /// Which error number a CNC gives is not documented (ADS-7), so these are assumed:
    ///
    /// | number | for |
    /// |---|---|
    /// | 0x6 | a port that no task has |
    /// | 0x701 | a service that the function does not take |
    /// | 0x702 | an index group without functions, a channel or axis that is not there |
    /// | 0x703 | an index offset without function, an object beyond the list |
    /// | 0x705 | a request or a read length of the wrong size |
    /// | 0x706 | an index out of bounds or too many, a handle of no variable |
    /// | 0x710 | a name or kind that is not there |
    ///
    /// # Errors
    /// One of these numbers.
    pub fn answer(&self, call: &Call<'_>) -> Result<Vec<u8>, AdsError> {
        let request = dispatch(call)?;
        let spec = request.function().spec();
        let misread = spec.request.and_then(|stream| self.change(stream, call.data));
        let reply = match misread {
            None => self.reply(&request)?,
            Some(data) => self.reply(&dispatch(&Call { data: &data, ..*call })?)?,
        };
        if to_u32(reply.len()) > call.read_length {
            return Err(AdsError::INVALID_SIZE);
        }
        Ok(spec.reply.and_then(|stream| self.change(stream, &reply)).unwrap_or(reply))
    }

    /// The bytes of a stream with the defect, if it is about that stream.
    pub(super) fn change(&self, stream: Stream, bytes: &[u8]) -> Option<Vec<u8>> {
        let defect = self.defect.as_ref().filter(|defect| defect.touches(stream))?;
        Some(defect.apply(bytes))
    }

    fn reply(&self, request: &Request<'_>) -> Result<Vec<u8>, AdsError> {
        match request {
            Request::CountObjects(op) => {
                let list = self.model.objects(op.list).ok_or(AdsError::INVALID_GROUP)?;
                encode(ObjectCount(to_u32(list.len())))
            }
            Request::ReadDescriptors(op) => {
                let list = self.model.objects(op.list()).ok_or(AdsError::INVALID_GROUP)?;
                let first = to_len(op.first()).checked_sub(1).ok_or(AdsError::INVALID_OFFSET)?;
                let asked = list.slice(first, to_len(op.count()));
                if asked.is_empty() { Err(AdsError::INVALID_OFFSET) } else { encode(asked) }
            }
            Request::CountVariables(op) => {
                let channel = self.channel(op.channel)?;
                let kind = op.kind.text();
                let count = match channel.of_kind(kind) {
                    Some(variables) => variables.count(),
                    None if kind.is_empty() => channel.variables.len(),
                    None => return Err(AdsError::SYMBOL_NOT_FOUND),
                };
                encode(VariableCount(to_u32(count)))
            }
            Request::DescribeByIndex(op) => {
                let channel = self.channel(op.channel)?;
                let variables = channel.of_kind(op.kind.text());
                let mut variables = variables.ok_or(AdsError::SYMBOL_NOT_FOUND)?;
                let variable = variables.nth(to_len(op.index)).ok_or(AdsError::INVALID_DATA)?;
                encode(variable.description())
            }
            Request::HandleByName(op) => {
                let channel = self.channel(op.channel)?;
                let variable = channel.by_name(op.name.text());
                encode(variable.ok_or(AdsError::SYMBOL_NOT_FOUND)?.handle)
            }
            Request::ReadByHandle(op) => {
                let channel = self.channel(op.channel)?;
                let variable = channel.by_handle(op.handle).ok_or(AdsError::INVALID_DATA)?;
                let indices: Vec<u32> = op.indices.iter().collect();
                value(variable, &indices)
            }
            Request::ReadByName(op) => {
                let channel = self.channel(op.channel)?;
                let named = channel.by_element_name(op.name.text());
                let (variable, indices) = named.ok_or(AdsError::SYMBOL_NOT_FOUND)?;
                value(variable, &indices)
            }
            Request::DescribeExtended(op) => {
                let channel = self.channel(op.channel)?;
                let kind = op.kind.text();
                let mut variables = channel.of_kind(kind).ok_or(AdsError::SYMBOL_NOT_FOUND)?;
                variables.nth(to_len(op.index)).ok_or(AdsError::INVALID_DATA)?;
                // As printed; V.G and V.A have none (VAR-16).
                encode(ExtendedReply((op.kind == Kind::V_E).then_some(ExtendedDescription {
                    synchronisation: Synchronisation::SYNCHRONIZED,
                    validity: Validity::GLOBAL,
                })))
            }
            Request::AxisHandleByName(op) => {
                let channel = self.channel(op.channel)?;
                let name = channel.axis_name(op.axis, op.name.text());
                let variable = name.and_then(|name| channel.by_name(name.as_cnc_str()));
                encode(variable.ok_or(AdsError::SYMBOL_NOT_FOUND)?.handle)
            }
            Request::AxisReadByName(op) => {
                let channel = self.channel(op.channel)?;
                let name = channel.axis_name(op.axis, op.name.text());
                let named = name.and_then(|name| channel.by_element_name(name.as_cnc_str()));
                let (variable, indices) = named.ok_or(AdsError::SYMBOL_NOT_FOUND)?;
                value(variable, &indices)
            }
            // A function of the table that this CNC does not serve is at no offset of it.
            _ => Err(AdsError::INVALID_OFFSET),
        }
    }

    fn channel(&self, at: ads_cnc::address::Channel) -> Result<&ChannelModel, AdsError> {
        self.model.channel(at).ok_or(AdsError::INVALID_GROUP)
    }
}

fn dispatch<'a>(call: &Call<'a>) -> Result<Request<'a>, AdsError> {
    call.dispatch().map_err(|refusal| {
        tracing::debug!(group = %call.index_group, offset = %call.index_offset, "refused: {refusal}");
        refusal.ads_error()
    })
}

fn value(variable: &Variable, indices: &[u32]) -> Result<Vec<u8>, AdsError> {
    let bytes = variable.element(indices).ok_or(AdsError::INVALID_DATA)?;
    encode(ValueRef { bytes })
}

fn encode<'a>(reply: impl Into<Reply<'a>>) -> Result<Vec<u8>, AdsError> {
    // The model was checked to fit: this does not fail.
    reply.into().to_vec().map_err(|_| AdsError::INVALID_DATA)
}

#[cfg(test)]
mod tests;
