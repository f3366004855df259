//! The borrowed and the owned type of each stream, as functions of bytes, so that tests treat all
//! streams alike.

use ads_cnc::layout::Stream;
use ads_cnc::{Decode as _, Encode as _, Error};

use super::Mutation;

/// One of the types of a stream, borrowed or owned.
#[derive(Clone, Copy)]
pub(crate) struct StreamType {
    /// `view` or `owned`.
    pub(crate) name: &'static str,
    /// Decodes the bytes; returns the encoded length of the value.
    pub(crate) len: fn(&[u8]) -> Result<usize, Error>,
    /// Decodes the bytes and encodes the value to the buffer; returns the number of written bytes.
    pub(crate) encode: fn(&[u8], &mut [u8]) -> Result<usize, Error>,
}

/// The result of `BinRead` and `BinWrite`: the written bytes if the input was accepted, and the
/// position of the reader.
#[cfg(feature = "binrw")]
pub(crate) type ReadAndWritten = (Option<Vec<u8>>, usize);

/// A stream with its types.
pub(crate) struct Subject {
    pub(crate) stream: Stream,
    pub(crate) view: StreamType,
    #[cfg(feature = "alloc")]
    pub(crate) owned: StreamType,
    /// Decodes the stream at the start of the bytes by `decode_prefix`; returns its length.
    pub(crate) prefix: fn(&[u8]) -> Result<usize, Error>,
    /// Decodes the bytes to both types and compares the values.
    #[cfg(feature = "alloc")]
    pub(crate) same: fn(&[u8]) -> Result<bool, Error>,
    /// Reads the bytes with `BinRead`, and writes the value with `BinWrite`.
    #[cfg(feature = "binrw")]
    pub(crate) binrw: fn(&[u8]) -> ReadAndWritten,
    /// Decodes the bytes to the owned type, and encodes it into a vector.
    #[cfg(feature = "alloc")]
    pub(crate) to_vec: fn(&[u8]) -> Result<Vec<u8>, Error>,
    /// Decodes the bytes to the owned type and calls the function; then copies the value, if
    /// decoding succeeded, and calls the function again.
    #[cfg(feature = "alloc")]
    pub(crate) twice: fn(&[u8], &mut dyn FnMut()),
    /// Generates a value from the bytes, checks the laws, and returns the encoded bytes.
    #[cfg(feature = "arbitrary")]
    pub(crate) made: fn(&[u8], &Mutation) -> Vec<u8>,
}

impl Subject {
    pub(crate) fn of(stream: Stream) -> &'static Self {
        let found = SUBJECTS.iter().find(|subject| subject.stream == stream);
        found.unwrap_or_else(|| panic!("{stream} has no readings"))
    }

    pub(crate) fn readings(&self) -> impl Iterator<Item = StreamType> {
        #[cfg(feature = "alloc")]
        return [self.view, self.owned].into_iter();
        #[cfg(not(feature = "alloc"))]
        return [self.view].into_iter();
    }
}

/// Generates a value from these bytes, which may be empty.
#[cfg(feature = "arbitrary")]
pub(crate) fn made<T>(bytes: &[u8]) -> T
where
    T: for<'a> arbitrary::Arbitrary<'a>,
{
    let value = T::arbitrary(&mut arbitrary::Unstructured::new(bytes));
    value.expect("bytes never run out")
}

#[cfg(feature = "alloc")]
fn decoded_and_copied<T: Clone>(decoded: Result<T, Error>, call: &mut dyn FnMut()) {
    call();
    let copy = std::hint::black_box(&decoded).clone();
    call();
    drop(std::hint::black_box((decoded, copy)));
}

#[cfg(feature = "binrw")]
fn read_and_written<T>(bytes: &[u8]) -> ReadAndWritten
where
    T: for<'a> binrw::BinRead<Args<'a> = ()> + binrw::meta::ReadEndian,
    T: for<'a> binrw::BinWrite<Args<'a> = ()> + binrw::meta::WriteEndian,
{
    let mut reader = binrw::io::Cursor::new(bytes);
    let written = T::read(&mut reader).ok().map(|value| {
        let mut writer = binrw::io::Cursor::new(Vec::new());
        value.write(&mut writer).unwrap();
        writer.into_inner()
    });
    (written, usize::try_from(reader.position()).unwrap())
}

macro_rules! reading {
    ($name:literal, $reading:ty) => {
        StreamType {
            name: $name,
            len: |bytes| Ok(<$reading>::decode(bytes)?.encoded_len()),
            encode: |bytes, buf| Ok(<$reading>::decode(bytes)?.encode(buf)?.len()),
        }
    };
}

macro_rules! subjects {
    ($( $stream:ident: $view:ty $( , $owned:ty )?; )+) => { &[$( Subject {
        stream: Stream::$stream,
        view: reading!("view", $view),
        prefix: |bytes| <$view>::decode_prefix(bytes).map(|(_, rest)| bytes.len() - rest.len()),
        #[cfg(feature = "alloc")]
        owned: subjects!(@owned $view $( , $owned )?),
        #[cfg(feature = "alloc")]
        same: subjects!(@same $view $( , $owned )?),
        #[cfg(feature = "binrw")]
        binrw: subjects!(@binrw $view $( , $owned )?),
        #[cfg(feature = "alloc")]
        to_vec: subjects!(@to_vec $view $( , $owned )?),
        #[cfg(feature = "alloc")]
        twice: subjects!(@twice $view $( , $owned )?),
        #[cfg(feature = "arbitrary")]
        made: subjects!(@made $view $( , $owned )?),
    }, )+] };
    // A stream without a separate owned type has one type for both.
    (@owned $both:ty) => { reading!("owned", $both) };
    (@owned $view:ty, $owned:ty) => { reading!("owned", $owned) };
    (@same $both:ty) => { |bytes| <$both>::decode(bytes).map(|_| true) };
    (@same $view:ty, $owned:ty) => {
        |bytes| {
            let (owned, view) = (<$owned>::decode(bytes)?, <$view>::decode(bytes)?);
            Ok(owned.as_ref() == view && view.to_owned() == owned)
        }
    };
    (@binrw $both:ty) => { read_and_written::<$both> };
    (@binrw $view:ty, $owned:ty) => { read_and_written::<$owned> };
    (@to_vec $both:ty) => { |bytes| <$both>::decode(bytes)?.encode_to_vec() };
    (@to_vec $view:ty, $owned:ty) => { |bytes| <$owned>::decode(bytes)?.encode_to_vec() };
    (@twice $both:ty) => { |bytes, call| decoded_and_copied(<$both>::decode(bytes), call) };
    (@twice $view:ty, $owned:ty) => { |bytes, call| decoded_and_copied(<$owned>::decode(bytes), call) };
    (@made $both:ty) => { |bytes, mutation| super::check_value_bent(&made::<$both>(bytes), mutation) };
    (@made $view:ty, $owned:ty) => { |bytes, mutation| super::check_value_bent(&made::<$owned>(bytes), mutation) };
}

/// All streams except `NoData`.
pub(crate) static SUBJECTS: &[Subject] = ads_cnc::streams! { subjects };
