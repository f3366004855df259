use std::io::{Read as _, Write as _};
use std::time::Instant;

use super::*;
use crate::gate::NET_ID;
use crate::simulator::Cnc;

/// A request for the number of V.E variables of channel 1.
const COUNT: &[u8] = &[
    0, 0, 52, 0, 0, 0, // AMS/TCP
    127, 0, 0, 1, 1, 1, 0x28, 2, 127, 0, 0, 1, 1, 2, 1, 0x80, 9, 0, 4, 0, 20, 0, 0, 0, 0, 0, 0, 0,
    7, 0, 0, 0, // AMS
    1, 0x23, 0x12, 0, 0x44, 0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, b'V', b'.', b'E', 0,
];
const ANSWER: &[u8] = &[
    0, 0, 44, 0, 0, 0, // AMS/TCP
    127, 0, 0, 1, 1, 2, 1, 0x80, 127, 0, 0, 1, 1, 1, 0x28, 2, 9, 0, 5, 0, 12, 0, 0, 0, 0, 0, 0, 0,
    7, 0, 0, 0, // AMS
    0, 0, 0, 0, 4, 0, 0, 0, 123, 0, 0, 0,
];

fn with_id(frame: &[u8], id: u8) -> Vec<u8> {
    let mut frame = frame.to_vec();
    frame[34] = id;
    frame
}

fn server() -> Server {
    serving(ServerOptions::default())
}

fn serving(options: ServerOptions) -> Server {
    let listener = net::listen("127.0.0.1:0".parse().unwrap()).unwrap();
    let cnc = Cnc::with_default_model().unwrap();
    Server::with_options(listener, Arc::new(cnc), options).unwrap()
}

fn idle(millis: u64) -> ServerOptions {
    ServerOptions { idle: Some(Duration::from_millis(millis)), ..ServerOptions::default() }
}

#[allow(clippy::disallowed_methods, reason = "to a server of the test")]
fn connect(addr: SocketAddr) -> io::Result<TcpStream> {
    TcpStream::connect_timeout(&addr, Duration::from_secs(5))
}

fn client(server: &Server) -> TcpStream {
    let stream = connect(server.addr()).unwrap();
    stream.set_nodelay(true).unwrap();
    stream.set_read_timeout(Some(Duration::from_secs(5))).unwrap();
    stream
}

fn expect(mut stream: &TcpStream, answer: &[u8]) {
    let mut received = vec![0; answer.len()];
    stream.read_exact(&mut received).unwrap();
    assert_eq!(received, answer);
}

fn works(mut stream: &TcpStream) {
    stream.write_all(COUNT).unwrap();
    expect(stream, ANSWER);
}

/// Checks that the server closes the connection. If the server did not read all bytes, the client
/// may see a reset instead of the end of the stream.
fn ends(mut stream: &TcpStream) {
    let mut rest = Vec::new();
    match stream.read_to_end(&mut rest) {
        Ok(_) => assert_eq!(rest, [0; 0]),
        Err(error) => {
            let ended = [io::ErrorKind::ConnectionReset, io::ErrorKind::ConnectionAborted];
            assert!(ended.contains(&error.kind()), "{error}");
        }
    }
}

#[test]
fn frames_may_arrive_in_any_pieces() {
    let server = server();
    for size in [1, 5, 6, 7, 37, 38, 39, 57] {
        let mut stream = client(&server);
        for piece in [COUNT, COUNT].concat().chunks(size) {
            stream.write_all(piece).unwrap();
            if size < 7 {
                thread::sleep(Duration::from_micros(200));
            }
        }
        expect(&stream, &[ANSWER, ANSWER].concat());
    }
}

#[test]
fn pipelined_requests_are_answered_in_order() {
    let server = server();
    let mut stream = client(&server);
    let ids = || 0..=255;
    stream.write_all(&ids().flat_map(|id| with_id(COUNT, id)).collect::<Vec<_>>()).unwrap();
    expect(&stream, &ids().flat_map(|id| with_id(ANSWER, id)).collect::<Vec<_>>());
}

/// An invalid frame does not prevent the replies to the requests that were received together with
/// it, before it.
#[test]
fn requests_before_a_malformed_frame_are_answered() {
    let cnc = Cnc::with_default_model().unwrap();
    let (mut received, mut answers) = (ReceiveBuffer::new(), Vec::<u8>::new());
    let bytes = [COUNT, COUNT, b"GET / HTTP/1.1\r\n\r\n and more than a header"].concat();
    received.room()[..bytes.len()].copy_from_slice(&bytes);
    let taken = received.take(bytes.len(), &cnc, NET_ID, |more| {
        answers.extend(more);
        Ok(())
    });
    assert!(taken.is_err());
    assert_eq!(answers, [ANSWER, ANSWER].concat());
}

