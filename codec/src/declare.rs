//! The declaration of a stream, in the form of a table like those in the manuals. From it, the
//! macro `stream!` generates the field table and the types of the stream, with trait
//! implementations and documentation. For `packed`, it only generates the table and a type for the
//! bytes of the stream.

#[cfg(feature = "arbitrary")]
use crate::rows::Owned;

/// The kinds of rows. The first lines define the size and the type of a row in its field table, and
/// the rows of `packed` types. The lines that begin with `$q` define the type of the row in a
/// borrowed type (a view) and in an owned type, the implementation of `Row`, and the documented
/// size and type; the last of them rejects any other kind. The lines that begin with `@` select one
/// of these items. `as` selects a Rust type for a number, or `Kind` for a text.
macro_rules! row {
    (size (NETID)) => { $crate::layout::Size::Fixed(6) };
    (size (OPTIONAL_UNS32 as $t:ident)) => { $crate::layout::Size::OptionalFixed(4) };
    (size (PADDED $n:literal)) => { $crate::layout::Size::Padded($n) };
    (size $kind:tt) => { <$crate::declare::row!(row $kind 'static) as $crate::rows::Row>::SIZE };
    (type (NETID)) => { $crate::layout::Type::NetId };
    (type (PADDED $n:literal)) => { $crate::layout::Type::String };
    (type $kind:tt) => { <$crate::declare::row!(row $kind 'static) as $crate::rows::Row>::TYPE };
    (doc (NETID) $a:lifetime) => { "6 | `BYTE[6]`" };
    (doc (PADDED $n:literal) $a:lifetime) => { concat!($n, " | `STRING`") };
    (packed (UNS08) $a:lifetime) => { u8 };
    (packed (UNS16) $a:lifetime) => { zerocopy::little_endian::U16 };
    (packed (UNS32) $a:lifetime) => { zerocopy::little_endian::U32 };
    (packed (NETID) $a:lifetime) => { [u8; 6] };
    (packed (PADDED $n:literal) $a:lifetime) => { [u8; $n] };
    (serde (NETID) $a:lifetime) => { $crate::ads::AmsNetId };
    (serde (PADDED $n:literal) $a:lifetime) => { $crate::serial::Padded<$n> };
    ($q:ident (UNS08) $a:lifetime) => { $crate::declare::row!(@$q [u8] [u8] [Number<u8, u8>] "1 | `UNS08`") };
    ($q:ident (UNS16) $a:lifetime) => { $crate::declare::row!(@$q [u16] [u16] [Number<u16, u16>] "2 | `UNS16`") };
    ($q:ident (UNS16 as $t:ident) $a:lifetime) => { $crate::declare::row!(@$q [$t] [$t] [Number<u16, $t>] "2 | `UNS16`") };
    ($q:ident (UNS32) $a:lifetime) => { $crate::declare::row!(@$q [u32] [u32] [Number<u32, u32>] "4 | `UNS32`") };
    ($q:ident (UNS32 as $t:ident) $a:lifetime) => { $crate::declare::row!(@$q [$t] [$t] [Number<u32, $t>] "4 | `UNS32`") };
    ($q:ident (OPTIONAL_UNS32 as $t:ident) $a:lifetime) => { $crate::declare::row!(@$q [$t] [$t] [Number<u32, $t>] "4, or no byte in the stream | `UNS32`") };
    ($q:ident (UNS32_NON_ZERO) $a:lifetime) => { $crate::declare::row!(@$q [u32] [u32] [NonZero] "4 | `UNS32`, not 0") };
    ($q:ident (BOOLEAN) $a:lifetime) => { $crate::declare::row!(@$q [u8] [u8] [Boolean<u8>] "1 | `BOOLEAN`") };
    ($q:ident (LIST $max:literal) $a:lifetime) => { $crate::declare::row!(@$q [$crate::U32List<$a>] [alloc::vec::Vec<u32>] [List<$max>] "4 each, at most ", $max, " | `UNS32`") };
    ($q:ident (DATA) $a:lifetime) => { $crate::declare::row!(@$q [&$a [u8]] [alloc::vec::Vec<u8>] [Data] "at most ", $crate::declare::stream!(@shown ADS_DATA), " | `BYTE[]`") };
    ($q:ident (REST $min:literal $max:tt) $a:lifetime) => { $crate::declare::row!(@$q [&$a [u8]] [alloc::vec::Vec<u8>] [Rest<$min, { $crate::declare::stream!(@max $max) }>] $min, " … ", $crate::declare::stream!(@shown $max), " | `BYTE[]`") };
    ($q:ident (TEXT_AND_TAIL $min:literal $max:literal) $a:lifetime) => { $crate::declare::row!(@$q [$crate::TextRef<$a>] [$crate::text::Text] [TextAndTail<$min, $max>] $min, " … ", $max, " | `STRING`") };
    ($q:ident (CSTRING $max:literal) $a:lifetime) => { $crate::declare::row!(@$q [$crate::TextRef<$a>] [$crate::text::Text] [CString<$max, false>] "1 … ", $max, " with NUL | `STRING`") };
    ($q:ident (CSTRING $max:literal as Kind) $a:lifetime) => { $crate::declare::row!(@$q [$crate::Kind<$a>] [$crate::text::Text] [KindText<$crate::rows::CString<$max, false>>] "1 … ", $max, " with NUL | `STRING`") };
    ($q:ident (OPTIONAL_CSTRING $max:literal as Kind) $a:lifetime) => { $crate::declare::row!(@$q [$crate::Kind<$a>] [$crate::text::Text] [KindText<$crate::rows::CString<$max, true>>] "1 … ", $max, " with NUL, or 0 | `STRING`") };
    ($q:ident (OPTIONAL_NUL $max:literal) $a:lifetime) => { $crate::declare::row!(@$q [$crate::TextRef<$a>] [$crate::text::Text] [OptionalNul<$max>] "1 … ", $max, " | `STRING`") };
    ($q:ident (CSTRING_PREFIX $max:literal) $a:lifetime) => { $crate::declare::row!(@$q [$crate::CncStr<$a>] [$crate::text::CncString] [CStringPrefix<$max>] "1 … ", $max, " with NUL | `STRING`") };
    (@view [$($view:tt)*] $o:tt $r:tt $($doc:tt)*) => { $($view)* };
    (@serde [$($view:tt)*] $o:tt $r:tt $($doc:tt)*) => { $($view)* };
    (@owned $v:tt [$($owned:tt)*] $r:tt $($doc:tt)*) => { $($owned)* };
    (@row $v:tt $o:tt [$($row:tt)*] $($doc:tt)*) => { $crate::rows::$($row)* };
    (@doc $v:tt $o:tt $r:tt $($doc:tt)*) => { concat!($($doc)*) };
    ($q:ident ($($row:tt)+) $a:lifetime) => {
        compile_error!(concat!("`", stringify!($($row)+), "` is not a kind of row: see `row!` in src/declare.rs"))
    };
}

/// Declares a stream from its table.
///
/// | | declares |
/// |---|---|
/// | `struct XRef<'a> / X` | a type that borrows its data, and a type that owns its data |
/// | `struct X` | one type with a field for each number |
/// | `tuple X` | one type with a single number |
/// | `packed XLayout` | the bytes of a stream of fixed length whose type is written by hand |
///
/// A row consists of the offset, the field, its name in errors and golden vectors if that differs,
/// the kind of row, the requirement and the meaning. The offset is, for example, `@20 + 4m` after
/// `m` counted items of 4 bytes, and `@1 + text` after a text and its NUL. The row before a list,
/// or before data with a length, is its `count`.
macro_rules! stream {
    (
        $(#[$doc:meta])*
        $stream:ident $name:literal, $title:literal, $clause:literal, max $max:tt;
        $what:ident $view:ident $(<$a:lifetime> / $owned:ident)? { $(
            $( count @$count_at:literal $(+ $count_per:tt)? $count:ident, $count_clause:literal, $count_meaning:literal; )?
            @$at:literal $(+ $per:tt)? $field:ident $($label:literal)?: $kind:ident $(( $($arg:tt),+ ))? $(as $new:ident)?,
                $field_clause:literal, $meaning:literal;
        )+ }
    ) => {
        $crate::declare::stream! { @types $what $view $(/ $owned)?
            [$(#[$doc])*]
            [$(
                $( [$count_at, [$($count_per)?], [$count], "4 | `UNS32`", $count_clause, $count_meaning] )?
                [$at, [$($per)?], [$field $($label)?],
                    $crate::declare::row!(doc ($kind $($($arg)+)? $(as $new)?) 'static), $field_clause, $meaning]
            )+]
            [$title, $max]
            [$( [$field [$field $($label)?] ($(rename = $label)?) $at ($kind $($($arg)+)? $(as $new)?)
                [$crate::declare::row!(row ($kind $($($arg)+)? $(as $new)?) 'static)] $meaning] )+]
        }

        impl $crate::layout::Declared for $crate::declare::stream!(@type $view $(/ $owned)?) {
            const STREAM: $crate::layout::Stream = $crate::layout::Stream::$stream;
            const LAYOUT: $crate::layout::Layout = $crate::layout::Layout {
                name: $name,
                title: $title,
                clause: $clause,
                max: $crate::declare::stream!(@max $max),
                repeats: false,
                fields: &[$(
                    $( $crate::layout::FieldSpec {
                        name: stringify!($count),
                        offset: $count_at,
                        per_item: 0 $(+ $crate::declare::stream!(@per $count_per))?,
                        size: $crate::layout::Size::Fixed(4),
                        ty: $crate::layout::Type::Uns32,
                        clause: $count_clause,
                        meaning: $count_meaning,
                    }, )?
                    $crate::layout::FieldSpec {
                        name: $crate::declare::stream!(@name [$field $($label)?]),
                        offset: $at,
                        per_item: 0 $(+ $crate::declare::stream!(@per $per))?,
                        size: $crate::declare::row!(size ($kind $($($arg)+)? $(as $new)?)),
                        ty: $crate::declare::row!(type ($kind $($($arg)+)? $(as $new)?)),
                        clause: $field_clause,
                        meaning: $meaning,
                    },
                )+],
            };
        }

        const _: () = {
            type Type = $crate::declare::stream!(@static $view $(/ $owned)?);
            assert!(
                <Type as $crate::layout::Declared>::LAYOUT.is_headed(),
                "a row of fixed size follows a row of variable size",
            );
            assert!(
                <Type as $crate::layout::Declared>::LAYOUT.is_filled(),
                "the maximum of a row does not fill the maximum length of the stream",
            );
            $(
                $( assert!(
                    <Type as $crate::layout::Declared>::LAYOUT.is_at(stringify!($count)),
                    concat!("`", stringify!($count), "` does not begin where the rows before it end"),
                ); )?
                assert!(
                    <Type as $crate::layout::Declared>::LAYOUT
                        .is_at($crate::declare::stream!(@name [$field $($label)?])),
                    concat!("`", stringify!($field), "` does not begin where the rows before it end"),
                );
            )+
        };
    };

    (@type $view:ident / $owned:ident) => { $view<'_> };
    (@type $view:ident) => { $view };
    (@static $view:ident / $owned:ident) => { $view<'static> };
    (@static $view:ident) => { $view };

    // `struct X`: one type with a field for each number.
    (@types struct $view:ident
        [$(#[$doc:meta])*] $table:tt [$title:literal, $max:literal]
        [$( [$field:ident $label:tt $renamed:tt $at:literal $kind:tt [$row:ty] $meaning:literal] )+]
    ) => {
        $crate::declare::stream! { @documented [$(#[$doc])*] $table ["", $max]
            #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
            #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
            #[cfg_attr(feature = "binrw", derive(binrw::BinRead, binrw::BinWrite), brw(little),
                bw(assert(
                    $crate::io::check(&$view { $( $field: *$field ),+ }).is_ok(),
                    $crate::io::error(&$view { $( $field: *$field ),+ }))))]
            pub struct $view { $(
                #[doc = $meaning]
                #[cfg_attr(feature = "serde", serde $renamed)]
                #[cfg_attr(feature = "binrw",
                    br(parse_with = $crate::io::parse::<$row, _>,
                        args(<$view as $crate::layout::Declared>::STREAM,
                        const { $crate::layout::Field::of::<$view>($crate::declare::stream!(@name $label)) })),
                    bw(write_with = $crate::io::emit::<$row, _>))]
                pub $field: $crate::declare::row!(view $kind 'static),
            )+ }
        }
        $crate::declare::stream! { @numbers $view $max { $( $field ),+ } [$( [$field $label $at [$row] $field] )+] }
        $crate::declare::stream! { @to_bytes () $view $max [$( [$at [$row] $field] )+] }
    };

    // `tuple X`: one type with a single number.
    (@types tuple $view:ident
        [$(#[$doc:meta])*] $table:tt [$title:literal, $max:literal]
        [[$field:ident $label:tt $renamed:tt $at:literal $kind:tt [$row:ty] $meaning:literal]]
    ) => {
        $crate::declare::stream! { @documented [$(#[$doc])*] $table ["", $max]
            #[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
            #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
            #[cfg_attr(feature = "binrw", derive(binrw::BinRead, binrw::BinWrite), brw(little),
                bw(assert(
                    $crate::io::check(&$view(*self_0)).is_ok(),
                    $crate::io::error(&$view(*self_0)))))]
            pub struct $view(
                #[cfg_attr(feature = "binrw",
                    br(parse_with = $crate::io::parse::<$row, _>,
                        args(<$view as $crate::layout::Declared>::STREAM,
                        const { $crate::layout::Field::of::<$view>($crate::declare::stream!(@name $label)) })),
                    bw(write_with = $crate::io::emit::<$row, _>))]
                pub $crate::declare::row!(view $kind 'static),
            );
        }
        $crate::declare::stream! { @numbers $view $max ( $field ) [[$field $label $at [$row] 0]] }
        $crate::declare::stream! { @to_bytes $kind $view $max [[$at [$row] 0]] }
    };

    // `packed XLayout`: numbers, NetIds and texts of fixed length, as the bytes on the wire.
    (@types packed $view:ident
        [$(#[$doc:meta])*] $table:tt [$title:literal, $max:literal]
        [$( [$field:ident $label:tt $renamed:tt $at:literal $kind:tt [$row:ty] $meaning:literal] )+]
    ) => {
        $(#[$doc])*
        #[derive(Clone, Copy, PartialEq, Eq, Hash)]
        #[derive(zerocopy::FromBytes, zerocopy::IntoBytes, zerocopy::KnownLayout)]
        #[derive(zerocopy::Immutable, zerocopy::Unaligned)]
        #[repr(C)]
        pub(crate) struct $view { $( pub(crate) $field: $crate::declare::row!(packed $kind 'static), )+ }

        const _: () = assert!(size_of::<$view>() == $max, "the rows do not have the length of the stream");

        #[cfg(feature = "serde")]
        const _: () = {
            #[derive(serde::Serialize, serde::Deserialize)]
            #[serde(expecting = $title)]
            struct Rows { $(
                #[serde $renamed]
                $field: $crate::declare::row!(serde $kind 'static),
            )+ }

            impl serde::Serialize for $view {
                fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                    Rows { $( $field: self.$field.into() ),+ }.serialize(serializer)
                }
            }

            impl<'de> serde::Deserialize<'de> for $view {
                fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                    let rows = Rows::deserialize(deserializer)?;
                    Ok(Self { $( $field: rows.$field.into() ),+ })
                }
            }
        };
    };

    // No `to_bytes` for this kind of row, because `encode` may reject its number.
    (@to_bytes (UNS32_NON_ZERO) $view:ident $max:literal $rows:tt) => {};
    (@to_bytes $kind:tt $view:ident $max:literal [$( [$at:literal [$row:ty] $member:tt] )+]) => {
        impl $view {
            /// Encodes the stream to an array, with the bytes that [`encode`](crate::Encode::encode)
            /// writes.
            #[must_use]
            pub fn to_bytes(&self) -> [u8; $max] {
                const { assert!($( !<$row as $crate::rows::Row>::REJECTS )&&+, "a row rejects numbers") };
                let mut bytes = [0; $max];
                $( <$row as $crate::rows::Row>::write_head(self.$member, &mut bytes, $at); )+
                bytes
            }
        }
    };

    (@numbers $view:ident $max:literal $built:tt [$( [$field:ident $label:tt $at:literal [$row:ty] $member:tt] )+]) => {
        const _: () = assert!(
            <$view as $crate::layout::Declared>::LAYOUT.head() == $max,
            "the rows do not have the length of the stream",
        );

        impl<'a> $crate::stream::Decode<'a> for $view {
            const STREAM: $crate::layout::Stream = <Self as $crate::layout::Declared>::STREAM;

            fn decode(bytes: &'a [u8]) -> Result<Self, $crate::error::Error> {
                let stream = <Self as $crate::layout::Declared>::STREAM;
                let mut input = $crate::bytes::Reader::without_limit(stream, &[]);
                let head: &[u8; $max] = match $crate::bytes::Reader::exact(stream, bytes) {
                    Ok(head) => head,
                    Err(error) => {
                        // The error of a row takes precedence over the error for bytes after the last row.
                        if let Some(head) = bytes.first_chunk::<$max>() { $(
                            if <$row as $crate::rows::Row>::REJECTS {
                                let field = const { $crate::layout::Field::of::<Self>($crate::declare::stream!(@name $label)) };
                                <$row as $crate::rows::Row>::read(&mut input, head, field, $at)?;
                            }
                        )+ }
                        return Err(error);
                    }
                };
                $( let $field = <$row as $crate::rows::Row>::read(
                    &mut input,
                    head,
                    const { $crate::layout::Field::of::<Self>($crate::declare::stream!(@name $label)) },
                    $at,
                )?; )+
                Ok($view $built)
            }
        }

        impl $crate::stream::Encode for $view {
            fn encoded_len(&self) -> usize {
                $max
            }

            fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], $crate::error::Error> {
                $( <$row as $crate::rows::Row>::check(
                    self.$member,
                    const { $crate::layout::Field::of::<Self>($crate::declare::stream!(@name $label)) },
                    $at,
                )?; )+
                let mut head = [0; $max];
                $( <$row as $crate::rows::Row>::write_head(self.$member, &mut head, $at); )+
                $crate::bytes::Writer::copy(<Self as $crate::layout::Declared>::STREAM, &head, buf)
            }
        }

        #[cfg(feature = "arbitrary")]
        impl<'u> arbitrary::Arbitrary<'u> for $view {
            fn arbitrary(u: &mut arbitrary::Unstructured<'u>) -> arbitrary::Result<Self> {
                $( let $field = <$row as $crate::rows::Owned>::any(u, 0)?; )+
                Ok($view $built)
            }
        }
    };

    (@documented
        [$(#[$doc:meta])*]
        [$( [$at:literal, $per:tt, $row_label:tt, $kind_doc:expr, $clause:literal, $row_meaning:literal] )+]
        [$length:literal, $max:tt] $item:item
    ) => {
        $(#[$doc])*
        ///
        #[doc = concat!($length, $crate::declare::stream!(@shown $max), " bytes:\n")]
        /// | offset | size | type | field | meaning | requirement |
        /// |---|---|---|---|---|---|
        $( #[doc = concat!(
            "| ", $at, $crate::declare::stream!(@after $per), " | ", $kind_doc, " | `", $crate::declare::stream!(@name $row_label), "` | ",
            $row_meaning, " | ", $clause, " |",
        )] )+
        $item
    };

    (@encoded $view:ident [$( [$label:tt $at:literal [$row:ty] $member:tt] )+]) => {
        impl $crate::stream::Encode for $view<'_> {
            fn encoded_len(&self) -> usize {
                let len = 0_usize;
                $( let len = len.saturating_add(
                    <$row as $crate::rows::Row>::len(self.$member),
                ); )+
                len
            }

            fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], $crate::error::Error> {
                let len = 0_usize;
                $(
                    <$row as $crate::rows::Row>::check(
                        self.$member,
                        const { $crate::layout::Field::of::<Self>($crate::declare::stream!(@name $label)) },
                        len,
                    )?;
                    let len = len.saturating_add(
                        <$row as $crate::rows::Row>::len(self.$member),
                    );
                )+
                let stream = <Self as $crate::layout::Declared>::STREAM;
                $crate::bytes::Writer::run(stream, len, buf, |out| {
                    let mut head = [0; <$view<'static> as $crate::layout::Declared>::LAYOUT.head()];
                    $( <$row as $crate::rows::Row>::write_head(self.$member, &mut head, $at); )+
                    out.array(head);
                    $( <$row as $crate::rows::Row>::write(self.$member, out); )+
                })
            }
        }
    };

    // `struct XRef<'a> / X`: a type that borrows its data, and a type that owns its data.
    (@types struct $view:ident / $owned:ident
        [$(#[$doc:meta])*] $table:tt [$title:literal, $max:tt]
        [$( [$field:ident $label:tt $renamed:tt $at:literal $kind:tt [$row:ty] $meaning:literal] )+]
    ) => {
        $crate::declare::stream! { @documented [$(#[$doc])*] $table ["At most ", $max]
            #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
            pub struct $view<'a> { $(
                #[doc = $meaning]
                pub $field: $crate::declare::row!(view $kind 'a),
            )+ }
        }

        impl<'a> $crate::stream::Decode<'a> for $view<'a> {
            const STREAM: $crate::layout::Stream = <Self as $crate::layout::Declared>::STREAM;

            fn decode(bytes: &'a [u8]) -> Result<Self, $crate::error::Error> {
                let mut input = $crate::bytes::Reader::new(<Self as $crate::layout::Declared>::STREAM, bytes)?;
                let head = input.head::<{ <$view<'static> as $crate::layout::Declared>::LAYOUT.head() }>()?;
                $( let $field = <$row as $crate::rows::Row>::read(
                    &mut input,
                    head,
                    const { $crate::layout::Field::of::<Self>($crate::declare::stream!(@name $label)) },
                    $at,
                )?; )+
                input.finish()?;
                Ok(Self { $( $field ),+ })
            }
        }

        $crate::declare::stream! { @encoded $view [$( [$label $at [$row] $field] )+] }

        #[cfg(feature = "alloc")]
        #[doc = concat!("[`", stringify!($view), "`], owned.")]
        #[derive(Clone, Debug, PartialEq, Eq, Hash)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        #[cfg_attr(feature = "binrw", derive(binrw::BinRead, binrw::BinWrite), brw(little),
            br(assert(
                $crate::io::check(&$view { $( $field: <$row as $crate::rows::Owned>::lend(&$field) ),+ }).is_ok(),
                $crate::io::error(&$view { $( $field: <$row as $crate::rows::Owned>::lend(&$field) ),+ }))),
            bw(assert(
                $crate::io::check(&$view { $( $field: <$row as $crate::rows::Owned>::lend($field) ),+ }).is_ok(),
                $crate::io::error(&$view { $( $field: <$row as $crate::rows::Owned>::lend($field) ),+ }))))]
        pub struct $owned { $(
            #[doc = $meaning]
            #[cfg_attr(feature = "serde", serde $renamed)]
            #[cfg_attr(feature = "binrw",
                br(parse_with = $crate::io::parse::<$row, _>,
                    args(<$view<'static> as $crate::layout::Declared>::STREAM,
                        const { $crate::layout::Field::of::<$view<'static>>($crate::declare::stream!(@name $label)) })),
                bw(write_with = $crate::io::emit::<$row, _>))]
            pub $field: $crate::declare::row!(owned $kind 'static),
        )+ }

        #[cfg(feature = "alloc")]
        const _: () = {
            impl $owned {
                /// Borrows the fields.
                #[inline]
                pub fn as_ref(&self) -> $view<'_> {
                    $view { $( $field: <$row as $crate::rows::Owned>::lend(&self.$field), )+ }
                }
            }

            impl $view<'_> {
                /// Copies the fields.
                pub fn to_owned(&self) -> $owned {
                    $owned { $( $field: <$row as $crate::rows::Owned>::own(self.$field), )+ }
                }
            }

            impl From<$view<'_>> for $owned {
                fn from(view: $view<'_>) -> Self {
                    view.to_owned()
                }
            }

            impl $crate::stream::Decode<'_> for $owned {
                const STREAM: $crate::layout::Stream = <$view<'static> as $crate::layout::Declared>::STREAM;

                fn decode(bytes: &[u8]) -> Result<Self, $crate::error::Error> {
                    <$view<'_> as $crate::stream::Decode<'_>>::decode(bytes).map(Self::from)
                }
            }

            $crate::stream::encode_as_ref!($owned);

            #[cfg(feature = "arbitrary")]
            impl<'u> arbitrary::Arbitrary<'u> for $owned {
                fn arbitrary(u: &mut arbitrary::Unstructured<'u>) -> arbitrary::Result<Self> {
                    let room = <$view<'_> as $crate::layout::Declared>::LAYOUT.room();
                    $(
                        let $field = <$row as $crate::rows::Owned>::any(u, room)?;
                        let room = room.saturating_sub($crate::declare::used::<$row>(&$field));
                    )+
                    let _left = room;
                    Ok(Self { $( $field ),+ })
                }
            }
        };
    };

    (@name [$field:ident]) => { stringify!($field) };
    (@name [$field:ident $label:literal]) => { $label };
    (@max ADS_DATA) => { $crate::layout::ADS_DATA };
    (@max (ADS_DATA + $header:literal)) => { $crate::layout::ADS_DATA + $header };
    (@max $max:literal) => { $max };
    (@shown ADS_DATA) => { "[`ADS_DATA_MAX`](crate::limits::ADS_DATA_MAX)" };
    (@shown (ADS_DATA + $header:literal)) => { concat!($crate::declare::stream!(@shown ADS_DATA), " + ", $header) };
    (@shown $max:literal) => { $max };
    (@per 4m) => { 4 };
    (@per 4n) => { 4 };
    // The offset of a row after a NUL-terminated text counts only the NUL of the text.
    (@per text) => { 0 };
    (@after []) => { "" };
    (@after [text]) => { " and the text" };
    (@after [$per:tt]) => { concat!(" + ", stringify!($per)) };
}

pub(crate) use {row, stream};

/// The number of bytes by which an encoded value exceeds the minimum length of its row.
#[cfg(feature = "arbitrary")]
pub(crate) fn used<R: Owned>(value: &R::Type) -> usize {
    R::len(R::lend(value)).saturating_sub(R::LEAST)
}
