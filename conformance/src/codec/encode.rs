//! The other way round: fields in, bytes or a refusal out.

use ads_cnc::ads::{
    AdsError, AdsState, AmsAddr, AmsHeader, AmsNetId, AmsPort, AmsTcpHeader, Command,
    DeviceInfoReply, DeviceStateReply, FrameRef, ReadReply, ReadRequest, ReadWriteReply,
    ReadWriteRequest, StateFlags, WriteReply, WriteRequest,
};
use ads_cnc::dynamic::{DynamicCount, DynamicIndex, DynamicName, DynamicNameRequest, DynamicValue};
use ads_cnc::sda::{
    ElementCount, ElementLength, ElementText, ElementWriteFlag, ObjectAddress, ObjectAddressQuery,
};
use ads_cnc::streaming::ProgramStream;
use ads_cnc::{
    Content, Decode as _, Description, DescriptionByName, Descriptor, Descriptors, Encode,
    ExtendedDescription, ExtendedReply, Handle, HandleRead, HandleWrite, NameWrite, ObjectCount,
    Synchronisation, Validity, Value, VariableAccess, VariableCount, VariableIndexKind,
    VariableKind, VariableName, VariableType, WriteAccess,
};
use ads_cnc_vectors::{Context, Fields, Type};

use super::given::Given;
use super::{Refused, address};

/// Encodes fields as this stream.
///
/// # Errors
/// The codec's refusal, or what keeps these fields from being a value of the stream.
pub fn encode(stream: &str, context: &Context, fields: &Fields) -> Result<Vec<u8>, Refused> {
    let of = Given(fields);
    match stream {
        "ams-tcp-header" => {
            bytes(AmsTcpHeader { reserved: of.number("reserved")?, length: of.number("length")? })
        }
        "ams-header" => bytes(ams_header(of, of.number("data_length")?)?),
        "read-request" | "read-reply" | "write-request" | "write-reply" | "read-write-request"
        | "read-write-reply" => service(stream, of),
        "ams-frame" => frame(of),
        "device-info-reply" => bytes(DeviceInfoReply {
            result: AdsError(of.number("result")?),
            major: of.number("major")?,
            minor: of.number("minor")?,
            build: of.number("build")?,
            name: of.fixed("name")?,
        }),
        "device-state-reply" => bytes(DeviceStateReply {
            result: AdsError(of.number("result")?),
            ads_state: AdsState(of.number("ads_state")?),
            device_state: of.number("device_state")?,
        }),
        "object-count" => bytes(ObjectCount(of.number("count")?)),
        "object-descriptor" => bytes(descriptor(of)?),
        "object-descriptors" => {
            let records = of.records("descriptors")?;
            bytes(records.into_iter().map(descriptor).collect::<Result<Descriptors, _>>()?)
        }
        "object-address-query" => {
            bytes(ObjectAddressQuery { channel: of.number("channel")?, axis: of.number("axis")? })
        }
        "object-address" => {
            let (index_group, index_offset) = of.place()?;
            bytes(ObjectAddress { index_group, index_offset })
        }
        "element-count" => bytes(ElementCount(of.number("count")?)),
        "element-text" => bytes(ElementText { text: of.text("text")? }),
        "element-length" => length(of),
        "element-write-flag" => bytes(ElementWriteFlag(of.number("flag")?)),
        "content" => bytes(Content { bytes: content(of, context)? }),
        "dynamic-count" => bytes(DynamicCount(of.number("count")?)),
        "dynamic-index" => bytes(DynamicIndex(of.number("index")?)),
        "dynamic-name" => bytes(DynamicName { name: of.text("name")? }),
        "dynamic-name-request" => bytes(DynamicNameRequest { name: of.text("name")? }),
        "dynamic-value" => bytes(DynamicValue::from_bits(of.bits("value")?)),
        "index-group" => address::encode_group(of),
        "index-offset" => address::encode_offset(of, context),
        "program-stream" => bytes(ProgramStream { bytes: of.bytes("data")? }),
        other => variable(other, of, context),
    }
}

fn variable(stream: &str, of: Given<'_>, context: &Context) -> Result<Vec<u8>, Refused> {
    match stream {
        "variable-kind" => bytes(VariableKind { kind: of.text("kind")? }),
        "variable-count" => bytes(VariableCount(of.number("count")?)),
        "variable-index-kind" => {
            bytes(VariableIndexKind { index: of.number("index")?, kind: of.text("kind")? })
        }
        "variable-description" => bytes(Description {
            handle: Handle(of.number("handle")?),
            var_type: VariableType(of.number("type")?),
            access: VariableAccess(of.number("access")?),
            size: of.number("size")?,
            dimensions: of.numbers("dimensions")?,
            name: of.text("name")?,
        }),
        "variable-description-by-name" => bytes(DescriptionByName {
            handle: Handle(of.number("handle")?),
            var_type: VariableType(of.number("type")?),
            access: VariableAccess(of.number("access")?),
            size: of.number("size")?,
            dimensions: of.numbers("dimensions")?,
        }),
        "variable-name" => bytes(VariableName { name: of.text("name")? }),
        "variable-handle" => bytes(Handle(of.number("handle")?)),
        "variable-handle-read" => bytes(HandleRead {
            handle: Handle(of.number("handle")?),
            indices: of.numbers("indices")?,
        }),
        "variable-value" => bytes(Value { bytes: of.elements("value", context)? }),
        "variable-handle-write" => bytes(HandleWrite {
            handle: Handle(of.number("handle")?),
            indices: of.numbers("indices")?,
            value: of.elements("value", context)?,
        }),
        "variable-name-write" => bytes(NameWrite {
            name: of.characters("name")?.into(),
            value: of.elements("value", context)?,
        }),
        "variable-extended-description" => bytes(ExtendedReply(match of.has("validity") {
            false => None,
            true => Some(ExtendedDescription {
                synchronisation: Synchronisation(of.number("synchronisation")?),
                validity: Validity(of.number("validity")?),
            }),
        })),
        "variable-path" => super::path::encode(of),
        other => Err(Refused::Unsupported(format!("stream {other}"))),
    }
}

