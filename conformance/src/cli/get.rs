//! `ads-cnc get`: reads a value by its name.

use clap::Args;

use super::message::print_error;
use super::model::ModelArgs;
use super::name_args::{NameArgs, headline};
use super::output::print;
use super::target::{DeadlineArgs, REACHING_A_DEVICE, TargetArgs};
use crate::exit::Exit;
use crate::named::find;
use crate::number::to_u32;
use crate::objects::{ListedValue, ObjectReport, ObjectsReport};
use crate::session::ToolError;
use crate::text::{hex, json, plural};
use crate::values::{lines, plain, printable};

/// Read a variable, a parameter, an object or an element by its name
///
/// The type of a variable comes from its description. The command requests the description by name,
/// or, with --axis or on a CNC without that function, searches the descriptions of the variable's
/// kind. It searches for a COM object or an element in the lists of the channel, of the platform,
/// its axes and spindles; --of shortens the search. The command writes nothing.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES, after_long_help = format!("{EXAMPLES}\n\n{REACHING_A_DEVICE}"))]
pub(super) struct Get {
    #[command(flatten)]
    name: NameArgs,

    /// Print only the value, on one line, in the form that set accepts
    #[arg(long, conflicts_with_all = ["json", "hex"])]
    plain: bool,

    /// Print one JSON document
    #[arg(long, conflicts_with = "hex")]
    json: bool,

    /// Print only the bytes, as hexadecimal digits on one line
    #[arg(long)]
    hex: bool,

    #[command(flatten)]
    target: TargetArgs,

    #[command(flatten)]
    deadline: DeadlineArgs,

    #[command(flatten)]
    model: ModelArgs,
}

/// Maximum number of bytes of a value that is formatted, because a formatted element can need 60
/// bytes of memory for each byte of the value.
const FORMATTED_MAX: usize = 1 << 20;

const EXAMPLES: &str = "\
Examples:
  ads-cnc get V.E.Testvar
  ads-cnc get \"V.E.matrix[1][2]\" --plain
  ads-cnc get V.A.ACT_POS.X
  ads-cnc get V.A.ACT_POS --axis 2
  ads-cnc get P1 --channel 1 --json
  ads-cnc get V.CYC.count --type UNS32
  ads-cnc get mc_active_single_block_r --target 192.0.2.10 --net-id 192.0.2.10.1.1
  ads-cnc get example.enable --of \"HLD axis 1\"

Exit codes: 0 read; 1 the name is unknown to the CNC, the reply is not a value of the type, or the
value is larger than 1 MiB, which only --hex prints; 2 wrong usage, or an ambiguous name; 3 no
reply; 4 rejected for safety; 70 internal error.";

impl Get {
    pub(super) fn execute(&self) -> Exit {
        self.target.end(self.run(), |error| self.name.advice(error, &self.target, &self.model))
    }

    fn run(&self) -> Result<Exit, ToolError> {
        let mut session = self.model.open(&self.target)?.with_deadline(self.deadline.begin());
        let mut object = find(&mut session, &self.name.question())?;
        let bytes = session.read(&object.address)?;
        if bytes.len() > FORMATTED_MAX && !self.hex {
            return Err(ToolError::Unable(format!(
                "{} has {}, and values are formatted only up to {FORMATTED_MAX} bytes; --hex \
                 prints the bytes",
                printable(&object.name.to_string()),
                plural(bytes.len(), "byte")
            )));
        }
        object.ty = object.ty.fitted(to_u32(bytes.len()));
        print(|out| {
            if self.json {
                let one = ObjectReport::read(&object, &Ok(bytes.clone()));
                let report = ObjectsReport::new(&session, std::iter::once(one), Vec::new());
                return json::write(&report, out);
            }
            if self.hex {
                return writeln!(out, "{}", hex::spaced(&bytes));
            }
            if self.plain {
                let value = plain(&object.ty, &bytes);
                return value.map_or(Ok(()), |value| writeln!(out, "{value}"));
            }
            writeln!(out, "{}", headline(&object))?;
            let lines = lines(&object.ty, &bytes).unwrap_or_else(|| hex::dump(&bytes));
            lines.iter().try_for_each(|line| writeln!(out, "  {line}"))
        })?;
        Ok(self.judge(&object, &bytes))
    }

    /// The exit code for these bytes. Without --hex, bytes that are not a value of the type are a
    /// failure; with --plain, so is an unknown type. The reason is printed to stderr.
    fn judge(&self, object: &ListedValue, bytes: &[u8]) -> Exit {
        match object.ty.elements(bytes) {
            Ok(Some(_)) => Exit::Success,
            // With --hex the bytes are the result.
            _ if self.hex => Exit::Success,
            Ok(None) => {
                let ty = match object.ty.name.as_str() {
                    "" => "the CNC does not report the type".to_owned(),
                    name => format!("the manuals do not define the type {name}"),
                };
                print_error(format_args!("{ty}; specify it with --type TYPE"));
                if self.plain { Exit::Failure } else { Exit::Success }
            }
            Err(error) => {
                print_error(format_args!(
                    "the content is not a value of type {}: {error}",
                    object.ty
                ));
                Exit::Failure
            }
        }
    }
}
