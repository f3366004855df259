//! The types of elements, by name.

use ads_cnc_vectors::ids::*;

use crate::judge::{Checks as _, Rule, assumed, online};
use crate::suite::kit::Probe;

/// The size of a type, and whether a manual prints it or only online help does. The tables of
/// dynamic parameters print those of UNS32 and REAL64, an example that of BOOLEAN.
fn size_of(type_name: &str) -> Option<(u32, bool)> {
    Some(match type_name {
        "BOOLEAN" => (1, true),
        "UNS08" | "SGN08" => (1, false),
        "UNS16" | "SGN16" => (2, false),
        "UNS32" => (4, true),
        "SGN32" | "REAL32" => (4, false),
        "REAL64" => (8, true),
        _ => return None,
    })
}

/// The rule for a name that is not in the manual's list: a name of the same pattern with another
/// width may continue the list; another name for a listed type breaks it.
fn rule_of(type_name: &str) -> Rule {
    let digits = ["UNS", "SGN", "REAL"].into_iter().find_map(|one| type_name.strip_prefix(one));
    let is_alike = digits.is_some_and(|digits| {
        digits.len() == 2 && digits.bytes().all(|byte| byte.is_ascii_digit())
    });
    if is_alike || type_name == "STRING" { assumed(SDA_7) } else { SDA_7.into() }
}

/// Checks that type and length of an element match; returns whether the type is one of the manual.
pub(crate) fn type_and_length(
    probe: &mut Probe<'_>,
    type_name: &str,
    length: u32,
    at: &str,
) -> bool {
    let known = size_of(type_name);
    let found = || format!("{type_name:?} of {at}");
    let is_known = known.is_some() || type_name == "STRING";
    probe.check(rule_of(type_name), is_known, "one of the types of the manual", found);
    let found = || format!("{length} bytes of {at}, {type_name}");
    let Some((size, is_printed)) = known else {
        probe.check(assumed(SDA_8), length > 0, "a number of bytes", found);
        return is_known;
    };
    let expected = || format!("the {size} bytes of {type_name}");
    // Either the type or the length is wrong.
    let [of_name, of_length] =
        if is_printed { [SDA_7, SDA_8].map(Rule::from) } else { [SDA_7, SDA_8].map(online) };
    let of_type = if type_name == "BOOLEAN" { GEN_5.into() } else { online(GEN_5) };
    probe.check([of_name, of_length, of_type], length == size, expected, found);
    probe.check(SDA_8, length > 0, "a number of bytes", found);
    is_known
}

#[cfg(test)]
mod tests {
    use ads_cnc_vectors::Level;

    use super::*;

    #[test]
    fn names_that_are_none() {
        for other in ["UNS64", "SGN64", "REAL80", "STRING"] {
            assert_eq!(rule_of(other).level, Some(Level::Info), "{other}");
        }
        for wrong in ["UNS8", "uns08", "DWORD", "BOOL", "", "UNS008", "REAL"] {
            assert_eq!(rule_of(wrong).level, Some(Level::Must), "{wrong:?}");
        }
    }
}