#[test]
fn a_malformed_frame_only_ends_its_own_connection() {
    let server = server();
    let other = client(&server);
    works(&other);
    let changed = |at: usize, byte| {
        let mut frame = COUNT.to_vec();
        frame[at] = byte;
        frame
    };
    // The faults: reserved bytes that are not 0, a length shorter than a header, a length over the
    // limit, and inconsistent lengths.
    for frame in [changed(0, 1), changed(2, 31), changed(5, 1), changed(26, 19)] {
        let mut stream = client(&server);
        works(&stream);
        stream.write_all(&frame).unwrap();
        ends(&stream);
        works(&other);
    }
}

#[test]
fn the_server_survives_garbage() {
    let server = server();
    let mut state = 0x2545_F491_4F6C_DD1D_u64;
    for _ in 0..20 {
        let mut stream = client(&server);
        let garbage: Vec<u8> = std::iter::repeat_with(|| {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            state.to_le_bytes()[0]
        })
        .take(300)
        .collect();
        let _reset = stream.write_all(&garbage);
    }
    works(&client(&server));
}

#[test]
fn two_clients_do_not_wait_for_each_other() {
    let server = server();
    let (mut half, whole) = (client(&server), client(&server));
    half.write_all(&COUNT[..20]).unwrap();
    works(&whole);
    half.write_all(&COUNT[20..]).unwrap();
    expect(&half, ANSWER);
}

#[test]
fn connections_beyond_the_maximum_are_closed() {
    let server = server();
    let mut clients: Vec<_> = (0..CONNECTIONS_MAX).map(|_| client(&server)).collect();
    clients.iter().for_each(works);
    ends(&client(&server));
    // After a client has disconnected, another one can connect.
    clients.pop();
    let deadline = Instant::now() + Duration::from_secs(5);
    loop {
        let mut stream = client(&server);
        let mut first = [0; 1];
        if stream.write_all(COUNT).is_ok() && matches!(stream.read(&mut first), Ok(1)) {
            break;
        }
        assert!(Instant::now() < deadline, "no place became free");
        thread::sleep(Duration::from_millis(5));
    }
}

#[test]
fn dropping_the_server_ends_all_connections() {
    let server = server();
    let (idle, busy) = (client(&server), client(&server));
    works(&busy);
    let (addr, begun) = (server.addr(), Instant::now());
    drop(server);
    assert!(begun.elapsed() < Duration::from_secs(5));
    ends(&idle);
    ends(&busy);
    assert!(connect(addr).is_err());
}

#[test]
fn frames_up_to_the_maximum_length_are_accepted() {
    let server = server();
    let frame = |data: u32| {
        let mut frame = COUNT[..38].to_vec();
        frame[2..6].copy_from_slice(&(data + 32).to_le_bytes());
        frame[26..30].copy_from_slice(&data.to_le_bytes());
        frame.resize(38 + data as usize, 0);
        frame
    };
    let mut stream = client(&server);
    // The frames are sent together, in pieces that do not end where a frame ends.
    let longest = [frame(0x1_0000), frame(0x1_0000), COUNT.to_vec()].concat();
    for piece in longest.chunks(50_000) {
        stream.write_all(piece).unwrap();
    }
    // A write length that differs from the length of the data is rejected as a wrong size of the
    // request.
    let mut rejected = ANSWER[..46].to_vec();
    (rejected[2], rejected[26], rejected[42]) = (40, 8, 0);
    rejected[38..40].copy_from_slice(&[5, 7]);
    expect(&stream, &[&rejected[..], &rejected[..], ANSWER].concat());
    stream.write_all(&frame(0x1_0001)[..40]).unwrap();
    ends(&stream);
}

#[test]
fn other_commands_are_answered_in_order() {
    let server = server();
    let mut stream = client(&server);
    let command = |command: u8| {
        let mut frame = COUNT[..38].to_vec();
        (frame[2], frame[22], frame[26]) = (32, command, 0);
        frame
    };
    let answer = |command: u8, data: &[u8]| {
        let mut frame = ANSWER[..38].to_vec();
        let len = u8::try_from(data.len()).unwrap();
        (frame[2], frame[22], frame[26]) = (32 + len, command, len);
        [&frame, data].concat()
    };
    // The requests: ReadState, WriteControl, Read without its fields, and the number of variables.
    stream.write_all(&[command(4), command(5), command(2), COUNT.to_vec()].concat()).unwrap();
    let state = answer(4, &[0, 0, 0, 0, 5, 0, 0, 0]);
    let control = answer(5, &[1, 7, 0, 0]);
    let read = answer(2, &[5, 7, 0, 0, 0, 0, 0, 0]);
    expect(&stream, &[&state, &control, &read, ANSWER].concat());
}

