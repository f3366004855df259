//! Prints requests in a dry run, which does not send them.

use std::fmt;
use std::io::{self, Write as _};

use ads_cnc::layout::Stream;

use crate::exchange::{Exchange, ExchangeError};
use crate::report::lines;
use crate::text::plural;

/// Prints a request of a dry run to stdout.
pub(super) fn print(exchange: &Exchange) {
    // A failure to write, for example to a closed stdout, is not an error.
    let _unread = write!(io::stdout().lock(), "{}", NotSent(exchange));
}

/// A request in a dry run: function, address, bytes, and whether the gate would allow it.
struct NotSent<'e>(&'e Exchange);

impl fmt::Display for NotSent<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let call = self.0.call();
        let spec = call.dispatch().ok().map(|request| request.function().spec());
        let (name, clause) = spec.map_or(("no function", "-"), |spec| (spec.name, spec.clause));
        let verdict = match &self.0.outcome {
            // The error of the command contains the reason.
            Err(ExchangeError::NotPermitted(_)) => "would be rejected".to_owned(),
            Err(ExchangeError::Unsendable(error)) => format!("cannot be encoded: {error}"),
            _ => "would be sent".to_owned(),
        };
        writeln!(f, "{verdict}\n  {name} ({clause}): {}", self.0)?;
        if call.read_length > 0 {
            writeln!(f, "  reply of at most {}", plural(call.read_length, "byte"))?;
        }
        let stream = spec.and_then(|spec| spec.request).map(|stream: Stream| stream.layout().name);
        lines::annotated(stream, call.data).iter().try_for_each(|line| writeln!(f, "  {line}"))
    }
}
