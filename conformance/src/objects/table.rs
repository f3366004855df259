//! Objects as a text table and as CSV.

use std::io::{self, Write};

use super::ListedValue;
use crate::text::shorten;
use crate::values::printable;

/// A column: its heading, and a function that returns the cell for an object.
#[derive(Clone, Copy, Debug)]
pub struct Column {
    /// The heading of the column.
    pub head: &'static str,
    pub cell: fn(&ListedValue) -> String,
}

/// The columns for variables and parameters (`variables`), or for objects and elements.
pub const fn columns(variables: bool) -> &'static [Column] {
    if variables { VARIABLE } else { OBJECT }
}

const LIST: Column = Column { head: "list", cell: |object| object.list.to_string() };
const NAME: Column = Column { head: "name", cell: |object| printable(&object.name.to_string()) };
const TYPE: Column = Column { head: "type", cell: |object| object.ty.to_string() };
/// The heading of the column of values.
pub const VALUE: &str = "value";
const SIZE: Column = Column {
    head: "size",
    cell: |object| object.ty.size.map_or_else(String::new, |size| size.to_string()),
};
const ACCESS: Column = Column { head: "access", cell: |object| object.access.to_string() };

const OBJECT: &[Column] = &[
    LIST,
    NAME,
    TYPE,
    SIZE,
    Column {
        head: "unit",
        cell: |object| {
            object.unit.as_ref().map_or_else(String::new, |unit| printable(&unit.to_string()))
        },
    },
    ACCESS,
    Column {
        head: "group",
        cell: |object| {
            object.address.content().map_or_else(String::new, |(group, _)| group.to_string())
        },
    },
    Column {
        head: "offset",
        cell: |object| {
            object.address.content().map_or_else(String::new, |(_, offset)| offset.to_string())
        },
    },
];

const VARIABLE: &[Column] = &[
    LIST,
    NAME,
    TYPE,
    SIZE,
    ACCESS,
    Column {
        head: "handle",
        cell: |object| object.handle.map_or_else(String::new, |handle| format!("{:#x}", handle.0)),
    },
];

/// Maximum width of a column in characters if the output is not a terminal; a longer cell shifts
/// only the rest of its row.
const WIDTH_MAX: usize = 40;

/// Minimum width in characters to which the column of values is narrowed.
const WIDTH_MIN: usize = 8;

/// A column that the table shows: its index in the row, its heading and its width in characters.
struct Shown<'h> {
    place: usize,
    head: &'h str,
    width: usize,
}

impl Shown<'_> {
    /// The width to which the column can be narrowed; only values are truncated.
    fn least(&self) -> usize {
        if self.head == VALUE { self.width.min(WIDTH_MIN) } else { self.width }
    }
}

/// The width of a row of these columns, with two spaces between them.
fn total(columns: &[Shown<'_>], width: impl Fn(&Shown<'_>) -> usize) -> usize {
    let gaps = columns.len().saturating_sub(1).saturating_mul(2);
    columns.iter().map(width).fold(gaps, usize::saturating_add)
}

/// Writes rows with headings. Each column is as wide as its heading or its longest cell; without a
/// terminal, a cell widens its column to at most `WIDTH_MAX`. On a terminal (`terminal` is its
/// width), values are truncated so that a row fits on a line. If that is not enough, the last
/// columns are omitted, except names and values. Returns the headings of the omitted columns.
pub fn table<'h>(
    heads: &[&'h str],
    rows: impl Iterator<Item = Vec<String>> + Clone,
    terminal: Option<usize>,
    out: &mut impl Write,
) -> io::Result<Vec<&'h str>> {
    let columns = heads.iter().enumerate();
    let columns = columns.map(|(place, head)| Shown { place, head, width: head.len() });
    let mut columns: Vec<Shown<'_>> = columns.collect();
    let most = terminal.map_or(WIDTH_MAX, |_| usize::MAX);
    for row in rows.clone() {
        for (column, cell) in columns.iter_mut().zip(&row) {
            column.width = column.width.max(cell.chars().count().min(most));
        }
    }
    let mut omitted = Vec::new();
    let can_omit = |column: &Shown<'_>| ![NAME.head, VALUE].contains(&column.head);
    while let Some(terminal) = terminal
        && total(&columns, |column| column.least()) > terminal
        && let Some(last) = columns.iter().rposition(can_omit)
    {
        omitted.insert(0, columns.remove(last).head);
    }
    let excess =
        total(&columns, |column| column.width).saturating_sub(terminal.unwrap_or(usize::MAX));
    for column in &mut columns {
        column.width = column.width.saturating_sub(excess).max(column.least());
    }
    let heads: Vec<String> = heads.iter().map(|head| head.to_uppercase()).collect();
    for row in std::iter::once(heads).chain(rows) {
        let cells = columns.iter().filter_map(|column| {
            let (cell, width) = (row.get(column.place)?, column.width);
            Some(match terminal {
                Some(_) if cell.chars().count() > width => shorten(cell, width.saturating_sub(1)),
                _ => format!("{cell:<width$}"),
            })
        });
        writeln!(out, "{}", cells.collect::<Vec<_>>().join("  ").trim_end())?;
    }
    Ok(omitted)
}

