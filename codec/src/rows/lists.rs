//! Rows of counted items, and of remaining bytes.

use super::{Row, count, put_count};
use crate::bytes::{Reader, Writer, to_u32, to_usize};
use crate::error::{Error, ErrorKind};
use crate::layout::{ADS_DATA, Field, Size, Type};
use crate::variable::U32List;

/// A list of UNS32. The count of the list is a separate row.
pub(crate) struct List<const MAX: u32>;

impl<const MAX: u32> Row for List<MAX> {
    type View<'a> = U32List<'a>;
    const SIZE: Size = Size::Items { each: 4, max: MAX };
    const TYPE: Type = Type::Uns32;

    #[inline]
    fn read<'a>(
        input: &mut Reader<'a>,
        head: &'a [u8],
        field: Field,
        at: usize,
    ) -> Result<U32List<'a>, Error> {
        input.numbers(field.before(), count(head, at), MAX).map(U32List::from_wire)
    }

    #[inline]
    fn len(view: U32List<'_>) -> usize {
        view.encoded_len().saturating_add(4)
    }

    #[inline]
    fn check(view: U32List<'_>, field: Field, at: usize) -> Result<(), Error> {
        let count = to_u32(view.len());
        if count > MAX {
            Err(Error::new(ErrorKind::TooMany, field.before(), to_u32(at), MAX, count))
        } else {
            Ok(())
        }
    }

    #[inline]
    fn write_head(view: U32List<'_>, head: &mut [u8], at: usize) {
        put_count(head, at, view.len());
    }

    #[inline]
    fn write(view: U32List<'_>, out: &mut Writer<'_>) {
        view.write(out);
    }
}

/// Counted bytes. The number of bytes is a separate row.
pub(crate) struct Data;

impl Row for Data {
    type View<'a> = &'a [u8];
    const SIZE: Size = Size::Items { each: 1, max: ADS_DATA };
    const TYPE: Type = Type::Bytes;

    #[inline]
    fn read<'a>(
        input: &mut Reader<'a>,
        head: &'a [u8],
        field: Field,
        at: usize,
    ) -> Result<&'a [u8], Error> {
        input.take(field, count(head, at))
    }

    #[inline]
    fn len(view: &[u8]) -> usize {
        view.len().saturating_add(4)
    }

    #[inline]
    fn write_head(view: &[u8], head: &mut [u8], at: usize) {
        put_count(head, at, view.len());
    }

    #[inline]
    fn write(view: &[u8], out: &mut Writer<'_>) {
        out.put(view);
    }
}

/// All remaining bytes. The maximum length of the stream limits their number.
pub(crate) struct Rest<const MIN: u32, const MAX: u32>;

impl<const MIN: u32, const MAX: u32> Row for Rest<MIN, MAX> {
    type View<'a> = &'a [u8];
    const SIZE: Size = Size::Rest { min: MIN, max: MAX };
    const TYPE: Type = Type::Bytes;

    #[inline]
    fn read<'a>(
        input: &mut Reader<'a>,
        _: &'a [u8],
        field: Field,
        _: usize,
    ) -> Result<&'a [u8], Error> {
        let (at, bytes) = (input.at(), input.take_all());
        Self::check(bytes, field, to_usize(at))?;
        Ok(bytes)
    }

    #[inline]
    fn len(view: &[u8]) -> usize {
        view.len()
    }

    #[inline]
    fn check(view: &[u8], field: Field, at: usize) -> Result<(), Error> {
        if view.len() < to_usize(MIN) {
            Err(Error::new(ErrorKind::Truncated, field, to_u32(at), MIN, to_u32(view.len())))
        } else {
            Ok(())
        }
    }

    #[inline]
    fn write(view: &[u8], out: &mut Writer<'_>) {
        out.put(view);
    }
}

#[cfg(feature = "alloc")]
mod owned {
    use alloc::vec::Vec;

    use super::super::Owned;
    #[cfg(feature = "arbitrary")]
    use super::super::any::{Any, up_to};
    use super::*;
    #[cfg(feature = "binrw")]
    use crate::rows::Pull;

    impl<const MAX: u32> Owned for List<MAX> {
        type Type = Vec<u32>;

        #[inline]
        fn own(view: U32List<'_>) -> Vec<u32> {
            view.to_vec()
        }

        #[inline]
        fn lend(owned: &Vec<u32>) -> U32List<'_> {
            owned.as_slice().into()
        }

        #[cfg(feature = "binrw")]
        fn pull(from: &mut impl Pull) -> binrw::io::Result<()> {
            from.counted(4, MAX)
        }

        #[cfg(feature = "arbitrary")]
        fn any(u: Any<'_, '_>, room: usize) -> arbitrary::Result<Vec<u32>> {
            up_to(u, room.min(to_usize(MAX).saturating_mul(4)) / 4)
        }
    }

    /// Implements `Owned` for rows of bytes.
    macro_rules! bytes {
        ($(
            [$($generics:tt)*] $row:ty, pull $from:ident => $pull:expr,
            any $u:ident, $room:ident => $any:expr;
        )+) => { $(
            impl<$($generics)*> Owned for $row {
                type Type = Vec<u8>;

                #[inline]
                fn own(view: &[u8]) -> Vec<u8> {
                    view.to_vec()
                }

                #[inline]
                fn lend(owned: &Vec<u8>) -> &[u8] {
                    owned
                }

                #[cfg(feature = "binrw")]
                fn pull($from: &mut impl Pull) -> binrw::io::Result<()> {
                    $pull
                }

                #[cfg(feature = "arbitrary")]
                fn any($u: Any<'_, '_>, $room: usize) -> arbitrary::Result<Vec<u8>> {
                    $any
                }
            }
        )+ };
    }

    bytes! {
        [] Data, pull from => from.counted(1, ADS_DATA),
            any u, room => up_to(u, room.min(to_usize(ADS_DATA)));
        [const MIN: u32, const MAX: u32] Rest<MIN, MAX>, pull from => from.rest(MAX),
            any u, room => {
                let mut bytes: Vec<u8> = up_to(u, room.saturating_add(Self::LEAST).min(to_usize(MAX)))?;
                bytes.resize(bytes.len().max(Self::LEAST), 0);
                Ok(bytes)
            };
    }
}
