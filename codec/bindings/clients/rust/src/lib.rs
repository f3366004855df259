//! The requests of both programs, which differ only in their [`Transport`].

use std::error::Error;

use ads_cnc::address::{Channel, Class, ElementAddress};
use ads_cnc::ads::AdsError;
use ads_cnc::operation::*;
use ads_cnc::value::{DataType, Element, Elements};
use ads_cnc::{CncStr, CncString, Decode as _, DescriptionRef, Kind, U32List, VariablePath};
use futures_util::future::try_join_all;
use serde_json::{Value, json};

pub type Result<T> = std::result::Result<T, Box<dyn Error>>;

/// Carries requests to a CNC.
pub trait Transport {
    /// Sends a request and returns the data of its reply, or the [`AdsError`] of the CNC.
    fn send(&self, call: Call<'_>) -> impl Future<Output = Result<Vec<u8>>>;
}

/// Sends the request of an operation and returns the data of its reply, for `decode_reply`.
async fn send(cnc: &impl Transport, operation: &impl Operation) -> Result<Vec<u8>> {
    let mut data = vec![0; operation.encoded_len()];
    cnc.send(operation.call(&mut data)?).await
}

async fn text<O>(cnc: &impl Transport, operation: O) -> Result<String>
where
    O: for<'r> Operation<Reply<'r> = ads_cnc::sda::ElementTextRef<'r>>,
{
    let reply = send(cnc, &operation).await?;
    Ok(operation.decode_reply(&reply)?.text.to_string())
}

/// Converts a value to JSON. An array has one level of nested arrays for each dimension.
fn to_json(elements: &Elements<'_>) -> Result<Value> {
    fn nested(values: &[Value], dimensions: &[u32]) -> Value {
        let Some((_, inner)) = dimensions.split_first() else { return values[0].clone() };
        let len = inner.iter().product::<u32>() as usize;
        values.chunks(len).map(|values| nested(values, inner)).collect()
    }
    let values = elements.iter().map(|element| {
        Ok(match element {
            Element::String(text) => text.to_string().into(),
            _ if element.data_type() == DataType::Boolean => bool::try_from(element)?.into(),
            _ => i64::try_from(element).map_or(json!(f64::try_from(element)?), Value::from),
        })
    });
    let dimensions: Vec<u32> = elements.shape().dimensions().iter().collect();
    Ok(nested(&values.collect::<Result<Vec<_>>>()?, &dimensions))
}

async fn read(cnc: &impl Transport, channel: Channel, name: &str) -> Result<Value> {
    let describe = DescribeByName::new(channel, VariablePath::new(name)?)?;
    let description = send(cnc, &describe).await?;
    let description = describe.decode_reply(&description)?;
    let read = ReadByName::new(channel, name)?;
    let value = send(cnc, &read).await?;
    to_json(&description.elements(&read.decode_reply(&value)?)?)
}

async fn write(cnc: &impl Transport, channel: Channel, name: &str, value: &Value) -> Result<()> {
    let describe = DescribeByName::new(channel, VariablePath::new(name)?)?;
    let description = send(cnc, &describe).await?;
    let shape = describe.decode_reply(&description)?.shape()?;
    let mut bytes = vec![0; shape.size() as usize];
    let value = match value.as_str() {
        Some(text) => shape.encode(&text.parse::<CncString>()?.as_cnc_str(), &mut bytes)?,
        None => shape.encode(&u16::try_from(value.as_u64().ok_or("no number")?)?, &mut bytes)?,
    };
    send(cnc, &WriteByName::new(channel, name, value)?).await?;
    Ok(())
}

/// Reads and writes the simulated CNC, prints the values, and fails if a value is not the expected
/// one.
pub async fn show(cnc: &impl Transport, expected: &Value) -> Result<()> {
    let channel = Channel::new(1)?;

    // Describe all variables of the kind V.E, by index. Over tokio, all requests are sent without
    // waiting for replies.
    let count = CountVariables::new(channel, Kind::V_E);
    let number = count.decode_reply(&send(cnc, &count).await?)?.0;
    let listed = try_join_all((0..number).map(async |index| -> Result<Value> {
        let describe = DescribeByIndex::new(channel, index, Kind::V_E);
        let reply = send(cnc, &describe).await?;
        let found = describe.decode_reply(&reply)?;
        let dimensions: Vec<u32> = found.dimensions.iter().collect();
        Ok(json!([found.name.to_string(), found.shape()?.data_type().name(), dimensions]))
    }))
    .await?;
    check("V.E", &json!(listed), &expected["variables"])?;
    let name = |at: usize| listed[at][0].as_str().unwrap_or_default();
    println!("V.E: {number} variables, {} to {}", name(0), name(listed.len() - 1));

    for (name, value) in expected["read"].as_object().ok_or("read")? {
        shown(name, &read(cnc, channel, name).await?, value)?;
    }
    for (name, value) in expected["write"].as_object().ok_or("write")? {
        write(cnc, channel, name, &value[1]).await?;
        shown(&format!("{name}, written"), &read(cnc, channel, name).await?, &value[1])?;
    }

    // Find an element of SDA by its name: query the instance of the class, then read the names of
    // its elements.
    let find = FindInstance::new(Class::Hld, 1, 0);
    let found = find.decode_reply(&send(cnc, &find).await?)?;
    let first = found.first_element()?.ok_or("no HLD")?;
    let element = find_element(cnc, first, &expected["element"][0]).await?;
    let of_type = text(cnc, ReadElementType::new(element)).await?;
    let length = ReadElementLength::new(element);
    let length = length.decode_reply(&send(cnc, &length).await?)?.get();
    let read_element = ReadElement::new(element, length)?;
    let content = send(cnc, &read_element).await?;
    let data_type = DataType::by_name(CncStr::new(&of_type)?).ok_or("no such type")?;
    let value = to_json(&Elements::new(data_type, U32List::EMPTY, &content)?)?;
    let (group, offset) = (read_element.index_group(), read_element.index_offset().get());
    let name = expected["element"][0].as_str().unwrap_or_default();
    let wanted = json!([expected["element"][1], expected["element"][2]]);
    shown(&format!("{name} at {group}, {offset}"), &json!([of_type, value]), &wanted)?;

    let error = read(cnc, channel, "V.E.nothing").await.err().ok_or("V.E.nothing is there")?;
    let number = error.downcast_ref::<AdsError>().map(|error| error.0);
    shown("V.E.nothing, ADS error", &json!(number), &json!(0x710))?;

    // Decode only the received bytes: in this reply, zeros up to the read length are an error.
    let describe = DescribeByIndex::new(channel, 0, Kind::V_E);
    let mut padded = send(cnc, &describe).await?;
    padded.resize(describe.read_length() as usize, 0);
    let error = DescriptionRef::decode(&padded).err().ok_or("no error")?;
    let stream = error.field().stream().map(|stream| stream.layout().name);
    let found = json!([stream, error.field().name(), error.offset()]);
    shown("a padded reply", &found, &json!(["variable-description", "name", 20]))
}

async fn find_element(
    cnc: &impl Transport,
    first: ElementAddress,
    wanted: &Value,
) -> Result<ElementAddress> {
    let count = CountElements::new(first)?;
    for index in 1..=count.decode_reply(&send(cnc, &count).await?)?.0 {
        let element = first.nth(index)?;
        if text(cnc, ReadElementName::new(element)).await? == *wanted {
            return Ok(element);
        }
    }
    Err(format!("no element {wanted}").into())
}

fn shown(what: &str, found: &Value, wanted: &Value) -> Result<()> {
    check(what, found, wanted)?;
    println!("{what}: {found}");
    Ok(())
}

fn check(what: &str, found: &Value, wanted: &Value) -> Result<()> {
    if found == wanted {
        return Ok(());
    }
    Err(format!("{what}: {found}, expected {wanted}").into())
}

/// The arguments of both programs: the address of the CNC, and the file with the expected values.
pub fn arguments() -> Result<(String, Value)> {
    let mut arguments = std::env::args().skip(1);
    let (Some(address), Some(file)) = (arguments.next(), arguments.next()) else {
        return Err("arguments: HOST:PORT EXPECTED.json".into());
    };
    Ok((address, serde_json::from_reader(std::fs::File::open(file)?)?))
}
