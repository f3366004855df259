//! A test of `src/errata.md`, the page on the errata of the manuals.

#[test]
fn the_page_contains_every_erratum_of_the_register() {
    let page = include_str!("../src/errata.md");
    let words: Vec<&str> = page.split(|c: char| !c.is_alphanumeric() && c != '-').collect();
    let register = ads_cnc_vectors::errata();
    let missing: Vec<&str> =
        register.iter().map(|erratum| &*erratum.id).filter(|id| !words.contains(id)).collect();
    assert!(register.len() > 40 && missing.is_empty(), "{missing:?}");
}
