//! The kinds of rows that tables of streams have: how each is read, checked and written.

use core::marker::PhantomData;

use crate::bytes::{Reader, Writer, to_u32, to_usize};
use crate::error::{Error, ErrorKind};
use crate::layout::{Field, Size, Type};
use crate::text::{CncStr, TextRef};
use crate::variable::{Kind, U32List};

/// A kind of row.
///
/// The fixed rows that a stream begins with are its head. They are read after one check of the
/// length, each at the offset that the table prints.
pub(crate) trait Row {
    /// Its type in a view.
    type View<'a>: Copy;
    const SIZE: Size;
    const TYPE: Type;
    /// Whether a fixed row may be rejected.
    const REJECTS: bool = false;

    /// Reads the row, which begins `at` this offset.
    fn read<'a>(
        input: &mut Reader<'a>,
        head: &'a [u8],
        field: Field,
        at: usize,
    ) -> Result<Self::View<'a>, Error>;
    /// Bytes that it is encoded to, a count included.
    fn len(view: Self::View<'_>) -> usize;
    /// Rejects what `read` would reject; the row, a count included, begins at `at`.
    #[inline]
    fn check(_: Self::View<'_>, _: Field, _at: usize) -> Result<(), Error> {
        Ok(())
    }
    /// Writes what is of the head.
    fn write_head(_: Self::View<'_>, _head: &mut [u8], _at: usize) {}
    /// Writes what is not.
    fn write(_: Self::View<'_>, _: &mut Writer<'_>) {}
}

/// The bytes of a head at an offset. They are there: `stream!` checks where its rows are.
#[inline(always)]
fn part<const N: usize>(head: &[u8], at: usize) -> [u8; N] {
    head.get(at..).and_then(<[u8]>::first_chunk).copied().unwrap_or([0; N])
}

#[inline(always)]
fn put<const N: usize>(head: &mut [u8], at: usize, bytes: [u8; N]) {
    if let Some(part) = head.get_mut(at..).and_then(<[u8]>::first_chunk_mut) {
        *part = bytes;
    }
}

/// The number before an offset: the count of a list.
#[inline(always)]
fn count(head: &[u8], at: usize) -> u32 {
    u32::from_le_bytes(part(head, at.saturating_sub(4)))
}

#[inline(always)]
fn put_count(head: &mut [u8], at: usize, count: usize) {
    put(head, at.saturating_sub(4), to_u32(count).to_le_bytes());
}

/// A number on the wire.
pub(crate) trait Int: Copy {
    const SIZE: u32;
    const TYPE: Type;

    fn read(head: &[u8], at: usize) -> Self;
    fn write(self, head: &mut [u8], at: usize);
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
        }
    )+ };
}

ints! { u8 1 Uns08; u16 2 Uns16; u32 4 Uns32; }

/// A number `N`, as a `T`.
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

/// A BOOLEAN, as a `T`: any value but 0 is TRUE, and is kept.
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

/// A UNS32 that is not 0.
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

/// A count, which has a row of its own, and as many UNS32.
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
        match count > MAX {
            true => Err(Error::new(ErrorKind::TooMany, field.before(), to_u32(at), MAX, count)),
            false => Ok(()),
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

/// A length, which has a row of its own, and as many bytes.
pub(crate) struct Data<const MAX: u32>;

impl<const MAX: u32> Row for Data<MAX> {
    type View<'a> = &'a [u8];
    const SIZE: Size = Size::Items { each: 1, max: MAX };
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

/// The bytes that are left. Their maximum is that of the stream.
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
        match view.len() < to_usize(MIN) {
            true => {
                Err(Error::new(ErrorKind::Truncated, field, to_u32(at), MIN, to_u32(view.len())))
            }
            false => Ok(()),
        }
    }

    #[inline]
    fn write(view: &[u8], out: &mut Writer<'_>) {
        out.put(view);
    }
}

/// Text that a NUL or the end of the stream ends. Bytes after the NUL are kept.
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

