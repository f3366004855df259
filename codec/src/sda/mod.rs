//! Elements of the classes that the SDA and GEO tasks serve (SDA-1 … SDA-12).
//!
//! A query returns the address of an instance of a class, if the instance exists. An instance is a
//! list of elements. Each attribute of an element has its own index group:
//!
//! | attribute | group | read with | reply |
//! |---|---|---|---|
//! | object address | base + 0x600 | [`FindInstance`] | [`ObjectAddress`] |
//! | content of the first element | base | [`CountElements`] | [`ElementCount`] |
//! | content | base | [`ReadElement`], [`WriteElement`] | [`ContentRef`] |
//! | name | base + 0x100 | [`ReadElementName`] | [`ElementTextRef`] |
//! | type | base + 0x200 | [`ReadElementType`] | [`ElementTextRef`] |
//! | length | base + 0x300 | [`ReadElementLength`] | [`ElementLength`] |
//! | unit | base + 0x400 | [`ReadElementUnit`] | [`ElementTextRef`] |
//! | write flag | base + 0x500 | [`ReadElementWriteFlag`] | [`ElementWriteFlag`] |
//!
//! In logical addressing, the base is `0x120300` + `0x1000` × class + channel; for a spindle, it is
//! `0x25300` + spindle. The group of the object address contains no channel or spindle.
//!
//! ```
//! use ads_cnc::address::{Attribute, Class};
//! use ads_cnc::operation::{FindInstance, Operation, ReadElementName};
//!
//! let query = FindInstance::new(Class::Hld, 1, 0);
//! assert_eq!((query.index_group().get(), query.index_offset().get()), (0x12_3900, 0));
//! assert_eq!(query.encode(&mut [0; 8])?, [1, 0, 0, 0, 0, 0, 0, 0]);
//!
//! // The reply of a CNC:
//! let found = query.decode_reply(&[0x01, 0x33, 0x12, 0, 0, 0, 0, 0])?;
//! let first = found.first_element()?.expect("the channel is configured");
//! let name = ReadElementName::new(first.nth(1)?);
//! assert_eq!((name.index_group().get(), name.index_offset().get()), (0x12_3401, 1));
//! assert_eq!(name.decode_reply(b"feedhold.enable\0")?.text.text(), "feedhold.enable");
//! # Ok::<(), ads_cnc::Error>(())
//! ```
//!
//! Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 2.2.1 and 2.2.2.
//!
//! [`ContentRef`]: crate::ContentRef
//! [`FindInstance`]: crate::operation::FindInstance
//! [`CountElements`]: crate::operation::CountElements
//! [`ReadElement`]: crate::operation::ReadElement
//! [`WriteElement`]: crate::operation::WriteElement
//! [`ReadElementName`]: crate::operation::ReadElementName
//! [`ReadElementType`]: crate::operation::ReadElementType
//! [`ReadElementLength`]: crate::operation::ReadElementLength
//! [`ReadElementUnit`]: crate::operation::ReadElementUnit
//! [`ReadElementWriteFlag`]: crate::operation::ReadElementWriteFlag

mod element;
mod object_address;

#[cfg(feature = "alloc")]
pub use element::ElementText;
pub use element::{ElementCount, ElementLength, ElementTextRef, ElementWriteFlag};
pub use object_address::{ObjectAddress, ObjectAddressQuery};
