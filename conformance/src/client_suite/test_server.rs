//! The CNC to which a client under test connects: a TCP server that records the frames, up to a
//! limit, and can change the replies of the simulated CNC.

use std::collections::HashMap;
use std::io::{self, Read as _, Write as _};
use std::net::{Shutdown, SocketAddr, TcpStream};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use ads_cnc::ads::AmsNetId;

use super::script::ScenarioScript;
use super::tamper::SendStep;
use crate::client::Tap;
use crate::judge::Stop;
use crate::mutex::lock;
use crate::net;
use crate::number::{to_usize, u32_at};
use crate::simulator::{FRAME_MAX, NET_ID};
use crate::text::plural;

/// Maximum number of open connections, each of which has a thread; the server counts and closes
/// further connections.
pub(super) const CONNECTIONS_MAX: usize = 64;

/// After this many bytes of recorded requests and replies that wait to be judged, further requests
/// are not recorded. [`TURN`] bytes are added to the length of each request.
pub(super) const RECORDED_BYTES_MAX: usize = 8 << 20;
const TURN: usize = 128;

/// How long to wait for the client to close its connections at the end of a scenario, and how long
/// all connections must have been closed before [`TestServer::watch`] returns.
const LINGER: Duration = Duration::from_millis(200);

/// A request and all bytes that the server sent as its reply.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct RecordedExchange {
    pub(super) connection: usize,
    /// The address of the client, for the capture.
    pub(super) peer: Option<SocketAddr>,
    /// The request; the last request of a connection may be incomplete.
    pub(super) request: Vec<u8>,
    pub(super) sent: Vec<u8>,
    /// Why the bytes of the request are not a frame; `None` if they are a frame.
    pub(super) fault: Option<String>,
}

/// The recorded exchanges of a scenario.
#[derive(Debug, Default)]
struct Recording {
    kept: Vec<RecordedExchange>,
    /// The numbers of the exchanges whose reply is not sent completely, in ascending order.
    open: Vec<usize>,
    /// Number of exchanges that were removed from `kept` to be judged.
    taken: usize,
    bytes: usize,
    /// Number of exchanges that were not recorded because the limit was exceeded.
    beyond: usize,
}

impl Recording {
    /// Records an exchange. Returns its number, or `None` if the limit is exceeded.
    fn record(&mut self, exchange: RecordedExchange) -> Option<usize> {
        self.grow(exchange.request.len().saturating_add(TURN));
        if self.bytes > RECORDED_BYTES_MAX {
            self.beyond = self.beyond.saturating_add(1);
            return None;
        }
        self.kept.push(exchange);
        Some(self.taken.saturating_add(self.kept.len()).saturating_sub(1))
    }

    fn grow(&mut self, by: usize) {
        self.bytes = self.bytes.saturating_add(by);
    }

    fn of_number(&mut self, number: usize) -> Option<&mut RecordedExchange> {
        self.kept.get_mut(number.checked_sub(self.taken)?)
    }

    /// Records an exchange whose reply is sent afterwards, until [`close`](Self::close).
    fn open(&mut self, exchange: RecordedExchange) -> Option<usize> {
        let number = self.record(exchange);
        self.open.extend(number);
        number
    }

    fn close(&mut self, number: Option<usize>) {
        self.open.retain(|open| Some(*open) != number);
    }

    /// Removes the exchanges before the first one whose reply is not sent completely, and returns
    /// them in their order.
    fn take_answered(&mut self) -> Vec<RecordedExchange> {
        let first = self.open.first().map(|first| first.saturating_sub(self.taken));
        self.take_first(first.unwrap_or(usize::MAX))
    }

    /// Removes at most `count` of the recorded exchanges, the earliest first, and returns them in
    /// their order.
    fn take_first(&mut self, count: usize) -> Vec<RecordedExchange> {
        let exchanges: Vec<_> = self.kept.drain(..count.min(self.kept.len())).collect();
        self.taken = self.taken.saturating_add(exchanges.len());
        let lengths = self.kept.iter().flat_map(|one| [one.request.len(), one.sent.len(), TURN]);
        self.bytes = lengths.fold(0, usize::saturating_add);
        exchanges
    }
}

