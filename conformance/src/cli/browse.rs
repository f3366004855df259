//! `ads-cnc browse`: lists the objects and elements of a CNC, or its variables and parameters.

use std::io;

use ads_cnc::address::Channel;
use clap::{Args, ValueEnum};

use super::message::print_error;
use super::model::ModelArgs;
use super::name_args::no_channel;
use super::output::print;
use super::progress::ProgressLine;
use super::target::{DeadlineArgs, REACHING_A_DEVICE, TargetArgs, channel};
use crate::exit::Exit;
use crate::objects::{
    ListedValue, NAMES_MAX, OBJECTS_MAX, ObjectReport, ObjectsReport, Options, Pattern,
    REQUESTS_MAX, VALUE, WalkResult, absent_of, channels_of, columns, csv, table, walk,
};
use crate::session::{Session, ToolError};
use crate::text::{hex, json, plural};
use crate::values::plain;

/// Maximum number of characters of a value in a table, before an ellipsis; CSV and JSON shorten no
/// value.
const VALUE_MAX: usize = 48;
/// Maximum size in bytes of a value that is read; `get` reads larger values.
const CONTENT_MAX: u32 = 0x1_0000;

/// List objects and elements, or all variables
///
/// The command writes nothing and sends as few requests as possible: it reads descriptors in
/// ranges, channels by number until all are found, and axes and spindles until one does not exist.
/// Each element takes one request, and four more for its type, length, unit and access unless an
/// element with the same name and position in the class is already known; --exact sends them for
/// every element. No manual says which of the tasks SDA and GEO has a class: the command queries
/// GEO for the classes that SDA does not have. --of and --filter save requests, --rate limits their
/// rate.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES, after_long_help = format!("{EXAMPLES}\n\n{REACHING_A_DEVICE}"))]
pub(super) struct Browse {
    /// List variables by their descriptions (V.G, V.E, V.A) and parameters (P, V.L, V.P, V.S);
    /// V.CYC has no list
    #[arg(long)]
    variables: bool,

    /// List only names that contain PATTERN, or match it as a whole if it has * or ?; ignores case
    #[arg(long, value_name = "PATTERN")]
    filter: Option<String>,

    /// Read only lists with this whole name, as in the table; * and ? match: "COM *", "decoder
    /// channel 1"
    #[arg(long, value_name = "LIST")]
    of: Option<String>,

    /// Read only these channels [default: all active channels]
    #[arg(long, value_name = "N,…", value_delimiter = ',', value_parser = channel)]
    channel: Vec<Channel>,

    /// Also read the values
    #[arg(long)]
    content: bool,

    /// Request every attribute of every element
    #[arg(long, conflicts_with = "variables")]
    exact: bool,

    /// Output format
    #[arg(long, value_name = "FORMAT", default_value = "table")]
    format: BrowseFormat,

    /// Same as --format json
    #[arg(long, conflicts_with = "format")]
    json: bool,

    #[command(flatten)]
    target: TargetArgs,

    #[command(flatten)]
    deadline: DeadlineArgs,

    #[command(flatten)]
    model: ModelArgs,
}

const EXAMPLES: &str = "\
Examples:
  ads-cnc browse
  ads-cnc browse --of \"COM *\" --filter single_block --content
  ads-cnc browse --variables --filter \"V.G.*\"
  ads-cnc browse --format csv --target 192.0.2.10 --net-id 192.0.2.10.1.1 --rate 200 > objects.csv

Limits: 100000 objects with 8 MiB of names and dimensions, 1000000 requests and 8 MiB of values.

Exit codes: 0 listed; 2 wrong usage; 3 no reply, no match, a channel that does not exist, or a
maximum or the deadline was reached; 4 rejected for safety; 70 internal error. Requests that the CNC
rejects are noted on stderr, and their results are omitted.";

/// The help text contains these limits: if one changes, change the help text, too.
const _: () = assert!(
    OBJECTS_MAX == 100_000
        && REQUESTS_MAX == 1_000_000
        && NAMES_MAX == 8 << 20
        && CONTENTS_MAX == 8 << 20
);

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum BrowseFormat {
    /// Readable table
    Table,
    /// Comma-separated values with a header line
    Csv,
    /// One JSON document
    Json,
}

/// Size of all values together after which no more values are read, in bytes. A value counts once
/// for each dimension, because each dimension multiplies the size of the value in JSON.
const CONTENTS_MAX: usize = 8 << 20;

/// The bytes of a value, or the reason why it was not read.
type ReadContent = Result<Vec<u8>, String>;

impl Browse {
    pub(super) fn execute(&self) -> Exit {
        self.target.end(self.run(), |_| None)
    }

