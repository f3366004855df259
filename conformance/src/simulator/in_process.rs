//! Connections to a simulated CNC of this process, without sockets and without waiting.

use std::collections::VecDeque;
use std::io;
use std::sync::Arc;
use std::time::Duration;

use ads_cnc::ads::AmsNetId;

use super::{ReceiveBuffer, Responder};
use crate::net::{LocalPeers, Peer};

/// A CNC to which clients in this process connect without sockets.
#[derive(Debug)]
pub struct LocalCnc {
    cnc: Arc<dyn Responder>,
    net_id: AmsNetId,
}

impl LocalCnc {
    /// Makes `cnc`, whose clock must be stopped, available under an AMS NetId.
    pub fn new(cnc: Arc<dyn Responder>, net_id: AmsNetId) -> Arc<Self> {
        Arc::new(Self { cnc, net_id })
    }
}

impl LocalPeers for LocalCnc {
    fn connect(&self) -> Box<dyn Peer> {
        Box::new(InProcess::new(Arc::clone(&self.cnc), self.net_id))
    }

    fn pass(&self, time: Duration) {
        self.cnc.pass(time);
    }
}

/// The CNC's end of a connection.
///
/// If there are no bytes for the client, a socket waits; this end advances the CNC's clock by the
/// timeout instead. So the wait for a missing reply takes almost no time.
#[derive(Debug)]
struct InProcess {
    cnc: Arc<dyn Responder>,
    net_id: AmsNetId,
    received: ReceiveBuffer,
    /// Bytes for the client, in the pieces in which the CNC sent them.
    answers: VecDeque<Vec<u8>>,
    closed: bool,
}

impl InProcess {
    fn new(cnc: Arc<dyn Responder>, net_id: AmsNetId) -> Self {
        Self {
            cnc,
            net_id,
            received: ReceiveBuffer::new(),
            answers: VecDeque::new(),
            closed: false,
        }
    }
}

impl Peer for InProcess {
    fn send(&mut self, mut bytes: &[u8], _: Duration) -> io::Result<()> {
        let Self { cnc, net_id, received, answers, closed } = self;
        while !bytes.is_empty() && !*closed {
            let room = received.room();
            let count = room.len().min(bytes.len());
            let (piece, rest) = bytes.split_at(count);
            room.iter_mut().zip(piece).for_each(|(to, from)| *to = *from);
            bytes = rest;
            let taken = received.take(count, &**cnc, *net_id, |bytes| {
                answers.extend(bytes.chunks(cnc.piece()).map(<[u8]>::to_vec));
                Ok(())
            });
            // Like a `Server`, close a connection after an invalid frame.
            *closed = taken.is_err();
        }
        Ok(())
    }

    fn receive(&mut self, buf: &mut [u8], timeout: Duration) -> io::Result<usize> {
        match self.answers.front_mut() {
            Some(answer) => {
                let count = answer.len().min(buf.len());
                let read = answer.drain(..count);
                buf.iter_mut().zip(read).for_each(|(to, from)| *to = from);
                if answer.is_empty() {
                    self.answers.pop_front();
                }
                Ok(count)
            }
            None if self.closed => Ok(0),
            None => {
                self.cnc.pass(timeout);
                Err(io::ErrorKind::TimedOut.into())
            }
        }
    }
}
