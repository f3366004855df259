//! The variables of the Service Interface.

use core::fmt;

use crate::layout::Field;
use crate::layout::service;
use crate::variable::VariableType;

/// Declares [`ServiceVariable`] from one row for each variable.
macro_rules! service_variables {
    (
        $(#[$doc:meta])*
        $type:ident { $( $(#[$variant_doc:meta])* $variant:ident: $name:ident, $var_type:ident; )+ }
    ) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum $type { $( $(#[$variant_doc])* $variant, )+ }

        impl $type {
            $(
                #[doc = concat!("The name of [`", stringify!($variant), "`](Self::", stringify!($variant), ").")]
                pub const $name: &'static str = concat!("V.G.SERVICE.", stringify!($name));
            )+

            /// All variables, in the order of the manual.
            pub const ALL: [Self; [$( Self::$name ),+].len()] = [$( Self::$variant ),+];

            /// The variable's name, for requests by name.
            pub const fn name(self) -> &'static str {
                match self { $( Self::$variant => Self::$name, )+ }
            }

            /// The type of the variable: UNS32 for a state, otherwise STRING.
            pub const fn var_type(self) -> VariableType {
                match self { $( Self::$variant => VariableType::$var_type, )+ }
            }

            pub(super) const fn field(self) -> Field {
                match self { $( Self::$variant => service::$name, )+ }
            }
        }
    };
}

service_variables! {
    /// A variable of the Service Interface (SVC-1). Each channel has its own five
    /// variables.
    ///
    /// Manual: `service-en` and `service-de` 1.03, section 2. The C code of the example shows that the
    /// states are UNS32.
    ///
    /// ```
    /// use ads_cnc::VariableType;
    /// use ads_cnc::address::Channel;
    /// use ads_cnc::operation::{Operation, ReadByName};
    /// use ads_cnc::service::ServiceVariable;
    ///
    /// let variable = ServiceVariable::RequestState;
    /// assert_eq!(variable.name(), "V.G.SERVICE.REQUEST_STATE");
    /// assert_eq!(variable.var_type(), VariableType::UNS32);
    ///
    /// let read = ReadByName::new(Channel::new(1)?, variable.name())?;
    /// let mut buf = [0; 32];
    /// assert_eq!(read.encode(&mut buf)?, b"V.G.SERVICE.REQUEST_STATE\0");
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    ServiceVariable {
        /// The UUID of the called service.
        Uuid: UUID, STRING;
        /// The text of the request.
        Request: REQUEST, STRING;
        /// Not 0 if a request is present.
        RequestState: REQUEST_STATE, UNS32;
        /// Not 0 if a response is present.
        ResponseState: RESPONSE_STATE, UNS32;
        /// The text of the response.
        Response: RESPONSE, STRING;
    }
}

impl ServiceVariable {
    /// The variable with this name; `None` if there is no such variable.
    pub fn by_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|variable| variable.name() == name)
    }
}

/// Displays the name.
impl fmt::Display for ServiceVariable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
