//! Tests of frames, the sender and the host.

use super::*;

#[test]
fn frames_carry_calls() {
    let request = AdsCncRequest {
        function: number("ReadByName"),
        channel: 1,
        name: bytes("V.E.a"),
        ..zero()
    };
    let (call, data) = encode(&request, 64).unwrap();
    let call = AdsCncCall { data: AdsCncBytes::of(&data), ..call };
    let (mut payload, mut sent, mut length, mut used) = ([0; 64], [0; 128], 0, 0);
    let frame = |data: AdsCncBytes| AdsCncFrame {
        target: AdsCncAddress { net_id: [192, 0, 2, 7, 1, 1], port: 552 },
        source: AdsCncAddress { net_id: [192, 0, 2, 1, 1, 1], port: 0x8001 },
        command: 9,
        state_flags: 4,
        error: 0,
        invoke_id: 3,
        data,
    };
    // SAFETY: all pointers are valid.
    unsafe {
        assert!(ads_cnc_call_write(&call, payload.as_mut_ptr(), 64, &mut length, null_mut()));
        let it = frame(AdsCncBytes { data: payload.as_ptr(), length });
        assert!(ads_cnc_frame_write(&it, sent.as_mut_ptr(), 128, &mut length, null_mut()));
        assert_eq!(length, 38 + 16 + 6);
        let (mut read, mut got) = (zero::<AdsCncFrame>(), zero::<AdsCncCall>());
        for cut in 0..length {
            assert!(ads_cnc_frame_read(sent.as_ptr(), cut, 1000, &mut read, &mut used, null_mut()));
            assert_eq!(used, 0);
        }
        assert!(ads_cnc_frame_read(sent.as_ptr(), 128, 1000, &mut read, &mut used, null_mut()));
        assert_eq!((used, read.invoke_id, read.target.net_id), (length, 3, [192, 0, 2, 7, 1, 1]));
        assert!(ads_cnc_call_read(&read, &mut got, null_mut()));
        assert_eq!(
            (got.index_offset, got.read_length, got.data.get().unwrap_or_default()),
            (0x48, 2048, &data[..])
        );
        let mut error = zero();
        sent[0] = 1;
        assert!(!ads_cnc_frame_read(sent.as_ptr(), 128, 1000, &mut read, &mut used, &mut error));
        assert_eq!(
            text(&error),
            "ams-tcp-header: reserved at offset 0: mismatch, expected 0, found 1"
        );
        assert!(!ads_cnc_call_read(&AdsCncFrame { command: 1, ..read }, &mut got, &mut error));
        assert!(!ads_cnc_call_read(
            &AdsCncFrame { command: 0x1_0002, ..read },
            &mut got,
            &mut error
        ));
    }
}

#[test]
fn a_program_is_sent_in_packets() {
    let program = b"N10 G0 X0\nN20 M30";
    let (mut sender, mut progress, mut packet) =
        (zero::<AdsCncSender>(), zero::<AdsCncProgress>(), AdsCncBytes::NONE);
    // SAFETY: all pointers are valid.
    unsafe {
        // The memory is zero, so the sender is not started.
        assert!(
            !ads_cnc_sender_packet(&mut sender, &mut packet)
                && !ads_cnc_sender_acknowledge(&mut sender, 0)
        );
        assert!(!ads_cnc_sender_progress(&sender, &mut progress));
        assert!(ads_cnc_sender_start(&mut sender, program.as_ptr(), 17, null_mut()));
        assert!(!ads_cnc_sender_acknowledge(&mut sender, 0), "no packet is in flight");
        for acknowledgement in [1, 0] {
            // A sender has no pointer into itself, so it may be moved.
            let mut moved = core::ptr::read(&sender);
            assert!(ads_cnc_sender_packet(&mut moved, &mut packet));
            assert_eq!(packet.get().unwrap_or_default(), b"N10 G0 X0\r\nN20 M30\r\n");
            assert!(!ads_cnc_sender_acknowledge(&mut moved, 3));
            assert!(ads_cnc_sender_acknowledge(&mut moved, acknowledgement));
            sender = moved;
            assert!(ads_cnc_sender_progress(&sender, &mut progress));
            assert_eq!(
                (progress.state, progress.busy_count),
                if acknowledgement == 1 { (2, 1) } else { (4, 0) }
            );
        }
        assert_eq!(
            (progress.packets, progress.lines, progress.bytes, progress.left_lines),
            (1, 2, 20, 0)
        );
        assert!(!ads_cnc_sender_packet(&mut sender, &mut packet));
        assert_eq!([0, 0x705, 0x706].map(|result| ads_cnc_acknowledgement(result)), [0, 2, 1]);
        let mut error = zero();
        assert!(!ads_cnc_sender_start(&mut sender, b"N10\nN20 \xE4".as_ptr(), 9, &mut error));
        assert_eq!(
            text(&error),
            "nc-text: line at offset 5: a byte that is not ASCII, expected 2, found 228"
        );
    }
}

