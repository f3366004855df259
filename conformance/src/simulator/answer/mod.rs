//! Answers an ADS request with data or an error number.

mod dynamic;
mod elements;
mod objects;
mod variables;

use std::sync::{Mutex, MutexGuard};
use std::time::Duration;

use ads_cnc::address::Channel;
use ads_cnc::ads::{AdsError, AmsNetId, FrameRef};
use ads_cnc::operation::{Call, Function, Reply, Request, WriteProgramStream};
use ads_cnc::{Encode, NoData};

use super::clock::Clock;
use super::frames::Frames;
use super::program::Policy;
use super::respond::respond;
use super::state::CncState;
use super::{Model, ModelError, ReplyData, Responder, program};
use crate::mutex::lock;
use crate::number::to_u32;

/// The simulated CNC: a model, and its state under one lock.
#[derive(Debug)]
pub struct Cnc {
    model: Model,
    state: Mutex<CncState>,
    clock: Clock,
    policy: Policy,
}

impl Cnc {
    /// Creates a CNC with this data model, in its initial state.
    pub fn new(model: Model) -> Self {
        let policy = Policy::DEFAULT;
        let state = Mutex::new(CncState::new(&model, policy));
        Self { model, state, clock: Clock::running(), policy }
    }

    /// Replaces the data model, and resets the state and the policy; the clock continues.
    pub(crate) fn with_model(self, model: Model) -> Self {
        Self { clock: self.clock, ..Self::new(model) }
    }

    /// Replaces the policy of the NC programs and resets the state.
    pub(crate) fn with_policy(mut self, policy: Policy) -> Self {
        self.state = Mutex::new(CncState::new(&self.model, policy));
        Self { policy, ..self }
    }

    /// Creates the CNC of the manuals' examples, see [`DEFAULT_MODEL`](super::DEFAULT_MODEL).
    ///
    /// # Errors
    /// No error occurs: a test builds the default model.
    pub fn with_default_model() -> Result<Self, ModelError> {
        Model::default_model().map(Self::new)
    }

    /// Stops the clock at 0. From then on, only [`pass`](Self::pass) advances the clock, so that
    /// the caller controls the time.
    ///
    /// ```
    /// use std::time::Duration;
    ///
    /// use ads_cnc::address::{IndexGroup, IndexOffset};
    /// use ads_cnc::ads::AmsPort;
    /// use ads_cnc::operation::{AdsService, Call};
    /// use ads_cnc_conformance::simulator::{Cnc, Model};
    ///
    /// let model = r#"
    /// [[channel]]
    /// number = 1
    /// parameters = [{ name = "V.L.feed", comes = "2s", goes = "5s" }]
    /// "#;
    /// let cnc = Cnc::new(Model::from_toml(model, "an example")?).with_stopped_clock();
    /// let count = Call {
    ///     port: AmsPort::SDA,
    ///     service: AdsService::Read,
    ///     index_group: IndexGroup::new(0x12_2301),
    ///     index_offset: IndexOffset::new(0x03),
    ///     read_length: 4,
    ///     data: &[],
    /// };
    /// assert_eq!(cnc.answer(&count), Ok(vec![0; 4]));
    /// cnc.pass(Duration::from_secs(2));
    /// assert_eq!(cnc.answer(&count), Ok(vec![1, 0, 0, 0]));
    /// # Ok::<(), ads_cnc_conformance::simulator::ModelError>(())
    /// ```
    #[must_use]
    pub fn with_stopped_clock(mut self) -> Self {
        self.clock = Clock::stopped();
        self
    }

    /// Advances the clock by `time`. At the next access to the CNC, parameters are created and
    /// deleted, and programs continue up to the new time.
    pub fn pass(&self, time: Duration) {
        self.clock.pass(time);
    }

    pub const fn model(&self) -> &Model {
        &self.model
    }

    /// The state, advanced to the current time.
    pub(super) fn state(&self) -> MutexGuard<'_, CncState> {
        self.answering().state
    }

    /// Locks the state, and advances it to the current time.
    fn answering(&self) -> AnsweringCnc<'_> {
        let mut state = lock(&self.state);
        let now = self.now();
        state.advance(now);
        AnsweringCnc { model: &self.model, state, now }
    }

    /// The time of the clock.
    pub(super) fn now(&self) -> Duration {
        self.clock.now()
    }

    /// Answers a request; returns the data of the reply.
    ///
    /// # Errors
    /// The error numbers of a CNC are not documented (ADS-7), so these are assumed:
    ///
    /// | number | reason |
    /// |---|---|
    /// | 0x6 | no task has this port |
    /// | 0x701 | the function has another service |
    /// | 0x702 | index group without functions; no such channel, spindle or other instance, or no such axis in the index group |
    /// | 0x703 | index offset without a function; no such object or element, or no such axis in the index offset; 0x4C on a CNC that is too old |
    /// | 0x704 | write to a read-only value |
    /// | 0x705 | malformed data of a request; wrong size of a value; read length that is too small |
    /// | 0x706 | index out of bounds, or wrong number of indices; a handle that no variable of the channel has; a request for the handle of a variable that is accessible by name only; write to a place without an axis, except of an axis number; impossible axis exchange; NC text that does not fit into the buffer now |
    /// | 0x710 | no such name or kind; no such axis on the axis interface |
    pub fn answer(&self, call: &Call<'_>) -> Result<Vec<u8>, AdsError> {
        self.answering().answer(call)
    }

    /// Appends the frame of the reply; see [`Responder::respond`].
    pub fn respond(&self, net_id: AmsNetId, frame: &FrameRef<'_>, answers: &mut Vec<u8>) {
        Responder::respond(self, net_id, frame, answers);
    }

    /// The policy of the NC programs.
    pub(super) const fn policy(&self) -> Policy {
        self.policy
    }
}

