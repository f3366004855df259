//! Runs against CNCs with very many variables: sampling, and the number of requests.

use std::net::SocketAddr;
use std::sync::Arc;
use std::time::Duration;

use ads_cnc::operation::{Call, Request};
use ads_cnc_conformance::client::{Client, Target};
use ads_cnc_conformance::gate::Gate;
use ads_cnc_conformance::judge::{CaseOutcome, Needs, Selection, Verdict};
use ads_cnc_conformance::profile::Profile;
use ads_cnc_conformance::simulator::{
    Cnc, DEFAULT_MODEL, LocalCnc, Model, NET_ID, ReplyData, Responder, Settings,
};
use ads_cnc_conformance::suite::{self, ClaimsBy, Discovery, Sample, TargetState};

/// The default model with more variables in its first channel.
fn with_variables(count: usize) -> Cnc {
    let first = "variables = [\n";
    let (head, tail) = {
        let channel = DEFAULT_MODEL.find("[[channel]]").unwrap();
        let at = channel + DEFAULT_MODEL[channel..].find(first).unwrap() + first.len();
        DEFAULT_MODEL.split_at(at)
    };
    let more: String = (0..count)
        .map(|one| format!("  {{ name = \"V.E.more_{one}\", type = \"SGN32\", value = {one} }},\n"))
        .collect();
    let model = format!("{head}{more}{tail}");
    let model = Model::with_settings(&model, "the model", Settings::default()).unwrap();
    Cnc::new(model).with_stopped_clock()
}

/// A simulated CNC in this process as a device, after the queries with which a run discovers what the
/// device has.
pub(crate) fn connected(cnc: impl Responder + 'static, sample: Sample) -> (TargetState, Discovery) {
    let target = Target::local(SocketAddr::from(([127, 0, 0, 1], 0)), NET_ID);
    let client =
        Client::in_process(target, Gate::queries(), LocalCnc::new(Arc::new(cnc), NET_ID)).unwrap();
    let mut target = TargetState::new(client, Profile::DEVICE).with_sample(sample);
    let discovery = suite::discover(&mut target, ClaimsBy::Queries);
    (target, discovery)
}

/// The outcomes of the cases that `only` selects, or of all cases for a target.
pub(crate) fn outcomes(target: &mut TargetState, only: &[&str]) -> Vec<CaseOutcome> {
    let only = only.iter().map(|&word| word.to_owned()).collect();
    let cases = suite::cases().into_iter().filter(|case| case.needs != Needs::Codec).collect();
    let plan = Selection { only, ..Selection::default() }.plan(cases, 1).unwrap();
    suite::run(plan.cases, Some(target), None, 1)
}

/// The number of requests that these cases send.
fn requests(cnc: Cnc, sample: Sample, only: &[&str]) -> usize {
    let (mut target, _) = connected(cnc, sample);
    let before = target.frames;
    for outcome in outcomes(&mut target, only) {
        assert_eq!(outcome.verdict(), Verdict::Pass, "{outcome:?}");
    }
    target.frames - before
}

/// In a sample, too, the cases request the index after the last of all variables, not after the last of
/// the sample.
#[test]
fn a_sample_keeps_the_index_after_the_last() {
    let cnc = || with_variables(10_100);
    requests(cnc(), Sample::BySeed(1), &["var-extended-beyond-last"]);
    requests(cnc(), Sample::All, &["var-extended-beyond-last"]);
    // Unless all names are read, no case can know that a name does not exist.
    let (mut target, _) = connected(cnc(), Sample::BySeed(1));
    for outcome in outcomes(&mut target, &["var-descriptions", "var-similar-name"]) {
        assert_eq!(outcome.verdict(), Verdict::Pass, "{outcome:?}");
    }
}

/// A long list is sampled, and the result of the discovery states the sample; `Sample::All` reads
/// everything.
#[test]
fn a_long_list_is_sampled() {
    let (_, Discovery { found, .. }) = connected(with_variables(1000), Sample::BySeed(1));
    let long = found.lists.iter().find(|list| list.name == "V.E channel 1").unwrap();
    assert_eq!((long.items, long.read), (1123, 256));
    let sampled = found.sampled().unwrap();
    assert_eq!(sampled, "V.E channel 1: 256 of 1123; by the seed");
    let whole = found.lists.iter().filter(|list| list.items <= 256);
    assert!(whole.clone().count() > 90 && whole.clone().all(|list| list.read == list.items));

    let (_, Discovery { found, .. }) = connected(with_variables(1000), Sample::All);
    assert!(found.lists.iter().all(|list| list.read == list.items));
    assert_eq!(found.sampled(), None);

    let asked = |sample| requests(with_variables(1000), sample, &["var-extended-descriptions"]);
    assert_eq!(asked(Sample::All) - asked(Sample::BySeed(1)), 1123 - 256);
    // The check that names are unique reads all variables, even with a sample.
    let described = requests(with_variables(1000), Sample::BySeed(1), &["var-descriptions"]);
    assert!(described > 1123, "{described}");
}

/// The number of requests that is forecast before the cases differs by less than a tenth from the number
/// of requests that are sent.
#[test]
fn the_forecast_is_about_right() {
    for more in [0, 3000] {
        let (mut target, discovery) = connected(with_variables(more), Sample::BySeed(1));
        let before = target.frames;
        outcomes(&mut target, &[]);
        let (sent, expected) = ((target.frames - before) as u64, discovery.found.expected);
        assert!(sent.abs_diff(expected) < expected / 10, "{sent}, {expected} expected");
        // This number of requests takes ten minutes at 10 ms each.
        assert!(sent < 60_000, "{sent}");
    }
}

/// A CNC with 10,000 variables of each kind, whose descriptions have 2 kB each.
#[derive(Debug)]
struct LongDescriptions(Cnc);

impl Responder for LongDescriptions {
    fn answer(&self, call: &Call<'_>) -> ReplyData {
        match call.dispatch() {
            Ok(Request::CountVariables(_)) => Ok(10_000_u32.to_le_bytes().to_vec()),
            Ok(Request::DescribeByIndex(op)) => {
                let words = [vec![op.index, 1, 1, 1, 480], vec![1; 480]].concat();
                let mut data: Vec<u8> = words.into_iter().flat_map(u32::to_le_bytes).collect();
                data.extend(format!("V.E.long_{}\0", op.index).as_bytes());
                Ok(data)
            }
            _ => self.0.answer(call),
        }
    }

    fn pass(&self, time: Duration) {
        self.0.pass(time);
    }
}

/// The descriptions of all channels have a limit in total.
#[test]
fn the_stored_descriptions_are_limited() {
    let cnc = Cnc::with_default_model().unwrap().with_stopped_clock();
    let (mut target, _) = connected(LongDescriptions(cnc), Sample::All);
    let outcomes = outcomes(&mut target, &["var-described-handle"]);
    let [outcome] = outcomes.as_slice() else { panic!("{outcomes:?}") };
    let why = outcome.note.as_deref().unwrap_or_default();
    assert!(why.contains("need more than 16 MiB, which is the limit"), "{outcome:?}");
}
