//! What is asked for by a name.

use ads_cnc::address::{Channel, ChannelAxis};
use ads_cnc::value::DataType;

use crate::objects::Pattern;

/// What is asked for by a name.
///
/// | name | is |
/// |---|---|
/// | `V.L.…`, `V.P.…`, `V.S.…`, `P` and a digit | a dynamic parameter |
/// | any other `V.…` | a variable; with `[i][j]` at its end an element |
/// | anything else | a COM object or an element of SDA or GEO, by its whole name |
#[derive(Clone, Debug)]
pub struct Lookup {
    pub name: String,
    pub channel: Channel,
    /// Which place, over the axis interface; of V.A only.
    pub axis: Option<ChannelAxis>,
    /// Which lists of objects, if several have the name.
    pub lists: Option<Pattern>,
    /// At which offset, if a list has the name several times.
    pub offset: Option<u32>,
    /// What to take it for, whatever the CNC says.
    pub ty: Option<DataType>,
}

impl Lookup {
    /// What has this name, in a channel.
    pub fn new(name: &str, channel: Channel) -> Self {
        let name = name.to_owned();
        Self { name, channel, axis: None, lists: None, offset: None, ty: None }
    }
}
