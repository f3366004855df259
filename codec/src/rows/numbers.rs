//! Rows of fixed size: numbers.

use core::marker::PhantomData;

#[cfg(feature = "arbitrary")]
use super::any::Any;
use super::{Row, part, put};
use crate::bytes::{Reader, to_u32};
use crate::error::{Error, ErrorKind};
use crate::layout::{Field, Size, Type};

/// A number on the wire.
pub(crate) trait Int: Copy {
    const SIZE: u32;
    const TYPE: Type;

    fn read(head: &[u8], at: usize) -> Self;
    fn write(self, head: &mut [u8], at: usize);
    #[cfg(feature = "arbitrary")]
    fn any(u: Any<'_, '_>) -> arbitrary::Result<Self>;
}

macro_rules! ints {
    ($( $int:ident $size:literal $ty:ident; )+) => { $(
        impl Int for $int {
            const SIZE: u32 = $size;
            const TYPE: Type = Type::$ty;

            #[inline(always)]
            fn read(head: &[u8], at: usize) -> Self {
                Self::from_le_bytes(part(head, at))
            }

            #[inline(always)]
            fn write(self, head: &mut [u8], at: usize) {
                put(head, at, self.to_le_bytes());
            }

            #[cfg(feature = "arbitrary")]
            fn any(u: Any<'_, '_>) -> arbitrary::Result<Self> {
                u.arbitrary()
            }
        }
    )+ };
}

ints! { u8 1 Uns08; u16 2 Uns16; u32 4 Uns32; }

/// A number `N` on the wire, with the Rust type `T`.
pub(crate) struct Number<N, T>(PhantomData<(N, T)>);

impl<N: Int + From<T>, T: Copy + From<N>> Row for Number<N, T> {
    type View<'a> = T;
    const SIZE: Size = Size::Fixed(N::SIZE);
    const TYPE: Type = N::TYPE;

    #[inline(always)]
    fn read<'a>(_: &mut Reader<'a>, head: &'a [u8], _: Field, at: usize) -> Result<T, Error> {
        Ok(N::read(head, at).into())
    }

    #[inline]
    fn len(_: T) -> usize {
        size_of::<N>()
    }

    #[inline(always)]
    fn write_head(view: T, head: &mut [u8], at: usize) {
        N::from(view).write(head, at);
    }
}

/// A BOOLEAN with the Rust type `T`: any value but 0 is TRUE; the value is kept.
pub(crate) struct Boolean<T>(PhantomData<T>);

impl<T: Copy + From<u8>> Row for Boolean<T>
where
    u8: From<T>,
{
    type View<'a> = T;
    const SIZE: Size = Size::Fixed(1);
    const TYPE: Type = Type::Boolean;

    #[inline(always)]
    fn read<'a>(_: &mut Reader<'a>, head: &'a [u8], _: Field, at: usize) -> Result<T, Error> {
        Ok(u8::read(head, at).into())
    }

    #[inline]
    fn len(_: T) -> usize {
        1
    }

    #[inline(always)]
    fn write_head(view: T, head: &mut [u8], at: usize) {
        u8::from(view).write(head, at);
    }
}

/// An UNS32 that must not be 0.
pub(crate) struct NonZero;

impl Row for NonZero {
    type View<'a> = u32;
    const SIZE: Size = Size::NonZero;
    const TYPE: Type = Type::Uns32;
    const REJECTS: bool = true;

    #[inline]
    fn read<'a>(_: &mut Reader<'a>, head: &'a [u8], field: Field, at: usize) -> Result<u32, Error> {
        let number = u32::read(head, at);
        Self::check(number, field, at).map(|()| number)
    }

    #[inline]
    fn len(_: u32) -> usize {
        4
    }

    #[inline]
    fn check(view: u32, field: Field, at: usize) -> Result<(), Error> {
        match view {
            0 => Err(Error::new(ErrorKind::OutOfRange, field, to_u32(at), 1, 0)),
            _ => Ok(()),
        }
    }

    #[inline(always)]
    fn write_head(view: u32, head: &mut [u8], at: usize) {
        view.write(head, at);
    }
}

#[cfg(feature = "alloc")]
mod owned {
    use super::super::Owned;
    use super::*;
    #[cfg(feature = "binrw")]
    use crate::rows::Pull;

    /// Implements `Owned` for rows that have the same type in a view and in an owned type.
    macro_rules! numbers {
        ($( [$($generics:tt)*] $row:ty, $type:ty, [$($where:tt)*] $size:expr, any $u:ident => $any:expr; )+) => { $(
            impl<$($generics)*> Owned for $row where $($where)* {
                type Type = $type;

                #[inline]
                fn own(view: $type) -> $type {
                    view
                }

                #[inline]
                fn lend(owned: &$type) -> $type {
                    *owned
                }

                #[cfg(feature = "binrw")]
                fn pull(from: &mut impl Pull) -> binrw::io::Result<()> {
                    from.exact($size)
                }

                #[cfg(feature = "arbitrary")]
                fn any($u: Any<'_, '_>, _: usize) -> arbitrary::Result<$type> {
                    $any
                }
            }
        )+ };
    }

    numbers! {
        [N: Int + From<T>, T: Copy + From<N>] Number<N, T>, T, [] size_of::<N>(),
            any u => N::any(u).map(T::from);
        [T: Copy + From<u8>] Boolean<T>, T, [u8: From<T>] 1, any u => u8::any(u).map(T::from);
        [] NonZero, u32, [] 4, any u => Ok(u.arbitrary::<u32>()?.max(1));
    }
}
