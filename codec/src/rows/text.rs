//! Rows of text.

use core::marker::PhantomData;

use super::Row;
use crate::bytes::{Reader, Writer, to_u32};
use crate::error::Error;
use crate::layout::{Field, Size, Type};
use crate::text::{CncStr, TextRef};
use crate::variable::Kind;

/// Text up to a NUL or to the end of the stream. The bytes after the NUL are its tail, which is kept.
pub(crate) struct TextAndTail<const MIN: u32, const MAX: u32>;

impl<const MIN: u32, const MAX: u32> Row for TextAndTail<MIN, MAX> {
    type View<'a> = TextRef<'a>;
    const SIZE: Size = Size::TextAndTail { min: MIN, max: MAX };
    const TYPE: Type = Type::String;

    #[inline]
    fn read<'a>(
        input: &mut Reader<'a>,
        _: &'a [u8],
        field: Field,
        _: usize,
    ) -> Result<TextRef<'a>, Error> {
        input.text_and_tail(field, MIN, MAX)
    }

    #[inline]
    fn len(view: TextRef<'_>) -> usize {
        view.field_len()
    }

    #[inline]
    fn check(view: TextRef<'_>, field: Field, at: usize) -> Result<(), Error> {
        view.check_text_and_tail(field, to_u32(at), MIN, MAX).map(drop)
    }

    #[inline]
    fn write(view: TextRef<'_>, out: &mut Writer<'_>) {
        view.write(out);
    }
}

/// NUL-terminated text; more NULs may pad it. If `IS_OPTIONAL`, a field without any bytes is the
/// empty text.
pub(crate) struct CString<const MAX: u32, const IS_OPTIONAL: bool>;

impl<const MAX: u32, const IS_OPTIONAL: bool> Row for CString<MAX, IS_OPTIONAL> {
    type View<'a> = TextRef<'a>;
    const SIZE: Size = Size::CString { max: MAX, is_optional: IS_OPTIONAL };
    const TYPE: Type = Type::String;

    #[inline]
    fn read<'a>(
        input: &mut Reader<'a>,
        _: &'a [u8],
        field: Field,
        _: usize,
    ) -> Result<TextRef<'a>, Error> {
        if IS_OPTIONAL && input.is_empty() {
            Ok(TextRef::with_tail(CncStr::EMPTY, None))
        } else {
            input.cstring(field, MAX)
        }
    }

    #[inline]
    fn len(view: TextRef<'_>) -> usize {
        view.field_len()
    }

    #[inline]
    fn check(view: TextRef<'_>, field: Field, at: usize) -> Result<(), Error> {
        if IS_OPTIONAL && view.field_len() == 0 {
            Ok(())
        } else {
            view.check_cstring(field, to_u32(at), MAX).map(drop)
        }
    }

    #[inline]
    fn write(view: TextRef<'_>, out: &mut Writer<'_>) {
        view.write(out);
    }
}

/// A [`CString`] text that names a kind of variables.
pub(crate) struct KindText<R>(PhantomData<R>);

impl<R: for<'a> Row<View<'a> = TextRef<'a>>> Row for KindText<R> {
    type View<'a> = Kind<'a>;
    const SIZE: Size = R::SIZE;
    const TYPE: Type = R::TYPE;

    #[inline]
    fn read<'a>(
        input: &mut Reader<'a>,
        _: &'a [u8],
        field: Field,
        _: usize,
    ) -> Result<Kind<'a>, Error> {
        R::read(input, &[], field, 0).map(Kind::from_field)
    }

    #[inline]
    fn len(view: Kind<'_>) -> usize {
        R::len(view.field())
    }

    #[inline]
    fn check(view: Kind<'_>, field: Field, at: usize) -> Result<(), Error> {
        R::check(view.field(), field, at)
    }

    #[inline]
    fn write(view: Kind<'_>, out: &mut Writer<'_>) {
        R::write(view.field(), out);
    }
}

/// Text with or without a NUL at its end; more NULs may pad it.
pub(crate) struct OptionalNul<const MAX: u32>;

impl<const MAX: u32> Row for OptionalNul<MAX> {
    type View<'a> = TextRef<'a>;
    const SIZE: Size = Size::OptionalNul { max: MAX };
    const TYPE: Type = Type::String;

    #[inline]
    fn read<'a>(
        input: &mut Reader<'a>,
        _: &'a [u8],
        field: Field,
        _: usize,
    ) -> Result<TextRef<'a>, Error> {
        input.optional_nul(field)
    }

    #[inline]
    fn len(view: TextRef<'_>) -> usize {
        view.field_len()
    }

    #[inline]
    fn check(view: TextRef<'_>, field: Field, at: usize) -> Result<(), Error> {
        view.check_optional_nul(field, to_u32(at), MAX).map(drop)
    }

    #[inline]
    fn write(view: TextRef<'_>, out: &mut Writer<'_>) {
        view.write(out);
    }
}

