//! Laws of NC text, its packets and their sender.

use ads_cnc::limits::{NC_LINE_MAX, STREAM_PACKET_MAX};
use ads_cnc::streaming::*;

/// The expected lines without their ends, computed without the codec.
pub(crate) fn reference_lines(bytes: &[u8]) -> Vec<Vec<u8>> {
    let text: String = bytes.iter().map(|&byte| char::from(byte)).collect();
    let text = text.replace("\r\n", "\n").replace('\r', "\n");
    let mut lines: Vec<&str> = text.split('\n').collect();
    if lines.last() == Some(&"") {
        lines.pop();
    }
    lines.into_iter().map(|line| line.chars().map(|at| at as u8).collect()).collect()
}

fn ended(lines: &[Vec<u8>]) -> Vec<u8> {
    lines.iter().flat_map(|line| [line, &b"\r\n"[..]].concat()).collect()
}

pub(crate) fn reference_wire(bytes: &[u8]) -> Vec<u8> {
    ended(&reference_lines(bytes))
}

/// The line, the column and the kind of a fault.
pub(crate) type TextFault = (usize, usize, LineErrorKind);

pub(crate) fn fault_of(error: LineError) -> TextFault {
    (error.line() as usize, error.column() as usize, error.kind())
}

/// The expected first fault of a text, found byte by byte.
fn reference_fault(bytes: &[u8]) -> Option<TextFault> {
    let (mut line, mut column) = (1, 0);
    for (at, &byte) in bytes.iter().enumerate() {
        match byte {
            b'\n' if at > 0 && bytes[at - 1] == b'\r' => continue,
            b'\r' | b'\n' => (line, column) = (line + 1, 0),
            _ => column += 1,
        }
        let kind = match byte {
            _ if column > NC_LINE_MAX => {
                let more = bytes[at + 1..].iter().take_while(|byte| !b"\r\n".contains(byte));
                LineErrorKind::TooLong { length: (column + more.count()) as u32 }
            }
            0 => LineErrorKind::Nul,
            0x80.. => LineErrorKind::NotAscii { byte },
            _ => continue,
        };
        return Some((line, column, kind));
    }
    None
}

/// A fault that is added to the packets or the error of a text, to verify that the laws detect it.
#[derive(Clone, Copy)]
pub(crate) struct TextMutation {
    pub(crate) packets: fn(&mut Vec<Vec<u8>>),
    pub(crate) fault: fn(TextFault) -> Option<TextFault>,
}

impl TextMutation {
    pub(crate) const NONE: Self = Self { packets: |_| (), fault: Some };
}

pub(crate) fn packets(bytes: &[u8]) -> Vec<Vec<u8>> {
    let mut packets = NcText::new(bytes).expect("text that can be streamed").packets();
    let mut buf = [0xEE; STREAM_PACKET_MAX];
    std::iter::from_fn(|| packets.next_into(&mut buf).map(<[u8]>::to_vec)).collect()
}

/// Checks that the first fault of the bytes is detected. If they have no fault, checks and returns
/// the packets.
pub(crate) fn check_text(bytes: &[u8], mutation: TextMutation) -> Result<Vec<Vec<u8>>, TextFault> {
    let verdict = NcText::new(bytes).map(drop).map_err(fault_of);
    let found = verdict.err().and_then(mutation.fault);
    assert_eq!(found, reference_fault(bytes), "{bytes:x?}");
    verdict.map(|()| check_packets_bent(bytes, mutation))
}

/// Checks the packets of a text: together they are its lines with CR LF, each is at most as long as
/// permitted, and no packet has room for the first line of the next.
pub(crate) fn check_packets(bytes: &[u8]) {
    check_packets_bent(bytes, TextMutation::NONE);
}

fn check_packets_bent(bytes: &[u8], mutation: TextMutation) -> Vec<Vec<u8>> {
    let text = NcText::new(bytes).unwrap();
    let lines = reference_lines(bytes);
    let mut packets = packets(bytes);
    (mutation.packets)(&mut packets);
    let wire = packets.concat();
    assert_eq!(wire, ended(&lines), "all packets together");
    assert_eq!((text.wire_len(), text.line_count()), (wire.len(), lines.len()));
    assert_eq!(text.is_wire(), wire == bytes);
    assert!(text.lines().eq(lines));
    for packet in &packets {
        assert!((2..=STREAM_PACKET_MAX).contains(&packet.len()) && packet.ends_with(b"\r\n"));
    }
    for pair in packets.windows(2) {
        let next = pair[1].iter().position(|&byte| byte == b'\n').unwrap() + 1;
        assert!(pair[0].len() + next > STREAM_PACKET_MAX, "a line more would have fitted");
    }
    if text.is_wire() {
        let mut borrowed = text.packets();
        assert!(std::iter::from_fn(|| borrowed.next_borrowed()).eq(&packets), "zero-copy");
        assert!(borrowed.rest().is_empty());
    }
    packets
}

