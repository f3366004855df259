//! The actions that the suite tells a client to execute. Actions may be added, but the meaning of
//! an action must not change.

use std::fmt;

use serde::Serialize;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ActionWord {
    pub name: &'static str,
    /// Names of the arguments. In a line with an action, only the value of the last argument may
    /// contain spaces.
    pub arguments: &'static [&'static str],
    /// The result of the action and, if needed, the possible values of an argument and the effect
    /// of the action.
    pub gives: &'static str,
}

macro_rules! words {
    ($( $name:literal [$($argument:literal)*] $gives:literal; )+) => {
        &[$( ActionWord { name: $name, arguments: &[$($argument),*], gives: $gives } ),+]
    };
}

/// All actions.
pub const VOCABULARY: &[ActionWord] = words! {
    "count-objects" ["CHANNEL"] "the number of COM objects";
    "list-objects" ["CHANNEL"] "their descriptors: name, type, size, writable, group, offset";
    "read-object" ["CHANNEL" "NAME"] "the content of an object, found by its name and read by its type";
    "write-object" ["CHANNEL" "NAME" "VALUE"] "nothing";
    "count-variables" ["CHANNEL" "KIND"] "the number of variables; KIND is V.E, V.G, V.A, or all";
    "describe" ["CHANNEL" "INDEX" "KIND"] "a description: name, handle, type, access, size and dimensions; type and access are numbers";
    "describe-extended" ["CHANNEL" "INDEX" "KIND"] "synchronisation and validity, or null";
    "handle" ["CHANNEL" "NAME"] "the handle of a variable";
    "read-by-name" ["CHANNEL" "NAME" "TYPE"] "its value";
    "write-by-name" ["CHANNEL" "NAME" "TYPE" "VALUE"] "nothing";
    "read-by-handle" ["CHANNEL" "HANDLE" "INDICES" "TYPE"] "its value; INDICES such as 4 or 1,2, or - for none";
    "write-by-handle" ["CHANNEL" "HANDLE" "INDICES" "TYPE" "VALUE"] "nothing";
    "axis-handle" ["CHANNEL" "AXIS" "NAME"] "the handle of an axis variable";
    "read-axis" ["CHANNEL" "AXIS" "NAME" "TYPE"] "its value";
    "write-axis" ["CHANNEL" "AXIS" "NAME" "TYPE" "VALUE"] "nothing";
    "count-parameters" ["CHANNEL" "KIND"] "the number of parameters; KIND is P, V.L, V.P or V.S";
    "parameter-name" ["CHANNEL" "KIND" "INDEX"] "its name";
    "parameter-by-name" ["CHANNEL" "KIND" "NAME"] "its value";
    "parameter-by-index" ["CHANNEL" "KIND" "INDEX"] "its value";
    "find-instance" ["CLASS" "CHANNEL" "AXIS"] "index group and index offset, or null; CLASS is position-controller, interpolator, decoder, hld, path-preparation or spindle";
    "count-elements" ["CLASS" "CHANNEL" "AXIS"] "the number of elements";
    "element-name" ["CLASS" "CHANNEL" "AXIS" "ELEMENT"] "its name";
    "element-type" ["CLASS" "CHANNEL" "AXIS" "ELEMENT"] "the name of its type";
    "element-length" ["CLASS" "CHANNEL" "AXIS" "ELEMENT"] "its number of bytes";
    "element-unit" ["CLASS" "CHANNEL" "AXIS" "ELEMENT"] "its unit";
    "element-writable" ["CLASS" "CHANNEL" "AXIS" "ELEMENT"] "whether it may be written";
    "read-element" ["CLASS" "CHANNEL" "AXIS" "ELEMENT" "TYPE"] "its content";
    "write-element" ["CLASS" "CHANNEL" "AXIS" "ELEMENT" "TYPE" "VALUE"] "nothing";
    "stream" ["CHANNEL" "FILE"] "nothing; the whole NC program is written to the stream";
    "serve-echo" ["CHANNEL" "UUID" "REQUESTS" "SECONDS"] "the number of requests answered, each with its own text and response state 1; ends after REQUESTS requests or SECONDS seconds";
    "ask-service" ["CHANNEL" "UUID" "REQUEST"] "the response";
};

/// An action with its arguments.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Action {
    pub action: String,
    pub args: Vec<String>,
}

impl Action {
    /// Parses an action such as `read-by-name 1 V.E.Testvar SGN32[5]`; `None` if the action is
    /// unknown or an argument is missing or empty.
    ///
    /// ```
    /// use ads_cnc_conformance::client_suite::Action;
    ///
    /// let action = Action::parse("stream 1 /tmp/a program.nc").unwrap();
    /// assert_eq!(action.args, ["1", "/tmp/a program.nc"]);
    /// assert!(Action::parse("melt 1").is_none() && Action::parse("stream 1").is_none());
    /// ```
    pub fn parse(line: &str) -> Option<Self> {
        let (name, rest) = line.split_once(' ').unwrap_or((line, ""));
        let word = VOCABULARY.iter().find(|word| word.name == name)?;
        let count = word.arguments.len();
        let args: Vec<String> = match count {
            0 => Vec::new(),
            _ => rest.splitn(count, ' ').map(str::to_owned).collect(),
        };
        let whole = args.len() == count && args.iter().all(|one| !one.is_empty());
        whole.then(|| Self { action: name.to_owned(), args })
    }
}

impl fmt::Display for Action {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.action)?;
        self.args.iter().try_for_each(|one| write!(f, " {one}"))
    }
}
