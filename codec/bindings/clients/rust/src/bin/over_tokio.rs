//! Over a socket of tokio: many requests are under way on one connection, and each reply is brought to its
//! request by the invoke ID.
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
use ads_cnc::operation::{Call, Service};
use ads_cnc::{Decode as _, Encode as _};
use ads_cnc_clients::{Result, Transport, arguments, show};
use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _};
use tokio::net::TcpStream;
use tokio::net::tcp::{OwnedReadHalf, OwnedWriteHalf};
use tokio::sync::{mpsc, oneshot};
use tokio::time::timeout;

const TIMEOUT: Duration = Duration::from_secs(5);

/// A received frame: its header, and the data after it.
type Received = (AmsHeader, Vec<u8>);

/// The requests without a reply, by their invoke IDs.
type Pending = Arc<Mutex<HashMap<u32, oneshot::Sender<Received>>>>;

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
        // The sender waits while this many frames are not yet written.
        let (frames, to_write) = mpsc::channel(32);
        let pending = Pending::default();
        tokio::spawn(write_frames(write, to_write));
        tokio::spawn(read_frames(read, Arc::clone(&pending)));
        Ok(Self { target, source, frames, pending, invoke_id: AtomicU32::new(1) })
    }
}

/// A future may be dropped at any `await`, but half a frame must not be sent: a task of its own writes.
async fn write_frames(mut write: OwnedWriteHalf, mut frames: mpsc::Receiver<Vec<u8>>) {
    while let Some(frame) = frames.recv().await {
        if write.write_all(&frame).await.is_err() {
            return;
        }
    }
}

async fn read_frames(mut read: OwnedReadHalf, pending: Pending) {
    let mut received = Vec::new();
    // After a wrong length nothing can be read from the stream any more.
    while let Ok(1..) = read.read_buf(&mut received).await
        && let Ok(len) = take_frames(&received, &pending)
    {
        received.drain(..len);
    }
    // No reply comes any more: each request that waits for one fails.
    lock(&pending).clear();
}

/// Gives each complete frame to its request; returns the length of these frames.
fn take_frames(received: &[u8], pending: &Pending) -> std::result::Result<usize, ads_cnc::Error> {
    let mut end = 0;
    // `split` rejects a frame that is longer than a service can have.
    while let Some((frame, len)) = FrameRef::split(&received[end..], u32::MAX)? {
        end += len;
        // Other frames are skipped: requests, and replies that came too late.
        let is_reply = frame.header().state_flags == StateFlags::RESPONSE;
        if let Some(waiting) = lock(pending).remove(&frame.header().invoke_id).filter(|_| is_reply)
        {
            let _timed_out = waiting.send((frame.header(), frame.data().to_vec()));
        }
    }
    Ok(end)
}

fn lock<T>(mutex: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes a request when its future ends, also if it was dropped.
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
            Service::Read => {
                let reply = ReadReplyRef::decode(&data)?;
                (reply.result, reply.data)
            }
            Service::ReadWrite => {
                let reply = ReadWriteReplyRef::decode(&data)?;
                (reply.result, reply.data)
            }
            Service::Write => (WriteReply::decode(&data)?.result, None),
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