fn bytes(value: impl Encode) -> Result<Vec<u8>, Refused> {
    Ok(value.encode_to_vec()?)
}

/// A content by its type; bytes if there is none.
fn content(of: Given<'_>, context: &Context) -> Result<Vec<u8>, Refused> {
    match (context.kind, &context.dimensions) {
        (Some(_), Some(_)) => of.elements("content", context),
        _ => of.bytes("content"),
    }
}

/// A length in as many bytes as its type has: that width is the reader's, and only it can be kept.
fn length(of: Given<'_>) -> Result<Vec<u8>, Refused> {
    match of.kind("length")? {
        Type::Uns08 => bytes(ElementLength::decode(&of.number::<u8>("length")?.to_le_bytes())?),
        Type::Uns16 => bytes(ElementLength::decode(&of.number::<u16>("length")?.to_le_bytes())?),
        _ => bytes(ElementLength::new(of.number("length")?)),
    }
}

fn descriptor(of: Given<'_>) -> Result<Descriptor, Refused> {
    let (group, offset) = of.place()?;
    Ok(Descriptor::from_text(of.characters("name")?, of.characters("type")?)?
        .with_id(of.number("id")?)
        .with_size(of.number("size")?)
        .with_write_access(WriteAccess(of.number("write_access")?))
        .with_not_assigned(of.number("not_assigned")?)
        .with_content(group, offset))
}

fn ams_header(of: Given<'_>, data_length: u32) -> Result<AmsHeader, Refused> {
    let end = |net_id: &str, port: &str| -> Result<AmsAddr, Refused> {
        let net_id: AmsNetId = of.word(net_id)?.parse()?;
        Ok(AmsAddr { net_id, port: AmsPort(of.number(port)?) })
    };
    Ok(AmsHeader {
        target: end("target_net_id", "target_port")?,
        source: end("source_net_id", "source_port")?,
        command: Command(of.number("command")?),
        state_flags: StateFlags(of.number("state_flags")?),
        data_length,
        error: AdsError(of.number("error")?),
        invoke_id: of.number("invoke_id")?,
    })
}

fn frame(of: Given<'_>) -> Result<Vec<u8>, Refused> {
    let tcp = of.record("ams_tcp_header")?;
    if tcp.number::<u16>("reserved")? != 0 {
        return Err(Refused::Unfit("a frame with a reserved number other than 0".to_owned()));
    }
    let header = ams_header(of.record("ams_header")?, 0)?;
    let services = [
        ("read_request", "read-request"),
        ("read_reply", "read-reply"),
        ("write_request", "write-request"),
        ("write_reply", "write-reply"),
        ("read_write_request", "read-write-request"),
        ("read_write_reply", "read-write-reply"),
    ];
    let service_of = services.iter().find(|(field, _)| of.has(field));
    let data = match service_of {
        Some((field, stream)) => service(stream, of.record(field)?)?,
        None if of.has("data") => of.bytes("data")?,
        None => Vec::new(),
    };
    bytes(FrameRef::new(header, &data)?)
}

fn service(stream: &str, of: Given<'_>) -> Result<Vec<u8>, Refused> {
    let result = || Ok::<_, Refused>(AdsError(of.number("result")?));
    let data = || of.has("data").then(|| of.bytes("data")).transpose();
    match stream {
        "read-request" => {
            let (index_group, index_offset) = of.place()?;
            bytes(ReadRequest { index_group, index_offset, length: of.number("length")? })
        }
        "read-reply" => bytes(ReadReply { result: result()?, data: data()? }),
        "write-request" => {
            let (index_group, index_offset) = of.place()?;
            bytes(WriteRequest { index_group, index_offset, data: of.bytes("data")? })
        }
        "write-reply" => bytes(WriteReply { result: result()? }),
        "read-write-request" => {
            let (index_group, index_offset) = of.place()?;
            let read_length = of.number("read_length")?;
            let data = of.bytes("data")?;
            bytes(ReadWriteRequest { index_group, index_offset, read_length, data })
        }
        _ => bytes(ReadWriteReply { result: result()?, data: data()? }),
    }
}
