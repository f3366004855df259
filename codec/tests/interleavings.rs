//! The Service Interface in any order of steps: a program that asks, one host or two, writes and
//! reads that fail, against a model that counts.

use std::time::Duration;

use ads_cnc::CncStr;
use ads_cnc::service::ServiceVariable::ResponseState;
use ads_cnc::service::*;
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::select;

const NOW: Duration = Duration::ZERO;

fn ids() -> [ServiceId; 2] {
    [
        ServiceId::new("560AACBF-6335-44a9-895A-8B27F3ED5E47").unwrap(),
        ServiceId::new("19719079-ba06-4740-bc02-de5215211751").unwrap(),
    ]
}

/// How a step goes.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Luck {
    Fine,
    /// Nothing arrives.
    Fails,
    /// A write arrives, and the host is not told.
    FailsLate,
}

#[derive(Clone, Copy, Debug)]
enum Action {
    Program,
    Host(usize, Luck),
    /// The program gives up.
    GiveUp,
    ResetCnc,
    Restart(usize),
}

/// A request: which service, and which of a few texts, so that requests repeat.
type Asked = (usize, u8);

/// All that takes part, and the model: how often each service was asked and has served.
struct World<'s> {
    interface: Interface,
    hosts: Vec<Host<'s>>,
    ids: &'s [ServiceId],
    call: Option<(Asked, Call)>,
    asked: Vec<usize>,
    served: Vec<usize>,
    /// Whether each answer is the right one; chaos makes wrong ones.
    strict: bool,
}

impl<'s> World<'s> {
    fn new(ids: &'s [ServiceId], hosts: Vec<Host<'s>>, clears: Clears, strict: bool) -> Self {
        let interface = Interface::with(clears);
        let count = vec![0; ids.len()];
        Self { interface, hosts, ids, call: None, asked: count.clone(), served: count, strict }
    }

    /// What a service answers: who it is, what it was asked, how often it has served.
    fn answer(service: usize, request: &str, times: usize) -> String {
        format!("{service} {request} {times}")
    }

    fn program(&mut self, next: &mut impl Iterator<Item = Asked>) {
        let Some(((service, text), call)) = &mut self.call else {
            let Some((service, text)) = next.next() else { return };
            let request = format!("{service}{text}");
            let (id, request) = (self.ids[service], CncStr::new(&request).unwrap());
            let call = Call::new(id, request, SysServiceWait::default()).unwrap();
            self.asked[service] += 1;
            self.call = Some(((service, text), call));
            return;
        };
        match call.step() {
            CallStep::Read(variable) => call.read(self.interface.read(variable), NOW).unwrap(),
            CallStep::Write(variable, value) => {
                self.interface.write(variable, value).unwrap();
                call.written(NOW);
            }
            CallStep::Wait { .. } => call.poll(),
            CallStep::Done { state, response } => {
                if self.strict {
                    let (service, times) = (*service, self.asked[*service]);
                    let wanted = Self::answer(service, &format!("{service}{text}"), times);
                    assert_eq!((state, response), (7, CncStr::new(&wanted).unwrap()));
                    assert_eq!(self.served, self.asked);
                }
                self.call = None;
            }
            CallStep::TimedOut => unreachable!("it has no longest wait"),
        }
    }

    fn host(&mut self, place: usize, luck: Luck) {
        let place = place % self.hosts.len();
        let host = &mut self.hosts[place];
        match host.step() {
            HostStep::Read(_) | HostStep::Wait if luck != Luck::Fine => host.failed(),
            HostStep::Read(variable) => host.read(self.interface.read(variable)).unwrap(),
            HostStep::Wait => host.poll(),
            HostStep::Write(variable, value) => {
                if luck != Luck::Fails {
                    self.interface.write(variable, value).unwrap();
                }
                if luck == Luck::Fine { host.written() } else { host.failed() }
            }
            HostStep::Serve { uuid, request, .. } => {
                let service = self.ids.iter().position(|id| id == uuid).unwrap();
                let request = request.to_string();
                if self.strict {
                    // SVC-2: asked by the program, of this service, just now.
                    let ((asked, text), _) = self.call.as_ref().expect("somebody asks");
                    assert_eq!((*asked, format!("{asked}{text}")), (service, request.clone()));
                }
                self.served[service] += 1;
                let answer = Self::answer(service, &request, self.served[service]);
                host.answer(CncStr::new(&answer).unwrap(), 7).unwrap();
            }
        }
    }

    fn act(&mut self, action: Action, next: &mut impl Iterator<Item = Asked>) {
        match action {
            Action::Program => self.program(next),
            Action::Host(place, luck) => self.host(place, luck),
            Action::GiveUp => self.call = None,
            Action::ResetCnc => {
                self.call = None;
                self.interface.reset();
            }
            Action::Restart(place) => {
                let place = place % self.hosts.len();
                self.hosts[place].restart();
            }
        }
    }

