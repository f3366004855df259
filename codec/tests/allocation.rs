//! What decoding and encoding allocate, counted by the allocator of this test binary.

mod common;

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

use ads_cnc::ads::FrameRef;
use ads_cnc::layout::Stream;
use ads_cnc::streaming::{Ack, Interface, NcText, Sender};
use common::{CALLS, Subject, each_sample};

/// Counts by thread, as tests run beside each other.
struct Counting;

thread_local! {
    static LIVE: Cell<usize> = const { Cell::new(0) };
    static PEAK: Cell<usize> = const { Cell::new(0) };
    static COUNT: Cell<usize> = const { Cell::new(0) };
}

// SAFETY: passes every call on to the system's allocator; the counters neither allocate nor are
// dropped.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        LIVE.set(LIVE.get().saturating_add(layout.size()));
        PEAK.set(PEAK.get().max(LIVE.get()));
        COUNT.set(COUNT.get() + 1);
        // SAFETY: the caller keeps the contract, which is the same.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, memory: *mut u8, layout: Layout) {
        // What another thread allocated is not taken off here.
        LIVE.set(LIVE.get().saturating_sub(layout.size()));
        // SAFETY: the caller keeps the contract, which is the same.
        unsafe { System.dealloc(memory, layout) }
    }
}

#[global_allocator]
static COUNTING: Counting = Counting;

/// The most bytes held at once while this runs, and how often it allocated.
fn measure(run: impl FnOnce()) -> (usize, usize) {
    let before = (LIVE.get(), COUNT.get());
    PEAK.set(before.0);
    run();
    (PEAK.get() - before.0, COUNT.get() - before.1)
}

/// The counters count: without this, the tests below could not fail.
#[test]
fn the_counters_count() {
    let held = measure(|| drop(std::hint::black_box(vec![0_u8; 1000])));
    assert_eq!(held, (1000, 1));
    let (grown, _) = measure(|| {
        let mut bytes = std::hint::black_box(vec![0_u8; 1000]);
        bytes.reserve_exact(1000);
    });
    assert_eq!(grown, 3000);
}

/// Numbers that four bytes on the wire can promise and no stream can hold.
const HOSTILE: [u32; 6] = [u32::MAX, 0x8000_0000, 0x7FFF_FFFF, 0x4000_0001, 0x0100_0000, 0xFFFF];

/// Every sample, and every sample with each four bytes of it replaced by each hostile number.
fn hostile() -> impl Iterator<Item = (Stream, Vec<u8>)> {
    each_sample().flat_map(|(stream, sample)| {
        let bytes = sample.bytes();
        let places = 0..bytes.len().saturating_sub(3);
        let changed = places.flat_map(move |at| {
            let bytes = sample.bytes();
            HOSTILE.map(|number| {
                let mut bytes = bytes.clone();
                bytes[at..at + 4].copy_from_slice(&number.to_le_bytes());
                (stream, bytes)
            })
        });
        changed.chain([(stream, bytes)])
    })
}

/// No count or length in the bytes makes an owned reading hold more than the bytes warrant.
#[cfg(feature = "alloc")]
#[test]
fn owned_readings_hold_no_more_than_the_input_warrants() {
    let check = |stream: Stream, bytes: &[u8]| {
        let decode = Subject::of(stream).owned.len;
        let (held, _) = measure(|| {
            let _ = std::hint::black_box(decode(bytes));
        });
        assert!(held <= 2 * bytes.len() + 4096, "{stream}: {held} for {}", bytes.len());
    };
    for (stream, bytes) in hostile() {
        check(stream, &bytes);
    }
    // Long ones, where a factor shows.
    let long = |head: &[u8], len: usize| {
        let mut bytes = head.to_vec();
        bytes.resize(len, 7);
        bytes
    };
    check(Stream::ObjectDescriptors, &long(&[], 84 * 1000));
    check(Stream::ReadReply, &long(&[0, 0, 0, 0, 0, 0, 16, 0], 0x10_0008));
    check(Stream::ReadWriteReply, &long(&[0, 0, 0, 0, 0, 0, 16, 0], 0x10_0008));
    check(Stream::WriteRequest, &long(&[1, 1, 1, 1, 1, 1, 1, 1, 0, 0, 16, 0], 0x10_000C));
    check(Stream::VariableValue, &long(&[], 2048));
    check(Stream::VariableHandleRead, &long(&[1, 1, 1, 1, 0xFE, 1, 0, 0], 2048));
    check(
        Stream::VariableDescription,
        &long(&[[1; 16].as_slice(), &[0xFA, 1, 0, 0]].concat(), 2048),
    );
}

/// Views, walks and encoders never allocate, whatever the bytes.
#[test]
fn views_walks_and_encoders_allocate_nothing() {
    for (stream, bytes) in hostile() {
        let view = Subject::of(stream).view;
        let mut buf = [0; 1024];
        let (_, count) = measure(|| {
            let _ = std::hint::black_box((view.encode)(&bytes, &mut buf));
            let _ = std::hint::black_box(stream.walk(&bytes, |_| ()));
        });
        assert_eq!(count, 0, "{stream}: {bytes:x?}");
    }
}