/// The number of requests and connections that exceeded the limits.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Overflow {
    /// Number of requests that were not recorded, and so are not judged.
    pub(super) requests: usize,
    /// Number of connections that the server closed immediately.
    pub(super) connections: usize,
}

impl Overflow {
    /// Why the case is inconclusive; `None` if no limit was exceeded.
    pub(super) fn stop(self) -> Option<Stop> {
        let requests = (self.requests > 0).then(|| {
            let (count, mebibytes) = (plural(self.requests, "request"), RECORDED_BYTES_MAX >> 20);
            format!("not judged: {count} after the first {mebibytes} MiB")
        });
        let connections = (self.connections > 0).then(|| {
            let count = plural(self.connections, "connection");
            format!("closed at once: {count} while {CONNECTIONS_MAX} were open")
        });
        let exceeded: Vec<String> = [requests, connections].into_iter().flatten().collect();
        (!exceeded.is_empty()).then(|| Stop::Inconclusive(exceeded.join("; ")))
    }
}

/// The TCP server, which runs one scenario after another.
#[derive(Debug)]
pub struct TestServer {
    acceptor: net::Acceptor,
    run: Arc<Mutex<Option<Arc<TestRun>>>>,
    capture: Option<Mutex<ClientCapture>>,
}

/// The capture of the recorded traffic with clients, in which one connection is open at a time.
#[derive(Debug)]
struct ClientCapture {
    tap: Box<dyn Tap>,
    /// The addresses of client and server of the connection that is open in the capture.
    open: Option<(SocketAddr, SocketAddr)>,
}

impl ClientCapture {
    /// Ends the open connection in the capture and begins the connection `next`, if they differ.
    fn switch(&mut self, next: Option<(SocketAddr, SocketAddr)>) {
        if self.open == next {
            return;
        }
        if self.open.take().is_some() {
            self.tap.closed();
        }
        if let Some((client, server)) = next {
            self.tap.opened(client, server);
        }
        self.open = next;
    }
}

/// The state of the current scenario.
#[derive(Debug)]
struct TestRun {
    script: Mutex<ScenarioScript>,
    exchanges: Mutex<Recording>,
    /// The open connections by number, so that the end of the scenario can close them.
    streams: Mutex<HashMap<usize, TcpStream>>,
    threads: Mutex<Vec<JoinHandle<()>>>,
    /// Number of connections.
    count: AtomicUsize,
    /// Number of connections that exceeded [`CONNECTIONS_MAX`].
    beyond: AtomicUsize,
    /// Is notified when a connection is removed from `streams`.
    closed: Condvar,
}

impl TestServer {
    pub fn new(addr: SocketAddr) -> io::Result<Self> {
        let run: Arc<Mutex<Option<Arc<TestRun>>>> = Arc::default();
        let playing = Arc::clone(&run);
        let acceptor = net::Acceptor::start("clients", net::listen(addr)?, move |stream, _| {
            // If no scenario is running, the connection is dropped and so closed. The lock is held
            // until the connection is registered with its scenario, because a scenario may end at
            // any time.
            let run = lock(&playing);
            let _gone = run.clone().map(|run| run.connect(stream));
        })?;
        Ok(Self { acceptor, run, capture: None })
    }

    /// Writes the recorded traffic of all connections to a capture.
    #[must_use]
    pub fn with_capture(mut self, capture: impl Into<Box<dyn Tap>>) -> Self {
        self.capture = Some(Mutex::new(ClientCapture { tap: capture.into(), open: None }));
        self
    }

    /// Ends the capture, if any.
    ///
    /// # Errors
    /// The first error of the system while the capture was written.
    pub fn end_capture(&mut self) -> io::Result<()> {
        let capture = self.capture.take().map(Mutex::into_inner);
        capture
            .map_or(Ok(()), |capture| capture.unwrap_or_else(PoisonError::into_inner).tap.finish())
    }

    fn capture(&self, exchanges: &[RecordedExchange]) {
        let Some(mut capture) = self.capture.as_ref().map(lock) else { return };
        let mut all: Vec<&RecordedExchange> = exchanges.iter().collect();
        all.sort_by_key(|exchange| exchange.connection);
        for exchange in all {
            let Some(peer) = exchange.peer else { continue };
            capture.switch(Some((peer, self.addr())));
            capture.tap.sent(&exchange.request);
            capture.tap.received(&exchange.sent);
        }
    }

