//! The readable values of a CNC: objects of the COM task, elements of SDA and GEO, variables,
//! parameters.
//!
//! [`walk`] finds all of them with as few requests as possible. A list ends where the table says; the
//! request after its last entry is rejected:
//!
//! | list | requests | ends |
//! |---|---|---|
//! | channels | number of objects, by rank and by number | when as many numbers are found as ranks; without ranks after [`GAP`] rejected numbers in a row |
//! | channels that the caller names | number of objects of each | with them |
//! | objects | descriptors, [`RANGE`] in a request; each by itself after such a request was rejected | with their number, or after [`GAP`] rejected in a row |
//! | platform axes | number of objects | at the first that is rejected |
//! | position controller, HLD of the platform | axes from 1 on | at the first that is rejected |
//! | HLD of the first channel | axes from 1 on, if the platform has none (E-30) | at the first that is rejected |
//! | interpolator, decoder, path preparation, HLD | each channel found | with them |
//! | axes of a channel in these, but for the HLD | from 1 on | at the first that is rejected |
//! | spindles | from 0 on | at the first that is rejected |
//! | elements | name, type, length, unit, write flag | with their number, or after [`GAP`] rejected in a row |
//! | variables, parameters | description or name, by index | with their number, or after [`GAP`] rejected in a row |
//!
//! The suite walks by the same rules (`Walker`), but names the channels and axes that the profile
//! claims, and reads one descriptor in a request.
//!
//! No manual says whether SDA or GEO has a class: requests go to SDA, and to GEO for a class of which SDA
//! has nothing. At most [`OBJECTS_MAX`] objects are listed with [`NAMES_MAX`] bytes of names, and
//! [`REQUESTS_MAX`] requests sent. (0, 0), an error, or the address of another instance as the address of
//! an instance means that the target does not have it. No number is above 255. Type, length, unit and
//! write flag of an element are read once for the channels of a class and once for its axes: an element
//! with the same name and number in another instance is assumed to have the same ([`Options::exact`]
//! reads all).

mod list;
mod object;
mod pattern;
mod report;
mod table;
mod value_address;
mod walk;

pub use list::List;
pub use object::{Object, ReportedAccess};
pub use pattern::Pattern;
pub use report::{ObjectReport, ObjectsReport};
pub use table::{Column, columns, csv, table};
pub use value_address::ValueAddress;
pub(crate) use walk::{
    CLASSES, KINDS, Walker, active_channels, decode_element_count, decoder_of, has_variables,
};
pub use walk::{
    GAP, NAMES_MAX, OBJECTS_MAX, Options, RANGE, REQUESTS_MAX, WalkProgress, WalkResult, walk,
};
pub(crate) use walk::{absent_of, channels_of};
