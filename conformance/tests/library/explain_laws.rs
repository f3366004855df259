//! Properties that the explanation of any bytes must have.

use ads_cnc::address::{IndexGroup, IndexOffset};
use ads_cnc::ads::AmsPort;
use ads_cnc::layout::Stream;
use ads_cnc::operation::{AdsService, Function, OffsetRule};
use ads_cnc::value::DataType;
use ads_cnc_conformance::explain::{
    ExplainQuery, ExplainSubject, Explanation, ExplanationOutcome, ServiceAddress, ValueFormat,
    explain, parse_hex, type_by_name,
};
use ads_cnc_vectors::{Expect, vectors};
use jsonschema::Validator;
use proptest::prelude::*;
use proptest::sample::select;

#[path = "../common/explained.rs"]
mod explained;

use explained::{check_explanation, check_printed, printed};

fn schema() -> Validator {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/schema/explain.schema.json");
    let schema = serde_json::from_str(&std::fs::read_to_string(file).unwrap()).unwrap();
    jsonschema::draft202012::meta::validate(&schema).unwrap();
    jsonschema::validator_for(&schema).unwrap()
}

/// Explains bytes and checks the properties of the explanation.
fn check(question: &ExplainQuery, bytes: &[u8], schema: &Validator) -> Explanation {
    let explanation = explain(question, bytes);
    // The explanation of an address does not include the bytes.
    let bytes = if matches!(question.subject, ExplainSubject::Address(_)) { &[] } else { bytes };
    check_explanation(&Explanation { length: bytes.len(), ..explanation.clone() }, bytes);
    check_printed(&printed(&explanation));
    let document = serde_json::to_value(&explanation).unwrap();
    let errors: Vec<String> =
        schema.iter_errors(&document).map(|e| format!("{e} at {}", e.instance_path())).collect();
    assert!(errors.is_empty(), "{errors:#?}");
    explanation
}

fn stream(stream: Stream) -> ExplainQuery {
    ExplainQuery { subject: ExplainSubject::Stream(stream), values: ValueFormat::default() }
}

fn values() -> impl Strategy<Value = ValueFormat> {
    let ty = proptest::option::of(select(DataType::ALL.to_vec()));
    let dimensions = proptest::collection::vec(prop_oneof![0..6_u32, any::<u32>()], 0..4);
    (ty, dimensions).prop_map(|(ty, dimensions)| ValueFormat { ty, dimensions })
}

fn services() -> impl Strategy<Value = Option<AdsService>> {
    proptest::option::of(select(vec![AdsService::Read, AdsService::Write, AdsService::ReadWrite]))
}

/// Addresses of functions, and any other addresses.
fn places() -> impl Strategy<Value = ServiceAddress> {
    let examples: Vec<(u32, u32)> = Function::ALL
        .iter()
        .map(|function| {
            let spec = function.spec();
            let offset = match spec.offset {
                OffsetRule::At(at) | OffsetRule::AtLeast(at) => at,
                OffsetRule::OfAxis(element) => 0x2_0000 + element,
                OffsetRule::OfKind([first, ..]) => first,
                _ => 0,
            };
            (spec.group.example().get(), offset)
        })
        .collect();
    let known = select(examples).prop_flat_map(|(group, offset)| {
        (Just(group), prop_oneof![3 => Just(offset), 1 => any::<u32>()])
    });
    let near = (0x2_0000..0x13_FFFF_u32, 0..0x3_0000_u32);
    let address = prop_oneof![6 => known, 2 => near, 1 => any::<(u32, u32)>()];
    let port = proptest::option::of(prop_oneof![550..555_u16, any::<u16>()]);
    (port, services(), address, any::<bool>()).prop_map(
        |(port, service, (group, offset), reply)| {
            let (group, offset) = (IndexGroup::new(group), IndexOffset::new(offset));
            ServiceAddress { port: port.map(AmsPort), service, group, offset, reply }
        },
    )
}

fn subjects() -> impl Strategy<Value = ExplainSubject> {
    prop_oneof![
        select(Stream::all().collect::<Vec<_>>()).prop_map(ExplainSubject::Stream),
        places().prop_map(ExplainSubject::Place),
        places().prop_map(ExplainSubject::Address),
        proptest::option::of(places()).prop_map(ExplainSubject::Frames),
    ]
}

/// Sequences of numbers that are typical in streams, and any bytes.
fn bytes() -> impl Strategy<Value = Vec<u8>> {
    let word = prop_oneof![
        4 => (0..12_u32).prop_map(|number| number.to_le_bytes().to_vec()),
        1 => any::<u32>().prop_map(|number| number.to_le_bytes().to_vec()),
        1 => Just(b"V.E.a\0".to_vec()),
        1 => Just(b"N10 $WHILE 1\r\n".to_vec()),
        1 => proptest::collection::vec(any::<u8>(), 0..9),
    ];
    proptest::collection::vec(word, 0..24).prop_map(|words| words.concat())
}

