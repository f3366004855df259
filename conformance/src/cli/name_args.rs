//! Options of the commands that take a name (`get` and `set`), and functions that other commands
//! use too.

use std::time::Duration;

use ads_cnc::address::{Channel, ChannelAxis};
use ads_cnc::operation::Function;
use ads_cnc::value::DataType;
use clap::Args;

use super::model::ModelArgs;
use super::target::{ChannelArgs, TargetArgs};
use crate::deadline::Deadline;
use crate::named::{Lookup, by_name_alone};
use crate::objects::{ListedValue, Options, Pattern, channels_of, walk};
use crate::session::ToolError;
use crate::text::{nearest, plural};
use crate::value_format::type_by_name;

/// The arguments that identify a variable, parameter, object or element.
#[derive(Args, Clone, Debug)]
pub(super) struct NameArgs {
    /// Name of a variable (V.E.list, V.E.list[3], V.G.NP[0].V), of a parameter (V.P.count; P1, which
    /// only `get` accepts), of a COM object or of an element of SDA and GEO
    #[arg(value_name = "NAME", value_parser = given_name)]
    name: String,

    #[command(flatten)]
    channel: ChannelArgs,

    /// Use the axis interface for a V.A variable: index of the axis in the channel, from 1
    #[arg(long, value_name = "INDEX", value_parser = axis)]
    axis: Option<ChannelAxis>,

    /// List that contains the name, as browse names it; * and ? are wildcards [default: all lists]
    #[arg(long, value_name = "LIST", conflicts_with = "axis")]
    of: Option<String>,

    /// Index offset of the object, if a list has the name several times
    #[arg(long, value_name = "NUMBER", value_parser = number, conflicts_with = "axis")]
    offset: Option<u32>,

    /// Type of the value: BOOLEAN, SGN32, REAL64, STRING, …; for a variable, the command then does
    /// not request the description
    #[arg(long = "type", value_name = "TYPE", value_parser = type_by_name)]
    pub(super) ty: Option<DataType>,
}

impl NameArgs {
    pub(super) fn question(&self) -> Lookup {
        Lookup {
            name: self.name.clone(),
            channel: self.channel.channel,
            axis: self.axis,
            lists: self.of.as_deref().map(Pattern::whole),
            offset: self.offset,
            ty: self.ty,
        }
    }

    /// Advice for the user after an ADS error, after [`ToolError::Absent`] and, if the name begins
    /// like that of a variable, after [`ToolError::Unable`]; `None` after any other error.
    pub(super) fn advice(
        &self,
        error: &ToolError,
        target: &TargetArgs,
        model: &ModelArgs,
    ) -> Option<String> {
        let is_variable = is_like_variable(&self.name);
        let is_absent = matches!(error, ToolError::Absent(_));
        let is_unable = is_variable && matches!(error, ToolError::Unable(_));
        if !(error.ads_error().is_some() || is_absent || is_unable) {
            return None;
        }
        if self.name.starts_with("V.CYC.") {
            return Some("the CNC does not list V.CYC variables: check the name".into());
        }
        let (name, channel) = (&self.name, self.channel.channel.number());
        let part = name.split(['[', '.']).nth(2).unwrap_or(name);
        let device = target.as_options();
        let browse =
            format!("ads-cnc browse{device} --variables --channel {channel} --filter \"{part}\"");
        if let (true, [_, _, _, axis]) =
            (self.axis.is_some(), name.split('.').collect::<Vec<_>>().as_slice())
        {
            let short = name.trim_end_matches(axis).trim_end_matches('.');
            return Some(format!("with --axis, omit the axis from the name: {short}"));
        }
        if let Some(axes) = self.axes(target, model) {
            return Some(axes);
        }
        // A V.A name without its axis has three parts; the axis is the fourth part.
        let lacks_axis =
            name.starts_with("V.A.") && name.split('.').count() == 3 && self.axis.is_none();
        // The name of a P parameter is P and a number: the names of other parameters would resemble
        // it, so no similar names are suggested after an ADS error.
        if (is_variable || is_absent)
            && !lacks_axis
            && let Some(found) = self.look_for(target, model, is_absent)
        {
            return Some(found);
        }
        if is_absent && !is_variable {
            return Some(format!(
                "to search every channel for similar names, and with --variables for variables: \
                 ads-cnc browse{device} --filter \"{name}\""
            ));
        }
        let browse = format!("to search for similar variables: {browse}");
        Some(match error {
            ToolError::Ads { function: Function::WriteByName, .. }
                if ["V.P.", "V.L.", "V.S."].iter().any(|kind| name.starts_with(kind)) =>
            {
                format!(
                    "writing V.P, V.L and V.S by name needs a CNC from V4.18.0, V3.1.3115, \
                     V3.1.3081.07, V2.11.2847 or V2.11.2077 on (ads-de 1.051, section 4.1); {browse}"
                )
            }
            _ if lacks_axis => {
                format!("specify the axis: --axis INDEX, or its name, as in {name}.X; {browse}")
            }
            _ => browse,
        })
    }
}

/// The message about channels that the CNC does not have (`absent`), with the channels that it has
/// (`there`).
pub(super) fn no_channel(absent: &[Channel], there: &[Channel]) -> String {
    let [absent, there] = [(absent, " or "), (there, ", ")].map(|(channels, between)| {
        let numbers = channels.iter().map(|one| one.number().to_string());
        numbers.collect::<Vec<_>>().join(between)
    });
    format!("the CNC has no active channel {absent}; channels: {there}")
}

