//! A name to find, and the options that narrow the search.

use ads_cnc::address::{Channel, ChannelAxis};
use ads_cnc::value::DataType;

use crate::objects::Pattern;

/// A name to find. The name determines the kind of value:
///
/// | name | kind |
/// |---|---|
/// | `V.L.…`, `V.P.…`, `V.S.…`, `P` and a digit | a dynamic parameter |
/// | any other `V.…` | a variable; with `[i][j]` at the end, an element of an array |
/// | anything else | a COM object or an element of SDA or GEO, by its whole name |
#[derive(Clone, Debug)]
pub struct Lookup {
    pub name: String,
    pub channel: Channel,
    /// The axis, for access through the axis interface; only for V.A.
    pub axis: Option<ChannelAxis>,
    /// A pattern of the names of the lists to search; `None` to search all lists of the channel, of
    /// the platform, its axes and spindles.
    pub lists: Option<Pattern>,
    /// The index offset that the object or element must have; `None` for any.
    pub offset: Option<u32>,
    /// The type to use instead of the type in the CNC's description. For a dynamic parameter, any
    /// type other than REAL64 is an error.
    pub ty: Option<DataType>,
}

impl Lookup {
    /// A lookup of a name in a channel, without further options.
    pub fn new(name: &str, channel: Channel) -> Self {
        let name = name.to_owned();
        Self { name, channel, axis: None, lists: None, offset: None, ty: None }
    }
}