/// Text that a NUL must end; more NULs may pad it. If it `IS_OPTIONAL`, no bytes are empty text.
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
        match IS_OPTIONAL && input.is_empty() {
            true => Ok(TextRef::with_tail(CncStr::EMPTY, None)),
            false => input.cstring(field, MAX),
        }
    }

    #[inline]
    fn len(view: TextRef<'_>) -> usize {
        view.field_len()
    }

    #[inline]
    fn check(view: TextRef<'_>, field: Field, at: usize) -> Result<(), Error> {
        match IS_OPTIONAL && view.field_len() == 0 {
            true => Ok(()),
            false => view.check_cstring(field, to_u32(at), MAX).map(drop),
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

/// Text that a NUL may end; more NULs may pad it.
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

/// Text that a NUL must end, and more of the stream after it.
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
pub(crate) use owned::Owned;

#[cfg(feature = "alloc")]
mod owned {
    use alloc::vec::Vec;

    #[cfg(feature = "arbitrary")]
    use super::any::{Any, ended, min, nothing, open, text, up_to};
    use super::*;
    #[cfg(feature = "binrw")]
    use crate::io::Pull;
    use crate::text::{CncString, Text};

    /// A kind of row in a type that owns its data.
    pub(crate) trait Owned: Row {
        type Type;
        /// The fewest bytes that it is encoded to.
        #[cfg(feature = "arbitrary")]
        const LEAST: usize;

        fn own(view: Self::View<'_>) -> Self::Type;
        fn lend(owned: &Self::Type) -> Self::View<'_>;
        /// Takes the row's bytes from a reader; `read` rejects what is wrong with them.
        #[cfg(feature = "binrw")]
        fn pull(from: &mut impl Pull) -> binrw::io::Result<()>;
        /// A value that a stream can have, with at most `room` bytes beyond the fewest.
        #[cfg(feature = "arbitrary")]
        fn any(u: Any<'_, '_>, room: usize) -> arbitrary::Result<Self::Type>;
    }

    /// Rows that are the same in a view.
    macro_rules! numbers {
        ($( [$($generics:tt)*] $row:ty, $type:ty, [$($where:tt)*] $size:expr, any $u:ident => $any:expr; )+) => { $(
            impl<$($generics)*> Owned for $row where $($where)* {
                type Type = $type;
                #[cfg(feature = "arbitrary")]
                const LEAST: usize = $size;

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

    /// Numbers of which arbitrary ones can be made.
    #[cfg(feature = "arbitrary")]
    pub(crate) trait AnyInt: Int + for<'a> arbitrary::Arbitrary<'a> {}
    #[cfg(feature = "arbitrary")]
    impl<N: Int + for<'a> arbitrary::Arbitrary<'a>> AnyInt for N {}
    #[cfg(not(feature = "arbitrary"))]
    pub(crate) trait AnyInt: Int {}
    #[cfg(not(feature = "arbitrary"))]
    impl<N: Int> AnyInt for N {}

    numbers! {
        [N: AnyInt + From<T>, T: Copy + From<N>] Number<N, T>, T, [] size_of::<N>(),
            any u => u.arbitrary::<N>().map(T::from);
        [T: Copy + From<u8>] Boolean<T>, T, [u8: From<T>] 1, any u => u.arbitrary::<u8>().map(T::from);
        [] NonZero, u32, [] 4, any u => Ok(u.arbitrary::<u32>()?.max(1));
    }

    impl<const MAX: u32> Owned for List<MAX> {
        type Type = Vec<u32>;
        #[cfg(feature = "arbitrary")]
        const LEAST: usize = 4;

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

    /// Rows that are bytes.
    macro_rules! bytes {
        ($(
            [$($generics:tt)*] $row:ty, least $least:expr, pull $from:ident => $pull:expr,
            any $u:ident, $room:ident => $any:expr;
        )+) => { $(
            impl<$($generics)*> Owned for $row {
                type Type = Vec<u8>;
                #[cfg(feature = "arbitrary")]
                const LEAST: usize = $least;

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
        [const MAX: u32] Data<MAX>, least 4, pull from => from.counted(1, MAX),
            any u, room => up_to(u, room.min(to_usize(MAX)));
        [const MIN: u32, const MAX: u32] Rest<MIN, MAX>, least min(MIN), pull from => from.rest(MAX),
            any u, room => {
                let mut bytes: Vec<u8> = up_to(u, room.saturating_add(Self::LEAST).min(to_usize(MAX)))?;
                bytes.resize(bytes.len().max(Self::LEAST), 0);
                Ok(bytes)
            };
    }

    /// Rows that are text with what follows its NUL.
    macro_rules! texts {
        ($(
            [$($generics:tt)*] $row:ty, least $least:expr, at most $max:ident,
            any $u:ident, $len:ident => $any:expr;
        )+) => { $(
            impl<$($generics)*> Owned for $row {
                type Type = Text;
                #[cfg(feature = "arbitrary")]
                const LEAST: usize = $least;

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
        [const MIN: u32, const MAX: u32] TextAndTail<MIN, MAX>, least min(MIN), at most MAX,
            any u, len => if MIN == 0 && u.arbitrary()? { nothing() } else { open(u, len, false) };
        [const MAX: u32, const IS_OPTIONAL: bool] CString<MAX, IS_OPTIONAL>, least 1, at most MAX,
            any u, len => if IS_OPTIONAL && u.arbitrary()? { nothing() } else { ended(u, len, true) };
        [const MAX: u32] OptionalNul<MAX>, least 1, at most MAX,
            any u, len => open(u, len, true);
    }

    impl<R> Owned for KindText<R>
    where
        R: for<'a> Row<View<'a> = TextRef<'a>> + Owned<Type = Text>,
    {
        type Type = Text;
        #[cfg(feature = "arbitrary")]
        const LEAST: usize = R::LEAST;

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
        #[cfg(feature = "arbitrary")]
        const LEAST: usize = 1;

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

/// Parts of arbitrary values.
#[cfg(feature = "arbitrary")]
pub(crate) mod any {
    use alloc::vec::Vec;

    use crate::text::{CncString, Text};

    pub(super) type Any<'u, 'a> = &'u mut arbitrary::Unstructured<'a>;

    /// At most so many of anything.
    pub(crate) fn up_to<T: for<'a> arbitrary::Arbitrary<'a>>(
        u: Any<'_, '_>,
        max: usize,
    ) -> arbitrary::Result<Vec<T>> {
        let len = u.arbitrary_len::<T>()?.min(max);
        (0..len).map(|_| u.arbitrary()).collect()
    }

    /// Text of at most so many bytes.
    pub(crate) fn text(u: Any<'_, '_>, max: usize) -> arbitrary::Result<CncString> {
        let mut bytes: Vec<u8> = up_to(u, max)?;
        bytes.retain(|&byte| byte != 0);
        Ok(CncString::without_nul(bytes))
    }

    /// Text and its NUL, followed by NULs if it `is_padded`, else by anything.
    pub(crate) fn ended(u: Any<'_, '_>, max: usize, is_padded: bool) -> arbitrary::Result<Text> {
        let text = text(u, max.saturating_sub(1))?;
        let left = max.saturating_sub(1).saturating_sub(text.as_bytes().len());
        let mut tail = up_to(u, left)?;
        if is_padded {
            tail.fill(0);
        }
        Ok(Text { text, tail: Some(tail) })
    }

    /// The same, or without the NUL.
    pub(crate) fn open(u: Any<'_, '_>, max: usize, is_padded: bool) -> arbitrary::Result<Text> {
        let ended = ended(u, max, is_padded)?;
        let is_open = !ended.text.as_bytes().is_empty() && u.arbitrary()?;
        Ok(Text { tail: ended.tail.filter(|_| !is_open), ..ended })
    }

    /// The fewest bytes, which are none or one.
    pub(super) const fn min(min: u32) -> usize {
        assert!(min <= 1);
        if min == 0 { 0 } else { 1 }
    }

    pub(crate) fn nothing() -> arbitrary::Result<Text> {
        Ok(Text { text: CncString::default(), tail: None })
    }

    #[test]
    fn the_fewest_bytes_are_none_or_one() {
        assert_eq!([min(0), min(1)], [0, 1]);
    }
}