/// NUL-terminated text before other fields of the stream.
pub(crate) struct CStringPrefix<const MAX: u32>;

impl<const MAX: u32> Row for CStringPrefix<MAX> {
    type View<'a> = CncStr<'a>;
    const SIZE: Size = Size::CStringPrefix { max: MAX };
    const TYPE: Type = Type::String;

    #[inline]
    fn read<'a>(
        input: &mut Reader<'a>,
        _: &'a [u8],
        field: Field,
        _: usize,
    ) -> Result<CncStr<'a>, Error> {
        input.cstring_prefix(field, MAX)
    }

    #[inline]
    fn len(view: CncStr<'_>) -> usize {
        view.len().saturating_add(1)
    }

    #[inline]
    fn check(view: CncStr<'_>, field: Field, at: usize) -> Result<(), Error> {
        TextRef::from(view).check_text_and_tail(field, to_u32(at), 1, MAX).map(drop)
    }

    #[inline]
    fn write(view: CncStr<'_>, out: &mut Writer<'_>) {
        TextRef::from(view).write(out);
    }
}

#[cfg(feature = "alloc")]
mod owned {
    use super::super::Owned;
    #[cfg(feature = "arbitrary")]
    use super::super::any::{Any, ended, nothing, open, text};

    use super::*;
    #[cfg(feature = "arbitrary")]
    use crate::bytes::to_usize;
    #[cfg(feature = "binrw")]
    use crate::rows::Pull;
    use crate::text::{CncString, Text};

    /// Implements `Owned` for rows with the view [`TextRef`] and the owned type [`Text`], which
    /// keeps the bytes after the text.
    macro_rules! texts {
        ($(
            [$($generics:tt)*] $row:ty, at most $max:ident,
            any $u:ident, $len:ident => $any:expr;
        )+) => { $(
            impl<$($generics)*> Owned for $row {
                type Type = Text;

                #[inline]
                fn own(view: TextRef<'_>) -> Text {
                    view.into()
                }

                #[inline]
                fn lend(owned: &Text) -> TextRef<'_> {
                    owned.as_ref()
                }

                #[cfg(feature = "binrw")]
                fn pull(from: &mut impl Pull) -> binrw::io::Result<()> {
                    from.rest($max)
                }

                #[cfg(feature = "arbitrary")]
                fn any($u: Any<'_, '_>, room: usize) -> arbitrary::Result<Text> {
                    let $len = room.saturating_add(Self::LEAST).min(to_usize($max));
                    $any
                }
            }
        )+ };
    }

    texts! {
        [const MIN: u32, const MAX: u32] TextAndTail<MIN, MAX>, at most MAX,
            any u, len => if MIN == 0 && u.arbitrary()? { nothing() } else { open(u, len, false) };
        [const MAX: u32, const IS_OPTIONAL: bool] CString<MAX, IS_OPTIONAL>, at most MAX,
            any u, len => if IS_OPTIONAL && u.arbitrary()? { nothing() } else { ended(u, len, true) };
        [const MAX: u32] OptionalNul<MAX>, at most MAX,
            any u, len => open(u, len, true);
    }

    impl<R> Owned for KindText<R>
    where
        R: for<'a> Row<View<'a> = TextRef<'a>> + Owned<Type = Text>,
    {
        type Type = Text;

        #[inline]
        fn own(view: Kind<'_>) -> Text {
            R::own(view.field())
        }

        #[inline]
        fn lend(owned: &Text) -> Kind<'_> {
            Kind::from_field(owned.as_ref())
        }

        #[cfg(feature = "binrw")]
        fn pull(from: &mut impl Pull) -> binrw::io::Result<()> {
            R::pull(from)
        }

        #[cfg(feature = "arbitrary")]
        fn any(u: Any<'_, '_>, room: usize) -> arbitrary::Result<Text> {
            R::any(u, room)
        }
    }

    impl<const MAX: u32> Owned for CStringPrefix<MAX> {
        type Type = CncString;

        #[inline]
        fn own(view: CncStr<'_>) -> CncString {
            view.into()
        }

        #[inline]
        fn lend(owned: &CncString) -> CncStr<'_> {
            owned.as_cnc_str()
        }

        #[cfg(feature = "binrw")]
        fn pull(from: &mut impl Pull) -> binrw::io::Result<()> {
            from.until_nul(MAX)
        }

        #[cfg(feature = "arbitrary")]
        fn any(u: Any<'_, '_>, room: usize) -> arbitrary::Result<CncString> {
            text(u, room.min(to_usize(MAX).saturating_sub(1)))
        }
    }
}
