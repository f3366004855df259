//! `ads-cnc explain`: shows bytes field by field.

use std::fs::File;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use ads_cnc::address::{IndexGroup, IndexOffset};
use ads_cnc::ads::AmsPort;
use ads_cnc::layout::Stream;
use ads_cnc::operation::AdsService;
use ads_cnc::value::DataType;
use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};

use super::check::compressed;
use super::display::Color;
use super::message::{exit_with_error, print_error};
use super::name_args::number;
use super::output::{lost, print_output, show};
use crate::exit::Exit;
use crate::explain::{
    ExplainQuery, ExplainSubject, Explanation, ServiceAddress, ValueFormat, candidates, explain,
    looks_like_frame, parse_hex, print, type_by_name,
};
use crate::text::{did_you_mean, read_limited};

/// Maximum number of bytes that are read from a file or stdin (1 MiB), because the explanation of a
/// byte needs up to 400 bytes of memory.
const INPUT_MAX: u64 = 0x10_0000;

/// Explain bytes field by field
///
/// --stream, --group with --offset, or --frame specify the meaning of the bytes; without them, the
/// bytes must be AMS/TCP frames. Truncated or invalid bytes are shown up to the error.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(super) struct Explain {
    /// Bytes in hex, in the order in which they are sent; - reads hex from stdin
    #[arg(value_name = "HEX")]
    hex_bytes: Vec<String>,

    /// Read the bytes from this binary file; - is stdin
    #[arg(long, value_name = "FILE", conflicts_with = "hex_bytes")]
    file: Option<PathBuf>,

    /// Read the file as hex
    #[arg(long, requires = "file")]
    hex: bool,

    /// Parse the bytes as this stream (see --list)
    #[arg(long, value_name = "NAME", conflicts_with_all = ["frame", "group"])]
    stream: Option<String>,

    /// Parse the bytes as consecutive AMS/TCP frames
    #[arg(long)]
    frame: bool,

    /// Parse the bytes as service data of this index group; with --frame, use the index group for
    /// replies without their request
    #[arg(long, value_name = "NUMBER", value_parser = number, requires = "offset")]
    group: Option<u32>,

    /// Index offset of the service data
    #[arg(long, value_name = "NUMBER", value_parser = number, requires = "group")]
    offset: Option<u32>,

    /// ADS service [default: the service of the function at this address]
    #[arg(long, value_name = "SERVICE", requires = "group", value_parser = service())]
    service: Option<AdsService>,

    /// AMS port: 551 GEO, 552 SDA, 553 COM
    #[arg(long, requires = "group")]
    port: Option<u16>,

    /// Parse the bytes as a reply [default: as a request]
    #[arg(long, requires = "group")]
    reply: bool,

    /// Type of a value or content: BOOLEAN, SGN32, REAL64, STRING, DINT, …
    #[arg(long = "type", value_name = "TYPE", value_parser = type_by_name)]
    ty: Option<DataType>,

    /// Number of elements in each dimension of a value or content
    #[arg(long, value_name = "N,…", value_delimiter = ',', requires = "ty")]
    dimensions: Vec<u32>,

    /// Print one JSON document
    #[arg(long)]
    json: bool,

    /// When to colour the output; auto: on a terminal, unless NO_COLOR is set
    #[arg(long, hide_short_help = true, value_name = "WHEN", default_value = "auto")]
    color: Color,

    /// List the streams: name, requirement, maximum number of bytes, title
    #[arg(long, exclusive = true)]
    list: bool,
}

const EXAMPLES: &str = "\
Examples:
  ads-cnc explain --stream variable-handle 04 00 00 02
  ads-cnc explain --group 0x122301 --offset 0x46 562e452e7661727465737400
  ads-cnc explain --group 0x122301 --offset 0x48 --reply --type SGN32 4d 01 00 00
  ads-cnc explain --group 0x120101 --offset 0x10001
  ads-cnc explain --file frames.bin --json
  xxd -p frames.bin | ads-cnc explain -

