//! Tests with null pointers, impossible lengths and random numbers.

use super::*;

/// A null pointer is an error if its length is not 0 or the argument is required. A length that
/// exceeds the address space is an error, too.
#[test]
fn null_and_impossible_lengths_are_errors() {
    let (most, mut error) = (u32::MAX, zero::<AdsCncError>());
    // SAFETY: null is never read or written.
    unsafe {
        assert!(!ads_cnc_encode(null(), null_mut(), 0, null_mut(), &mut error));
        assert_eq!(error.kind, 32);
        let request = AdsCncRequest { name: AdsCncBytes { data: null(), length: 1 }, ..zero() };
        assert!(!ads_cnc_encode(&request, null_mut(), 0, null_mut(), null_mut()));
        let request = AdsCncRequest { channel: 1, indices_count: most, ..zero() };
        assert!(!ads_cnc_encode(&request, null_mut(), 0, null_mut(), null_mut()));
        // The request of CountObjects has no data, so it needs no buffer.
        assert!(ads_cnc_encode(
            &AdsCncRequest { channel: 1, ..zero() },
            null_mut(),
            0,
            null_mut(),
            null_mut()
        ));
        for request in [
            AdsCncRequest { channel: 1, by_index: 2, ..zero() },
            // Channels count from 1, and a list of objects is that of a channel or of a platform axis.
            AdsCncRequest { by_index: 1, ..zero() },
            AdsCncRequest { by_index: 1, axis: 1, ..zero() },
            AdsCncRequest { channel: 1, axis: 1, ..zero() },
        ] {
            assert!(!ads_cnc_encode(&request, null_mut(), 0, null_mut(), null_mut()));
        }
        assert!(!ads_cnc_decode(0, null(), most, null_mut(), most, null_mut(), null_mut()));
        assert!(!ads_cnc_decode(38, null(), 0, null_mut(), 0, null_mut(), &mut error));
        assert_eq!(error.kind, 34);
        let content = stream_number(Stream::Content);
        assert!(ads_cnc_decode(content, null(), 0, null_mut(), most, null_mut(), null_mut()));
        assert!(!ads_cnc_build(most, null(), 0, null_mut(), 0, null_mut(), null_mut()));
        assert!(!ads_cnc_build(0, null(), most, null_mut(), 0, null_mut(), null_mut()));
        assert!(!ads_cnc_dispatch(null(), null_mut(), 0, null_mut(), null_mut(), null_mut()));
        assert!(!ads_cnc_frame_write(null(), null_mut(), 0, null_mut(), null_mut()));
        assert!(!ads_cnc_frame_read(null(), most, 0, null_mut(), null_mut(), null_mut()));
        assert!(!ads_cnc_call_write(null(), null_mut(), 0, null_mut(), null_mut()));
        assert!(!ads_cnc_call_read(null(), null_mut(), null_mut()));
        assert!(!ads_cnc_sender_start(null_mut(), null(), 0, null_mut()));
        assert!(
            !ads_cnc_sender_packet(null_mut(), null_mut())
                && !ads_cnc_sender_progress(null(), null_mut())
        );
        assert!(
            !ads_cnc_host_start(null_mut(), null(), 0, null_mut())
                && !ads_cnc_host_step(null(), null_mut())
        );
        assert_eq!((ads_cnc_host_outcome(null()), ads_cnc_function(null(), 1)), (0, ADS_CNC_NONE));
        assert_eq!(
            (ads_cnc_stream(null(), most), ads_cnc_field(0, null(), 1)),
            (ADS_CNC_NONE, ADS_CNC_NONE)
        );
        assert_eq!(ads_cnc_field(most, b"id".as_ptr(), 2), ADS_CNC_NONE);
        assert!(!ads_cnc_stream_info(38, null_mut()) && !ads_cnc_type(12, null_mut()));
        assert!(
            !ads_cnc_field_info(0, most, null_mut()) && !ads_cnc_field_info(most, 0, null_mut())
        );
    }
}

/// Random numbers in requests, calls and parts cause a result or an error. Under Miri, this test
/// detects undefined behaviour.
#[test]
fn random_numbers_are_answered() {
    let mut seed = 0x9E37_79B9_u32;
    let mut next = || {
        seed ^= seed << 13;
        seed ^= seed >> 17;
        seed ^= seed << 5;
        let near = [0, 1, 2, 7, 29, 30, 255, 256, 0x12_2301, 0x12_0101, 0x13_0101, u32::MAX];
        if seed & 1 == 0 { near[(seed >> 8) as usize % near.len()] } else { seed >> (seed % 31) }
    };
    let data: Vec<u8> = (0..80).collect();
    let rounds = if cfg!(miri) { 100 } else { 20_000 };
    let (mut encoded, mut indices) = (0, [0; 4]);
    for _ in 0..rounds {
        let request = AdsCncRequest {
            function: next() % 32,
            channel: next(),
            by_index: next() % 3,
            axis: next(),
            index: next(),
            count: next(),
            size: next(),
            handle: next(),
            index_group: next(),
            index_offset: next(),
            kind: bytes(["", "P", "V.E", "decoder", "\u{e4}"][next() as usize % 5]),
            name: bytes(["", "V.E.a", "a\0b"][next() as usize % 3]),
            value: AdsCncBytes::of(&data[..next() as usize % 80]),
            indices: indices.as_ptr(),
            indices_count: next() % 5,
        };
        encoded += u32::from(encode(&request, next() % 200).is_ok());
        let call = AdsCncCall {
            port: [551, 552, 553, next()][next() as usize % 4],
            command: [2, 3, 9, next()][next() as usize % 4],
            index_group: next(),
            index_offset: next(),
            read_length: next(),
            data: request.value,
        };
        let _answer = dispatch(&call, &mut indices);
        let _fields = decode(next() % 40, &data[..next() as usize % 80]);
        let parts = [0; 3].map(|_| AdsCncPart {
            field: next() % 10,
            number: next(),
            data: if next() & 1 == 0 { AdsCncBytes::NONE } else { request.name },
        });
        let _built = build(next() % 40, &parts[..next() as usize % 4], next() as usize % 200);
    }
    assert!(encoded > rounds / 20, "{encoded}");
}
