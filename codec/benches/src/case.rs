//! The cases, with their limits.

/// A measured case.
#[derive(Clone, Copy)]
pub struct Case {
    /// The subject, such as `description`.
    pub subject: &'static str,
    /// The implementation, such as `borrowed` or `by hand`.
    pub who: &'static str,
    /// Creates the inputs; not measured.
    pub prepare: fn() -> Work,
    /// The limits of its cost.
    pub limits: &'static [Limit],
    /// Whether it takes too long to be counted on every change.
    pub is_long: bool,
}

/// A limit of the cost of a case.
#[derive(Clone, Copy)]
pub enum Limit {
    /// A multiple of the instructions of another case of the same subject.
    Instructions(&'static str, f64),
    /// A multiple of the time of another case of the same subject.
    Time(&'static str, f64),
    /// A number of instructions per unit more than another case of the same subject.
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

/// Work that can be repeated.
pub struct Work {
    /// The number of units in a run: records, bytes or calls. Figures are per unit.
    pub units: u64,
    /// One run.
    pub run: Box<dyn FnMut()>,
}

impl Case {
    /// A case of `subject`, by the implementation `who`, without limits.
    pub(crate) const fn new(
        subject: &'static str,
        who: &'static str,
        prepare: fn() -> Work,
    ) -> Self {
        Self { subject, who, prepare, limits: &[], is_long: false }
    }

    /// Adds these limits.
    pub(crate) const fn within(self, limits: &'static [Limit]) -> Self {
        Self { limits, ..self }
    }

    /// Makes the case counted with `--renew` only.
    pub(crate) const fn long(self) -> Self {
        Self { is_long: true, ..self }
    }

    /// Whether a limit depends on the cost of this case.
    pub(crate) fn is_gated(&self) -> bool {
        if self.is_long {
            return false;
        }
        let is_named = |limit: &Limit| limit.against() == self.who;
        !self.limits.is_empty()
            || crate::all().any(|it| it.subject == self.subject && it.limits.iter().any(is_named))
    }
}

/// Processes each input in turn. The compiler can predict neither the inputs nor that the results are
/// unused.
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
