//! `ads-cnc requirements`: prints requirements with the vectors, cases, tests and fuzz targets that
//! verify them, and errata.

use ads_cnc::layout::Stream;
use ads_cnc::operation::Function;
use ads_cnc_vectors::{Erratum, erratum};

use super::message::{exit_with_error, print_error};
use super::output::print_output;
use crate::exit::Exit;
use crate::judge::{clauses_of, matches, names, sections};
use crate::matrix::{self, RequirementRow};
use crate::text::did_you_mean;

/// Print requirements: text, sources, rulings, vectors, cases and tests
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:\n  ads-cnc requirements VAR-11\n  \
    ads-cnc requirements variable-description\n  \
    ads-cnc requirements VAR --format json\n\n\
    Exit codes: 0 printed, 2 wrong usage, 3 no requirement matches, 70 internal error")]
pub(super) struct Requirements {
    /// An area (VAR), a requirement (VAR-11), a section of a manual (ads:4.3), a stream
    /// (variable-description), a function (ReadByName), the ID of a case or an erratum (E-17)
    /// [default: all requirements]
    #[arg(value_name = "AREA|ID|STREAM", conflicts_with = "only")]
    wanted: Vec<String>,

    /// Same as the argument, under the name that the option has in run; repeatable
    #[arg(long, value_name = "AREA|ID|STREAM")]
    only: Vec<String>,

    /// Output format
    #[arg(long, value_enum, default_value = "text")]
    format: RequirementsFormat,
}

#[derive(Clone, Copy, Debug, clap::ValueEnum)]
enum RequirementsFormat {
    Text,
    Markdown,
    Json,
    /// The sections of the manuals, each with its coverage
    Sections,
}

impl Requirements {
    pub(super) fn execute(&self) -> Exit {
        let mut rows = matrix::matrix();
        let errata: Vec<&Erratum> =
            self.words().filter_map(|word| erratum(&word.to_ascii_uppercase())).collect();
        if !errata.is_empty() && !matches!(self.format, RequirementsFormat::Text) {
            let why = "an erratum is printed only with --format text";
            return exit_with_error(Exit::Usage, why);
        }
        let is_known = |word: &str| {
            errata.iter().any(|one| one.id.eq_ignore_ascii_case(word))
                || rows.iter().any(|row| is_named(row, word))
        };
        let unknown: Vec<&String> = self.words().filter(|word| !is_known(word)).collect();
        if !unknown.is_empty() {
            unknown.into_iter().for_each(|word| print_error(no_such(word, &rows)));
            return Exit::Nothing;
        }
        rows.retain(|row| {
            self.words().next().is_none() || self.words().any(|word| is_named(row, word))
        });
        let text = match self.format {
            RequirementsFormat::Text => {
                let errata = errata.into_iter().map(matrix::erratum_to_text);
                let rows = (!rows.is_empty()).then(|| matrix::to_text(&rows));
                Ok(errata.chain(rows).collect::<Vec<_>>().join("\n"))
            }
            RequirementsFormat::Markdown => Ok(matrix::to_markdown(&rows)),
            RequirementsFormat::Sections => Ok(matrix::to_sections(&rows)),
            RequirementsFormat::Json => serde_json::to_string_pretty(&rows).map(|json| json + "\n"),
        };
        print_output(|out| out.write_all(text?.as_bytes()))
    }

    fn words(&self) -> impl Iterator<Item = &String> {
        self.wanted.iter().chain(&self.only)
    }
}

/// Whether the word or pattern names the requirement in this row, its area, one of its parts or
/// sections, or a case in the row. It may name a vector or sequence by the ID of its case (`vec-…`,
/// `seq-…`). A word may also name a stream whose table cites the requirement, or a function that
/// the requirement defines.
fn is_named(row: &RequirementRow, word: &str) -> bool {
    let has =
        |ids: &[String], prefix: &str| ids.iter().any(|id| matches(word, &format!("{prefix}{id}")));
    names(word, &row.id)
        || clauses(word).iter().any(|clause| names(clause, &row.id))
        || has(&row.cases, "")
        || ["vec-", "seq-"].iter().any(|kind| has(&row.accepted, kind) || has(&row.rejected, kind))
}

/// The message for a word that matches neither a row nor an erratum, with similar names.
fn no_such(word: &str, rows: &[RequirementRow]) -> String {
    let functions = Function::ALL.iter().map(|one| id(*one));
    let made: Vec<String> = functions.chain(sections()).collect();
    let ids = rows.iter().flat_map(|row| {
        let area = row.id.split('-').next().unwrap_or(&row.id);
        [area, &row.id].into_iter().chain(row.cases.iter().map(String::as_str))
    });
    let streams = Stream::all().map(|stream| stream.layout().name);
    let near = did_you_mean(word, ids.chain(streams).chain(made.iter().map(String::as_str)));
    format!(
        "no requirement, area, section, stream, function, case or erratum has the ID {word}{near}"
    )
}

/// The clauses of the stream of this name and of its fields, or of the function of this name.
fn clauses(name: &str) -> Vec<&'static str> {
    let streams = Stream::by_name(&name.to_ascii_lowercase()).into_iter();
    let functions = Function::ALL.iter().filter(|one| name.eq_ignore_ascii_case(&id(**one)));
    let functions = functions.map(|function| function.spec().clause);
    streams.flat_map(clauses_of).chain(functions).collect()
}

/// The name of the variant of [`Function`], for example `ReadByName`.
fn id(function: Function) -> String {
    format!("{function:?}")
}
