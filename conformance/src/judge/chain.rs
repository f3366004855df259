//! The chains of functions, and the clauses that define a function. In a chain, the replies of
//! earlier functions determine the requests of a later function, or the expected values in its
//! replies.

use std::collections::HashSet;

use ads_cnc::layout::Stream;
use ads_cnc::operation::Function;

/// The functions whose replies directly determine the requests of `function`, or the expected
/// values in its replies.
const fn sources(function: Function) -> &'static [Function] {
    use Function::*;
    match function {
        ReadDescriptors => &[CountObjects],
        ReadObject | WriteObject | WriteProgramStream => &[ReadDescriptors],
        DescribeByIndex | DescribeExtended => &[CountVariables],
        HandleByName | DescribeByName | ReadByName | WriteByName => &[DescribeByIndex],
        AxisHandleByName | AxisReadByName | AxisWriteByName => &[DescribeByIndex],
        ReadByHandle | WriteByHandle => &[DescribeByIndex, HandleByName],
        DynamicNameByIndex => &[CountDynamic],
        DynamicValueByName => &[DynamicNameByIndex],
        DynamicValueByIndex => &[CountDynamic, DynamicNameByIndex],
        CountElements => &[FindInstance],
        ReadElementName | ReadElementType | ReadElementLength => &[CountElements],
        ReadElementUnit | ReadElementWriteFlag => &[CountElements],
        ReadElement | WriteElement => &[CountElements, ReadElementLength, ReadElementType],
        _ => &[],
    }
}

/// All functions before `function` in a chain.
pub(super) fn before(function: Function) -> HashSet<Function> {
    let mut all = HashSet::new();
    let mut pending = vec![function];
    while let Some(next) = pending.pop() {
        pending.extend(sources(next).iter().filter(|source| all.insert(**source)));
    }
    all
}

/// Whether the requests of `function`, or the expected values in its replies, depend on the replies
/// of `earlier`.
pub(crate) fn follows(function: Function, earlier: Function) -> bool {
    before(function).contains(&earlier)
}

/// The first function of the chain of `function`.
pub(super) fn origin(function: Function) -> Function {
    let mut first = function;
    while let [source, ..] = sources(first) {
        first = *source;
    }
    first
}

/// The clauses of a stream and its fields.
pub(crate) fn clauses_of(stream: Stream) -> impl Iterator<Item = &'static str> {
    let layout = stream.layout();
    layout.fields.iter().map(|field| field.clause).chain([layout.clause])
}

/// Whether the clause defines the function, the stream of its request or reply, or a field of such
/// a stream.
pub(super) fn defines(clause: &str, function: Function) -> bool {
    let spec = function.spec();
    let mut streams = [spec.request, spec.reply].into_iter().flatten();
    spec.clause == clause || streams.any(|stream| clauses_of(stream).any(|one| one == clause))
}

/// Whether the clause belongs to an area whose clauses are about particular functions, so that its
/// failure can show that a function is wrong.
pub(super) fn is_of_functions(clause: &str) -> bool {
    let area = clause.split_once('-').map_or(clause, |(area, _)| area);
    !matches!(area, "GEN" | "ADR" | "ADS" | "OBJ")
}

/// Whether a failure of the clause `cause` can be the cause of a failure of `clause`. It cannot if
/// both clauses define the same function, if `clause` defines an earlier function than `cause`, or
/// if only `clause` defines a function.
pub(super) fn can_explain(cause: &str, clause: &str) -> bool {
    // Every clause of streaming (STM) is treated as a clause of this function.
    let is_of = |clause: &str, function| {
        defines(clause, function)
            || clause.starts_with("STM") && function == Function::WriteProgramStream
    };
    let homes = |clause| Function::ALL.iter().filter(move |one| is_of(clause, **one));
    // A clause that defines no function, such as a clause about addresses, is not the cause if a
    // clause that defines a function fails.
    (homes(cause).next().is_some() || homes(clause).next().is_none())
        && homes(cause).all(|home| !homes(clause).any(|one| one == home || follows(*home, *one)))
}
