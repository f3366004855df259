//! Tests with the golden sequences of NC text: packets, errors and diagnostics.

use ads_cnc::limits::STREAM_PACKET_MAX;
#[cfg(feature = "alloc")]
use ads_cnc::streaming::DiagnosticKind;
use ads_cnc::streaming::{Ack, LineErrorKind, NcText, Sender};
#[cfg(feature = "alloc")]
use ads_cnc_vectors::SequenceReject;
use ads_cnc_vectors::{Pieces, Sequence, SequenceExpect, SequenceInput, sequences};

/// The golden sequences of a kind. Fails if there are fewer than `least`.
fn cases(kind: &str, least: usize) -> Vec<&'static Sequence> {
    let found: Vec<_> = sequences().iter().filter(|case| case.kind() == kind).collect();
    assert!(found.len() >= least, "{} of {kind}", found.len());
    found
}

#[test]
fn texts_become_packets() {
    for case in cases("nc-text", 30) {
        let SequenceInput::NcText(given) = &case.given else { unreachable!() };
        let bytes = given.bytes();
        match (NcText::new(&bytes), &case.expect) {
            (Ok(text), SequenceExpect::Accept(accept)) => {
                let packets = accept.packets.as_deref().expect("a text has packets");
                let stated: Vec<Vec<u8>> = packets.iter().map(Pieces::bytes).collect();
                assert_eq!(made(text), stated, "{}", case.id);
                assert_eq!(sent(text), stated, "{}: by a sender", case.id);
            }
            (Err(error), SequenceExpect::Reject(reject)) => {
                let class = match error.kind() {
                    LineErrorKind::TooLong { .. } => "too-long",
                    LineErrorKind::NotAscii { .. } => "not-ascii",
                    LineErrorKind::Nul => "nul",
                    other => panic!("{}: {other:?}", case.id),
                };
                let found = (class, Some(error.line()), Some(error.column()));
                assert_eq!(found, (&*reject.class, reject.line, reject.column), "{}", case.id);
            }
            (text, _) => panic!("{}: {text:?}", case.id),
        }
    }
}

fn made(text: NcText<'_>) -> Vec<Vec<u8>> {
    let mut packets = text.packets();
    let mut buf = [0; STREAM_PACKET_MAX];
    std::iter::from_fn(|| packets.next_into(&mut buf).map(<[u8]>::to_vec)).collect()
}

fn sent(text: NcText<'_>) -> Vec<Vec<u8>> {
    let mut sender = Sender::new(text);
    let next = || {
        let packet = sender.packet()?.to_vec();
        sender.acknowledge(Ack::Accepted).ok()?;
        Some(packet)
    };
    std::iter::from_fn(next).collect()
}

#[cfg(feature = "alloc")]
#[test]
fn programs_are_checked() {
    for case in cases("nc-check", 50) {
        let SequenceInput::NcCheck(packets) = &case.given else { unreachable!() };
        let bytes: Vec<u8> = packets.iter().flat_map(Pieces::bytes).collect();
        let text = NcText::new(&bytes).unwrap_or_else(|error| panic!("{}: {error}", case.id));
        assert!(text.is_wire(), "{}", case.id);
        let found: Vec<SequenceReject> = text
            .diagnostics()
            .map(|finding| {
                let (class, refers_to) = match finding.kind {
                    DiagnosticKind::Loop(_) => ("loop", None),
                    DiagnosticKind::BackwardJump { to } => ("backward-jump", Some(to)),
                    DiagnosticKind::AfterEnd { of, .. } => ("after-end", Some(of)),
                    DiagnosticKind::OpenComment => ("open-comment", None),
                    other => panic!("{}: {other:?}", case.id),
                };
                SequenceReject {
                    class: class.to_owned(),
                    clause: Some(finding.kind.clause().to_owned()),
                    line: Some(finding.line),
                    column: Some(finding.column),
                    refers_to,
                    step: None,
                }
            })
            .collect();
        let stated = match &case.expect {
            SequenceExpect::Accept(_) => Vec::new(),
            SequenceExpect::Reject(reject) => vec![reject.clone()],
        };
        assert_eq!(found, stated, "{}", case.id);
    }
}
