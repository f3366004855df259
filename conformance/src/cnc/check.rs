//! What a data model has to hold to, so that every answer fits its stream.

use std::collections::BTreeSet;

use ads_cnc::limits::VARIABLE_MAX;
use ads_cnc::{Descriptors, Encode, Handle, VariableType};

use super::model::ChannelModel;
use super::to_len;
use super::variable::Variable;

/// A data model whose parts do not fit.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ModelError {
    /// A channel number that cannot be addressed.
    #[error("channels are counted from 1")]
    ChannelZero,
    /// Two channels with one number.
    #[error("channel {0} is there twice")]
    Channel(u8),
    /// A name of no known kind, or one that ends like an element's.
    #[error("{0}: a name begins with V.E., V.G. or V.A. and does not end in ]")]
    Name(String),
    /// Two variables of a channel with one name.
    #[error("{0} is there twice")]
    NameTwice(String),
    /// Two variables of a channel with one handle.
    #[error("{name} has the handle {:#x} of another variable", handle.0)]
    Handle {
        /// The second variable with it.
        name: String,
        /// The handle.
        handle: Handle,
    },
    /// A type the manuals do not have.
    #[error("{name} has the unknown type {}", var_type.0)]
    Type {
        /// The variable.
        name: String,
        /// The type.
        var_type: VariableType,
    },
    /// A value that has not the size of its elements.
    #[error("{name}: {expected} bytes expected, {found} there")]
    Size {
        /// The variable.
        name: String,
        /// Type size and dimensions, multiplied.
        expected: usize,
        /// Bytes of the value.
        found: usize,
    },
    /// A dimension without elements, or elements beyond number.
    #[error("{0}: its dimensions do not multiply to a number of elements")]
    Dimensions(String),
    /// A STRING without an end.
    #[error("{0}: a STRING has no NUL")]
    NoNul(String),
    /// A value longer than a reply.
    #[error("{name}: {found} bytes of value, at most {VARIABLE_MAX} fit into a reply")]
    TooLong {
        /// The variable.
        name: String,
        /// Bytes of the value.
        found: usize,
    },
    /// An object list too long for one reply.
    #[error("{0} objects in a list, at most {OBJECTS_MAX} fit into a reply")]
    Objects(usize),
    /// Two objects with one number.
    #[error("two objects have the ID {0}")]
    ObjectId(u32),
    /// An object that has not the size of its type.
    #[error("object {id}: its type has {expected} bytes, {found} given")]
    ObjectSize {
        /// The object.
        id: u32,
        /// Size of the type.
        expected: u32,
        /// Size given.
        found: u32,
    },
    /// Something the codec does not encode.
    #[error(transparent)]
    Codec(#[from] ads_cnc::Error),
}

/// Objects of a list: all of them fit into one reply.
const OBJECTS_MAX: usize = 780;

pub(super) fn channels(channels: &[ChannelModel]) -> Result<(), ModelError> {
    let mut numbers = BTreeSet::new();
    for channel in channels {
        if channel.number == 0 {
            return Err(ModelError::ChannelZero);
        }
        if !numbers.insert(channel.number) {
            return Err(ModelError::Channel(channel.number));
        }
        variables(&channel.variables)?;
    }
    Ok(())
}

fn variables(variables: &[Variable]) -> Result<(), ModelError> {
    let (mut names, mut handles) = (BTreeSet::new(), BTreeSet::new());
    for variable in variables {
        one(variable)?;
        if !names.insert(&variable.name) {
            return Err(ModelError::NameTwice(variable.name.to_string()));
        }
        if !handles.insert(variable.handle) {
            let (name, handle) = (variable.name.to_string(), variable.handle);
            return Err(ModelError::Handle { name, handle });
        }
    }
    Ok(())
}

fn one(variable: &Variable) -> Result<(), ModelError> {
    let name = || variable.name.to_string();
    if variable.kind().is_none() || variable.name.as_bytes().ends_with(b"]") {
        return Err(ModelError::Name(name()));
    }
    let mut dimensions = variable.dimensions.iter().map(|&elements| to_len(elements));
    let elements = dimensions.try_fold(1_usize, |count, elements| count.checked_mul(elements));
    let Some(elements) = elements.filter(|&count| count > 0) else {
        return Err(ModelError::Dimensions(name()));
    };
    let found = variable.bytes.len();
    if found > VARIABLE_MAX {
        return Err(ModelError::TooLong { name: name(), found });
    }
    let each = match variable.var_type.element_size() {
        Some(size) => to_len(size),
        None if variable.var_type == VariableType::STRING => string(variable, elements)?,
        None => return Err(ModelError::Type { name: name(), var_type: variable.var_type }),
    };
    let expected = each.saturating_mul(elements);
    if found != expected {
        return Err(ModelError::Size { name: name(), expected, found });
    }
    // Name and dimensions have limits of their own, which the codec knows.
    variable.description().to_vec()?;
    Ok(())
}

/// The declared bytes of each STRING.
fn string(variable: &Variable, elements: usize) -> Result<usize, ModelError> {
    let each = variable.bytes.len().checked_div(elements).unwrap_or_default();
    let mut texts = variable.bytes.chunks(each.max(1));
    if each == 0 || !texts.all(|text| text.contains(&0)) {
        return Err(ModelError::NoNul(variable.name.to_string()));
    }
    Ok(each)
}

