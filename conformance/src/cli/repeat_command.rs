//! The command line in a report that repeats a run.

/// Options with a value that [`again`] removes: the report adds its own selection and seed, and the
/// other options write files, name waivers or affect only the output.
const LEFT_OUT: [&str; 11] = [
    "--seed",
    "--only",
    "--json",
    "--html",
    "--junit",
    "--markdown",
    "--badge",
    "--color",
    "--log",
    "--capture",
    "--waivers",
];
/// Options without a value that [`again`] removes, because they affect only the output.
const FLAGS_LEFT_OUT: [&str; 4] = ["-v", "--verbose", "-q", "--quiet"];

/// Returns the command line of `ads-cnc run` with these arguments, without the options in
/// `LEFT_OUT` and `FLAGS_LEFT_OUT`.
pub(super) fn again(arguments: impl IntoIterator<Item = String>) -> String {
    let mut words = vec!["ads-cnc".to_owned(), "run".to_owned()];
    let mut arguments = arguments.into_iter();
    while let Some(word) = arguments.next() {
        let name = word.split('=').next().unwrap_or_default();
        // The subcommand is the first word that is left; a later `run` is the value of an option.
        let is_subcommand = word == "run" && words.len() == 2;
        if LEFT_OUT.contains(&name) {
            if name == word {
                arguments.next();
            }
        } else if !is_subcommand && !FLAGS_LEFT_OUT.contains(&word.as_str()) {
            words.push(quoted(&word));
        }
    }
    words.join(" ")
}

/// A word as written in a POSIX shell: in quotes if it is empty or has other than plain characters.
fn quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_./:=,@%+".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        return word.to_owned();
    }
    format!("'{}'", word.replace('\'', "'\\''"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reports_and_selection_are_left_out() {
        let line = |text: &str| again(text.split(' ').map(str::to_owned));
        assert_eq!(
            line("run --target 192.0.2.1 --seed 7 --json=r.json -v --only VAR --edition de-1.051"),
            "ads-cnc run --target 192.0.2.1 --edition de-1.051"
        );
        assert_eq!(line("--log debug run --client run"), "ads-cnc run --client run");
        let command = ["run", "--testee", "python3 it's.py"].map(str::to_owned);
        assert_eq!(again(command), "ads-cnc run --testee 'python3 it'\\''s.py'");
    }
}