#[test]
fn idle_connections_are_closed() {
    let server = serving(idle(300));
    let silent: Vec<_> = (0..CONNECTIONS_MAX).map(|_| client(&server)).collect();
    silent.iter().for_each(ends);
    works(&client(&server));
}

#[test]
fn single_bytes_do_not_extend_the_idle_limit() {
    let server = serving(idle(800));
    let (mut slow, begun) = (client(&server), Instant::now());
    let gone = COUNT.iter().any(|byte| {
        thread::sleep(Duration::from_millis(60));
        slow.write_all(&[*byte]).is_err() || begun.elapsed() > Duration::from_millis(3000)
    });
    assert!(gone);
    ends(&slow);
    // A client that sends requests is not idle, however long the connection lasts.
    let busy = client(&server);
    while begun.elapsed() < Duration::from_millis(4000) {
        works(&busy);
        thread::sleep(Duration::from_millis(30));
    }
}

fn hasty(millis: u64) -> ServerOptions {
    ServerOptions { frame: Some(Duration::from_millis(millis)), ..ServerOptions::default() }
}

/// The idle limit is ten minutes, so only the limit for the first frame can end the connection in
/// time.
#[test]
fn connections_without_a_first_request_are_closed() {
    let server = serving(hasty(500));
    let mut open: Vec<_> = (0..CONNECTIONS_MAX).map(|_| client(&server)).collect();
    for (count, stream) in open.iter_mut().enumerate() {
        let _gone = stream.write_all(&COUNT[..count % COUNT.len()]);
    }
    open.iter().for_each(ends);
    works(&client(&server));
}

#[test]
fn an_incomplete_frame_ends_its_connection() {
    let server = serving(hasty(1000));
    let mut half = client(&server);
    works(&half);
    // The next frame may begin later than the frame limit, but must then be complete within the
    // limit.
    thread::sleep(Duration::from_millis(1200));
    half.write_all(&COUNT[..50]).unwrap();
    // The same limit applies to the beginning of a frame in the same segment as a complete frame.
    let mut next = client(&server);
    next.write_all(&[COUNT, &COUNT[..1]].concat()).unwrap();
    expect(&next, ANSWER);
    ends(&half);
    ends(&next);
}

/// Further bytes do not extend the limit of a frame.
#[test]
fn single_bytes_do_not_extend_the_frame_limit() {
    let server = serving(hasty(1000));
    let (mut slow, begun) = (client(&server), Instant::now());
    works(&slow);
    let gone = COUNT.iter().any(|byte| {
        thread::sleep(Duration::from_millis(40));
        slow.write_all(&[*byte]).is_err() || begun.elapsed() > Duration::from_millis(3000)
    });
    assert!(gone);
    ends(&slow);
}

/// After its first request, a connection may be idle up to the idle limit.
#[test]
fn a_connection_may_be_idle_after_a_request() {
    let server = serving(hasty(1000));
    let stream = client(&server);
    works(&stream);
    thread::sleep(Duration::from_millis(1200));
    works(&stream);
}

#[test]
fn many_clients_are_served_at_once() {
    let server = server();
    thread::scope(|scope| {
        for of in 0..32_u8 {
            let mut stream = client(&server);
            scope.spawn(move || {
                for _ in 0..50 {
                    let batch: Vec<u8> = (0..8).flat_map(|at| with_id(COUNT, of ^ at)).collect();
                    stream.write_all(&batch).unwrap();
                    let wanted: Vec<u8> = (0..8).flat_map(|at| with_id(ANSWER, of ^ at)).collect();
                    expect(&stream, &wanted);
                }
            });
        }
    });
}

#[test]
fn the_server_answers_for_its_net_id() {
    let options = ServerOptions { net_id: AmsNetId([10, 0, 0, 1, 1, 1]), ..Default::default() };
    let server = serving(options);
    let mut stream = client(&server);
    stream.write_all(COUNT).unwrap();
    let mut answer = [0; 38];
    stream.read_exact(&mut answer).unwrap();
    assert_eq!(answer[30..34], [7, 0, 0, 0]);
    let mut named = COUNT.to_vec();
    named[6..12].copy_from_slice(&[10, 0, 0, 1, 1, 1]);
    stream.write_all(&named).unwrap();
    let mut answer = ANSWER.to_vec();
    answer[14..20].copy_from_slice(&[10, 0, 0, 1, 1, 1]);
    expect(&stream, &answer);
}
