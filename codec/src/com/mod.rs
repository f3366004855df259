//! The COM task: the number of objects, and the descriptor of each (COM-1 … COM-3).

mod count;
mod descriptor;
mod list;

pub use count::ObjectCount;
pub(crate) use descriptor::DescriptorLayout;
pub use descriptor::{Descriptor, DescriptorRef, WriteAccess};
#[cfg(feature = "alloc")]
pub use list::Descriptors;
pub use list::{DescriptorIter, DescriptorsRef};
