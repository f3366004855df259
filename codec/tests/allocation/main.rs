//! Tests of the allocations of the codec, which the allocator of this test binary counts.

#[path = "../common/mod.rs"]
mod common;
mod counting;
#[path = "../everything/mod.rs"]
mod everything;
mod inputs;
#[cfg(feature = "alloc")]
mod owned;

use std::hint::black_box;

use ads_cnc::ads::{AmsPort, FrameRef};
use ads_cnc::layout::Stream;
use ads_cnc::limits::STREAM_PACKET_MAX;
use ads_cnc::operation::{AdsService, Call};
use ads_cnc::streaming::{Ack, NcText, Sender, check_line_ends};
use ads_cnc::{Decode as _, Encode as _, Error, HandleReadRef};
use common::{CALLS, Subject};
use counting::{allocations, measure};
use inputs::{each_input, each_vector};

/// A decoder that returns the encoded length of the decoded value.
type Decoder = fn(&[u8]) -> Result<usize, Error>;

/// The number of bytes by which the peak memory of decoding exceeds twice the length of the input
/// plus 4 KiB, or 0.
fn excess(decode: Decoder, bytes: &[u8]) -> usize {
    let (held, _) = measure(|| {
        let _ = black_box(decode(bytes));
    });
    held.saturating_sub(2 * bytes.len() + 4096)
}

fn start(bytes: &[u8]) -> &[u8] {
    &bytes[..bytes.len().min(64)]
}

/// `excess` detects a decoder that allocates memory for a wrong count, and a decoder that copies
/// the input three times.
#[test]
fn decoders_that_allocate_too_much_are_detected() {
    let believes: Decoder = |bytes| {
        let count =
            bytes.get(4..8).map_or(0, |count| u32::from_le_bytes(count.try_into().unwrap()));
        let indices = black_box(Vec::<u32>::with_capacity(count.min(0x1_0000) as usize));
        HandleReadRef::decode(bytes).map(|request| request.encoded_len() + indices.len())
    };
    let copies: Decoder = |bytes| {
        let held = black_box([bytes.to_vec(), bytes.to_vec(), bytes.to_vec()]);
        Ok(held[0].len())
    };
    let mut found = (false, false);
    each_input(|stream, bytes| match stream {
        Stream::VariableHandleRead => found.0 |= excess(believes, bytes) > 0,
        Stream::ReadReply => found.1 |= excess(copies, bytes) > 0,
        _ => {}
    });
    assert_eq!(found, (true, true));
}

#[test]
fn views_walks_and_encoders_allocate_nothing() {
    let mut buf = vec![0; 0x41_0000];
    each_input(|stream, bytes| {
        let view = Subject::of(stream).view;
        let count = allocations(|| {
            let _ = black_box((view.len)(bytes));
            let _ = black_box((view.encode)(bytes, &mut buf));
            let _ = black_box((view.encode)(bytes, &mut []));
            let _ = black_box(stream.walk(bytes, |_| ()));
        });
        assert_eq!(count, 0, "{stream}: {:x?}", start(bytes));
    });
}

/// The code of the no-panic proof (`everything`) allocates nothing with any vector of at most 4096
/// bytes as input. This code calls the public functions that exist without features; the script
/// `proofs/reached.py` compares the code with the list of the public API.
#[test]
fn borrowing_functions_allocate_nothing() {
    for (stream, bytes) in each_vector().filter(|(_, bytes)| bytes.len() <= 4096) {
        let count = allocations(|| {
            black_box(everything::runs(&bytes));
        });
        assert_eq!(count, 0, "{stream}: {:x?}", start(&bytes));
    }
}

/// Dispatch, requests and replies allocate nothing, for every sample of a call: with the data of
/// the sample, and with every vector of at most 4096 bytes as data, with and without its last byte.
#[test]
fn dispatch_and_replies_allocate_nothing() {
    let vectors: Vec<_> = each_vector().filter(|(_, bytes)| bytes.len() <= 4096).collect();
    let (mut dispatched, mut answered) = (0, 0);
    for sample in CALLS {
        let own = sample.call.dispatch().unwrap();
        let mut buf = [0; 4096];
        for (_, bytes) in &vectors {
            let less = &bytes[..bytes.len().saturating_sub(1)];
            for data in [sample.call.data, bytes, less] {
                let count = allocations(|| {
                    if let Ok(request) = black_box(Call { data, ..sample.call }.dispatch()) {
                        black_box(request.encode(&mut buf).unwrap());
                        dispatched += 1;
                    }
                    if let Ok(reply) = black_box(own.decode_reply(data)) {
                        black_box(reply.encode(&mut buf).unwrap());
                        answered += 1;
                    }
                });
                assert_eq!(count, 0, "{}: {:x?}", sample.slug, start(data));
            }
        }
    }
    assert!(dispatched > CALLS.len() && answered > CALLS.len());
}

#[test]
fn dispatch_errors_allocate_nothing() {
    for sample in CALLS {
        let count = allocations(|| {
            for port in [0, 551, 552, 553, 851] {
                for service in [AdsService::Read, AdsService::Write, AdsService::ReadWrite] {
                    let _ =
                        black_box(Call { port: AmsPort(port), service, ..sample.call }.dispatch());
                }
            }
        });
        assert_eq!(count, 0, "{}", sample.slug);
    }
}