/// After a failed start, a machine does not use the data of an earlier start, which may be freed.
#[test]
fn a_failed_start_leaves_a_machine_not_started() {
    let (mut sender, mut host) = (zero::<AdsCncSender>(), zero::<AdsCncHost>());
    // SAFETY: all pointers are valid, or null.
    unsafe {
        for (text, length) in [(b"N20 \xE4".as_ptr(), 5), (null(), 1)] {
            let program = b"N10 G0 X0".to_vec();
            assert!(ads_cnc_sender_start(&mut sender, program.as_ptr(), 9, null_mut()));
            assert!(!ads_cnc_sender_start(&mut sender, text, length, null_mut()));
            drop(program);
            assert!(!ads_cnc_sender_packet(&mut sender, null_mut()));
            assert!(!ads_cnc_sender_progress(&sender, null_mut()));
        }
        assert!(ads_cnc_host_start(&mut host, null(), 0, null_mut()));
        assert!(!ads_cnc_host_start(&mut host, null(), 1, null_mut()));
        assert!(!ads_cnc_host_step(&host, null_mut()));
    }
}

#[test]
fn a_host_serves_a_request() {
    const UUID: &str = "560AACBF-6335-44a9-895A-8B27F3ED5E47";
    let (mut ids, mut host) = (
        [zero::<[u8; 36]>(); 2].map(|_| MaybeUninit::<AdsCncServiceId>::uninit()),
        zero::<AdsCncHost>(),
    );
    let (mut step, mut written, mut error) = (zero::<AdsCncHostStep>(), Vec::new(), zero());
    // SAFETY: all pointers are valid.
    unsafe {
        assert!(!ads_cnc_host_step(&host, &mut step) && !ads_cnc_host_event(&mut host, 2));
        let other = UUID.replace('5', "6");
        assert!(ads_cnc_service_id(other.as_ptr(), 36, ids[0].as_mut_ptr(), null_mut()));
        assert!(ads_cnc_service_id(UUID.as_ptr(), 36, ids[1].as_mut_ptr(), null_mut()));
        assert!(!ads_cnc_service_id(UUID.as_ptr(), 35, null_mut(), &mut error));
        assert_eq!(text(&error), "service: uuid at offset 0: truncated, expected 36, found 35");
        assert!(ads_cnc_host_start(&mut host, ids.as_ptr().cast(), 2, null_mut()));
        for _ in 0..30 {
            assert!(ads_cnc_host_step(&host, &mut step));
            let name = string(step.variable);
            match step.kind {
                1 => {
                    let value: &[u8] = match name.as_str() {
                        "V.G.SERVICE.UUID" => UUID.as_bytes(),
                        "V.G.SERVICE.REQUEST" => b"L\xE4nge\0",
                        _ => &[7, 0, 0, 0],
                    };
                    assert!(ads_cnc_host_read(
                        &mut host,
                        value.as_ptr(),
                        value.len() as u32,
                        null_mut()
                    ));
                }
                2 => {
                    written.push((name, step.data.get().unwrap_or_default().to_vec()));
                    assert!(ads_cnc_host_event(&mut host, 0));
                }
                3 => {
                    assert_eq!((step.service, step.request_state), (1, 7));
                    assert_eq!(step.data.get().unwrap_or_default(), b"L\xE4nge");
                    assert!(!ads_cnc_host_answer(&mut host, b"5".as_ptr(), 1, 0, &mut error));
                    assert!(ads_cnc_host_answer(&mut host, b"5".as_ptr(), 1, 1, null_mut()));
                }
                _ => break,
            }
        }
        assert_eq!(written.len(), 3);
        assert_eq!(written[0], ("V.G.SERVICE.RESPONSE".to_string(), b"5\0".to_vec()));
        assert_eq!(ads_cnc_host_outcome(&host), 1);
        assert!(ads_cnc_host_event(&mut host, 2) && !ads_cnc_host_event(&mut host, 4));
        assert!(!ads_cnc_host_read(&mut host, b"".as_ptr(), 0, &mut error));
    }
}

/// The data of a step is in the host, and a service may pass it back. Under Miri, this test detects
/// that the host is changed while the data is borrowed.
#[test]
fn a_host_accepts_its_own_data() {
    let id = *b"560AACBF-6335-44a9-895A-8B27F3ED5E47";
    let (mut host, mut step) = (zero::<AdsCncHost>(), zero::<AdsCncHostStep>());
    let host = &raw mut host;
    // SAFETY: all pointers are valid.
    unsafe {
        assert!(ads_cnc_host_start(host, id.as_ptr().cast(), 1, null_mut()));
        let values: [&[u8]; 6] = [&[7, 0, 0, 0], &id, b"echo\0", &[7, 0, 0, 0], &id, b"echo\0"];
        for value in values {
            assert!(ads_cnc_host_step(host, &mut step));
            assert!(ads_cnc_host_read(host, value.as_ptr(), value.len() as u32, null_mut()));
        }
        assert!(ads_cnc_host_step(host, &mut step) && step.kind == 3);
        assert!(ads_cnc_host_read(host, step.data.data, step.data.length, null_mut()));
        assert!(ads_cnc_host_step(host, &mut step) && step.kind == 3);
        assert!(ads_cnc_host_answer(host, step.data.data, step.data.length, 1, null_mut()));
        for value in [&[7, 0, 0, 0], &id[..], b"echo\0"] {
            assert!(ads_cnc_host_read(host, value.as_ptr(), value.len() as u32, null_mut()));
        }
        assert!(ads_cnc_host_step(host, &mut step) && step.kind == 2);
        assert_eq!(step.data.get().unwrap_or_default(), b"echo\0");
    }
}
