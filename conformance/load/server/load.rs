//! The clients: each has its own connection and thread, and one or more pending requests.

use std::collections::VecDeque;
use std::io::{self, Read as _, Write as _};
use std::net::{SocketAddr, TcpStream};
use std::sync::Barrier;
use std::thread;
use std::time::{Duration, Instant};

use ads_cnc_conformance::number::to_u32;

use crate::work::{Result, Work};

/// Maximum wait for a connection, and for any byte of a reply.
const WAIT_MAX: Duration = Duration::from_secs(10);

/// The load of a server.
#[derive(Clone, Copy)]
pub(crate) struct Load {
    pub(crate) clients: usize,
    /// Number of pending requests of a client.
    pub(crate) depth: usize,
    pub(crate) time: Duration,
}

/// The result of one slice of time.
#[derive(Default)]
pub(crate) struct Slice {
    /// Replies per second.
    pub(crate) rate: f64,
    /// Time from writing a request to reading its reply, in ns, for each reply including late ones, so
    /// that the list is never empty.
    pub(crate) nanos: Vec<u32>,
}

/// Sends requests for a slice of time. Checks every reply; a wrong reply is an error. An echo
/// server (`is_echo`) repeats the same reply, whose invoke ID is 0.
pub(crate) fn slice(addr: SocketAddr, work: &Work, load: Load, is_echo: bool) -> Result<Slice> {
    let clients = (0..load.clients).map(|_| Client::connect(addr, work, is_echo));
    let clients = clients.collect::<Result<Vec<_>>>()?;
    let ready = &Barrier::new(load.clients);
    let slices = thread::scope(|scope| {
        let threads = clients.into_iter().map(|mut client| {
            scope.spawn(move || {
                ready.wait();
                client.run(load)
            })
        });
        // Start all threads before joining the first.
        let threads: Vec<_> = threads.collect();
        let joined = threads.into_iter().map(|thread| thread.join().expect("no client panics"));
        joined.collect::<Result<Vec<Slice>>>()
    })?;
    let mut all = Slice::default();
    for one in slices {
        all.rate += one.rate;
        all.nanos.extend(one.nanos);
    }
    Ok(all)
}

/// Sends `depth` requests in one write, and returns the number of replies before a pause of 500 ms.
pub(crate) fn answered_of_burst(addr: SocketAddr, work: &Work, depth: usize) -> Result<usize> {
    let mut client = Client::connect(addr, work, false)?;
    client.ask(depth)?;
    client.stream.set_read_timeout(Some(Duration::from_millis(500)))?;
    let mut answered = 0;
    while answered < depth {
        match client.replies() {
            Ok(replies) => answered += replies,
            Err(error) => match error.downcast_ref::<io::Error>().map(io::Error::kind) {
                Some(io::ErrorKind::WouldBlock | io::ErrorKind::TimedOut) => break,
                _ => return Err(error),
            },
        }
    }
    Ok(answered)
}

struct Client<'a> {
    stream: TcpStream,
    work: &'a Work,
    is_echo: bool,
    /// The numbers of the next request and of the next reply.
    next: (u32, u32),
    out: Vec<u8>,
    received: Vec<u8>,
    buffered: usize,
}

impl<'a> Client<'a> {
    /// Connects, sends one request, and waits for its reply.
    fn connect(addr: SocketAddr, work: &'a Work, is_echo: bool) -> Result<Self> {
        let stream = TcpStream::connect_timeout(&addr, WAIT_MAX)?;
        stream.set_nodelay(true)?;
        stream.set_read_timeout(Some(WAIT_MAX))?;
        stream.set_write_timeout(Some(WAIT_MAX))?;
        let received = vec![0; 256 * 1024];
        let mut client =
            Self { stream, work, is_echo, next: (1, 1), out: Vec::new(), received, buffered: 0 };
        client.ask(1)?;
        while client.replies()? == 0 {}
        Ok(client)
    }

    fn run(&mut self, load: Load) -> Result<Slice> {
        let (begin, mut nanos) = (Instant::now(), Vec::with_capacity(1 << 16));
        let mut under_way = VecDeque::with_capacity(load.depth);
        let mut in_time = 0_u32;
        let mut now = begin;
        loop {
            if now.duration_since(begin) < load.time {
                let more = load.depth - under_way.len();
                under_way.extend(std::iter::repeat_n(Instant::now(), more));
                self.ask(more)?;
            } else if under_way.is_empty() {
                break;
            }
            let replies = self.replies()?;
            now = Instant::now();
            if replies > under_way.len() {
                return Err("more replies than requests".into());
            }
            for sent in under_way.drain(..replies) {
                // A time over 4.29 s (`u32::MAX` ns) is recorded as 4.29 s. 10 s without a byte are
                // an error.
                let nano = now.duration_since(sent).as_nanos();
                nanos.push(to_u32(nano));
            }
            // A reply after the end of the slice counts for the latency, but not for the rate.
            if now.duration_since(begin) < load.time {
                in_time += u32::try_from(replies)?;
            }
        }
        Ok(Slice { rate: f64::from(in_time) / load.time.as_secs_f64(), nanos })
    }

    /// Sends `count` requests at once.
    fn ask(&mut self, count: usize) -> Result<()> {
        self.out.clear();
        for _ in 0..count {
            self.work.request(self.next.0, &mut self.out)?;
            self.next.0 = self.next.0.wrapping_add(1);
        }
        self.stream.write_all(&self.out)?;
        Ok(())
    }

    /// Reads once; returns the number of complete replies.
    fn replies(&mut self) -> Result<usize> {
        let count = self.stream.read(&mut self.received[self.buffered..])?;
        if count == 0 {
            return Err("the server has closed the connection".into());
        }
        self.buffered += count;
        let (mut at, mut replies) = (0, 0);
        loop {
            let expected = if self.is_echo { 0 } else { self.next.1 };
            let Some(len) = self.work.check(&self.received[at..self.buffered], expected)? else {
                break;
            };
            self.next.1 = self.next.1.wrapping_add(1);
            at += len;
            replies += 1;
        }
        self.received.copy_within(at..self.buffered, 0);
        self.buffered -= at;
        Ok(replies)
    }
}
