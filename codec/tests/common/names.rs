//! Laws of names of variables: how they are parsed, built and rejected (VAR-20).

use ads_cnc::limits::NAME_MAX;
use ads_cnc::text::cp1252_to_char;
use ads_cnc::{CncStr, Error, ErrorKind, Kind, PathPart, U32List, VariablePath};

use super::Fault;

/// The pieces of a name: the result of parsing it, and the input for building it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Pieces {
    pub(crate) kind: String,
    pub(crate) parts: Vec<(String, Vec<u32>)>,
}

impl Pieces {
    pub(crate) fn new(kind: &str, parts: &[(&str, &[u32])]) -> Self {
        let part = |&(name, indices): &(&str, &[u32])| (name.to_string(), indices.to_vec());
        Self { kind: kind.to_string(), parts: parts.iter().map(part).collect() }
    }

    pub(crate) fn of(path: VariablePath<'_>) -> Self {
        let part = |part: PathPart<'_>| (part.name.to_string(), part.indices.iter().collect());
        Self { kind: path.kind().text().to_string(), parts: path.parts().map(part).collect() }
    }

    pub(crate) fn write<'b>(&self, buf: &'b mut [u8]) -> Result<VariablePath<'b>, Error> {
        let parts = self.parts.iter().map(|(name, indices)| PathPart {
            name: CncStr::new(name).unwrap(),
            indices: U32List::from(&indices[..]),
        });
        VariablePath::write(Kind::new(&self.kind).unwrap(), parts, buf)
    }

    /// The name, built without the codec.
    pub(crate) fn name(&self) -> String {
        let mut name = self.kind.clone();
        for (part, indices) in &self.parts {
            name += &format!(".{part}");
            indices.iter().for_each(|index| name += &format!("[{index}]"));
        }
        name
    }
}

/// Splits a name into its pieces without the codec. Returns `None` for an invalid name.
pub(crate) fn split(name: &str) -> Option<Pieces> {
    let mut parts = name.split('.');
    let (v, kind) = (parts.next()?, parts.next()?);
    if v != "V" || kind.is_empty() || kind.contains(['[', ']']) || name.chars().count() > NAME_MAX {
        return None;
    }
    let part = |part: &str| {
        let (name, brackets) = part.split_at(part.find('[').unwrap_or(part.len()));
        let mut indices = Vec::new();
        let mut rest = brackets;
        while !rest.is_empty() {
            let (digits, after) = rest.strip_prefix('[')?.split_once(']')?;
            let number = digits.bytes().all(|byte| byte.is_ascii_digit()).then_some(digits)?;
            indices.push(number.parse().ok().filter(|&index| index < u32::MAX)?);
            rest = after;
        }
        (!name.is_empty() && !name.contains(']')).then(|| (name.to_string(), indices))
    };
    let parts = parts.map(part).collect::<Option<Vec<_>>>()?;
    (!parts.is_empty()).then(|| Pieces { kind: format!("V.{kind}"), parts })
}

/// A fault that is added to parsing or building, to verify that the laws detect it.
#[derive(Clone, Copy)]
pub(crate) struct NameMutation {
    pub(crate) pieces: fn(&mut Pieces),
    pub(crate) fault: fn(Fault) -> Fault,
    /// Changes built names.
    pub(crate) written: fn(String) -> String,
}

impl NameMutation {
    pub(crate) const NONE: Self =
        Self { pieces: |_| (), fault: |fault| fault, written: |name| name };
}

/// Checks that the codec parses CP1252 bytes without NUL, and the same text in UTF-8, with the same
/// result as [`split`]. Then builds a valid name again, or checks the position of the error for an
/// invalid name.
pub(crate) fn check_name(wire: &[u8], mutation: NameMutation) -> Result<Pieces, Fault> {
    let utf8: String = wire.iter().map(|&byte| cp1252_to_char(byte)).collect();
    let of_wire = VariablePath::from_text(CncStr::from_bytes(wire).expect("no NUL"));
    let of_utf8 = VariablePath::new(&utf8);
    let verdict = of_wire.map_err(Fault::of).map_err(mutation.fault);
    assert_eq!(verdict, of_utf8.map_err(Fault::of), "{utf8:?}");
    let mut found = of_wire.ok().map(Pieces::of);
    if let Some(pieces) = &mut found {
        (mutation.pieces)(pieces);
    }
    let wanted = split(&utf8);
    assert_eq!(found, wanted, "{utf8:?}");
    match (verdict, wanted) {
        (Ok(path), Some(pieces)) => {
            assert_eq!(of_utf8.map(Pieces::of).ok(), Some(pieces.clone()));
            check_parts(path, &utf8, &pieces);
            check_built(path, &pieces, mutation);
            Ok(pieces)
        }
        (Err(fault), _) => {
            check_fault(&utf8, fault);
            Err(fault)
        }
        (Ok(_), None) => unreachable!("they are the same"),
    }
}

