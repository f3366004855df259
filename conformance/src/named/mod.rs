//! Finds a variable, an element, a parameter or an object by its name.

mod lookup;
mod object;
mod variable;

pub use lookup::Lookup;

use crate::objects::ListedValue;
use crate::session::{Session, ToolError};

/// Finds a variable, an element, a parameter or an object by its name.
///
/// ```
/// use ads_cnc::address::Channel;
/// use ads_cnc_conformance::simulator::Cnc;
/// use ads_cnc_conformance::gate::Gate;
/// use ads_cnc_conformance::named::{Lookup, find};
/// use ads_cnc_conformance::session::Session;
/// use ads_cnc_conformance::values::plain;
///
/// let mut session = Session::simulated(Cnc::with_default_model()?, Gate::queries())?;
/// let mut value = |name: &str| {
///     let lookup = Lookup::new(name, Channel::new(1).unwrap());
///     let object = find(&mut session, &lookup)?;
///     let bytes = session.read(&object.address)?;
///     Ok::<_, ads_cnc_conformance::session::ToolError>(plain(&object.ty, &bytes).unwrap())
/// };
/// assert_eq!(value("V.E.Testvar")?, "123,234,345,456,567");
/// assert_eq!(value("V.E.matrix[1][2]")?, "23");
/// assert_eq!(value("P1")?, "4711.0");
/// assert_eq!(value("mc_active_single_block_r")?, "FALSE");
/// assert_eq!(value("feedhold.enable")?, "TRUE");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// For example if a part of the lookup, such as the name, is invalid, if not exactly one object or
/// element has this name, or if the CNC rejects or does not answer a necessary request.
pub fn find(session: &mut Session, lookup: &Lookup) -> Result<ListedValue, ToolError> {
    if variable::is_named(&lookup.name) || lookup.axis.is_some() {
        variable::find(session, lookup)
    } else {
        object::find(session, lookup)
    }
}

/// Returns a variable or a parameter without sending a request, because its name determines its
/// address; `None` for an object or an element. The type of a variable is that of `lookup`, if any;
/// the type of a parameter is REAL64.
///
/// # Errors
/// If the name is not the name of a variable, or cannot be encoded, or the type of `lookup` is not
/// that of a parameter.
pub fn by_name_alone(lookup: &Lookup) -> Result<Option<ListedValue>, ToolError> {
    let is_variable = variable::is_named(&lookup.name) || lookup.axis.is_some();
    is_variable.then(|| variable::unasked(lookup)).transpose()
}