/// A fault that is added to a sender, to verify that the laws detect it.
#[derive(Clone, Copy)]
pub(crate) struct SenderMutation {
    /// Changes the acknowledgement.
    pub(crate) ack: fn(Ack) -> Ack,
    /// Changes the reported progress.
    pub(crate) sent: fn(Progress) -> Progress,
}

impl SenderMutation {
    pub(crate) const NONE: Self = Self { ack: |ack| ack, sent: |sent| sent };
}

/// A sender and its expected state. `new`, `packet` and `acknowledge` check the sender after the
/// call.
pub(crate) struct CheckedSender<'t> {
    sender: Sender<'t>,
    wire: Vec<u8>,
    packets: Vec<Vec<u8>>,
    sent: Progress,
    state: SenderState,
    busy_count: u32,
    mutation: SenderMutation,
}

impl<'t> CheckedSender<'t> {
    pub(crate) fn new(text: &'t [u8], mutation: SenderMutation) -> Self {
        let packets = packets(text);
        let state = if packets.is_empty() { SenderState::Done } else { SenderState::Ready };
        let sender = Sender::new(NcText::new(text).unwrap());
        let (wire, sent) = (packets.concat(), Progress::default());
        let checked = Self { sender, wire, packets, sent, state, busy_count: 0, mutation };
        checked.check();
        checked
    }

    /// Checks that the sender returns the expected packet: the same one until it is accepted, and
    /// none after a rejection or after the last packet. Returns the packet.
    pub(crate) fn packet(&mut self) -> Option<Vec<u8>> {
        let ended = matches!(self.state, SenderState::Stopped | SenderState::Done);
        let wanted = if ended { None } else { self.packets.get(self.sent.packets) };
        assert_eq!(self.sender.packet(), wanted.map(Vec::as_slice));
        let packet = wanted.cloned();
        if packet.is_some() {
            self.state = SenderState::InFlight;
        }
        self.check();
        packet
    }

    /// Checks that the sender accepts an acknowledgement exactly if a packet is in flight.
    pub(crate) fn acknowledge(&mut self, ack: Ack) {
        let out = self.state == SenderState::InFlight;
        let taken = self.sender.acknowledge((self.mutation.ack)(ack));
        assert_eq!(taken, if out { Ok(()) } else { Err(UnexpectedAck) });
        match ack {
            _ if !out => {}
            Ack::Rejected => self.state = SenderState::Stopped,
            Ack::Busy => {
                self.state = SenderState::Waiting;
                self.busy_count += 1;
            }
            Ack::Accepted => {
                let packet = &self.packets[self.sent.packets];
                self.sent.packets += 1;
                self.sent.lines += packet.iter().filter(|&&byte| byte == b'\n').count();
                self.sent.bytes += packet.len();
                self.busy_count = 0;
                let all = self.sent.packets == self.packets.len();
                self.state = if all { SenderState::Done } else { SenderState::Ready };
            }
        }
        self.check();
    }

    /// Checks the progress, the state, the count of busy acknowledgements, and the number of
    /// remaining bytes.
    fn check(&self) {
        let sender = &self.sender;
        let found = ((self.mutation.sent)(sender.sent()), sender.state(), sender.busy_count());
        assert_eq!(found, (self.sent, self.state, self.busy_count));
        assert_eq!(sender.left_bytes(), self.wire.len() - self.sent.bytes);
    }

    /// Checks that the remaining text is the text after the accepted packets.
    pub(crate) fn check_left(&self) {
        let left = reference_lines(self.sender.left());
        assert_eq!(self.sender.left_lines(), left.len());
        assert_eq!(ended(&left), self.wire[self.sent.bytes..]);
    }

    /// The bytes of the packets that were accepted.
    pub(crate) fn taken(&self) -> &[u8] {
        &self.wire[..self.sent.bytes]
    }
}

/// The expected fault for line ends: the first line that does not end in CR LF, found byte by byte.
pub(crate) fn missing_end(bytes: &[u8]) -> Option<TextFault> {
    let (mut line, mut column) = (1, 1);
    for (at, &byte) in bytes.iter().enumerate() {
        match byte {
            b'\r' if bytes.get(at + 1) != Some(&b'\n') => {
                return Some((line, column, LineErrorKind::BareCr));
            }
            b'\n' if at == 0 || bytes[at - 1] != b'\r' => {
                return Some((line, column, LineErrorKind::BareLf));
            }
            b'\n' => (line, column) = (line + 1, 1),
            b'\r' => {}
            _ => column += 1,
        }
    }
    (column > 1).then_some((line, column, LineErrorKind::NoLineEnd))
}
