//! What answers requests.

use std::fmt;
use std::sync::Arc;
use std::time::Duration;

use ads_cnc::ads::{AmsNetId, FrameRef};
use ads_cnc::operation::Call;

use super::respond::{ReplyData, respond};

/// Answers ADS requests: a [`Cnc`](super::Cnc), or what is put around one.
pub trait Responder: fmt::Debug + Send + Sync {
    /// The data to answer with.
    ///
    /// # Errors
    /// An error number.
    fn answer(&self, call: &Call<'_>) -> ReplyData;

    /// Appends the frame to answer with, as the device of this NetId; nothing for a frame that is no
    /// request.
    ///
    /// A frame for another NetId or a port that no task has is answered with an error in the AMS
    /// header and no data, all other refusals with a result.
    fn respond(&self, net_id: AmsNetId, frame: &FrameRef<'_>, answers: &mut Vec<u8>) {
        respond(&|call| self.answer(call), net_id, frame, answers);
    }

    /// The most bytes that are sent at a time; at least 1.
    fn piece(&self) -> usize {
        usize::MAX
    }

    /// Lets time pass, on a stopped clock.
    fn pass(&self, time: Duration);
}

impl<R: Responder + ?Sized> Responder for Arc<R> {
    fn answer(&self, call: &Call<'_>) -> ReplyData {
        (**self).answer(call)
    }

    fn respond(&self, net_id: AmsNetId, frame: &FrameRef<'_>, answers: &mut Vec<u8>) {
        (**self).respond(net_id, frame, answers);
    }

    fn piece(&self) -> usize {
        (**self).piece()
    }

    fn pass(&self, time: Duration) {
        (**self).pass(time);
    }
}
