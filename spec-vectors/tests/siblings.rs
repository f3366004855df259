//! A rejected vector and its sibling have the same context for a decoder, and differ in one part of
//! at most eight bytes, or one of them begins with the other.

use ads_cnc_vectors::{Context, Vector, vector, vectors};

/// The maximum number of differing bytes: a count and an additional item, of four bytes each.
const EDIT_MAX: usize = 8;

/// The length of the part in which two streams differ; 0 if one of them begins with the other.
fn edit(good: &[u8], bad: &[u8]) -> usize {
    let front = good.iter().zip(bad).take_while(|(one, other)| one == other).count();
    if front == good.len().min(bad.len()) {
        return 0;
    }
    let back = good[front..].iter().rev().zip(bad[front..].iter().rev());
    good.len().max(bad.len()) - front - back.take_while(|(one, other)| one == other).count()
}

#[test]
fn edit_measures_the_differing_part() {
    assert_eq!(edit(b"abcd", b"abcd"), 0);
    assert_eq!(edit(b"abcd", b"ab"), 0);
    assert_eq!(edit(b"ab", b"abcd"), 0);
    assert_eq!(edit(b"abcd", b"axcd"), 1);
    assert_eq!(edit(b"abcd", b"xbcy"), 4);
    assert_eq!(edit(b"abcd", b"abxxcd"), 2);
    assert_eq!(edit(b"aaaa", b"aab"), 2);
}

/// The context that a decoder uses: without the references to other vectors.
fn decoder_context(v: &Vector) -> Context {
    Context { request: None, carries: None, ..v.context.clone() }
}

#[test]
fn siblings_differ_in_one_part() {
    for v in vectors() {
        let Some(sibling) = v.sibling.as_deref().and_then(vector) else { continue };
        assert_eq!(decoder_context(v), decoder_context(sibling), "{} and {}", v.id, sibling.id);
        let differing = edit(&sibling.bytes(), &v.bytes());
        assert!(differing <= EDIT_MAX, "{}: {differing} bytes from {}", v.id, sibling.id);
    }
}
