//! Checks that every explanation must pass, whatever the explained bytes are. The fuzz targets use these
//! checks too.

use ads_cnc_conformance::explain::{
    ExplainedStream, Explanation, ExplanationOutcome, parse_hex, print,
};

/// Checks that the rows and the unread bytes of a part cover all bytes of the part, in order and without
/// gaps.
fn check_part(part: &ExplainedStream, bytes: &[u8]) {
    let given = &bytes[part.at..part.at + part.length];
    let mut end = 0;
    for row in &part.rows {
        assert_eq!(row.offset, end, "{part:?}");
        assert_eq!(parse_hex(&row.hex).unwrap(), given[end..end + row.length]);
        end += row.length;
    }
    if let Some(unread) = &part.unread {
        assert_eq!((unread.offset, unread.length), (end, part.length - end), "{part:?}");
        assert_eq!(parse_hex(&unread.hex).unwrap(), given[end..]);
        assert!(!part.faults.is_empty(), "not read without a reason: {part:?}");
        end = part.length;
    }
    assert_eq!(end, part.length, "{part:?}");
    for fault in &part.faults {
        assert!(fault.offset <= part.length, "{part:?}");
    }
}

/// Checks that the parts cover every byte, and only once unless the bytes contain an error.
fn check_whole(explanation: &Explanation, bytes: &[u8]) {
    let mut shown = vec![0; bytes.len()];
    for part in &explanation.parts {
        // The bytes of a row that is explained by a separate part are counted only in that part.
        let rows = part.rows.iter().filter(|row| !row.below).map(|row| (row.offset, row.length));
        let unread = part.unread.iter().map(|unread| (unread.offset, unread.length));
        for (offset, length) in rows.chain(unread) {
            let begin = part.at + offset;
            shown[begin..begin + length].iter_mut().for_each(|times| *times += 1);
        }
    }
    let right = |times: &i32| match explanation.outcome {
        ExplanationOutcome::Faulty => *times >= 1,
        _ => *times == 1,
    };
    assert!(shown.iter().all(right), "{shown:?} of {explanation:#?}");
}

/// Checks that the printed text contains no control characters except line ends, because a terminal
/// would interpret them.
pub(crate) fn check_printed(printed: &[u8]) {
    let controls = |byte: &&u8| byte.is_ascii_control() && **byte != b'\n';
    assert_eq!(printed.iter().find(controls), None);
    let printed = std::str::from_utf8(printed).unwrap();
    assert!(!printed.chars().any(|one| one.is_control() && one != '\n'));
}

/// Checks an explanation, and that it can be printed.
pub(crate) fn check_explanation(explanation: &Explanation, bytes: &[u8]) {
    assert_eq!(explanation.length, bytes.len());
    for part in &explanation.parts {
        check_part(part, bytes);
    }
    check_whole(explanation, bytes);
    let faulty = explanation.parts.iter().any(|part| !part.faults.is_empty());
    assert_eq!(explanation.outcome == ExplanationOutcome::Faulty, faulty);
    print(explanation, true, &mut Vec::new()).unwrap();
}

/// The explanation as printed text.
pub(crate) fn printed(explanation: &Explanation) -> Vec<u8> {
    let mut plain = Vec::new();
    print(explanation, false, &mut plain).unwrap();
    plain
}
