//! Functions and types that several cases share, such as requests, checks, lists of items, and the
//! restoring of written values.

mod axis_interface;
mod changes;
mod channel_items;
mod counted;
mod dynamic_variables;
mod each_variable;
mod instance;
mod inventory;
mod layout;
mod object_list;
mod probe;
mod raw_call;
mod sample;
mod service_channels;
mod steady;
mod target_state;
mod try_write;
mod undo;
mod writable;

pub(crate) use axis_interface::{
    AxisHandle, GAP_MAX, PLACES_MAX, answering_places, axis_address, axis_names, axis_variables,
    name_on_axes,
};
pub use changes::Changes;
pub(crate) use channel_items::{ChannelItems, content_reads, in_channel};
pub(crate) use counted::Counted;
pub(crate) use dynamic_variables::{dynamic_among_variables, has_dynamic_variables};
pub(crate) use each_variable::{each_array, each_variable};
pub(crate) use instance::Instance;
pub(crate) use inventory::{
    INSTANCES_MAX, OBJECTS_MAX, OF_PLACES, VARIABLES_MAX, attribute_reads, element_by_rank, name_of,
};
pub(crate) use layout::{brackets, element_name, element_size, order, part, places_tried};
pub(crate) use object_list::{
    descriptors_one_by_one, known_object_count, object_count, read_descriptors,
};
pub use probe::Probe;
pub(crate) use probe::{ask_if_claimed, with_reply};
pub(crate) use raw_call::{IntoRawCall, RawCall};
pub use sample::Sample;
pub(crate) use sample::{ItemKind, SampleSizes};
pub(crate) use service_channels::service_channels;
pub(crate) use steady::{
    Compared, PendingCheck, Steady, between, compare, rules_by_index, steadily,
};
pub(crate) use target_state::DescribedList;
pub use target_state::TargetState;
pub(crate) use try_write::{NOTHING_WRITABLE, WriteCheck, changed_value, is_sendable, same};
pub(crate) use writable::{
    WritableElement, WritableNumber, each_of_access, elements_with_flag, handle_of, is_of_service,
    is_taken, may_write_whole, require_taken, writable_numbers, write_check,
};