/// One to three complete frames, which may then be changed at one offset and truncated.
fn frames() -> impl Strategy<Value = Vec<u8>> {
    let command = prop_oneof![4 => select(vec![2_u16, 3, 9]), 1 => any::<u16>()];
    let flags = prop_oneof![4 => 4..6_u16, 1 => any::<u16>()];
    let one = (command, flags, 550..555_u16, places(), any::<bool>(), bytes());
    let frame = one.prop_map(|(command, flags, port, place, lies, inside)| {
        let (group, offset) = (place.group.get().to_le_bytes(), place.offset.get().to_le_bytes());
        let length = u32::try_from(inside.len()).unwrap().saturating_add(lies.into()).to_le_bytes();
        let read = 84_u32.to_le_bytes();
        let data = match (flags & 1, command) {
            (0, 2) => [&group[..], &offset, &read].concat(),
            (0, 3) => [&group[..], &offset, &length, &inside].concat(),
            (0, _) => [&group[..], &offset, &read, &length, &inside].concat(),
            _ => [&[0; 4][..], &length, &inside].concat(),
        };
        let (target, source) = ([192, 0, 2, 10, 1, 1], [192, 0, 2, 20, 1, 1]);
        let (near, far) = (port.to_le_bytes(), [0, 0x80]);
        let ends = match flags & 1 {
            0 => [&target[..], &near, &source, &far].concat(),
            _ => [&source[..], &far, &target, &near].concat(),
        };
        let len = u32::try_from(data.len()).unwrap();
        let rest = [
            &command.to_le_bytes()[..],
            &flags.to_le_bytes(),
            &len.to_le_bytes(),
            &[0; 4],
            &[7, 0, 0, 0],
        ];
        [&[0, 0][..], &(len + 32).to_le_bytes(), &ends, &rest.concat(), &data].concat()
    });
    let cut = proptest::option::of(any::<proptest::sample::Index>());
    let change = proptest::option::of((any::<proptest::sample::Index>(), any::<u8>()));
    (proptest::collection::vec(frame, 1..4), cut, change).prop_map(|(frames, cut, change)| {
        let mut bytes = frames.concat();
        if let Some((place, byte)) = change {
            let place = place.index(bytes.len());
            bytes[place] = byte;
        }
        if let Some(cut) = cut {
            bytes.truncate(cut.index(bytes.len()));
        }
        bytes
    })
}

thread_local!(static SCHEMA: Validator = schema());

proptest! {
    #![proptest_config(crate::kept::cases(256, file!()))]

    #[test]
    fn any_bytes_with_any_query(subject in subjects(), values in values(), bytes in bytes()) {
        SCHEMA.with(|schema| check(&ExplainQuery { subject, values }, &bytes, schema));
    }

    #[test]
    fn any_frames(place in proptest::option::of(places()), values in values(), bytes in frames()) {
        SCHEMA.with(|schema| {
            check(&ExplainQuery { subject: ExplainSubject::Frames(place), values }, &bytes, schema)
        });
    }

    /// Explains the same bytes as each stream in turn.
    #[test]
    fn every_explanation_agrees_with_the_walk(bytes in bytes()) {
        for named in Stream::all() {
            let explanation = SCHEMA.with(|schema| check(&stream(named), &bytes, schema));
            let walked = named.walk(&bytes, |_| ());
            // The explanation also checks NC text, which the walk over the field table does not.
            if named != Stream::ProgramStream {
                prop_assert_eq!(walked.is_err(), explanation.outcome == ExplanationOutcome::Faulty);
            }
        }
    }

    #[test]
    fn any_text_is_hex_or_rejected(text in "\\PC*") {
        if let Err(error) = parse_hex(&text) {
            prop_assert!(error.line >= 1 && error.column >= 1);
        }
    }
}

/// The explanation of each golden vector of a stream with a field table, except the program stream,
/// has an error exactly if the vector expects one.
#[test]
fn explanations_agree_with_the_vectors() {
    let schema = schema();
    let (mut seen, mut rejected, mut same) = (0, 0, 0);
    for vector in vectors() {
        let Some(named) = Stream::by_name(&vector.stream) else { continue };
        if named == Stream::ProgramStream {
            continue;
        }
        seen += 1;
        let context = &vector.context;
        let ty = context.kind.map(|kind| serde_json::to_value(kind).unwrap());
        let ty = ty.and_then(|name| type_by_name(name.as_str().unwrap()).ok());
        let dimensions = context.dimensions.clone().unwrap_or_default();
        let values = ValueFormat { ty, dimensions };
        let question = ExplainQuery { subject: ExplainSubject::Stream(named), values };
        let explanation = check(&question, &vector.bytes(), &schema);
        let fault = explanation.parts[0].faults.first();
        match (&vector.expect, fault) {
            (Expect::Accept(_), None) => {}
            (Expect::Reject(reject), Some(fault)) => {
                // The error class and the offset in a vector are advisory, but most equal those of
                // the explanation.
                rejected += 1;
                same += usize::from((fault.class, fault.offset) == (&reject.class, reject.offset));
            }
            (_, fault) => panic!("{}: {fault:?}", vector.id),
        }
    }
    println!("{seen} vectors, {rejected} rejected, {same} with the same class and offset");
    assert!(seen > 100 && same * 10 > rejected * 8, "{seen} {rejected} {same}");
}

/// The data of a reply without its request is shown, although the stream of the data is unknown.
#[test]
fn the_data_of_a_reply_without_request_is_shown() {
    let mut frame = vec![0, 0, 44, 0, 0, 0];
    frame.extend([192, 0, 2, 20, 1, 1, 0, 0x80, 192, 0, 2, 10, 1, 1, 0x28, 2]);
    frame.extend([2, 0, 5, 0, 12, 0, 0, 0, 0, 0, 0, 0, 7, 0, 0, 0]);
    frame.extend([0, 0, 0, 0, 4, 0, 0, 0, 0xA1, 0xB2, 0xC3, 0xD4]);
    let question =
        ExplainQuery { subject: ExplainSubject::Frames(None), values: ValueFormat::default() };
    let explanation = check(&question, &frame, &schema());
    assert_eq!(explanation.parts.len(), 3);
    let shown = String::from_utf8(printed(&explanation)).unwrap();
    assert!(shown.contains("a1 b2 c3 d4") && !shown.contains("below"), "{shown}");
}
