use std::time::Instant;

use super::*;

/// How many V.E variables channel 1 has, as it goes over the wire but for the invoke ID.
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
    let listener = net::listen("127.0.0.1:0".parse().unwrap()).unwrap();
    Server::start(listener, Arc::new(Cnc::with_default_model().unwrap())).unwrap()
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

/// The server closes: an end, or a reset if bytes lay unread.
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
fn frames_come_in_any_pieces() {
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
fn pipelined_requests_are_answered_in_their_order() {
    let server = server();
    let mut stream = client(&server);
    let ids = || 0..=255;
    stream.write_all(&ids().flat_map(|id| with_id(COUNT, id)).collect::<Vec<_>>()).unwrap();
    expect(&stream, &ids().flat_map(|id| with_id(ANSWER, id)).collect::<Vec<_>>());
}

#[test]
fn a_malformed_frame_ends_its_own_connection_only() {
    let server = server();
    let other = client(&server);
    works(&other);
    let changed = |at: usize, byte| {
        let mut frame = COUNT.to_vec();
        frame[at] = byte;
        frame
    };
    // reserved, length under a header, length over the limit, lengths that disagree
    for frame in [changed(0, 1), changed(2, 31), changed(5, 1), changed(26, 19)] {
        let mut stream = client(&server);
        works(&stream);
        stream.write_all(&frame).unwrap();
        ends(&stream);
        works(&other);
    }
}

#[test]
fn garbage_is_no_end_of_the_server() {
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
fn one_connection_too_many_is_closed() {
    let server = server();
    let mut clients: Vec<_> = (0..CONNECTIONS_MAX).map(|_| client(&server)).collect();
    clients.iter().for_each(works);
    ends(&client(&server));
    // A place is free once a client has gone.
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
fn dropping_it_ends_all_connections() {
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
