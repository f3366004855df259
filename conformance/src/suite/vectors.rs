//! Cases made of golden vectors, for the codec.

use ads_cnc::layout::Stream;
use ads_cnc_vectors::{Expect, Hex, Vector, vectors};

use super::case::{Body, Case, Evidence, Judgement, Needs};
use super::printed::{case_of, typed};
use crate::codec::{self, Refused};
use crate::defect::Defect;
use crate::show::show;
use crate::verdict::Verdict;

/// One case for each vector.
pub(super) fn cases() -> Vec<Case> {
    vectors().iter().map(|one| case_of(one, "vec", Needs::Codec, Body::Vector(one))).collect()
}

/// Holds the codec against a vector; a defect changes the bytes before the codec sees them.
pub(super) fn judge(vector: &Vector, defect: Option<&Defect>) -> Judgement {
    let mut bytes = vector.bytes();
    let stream = Stream::by_name(&vector.stream);
    if let Some(defect) = defect.filter(|one| stream.is_some_and(|stream| one.touches(stream))) {
        bytes = defect.apply(&bytes);
    }
    let decoded = codec::decode(vector, &bytes);
    let again = decoded.as_ref().ok().filter(|_| vector.is_accepted());
    let again = again.map(|decoded| decoded.bytes.clone());
    let (kept, expected, found) = match (&vector.expect, decoded) {
        (Expect::Accept(accept), Ok(decoded)) => {
            let expected = show(&accept.value);
            if decoded.fields != accept.value {
                (false, expected, show(&decoded.fields))
            } else {
                let found = format!("encoded again as {}", Hex(decoded.bytes.clone()));
                (decoded.bytes == bytes, format!("{} again", Hex(bytes.clone())), found)
            }
        }
        (Expect::Accept(accept), Err(refused)) => (false, show(&accept.value), describe(refused)),
        (Expect::Reject(reject), Ok(decoded)) => {
            let place = format!("{} at offset {} in {}", reject.class, reject.offset, reject.field);
            (false, place, format!("accepted: {}", show(&decoded.fields)))
        }
        (Expect::Reject(reject), Err(refused)) => {
            // Class and place are advice; that it is refused by the codec is what counts.
            let kept = matches!(refused, Refused::Error(_));
            (kept, format!("{} in {}", reject.class, reject.field), describe(refused))
        }
    };
    let evidence = Evidence {
        call: format!("vector {}, to the codec", vector.id),
        request_stream: stream.map(|stream| stream.layout().name),
        sent: bytes,
        reply_stream: stream.map(|stream| stream.layout().name),
        expected: again.is_some().then(|| vector.bytes()),
        result: if again.is_some() { "encoded again".to_owned() } else { found.clone() },
        received: again,
        values: typed(&vector.context),
        ..Evidence::default()
    };
    let verdict = if kept { Verdict::Pass } else { Verdict::Fail };
    let evidence = Some(evidence);
    Judgement { requirement: "", level: None, verdict, expected, found, evidence, more: 0 }
}

fn describe(refused: Refused) -> String {
    match refused {
        Refused::Error(error) => format!("{}: {error}", codec::class(&error)),
        Refused::Unsupported(what) => format!("unsupported: {what}"),
    }
}
