//! Finds the calls in a document, and compares their output.

/// A call in a block ```console and the output that the document shows below the call.
#[derive(Debug, Default)]
pub(crate) struct Shown {
    pub(crate) call: String,
    pub(crate) output: String,
}

/// All calls of a document, in order.
pub(crate) fn calls(document: &str) -> Vec<Shown> {
    let mut all: Vec<Shown> = Vec::new();
    for block in document.split("```console\n").skip(1) {
        let (block, _) = block.split_once("```").unwrap();
        let block = block.replace("\\\n", "");
        let mut is_first = true;
        for line in block.lines() {
            match (line.strip_prefix("$ "), all.last_mut()) {
                (Some(call), _) => all.push(Shown { call: call.to_owned(), ..Shown::default() }),
                (None, Some(last)) if !is_first => last.output.push_str(&format!("{line}\n")),
                _ => panic!("a block that begins with no call: {line}"),
            }
            is_first = false;
        }
    }
    all
}

/// Splits a call into words at the spaces outside of quotes, and removes the quotes.
pub(crate) fn words(call: &str) -> Vec<String> {
    let (mut words, mut quote, mut open) = (vec![String::new()], None, false);
    for character in call.chars() {
        match (character, quote) {
            ('\'' | '"', None) => quote = Some(character),
            (end, Some(begun)) if end == begun => quote = None,
            (' ', None) => open = true,
            _ => {
                if std::mem::take(&mut open) {
                    words.push(String::new());
                }
                words.last_mut().unwrap().push(character);
            }
        }
    }
    words
}

/// Whether the output matches the shown output line by line. A shown line with only … matches any
/// number of lines, and a shown line that ends in … matches any line with the same beginning. Some
/// values that may differ from run to run are ignored, such as ports, seeds and times.
pub(crate) fn fits(shown: &str, output: &str) -> bool {
    let lines = |text: &str| text.lines().map(steady).collect::<Vec<_>>();
    all_fit(&lines(shown), &lines(output))
}

fn all_fit(shown: &[String], output: &[String]) -> bool {
    let Some((line, below)) = shown.split_first() else {
        return output.is_empty();
    };
    if line.trim() == "…" {
        return (0..=output.len()).any(|skipped| all_fit(below, &output[skipped..]));
    }
    output.split_first().is_some_and(|(first, rest)| {
        let is_begun = line.strip_suffix('…').is_some_and(|begin| first.starts_with(begin));
        (line == first || is_begun) && all_fit(below, rest)
    })
}

/// The line without the number after each of some words.
fn steady(line: &str) -> String {
    let mut line = line.to_owned();
    for words in ["127.0.0.1:", "seed ", "cases, ", "checks, ", "within ", " s ("] {
        let mut parts = line.split(words);
        let mut steady = parts.next().unwrap_or_default().to_owned();
        for part in parts {
            let is_number = |character: char| character.is_ascii_digit() || character == '.';
            steady.push_str(words);
            steady.push_str(part.trim_start_matches(is_number));
        }
        line = steady;
    }
    line
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn different_output_does_not_match() {
        let output = "a\nb\n\nlast, seed 7\n";
        for shown in ["…\n", "a\n…\n", "a\nb\n\nlast, seed 8\n", "a\n…\nla…\n", "…\nb\n…\n"]
        {
            assert!(fits(shown, output), "{shown}");
        }
        for shown in ["", "a\n", "b\n…\n", "a\n…\nb\n", "a\n…\nlast, seed x\n", "…\nc\n…\n"]
        {
            assert!(!fits(shown, output), "{shown}");
        }
    }
}
