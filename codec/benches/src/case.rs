//! The type of a case, and its limits.

/// A measured case.
#[derive(Clone, Copy)]
pub struct Case {
    /// The subject that is measured, such as `description`.
    pub subject: &'static str,
    /// The implementation, such as `borrowed` or `by hand`, or the size of the input, such as `1
    /// KB`.
    pub implementation: &'static str,
    /// Creates the inputs and the work to measure; the creation is not measured.
    pub prepare: fn() -> Work,
    /// The limits of the cost of the case.
    pub limits: &'static [Limit],
    /// True if counting the case takes too long for every change, so that only `run --renew` counts
    /// it.
    pub is_long: bool,
}

/// A limit of the cost of a case.
#[derive(Clone, Copy)]
pub enum Limit {
    /// At most this multiple of the instructions per unit of another case of the same subject.
    Instructions(&'static str, f64),
    /// At most this multiple of the time per unit of another case of the same subject. This is a
    /// goal: a case that exceeds it is only reported.
    Time(&'static str, f64),
    /// At most this number of instructions per unit more than another case of the same subject.
    Over(&'static str, f64),
}

impl Limit {
    /// The implementation of the reference: the limit compares the case with it.
    pub fn against(&self) -> &'static str {
        match self {
            Self::Instructions(other, _) | Self::Time(other, _) | Self::Over(other, _) => other,
        }
    }
}

/// Work that can be repeated.
pub struct Work {
    /// The number of units in a run, such as streams, records, calls, dimensions or bytes. Results
    /// are per unit.
    pub units: u64,
    /// Performs one run.
    pub run: Box<dyn FnMut()>,
}

impl Case {
    /// A case of `subject` by `implementation`, without limits.
    pub(crate) const fn new(
        subject: &'static str,
        implementation: &'static str,
        prepare: fn() -> Work,
    ) -> Self {
        Self { subject, implementation, prepare, limits: &[], is_long: false }
    }

    /// Adds these limits.
    pub(crate) const fn within(self, limits: &'static [Limit]) -> Self {
        Self { limits, ..self }
    }

    /// Marks the case as long (see `is_long`).
    pub(crate) const fn long(self) -> Self {
        Self { is_long: true, ..self }
    }

    /// Returns true for a case that `codec/benches/run` counts without `--renew`: the case is not
    /// long, and it has a limit or is the reference of a limit.
    pub(crate) fn is_gated(&self) -> bool {
        if self.is_long {
            return false;
        }
        let is_named = |limit: &Limit| limit.against() == self.implementation;
        !self.limits.is_empty()
            || crate::all().any(|it| it.subject == self.subject && it.limits.iter().any(is_named))
    }
}

/// Creates work that processes each input in turn. `black_box` hides the inputs from the compiler,
/// and the fact that the results are unused.
macro_rules! each {
    ($inputs:expr, |$input:ident| $work:expr) => {
        $crate::case::each!($inputs, 1, |$input| $work)
    };
    ($inputs:expr, $units_of_each:expr, |$input:ident| $work:expr) => {{
        let mut inputs = $inputs;
        $crate::case::Work {
            units: inputs.len() as u64 * $units_of_each,
            run: Box::new(move || {
                for input in std::hint::black_box(&mut inputs) {
                    let $input = std::hint::black_box(input);
                    std::hint::black_box(&$work);
                }
            }),
        }
    }};
}

pub(crate) use each;
