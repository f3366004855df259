//! `ads-cnc set`: writes a value by its name.

#![cfg_attr(
    not(test),
    deny(clippy::arithmetic_side_effects, clippy::as_conversions, clippy::indexing_slicing),
    deny(clippy::expect_used, clippy::panic, clippy::string_slice, clippy::unreachable),
    deny(clippy::unwrap_used)
)]

use ads_cnc::dynamic::DynamicKind;
use clap::Args;

use super::message::{exit_with_error, print_error};
use super::model::ModelArgs;
use super::name_args::NameArgs;
use super::not_sent;
use super::output::print;
use super::target::{
    DeadlineArgs, REACHING_A_DEVICE, TargetArgs, WHAT_MAY_BE_WRITTEN, simulator_gate,
};
use crate::exit::Exit;
use crate::named::{Lookup, by_name_alone, find};
use crate::number::{to_u32, to_usize};
use crate::objects::{ListedValue, ReportedAccess, ValueAddress};
use crate::session::{Session, ToolError};
use crate::values::{Type, parse, plain};

/// Write a variable, an object or an element by its name, and read it back
///
/// A write may move a machine. On a device, only the variables, objects and elements that a file
/// for --allow-write names can be written, on the device and until the time in that file. Any other
/// write is rejected, and the error shows the entry that it needs.
///
/// Without --target, the command writes to a simulated CNC and needs no file. The simulated CNC
/// ends with the command and keeps no value: this only shows what would happen.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES, after_long_help = format!("{EXAMPLES}\n\n{REACHING_A_DEVICE}\n\n{WHAT_MAY_BE_WRITTEN}"))]
pub(super) struct Set {
    #[command(flatten)]
    name: NameArgs,

    /// Value: a number, decimal or with 0x; TRUE or FALSE; a text; all elements of an array as
    /// 1,2,3
    #[arg(value_name = "VALUE", allow_hyphen_values = true)]
    value: String,

    #[command(flatten)]
    target: TargetArgs,

    #[command(flatten)]
    model: ModelArgs,

    #[command(flatten)]
    deadline: DeadlineArgs,
}

const EXAMPLES: &str = "\
Examples:
  ads-cnc set \"V.E.test[4]\" 123
  ads-cnc set V.E.test 1,2,3,4,0xFF
  ads-cnc set V.E.text \"a text\"
  ads-cnc set V.A.WCS 123.456 --axis 2
  ads-cnc set V.CYC.count 7 --type UNS32
  ads-cnc set V.E.test 1,2,3,4,5 --target 192.0.2.10 --net-id 192.0.2.10.1.1 --allow-write FILE
  ads-cnc set V.E.vartest 7 --type UNS16 --dry-run --target 192.0.2.10 --net-id 192.0.2.10.1.1

In an array with several dimensions, the last index changes fastest (assumed): [[1,2,3],[4,5,6]], as
printed by get --json, is the same as 1,2,3,4,5,6. In an array of texts, put a text with a comma in
double quotes.

Exit codes: 0 written, and the same value read back; 1 the CNC rejects the write, describes the
object as read only, rejects reading it back, or returns another value, as for a command that it
consumes; 2 wrong usage, or a value that does not fit; 3 no reply; 4 rejected for safety; 70
internal error.";

impl Set {
    pub(super) fn execute(&self) -> Exit {
        self.target.end(self.run(), |error| match error {
            ToolError::NotSent => Some("specify --type TYPE to see the write itself".to_owned()),
            error => self.name.advice(error, &self.target, &self.model),
        })
    }

    fn run(&self) -> Result<Exit, ToolError> {
        let question = self.name.question();
        let alone = by_name_alone(&question)?;
        if let Some(object) = &alone {
            check(object)?;
            let checked = self.target.ask_gate(|session| session.check_write(&object.address));
            checked.map_err(|rejected| self.wrong(&question).unwrap_or(rejected))?;
        }
        let mut session = self.open(alone.as_ref())?;
        if let Some(object) = &alone {
            self.ask_gate(object, &mut session)?;
        }
        let object = find(&mut session, &question)?;
        check(&object)?;
        let size = object.size();
        let NewValue { old, ty, mut bytes } = self.value(&object, &mut session)?;
        if object.address.content().is_some() {
            // The content of an object or element has a fixed size: a shorter text is padded with
            // zeros.
            bytes.resize(to_usize(size).max(bytes.len()), 0);
        }
        if session.is_simulated() && !self.target.has_file() {
            session = session.with_gate(simulator_gate(object.entry()))?;
        }
        session.write(&object.address, &bytes)?;
        if session.is_dry() {
            return Ok(Exit::Success);
        }
        let new = match session.read(&object.address) {
            Ok(new) => Some(new),
            Err(ToolError::Ads { .. }) => None,
            Err(error) => {
                print_error("the value was written, but could not be read back");
                return Err(error);
            }
        };
        self.show(&object, &ty, old.as_deref(), new.as_deref())?;
        if session.is_simulated() {
            print_error(
                "written to a temporary simulated CNC, which has ended; --target writes to a running CNC",
            );
        }
        Ok(judge(&ty, &bytes, new.as_deref()))
    }

