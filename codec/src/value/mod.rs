//! Decodes and encodes the values of variables, objects and elements by their types.
//!
//! A [`ValueRef`](crate::ValueRef) or [`ContentRef`](crate::ContentRef) only contains bytes. The type
//! is in the description of the variable, the descriptor of the object or an attribute of the element.
//! [`DataType`] is the type of a variable, an object or an element. [`Shape`] adds dimensions and size.
//! [`Elements`] applies a shape to the bytes.
//!
//! | task | use |
//! |---|---|
//! | read numbers of a type that your program knows | [`ValueRef::get`](crate::ValueRef::get), `iter`, `copy_to`, `to_vec` |
//! | read such numbers, and check the type against the description | [`Elements::items`], `copy_to`, `to_vec` |
//! | read elements of a type known only at run time | [`Elements::get`], `iter`, [`Element`] |
//! | convert an element to a number, a `bool` or a text | `TryFrom<Element>` |
//! | read a structure of your own | [`Reader`], [`content_error`] |
//! | encode a value | [`EncodeValue`], [`Shape::encode`] |
//!
//! Only the functions that return vectors or strings allocate. Bytes are little-endian (GEN-1,
//! assumed) and need not be aligned. The order of the elements with more than one dimension is not
//! documented. This crate **assumes** row-major order: the last index varies fastest (VAR-21). It
//! also assumes that each text in an array of STRING has the same number of bytes.
//!
//! Errors have the subject `typed-value`, except those of [`Reader`] and [`content_error`]. For a
//! wrong index in a list of indices, or an empty dimension, the offset of the error is the position
//! of the dimension, from 0. The table of [`DataType`] lists the numbers of types in errors.
//!
//! ```
//! use ads_cnc::value::{Element, EncodeValue};
//! use ads_cnc::{Decode, DescriptionRef, U32List, ValueRef};
//!
//! // The description of a variable SGN32[2][3], and its value.
//! let description = DescriptionRef::decode(
//!     b"\x01\0\0\x02\x06\0\0\0\x02\0\0\0\x18\0\0\0\x02\0\0\0\x02\0\0\0\x03\0\0\0V.E.field\0",
//! )?;
//! let bytes = b"\x0b\0\0\0\x0c\0\0\0\x0d\0\0\0\x15\0\0\0\x16\0\0\0\x17\0\0\0";
//! let value = ValueRef::decode(bytes)?;
//!
//! let elements = description.elements(&value)?;
//! assert_eq!(elements.element(U32List::from(&[1, 0]))?, Element::Sgn32(21));
//! assert_eq!(
//!     elements.element(U32List::from(&[1, 3])).unwrap_err().to_string(),
//!     "index 3 in dimension 1 (from 0) is out of range 0..=2"
//! );
//! assert_eq!(elements.items::<i32>()?.sum::<i32>(), 102);
//! let first: f64 = elements.get(0)?.try_into()?;
//! assert_eq!(first, 11.0);
//!
//! // Encode one element, an SGN32, to write it by its indices.
//! let mut buf = [0; 4];
//! assert_eq!(description.shape()?.element_shape().encode(&123_i32, &mut buf)?, [123, 0, 0, 0]);
//! assert_eq!([11, 12, 13].encode_value(&mut [0; 12])?, &bytes[..12]);
//! # Ok::<(), ads_cnc::Error>(())
//! ```
//!
//! If your program knows the type, it needs no description:
//!
//! ```
//! # #[cfg(feature = "alloc")] {
//! use ads_cnc::address::Channel;
//! use ads_cnc::operation::{Operation, ReadByName};
//!
//! # let data = &[123, 0, 0, 0, 234, 0, 0, 0];
//! let field: Vec<i32> =
//!     ReadByName::new(Channel::new(1)?, "V.E.field")?.decode_reply(data)?.to_vec()?;
//! assert_eq!(field, [123, 234]);
//! # }
//! # Ok::<(), ads_cnc::Error>(())
//! ```
//!
//! Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 2.1.1, 2.2.1, 4.3.2 and 4.3.4 … 4.3.7.

pub(crate) mod data_type;
mod describe;
mod element;
mod encode;
mod reader;
mod scalar;
mod shape;
mod typed;

pub use data_type::DataType;
pub use element::{Element, ElementIter, Elements};
pub use encode::EncodeValue;
pub use reader::{Reader, content_error};
pub(crate) use scalar::numbers;
pub use scalar::{Boolean, Scalar};
pub use shape::Shape;