    /// All hosts step in turn until they have nothing to do.
    fn settle(&mut self) {
        for _ in 0..100 {
            (0..self.hosts.len()).for_each(|place| self.host(place, Luck::Fine));
        }
        for place in 0..self.hosts.len() {
            let steps = (0..10).find(|_| {
                let waits = self.hosts[place].step() == HostStep::Wait;
                if !waits {
                    self.host(place, Luck::Fine);
                }
                waits
            });
            assert!(steps.is_some(), "host {place} does not come to rest");
        }
    }

    /// Everyone steps in turn until the program has all its answers.
    fn finish(&mut self, next: &mut impl Iterator<Item = Asked>) {
        for _ in 0..2000 {
            self.program(next);
            (0..self.hosts.len()).for_each(|place| self.host(place, Luck::Fine));
        }
        assert!(self.call.is_none(), "the program still waits");
        assert!(next.next().is_none());
    }
}

fn clears() -> impl Strategy<Value = Clears> {
    select(vec![Clears::OnResponseState, Clears::Never])
}

fn requests() -> impl Strategy<Value = Vec<Asked>> {
    vec((0..2_usize, 0..2_u8), 1..12)
}

fn luck() -> impl Strategy<Value = Luck> {
    prop_oneof![6 => Just(Luck::Fine), 1 => Just(Luck::Fails), 1 => Just(Luck::FailsLate)]
}

fn orderly() -> impl Strategy<Value = Vec<Action>> {
    // Runs of the same, so that either side gets far while the other stands.
    let one = prop_oneof![
        1 => Just(Action::Program),
        2 => (0..2_usize, luck()).prop_map(|(place, luck)| Action::Host(place, luck)),
    ];
    let runs = vec((one, 1..8_usize), 0..120);
    runs.prop_map(|runs| {
        runs.into_iter().flat_map(|(action, times)| std::iter::repeat_n(action, times)).collect()
    })
}

fn chaos() -> impl Strategy<Value = Vec<Action>> {
    let one = prop_oneof![
        20 => Just(Action::Program),
        30 => (0..2_usize, luck()).prop_map(|(place, luck)| Action::Host(place, luck)),
        1 => Just(Action::GiveUp),
        1 => Just(Action::ResetCnc),
        1 => (0..2_usize).prop_map(Action::Restart),
    ];
    vec(one, 0..400)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1500, failure_persistence: None, ..Default::default() })]

    /// One host for two services, whatever fails: every request is served once, by the service it
    /// is for, and gets the answer to itself.
    #[test]
    fn one_host(requests in requests(), actions in orderly(), clears in clears()) {
        let ids = ids();
        let mut world = World::new(&ids, vec![Host::new(&ids)], clears, true);
        let mut next = requests.into_iter();
        actions.into_iter().for_each(|action| world.act(action, &mut next));
        world.finish(&mut next);
    }

    /// Two hosts that know nothing of each other, one service each: the same. A write of
    /// RESPONSE_STATE that fails does not arrive here: a host that looks whether it has cannot tell
    /// its own request from a later one while the other host is about to answer that.
    #[test]
    fn two_hosts(requests in requests(), actions in orderly(), clears in clears()) {
        let ids = ids();
        let hosts = vec![Host::new(&ids[..1]), Host::new(&ids[1..])];
        let mut world = World::new(&ids, hosts, clears, true);
        let mut next = requests.into_iter();
        for mut action in actions {
            if let Action::Host(place, luck) = &mut action {
                let step = world.hosts[*place].step();
                if *luck == Luck::FailsLate && matches!(step, HostStep::Write(ResponseState, _)) {
                    *luck = Luck::Fails;
                }
            }
            world.act(action, &mut next);
        }
        world.finish(&mut next);
    }

    /// After anything at all, programs that give up and a CNC that is reset among it, hosts come to
    /// rest, and the next requests are answered as if nothing had been.
    #[test]
    fn after_chaos(
        before in requests(),
        after in requests(),
        actions in chaos(),
        clears in clears(),
        together: bool,
    ) {
        let ids = ids();
        let hosts = match together {
            true => vec![Host::new(&ids)],
            false => vec![Host::new(&ids[..1]), Host::new(&ids[1..])],
        };
        let mut world = World::new(&ids, hosts, clears, false);
        let mut next = before.into_iter();
        actions.into_iter().for_each(|action| world.act(action, &mut next));
        world.call = None;
        world.settle();
        (world.strict, world.asked) = (true, world.served.clone());
        world.finish(&mut after.into_iter());
    }
}