    /// Finds the object, reads its value and parses the new value. Returns an error that says more
    /// than the gate's rejection of the write, such as an unknown name. `None` without such an
    /// error, and with --allow-write.
    fn wrong(&self, question: &Lookup) -> Option<ToolError> {
        if self.target.has_file() {
            return None;
        }
        let mut session = self.open(None).ok()?;
        let found = find(&mut session, question).and_then(|object| {
            check(&object)?;
            self.value(&object, &mut session).map(drop)
        });
        found.err().filter(|error| {
            use ToolError::{Absent, Ads, Unable, Usage};
            matches!(error, Absent(_) | Ads { .. } | Unable(_) | Usage(_))
        })
    }

    /// Reads the current value, and parses the new value by the type of the object and the length
    /// of the current value.
    fn value(&self, object: &ListedValue, session: &mut Session) -> Result<NewValue, ToolError> {
        let old = match session.read(&object.address) {
            Ok(old) => Some(old),
            // A value that cannot be read may be writable.
            Err(ToolError::Ads { .. }) => None,
            Err(ToolError::NotSent) if session.is_dry() => None,
            Err(error) => return Err(error),
        };
        let ty = match &old {
            Some(old) => object.ty.clone().fitted(to_u32(old.len())),
            None => object.ty.clone(),
        };
        let bytes = parse(&ty, &self.value).map_err(|why| ToolError::Usage(why.to_string()))?;
        Ok(NewValue { old, ty, bytes })
    }

    /// Checks the write with the gate of the session before the description is requested; for the
    /// simulated CNC, only with --allow-write. A dry run prints a rejected write.
    fn ask_gate(&self, object: &ListedValue, session: &mut Session) -> Result<(), ToolError> {
        if session.is_simulated() && !self.target.has_file() {
            return Ok(());
        }
        let checked = session.check_write(&object.address);
        if checked.is_err() && session.is_dry() {
            // The printed write contains the value, which can be parsed only if the type is known.
            let value = parse(&object.ty, &self.value).unwrap_or_default();
            return session.write(&object.address, &value);
        }
        checked
    }

    /// Opens the session. In a dry run without --target and --allow-write, its gate allows the
    /// write of `alone`, the object whose address the name alone determines.
    fn open(&self, alone: Option<&ListedValue>) -> Result<Session, ToolError> {
        let simulated = !self.target.is_device() && !self.target.has_file();
        match alone {
            Some(object) if simulated && self.target.is_dry() => {
                Session::dry_simulated(simulator_gate(object.entry()), not_sent::print)
            }
            _ => Ok(self.model.open(&self.target)?.with_deadline(self.deadline.begin())),
        }
    }

    fn show(
        &self,
        object: &ListedValue,
        ty: &Type,
        old: Option<&[u8]>,
        new: Option<&[u8]>,
    ) -> Result<(), ToolError> {
        let text = |bytes: Option<&[u8]>| match bytes {
            Some(bytes) => plain(ty, bytes).unwrap_or_else(|| crate::text::hex::spaced(bytes)),
            None => "(not readable)".to_owned(),
        };
        let (name, old, new) = (object.name.to_string(), text(old), text(new));
        // Show long values on lines of their own.
        let between = if old.len().max(new.len()) > 30 { "\n  → " } else { " → " };
        let start = if between.starts_with('\n') { "\n    " } else { " " };
        let name = crate::values::printable(&name);
        print(|out| writeln!(out, "{name}:{start}{old}{between}{new}"))
    }
}

/// The new value of an object, and its value before the write.
struct NewValue {
    /// The value before the write; `None` if it cannot be read.
    old: Option<Vec<u8>>,
    ty: Type,
    bytes: Vec<u8>,
}

/// Checks that the object is not a P parameter, and that the CNC does not describe it as read-only.
fn check(object: &ListedValue) -> Result<(), ToolError> {
    let name = &object.name;
    if matches!(object.address, ValueAddress::Parameter { kind: DynamicKind::P, .. }) {
        let why = format!("{name} is a P parameter, which no documented function can write");
        return Err(ToolError::Unable(why));
    }
    match object.access {
        ReportedAccess::Read => Err(ToolError::Unable(format!(
            "nothing was written: the CNC describes {name} as read only"
        ))),
        _ => Ok(()),
    }
}

/// Compares the value read back with the written value; compares a text only up to its NUL. Without
/// a value read back, the exit code is that of a failure, because the write is not confirmed.
fn judge(ty: &Type, written: &[u8], new: Option<&[u8]>) -> Exit {
    let Some(new) = new else {
        let why = "the value was written, but the CNC rejects reading it back";
        return exit_with_error(Exit::Failure, why);
    };
    let same = written == new
        || plain(ty, written).is_some_and(|written| plain(ty, new).as_ref() == Some(&written));
    if same {
        return Exit::Success;
    }
    let wrote = plain(ty, written).unwrap_or_default();
    let why = format!("the CNC accepted {wrote}, but now returns another value");
    exit_with_error(Exit::Failure, why)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_that_cannot_be_read_back_is_a_failure() {
        assert_eq!(judge(&Type::UNKNOWN, &[1], None), Exit::Failure);
        assert_eq!(judge(&Type::UNKNOWN, &[1], Some(&[1])), Exit::Success);
    }
}
