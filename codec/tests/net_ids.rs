//! Tests of NetIds as text.

use ads_cnc::ErrorKind::*;
use ads_cnc::ads::AmsNetId;

use super::common::{Fault, fault};

/// Every byte at every position of a NetId is displayed as a number and parsed from it, also with
/// leading zeros.
#[test]
fn displayed_net_ids_are_parsed() {
    for place in 0..6 {
        for byte in 0..=u8::MAX {
            let mut id = AmsNetId([1, 20, 255, 0, 100, 9]);
            id.0[place] = byte;
            assert_eq!(id.to_string().parse(), Ok(id));
            let padded = id.0.map(|number| format!("{number:03}")).join(".");
            assert_eq!(padded.parse(), Ok(id), "{padded}");
        }
    }
}

/// An invalid text is rejected. The offset in the error is that of the wrong number, or 0 if the
/// count of numbers is wrong.
#[test]
fn invalid_net_ids_are_rejected() {
    for (text, wanted) in [
        ("", fault(Digits, "number", 0, (3, 0))),
        ("1..3.4.5.6", fault(Digits, "number", 2, (3, 0))),
        ("1.2.3.4.5.", fault(Digits, "number", 10, (3, 0))),
        ("1.2.3.0004.5.6", fault(Digits, "number", 6, (3, 4))),
        ("1.2.3.4.5", fault(Mismatch, "numbers", 0, (6, 5))),
        ("1.2.3.4.5.6.7", fault(Mismatch, "numbers", 0, (6, 7))),
        ("1.2.3.4.5.6.", fault(Mismatch, "numbers", 0, (6, 7))),
        ("1.2.3.4.5.6..x", fault(Mismatch, "numbers", 0, (6, 8))),
        ("1.256.3.4.5.6", fault(OutOfRange, "number", 2, (255, 256))),
        ("1.2.3.4.5.999", fault(OutOfRange, "number", 10, (255, 999))),
        ("+1.2.3.4.5.6", fault(NotDecimal, "number", 0, (0, '+' as usize))),
        ("1.2.3.4.5.6 ", fault(NotDecimal, "number", 10, (0, ' ' as usize))),
        ("1.2.٣.4.5.6", fault(NotDecimal, "number", 4, (0, '٣' as usize))),
        ("1,2.3.4.5.6", fault(NotDecimal, "number", 0, (0, ',' as usize))),
    ] {
        assert_eq!(text.parse::<AmsNetId>().map_err(Fault::of), Err(wanted), "{text:?}");
    }
}
