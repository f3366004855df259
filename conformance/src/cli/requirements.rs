//! `ads-cnc requirements`: prints the traceability matrix.

use std::io::{self, Write as _};

use super::message::print_error;
use crate::judge::{Exit, names};
use crate::matrix::{self, RequirementRow};
use crate::tables::Tables;
use crate::text::did_you_mean;

/// Print requirements: text, sources, rulings, vectors, cases and tests
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:\n  ads-cnc requirements VAR-11\n  \
    ads-cnc requirements variable-description\n  \
    ads-cnc requirements VAR --format json\n\n\
    Exit codes: 0 printed, 2 wrong usage, 3 no requirement matches, 70 internal error")]
pub(super) struct Requirements {
    /// An area (VAR), a requirement (VAR-11), a stream (variable-description), a function
    /// (ReadByName) or the ID of a case [default: all requirements]
    #[arg(value_name = "AREA|STREAM|ID", conflicts_with = "only")]
    wanted: Vec<String>,

    /// Same as the argument, with the option name of run; repeatable
    #[arg(long, value_name = "AREA|STREAM|ID")]
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
        let tables = Tables::new();
        rows.retain(|row| self.matches(row, &tables));
        if rows.is_empty() {
            let rows = matrix::matrix();
            let ids = rows.iter().flat_map(|row| {
                let id = row.id.as_str();
                let area = id.split('-').next().unwrap_or(id);
                [area, id].into_iter().chain(row.cases.iter().map(String::as_str))
            });
            let streams = tables.streams.iter().map(|stream| stream.name);
            let functions = tables.functions.iter().map(|function| function.id.as_str());
            let ids: Vec<&str> = ids.chain(streams).chain(functions).collect();
            for word in self.wanted.iter().chain(&self.only) {
                let near = did_you_mean(word, ids.iter().copied());
                print_error(format_args!(
                    "no requirement, area, stream, function or case has the ID {word}{near}"
                ));
            }
            return Exit::Nothing;
        }
        let text = match self.format {
            RequirementsFormat::Text => Ok(matrix::to_text(&rows)),
            RequirementsFormat::Markdown => Ok(matrix::to_markdown(&rows)),
            RequirementsFormat::Sections => Ok(matrix::to_sections(&rows)),
            RequirementsFormat::Json => serde_json::to_string_pretty(&rows).map(|json| json + "\n"),
        };
        let printed = text.map_err(io::Error::from).and_then(|text| {
            let mut out = io::stdout().lock();
            out.write_all(text.as_bytes()).and_then(|()| out.flush())
        });
        match printed {
            Ok(()) => Exit::Success,
            // The reader closed the pipe on purpose.
            Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Exit::Success,
            Err(error) => {
                print_error(format_args!("cannot write the requirements: {error}"));
                Exit::Internal
            }
        }
    }

    fn matches(&self, row: &RequirementRow, tables: &Tables) -> bool {
        let has = |only: &str, ids: &[String], prefix: &str| {
            ids.iter().any(|id| only.eq_ignore_ascii_case(&format!("{prefix}{id}")))
        };
        let named = |only: &String| {
            names(only, &row.id)
                || clauses(only, tables).any(|clause| names(clause, &row.id))
                || has(only, &row.cases, "")
                || has(only, &row.accepted, "vec-")
                || has(only, &row.rejected, "vec-")
        };
        let wanted = || self.wanted.iter().chain(&self.only);
        wanted().next().is_none() || wanted().any(named)
    }
}

/// The clauses of the stream or function of this name.
fn clauses<'t>(name: &'t str, tables: &'t Tables) -> impl Iterator<Item = &'static str> + 't {
    let streams = tables.streams.iter().filter(|stream| name.eq_ignore_ascii_case(stream.name));
    let streams = streams.flat_map(|stream| {
        let fields = stream.fields.iter().map(|field| field.clause);
        [stream.clause].into_iter().chain(fields)
    });
    let functions = tables.functions.iter().filter(|one| name.eq_ignore_ascii_case(&one.id));
    streams.chain(functions.map(|function| function.clause))
}
