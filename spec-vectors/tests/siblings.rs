//! A rejected vector differs from its sibling in what it is rejected for, and in nothing else.

use ads_cnc_vectors::{Context, Vector, vector, vectors};

/// A count and the item it adds.
const EDIT_MAX: usize = 8;

/// Bytes in the one place where two streams differ; 0 if one of them is the other, cut or continued.
fn edit(good: &[u8], bad: &[u8]) -> usize {
    let front = good.iter().zip(bad).take_while(|(one, other)| one == other).count();
    if front == good.len().min(bad.len()) {
        return 0;
    }
    let behind = good[front..].iter().rev().zip(bad[front..].iter().rev());
    good.len().max(bad.len()) - front - behind.take_while(|(one, other)| one == other).count()
}

#[test]
fn the_place_that_differs_is_found() {
    assert_eq!(edit(b"abcd", b"abcd"), 0);
    assert_eq!(edit(b"abcd", b"ab"), 0);
    assert_eq!(edit(b"ab", b"abcd"), 0);
    assert_eq!(edit(b"abcd", b"axcd"), 1);
    assert_eq!(edit(b"abcd", b"xbcy"), 4);
    assert_eq!(edit(b"abcd", b"abxxcd"), 2);
    assert_eq!(edit(b"aaaa", b"aab"), 2);
}

/// What a decoder is told. Which vector is answered or carried tells it nothing.
fn told(v: &Vector) -> Context {
    Context { request: None, carries: None, ..v.context.clone() }
}

#[test]
fn siblings_differ_in_one_place() {
    for v in vectors() {
        let Some(sibling) = v.sibling.as_deref().and_then(vector) else { continue };
        assert_eq!(told(v), told(sibling), "{} is told something else than {}", v.id, sibling.id);
        let differing = edit(&sibling.bytes(), &v.bytes());
        assert!(differing <= EDIT_MAX, "{}: {differing} bytes from {}", v.id, sibling.id);
    }
}
