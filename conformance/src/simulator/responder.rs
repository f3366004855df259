//! The trait of a CNC, or of middleware around a CNC, that answers ADS requests.

use std::fmt;
use std::time::Duration;

use ads_cnc::ads::{AmsNetId, FrameRef};
use ads_cnc::operation::Call;

use super::frames::Frames;
use super::respond::{ReplyData, respond};

/// Answers ADS requests: a [`Cnc`](super::Cnc), or middleware around a CNC.
pub trait Responder: fmt::Debug + Send + Sync {
    /// Answers a request; returns the data of the reply.
    ///
    /// # Errors
    /// The ADS error number of the reply.
    fn answer(&self, call: &Call<'_>) -> ReplyData;

    /// Appends the reply to a frame, as the device with this NetId. Appends nothing if the frame is
    /// not a request.
    ///
    /// A frame to another NetId or to a port without a task is answered with an AMS error without
    /// data; other invalid requests are answered with an error in the result.
    fn respond(&self, net_id: AmsNetId, frame: &FrameRef<'_>, answers: &mut Vec<u8>) {
        respond(&mut |call| self.answer(call), net_id, frame, answers);
    }

    /// Appends the replies to several frames, in order. A [`Cnc`](super::Cnc) reads its clock only
    /// once for all of these frames.
    fn respond_all(&self, net_id: AmsNetId, frames: &mut Frames<'_>, answers: &mut Vec<u8>) {
        while let Some(frame) = frames.next(answers) {
            self.respond(net_id, &frame, answers);
        }
    }

    /// Maximum number of bytes of a reply that are sent at a time; at least 1.
    fn piece(&self) -> usize {
        usize::MAX
    }

    /// Advances the clock of the CNC by `time`.
    fn pass(&self, time: Duration);
}
