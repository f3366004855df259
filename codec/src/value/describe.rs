//! Methods of descriptions, descriptors and values for decoding a value by its type.

use super::shape::known;
use super::{DataType, Element, Elements, Shape};
use crate::com::{Descriptor, DescriptorRef};
use crate::error::Error;
use crate::variable::{DescriptionByNameRef, DescriptionRef, U32List, ValueRef, VariableType};

/// Implements `shape`, `elements` and `element` for a description by index or by name.
macro_rules! describes {
    ($( $description:ident )+) => { $(
        impl<'a> $description<'a> {
            /// Type, dimensions and size of the variable, checked to be consistent (VAR-8).
            ///
            /// # Errors
            /// Those of [`Shape::for_variable`].
            pub fn shape(&self) -> Result<Shape<'a>, Error> {
                Shape::for_variable(self.var_type, self.dimensions, self.size)
            }

            /// The elements in a value that was read without indices: the whole variable.
            ///
            /// # Errors
            /// Those of [`shape`](Self::shape) and of [`Shape::elements`].
            pub fn elements(&self, value: &ValueRef<'a>) -> Result<Elements<'a>, Error> {
                self.shape()?.elements(value.bytes)
            }

            /// The element in a value that was read by the indices of a single element.
            ///
            /// ```
            /// use ads_cnc::{Decode, DescriptionByNameRef, Element, ValueRef};
            ///
            /// // BOOLEAN[2]
            /// let bytes = b"\x02\0\0\x02\x01\0\0\0\x01\0\0\0\x02\0\0\0\x01\0\0\0\x02\0\0\0";
            /// let variable = DescriptionByNameRef::decode(bytes)?;
            /// let element = variable.element(&ValueRef { bytes: &[1] })?;
            /// assert!(matches!(element, Element::Boolean(on) if on.is_true()));
            /// # Ok::<(), ads_cnc::Error>(())
            /// ```
            ///
            /// # Errors
            /// Those of [`elements`](Self::elements).
            pub fn element(&self, value: &ValueRef<'a>) -> Result<Element<'a>, Error> {
                self.shape()?.element_shape().elements(value.bytes)?.element(U32List::EMPTY)
            }
        }
    )+ };
}

describes! { DescriptionRef DescriptionByNameRef }

impl<'a> ValueRef<'a> {
    /// The elements of a value of this type and these dimensions; for a single element,
    /// `dimensions` is empty.
    ///
    /// [`DescriptionRef::elements`] also checks the size in the description.
    ///
    /// ```
    /// use ads_cnc::{Decode, Element, U32List, ValueRef, VariableType};
    ///
    /// let value = ValueRef::decode(&[77, 1, 0, 0, 200, 1, 0, 0])?;
    /// let elements = value.elements(VariableType::SGN32, U32List::from(&[2]))?;
    /// assert!(elements.iter().eq([Element::Sgn32(333), Element::Sgn32(456)]));
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`Elements::new`], and [`ErrorKind::OutOfRange`](crate::ErrorKind::OutOfRange) for
    /// an undocumented type.
    pub fn elements(
        &self,
        var_type: VariableType,
        dimensions: U32List<'a>,
    ) -> Result<Elements<'a>, Error> {
        Elements::new(known(var_type)?, dimensions, self.bytes)
    }
}

macro_rules! data_type {
    ($( $descriptor:ty )+) => { $(
        impl $descriptor {
            /// The type of the content; `None` if [`type_name`](Self::type_name) is not the name of
            /// a [`DataType`].
            pub fn data_type(&self) -> Option<DataType> {
                DataType::by_name(self.type_name())
            }
        }
    )+ };
}

data_type! { Descriptor DescriptorRef<'_> }

#[cfg(feature = "alloc")]
mod owned {
    use super::*;
    use crate::variable::{Description, DescriptionByName};

    macro_rules! describes {
        ($( $description:ident )+) => { $(
            impl $description {
                /// Like the method `shape` of the borrowed type of this description.
                ///
                /// # Errors
                /// Those of [`Shape::for_variable`].
                pub fn shape(&self) -> Result<Shape<'_>, Error> {
                    self.as_ref().shape()
                }

                /// Like the method `elements` of the borrowed type of this description.
                ///
                /// # Errors
                /// Those of [`shape`](Self::shape) and of [`Shape::elements`].
                pub fn elements<'a>(&'a self, value: &ValueRef<'a>) -> Result<Elements<'a>, Error> {
                    self.as_ref().elements(value)
                }

                /// Like the method `element` of the borrowed type of this description.
                ///
                /// # Errors
                /// Those of [`elements`](Self::elements).
                pub fn element<'a>(&'a self, value: &ValueRef<'a>) -> Result<Element<'a>, Error> {
                    self.as_ref().element(value)
                }
            }
        )+ };
    }

    describes! { Description DescriptionByName }
}
