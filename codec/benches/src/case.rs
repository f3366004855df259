//! What is measured, and against what it is held.

/// One thing measured.
#[derive(Clone, Copy)]
pub struct Case {
    /// What it is about: `description`.
    pub subject: &'static str,
    /// Who does it: `borrowed`, `by hand`.
    pub who: &'static str,
    /// Makes what is needed, which is not measured.
    pub prepare: fn() -> Work,
    /// What it may cost.
    pub limits: &'static [Limit],
    /// Whether it takes too long to be counted for every change.
    pub is_long: bool,
}

/// What a case may cost.
#[derive(Clone, Copy)]
pub enum Limit {
    /// So many times the instructions of another of the same subject.
    Instructions(&'static str, f64),
    /// So many times the time of another of the same subject.
    Time(&'static str, f64),
    /// So many instructions for each unit more than another of the same subject.
    Over(&'static str, f64),
}

impl Limit {
    /// The other case.
    pub fn against(&self) -> &'static str {
        match self {
            Self::Instructions(other, _) | Self::Time(other, _) | Self::Over(other, _) => other,
        }
    }
}

/// Work that may be done again and again.
pub struct Work {
    /// How many records, bytes or calls a go has; figures are for one of them.
    pub units: u64,
    /// One go.
    pub run: Box<dyn FnMut()>,
}

impl Case {
    /// Of `subject`, by `who`, without limits.
    pub(crate) const fn new(
        subject: &'static str,
        who: &'static str,
        prepare: fn() -> Work,
    ) -> Self {
        Self { subject, who, prepare, limits: &[], is_long: false }
    }

    /// With these limits.
    pub(crate) const fn within(self, limits: &'static [Limit]) -> Self {
        Self { limits, ..self }
    }

    /// Counted with `--renew` only.
    pub(crate) const fn long(self) -> Self {
        Self { is_long: true, ..self }
    }

    /// Whether something depends on what this costs.
    pub(crate) fn is_gated(&self) -> bool {
        if self.is_long {
            return false;
        }
        let is_named = |limit: &Limit| limit.against() == self.who;
        !self.limits.is_empty()
            || crate::all().any(|it| it.subject == self.subject && it.limits.iter().any(is_named))
    }
}

/// Work on each of the inputs in turn. The compiler may foresee neither what goes in nor that
/// nothing of what comes out is needed.
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