impl AnsweringCnc<'_> {
    fn answer(&mut self, call: &Call<'_>) -> ReplyData {
        let request = dispatch(call)?;
        let reply = self.reply(&request)?;
        if to_u32(reply.len()) > call.read_length {
            return Err(AdsError::INVALID_SIZE);
        }
        Ok(reply)
    }

    fn reply(&mut self, request: &Request<'_>) -> ReplyData {
        match request {
            Request::CountObjects(op) => self.count_objects(op),
            Request::ReadDescriptors(op) => self.descriptors(op),
            Request::ReadObject(op) => self.read_object(op),
            Request::WriteObject(op) => self.write_object(op),
            Request::FindInstance(op) => self.find_instance(op),
            Request::CountElements(op) => self.read_element(op.element()),
            Request::ReadElement(op) => self.read_element(op.element()),
            Request::WriteElement(op) => self.write_element(op),
            Request::ReadElementName(op) => self.element_name(op.element),
            Request::ReadElementType(op) => self.element_type(op.element),
            Request::ReadElementLength(op) => self.element_length(op.element),
            Request::ReadElementUnit(op) => self.element_unit(op.element),
            Request::ReadElementWriteFlag(op) => self.element_write_flag(op.element),
            Request::CountVariables(op) => self.count_variables(op),
            Request::DescribeByIndex(op) => self.describe_by_index(op),
            Request::DescribeExtended(op) => self.describe_extended(op),
            Request::DescribeByName(op) => self.describe_by_name(op),
            Request::HandleByName(op) => self.handle_by_name(op),
            Request::ReadByHandle(op) => self.read_by_handle(op),
            Request::ReadByName(op) => self.read_by_name(op),
            Request::WriteByHandle(op) => self.write_by_handle(op),
            Request::WriteByName(op) => self.write_by_name(op),
            Request::AxisHandleByName(op) => self.axis_handle_by_name(op),
            Request::AxisReadByName(op) => self.axis_read_by_name(op),
            Request::AxisWriteByName(op) => self.axis_write_by_name(op),
            Request::CountDynamic(op) => self.count_dynamic(op),
            Request::DynamicNameByIndex(op) => self.dynamic_name(op),
            Request::DynamicValueByName(op) => self.dynamic_by_name(op),
            Request::DynamicValueByIndex(op) => self.dynamic_by_index(op),
            Request::WriteProgramStream(op) => self.write_program_stream(op),
            // `Request` is non-exhaustive, so this arm is required; the assertion below fails if a
            // function is added.
            _ => Err(AdsError::INVALID_OFFSET),
        }
    }
}

const _: () = assert!(Function::ALL.len() == 30, "add the new function to `AnsweringCnc::reply`");

impl Responder for Cnc {
    fn answer(&self, call: &Call<'_>) -> ReplyData {
        Self::answer(self, call)
    }

    fn respond_all(&self, net_id: AmsNetId, frames: &mut Frames<'_>, answers: &mut Vec<u8>) {
        // Lock the state, read the clock and advance the programs once for all frames, which takes
        // less time than once for each frame.
        let mut cnc = self.answering();
        while let Some(frame) = frames.next(answers) {
            respond(&mut |call| cnc.answer(call), net_id, &frame, answers);
        }
    }

    fn pass(&self, time: Duration) {
        Self::pass(self, time);
    }
}

/// The CNC while it answers requests, with its state locked.
struct AnsweringCnc<'a> {
    model: &'a Model,
    state: MutexGuard<'a, CncState>,
    now: Duration,
}

impl AnsweringCnc<'_> {
    fn channel(&self, at: Channel) -> Result<usize, AdsError> {
        self.state.channel(self.model, at.addressing(), at.number())
    }

    fn write_program_stream(&mut self, op: &WriteProgramStream<'_>) -> ReplyData {
        let channel = self.channel(op.channel)?;
        let channel = self.state.channels.get_mut(channel).ok_or(AdsError::INVALID_GROUP)?;
        match program::result(channel.program.write(op.packet, self.now)) {
            AdsError::NO_ERROR => encode(NoData),
            rejected => Err(rejected),
        }
    }
}

fn dispatch<'a>(call: &Call<'a>) -> Result<Request<'a>, AdsError> {
    call.dispatch().map_err(|rejection| {
        tracing::debug!(group = %call.index_group, offset = %call.index_offset, "rejected: {rejection}");
        rejection.ads_error()
    })
}

fn encode<'a>(reply: impl Into<Reply<'a>>) -> ReplyData {
    // This does not fail, because the model was checked.
    reply.into().encode_to_vec().map_err(|_| AdsError::INVALID_DATA)
}

#[cfg(test)]
mod any_call;
#[cfg(test)]
mod tests;
