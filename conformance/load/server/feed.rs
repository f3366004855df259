//! The simulated CNC without a socket, for counting instructions: feeds the bytes of requests to the
//! code of a connection's thread.

use ads_cnc_conformance::simulator::{Cnc, NET_ID, ReceiveBuffer};

use crate::work::{Result, Work};

/// Feeds `count` requests, `depth` at a time.
pub(crate) fn feed(work: &Work, count: usize, depth: usize) -> Result<()> {
    let (cnc, mut received) = (Cnc::with_default_model()?, ReceiveBuffer::new());
    let (mut requests, mut replies) = (Vec::new(), Vec::new());
    for _ in 0..depth {
        work.request(1, &mut requests)?;
        replies.extend(work.reply(1)?);
    }
    for _ in 0..count / depth {
        let room = received.room();
        room.get_mut(..requests.len()).ok_or("too many at a time")?.copy_from_slice(&requests);
        let mut rest = replies.as_slice();
        let mut right = true;
        received.take(requests.len(), &cnc, NET_ID, |answers| {
            match rest.strip_prefix(answers) {
                Some(more) => rest = more,
                None => right = false,
            }
            Ok(())
        })?;
        if !right || !rest.is_empty() {
            return Err(format!("{}: a wrong reply", work.name).into());
        }
    }
    Ok(())
}
