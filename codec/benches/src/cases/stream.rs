//! The macro that declares the cases of a stream.

use ads_cnc::layout::Stream;

use crate::Case;

/// The cases of one stream.
pub(crate) struct Entry {
    #[cfg_attr(not(test), expect(dead_code, reason = "the tests see that none is missing"))]
    pub(crate) stream: Stream,
    pub(crate) cases: &'static [Case],
    /// Panics if the codec and the handwritten code have different results.
    #[cfg(test)]
    pub(crate) alike: fn(),
}

/// Declares the cases of a stream. The inputs are the samples of the codec's tests, or, in the
/// cases of rejection, the inputs of `inputs::rejected`. The encoding cases encode the owned type,
/// or the only type of the stream.
macro_rules! stream {
    ($subject:literal, $stream:ident, $both:ty, by hand $hand:ty) => {
        $crate::cases::stream::Entry {
            stream: Stream::$stream,
            cases: &[
                $crate::cases::stream::stream!(@decode $subject, $stream, "decode", $both)
                    .within(&[$crate::Limit::Instructions("decode by hand", 1.3)]),
                $crate::cases::stream::stream!(@decode $subject, $stream, "decode by hand", $hand),
                $crate::cases::stream::stream!(@reject $subject, $stream, "rejected", $both, "decode"),
                $crate::cases::stream::stream!(@encode $subject, $stream, "encode", $both),
                $crate::cases::stream::stream!(@encode $subject, $stream, "encode by hand", $hand),
            ],
            #[cfg(test)]
            alike: || $crate::cases::stream::alike!($stream, $both, $hand),
        }
    };
    (
        $subject:literal, $stream:ident, $view:ty, by hand $hand:ty,
        owned $owned:ty, by hand $hand_owned:ty
    ) => {
        $crate::cases::stream::Entry {
            stream: Stream::$stream,
            cases: &[
                $crate::cases::stream::stream!(@decode $subject, $stream, "borrowed", $view)
                    .within(&[$crate::Limit::Instructions("borrowed by hand", 1.3)]),
                $crate::cases::stream::stream!(@decode $subject, $stream, "borrowed by hand", $hand),
                $crate::cases::stream::stream!(@decode $subject, $stream, "owned", $owned)
                    .within(&[$crate::Limit::Instructions("owned by hand", 1.3)]),
                $crate::cases::stream::stream!(@decode $subject, $stream, "owned by hand", $hand_owned),
                $crate::cases::stream::stream!(@reject $subject, $stream, "rejected", $view, "borrowed"),
                $crate::cases::stream::stream!(@reject $subject, $stream, "rejected, owned", $owned, "owned"),
                $crate::cases::stream::stream!(@encode $subject, $stream, "encode", $owned),
                $crate::cases::stream::stream!(@encode $subject, $stream, "encode by hand", $hand_owned),
            ],
            #[cfg(test)]
            alike: || {
                $crate::cases::stream::alike!($stream, $view, $hand);
                $crate::cases::stream::alike!($stream, $owned, $hand_owned);
            },
        }
    };
    (@decode $subject:literal, $stream:ident, $implementation:literal, $reading:ty) => {
        $crate::Case::new($subject, $implementation, || {
            $crate::case::each!($crate::inputs::many(Stream::$stream), |bytes| {
                <$reading>::decode(bytes)
            })
        })
    };
    (@reject $subject:literal, $stream:ident, $implementation:literal, $reading:ty, $than:literal) => {
        $crate::Case::new($subject, $implementation, || {
            let accepts = |bytes: &[u8]| <$reading>::decode(bytes).is_ok();
            $crate::case::each!($crate::inputs::rejected(Stream::$stream, accepts), |bytes| {
                <$reading>::decode(bytes)
            })
        })
        .within(&[$crate::Limit::Over($than, 200.0)])
    };
    (@encode $subject:literal, $stream:ident, "encode", $reading:ty) => {
        $crate::cases::stream::stream!(@encoding $subject, $stream, "encode", $reading).within(&[
            $crate::Limit::Instructions("encode by hand", 3.0),
        ])
    };
    (@encode $subject:literal, $stream:ident, $implementation:literal, $reading:ty) => {
        $crate::cases::stream::stream!(@encoding $subject, $stream, $implementation, $reading)
    };
    (@encoding $subject:literal, $stream:ident, $implementation:literal, $reading:ty) => {
        $crate::Case::new($subject, $implementation, || {
            let samples = $crate::inputs::many(Stream::$stream);
            let mut buf = [0; 4096];
            $crate::case::each!(
                samples
                    .iter()
                    .map(|bytes| <$reading>::decode(bytes).unwrap())
                    .collect::<Vec<_>>(),
                |stream| stream.encode(&mut buf)
            )
        })
    };
}

/// Checks that the codec and the handwritten code accept and reject the same bytes, and encode the
/// decoded value to the same bytes.
#[cfg(test)]
macro_rules! alike {
    ($stream:ident, $codec:ty, $hand:ty) => {{
        let mut taken = 0;
        for bytes in $crate::inputs::all(Stream::$stream) {
            let (codec, hand) = (<$codec>::decode(&bytes), <$hand>::decode(&bytes));
            match (&codec, &hand) {
                (Ok(codec), Ok(hand)) => {
                    let (mut one, mut two) = ([0xAA; 4096], [0x55; 4096]);
                    assert_eq!(codec.encode(&mut one).unwrap(), bytes);
                    assert_eq!(hand.encode(&mut two).unwrap(), bytes);
                    if let Some(short) = bytes.len().checked_sub(1) {
                        assert!(codec.encode(&mut one[..short]).is_err());
                        assert!(hand.encode(&mut two[..short]).is_err());
                    }
                    taken += 1;
                }
                (Err(_), Err(_)) => {}
                _ => panic!("{}: {bytes:02x?}: {codec:?}, by hand {hand:?}", Stream::$stream),
            }
        }
        assert!(taken > 0);
    }};
}

#[cfg(test)]
pub(crate) use alike;
pub(crate) use stream;