    /// The address on which the server listens.
    pub const fn addr(&self) -> SocketAddr {
        self.acceptor.addr()
    }

    pub const fn net_id(&self) -> AmsNetId {
        NET_ID
    }

    /// Begins a scenario: from now on, the server serves connections with this script.
    pub(super) fn begin(&self, script: ScenarioScript) {
        *lock(&self.run) = Some(Arc::new(TestRun {
            script: Mutex::new(script),
            exchanges: Mutex::default(),
            streams: Mutex::default(),
            threads: Mutex::default(),
            count: AtomicUsize::new(0),
            beyond: AtomicUsize::new(0),
            closed: Condvar::new(),
        }));
    }

    /// Waits until a client has connected, all connections are closed and none was opened for
    /// [`LINGER`], or until `go_on` returns false.
    pub(super) fn watch(&self, mut go_on: impl FnMut() -> bool) {
        let Some(run) = lock(&self.run).clone() else { return };
        let (mut before, mut since) = (0, Instant::now());
        while go_on() {
            // A connection may open and close between two polls.
            let count = run.count.load(Ordering::SeqCst);
            if count != before || !lock(&run.streams).is_empty() {
                (before, since) = (count, Instant::now());
            }
            if count > 0 && since.elapsed() > LINGER {
                return;
            }
            thread::sleep(Duration::from_millis(20));
        }
    }

    /// Removes and returns the exchanges recorded since the last call, up to the first exchange
    /// whose reply the server has not sent completely.
    pub(super) fn exchanges(&self) -> Vec<RecordedExchange> {
        let Some(run) = lock(&self.run).clone() else { return Vec::new() };
        let exchanges = lock(&run.exchanges).take_answered();
        self.capture(&exchanges);
        exchanges
    }

    /// Ends the scenario and closes all connections. Returns the exchanges that were not taken
    /// before, what exceeded the limits, and the script, which is `None` if it is still in use or
    /// no scenario was running.
    pub(super) fn end(&self) -> (Vec<RecordedExchange>, Overflow, Option<ScenarioScript>) {
        let Some(run) = lock(&self.run).take() else {
            return (Vec::new(), Overflow::default(), None);
        };
        // Waits, for at most `LINGER`, until the server has read the bytes that a client sent
        // before it closed a connection.
        drop(run.closed.wait_timeout_while(lock(&run.streams), LINGER, |open| !open.is_empty()));
        for stream in lock(&run.streams).values() {
            let _closed = stream.shutdown(Shutdown::Both);
        }
        for thread in lock(&run.threads).drain(..) {
            let _panicked = thread.join();
        }
        let exchanges = lock(&run.exchanges).take_first(usize::MAX);
        self.capture(&exchanges);
        if let Some(mut capture) = self.capture.as_ref().map(lock) {
            capture.switch(None);
        }
        let connections = run.beyond.load(Ordering::SeqCst);
        let beyond = Overflow { requests: lock(&run.exchanges).beyond, connections };
        let script = Arc::into_inner(run)
            .map(|run| run.script.into_inner().unwrap_or_else(PoisonError::into_inner));
        (exchanges, beyond, script)
    }
}

impl Drop for TestServer {
    fn drop(&mut self) {
        self.acceptor.stop();
        self.end();
    }
}

impl TestRun {
    fn connect(self: Arc<Self>, stream: TcpStream) -> io::Result<()> {
        let connection = self.count.fetch_add(1, Ordering::SeqCst);
        if lock(&self.streams).len() >= CONNECTIONS_MAX {
            self.beyond.fetch_add(1, Ordering::SeqCst);
            return Ok(());
        }
        stream.set_nodelay(true)?;
        stream.set_write_timeout(Some(Duration::from_secs(5)))?;
        let peer = Some(stream.peer_addr()?);
        let blank = RecordedExchange { connection, peer, ..RecordedExchange::default() };
        lock(&self.streams).insert(connection, stream.try_clone()?);
        let run = Arc::clone(&self);
        let thread = thread::Builder::new().name(format!("client-{connection}"));
        let spawned = thread.spawn(move || {
            // The client may close the connection at any time.
            let _gone = run.serve(&blank, &stream);
            let _closed = stream.shutdown(Shutdown::Both);
            lock(&run.streams).remove(&connection);
            run.closed.notify_all();
        });
        let mut threads = lock(&self.threads);
        threads.retain(|thread| !thread.is_finished());
        match spawned {
            Ok(thread) => threads.push(thread),
            Err(_) => drop(lock(&self.streams).remove(&connection)),
        }
        Ok(())
    }

