//! Explains index groups and offsets, and the function at an address.

use ads_cnc::address::{Access, AxisStride, Class, ComGroup, Group, IndexOffset};
use ads_cnc::dynamic::DynamicKind;
use ads_cnc::layout::Stream;
use ads_cnc::operation::{
    AdsService, DispatchError, Effect, Function, FunctionSpec, GroupRule, OffsetRule, Task,
};

use super::explanation::{ExplainedAddress, ExplainedStream, FunctionReport, ServiceAddress};
use super::group::describe;
use super::part;
use crate::edition::Feature;
use crate::value_format::ValueFormat;

/// Explains the data of a service at an address; the data begins at offset `at` of the input.
pub(super) fn of_data(
    ads_address: &ServiceAddress,
    at: usize,
    bytes: &[u8],
    values: &ValueFormat,
) -> ExplainedStream {
    let found = find(ads_address);
    let mut part = match found {
        Err(_) => ExplainedStream::opaque("Data of no documented function".to_owned(), at, bytes),
        Ok(function) => {
            let spec = function.spec();
            match if ads_address.reply { spec.reply } else { spec.request } {
                Some(stream) => part::of_stream(stream, at, bytes, values),
                None => no_data(ads_address, spec, at, bytes, values),
            }
        }
    };
    part.address = Some(report(ads_address, found));
    part
}

/// Explains an address without data.
pub(super) fn alone(ads_address: &ServiceAddress) -> ExplainedStream {
    // A content can be read and written: if the service is unknown, explain the read.
    let reading = ServiceAddress { reply: true, ..*ads_address };
    let found = find(if ads_address.service.is_none() { &reading } else { ads_address });
    ExplainedStream { address: Some(report(ads_address, found)), ..ExplainedStream::default() }
}

fn no_data(
    ads_address: &ServiceAddress,
    spec: &FunctionSpec,
    at: usize,
    bytes: &[u8],
    values: &ValueFormat,
) -> ExplainedStream {
    let mut part = part::of_stream(Stream::NoData, at, bytes, values);
    (part.title, part.stream) = ("No data".to_owned(), None);
    part.rows.clear();
    if !ads_address.reply {
        // The requirement of the stream `NoData` (VAR-17) specifies only replies.
        (part.clause, part.sources) = (None, Vec::new());
    }
    let (service, what) =
        (spec.service, if ads_address.reply { "returns none" } else { "sends none" });
    part.notes.push(format!("a {service} {what}"));
    if !ads_address.reply && !bytes.is_empty() {
        part.notes.push("for the data of the reply, specify --reply".to_owned());
    }
    part
}

/// Finds the function at an address.
fn find(ads_address: &ServiceAddress) -> Result<Function, DispatchError> {
    if let Some(port) = ads_address.port {
        Task::from_port(port).ok_or(DispatchError::Port(port))?;
    }
    let parts = ads_address.group.parts().ok_or(DispatchError::Group(ads_address.group))?;
    let mut error = DispatchError::Group(ads_address.group);
    let mut content = None;
    for function in Function::ALL.iter().copied() {
        let spec = function.spec();
        if !serves(ads_address, spec) || !spec.group.contains(parts) {
            continue;
        }
        if !spec.offset.contains(ads_address.offset) {
            error = DispatchError::Offset(ads_address.offset);
            continue;
        }
        let takes = spec.service;
        match ads_address.service {
            Some(service) if service == takes => return Ok(function),
            // A function takes precedence over a content at the same address (SDA-12).
            Some(service) if !spec.is_content() => {
                return Err(DispatchError::Service { expected: takes, found: service });
            }
            Some(service) => error = DispatchError::Service { expected: takes, found: service },
            None if !spec.is_content() => return Ok(function),
            // Without a service, content in a reply was read, and content in a request is to be
            // written.
            None if ads_address.reply == (takes == AdsService::Read) => {
                content = content.or(Some(function))
            }
            None => {}
        }
    }
    content.ok_or(error)
}

/// Whether the port, if known, belongs to the function's task; SDA and GEO are interchangeable
/// (ADR-10, assumed).
fn serves(ads_address: &ServiceAddress, spec: &FunctionSpec) -> bool {
    let task = ads_address.port.and_then(Task::from_port);
    task.is_none_or(|task| (task == Task::Com) == (spec.task == Task::Com))
}

fn report(
    ads_address: &ServiceAddress,
    found: Result<Function, DispatchError>,
) -> ExplainedAddress {
    let function = found.ok();
    let service = ads_address.service.or(function.map(|function| function.spec().service));
    let mut notes = Vec::new();
    let offset = offset(ads_address, function, &mut notes);
    match found {
        Ok(function) => meanings(ads_address, function, &mut notes),
        Err(error) => notes.push(at_other_port(ads_address).unwrap_or_else(|| error.to_string())),
    }
    ExplainedAddress {
        port: ads_address.port.map(|port| port.0),
        service: service.map(|service| service.to_string()),
        index_group: ads_address.group.get(),
        index_offset: ads_address.offset.get(),
        group: describe(ads_address.group),
        offset,
        function: function.map(|function| function_report(function.spec())),
        notes,
    }
}

/// Describes the function that another task has at this address; `None` if no other task has one,
/// or if the port is unknown.
fn at_other_port(ads_address: &ServiceAddress) -> Option<String> {
    let port = ads_address.port?;
    let spec = find(&ServiceAddress { port: None, ..*ads_address }).ok()?.spec();
    Some(format!("{}, at port {port} instead of {}", spec.name, spec.task.port()))
}

