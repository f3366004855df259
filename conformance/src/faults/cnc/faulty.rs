//! A CNC with a defect.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::time::Duration;

use ads_cnc::ads::{AmsNetId, Command, FrameRef};
use ads_cnc::layout::Stream;
use ads_cnc::limits::{AMS_HEADER_LEN, AMS_TCP_HEADER_LEN};
use ads_cnc::operation::Call;

use super::{CncFault, Memory, ReplyData, Upstream, is};
use crate::ads_service::{reply_stream, request_stream, service_of};
use crate::faults::field::FieldDefect;
use crate::faults::seeded_defect::{Mechanism, SeededDefect};
use crate::simulator::{Cnc, Frames, Model, Responder, respond};

/// A simulated CNC with at most one defect, or with several field defects.
///
/// A field defect changes the data of requests before the CNC decodes this data, and the headers
/// and the data of its replies.
#[derive(Debug)]
pub struct Faulty {
    cnc: Arc<Cnc>,
    how: Option<Mechanism>,
    /// The field defects.
    fields: Vec<FieldDefect>,
    memory: Mutex<Memory>,
    /// Whether a field defect has changed at least one byte.
    shown: AtomicBool,
}

impl Faulty {
    /// Adds a defect or a variant to a CNC that has processed no request.
    pub fn new(cnc: Cnc, defect: Option<&SeededDefect>) -> Self {
        let how = defect.map(|defect| defect.how.clone());
        let cnc = match &how {
            Some(Mechanism::Cnc(CncFault::Model(model))) => {
                match Model::from_toml(model, "the model of a variant") {
                    Ok(model) => cnc.with_model(model),
                    Err(_) => cnc,
                }
            }
            Some(Mechanism::Cnc(CncFault::Program(policy))) => cnc.with_policy(*policy),
            _ => cnc,
        };
        let fields = match &how {
            Some(Mechanism::Field(defect)) => vec![defect.clone()],
            _ => Vec::new(),
        };
        let (cnc, memory, shown) = (Arc::new(cnc), Mutex::default(), AtomicBool::new(false));
        Self { cnc, how, fields, memory, shown }
    }

    /// Creates a CNC with several field defects.
    pub fn with_fields(cnc: Cnc, fields: Vec<FieldDefect>) -> Self {
        Self { fields, ..Self::new(cnc, None) }
    }

    /// The CNC to which the defect was added.
    pub const fn cnc(&self) -> &Arc<Cnc> {
        &self.cnc
    }

    /// Whether a field defect has changed at least one byte; true for other defects. A field defect
    /// that sets a field to the value that it already has is not detectable.
    pub(crate) fn has_shown(&self) -> bool {
        self.fields.is_empty() || self.shown.load(Ordering::Relaxed)
    }

    fn upstream(&self) -> Upstream<'_> {
        Upstream { cnc: &self.cnc, memory: &self.memory }
    }

    /// The bytes of a stream, changed by the field defects; `None` if no byte changes.
    fn change(&self, stream: Option<Stream>, bytes: &[u8]) -> Option<Vec<u8>> {
        let stream = stream?;
        let mut changed = None;
        for defect in self.fields.iter().filter(|defect| defect.touches(stream)) {
            changed = Some(defect.apply(changed.as_deref().unwrap_or(bytes)));
        }
        let changed = changed.filter(|changed| changed != bytes)?;
        self.shown.store(true, Ordering::Relaxed);
        Some(changed)
    }

    /// Applies the field defects to the two headers and the data of a response frame.
    fn change_frame(&self, command: Command, answer: &mut [u8]) {
        let reply = match (service_of(command), command) {
            (Some(service), _) => Some(reply_stream(service)),
            (None, Command::READ_DEVICE_INFO) => Some(Stream::DeviceInfoReply),
            (None, Command::READ_STATE) => Some(Stream::DeviceStateReply),
            (None, Command::ADD_NOTIFICATION) => None,
            (None, _) => Some(Stream::WriteReply),
        };
        let (tcp, rest) = answer.split_at_mut_checked(AMS_TCP_HEADER_LEN).unwrap_or_default();
        let (ams, data) = rest.split_at_mut_checked(AMS_HEADER_LEN).unwrap_or_default();
        let parts =
            [(Some(Stream::AmsTcpHeader), tcp), (Some(Stream::AmsHeader), ams), (reply, data)];
        for (stream, part) in parts {
            if let Some(changed) = self.change(stream, part) {
                part.iter_mut().zip(changed).for_each(|(byte, new)| *byte = new);
            }
        }
    }
}

impl Responder for Faulty {
    fn answer(&self, call: &Call<'_>) -> ReplyData {
        match &self.how {
            Some(Mechanism::Cnc(CncFault::Answer(answer))) => answer(&self.upstream(), call),
            Some(Mechanism::Cnc(CncFault::Function(functions, answer))) if is(call, functions) => {
                answer(&self.upstream(), call)
            }
            _ if !self.fields.is_empty() => {
                let spec = call.dispatch().ok().map(|request| request.function().spec());
                let misread = self.change(spec.and_then(|spec| spec.request), call.data);
                let data = misread.as_deref().unwrap_or(call.data);
                let reply = self.cnc.answer(&Call { data, ..*call })?;
                Ok(self.change(spec.and_then(|spec| spec.reply), &reply).unwrap_or(reply))
            }
            _ => self.cnc.answer(call),
        }
    }

    fn respond(&self, net_id: AmsNetId, frame: &FrameRef<'_>, answers: &mut Vec<u8>) {
        let (start, command) = (answers.len(), frame.header().command);
        let misread = self.change(service_of(command).map(request_stream), frame.data());
        let misread = misread.as_deref().and_then(|data| FrameRef::new(frame.header(), data).ok());
        respond(&mut |call| self.answer(call), net_id, misread.as_ref().unwrap_or(frame), answers);
        if let Some(Mechanism::Cnc(CncFault::Frame(sent))) = self.how
            && answers.len() > start
        {
            let correct = answers.split_off(start);
            answers.extend(sent(&self.upstream(), frame, correct));
        }
        self.change_frame(command, answers.get_mut(start..).unwrap_or_default());
    }

    fn respond_all(&self, net_id: AmsNetId, frames: &mut Frames<'_>, answers: &mut Vec<u8>) {
        if self.how.is_none() && self.fields.is_empty() {
            return self.cnc.respond_all(net_id, frames, answers);
        }
        while let Some(frame) = frames.next(answers) {
            self.respond(net_id, &frame, answers);
        }
    }

    fn piece(&self) -> usize {
        match self.how {
            Some(Mechanism::Cnc(CncFault::Pieces(len))) => len.max(1),
            _ => usize::MAX,
        }
    }

    fn pass(&self, time: Duration) {
        self.cnc.pass(time);
    }
}
