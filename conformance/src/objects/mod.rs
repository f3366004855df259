//! What a CNC has that can be read: objects of the COM task, elements of SDA and GEO, variables,
//! parameters.
//!
//! [`walk`] finds all of them, with as few requests as say what is there. Where a list ends, and so
//! what is asked in vain, is this, for each list:
//!
//! | what | asked | ends |
//! |---|---|---|
//! | channels | number of objects, by rank and by number | when as many numbers are found as ranks; without ranks behind [`GAP`] numbers in a row that are not there |
//! | channels that are named | number of objects of each | with them |
//! | objects | descriptors, [`RANGE`] in a request | with their number |
//! | platform axes | number of objects | at the first that is not there |
//! | position controller, HLD of the platform | axes from 1 on | at the first that is not there |
//! | HLD of the first channel | axes from 1 on, if the platform has none (E-30) | at the first that is not there |
//! | interpolator, decoder, path preparation, HLD | each channel found | with them |
//! | places of a channel in these, but for the HLD | from 1 on | at the first that is not there |
//! | spindles | from 0 on | at the first that is not there |
//! | elements | name, type, length, unit, write flag | with their number; behind [`GAP`] refused in a row |
//!
//! Which of SDA and GEO has a class no manual says: SDA is asked, and GEO for a class of which SDA has
//! nothing. At most [`OBJECTS_MAX`] objects are listed with [`NAMES_MAX`] bytes of names, and [`REQUESTS_MAX`] requests sent. An instance that is not there is one request: (0, 0), an error or the place of another instance is
//! the answer. No number goes beyond 255. Type, length, unit and write flag of an element are asked once of a class, for
//! its channels and for its axes: an element of the same name at the same place of another is taken
//! for alike (assumed; [`Options::exact`] asks all).

mod list;
mod pattern;
mod place;
mod report;
mod table;
mod walk;

pub use list::List;
pub use pattern::Pattern;
pub use place::{Access, Object, Place};
pub use report::{ObjectReport, ObjectsReport};
pub use table::{Column, columns, csv, table};
pub(crate) use walk::parameter;
pub use walk::{
    GAP, NAMES_MAX, OBJECTS_MAX, Options, RANGE, REQUESTS_MAX, WalkProgress, WalkResult, walk,
};
