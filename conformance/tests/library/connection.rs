//! The client without a connection or after a frame that was not sent completely, and a session whose
//! connection is replaced.

use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

use ads_cnc::Kind;
use ads_cnc::address::Channel;
use ads_cnc::operation::{CountVariables, Request};
use ads_cnc_conformance::client::{Client, Target};
use ads_cnc_conformance::deadline::Deadline;
use ads_cnc_conformance::exchange::{Exchange, ExchangeError};
use ads_cnc_conformance::gate::{Gate, NET_ID};
use ads_cnc_conformance::net::{self, LocalPeers, Peer};
use ads_cnc_conformance::session::{Session, ToolError};
use ads_cnc_conformance::simulator::Cnc;

/// The first request is sent before the connection is found to be closed. Without a connection, the
/// second request is not sent.
#[test]
fn without_a_connection_no_frame_is_sent() {
    let listener = net::listen(([127, 0, 0, 1], 0).into()).unwrap();
    let target = Target::local(listener.local_addr().unwrap(), NET_ID);
    let mut client = Client::connect(target, Gate::queries()).unwrap();
    drop(listener.accept().unwrap());
    drop(listener);
    let request = Request::from(CountVariables::new(Channel::new(1).unwrap(), Kind::V_E));
    let mut buf = [0; 64];
    let call = request.encode(&mut buf).unwrap();
    let exchanges = [client.call(&call), client.call(&call)];
    let is_disconnected =
        |one: &Exchange| matches!(one.outcome, Err(ExchangeError::Disconnected(_)));
    assert!(exchanges.iter().all(is_disconnected), "{exchanges:?}");
    assert_eq!(exchanges.map(|one| one.sent.is_empty()), [false, true]);
}

/// A peer to which no frame can be sent within the timeout; counts the connections.
#[derive(Debug, Default)]
struct Blocked(AtomicUsize);

impl LocalPeers for Blocked {
    fn connect(&self) -> Box<dyn Peer> {
        self.0.fetch_add(1, Ordering::SeqCst);
        Box::new(Self::default())
    }

    fn pass(&self, _: Duration) {}
}

impl Peer for Blocked {
    fn send(&mut self, _: &[u8], _: Duration) -> io::Result<()> {
        Err(io::ErrorKind::TimedOut.into())
    }

    fn receive(&mut self, _: &mut [u8], _: Duration) -> io::Result<usize> {
        Err(io::ErrorKind::TimedOut.into())
    }
}

/// After a frame that was possibly sent only in part, the next frame is sent on a new connection.
#[test]
fn no_frame_follows_a_part_of_a_frame() {
    let peers = Arc::new(Blocked::default());
    let target = Target::local(([127, 0, 0, 1], 0).into(), NET_ID);
    let mut client = Client::in_process(target, Gate::queries(), peers.clone()).unwrap();
    let request = Request::from(CountVariables::new(Channel::new(1).unwrap(), Kind::V_E));
    let mut buf = [0; 64];
    let call = request.encode(&mut buf).unwrap();
    for connections in [1, 2] {
        assert!(matches!(client.call(&call).outcome, Err(ExchangeError::Silence(_))));
        assert_eq!(peers.0.load(Ordering::SeqCst), connections);
    }
}

/// A session with another gate keeps its deadline.
#[test]
fn the_deadline_remains_with_another_gate() {
    let session = Session::simulated_to_try(Cnc::with_default_model().unwrap()).unwrap();
    let session = session.with_deadline(Deadline::after(Duration::ZERO));
    let mut session = session.with_gate(Gate::queries()).unwrap();
    let count = CountVariables::new(Channel::new(1).unwrap(), Kind::V_E);
    let called = session.call(&count);
    assert!(matches!(called, Err(ToolError::Enough(_))), "{called:?}");
}
