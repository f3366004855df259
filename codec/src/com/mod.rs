//! The COM task: how many objects there are, and the 84 bytes that describe each (COM-1 … COM-3).

mod count;
mod descriptor;
mod list;

pub use count::ObjectCount;
pub(crate) use descriptor::DescriptorLayout;
pub use descriptor::{Descriptor, DescriptorRef, WriteAccess};
#[cfg(feature = "alloc")]
pub use list::Descriptors;
pub use list::DescriptorsRef;