/// Nor do dispatch, the encoding of a request and the splitting of frames.
#[test]
fn dispatch_and_frames_allocate_nothing() {
    for sample in CALLS {
        let mut buf = [0; 1024];
        let (_, count) = measure(|| {
            let request = sample.call.dispatch().unwrap();
            std::hint::black_box(request.encode(&mut buf).unwrap());
        });
        assert_eq!(count, 0, "{}", sample.slug);
    }
    let hostile = [0, 0, 0xFF, 0xFF, 0xFF, 0xFF, 0, 0];
    let (_, count) = measure(|| {
        let _ = std::hint::black_box(FrameRef::split(&hostile, u32::MAX));
    });
    assert_eq!(count, 0);
}

/// Streaming allocates nothing: neither packets nor findings nor either end.
#[test]
fn streaming_allocates_nothing() {
    let jumps: String = (0..200).map(|n| format!("N{n}: X1\n$GOTO N{}\n", n / 2)).collect();
    for text in [jumps.clone(), jumps.replace('\n', "\r\n"), "$FOR\nM30\nX1".into()] {
        let (peak, count) = measure(|| {
            let text = NcText::new(text.as_bytes()).unwrap();
            assert!(text.findings().count() > 1);
            let (mut sender, mut interface) = (Sender::new(text), Interface::new());
            while let Some(packet) = sender.packet() {
                let ack = interface.write(packet);
                sender.acknowledge(ack).unwrap();
                if ack == Ack::Later {
                    interface.read().unwrap();
                }
            }
            assert_eq!(sender.left_bytes(), 0);
        });
        assert_eq!((peak, count), (0, 0));
    }
}

/// Names are taken apart and put together without allocating.
#[test]
fn names_allocate_nothing() {
    use ads_cnc::{Numbers, VariablePath};

    let (_, count) = measure(|| {
        let array = VariablePath::new("V.G.NP[0].Größe").unwrap();
        let mut buf = [0; 32];
        let element = array.write_element(Numbers::from(&[1, 20]), &mut buf).unwrap();
        assert_eq!(element.parts().map(|part| part.indices.len()).sum::<usize>(), 3);
    });
    assert_eq!(count, 0);
}

/// Values of all types are read, found and written without allocating; owned, they have their bytes.
#[test]
fn typed_values_hold_no_more_than_their_bytes() {
    use ads_cnc::value::{DataType, Elements, EncodeValue, StringsRef};
    use ads_cnc::{Element, Numbers};

    let bytes = [7; 2048];
    for data_type in DataType::ALL {
        let count = data_type.size().map_or(2048, |each| 2048 / each);
        let dimensions = [2, count / 2];
        let read = || Elements::new(data_type, Numbers::from(&dimensions), &bytes).unwrap();
        let (_, allocated) = measure(|| {
            let mut buf = [0; 2048];
            let elements = read();
            assert_eq!(elements.iter().next_back(), elements.element(Numbers::from(&[1, 3])).ok());
            assert!(elements.element(Numbers::from(&[2, 0])).is_err());
            assert_eq!(elements.encode_value(&mut buf), Ok(&bytes[..]));
            assert_eq!(elements.shape().encode(&elements, &mut buf), Ok(&bytes[..]));
            if let Some(Element::Sgn32(first)) = elements.get(0) {
                assert!(elements.items().unwrap().iter().all(|item: i32| item == first));
                assert_eq!([first; 3].encode_value(&mut buf), Ok(&bytes[..12]));
            }
            let _ = std::hint::black_box(StringsRef::new(&bytes, count).map(|s| s.iter().count()));
        });
        assert_eq!(allocated, 0, "{data_type:?}");
        #[cfg(feature = "alloc")]
        {
            let owned = || drop(std::hint::black_box(ads_cnc::value::Values::from(read())));
            // One-byte texts too: not an allocation each.
            assert_eq!(measure(owned), (2048, 1), "{data_type:?}");
        }
    }
}

/// Nor do the three that take part in the Service Interface.
#[test]
fn services_allocate_nothing() {
    use ads_cnc::CncStr;
    use ads_cnc::service::{Call, CallStep, Host, HostStep, Interface, ServiceId, SysServiceWait};

    let mut answered = false;
    let (_, count) = measure(|| {
        let ids = [ServiceId::new("560AACBF-6335-44a9-895A-8B27F3ED5E47").unwrap()];
        let (mut host, mut interface) = (Host::new(&ids), Interface::new());
        let (text, now) = (CncStr::new("3").unwrap(), std::time::Duration::ZERO);
        let mut call = Call::new(ids[0], text, SysServiceWait::default()).unwrap();
        for _ in 0..100 {
            match call.step() {
                CallStep::Read(variable) => call.read(interface.read(variable), now).unwrap(),
                CallStep::Write(variable, value) => {
                    interface.write(variable, value).unwrap();
                    call.written(now);
                }
                CallStep::Wait { .. } => call.poll(),
                CallStep::Done { response, .. } => answered = response == text,
                CallStep::TimedOut => {}
            }
            match host.step() {
                HostStep::Read(variable) => host.read(interface.read(variable)).unwrap(),
                HostStep::Write(variable, value) => {
                    interface.write(variable, value).unwrap();
                    host.written();
                }
                HostStep::Serve { .. } => host.answer(text, 1).unwrap(),
                HostStep::Wait => host.poll(),
            }
        }
    });
    assert_eq!((answered, count), (true, 0));
}