    fn run(&self) -> Result<Exit, ToolError> {
        let mut session = self.model.open(&self.target)?.with_deadline(self.deadline.begin());
        let options = Options {
            channels: self.channel.clone(),
            lists: self.of.as_deref().map(Pattern::whole),
            names: self.filter.as_deref().map(Pattern::part),
            variables: self.variables,
            exact: self.exact,
        };
        let absent = absent_of(&mut session, &self.channel)?;
        if !absent.is_empty() && self.channel.iter().all(|one| absent.contains(one)) {
            print_error(no_channel(&absent, &channels_of(&mut session)?));
            return Ok(Exit::Nothing);
        }
        let mut progress = ProgressLine::new();
        let mut found = walk(&mut session, &options, &mut |seen| {
            progress.update(|| {
                format!(
                    "{}: {} found, {}",
                    seen.list,
                    seen.objects,
                    plural(seen.requests, "request")
                )
            });
        })?;
        let contents = if self.content {
            Some(read_all(&mut session, &mut found, &mut progress)?)
        } else {
            None
        };
        drop(progress);
        self.write(&session, &found, contents.as_deref())?;
        for note in &found.notes {
            print_error(note);
        }
        if !absent.is_empty() {
            print_error(no_channel(&absent, &channels_of(&mut session)?));
            return Ok(Exit::Nothing);
        }
        if found.objects.is_empty() {
            print_error(match (&self.filter, &self.of, self.variables) {
                (None, None, false) => "the CNC has no objects; --variables lists its variables",
                (None, None, true) => "the CNC has no variables",
                (Some(name), ..) if !self.variables && name.to_uppercase().starts_with("V.") => {
                    "no match: --variables lists variables"
                }
                _ => "no match: --filter takes a part of a name, --of the whole name of a list",
            });
            return Ok(Exit::Nothing);
        }
        Ok(if found.is_cut { Exit::Nothing } else { Exit::Success })
    }

    fn write(
        &self,
        session: &Session,
        found: &WalkResult,
        contents: Option<&[ReadContent]>,
    ) -> Result<(), ToolError> {
        let (mut omitted, mut width) = (Vec::new(), None);
        let format = if self.json { BrowseFormat::Json } else { self.format };
        print(|mut out| match format {
            BrowseFormat::Json => {
                let objects =
                    found.objects.iter().enumerate().map(|(place, object)| {
                        match contents.and_then(|contents| contents.get(place)) {
                            Some(content) => ObjectReport::read(object, content),
                            None => ObjectReport::from(object),
                        }
                    });
                let report = ObjectsReport::new(session, objects, found.notes.clone());
                json::write(&report, out)
            }
            format => {
                let columns = columns(self.variables);
                let mut heads: Vec<&str> = columns.iter().map(|column| column.head).collect();
                heads.extend(contents.map(|_| VALUE));
                let rows = found.objects.iter().enumerate().map(|(place, object)| {
                    let mut row: Vec<String> =
                        columns.iter().map(|column| (column.cell)(object)).collect();
                    let content = contents.and_then(|contents| contents.get(place));
                    row.extend(content.map(|content| cell(object, content, format)));
                    row
                });
                match format {
                    BrowseFormat::Csv => csv(&heads, rows, &mut out),
                    _ => {
                        let size = terminal_size::terminal_size_of(io::stdout());
                        width = size.map(|(width, _)| usize::from(width.0));
                        table(&heads, rows, width, &mut out).map(|without| omitted = without)
                    }
                }
            }
        })?;
        if let Some(width) = width.filter(|_| !omitted.is_empty()) {
            print_error(format_args!(
                "columns that do not fit the terminal of {width} characters are omitted: {}; \
                 --format csv prints all",
                omitted.join(", ")
            ));
        }
        Ok(())
    }
}

fn read_all(
    session: &mut Session,
    found: &mut WalkResult,
    progress: &mut ProgressLine,
) -> Result<Vec<ReadContent>, ToolError> {
    let (objects, mut bytes) = (&found.objects, 0_usize);
    let mut contents = Vec::with_capacity(objects.len());
    let mut enough = None;
    for (place, object) in objects.iter().enumerate() {
        progress.update(|| format!("values: {place} of {}", objects.len()));
        if let Some(why) = &enough {
            contents.push(Err(String::clone(why)));
            continue;
        }
        let size = object.size();
        let content = match size {
            0..=CONTENT_MAX => session.read(&object.address),
            _ => Err(ToolError::Unable(format!("{}; use get to read it", plural(size, "byte")))),
        };
        contents.push(match content {
            Ok(content) => {
                let levels = object.ty.dimensions.len().max(1);
                bytes = bytes.saturating_add(content.len().saturating_mul(levels));
                if bytes > CONTENTS_MAX {
                    enough = Some(format!("limit of {} MiB reached", CONTENTS_MAX >> 20));
                }
                Ok(content)
            }
            Err(ToolError::Enough(why)) => {
                enough = Some(format!("not read: {why}"));
                Err(format!("not read: {why}"))
            }
            // After each of these errors, the other values can still be read.
            Err(
                why @ (ToolError::Ads { .. }
                | ToolError::Reply(_)
                | ToolError::Unable(_)
                | ToolError::Unsendable(_)
                | ToolError::NotPermitted(_)),
            ) => Err(why.to_string()),
            Err(error) => return Err(error),
        });
    }
    if let Some(why) = enough {
        found.notes.push(format!("not all values are listed: {why}"));
        found.is_cut = true;
    }
    Ok(contents)
}

fn cell(object: &ListedValue, content: &ReadContent, format: BrowseFormat) -> String {
    let text = match content {
        Ok(bytes) => plain(&object.ty, bytes).unwrap_or_else(|| hex::spaced(bytes)),
        Err(_) if format == BrowseFormat::Csv => return String::new(),
        Err(why) => format!("({why})"),
    };
    let is_long = text.chars().count() > VALUE_MAX && format == BrowseFormat::Table;
    if is_long {
        let start: String = text.chars().take(VALUE_MAX).collect();
        return format!("{start}…");
    }
    text
}