/// Splitting frames allocates nothing, even if a length in the header is wrong.
#[test]
fn frames_allocate_nothing() {
    let data = [0; 64];
    let mut frame = [0; 38 + 64];
    frame[2..6].copy_from_slice(&96_u32.to_le_bytes());
    frame[26..30].copy_from_slice(&64_u32.to_le_bytes());
    assert_eq!(FrameRef::split(&frame, 64).unwrap().unwrap().0.data(), data);
    for at in 0..frame.len() - 4 {
        for number in [0, 63, 64, 65, 96, 97, 0x40_0000, u32::MAX] {
            let mut lie = frame;
            lie[at..at + 4].copy_from_slice(&u32::to_le_bytes(number));
            let count = allocations(|| {
                if let Ok(Some((frame, _))) = black_box(FrameRef::split(&lie, u32::MAX)) {
                    let _ = black_box(frame.encode(&mut [0; 128]));
                }
            });
            assert_eq!(count, 0, "{number:#x} at {at}");
        }
    }
}

/// Texts, packets, the sender and the check of line ends allocate nothing.
#[test]
fn streaming_allocates_nothing() {
    let jumps: String = (0..200).map(|n| format!("N{n}: X1\n$GOTO N{}\n", n / 2)).collect();
    let rejected = format!("X1\n{}", "Y".repeat(991));
    let count = allocations(|| assert!(NcText::new(rejected.as_bytes()).is_err()));
    assert_eq!(count, 0);
    for text in [jumps.clone(), jumps.replace('\n', "\r\n"), "$FOR\nM30\nX1".into()] {
        let (peak, count) = measure(|| {
            let text = NcText::new(text.as_bytes()).unwrap();
            assert_eq!(text.lines().count(), text.line_count());
            let (mut packets, mut buf) = (text.packets(), [0; STREAM_PACKET_MAX]);
            while packets.next_into(&mut buf).is_some() {}
            let mut packets = text.packets();
            while packets.next_borrowed().is_some() {}
            let mut sender = Sender::new(text);
            for ack in [Ack::Busy, Ack::Accepted].into_iter().cycle() {
                let Some(packet) = sender.packet() else { break };
                check_line_ends(packet).unwrap();
                sender.acknowledge(ack).unwrap();
            }
            assert_eq!(sender.left_bytes(), 0);
        });
        assert_eq!((peak, count), (0, 0));
    }
}

#[test]
fn names_allocate_nothing() {
    use ads_cnc::{U32List, VariablePath};

    let (_, count) = measure(|| {
        let array = VariablePath::new("V.G.NP[0].Größe").unwrap();
        let mut buf = [0; 32];
        let element = array.write_element(U32List::from(&[1, 20]), &mut buf).unwrap();
        assert_eq!(element.parts().map(|part| part.indices.len()).sum::<usize>(), 3);
    });
    assert_eq!(count, 0);
}

/// Values of all types are decoded and encoded without allocating; `to_vec` allocates only the
/// items, and nothing if it rejects the type.
#[test]
fn typed_values_hold_no_more_than_their_bytes() {
    use ads_cnc::value::{DataType, Elements, EncodeValue};
    use ads_cnc::{Element, U32List};

    let bytes = [7; 2048];
    for data_type in DataType::ALL {
        let count = data_type.size().map_or(2048, |each| 2048 / each);
        let dimensions = [2, count / 2];
        let read = || Elements::new(data_type, U32List::from(&dimensions), &bytes).unwrap();
        let (_, allocated) = measure(|| {
            let mut buf = [0; 2048];
            let elements = read();
            assert_eq!(elements.iter().next_back(), elements.element(U32List::from(&[1, 3])).ok());
            assert!(elements.element(U32List::from(&[2, 0])).is_err());
            assert_eq!(elements.encode_value(&mut buf), Ok(&bytes[..]));
            assert_eq!(elements.shape().encode(&elements, &mut buf), Ok(&bytes[..]));
            if let Ok(Element::Sgn32(first)) = elements.get(0) {
                assert!(elements.items().unwrap().all(|item: i32| item == first));
                assert_eq!([first; 3].encode_value(&mut buf), Ok(&bytes[..12]));
            }
        });
        assert_eq!(allocated, 0, "{data_type:?}");
        #[cfg(feature = "alloc")]
        {
            let wanted = if data_type == DataType::Sgn32 { (2048, 1) } else { (0, 0) };
            assert_eq!(
                measure(|| drop(black_box(read().to_vec::<i32>()))),
                wanted,
                "{data_type:?}"
            );
        }
    }
}

#[test]
fn services_allocate_nothing() {
    use ads_cnc::CncStr;
    use ads_cnc::service::{Host, HostStep, ServiceId, ServiceVariable::*};

    const ID: &str = "560AACBF-6335-44a9-895A-8B27F3ED5E47";
    let mut answered = false;
    let (_, count) = measure(|| {
        let ids = [ServiceId::new(ID).unwrap()];
        let (mut host, text) = (Host::new(&ids), CncStr::new("3").unwrap());
        while !answered {
            match host.step() {
                HostStep::Read(Uuid) => host.read(ID.as_bytes()).unwrap(),
                HostStep::Read(Request) => host.read(b"3\0").unwrap(),
                HostStep::Read(_) => host.read(&[1, 0, 0, 0]).unwrap(),
                HostStep::Write(variable, _) => {
                    answered = variable == ResponseState;
                    host.written();
                }
                HostStep::Serve { .. } => host.answer(text, 1).unwrap(),
                HostStep::Wait => host.poll(),
            }
        }
    });
    assert_eq!(count, 0);
}