With --group, the bytes are the data of the service, without its own header; without bytes, the
command explains the address. An empty argument (\"\") means empty data.

Exit codes: 0 explained; 1 the bytes are invalid; 2 wrong usage; 3 the address is unknown;
70 internal error.";

/// Parses the name of a service.
fn service() -> impl TypedValueParser<Value = AdsService> {
    PossibleValuesParser::new(["read", "write", "read-write"]).map(|name| match name.as_str() {
        "read" => AdsService::Read,
        "write" => AdsService::Write,
        _ => AdsService::ReadWrite,
    })
}

/// Whether the bytes begin like a pcap, pcapng or NetMon file.
fn is_capture(bytes: &[u8]) -> bool {
    let starts = [
        [0xD4, 0xC3, 0xB2, 0xA1],
        [0xA1, 0xB2, 0xC3, 0xD4],
        [0x4D, 0x3C, 0xB2, 0xA1],
        [0xA1, 0xB2, 0x3C, 0x4D],
        [0x0A, 0x0D, 0x0D, 0x0A],
        *b"GMBU",
        *b"RTSS",
    ];
    starts.iter().any(|start| bytes.starts_with(start))
}

/// Whether the bytes are a text of at least one hexadecimal byte.
fn is_hex(bytes: &[u8]) -> bool {
    let text = std::str::from_utf8(bytes);
    text.is_ok_and(|text| parse_hex(text).is_ok_and(|bytes| !bytes.is_empty()))
}

/// Whether the bytes begin like an Ethernet frame with IPv4 or IPv6, with one VLAN tag or none.
fn is_ethernet(bytes: &[u8]) -> bool {
    let of_ip = |at: usize| match bytes.get(at..) {
        Some([8, 0, version, ..]) => version >> 4 == 4,
        Some([0x86, 0xDD, version, ..]) => version >> 4 == 6,
        _ => false,
    };
    of_ip(12) || (bytes.get(12..14) == Some(&[0x81, 0]) && of_ip(16))
}

/// Reads the decimal digits of an unknown index group as hex, because the user may have omitted 0x,
/// and returns the result if it is a known index group.
fn meant_as_hex(group: u32) -> Option<IndexGroup> {
    let is_known = |group: u32| IndexGroup::new(group).parts().is_some();
    let meant = u32::from_str_radix(&group.to_string(), 16).ok()?;
    (!is_known(group) && is_known(meant)).then(|| IndexGroup::new(meant))
}

impl Explain {
    /// Explains the bytes, or lists the streams, and returns the exit code.
    pub(super) fn execute(&self) -> Exit {
        if self.list {
            return print_output(list);
        }
        let explanation = match self.explanation() {
            Ok(explanation) => explanation,
            Err(why) => return exit_with_error(Exit::Usage, why),
        };
        let shown = show(|out| match self.json {
            true => crate::text::json::write(&explanation, out),
            false => print(&explanation, self.color.is_on(), out),
        });
        if let Err(error) = shown {
            return lost(error);
        }
        if let Some(group) = self.group.and_then(meant_as_hex) {
            print_error(format_args!(
                "did you mean --group {group}? Without 0x a number is decimal"
            ));
        }
        explanation.outcome.exit()
    }

    fn explanation(&self) -> Result<Explanation, String> {
        let given = self.bytes()?;
        let values = ValueFormat { ty: self.ty, dimensions: self.dimensions.clone() };
        let question = ExplainQuery { subject: self.subject(given.as_deref())?, values };
        Ok(explain(&question, &given.unwrap_or_default()))
    }

    fn subject(&self, bytes: Option<&[u8]>) -> Result<ExplainSubject, String> {
        if let Some(name) = &self.stream {
            return Stream::by_name(name).map(ExplainSubject::Stream).ok_or_else(|| {
                let near = did_you_mean(name, Stream::all().map(|stream| stream.layout().name));
                // The golden vectors use these names for inputs that are not streams.
                let instead = match name.as_str() {
                    "index-group" | "index-offset" => {
                        "--group NUMBER --offset NUMBER explain an address"
                    }
                    "ams-frame" => "--frame explains AMS/TCP frames",
                    _ => "ads-cnc explain --list shows all streams",
                };
                format!("no stream has the name {name}{near}\n{instead}")
            });
        }
        let ads_address = self.group.zip(self.offset).map(|(group, offset)| ServiceAddress {
            port: self.port.map(AmsPort),
            service: self.service,
            group: IndexGroup::new(group),
            offset: IndexOffset::new(offset),
            reply: self.reply,
        });
        match ads_address {
            Some(ads_address) if !self.frame && bytes.is_none() => {
                Ok(ExplainSubject::Address(ads_address))
            }
            Some(ads_address) if !self.frame => Ok(ExplainSubject::Place(ads_address)),
            ads_address if self.frame => Ok(ExplainSubject::Frames(ads_address)),
            ads_address => match bytes.unwrap_or_default() {
                [] => Err(format!("no bytes are given\n{EXPLAIN_HELP}")),
                bytes if looks_like_frame(bytes) => Ok(ExplainSubject::Frames(ads_address)),
                bytes if self.file.is_some() && !self.hex && is_hex(bytes) => {
                    Err("the file contains hexadecimal text: add --hex".to_owned())
                }
                bytes if is_ethernet(bytes) => {
                    Err("this is a whole Ethernet frame: copy the TCP payload only".to_owned())
                }
                bytes => Err(unknown(bytes)),
            },
        }
    }

    /// The bytes to explain; `None` to explain only the address of --group and --offset.
    fn bytes(&self) -> Result<Option<Vec<u8>>, String> {
        let text = match (&self.file, self.hex_bytes.as_slice()) {
            (Some(file), _) => {
                let bytes = read_file(file)?;
                if let Some(why) = compressed(file) {
                    return Err(format!("{}: {why}", file.display()));
                }
                if is_capture(&bytes) {
                    let name = file.display();
                    return Err(format!("{name} is a capture: ads-cnc check {name} judges it"));
                }
                if !self.hex {
                    return Ok(Some(bytes));
                }
                text(bytes)?
            }
            (None, [stdin]) if stdin == "-" => text(read_stdin()?)?,
            (None, []) if self.group.is_some() && !self.frame => return Ok(None),
            (None, []) => return Err(format!("no bytes are given\n{EXPLAIN_HELP}")),
            (None, words) => words.join(" "),
        };
        parse_hex(&text).map(Some).map_err(|error| match self.hex_bytes.as_slice() {
            [file] if Path::new(file).is_file() => match compressed(Path::new(file)) {
                Some(why) => format!("{file}: {why}"),
                None => format!(
                    "{file} is a file: use --file {file}, or for a capture ads-cnc check {file}"
                ),
            },
            _ => error.to_string(),
        })
    }
}

/// Lists the streams.
fn list(out: &mut dyn Write) -> io::Result<()> {
    Stream::all().map(Stream::layout).try_for_each(|layout| {
        let (name, title, clause) = (layout.name, layout.title, layout.clause);
        writeln!(out, "{name:<30}  {clause:<6}  {:>8}  {title}", layout.max)
    })
}

const EXPLAIN_HELP: &str = "\
specify what the bytes are:
  --stream NAME                    a stream; --list shows all
  --group NUMBER --offset NUMBER   data of a request, or with --reply of a reply
  --frame                          AMS/TCP frames";

fn unknown(bytes: &[u8]) -> String {
    let fits = candidates(bytes);
    let fits = match fits.as_slice() {
        [] => "no stream matches all bytes".to_owned(),
        fits => format!("streams that match all bytes: {}", fits.join(" ")),
    };
    format!("the bytes are not an AMS/TCP frame; {EXPLAIN_HELP}\n{fits}")
}

fn text(bytes: Vec<u8>) -> Result<String, String> {
    String::from_utf8(bytes).map_err(|_| "binary instead of hex: use --file FILE".to_owned())
}

fn read_file(file: &Path) -> Result<Vec<u8>, String> {
    if file == Path::new("-") {
        return read_stdin();
    }
    let bytes = File::open(file).and_then(|opened| read_limited(opened, INPUT_MAX));
    bytes.map_err(|error| format!("{}: {error}", file.display()))
}

fn read_stdin() -> Result<Vec<u8>, String> {
    read_limited(io::stdin().lock(), INPUT_MAX).map_err(|error| format!("stdin: {error}"))
}
