//! `ads-cnc tables` prints the tables of the codec, and `ads-cnc wireshark` a dissector that is
//! generated from them.

use std::io::{self, Write};

use clap::Args;

use super::output::print_output;
use crate::exit::Exit;
use crate::tables::{self, OffsetTable, Tables};
use crate::text::plural;

/// Print the tables of all streams and functions, for code generators
///
/// The tables contain the streams with their fields, and the functions with their addresses and
/// effects.
#[derive(Args, Debug)]
#[command(after_help = TABLES_EXAMPLES)]
pub(super) struct TablesArgs {
    /// Print one JSON document that follows conformance/schema/tables.schema.json [default: text]
    #[arg(long, conflicts_with = "ksy")]
    json: bool,

    /// Print the streams as a Kaitai Struct description, for readers in other languages
    #[arg(long)]
    ksy: bool,
}

const TABLES_EXAMPLES: &str = "\
Examples:
  ads-cnc tables
  ads-cnc tables --json > tables.json
  ads-cnc tables --ksy > ads_cnc.ksy

Exit codes: 0 written; 2 wrong usage; 70 internal error.";

/// Print a dissector for Wireshark, in Lua
///
/// With the dissector, Wireshark 4.0 or later shows the function, the requirement, the effect and
/// every field of each frame to a CNC, and filters by them: `ads_cnc.effect == "Write"`,
/// `ads_cnc.variable_description.size > 100`.
#[derive(Args, Debug)]
#[command(after_help = WIRESHARK_EXAMPLES)]
pub(super) struct WiresharkArgs {}

const WIRESHARK_EXAMPLES: &str = "\
Examples:
  ads-cnc wireshark > ~/.local/lib/wireshark/plugins/ads_cnc.lua
  ads-cnc wireshark > \"%APPDATA%\\Wireshark\\plugins\\ads_cnc.lua\"
  ads-cnc wireshark > ads_cnc.lua
  tshark -X lua_script:ads_cnc.lua -r capture.pcapng -Y \"ads_cnc.effect == \\\"Write\\\"\"

Exit codes: 0 written; 2 wrong usage; 70 internal error.";

impl TablesArgs {
    /// Prints the tables and returns the exit code.
    pub(super) fn execute(&self) -> Exit {
        let tables = Tables::new();
        print_output(|out| match (self.json, self.ksy) {
            (true, _) => crate::text::json::write(&tables, out),
            (false, true) => out.write_all(tables::kaitai_struct(&tables).as_bytes()),
            (false, false) => print(&tables, out),
        })
    }
}

impl WiresharkArgs {
    /// Prints the dissector and returns the exit code.
    pub(super) fn execute(&self) -> Exit {
        print_output(|out| {
            let script = tables::dissector(&Tables::new()).map_err(io::Error::other)?;
            out.write_all(script.as_bytes())
        })
    }
}

fn print(tables: &Tables, out: &mut dyn Write) -> io::Result<()> {
    for stream in &tables.streams {
        let repeats = if stream.repeats { ", one or more records" } else { "" };
        let (name, title, clause) = (stream.name, stream.title, stream.clause);
        let max = stream.max_length;
        writeln!(out, "{name}: {title} ({clause}; at most {}{repeats})", plural(max, "byte"))?;
        for field in &stream.fields {
            let at = match field.offset_per_item {
                0 => field.offset.to_string(),
                each => format!("{} + {each}n", field.offset),
            };
            let (name, ty, meaning, clause) = (field.name, &field.ty, field.meaning, field.clause);
            writeln!(out, "  {at:>8}  {name:<20} {ty:<8}  {clause:<6}  {meaning}")?;
        }
        writeln!(out)?;
    }
    for function in &tables.functions {
        let (id, service, port, clause) =
            (&function.id, &function.service, function.port, function.clause);
        writeln!(out, "{id}: {}", function.title)?;
        let groups = function.groups.iter().map(|[first, last]| match first == last {
            true => format!("0x{first:X}"),
            false => format!("0x{first:X} to 0x{last:X}"),
        });
        let offsets = match &function.offsets {
            OffsetTable::OneOf { offsets } => {
                let all: Vec<_> = offsets.iter().map(|offset| format!("0x{offset:X}")).collect();
                all.join(", ")
            }
            OffsetTable::AtLeast { first } => format!("0x{first:X} and above"),
            OffsetTable::OfAxis { first_axis, element } => {
                format!("0x10000 * axis + 0x{element:X}, axis from {first_axis}")
            }
        };
        writeln!(out, "  {service} at port {port}, effect {}, {clause}", function.effect)?;
        writeln!(out, "  groups   {}", groups.collect::<Vec<_>>().join(", "))?;
        writeln!(out, "  offsets  {offsets}")?;
        let stream = |stream: Option<&'static str>| stream.unwrap_or("no data");
        writeln!(out, "  {} -> {}\n", stream(function.request), stream(function.reply))?;
    }
    Ok(())
}
