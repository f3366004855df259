//! The nearest of several names to a misspelt one.

/// The names nearest to a word, at most this many.
const NEAREST_MAX: usize = 3;

/// Maximum number of characters of words that are compared.
const COMPARED_MAX: usize = 256;

/// The names that the word may stand for, the nearest first: without regard to case they differ in a
/// third of their characters at most, or contain the word.
pub(crate) fn nearest<'n>(word: &str, names: impl IntoIterator<Item = &'n str>) -> Vec<&'n str> {
    let lower: Vec<char> = word.to_lowercase().chars().take(COMPARED_MAX).collect();
    if lower.is_empty() {
        return Vec::new();
    }
    let limit = (lower.len() / 3).max(1);
    let text: String = lower.iter().collect();
    let mut found: Vec<(usize, &str)> = names
        .into_iter()
        .filter_map(|name| {
            let other = name.to_lowercase();
            // A part of a name is farther than any misspelling.
            let is_part = lower.len() > 2 && other.contains(&text);
            let chars: Vec<char> = other.chars().take(COMPARED_MAX).collect();
            let far = chars.len().abs_diff(lower.len()) > limit;
            let distance = if far { usize::MAX } else { distance(&lower, &chars) };
            match (distance <= limit, is_part) {
                (true, _) => Some((distance, name)),
                (false, true) => Some((limit.saturating_add(other.len()), name)),
                (false, false) => None,
            }
        })
        .collect();
    found.sort_unstable();
    found.dedup();
    found.into_iter().take(NEAREST_MAX).map(|(_, name)| name).collect()
}

/// ` - did you mean …?` with the nearest names; empty without one.
pub(crate) fn did_you_mean<'n>(word: &str, names: impl IntoIterator<Item = &'n str>) -> String {
    match nearest(word, names).as_slice() {
        [] => String::new(),
        names => format!(" - did you mean {}?", names.join(" or ")),
    }
}

/// The number of characters to insert, delete, replace or swap with the next.
fn distance(one: &[char], other: &[char]) -> usize {
    let mut before: Vec<usize> = Vec::new();
    let mut last: Vec<usize> = (0..=other.len()).collect();
    for (row, a) in one.iter().enumerate() {
        let mut next = vec![row + 1];
        for (column, b) in other.iter().enumerate() {
            let at =
                |line: &[usize], column: usize| line.get(column).copied().unwrap_or(usize::MAX);
            let mut best = at(&last, column).saturating_add(usize::from(a != b));
            best = best.min(at(&last, column + 1).saturating_add(1));
            best = best.min(at(&next, column).saturating_add(1));
            let swapped = row > 0
                && column > 0
                && one.get(row - 1) == Some(b)
                && other.get(column - 1) == Some(a);
            if swapped {
                best = best.min(at(&before, column - 1).saturating_add(1));
            }
            next.push(best);
        }
        before = std::mem::replace(&mut last, next);
    }
    last.last().copied().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_misspelt_name_is_found() {
        let names = ["run", "serve", "report", "V.E.Testvar", "V.E.matrix", "size.flip"];
        let nearest = |word| nearest(word, names);
        assert_eq!(nearest("rnu"), ["run"]);
        assert_eq!(nearest("V.E.Testvr"), ["V.E.Testvar"]);
        assert_eq!(nearest("v.e.MATRIX"), ["V.E.matrix"]);
        assert_eq!(nearest("size"), ["size.flip"]);
        assert_eq!(nearest("x"), [""; 0]);
        assert_eq!(nearest(""), [""; 0]);
        assert_eq!(did_you_mean("reprt", names), " - did you mean report?");
        assert_eq!(did_you_mean("zzzz", names), "");
    }
}
