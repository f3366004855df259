//! The field that an error names.

use core::fmt;

use super::spec::{Declared, FieldSpec};
use super::{Stream, Subject};

/// A field of a stream, a part of another [`Subject`], or a stream or subject as a whole.
///
/// ```
/// use ads_cnc::layout::{Field, Stream};
/// use ads_cnc::{Decode, DescriptionRef};
///
/// let error = DescriptionRef::decode(&[2, 0, 0, 2, 1, 0]).unwrap_err();
/// assert_eq!(Some(error.field()), Field::by_name(Stream::VariableDescription, "type"));
/// assert_eq!(error.field().spec().unwrap().offset, 4);
/// assert_eq!(Field::whole(Stream::VariableDescription).name(), "stream");
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct Field {
    subject: Subject,
    index: u8,
}

impl Field {
    #[inline]
    pub(crate) const fn new(subject: Subject, index: u8) -> Self {
        Self { subject, index }
    }

    /// The field with this name in a declared stream. Panics if there is no such field.
    pub(crate) const fn of<T: Declared>(name: &str) -> Self {
        let index = T::LAYOUT.index(name);
        assert!(index != u8::MAX, "the stream has no field of this name");
        Self::new(Subject::Stream(T::STREAM), index)
    }

    /// The previous field. Before a list, this is its count.
    pub(crate) const fn before(self) -> Self {
        Self { index: self.index.saturating_sub(1), ..self }
    }

    /// The same field of another stream, which must have the same rows.
    pub(crate) const fn in_stream(self, stream: Stream) -> Self {
        Self { subject: Subject::Stream(stream), ..self }
    }

    /// The stream as a whole, for example for errors of its length or end.
    pub const fn whole(stream: Stream) -> Self {
        Self::whole_subject(Subject::Stream(stream))
    }

    /// A subject as a whole, for errors that concern no single part.
    pub(crate) const fn whole_subject(subject: Subject) -> Self {
        Self { subject, index: u8::MAX }
    }

    /// The stream or subject of this field as a whole.
    pub(crate) const fn to_whole(self) -> Self {
        Self::whole_subject(self.subject)
    }

    /// The field of `stream` with this name; `None` if there is no such field.
    pub fn by_name(stream: Stream, name: &str) -> Option<Self> {
        stream.fields().find(|field| field.name() == name)
    }

    /// The subject that the field belongs to.
    pub const fn subject(self) -> Subject {
        self.subject
    }

    /// The stream that the field belongs to; `None` for a part of another subject.
    pub const fn stream(self) -> Option<Stream> {
        match self.subject {
            Subject::Stream(stream) => Some(stream),
            _ => None,
        }
    }

    /// The row in the table of the stream; `None` for a stream as a whole and for a part of another
    /// subject.
    pub fn spec(self) -> Option<&'static FieldSpec> {
        self.stream()?.layout().fields.get(usize::from(self.index))
    }

    /// The name of the field or part; `stream` for a stream or another subject as a whole.
    pub fn name(self) -> &'static str {
        self.subject.part(self.index).unwrap_or("stream")
    }
}

impl fmt::Display for Field {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.subject.name(), self.name())
    }
}

impl fmt::Debug for Field {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}.{}", self.subject.name(), self.name())
    }
}

impl Stream {
    /// The fields, in the order on the wire.
    pub fn fields(self) -> impl Iterator<Item = Field> {
        (0u8..)
            .zip(self.layout().fields)
            .map(move |(index, _)| Field::new(Subject::Stream(self), index))
    }

    /// All streams except [`NoData`](Self::NoData).
    pub fn all() -> impl Iterator<Item = Self> {
        Self::ALL.iter().copied()
    }

    /// The stream with this name; `None` for any other name, and for that of
    /// [`NoData`](Self::NoData).
    pub fn by_name(name: &str) -> Option<Self> {
        Self::all().find(|stream| stream.layout().name == name)
    }
}

impl fmt::Display for Stream {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.layout().name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::DescriptionRef;

    #[test]
    fn fields_are_found_by_name() {
        let field = Field::of::<DescriptionRef<'_>>("dimensions");
        assert_eq!((field.name(), field.before().name()), ("dimensions", "dimension_count"));
    }

    #[test]
    #[should_panic = "no field of this name"]
    fn unknown_field_of_a_declared_stream_panics() {
        Field::of::<DescriptionRef<'_>>("dimension");
    }
}
