//! Tests of the numbers and names of codes and types. The numbers are those of the manuals or of the
//! vendors' help pages, if a test does not say otherwise.

use ads_cnc::ads::{AdsError, AdsState, Command, StateFlags};
use ads_cnc::value::{DataType, Shape};
use ads_cnc::{Synchronisation, U32List, Validity, VariableAccess, VariableType, WriteAccess};

/// The numbers up to 0xFFF of a code that have a name, with their names.
macro_rules! names {
    ($code:ident) => {
        (0..0x1000).filter_map(|number| Some((number, $code(number).name()?))).collect::<Vec<_>>()
    };
}

/// Types, access, synchronisation and validity of variables, and the write access of objects
/// (VAR-5, VAR-6, VAR-15, COM-2).
#[test]
fn codes_of_variables_have_the_numbers_of_the_manual() {
    let types = [
        (1, "BOOLEAN"),
        (2, "SGN08"),
        (3, "UNS08"),
        (4, "SGN16"),
        (5, "UNS16"),
        (6, "SGN32"),
        (7, "UNS32"),
        (8, "REAL64"),
        (9, "STRING"),
    ];
    assert_eq!(names!(VariableType), types);
    assert_eq!(names!(VariableAccess), [(1, "READ_ONLY"), (2, "READ_WRITE")]);
    assert_eq!(names!(Synchronisation), [(1, "NO_SYNC"), (2, "SYNCHRONIZED")]);
    assert_eq!(names!(Validity), [(1, "CHANNEL"), (2, "GLOBAL")]);
    assert_eq!(names!(WriteAccess), [(0, "READ_ONLY"), (1, "WRITABLE")]);
}

/// Commands, flags, states and errors of ADS (ADS-5, ADS-7, ADS-9).
#[test]
fn codes_of_ads_have_the_numbers_of_the_help_pages() {
    let commands = [
        (1, "READ_DEVICE_INFO"),
        (2, "READ"),
        (3, "WRITE"),
        (4, "READ_STATE"),
        (5, "WRITE_CONTROL"),
        (6, "ADD_NOTIFICATION"),
        (7, "DELETE_NOTIFICATION"),
        (8, "NOTIFICATION"),
        (9, "READ_WRITE"),
    ];
    assert_eq!(names!(Command), commands);
    assert_eq!(names!(StateFlags), [(4, "REQUEST"), (5, "RESPONSE")]);
    assert_eq!(names!(AdsState), [(5, "RUN"), (6, "STOP"), (15, "CONFIG")]);
    let errors = [
        (0, "NO_ERROR"),
        (6, "TARGET_PORT_NOT_FOUND"),
        (7, "TARGET_MACHINE_NOT_FOUND"),
        (0x701, "SERVICE_NOT_SUPPORTED"),
        (0x702, "INVALID_GROUP"),
        (0x703, "INVALID_OFFSET"),
        (0x704, "INVALID_ACCESS"),
        (0x705, "INVALID_SIZE"),
        (0x706, "INVALID_DATA"),
        (0x710, "SYMBOL_NOT_FOUND"),
    ];
    assert_eq!(names!(AdsError), errors);
}

/// The numbers of types in errors are the codes of the types of variables, and 10 to 12 for the
/// types that have no such code.
#[test]
fn types_have_their_sizes_and_their_numbers_in_errors() {
    let types = DataType::ALL.map(|ty| {
        let shape = Shape::new(ty, U32List::EMPTY, ty.size().unwrap_or(1)).unwrap();
        let error = match ty {
            DataType::Boolean => shape.encode(&1_u8, &mut []),
            _ => shape.encode(&true, &mut []),
        };
        (ty.name(), error.unwrap_err().expected(), ty.size())
    });
    let expected = [
        ("BOOLEAN", 1, Some(1)),
        ("SGN08", 2, Some(1)),
        ("UNS08", 3, Some(1)),
        ("SGN16", 4, Some(2)),
        ("UNS16", 5, Some(2)),
        ("SGN32", 6, Some(4)),
        ("UNS32", 7, Some(4)),
        ("LINT", 10, Some(8)),
        ("LWORD", 11, Some(8)),
        ("REAL32", 12, Some(4)),
        ("REAL64", 8, Some(8)),
        ("STRING", 9, None),
    ];
    assert_eq!(types, expected);
}