    /// Serves a connection; each recorded exchange is made from `blank`.
    fn serve(&self, blank: &RecordedExchange, mut stream: &TcpStream) -> io::Result<()> {
        let (mut received, mut chunk) = (Vec::new(), [0; 4096]);
        loop {
            while let Some(len) = frame_len(&received) {
                if len > FRAME_MAX {
                    let fault = Some(format!("a frame of {}", plural(len, "byte")));
                    self.record(RecordedExchange { request: received, fault, ..blank.clone() });
                    return Ok(());
                }
                if received.len() < len {
                    break;
                }
                let rest = received.split_off(len);
                let request = std::mem::replace(&mut received, rest);
                if !self.exchange(blank, &request, stream)? {
                    return Ok(());
                }
            }
            match stream.read(&mut chunk) {
                Ok(0) | Err(_) => {
                    if !received.is_empty() {
                        let fault = Some("closed within a frame".to_owned());
                        self.record(RecordedExchange { request: received, fault, ..blank.clone() });
                    }
                    return Ok(());
                }
                Ok(count) => received.extend(chunk.iter().take(count)),
            }
        }
    }

    /// Records a frame and replies to it. Returns whether the connection stays open.
    fn exchange(
        &self,
        blank: &RecordedExchange,
        request: &[u8],
        stream: &TcpStream,
    ) -> io::Result<bool> {
        // The request is recorded before the reply is sent, because the scenario may end as soon as
        // the client has received the reply.
        let number = lock(&self.exchanges)
            .open(RecordedExchange { request: request.to_vec(), ..blank.clone() });
        let stays = self.reply(blank.connection, request, number, stream);
        lock(&self.exchanges).close(number);
        stays
    }

    fn reply(
        &self,
        connection: usize,
        request: &[u8],
        number: Option<usize>,
        mut stream: &TcpStream,
    ) -> io::Result<bool> {
        let steps = match lock(&self.script).answer(connection, request) {
            Ok(steps) => steps,
            Err(fault) => {
                let mut exchanges = lock(&self.exchanges);
                if let Some(exchange) = number.and_then(|number| exchanges.of_number(number)) {
                    exchange.fault = Some(fault);
                }
                return Ok(false);
            }
        };
        for deed in steps {
            match deed {
                SendStep::Send(bytes) => {
                    let mut exchanges = lock(&self.exchanges);
                    if let Some(exchange) = number.and_then(|number| exchanges.of_number(number)) {
                        exchange.sent.extend(&bytes);
                        exchanges.grow(bytes.len());
                    }
                    drop(exchanges);
                    stream.write_all(&bytes)?;
                }
                SendStep::Pause(time) => thread::sleep(time),
                SendStep::Close => return Ok(false),
            }
        }
        Ok(true)
    }

    fn record(&self, exchange: RecordedExchange) {
        lock(&self.exchanges).record(exchange);
    }
}

/// The length of a frame according to its AMS/TCP header; `None` if the header is incomplete. The
/// header is read without the codec, which judges the frame later.
fn frame_len(received: &[u8]) -> Option<usize> {
    Some(to_usize(u32_at(received, 2)?).saturating_add(6))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Clients on several connections are answered at the same time: an exchange is not judged
    /// before its reply is recorded.
    #[test]
    fn an_exchange_is_taken_after_its_reply() {
        let mut recording = Recording::default();
        let [first, second] = [0, 1].map(|connection| {
            recording.open(RecordedExchange { connection, ..RecordedExchange::default() })
        });
        recording.close(second);
        assert!(recording.take_answered().is_empty());
        recording.of_number(first.unwrap()).unwrap().sent.push(7);
        recording.close(first);
        let sent: Vec<_> = recording.take_answered().into_iter().map(|one| one.sent).collect();
        assert_eq!(sent, [vec![7_u8], vec![]]);
        assert_eq!(recording.bytes, 0);
    }
}
