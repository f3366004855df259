//! Values and rows from which variables are made.

use ads_cnc::VariableType as Type;

/// A value before it has a name.
pub(super) struct Data {
    pub(super) var_type: Type,
    pub(super) dimensions: Vec<u32>,
    pub(super) bytes: Vec<u8>,
}

impl Data {
    /// The same elements in these dimensions.
    pub(super) fn of(mut self, dimensions: &[u32]) -> Self {
        self.dimensions = dimensions.to_vec();
        self
    }
}

/// Declares a function that makes an elementary value of one element; of more, dimensions follow.
macro_rules! values {
    ($( $name:ident($ty:ty) => $var_type:ident; )+) => { $(
        pub(super) fn $name(elements: &[$ty]) -> Data {
            let bytes = elements.iter().flat_map(|element| element.to_le_bytes()).collect();
            Data { var_type: Type::$var_type, dimensions: Vec::new(), bytes }
        }
    )+ };
}

values! {
    boolean(u8) => BOOLEAN;
    sgn08(i8) => SGN08;
    uns08(u8) => UNS08;
    sgn16(i16) => SGN16;
    uns16(u16) => UNS16;
    sgn32(i32) => SGN32;
    uns32(u32) => UNS32;
    real64(f64) => REAL64;
}

/// Texts in the bytes they are declared with, NULs behind them.
pub(super) fn string(declared: usize, texts: &[&[u8]]) -> Data {
    let padded = |text: &&[u8]| text.iter().copied().chain([0; 800]).take(declared).collect();
    let bytes = texts.iter().flat_map::<Vec<u8>, _>(padded).collect();
    Data { var_type: Type::STRING, dimensions: Vec::new(), bytes }
}

/// A value without meaning for the variables that only fill a list; its type goes round.
pub(super) fn filling(number: u8) -> Data {
    let n = i16::from(number);
    match number.checked_rem(8).unwrap_or_default() {
        0 => boolean(&[number & 1]),
        1 => sgn08(&[-1, 1, 2]).of(&[3]),
        2 => uns08(&[number]),
        3 => sgn16(&[n.wrapping_neg()]),
        4 => uns16(&[0x8000 | u16::from(number)]),
        5 => sgn32(&[i32::from(n).wrapping_neg(), i32::from(n)]).of(&[2]),
        6 => uns32(&[0x8000_0000 | u32::from(number)]),
        _ => real64(&[f64::from(n) / 8.0]),
    }
}