pub(super) fn objects(
    channels: &[ChannelModel],
    platform: &Descriptors,
    axes: &[Descriptors],
) -> Result<(), ModelError> {
    let mut ids = BTreeSet::new();
    let lists = channels.iter().map(|channel| &channel.objects).chain([platform]).chain(axes);
    for objects in lists {
        list(objects)?;
        for object in objects.as_ref().iter() {
            let (id, found) = (object.id(), object.size());
            if !ids.insert(id) {
                return Err(ModelError::ObjectId(id));
            }
            let size = object.type_size();
            if let Some(expected) = size.filter(|&expected| expected != found) {
                return Err(ModelError::ObjectSize { id, expected, found });
            }
        }
    }
    Ok(())
}

pub(super) fn list(objects: &Descriptors) -> Result<(), ModelError> {
    match objects.as_ref().len() {
        count if count > OBJECTS_MAX => Err(ModelError::Objects(count)),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use ads_cnc::{Descriptor, VariableAccess};

    use super::*;
    use crate::cnc::{DATA_MAX, Model};

    fn variable() -> Variable {
        Variable {
            handle: Handle(1),
            name: "V.E.a".parse().unwrap(),
            var_type: VariableType::SGN16,
            access: VariableAccess::READ_ONLY,
            dimensions: vec![2],
            bytes: vec![0; 4],
        }
    }

    fn model(variables: Vec<Variable>) -> Result<Model, ModelError> {
        let objects = Descriptors::default();
        let channel =
            ChannelModel { number: 1, active: true, objects, variables, axes: Vec::new() };
        Model::new(vec![channel], Descriptors::default(), Vec::new())
    }

    #[test]
    fn a_longest_list_is_one_reply() {
        assert_eq!((DATA_MAX as usize - 8) / ads_cnc::limits::DESCRIPTOR_LEN, OBJECTS_MAX);
    }

    #[test]
    fn variables_have_to_fit() {
        let one = variable();
        assert!(model(vec![one.clone()]).is_ok());
        let error = |variable: Variable| model(vec![variable]).unwrap_err().to_string();
        let named = |name: &str| Variable { name: name.parse().unwrap(), ..variable() };
        for name in ["V.P.a", "V.E.", "V.E", "V.E.a[1]"] {
            assert!(error(named(name)).contains("a name begins with"), "{name}");
        }
        assert!(error(named(&format!("V.E.{}", "x".repeat(252)))).contains("too long"));
        let bytes = vec![0; 5];
        let wrong = error(Variable { bytes, ..one.clone() });
        assert_eq!(wrong, "V.E.a: 4 bytes expected, 5 there");
        let dimensions = |dimensions| Variable { dimensions, ..variable() };
        assert!(error(dimensions(vec![2, 0])).contains("do not multiply"));
        assert!(error(dimensions(vec![u32::MAX; 9])).contains("do not multiply"));
        let long = Variable { dimensions: vec![1025], bytes: vec![0; 2050], ..one.clone() };
        assert!(error(long).contains("at most 2048"));
        assert!(error(Variable { var_type: VariableType(10), ..one.clone() }).contains("type 10"));
        let string = Variable { var_type: VariableType::STRING, bytes: b"ab\0c".to_vec(), ..one };
        assert!(error(string.clone()).contains("no NUL"));
        assert!(model(vec![Variable { dimensions: vec![], ..string }]).is_ok());
    }

    #[test]
    fn names_handles_numbers_and_ids_are_unique() {
        let (one, mut two) = (variable(), variable());
        two.handle = Handle(2);
        let twice = ModelError::NameTwice("V.E.a".into());
        assert_eq!(model(vec![one.clone(), two.clone()]).unwrap_err(), twice);
        two.name = "V.G.a".parse().unwrap();
        assert!(model(vec![one.clone(), two.clone()]).is_ok());
        two.handle = Handle(1);
        assert!(model(vec![one, two]).unwrap_err().to_string().contains("handle 0x1"));

        let objects: Descriptors =
            [Descriptor::new("o", "INT").unwrap().with_id(3).with_size(2)].into_iter().collect();
        let channel = |number| ChannelModel {
            number,
            active: true,
            objects: Descriptors::default(),
            variables: Vec::new(),
            axes: Vec::new(),
        };
        let channels = |numbers: &[u8]| numbers.iter().copied().map(channel).collect();
        let error = |numbers: &[u8], platform: &Descriptors, axes: Vec<Descriptors>| {
            Model::new(channels(numbers), platform.clone(), axes).unwrap_err()
        };
        let none = Descriptors::default();
        assert_eq!(error(&[0], &none, vec![]), ModelError::ChannelZero);
        assert_eq!(error(&[4, 4], &none, vec![]), ModelError::Channel(4));
        assert_eq!(error(&[1], &objects, vec![objects.clone()]), ModelError::ObjectId(3));
        let wrong = [Descriptor::new("o", "LREAL").unwrap().with_size(4)].into_iter().collect();
        let (id, expected, found) = (0, 8, 4);
        assert_eq!(error(&[], &wrong, vec![]), ModelError::ObjectSize { id, expected, found });
    }
}
