//! Events of machines and streams, written by hand. The bodies document the meaning of the bytes.

use super::Seed;
use crate::bodies::frames;

pub(super) fn frames() -> Vec<Seed> {
    let (twelve, long, none) = (&b"twelve bytes"[..], &[7; 40][..], &[][..]);
    let whole = 0xFF;
    [
        ("one", frames::write(40, &[20], &[(twelve, whole, 0)])),
        (
            "three",
            frames::write(
                64,
                &[3, 40, 55],
                &[(none, whole, 0), (long, whole, 0), (twelve, whole, 0)],
            ),
        ),
        ("too-long", frames::write(39, &[70], &[(twelve, whole, 0), (long, whole, 0)])),
        ("length-one-less", frames::write(64, &[60], &[(twelve, whole, 0), (twelve, 2, 1)])),
        ("length-overflows", frames::write(255, &[4, 5], &[(long, 5, 0x80)])),
        ("reserved", frames::write(64, &[51], &[(twelve, whole, 0), (long, 1, 0x10)])),
        ("no-header", frames::write(64, &[51], &[(none, 2, 1)])),
        ("data-length", frames::write(64, &[], &[(none, whole, 0), (twelve, 26, 7)])),
        ("another-command", frames::write(64, &[37, 38], &[(twelve, 16, 1)])),
    ]
    .map(|(name, bytes)| (name.to_string(), bytes))
    .into()
}

/// Inputs of the target `streaming_sender`: lines, then events. 0 sends a packet, 3 gets the packet; 4, 12
/// and 28 acknowledge it as busy, accepted and rejected; 5 reads, 0xFE resets.
pub(super) fn senders() -> Vec<Seed> {
    let (short, long) = (0x28, 0xFC);
    [
        ("one-packet", vec![3, short, short + 1, short + 2, 0, 5]),
        ("wire", vec![2, short, short, 3, 0, 5, 3]),
        ("two-packets", vec![2, long, long + 3, 0, 5, 0, 5, 0]),
        ("later", vec![3, long, long + 1, short, 3, 4, 3, 3, 4, 0, 0, 5, 0, 0, 5]),
        ("refused", vec![2, long, short, 3, 28, 3, 0, 4]),
        ("nobody-waits", vec![4, long, long, long, long, 12, 3, 12, 3, 12, 3, 12, 12]),
        ("full", [&[7][..], &[long; 7], &[0; 12], &[5], &[0; 4], &[5]].concat()),
        ("reset", [&[4][..], &[long; 4], &[0, 0, 0, 0xFE, 0, 5]].concat()),
        ("another-writes", vec![1, short, 0xFF, 0, 5, 7, 0x0F, 5]),
    ]
    .map(|(name, bytes)| (name.to_string(), bytes))
    .into()
}

/// Inputs of the target `service_host`. 0x70 is 8 steps of the program, 0x72 and 0x7A are 8 steps of the
/// first and the second host. In a byte that ends with the bits of 5 or 6, a step of a host fails.
pub(super) fn worlds() -> Vec<Seed> {
    let turns = [0x70, 0x72, 0x7A].repeat(8);
    let failing =
        [0x70, 0x05, 0x12, 0x06, 0x12, 0x05, 0x0D, 0x1A, 0x0E, 0x1A, 0x32, 0x06].repeat(6);
    let chaos = [0x30, 0x72, 0x07, 0x20, 0x7A, 0x47, 0x32, 0x87, 0x8F, 0x06, 0x0E].repeat(3);
    let mut seeds = Vec::new();
    for what in 0..4 {
        let requests = [4, 0, 1, 2, 0];
        for (name, events) in [("fine", &turns), ("failing", &failing)] {
            seeds.push((format!("{name}-{what}"), [&[what], &requests[..], events].concat()));
        }
        let twice = [&[what | 4], &requests[..], &requests[..], &chaos];
        seeds.push((format!("chaos-{what}"), twice.concat()));
    }
    seeds
}

/// Inputs of the target `service_machines`. As the byte of a value, 0x0A is a state of 1, 0x03 a
/// UUID, and 0x1D a text.
pub(super) fn machines() -> Vec<Seed> {
    let found = [0, 0x0A, 0, 0x03, 0, 0x1D];
    let answer = [14, 1, 0x0D];
    let host = |events: &[&[u8]]| [&[0][..], &events.concat()].concat();
    let call = [1, 0, 1, 7, 0, 100, 1, 0x1D, 0, 0, 0];
    [
        ("host-answers", host(&[&found, &found, &answer, &found, &[9, 9, 9, 12]])),
        ("host-loses-one", host(&[&found, &found, &answer, &[0, 0x01, 12]])),
        ("host-finds-another", host(&[&found, &[0, 0x0A, 0, 0x0B, 12], &found])),
        ("host-fails", {
            let looks = [9, 11, 0, 0x0A, 0, 0x03, 0, 0x1D, 9, 11, 0, 0x01, 11, 0, 0x01, 0, 0x01];
            host(&[&found, &found, &answer, &found, &[11], &found, &looks, &[0, 0x03, 9]])
        }),
        ("host-no-answers", host(&[&found, &found, &[14, 0, 0x0D, 14, 1, 0xFE], &answer])),
        ("call", [&call[..], &[4, 0x01, 3, 4, 0x3A, 4, 0x15]].concat()),
        (
            "call-times-out",
            [&call[..], &[0xF4, 1, 0xF3, 0xF4, 1, 0xF3, 0xF4, 1, 0xF3, 0xF4, 1, 0xF3]].concat(),
        ),
        ("call-of-nothing", vec![1, 1, 0, 0, 0x1D]),
        (
            "call-wrong-values",
            [&call[..], &[4, 0x1D, 4, 0x2F, 1, 2, 3, 4, 5, 4, 0x0A, 4, 0xFE, 4, 0xF6]].concat(),
        ),
        ("variables", vec![2, 0, 0, 0x03, 1, 0x1D, 2, 0x0A, 3, 0x0A, 4, 0x15, 2, 0x0A, 0xFF]),
        ("variables-wrong", vec![2, 1, 0, 0xFE, 2, 0x1D, 3, 0x2F, 1, 0, 0, 0, 0, 4, 0xF6]),
    ]
    .map(|(name, bytes)| (name.to_string(), bytes))
    .into()
}
