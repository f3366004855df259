//! Calls the public functions of the codec that exist without features, and the diagnostics of a
//! program: decoding, operations, frames, texts, values and state machines, with bytes that the
//! compiler does not know. The no-panic proof (`proofs/run`) links this code; linking fails if a
//! panic is reachable. A test in `allocation/main.rs` runs this code and counts its allocations.

#![allow(unused_qualifications, reason = "the proof is searched for whole paths")]

mod named;

use ads_cnc::address::{IndexGroup, IndexOffset};
use ads_cnc::ads::*;
use ads_cnc::operation::{AdsService, Call};
use ads_cnc::service::{Host, HostStep, ServiceId};
use ads_cnc::value::{Boolean, EncodeValue as _, Scalar};
use ads_cnc::*;
use core::hint::black_box;

/// Decodes a stream and encodes the value again; also decodes a stream at the start of the bytes.
/// Returns true.
fn both<'a, T: Decode<'a> + Encode>(bytes: &'a [u8]) -> bool {
    let mut buf = [0; 2200];
    let written = T::decode(bytes).and_then(|value| value.encode(&mut buf).map(<[u8]>::len));
    let after = T::decode_prefix(bytes).map_or(0, |(_, rest)| rest.len());
    black_box(written.unwrap_or_else(|error| error.offset() as usize)).max(after) < usize::MAX
}

macro_rules! readings {
    ($( $stream:ident: $view:ty $( , $owned:ty )?; )+) => {
        fn readings(bytes: &[u8]) -> bool {
            both::<Descriptor>(bytes)
                & both::<ExtendedDescription>(bytes)
                & both::<NoData>(bytes)
                $( & both::<$view>(bytes) )+
        }
    };
}
ads_cnc::streams! { readings }

/// Dispatches a call whose address, read length and data are in the bytes, encodes the request
/// again, and decodes the bytes as a reply to it.
fn operations(bytes: &[u8]) -> Result<usize, Error> {
    let number = |at: usize| {
        let four = bytes.get(at..).and_then(|rest| rest.first_chunk());
        four.map_or(0, |four| u32::from_le_bytes(*four))
    };
    let service = match number(0) & 3 {
        0 => AdsService::Read,
        1 => AdsService::Write,
        _ => AdsService::ReadWrite,
    };
    let call = Call {
        port: AmsPort(number(1) as u16),
        service,
        index_group: IndexGroup::new(number(4)),
        index_offset: IndexOffset::new(number(8)),
        read_length: number(12),
        data: bytes,
    };
    let Ok(request) = call.dispatch() else { return Ok(0) };
    let (mut buf, mut out) = ([0; 2200], [0; 2200]);
    let again = request.encode(&mut buf)?.data.len();
    let reply = request.decode_reply(bytes)?;
    Ok(reply.encode(&mut out)?.len().wrapping_add(again))
}

fn frames(bytes: &[u8]) -> Result<usize, Error> {
    let mut buf = [0; 256];
    match FrameRef::split(bytes, 64)? {
        Some((frame, _)) => Ok(frame.encode(&mut buf)?.len()),
        None => Ok(0),
    }
}

fn texts(bytes: &[u8]) -> Result<usize, Error> {
    let text = CncStr::from_bytes(bytes)?;
    let path = VariablePath::from_text(text)?;
    let mut buf = [0; 300];
    let element = path.write_element(U32List::from(&[1, 2]), &mut buf)?;
    let value = ValueRef { bytes }.elements(VariableType(9), element.elements())?;
    Ok(element.parts().count().wrapping_add(value.len()))
}