/// Writes rows as comma-separated values with CR LF, as in RFC 4180. A cell that a spreadsheet may
/// treat as a formula gets a leading apostrophe.
pub fn csv(
    heads: &[&str],
    rows: impl Iterator<Item = Vec<String>>,
    out: &mut impl Write,
) -> io::Result<()> {
    let heads: Vec<String> = heads.iter().map(|&head| head.to_owned()).collect();
    for row in std::iter::once(heads).chain(rows) {
        let cells: Vec<String> = row.iter().map(|cell| quoted(cell)).collect();
        write!(out, "{}\r\n", cells.join(","))?;
    }
    Ok(())
}

fn quoted(cell: &str) -> String {
    let cell = if is_formula(cell) { format!("'{cell}") } else { cell.to_owned() };
    if cell.contains([',', '"', '\r', '\n']) {
        format!("\"{}\"", cell.replace('"', "\"\""))
    } else {
        cell
    }
}

/// Whether a spreadsheet may treat a cell as a formula. Numbers, lists of numbers and a single
/// character are not formulas.
fn is_formula(cell: &str) -> bool {
    let begins = cell.starts_with(['=', '+', '-', '@', '\t', '\r', '\n']);
    let is_number = |part: &str| part.parse::<f64>().is_ok();
    begins && cell.len() > 1 && !cell.split(',').all(is_number)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_fits_the_terminal() {
        let name = "n".repeat(60);
        let row = || vec!["SDA channel 1".to_owned(), name.clone(), "4".to_owned(), "T".repeat(9)];
        for (terminal, widest, without) in [
            (None, 92, &[][..]),
            (Some(100), 92, &[]),
            (Some(91), 91, &[]),
            (Some(90), 86, &["size"]),
            (Some(80), 71, &["list", "size"]),
            (Some(70), 70, &["list", "size"]),
            (Some(10), 70, &["list", "size"]),
        ] {
            let (mut out, rows) = (Vec::new(), [row(), row()].into_iter());
            let omitted = table(&["list", "name", "size", VALUE], rows, terminal, &mut out);
            assert_eq!(omitted.unwrap(), without, "{terminal:?}");
            let text = String::from_utf8(out).unwrap();
            let lines = text.lines().map(|line| line.chars().count());
            assert_eq!(lines.max(), Some(widest), "{text}");
            assert_eq!(text.matches(&name).count(), 2, "{text}");
        }
    }

    #[test]
    fn cells_with_commas_are_quoted() {
        let (mut out, row) = (Vec::new(), vec!["a,b".to_owned(), "\"c\"".to_owned()]);
        csv(&["one", "two"], [row].into_iter(), &mut out).unwrap();
        assert_eq!(out, b"one,two\r\n\"a,b\",\"\"\"c\"\"\"\r\n");
    }

    #[test]
    fn no_cell_is_a_formula() {
        for (cell, shown) in [
            ("=cmd|'/C calc'!A0", "'=cmd|'/C calc'!A0"),
            ("+1+1", "'+1+1"),
            ("-2+3", "'-2+3"),
            ("@SUM(A1)", "'@SUM(A1)"),
            ("=1,2", "\"'=1,2\""),
            ("\t=1", "'\t=1"),
            ("-,=1", "\"'-,=1\""),
            ("-inf", "-inf"),
            ("-1.5e-7", "-1.5e-7"),
            ("-1,2,-3", "\"-1,2,-3\""),
            ("-", "-"),
            ("a=b", "a=b"),
        ] {
            let mut out = Vec::new();
            csv(&["head"], [vec![cell.to_owned()]].into_iter(), &mut out).unwrap();
            assert_eq!(String::from_utf8(out).unwrap(), format!("head\r\n{shown}\r\n"));
        }
    }
}