/// Maximum number of axes of a channel that are queried for a variable.
const AXES_MAX: u32 = 32;

/// Time limit for the search for names that are similar to an unknown name, and for the search for
/// axes that have a variable.
const COMPARING_MAX: Duration = Duration::from_secs(5);

fn is_like_variable(name: &str) -> bool {
    name.get(..2).is_some_and(|start| start.eq_ignore_ascii_case("V."))
}

impl NameArgs {
    /// With --axis, lists the axes of the channel that have the variable, as advice; `None` if no
    /// axis has it, and with --capture.
    fn axes(&self, target: &TargetArgs, model: &ModelArgs) -> Option<String> {
        if self.axis.is_none() || target.capture().is_some() {
            return None;
        }
        let session = model.open(target).ok()?;
        let mut session = session.with_deadline(Deadline::after(COMPARING_MAX));
        let mut axes = Vec::new();
        for axis in (1..=AXES_MAX).filter_map(|place| ChannelAxis::new(place).ok()) {
            let lookup = Lookup { axis: Some(axis), ..self.question() };
            let object = by_name_alone(&lookup).ok()??;
            axes.extend(session.read(&object.address).is_ok().then(|| axis.index().to_string()));
        }
        let number = self.channel.channel.number();
        let axes = (!axes.is_empty()).then(|| axes.join(", "))?;
        Some(format!("axes of channel {number} with {}: {axes}", self.name))
    }

    /// Lists the channels of the CNC if it does not have the channel of --channel. Otherwise, lists
    /// the names most similar to the unknown name: of variables and, if `objects`, of objects and
    /// elements.
    fn look_for(&self, target: &TargetArgs, model: &ModelArgs, objects: bool) -> Option<String> {
        // A second session would overwrite the capture of the first session.
        if target.capture().is_some() {
            return None;
        }
        let session = model.open(target).ok()?;
        let mut session = session.with_deadline(Deadline::after(COMPARING_MAX));
        let channel = self.channel.channel;
        let channels = channels_of(&mut session).ok()?;
        if !channels.contains(&channel) {
            return Some(no_channel(&[channel], &channels));
        }
        let mut names: Vec<String> = Vec::new();
        for variables in [true, false] {
            if variables || objects {
                let options = Options { channels: vec![channel], variables, ..Options::default() };
                let found = walk(&mut session, &options, &mut |_| {}).ok()?;
                names.extend(found.objects.iter().map(|object| object.name.to_string()));
            }
        }
        if names.contains(&self.name) {
            return None;
        }
        let (base, indices) = match self.name.split_once('[') {
            Some((base, rest)) => (base, format!("[{rest}")),
            None => (self.name.as_str(), String::new()),
        };
        let mut whole = nearest(&self.name, names.iter().map(String::as_str));
        if whole.first().is_some_and(|first| first.eq_ignore_ascii_case(&self.name)) {
            whole.truncate(1);
        }
        let near = if whole.is_empty() {
            let near = nearest(base, names.iter().map(String::as_str));
            near.into_iter().map(|name| format!("{name}{indices}")).collect()
        } else {
            whole.into_iter().map(str::to_owned).collect::<Vec<_>>()
        };
        (!near.is_empty()).then(|| format!("did you mean {}?", near.join(" or ")))
    }
}

/// Name, type, size, unit, access, list, address and handle of a value on one line, as far as they
/// are known.
pub(super) fn headline(object: &ListedValue) -> String {
    let mut parts: Vec<String> = Vec::new();
    if !object.ty.name.is_empty() {
        parts.push(object.ty.to_string());
    }
    parts.extend(object.ty.size.map(|size| plural(size, "byte")));
    let unit = object.unit.as_ref().map(ToString::to_string);
    parts.extend(unit.filter(|unit| !unit.is_empty() && unit != "-"));
    parts.push(object.access.to_string());
    parts.push(object.list.to_string());
    parts.extend(object.address.content().map(|(group, offset)| format!("{group} {offset}")));
    parts.extend(object.handle.map(|handle| format!("handle {:#x}", handle.0)));
    parts.retain(|part| !part.is_empty());
    let name = crate::values::printable(&object.name.to_string());
    format!("{name}  {}", crate::values::printable(&parts.join(", ")))
}

fn given_name(text: &str) -> Result<String, String> {
    if text.is_empty() { Err("the name is empty".to_owned()) } else { Ok(text.to_owned()) }
}

fn axis(text: &str) -> Result<ChannelAxis, String> {
    let place = text.parse().map_err(|_| "expected a number".to_owned())?;
    ChannelAxis::new(place).map_err(|error| error.to_string())
}

/// Parses a number of 32 bits, decimal or in hex with 0x.
pub(super) fn number(text: &str) -> Result<u32, String> {
    let hex = text.strip_prefix("0x").or_else(|| text.strip_prefix("0X"));
    let number = match hex {
        Some(digits) if digits.starts_with('+') => None,
        Some(digits) => u32::from_str_radix(digits, 16).ok(),
        None => text.parse().ok(),
    };
    number.ok_or_else(|| "expected a number of 32 bits, decimal or in hex with 0x".to_owned())
}