/// Decodes the bytes as a description, and as a value of the described type, dimensions and size.
fn values(bytes: &[u8]) -> Result<usize, Error> {
    let value = ValueRef { bytes };
    if let Ok(nameless) = DescriptionByNameRef::decode(bytes) {
        black_box(nameless.element(&value)?.data_type());
    }
    let description = DescriptionRef::decode(bytes)?;
    let (elements, shape) = (description.elements(&value)?, description.shape()?);
    let mut buf = [0; 2200];
    let mut seen = shape.encode(&elements, &mut buf)?.len();
    seen = seen.wrapping_add(shape.index_of(description.dimensions)? as usize);
    seen = seen.wrapping_add(elements.iter().rev().skip(3).count());
    seen = seen.wrapping_add(description.element(&value)?.encode_value(&mut buf)?.len());
    seen = seen.wrapping_add(elements.element(description.dimensions)?.value_len());
    let texts = [description.name.text(), description.name.text()];
    seen = seen.wrapping_add(shape.encode_texts(&texts, &mut buf)?.len());
    seen = seen.wrapping_add(elements.iter().map(converted).sum());
    seen = seen.wrapping_add(items::<bool>(elements)?);
    seen = seen.wrapping_add(items::<Boolean>(elements)?).wrapping_add(items::<i8>(elements)?);
    seen = seen.wrapping_add(items::<u8>(elements)?).wrapping_add(items::<i16>(elements)?);
    seen = seen.wrapping_add(items::<u16>(elements)?).wrapping_add(items::<i32>(elements)?);
    seen = seen.wrapping_add(items::<u32>(elements)?).wrapping_add(items::<i64>(elements)?);
    seen = seen.wrapping_add(items::<u64>(elements)?).wrapping_add(items::<f32>(elements)?);
    Ok(seen.wrapping_add(items::<f64>(elements)?))
}

/// The number of types that the element can be converted to.
fn converted(element: Element<'_>) -> usize {
    [
        i8::try_from(element).is_ok(),
        u8::try_from(element).is_ok(),
        i16::try_from(element).is_ok(),
        u16::try_from(element).is_ok(),
        i32::try_from(element).is_ok(),
        u32::try_from(element).is_ok(),
        i64::try_from(element).is_ok(),
        u64::try_from(element).is_ok(),
        f32::try_from(element).is_ok(),
        f64::try_from(element).is_ok(),
        bool::try_from(element).is_ok(),
        CncStr::try_from(element).is_ok(),
        TextRef::try_from(element).is_ok(),
    ]
    .map(usize::from)
    .iter()
    .sum()
}

fn items<T: Scalar>(elements: Elements<'_>) -> Result<usize, Error> {
    let Ok(items) = elements.items::<T>() else { return Ok(0) };
    let (mut all, mut buf) = ([T::default(); 7], [0; 2200]);
    elements.copy_to(&mut all)?;
    let value = ValueRef { bytes: elements.as_bytes() };
    let one = value.get::<T>(black_box(3))?.encode_value(&mut buf)?.len();
    value.copy_to(&mut all)?;
    let again = value.iter::<T>()?.rev().filter(|item| *item == all[0]);
    let seen = again.count().wrapping_add(one).wrapping_add(items.rev().count());
    Ok(all.encode_value(&mut buf)?.len().wrapping_add(seen))
}

fn services(bytes: &[u8]) -> Result<usize, Error> {
    let ids = [ServiceId::new("560AACBF-6335-44a9-895A-8B27F3ED5E47")?];
    let mut host = Host::new(&ids);
    for _ in 0..black_box(20) {
        match host.step() {
            HostStep::Read(_) => host.read(bytes)?,
            HostStep::Write(_, []) => host.failed(),
            HostStep::Write(..) => host.written(),
            HostStep::Serve { .. } => host.answer(CncStr::EMPTY, 1)?,
            HostStep::Wait => host.poll(),
        }
    }
    Ok(0)
}

/// Calls the functions above and those of `named` with these bytes. Returns true.
pub(crate) fn runs(bytes: &[u8]) -> bool {
    let numbers = [
        operations(bytes).unwrap_or(1),
        frames(bytes).unwrap_or(2),
        texts(bytes).unwrap_or(3),
        values(bytes).unwrap_or(7),
        services(bytes).unwrap_or(4),
    ];
    black_box(numbers);
    named::runs(bytes);
    readings(bytes)
}
