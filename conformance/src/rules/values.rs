//! Values of variables, compared with their descriptions.

use ads_cnc::operation::{Reply, Request};
use ads_cnc::{VariableAccess, VariableType};
use ads_cnc_vectors::ids::*;

use super::knowledge::ExchangeJudge;
use super::knowledge::TargetVariable;
use super::topic::Topic;
use crate::judge::{Checks as _, assumed};
use crate::text::plural;

/// Maximum size in bytes with which a text variable can be declared (VAR-25).
const TEXT_MAX: usize = 800;

impl TargetVariable {
    /// Size in bytes of the value that is read or written, if the type determines it.
    fn size(&self) -> Option<u32> {
        let element = self.description.var_type.element_size()?;
        Some(if self.indices.is_empty() { self.description.size } else { element })
    }

    /// Whether the number of indices selects the whole variable or one element.
    fn has_valid_index_count(&self) -> bool {
        self.indices.is_empty() || self.indices.len() == self.description.dimensions.len()
    }

    /// Whether every index is within the array.
    fn is_inside(&self) -> bool {
        self.indices.iter().zip(&self.description.dimensions).all(|(index, count)| index < count)
    }
}

impl ExchangeJudge<'_> {
    pub(super) fn values(&mut self, request: &Request<'_>, reply: Option<&Reply<'_>>) {
        let Some(target) = self.cnc.variables.described(request) else { return };
        let name = &target.description.name.text;
        let by_handle = matches!(request, Request::ReadByHandle(_) | Request::WriteByHandle(_));
        let (clause, written) = match request {
            Request::WriteByHandle(write) => (VAR_12, Some(write.value.as_bytes())),
            Request::WriteByName(write) => (VAR_13, Some(write.value.as_bytes())),
            _ => (if by_handle { VAR_11 } else { VAR_20 }, None),
        };
        let dimensions = target.description.dimensions.len();
        let indices = target.indices.len();
        let fits = target.has_valid_index_count();
        let mut record = self.records.on(Topic::ClientVar, self.observation);
        let found = || format!("{} of {name}", plural(indices, "index"));
        let rule = assumed(if by_handle { VAR_11 } else { VAR_20 });
        record.check(rule, fits, || format!("no index, or {}", plural(dimensions, "index")), found);
        if let (Some(written), Some(size), true) = (written, target.size(), fits) {
            let given = written.len();
            let sized = u32::try_from(given) == Ok(size);
            let expected = || format!("the {} of {name}", plural(size, "byte"));
            record.check(clause, sized, expected, || plural(given, "byte"));
        }
        let mut record = self.records.on(Topic::CncVar, self.observation);
        record.about(name);
        if !fits {
            let expected = || {
                format!("an error number, because {name} has {}", plural(dimensions, "dimension"))
            };
            record.check(rule, reply.is_none(), expected, "a success");
            return;
        }
        if !target.is_inside() {
            let rule = if by_handle { VAR_11 } else { VAR_20 };
            let expected =
                || format!("an error number, because {name} has no element {:?}", target.indices);
            record.check(rule, reply.is_none(), expected, "a success");
            return;
        }
        if written.is_some() {
            let only_read = target.description.access == VariableAccess::READ_ONLY;
            let passed = !only_read || reply.is_none();
            let expected = || format!("an error number, because {name} is READ_ONLY");
            record.check(assumed(VAR_6), passed, expected, "a success");
            return;
        }
        let Some(Reply::Value(value)) = reply else { return };
        let given = value.bytes.len();
        let found = || format!("{} of {name}", plural(given, "byte"));
        if let Some(size) = target.size() {
            let sized = u32::try_from(given) == Ok(size);
            record.check(
                VAR_14,
                sized,
                || format!("the {} of its description", plural(size, "byte")),
                found,
            );
        } else if target.description.var_type == VariableType::STRING && dimensions == 0 {
            let expected = || format!("a text of at most {TEXT_MAX} bytes");
            record.check(VAR_25, given <= TEXT_MAX, expected, found);
        }
    }
}
