//! Patterns of names.

/// A case-insensitive pattern of names.
///
/// ```
/// use ads_cnc_conformance::text::Pattern;
///
/// let part = Pattern::part("single_block");
/// assert!(part.matches("mc_active_single_block_r") && !part.matches("mc_program_stream_w"));
/// // A star matches any number of characters, and a question mark matches one character. A pattern
/// // with a star or a question mark must match the whole name.
/// assert!(Pattern::part("v.g.np[?].*").matches("V.G.NP[0].V"));
/// assert!(!Pattern::part("single?block*").matches("mc_active_single_block_r"));
/// assert!(Pattern::whole("COM channel 1").matches("COM channel 1"));
/// assert!(!Pattern::whole("COM channel 1").matches("COM channel 12"));
/// ```
#[derive(Clone, Debug)]
pub struct Pattern {
    wanted: Vec<char>,
}

impl Pattern {
    /// Creates a pattern that matches any name containing `text`; if `text` has a star or a
    /// question mark, the pattern must match the whole name.
    pub fn part(text: &str) -> Self {
        if text.contains(['*', '?']) {
            Self::whole(text)
        } else {
            Self::whole(&format!("*{text}*"))
        }
    }

    pub fn whole(text: &str) -> Self {
        Self { wanted: folded(text).collect() }
    }

    /// Whether a name matches.
    pub fn matches(&self, name: &str) -> bool {
        let name: Vec<char> = folded(name).collect();
        let (mut pattern, mut rest) = (self.wanted.as_slice(), name.as_slice());
        // Where to continue after a mismatch: the pattern after the last star, and the name one
        // character later than at the last attempt.
        let mut back: Option<(&[char], &[char])> = None;
        loop {
            match (pattern.split_first(), rest.split_first()) {
                (Some(('*', after)), _) => {
                    back = Some((after, rest));
                    pattern = after;
                }
                (Some((wanted, after)), Some((found, later)))
                    if *wanted == '?' || wanted == found =>
                {
                    (pattern, rest) = (after, later);
                }
                (None, None) => return true,
                _ => match back.and_then(|(after, rest)| Some((after, rest.split_first()?.1))) {
                    Some((after, later)) => {
                        back = Some((after, later));
                        (pattern, rest) = (after, later);
                    }
                    None => return false,
                },
            }
        }
    }
}

fn folded(text: &str) -> impl Iterator<Item = char> + '_ {
    text.chars().flat_map(char::to_lowercase)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stars_match_any_number_of_characters() {
        for (pattern, name, matches) in [
            ("*", "", true),
            ("?", "", false),
            ("a*b*c", "axxbyybzzc", true),
            ("a*b*c", "axxbyybzz", false),
            ("*ab", "aab", true),
            ("**", "x", true),
            ("a**?", "a", false),
            ("L?NGE*", "länge", true),
        ] {
            assert_eq!(Pattern::whole(pattern).matches(name), matches, "{pattern} {name}");
        }
    }
}
