//! Sends the requests over a socket of tokio: several requests are in flight on one connection, and
//! the invoke ID matches each reply to its request.
//!
//!     over_tokio HOST:PORT EXPECTED.json

use std::collections::HashMap;
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use ads_cnc::ads::{
    AmsAddr, AmsHeader, AmsNetId, AmsPort, FrameRef, ReadReplyRef, ReadWriteReplyRef, StateFlags,
    WriteReply,
};
use ads_cnc::operation::{AdsService, Call};
use ads_cnc::{Decode as _, Encode as _};
use ads_cnc_clients::{Result, Transport, arguments, show};
use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _};
use tokio::net::TcpStream;
use tokio::net::tcp::{OwnedReadHalf, OwnedWriteHalf};
use tokio::sync::{mpsc, oneshot};
use tokio::time::timeout;

const TIMEOUT: Duration = Duration::from_secs(5);

/// A received frame: its header, and the data after it.
type ReceivedFrame = (AmsHeader, Vec<u8>);

/// The requests that have no reply yet, by their invoke IDs.
type Pending = Arc<Mutex<HashMap<u32, oneshot::Sender<ReceivedFrame>>>>;

struct Connection {
    target: AmsNetId,
    source: AmsAddr,
    frames: mpsc::Sender<Vec<u8>>,
    pending: Pending,
    invoke_id: AtomicU32,
}

impl Connection {
    async fn open(address: &str, target: AmsNetId, source: AmsAddr) -> Result<Self> {
        let stream = timeout(TIMEOUT, TcpStream::connect(address)).await??;
        stream.set_nodelay(true)?;
        let (read, write) = stream.into_split();
        // At most 32 frames wait to be written; further requests wait until one of them was
        // written.
        let (frames, to_write) = mpsc::channel(32);
        let pending = Pending::default();
        tokio::spawn(write_frames(write, to_write));
        tokio::spawn(read_frames(read, Arc::clone(&pending)));
        Ok(Self { target, source, frames, pending, invoke_id: AtomicU32::new(1) })
    }
}

/// Writes frames in a separate task: the future of a request may be dropped at any `await`, but a
/// partial frame must not be sent.
async fn write_frames(mut write: OwnedWriteHalf, mut frames: mpsc::Receiver<Vec<u8>>) {
    while let Some(frame) = frames.recv().await {
        if write.write_all(&frame).await.is_err() {
            return;
        }
    }
}

async fn read_frames(mut read: OwnedReadHalf, pending: Pending) {
    let mut received = Vec::new();
    // After a wrong length, no further frame can be found in the stream.
    while let Ok(1..) = read.read_buf(&mut received).await
        && let Ok(len) = take_frames(&received, &pending)
    {
        received.drain(..len);
    }
    // No more replies will arrive: all waiting requests fail.
    lock(&pending).clear();
}

/// Passes each complete frame that is a reply to its request; returns the length of all complete
/// frames.
fn take_frames(received: &[u8], pending: &Pending) -> std::result::Result<usize, ads_cnc::Error> {
    let mut end = 0;
    // `split` itself limits the data: it rejects a frame that is longer than any service can have.
    while let Some((frame, len)) = FrameRef::split(&received[end..], u32::MAX)? {
        end += len;
        // Skip other frames: requests, and replies that arrived too late.
        if frame.header().state_flags == StateFlags::RESPONSE
            && let Some(waiting) = lock(pending).remove(&frame.header().invoke_id)
        {
            let _timed_out = waiting.send((frame.header(), frame.data().to_vec()));
        }
    }
    Ok(end)
}

fn lock<T>(mutex: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes a request from the pending requests when its future ends or is dropped.
struct Remove<'a>(&'a Pending, u32);

impl Drop for Remove<'_> {
    fn drop(&mut self) {
        lock(self.0).remove(&self.1);
    }
}

impl Transport for Connection {
    async fn send(&self, call: Call<'_>) -> Result<Vec<u8>> {
        let invoke_id = self.invoke_id.fetch_add(1, Ordering::Relaxed);
        let target = AmsAddr { net_id: self.target, port: call.port };
        let command = call.service.command();
        let header = AmsHeader::request(target, self.source, command, invoke_id);
        let frame = FrameRef::new(header, &call.encode_to_vec()?)?.encode_to_vec()?;

        let (sender, reply) = oneshot::channel();
        lock(&self.pending).insert(invoke_id, sender);
        let _remove = Remove(&self.pending, invoke_id);
        self.frames.send(frame).await?;
        let (header, data) = timeout(TIMEOUT, reply).await??;
        header.error.into_result()?;
        if header.command != command {
            return Err(format!("a reply to {:?}, not to {command:?}", header.command).into());
        }
        let (result, data) = match call.service {
            AdsService::Read => {
                let reply = ReadReplyRef::decode(&data)?;
                (reply.result, reply.data)
            }
            AdsService::ReadWrite => {
                let reply = ReadWriteReplyRef::decode(&data)?;
                (reply.result, reply.data)
            }
            AdsService::Write => (WriteReply::decode(&data)?.result, None),
        };
        result.into_result()?;
        Ok(data.unwrap_or_default().to_vec())
    }
}

#[tokio::main(flavor = "current_thread")]
async fn main() -> Result<()> {
    let (address, expected) = arguments()?;
    let target = AmsNetId([127, 0, 0, 1, 1, 1]);
    let source = AmsAddr { net_id: AmsNetId([127, 0, 0, 1, 1, 8]), port: AmsPort(0x8001) };
    show(&Connection::open(&address, target, source).await?, &expected).await
}
