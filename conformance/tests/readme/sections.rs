//! Tests that the table of the manuals' sections, and the short table in the README, are up to date.

use std::fs;

use ads_cnc_conformance::matrix::{matrix, to_sections};

use super::root;

#[test]
fn tables_are_those_of_the_data() {
    let table = to_sections(&matrix());
    let short = &table[table.find("| area ").unwrap()..];
    let (short, _) = short.split_once("\n\n").unwrap();
    let (path, readme) = (root().join("conformance/doc/sections.md"), root().join("README.md"));
    let text = fs::read_to_string(&readme).unwrap();
    let (before, rest) = text.split_once("<!-- areas -->\n\n").unwrap();
    let (_, after) = rest.split_once("\n\n<!-- /areas -->").unwrap();
    let renewed = format!("{before}<!-- areas -->\n\n{short}\n\n<!-- /areas -->{after}");
    if std::env::var_os("ADS_CNC_WRITE_TABLES").is_some() {
        fs::write(&path, &table).unwrap();
        fs::write(&readme, &renewed).unwrap();
    }
    let is_same = fs::read_to_string(&path).is_ok_and(|text| text == table)
        && fs::read_to_string(&readme).unwrap() == renewed;
    assert!(
        is_same,
        "run with ADS_CNC_WRITE_TABLES=1 to rewrite {} and the README",
        path.display()
    );
}