fn function_report(spec: &'static FunctionSpec) -> FunctionReport {
    let effect = match spec.effect {
        Effect::Query => "query",
        Effect::Write => "write",
        // Show any other effect as motion, because it is not known to be harmless.
        _ => "motion",
    };
    let numbered = spec.section.starts_with(|first: char| first.is_ascii_digit());
    let section = match spec.section {
        section if numbered => format!("ads-en 1.05 and ads-de 1.051, section {section}"),
        "online" => "the vendors' public help pages".to_owned(),
        section => section.to_owned(),
    };
    FunctionReport {
        name: spec.name,
        service: spec.service.to_string(),
        task: spec.task.to_string(),
        port: spec.task.port().0,
        effect: effect.to_owned(),
        clause: spec.clause,
        section,
        request: spec.request.map(|stream| stream.layout().name),
        reply: spec.reply.map(|stream| stream.layout().name),
    }
}

/// Adds notes about the function, and about other functions at the address.
fn meanings(ads_address: &ServiceAddress, function: Function, notes: &mut Vec<String>) {
    let spec = function.spec();
    if ads_address.port.is_some_and(|port| port != spec.task.port()) {
        let (task, port) = (spec.task, spec.task.port());
        notes.push(format!("documented for {task}, port {port} (ADR-10)"));
    }
    match function {
        Function::ReadDescriptors => {
            notes.push("one descriptor, or as many as the read length holds (COM-3)".to_owned());
        }
        Function::WriteProgramStream => {
            let name = ads_cnc::streaming::OBJECT_NAME;
            notes.push(format!("also the COM object {name}, written as NC text (STM-1)"));
        }
        _ => {}
    }
    if let Some(feature) = Feature::of(function) {
        let since: Vec<String> = feature.since().iter().map(ToString::to_string).collect();
        let (since, requirement) = (since.join(" and "), feature.requirement());
        notes.push(format!("from {since} on ({requirement})"));
    }
    let parts = ads_address.group.parts();
    let here = |other: &&FunctionSpec| {
        other.is_content()
            && (other.service != spec.service || !spec.is_content())
            && serves(ads_address, other)
            && parts.is_some_and(|parts| other.group.contains(parts))
            && other.offset.contains(ads_address.offset)
    };
    let mut others = Function::ALL.iter().map(|function| function.spec()).filter(here);
    if spec.is_content() {
        let others = others.map(|other| format!("with {}: {}", other.service, other.name));
        notes.extend(others);
    } else if spec.group == GroupRule::ChannelOf(Class::Decoder)
        && others.next().is_some()
        && let Some((axis, element)) = axis_and_element(ads_address.offset, AxisStride::X10000)
    {
        notes.push(format!(
                "also the address of {}element {element:#x} of the decoder; the function takes precedence (SDA-12)",
                of_axis(axis),
            ));
    }
}

fn axis_and_element(offset: IndexOffset, stride: AxisStride) -> Option<(u32, u32)> {
    offset.axis_and_element(stride).ok()
}

fn of_axis(axis: u32) -> String {
    if axis == 0 { String::new() } else { format!("axis {axis}, ") }
}

/// Explains the index offset in words, and adds notes about its other possible meanings.
fn offset(
    ads_address: &ServiceAddress,
    function: Option<Function>,
    notes: &mut Vec<String>,
) -> String {
    let (offset, rule) = (ads_address.offset, function.map(|function| function.spec().offset));
    match (rule, ads_address.group.parts()) {
        (Some(OffsetRule::OfKind(offsets)), _) => {
            let kinds = DynamicKind::ALL.into_iter().zip(offsets);
            let mut kind = kinds.filter(|(_, at)| *at == offset.get());
            kind.next().map_or_else(String::new, |(kind, _)| format!("of {kind}"))
        }
        (Some(OffsetRule::OfAxis(_)), _) => split(offset, AxisStride::X10000),
        (Some(OffsetRule::At(_)), _) => String::new(),
        (_, Some(Group::Com(ComGroup { access: Access::Object, .. }))) => match offset.get() {
            0 => "the whole list".to_owned(),
            object => format!("object {object} of the list"),
        },
        (_, Some(Group::Com(_))) => {
            if offset.get() >= 0x1000 {
                let (far, near) = (AxisStride::X10000, AxisStride::X1000);
                notes.push(format!(
                    "of a channel axis: {} if axes are 0x10000 apart, as in the examples; {} if 0x1000, as in the table; the object's descriptor decides (ADR-8, E-01)",
                    split(offset, far),
                    split(offset, near),
                ));
            }
            "from the object's descriptor".to_owned()
        }
        (_, Some(Group::Class(class))) => {
            if class.class == Class::Hld && (0x1000..0x1_0000).contains(&offset.get()) {
                notes.push(format!(
                    "in the manual, the platform axes of the HLD are 0x1000 apart: {} (E-01)",
                    split(offset, AxisStride::X1000),
                ));
            }
            match offset.get() {
                0 => {
                    "element 0, with the name and the number of elements of the instance".to_owned()
                }
                _ => split(offset, AxisStride::X10000),
            }
        }
        (_, None) => String::new(),
    }
}

fn split(offset: IndexOffset, stride: AxisStride) -> String {
    match axis_and_element(offset, stride) {
        Some((axis, element)) => format!("{}element {element:#x}", of_axis(axis)),
        None => "no axis of 16 bits".to_owned(),
    }
}
