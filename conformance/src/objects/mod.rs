//! The readable values of a CNC: objects of the COM task, elements of SDA and GEO, variables and
//! parameters.
//!
//! [`walk`] finds either the objects and elements, or the variables and parameters. The table shows
//! the requests for each list, and the condition at which the list ends:
//!
//! | list | requests | ends |
//! |---|---|---|
//! | channels | by rank: number of objects, or of variables if only earlier ranks have objects; by number: number of objects, or the decoder if no rank has objects | when as many channel numbers as ranks are found; if no rank is found, after [`GAP`] consecutive rejected numbers |
//! | channels named by the caller | number of objects; if the channel has no object, its decoder | after the last named channel |
//! | objects | number, descriptors, at most [`RANGE`] in a request; one by one after a request for several was rejected | at their number, or after [`GAP`] consecutive rejections |
//! | platform axes | number of objects | at the first axis without objects |
//! | position controller, HLD of the platform | axes, starting at 1 | at the first missing axis |
//! | HLD of the first channel | axes, starting at 1, if the HLD of the platform has no axes (E-30) | at the first missing axis |
//! | interpolator, decoder, path preparation, HLD | each channel found | after the last channel |
//! | axes of a channel in these classes, except the HLD | axes, starting at 1 | at the first missing axis |
//! | spindles | spindles, starting at 0 | at the first missing spindle |
//! | elements | number, name, type, length, unit, write flag | at their number, or after [`GAP`] consecutive rejections |
//! | variables, parameters | number, description or name, by index | at their number, or after [`GAP`] consecutive rejections |
//!
//! A reply that cannot be decoded counts as a rejection.
//!
//! The suite uses similar rules (`Walker`), but requests the channels and the lists of platform
//! axes that the profile claims. It reads one descriptor per request, and also requests the axes of
//! the platform in the HLD of every channel.
//!
//! The manuals do not specify whether SDA or GEO serves a class: requests go to SDA, and to GEO for
//! a class of which SDA has no instance. At most [`OBJECTS_MAX`] objects are listed, with at most
//! [`NAMES_MAX`] bytes of names and units, and at most [`REQUESTS_MAX`] requests are sent. An
//! instance is missing if the target rejects the request for its address, or if the address is (0,
//! 0), belongs to no class, or is the address of another instance. The numbers of channels, axes
//! and spindles that are requested end at 255. Type, length, unit and write flag of an element are
//! read once for the channels or spindles of a class and once for its axes. An element with the
//! same name and number in another instance is assumed to have the same attributes. This is done
//! for at most 64 names of a number; [`Options::exact`] reads the attributes of every element.

mod list;
mod object;
mod report;
mod table;
mod value_address;
mod walk;

pub use crate::text::Pattern;
pub use list::ValueList;
pub use object::{ListedValue, ReportedAccess};
pub use report::{ObjectReport, ObjectsReport};
pub use table::{Column, VALUE, columns, csv, table};
pub use value_address::ValueAddress;
pub(crate) use walk::{
    CLASSES, KINDS, Walker, active_channels, decode_element_count, decoder_of, has_variables,
};
pub use walk::{
    GAP, NAMES_MAX, OBJECTS_MAX, Options, RANGE, REQUESTS_MAX, WalkProgress, WalkResult, walk,
};
pub(crate) use walk::{absent_of, channels_of};
