//! The steps of an NC program and of one or two hosts of services in any order, with failing writes
//! and reads: each request is served once and receives its own response. After timeouts and resets,
//! this is true of the requests that are sent once the hosts are idle.

use ads_cnc::service::ServiceId;
use ads_cnc_conformance::simulator::program::service::Clears;
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::select;

use crate::kept;
use crate::world::*;

fn clears() -> impl Strategy<Value = Clears> {
    select(vec![Clears::OnResponseState, Clears::Never])
}

fn requests() -> impl Strategy<Value = Vec<TestRequest>> {
    vec((0..2_usize, 0..2_u8), 1..12)
}

fn outcome() -> impl Strategy<Value = StepOutcome> {
    prop_oneof![6 => Just(StepOutcome::Fine), 1 => Just(StepOutcome::Fails), 1 => Just(StepOutcome::FailsLate)]
}

fn orderly() -> impl Strategy<Value = Vec<Action>> {
    // Actions are repeated, so that one side makes progress while the other waits.
    let one = prop_oneof![
        1 => Just(Action::Program),
        2 => (0..2_usize, outcome()).prop_map(|(place, outcome)| Action::Host(place, outcome)),
    ];
    let runs = vec((one, 1..8_usize), 0..120);
    runs.prop_map(|runs| {
        runs.into_iter().flat_map(|(action, times)| std::iter::repeat_n(action, times)).collect()
    })
}

fn chaos() -> impl Strategy<Value = Vec<Action>> {
    let one = prop_oneof![
        20 => Just(Action::Program),
        30 => (0..2_usize, outcome()).prop_map(|(place, outcome)| Action::Host(place, outcome)),
        1 => Just(Action::GiveUp),
        1 => Just(Action::ResetCnc),
        1 => (0..2_usize).prop_map(Action::Restart),
    ];
    vec(one, 0..400)
}

fn service_ids() -> [ServiceId; 2] {
    [
        ServiceId::new("560AACBF-6335-44a9-895A-8B27F3ED5E47").unwrap(),
        ServiceId::new("19719079-ba06-4740-bc02-de5215211751").unwrap(),
    ]
}

proptest! {
    #![proptest_config(kept::cases(1500, file!()))]

    /// One host for two services, with any failures: every request is served once by its service, and
    /// receives its own response.
    #[test]
    fn one_host_answers_each_request_once(requests in requests(), actions in orderly(), clears in clears()) {
        let ids = service_ids();
        let mut world = World::new(&ids, true, clears, true, ServiceMutation::NONE);
        let mut next = requests.into_iter();
        actions.into_iter().for_each(|action| world.act(action, &mut next));
        world.finish(&mut next);
    }

    /// Two independent hosts with one service each, and any failures, but no failed write of
    /// RESPONSE_STATE reaches the CNC. Every request is served once by its service, and receives
    /// its own response.
    #[test]
    fn two_hosts_answer_each_request_once(requests in requests(), actions in orderly(), clears in clears()) {
        let ids = service_ids();
        let mut world = World::new(&ids, false, clears, true, ServiceMutation::NONE);
        let mut next = requests.into_iter();
        for action in actions {
            let action = world.luck_of_two(action);
            world.act(action, &mut next);
        }
        world.finish(&mut next);
    }

    /// After any actions, including timeouts of programs and resets of the CNC, the hosts become idle
    /// and answer the next requests correctly.
    #[test]
    fn requests_after_chaos_are_answered(
        before in requests(),
        after in requests(),
        actions in chaos(),
        clears in clears(),
        together: bool,
    ) {
        let ids = service_ids();
        let mut world = World::new(&ids, together, clears, false, ServiceMutation::NONE);
        let mut next = before.into_iter();
        actions.into_iter().for_each(|action| world.act(action, &mut next));
        world.settle();
        world.finish(&mut after.into_iter());
    }
}
