//! Finds the names that are most similar to a misspelt name.

/// Maximum number of names that are returned.
const NEAREST_MAX: usize = 3;

/// Maximum number of characters of words that are compared.
const COMPARED_MAX: usize = 256;

/// The names that are most similar to a word, at most [`NEAREST_MAX`], the most similar first. A
/// name is similar if it contains the word and this has at least three characters, or if the number
/// of edits between both is at most 1 or at most a third of the number of characters of the word.
/// Case is ignored.
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
            // A name that contains the word is less similar than a name that differs in a few
            // characters.
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

/// ` - did you mean …?` with the most similar names; empty if no name is similar.
pub(crate) fn did_you_mean<'n>(word: &str, names: impl IntoIterator<Item = &'n str>) -> String {
    match nearest(word, names).as_slice() {
        [] => String::new(),
        names => format!(" - did you mean {}?", names.join(" or ")),
    }
}

/// The optimal string alignment distance of two words: the minimum number of edits if no part is
/// edited twice. An edit inserts, deletes or replaces a character, or swaps it with the next one.
fn distance(one: &[char], other: &[char]) -> usize {
    // `last` contains the distances of all prefixes of `other` to the current prefix of `one`,
    // `before` the distances to the prefix that is one character shorter.
    let (mut before, mut last): (Vec<usize>, Vec<usize>) =
        (Vec::new(), (0..=other.len()).collect());
    let mut previous = None;
    for a in one {
        let at = |line: &[usize], column: usize| line.get(column).copied().unwrap_or(usize::MAX);
        let more = |distance: usize| distance.saturating_add(1);
        let mut next = vec![more(at(&last, 0))];
        let mut left = None;
        for (column, b) in other.iter().enumerate() {
            let replaced = at(&last, column).saturating_add(usize::from(a != b));
            let deleted = more(at(&last, column.saturating_add(1)));
            let inserted = more(at(&next, column));
            let is_swapped = left == Some(a) && previous == Some(b);
            let swapped = match column.checked_sub(1).filter(|_| is_swapped) {
                Some(column) => more(at(&before, column)),
                None => usize::MAX,
            };
            next.push(replaced.min(deleted).min(inserted).min(swapped));
            left = Some(b);
        }
        before = std::mem::replace(&mut last, next);
        previous = Some(a);
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