/// Checks the parts that are read from a path: its text, the name of the variable without the
/// indices at its end, these indices, and the axis.
fn check_parts(path: VariablePath<'_>, name: &str, pieces: &Pieces) {
    assert_eq!((path.to_string(), path.text().len()), (name.to_string(), name.chars().count()));
    let variable = path.variable();
    assert!(name.starts_with(&variable.to_string()));
    let mut array = pieces.clone();
    let indices = std::mem::take(&mut array.parts.last_mut().unwrap().1);
    assert_eq!((Pieces::of(variable), variable.variable()), (array, variable));
    assert_eq!(path.elements(), U32List::from(&indices[..]));
    let axis = pieces.parts.iter().skip(1).last().filter(|_| pieces.kind == "V.A");
    assert_eq!(path.axis().map(|axis| axis.to_string()), axis.map(|(name, _)| name.clone()));
}

/// Checks that the codec builds the name from the pieces, without leading zeros of indices, and
/// that the variable with the indices at the end is the same element. A name of kind V.A must be
/// converted to a name for the channel interface and back, unless that name would be too long.
fn check_built(path: VariablePath<'_>, pieces: &Pieces, mutation: NameMutation) {
    let mut buf = [0x55; NAME_MAX + 1];
    let built = pieces.write(&mut buf).expect("no longer than it was");
    assert_eq!((mutation.written)(built.to_string()), pieces.name());
    assert_eq!(Pieces::of(built), *pieces);
    let len = built.text().len();
    assert!(buf[len..].iter().all(|&byte| byte == 0x55));
    let mut small = vec![0x55; len - 1];
    let error = pieces.write(&mut small).expect_err("a byte too few");
    assert_eq!((error.kind(), error.expected() as usize), (ErrorKind::BufferTooSmall, len));
    assert!(small.iter().all(|&byte| byte == 0x55));

    let (mut one, mut two) = ([0; NAME_MAX], [0; NAME_MAX]);
    let whole = path.variable();
    let element = whole.write_element(path.elements(), &mut one).expect("as long at most");
    let of_element = (mutation.written)(element.to_string());
    assert_eq!(split(&of_element), Some(pieces.clone()), "{path}");

    let written = path.write_axis(CncStr::new("X").unwrap(), &mut one);
    match written {
        Ok(there) => {
            assert!(there.axis().is_some_and(|axis| axis == "X"));
            let back = there.write_without_axis(&mut two).expect("it has an axis");
            assert_eq!(split(&(mutation.written)(back.to_string())), Some(pieces.clone()));
        }
        Err(error) => {
            let other = pieces.kind != "V.A";
            assert!(other || error.kind() == ErrorKind::TooLong, "{path}: {error}");
            assert_eq!(other, error.kind() == ErrorKind::Unexpected, "{path}: {error}");
        }
    }
}

/// Checks the numbers and the position of a fault. The text before the fault must be a valid name
/// or a name that ends too early; for `TooLong`, it may have any other fault.
fn check_fault(name: &str, fault: Fault) {
    let count = name.chars().count();
    assert!(fault.offset <= count, "{fault:?} of {name:?}");
    let before: String = name.chars().take(fault.offset).collect();
    let at = name.chars().nth(fault.offset);
    match fault.kind {
        ErrorKind::TooLong => assert_eq!((fault.expected, fault.found), (NAME_MAX, count)),
        ErrorKind::Truncated => assert_eq!(at, None, "{fault:?} of {name:?}"),
        ErrorKind::Unexpected => {
            assert_eq!(at.map(|at| u32::from(at) as usize), Some(fault.found), "{name:?}");
        }
        ErrorKind::OutOfRange => assert!(at.is_some_and(|at| at.is_ascii_digit()), "{name:?}"),
        other => panic!("{other:?} of {name:?}"),
    }
    match VariablePath::new(&before) {
        Ok(_) => {}
        Err(error) if fault.kind == ErrorKind::TooLong => {
            assert_ne!(error.kind(), ErrorKind::TooLong);
        }
        Err(error) => assert_eq!(error.kind(), ErrorKind::Truncated, "{fault:?} of {name:?}"),
    }
}
