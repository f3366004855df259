//! The layout of the structs: the same in Rust as in the header.

use core::mem::offset_of;

use super::*;

macro_rules! layouts {
    ($( $type:ident { $( $field:ident ),* } )+) => {
        /// The sizes and offsets of the structs in Rust, in the form of the rows of tests/layout.h.
        fn layouts() -> Vec<(String, usize)> {
            let mut rows = Vec::new();
            $(
                rows.push((format!("SIZE({}", stringify!($type)), size_of::<$type>()));
                $( rows.push((
                    format!("FIELD({}, {}", stringify!($type), stringify!($field)),
                    offset_of!($type, $field),
                )); )*
            )+
            rows
        }
    };
}

layouts! {
    AdsCncBytes { data, length }
    AdsCncError { kind, stream, field, offset, expected, found, subject, name, text }
    AdsCncRequest {
        function, channel, by_index, axis, index, count, size, handle, index_group, index_offset, kind, name,
        value, indices, indices_count
    }
    AdsCncCall { port, command, index_group, index_offset, read_length, data }
    AdsCncField { field, record, item, offset, length, number }
    AdsCncPart { field, number, data }
    AdsCncFunctionInfo {
        name, operation, port, command, effect, request, reply, argument_count, arguments
    }
    AdsCncStreamInfo { name, title, max, field_count, repeats }
    AdsCncFieldInfo { name, meaning, clause, kind, size, is_count, is_list }
    AdsCncType { name, object_name, code, kind, size }
    AdsCncAddress { net_id, port }
    AdsCncFrame { target, source, command, state_flags, error, invoke_id, data }
    AdsCncGroup { task, access, addressing, table, object_class, attribute, instance }
    AdsCncSender {}
    AdsCncProgress { state, packets, lines, bytes, left_lines, left_bytes, busy_count }
    AdsCncHost {}
    AdsCncServiceId {}
    AdsCncHostStep { kind, service, request_state, variable, data }
}

/// The structs in Rust have the layout in tests/layout.h. `codec/bindings/run` compiles
/// tests/layout.c, which checks the structs of the C header against the same rows.
#[test]
fn layouts_of_structs_equal_those_of_the_header() {
    let rows: Vec<&str> = include_str!("../../tests/layout.h").lines().collect();
    let rows: Vec<&str> = rows.into_iter().filter(|row| row.ends_with(')')).collect();
    let column = if size_of::<usize>() == 8 { 0 } else { 1 };
    assert_eq!(rows.len(), layouts().len());
    for (row, (name, here)) in rows.iter().zip(layouts()) {
        let numbers = row.strip_prefix(&name).unwrap_or_else(|| panic!("{row}: {name}"));
        let mut numbers = numbers.trim_end_matches(')').split(", ").skip(1);
        assert_eq!(numbers.nth(column).unwrap().parse(), Ok(here), "{row}");
    }
}
