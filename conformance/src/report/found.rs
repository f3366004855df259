//! What the queries before the cases found.

use serde::{Deserialize, Serialize};

/// What the queries before the cases found.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FoundReport {
    /// Number of requests that this took.
    pub requests: usize,
    /// Number of requests that the cases are expected to send, about, without those of
    /// `--allow-write`.
    pub expected: u64,
    /// The AMS ports that answer; none with `--profile`, which names them.
    pub ports: Vec<u16>,
    /// The channels that are judged.
    pub channels: Vec<FoundChannel>,
    /// Number of axes of the platform.
    pub platform_axes: u32,
    /// Number of spindles.
    pub spindles: u32,
    /// The lists that have a number of items.
    pub lists: Vec<FoundList>,
    /// Why the queries ended early.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stopped: Option<String>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FoundChannel {
    pub number: u32,
    /// Number of its places for axes, with an axis or without.
    pub axes: u32,
}

/// A list of objects, elements, variables or parameters.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FoundList {
    /// Its name, as `browse` has it.
    pub name: String,
    /// Number of its items.
    pub items: u32,
    /// Number of items that the cases read: fewer than `items` in a sample by the seed.
    pub read: u32,
}

/// Maximum number of sampled lists that a text names.
const NAMED_MAX: usize = 6;

fn joined(texts: impl Iterator<Item = String>) -> String {
    texts.collect::<Vec<_>>().join(", ")
}

impl FoundReport {
    /// What was found, in one line.
    pub fn summary(&self) -> String {
        let mut parts = Vec::new();
        if !self.ports.is_empty() {
            parts.push(format!("ports {}", joined(self.ports.iter().map(ToString::to_string))));
        }
        if !self.channels.is_empty() {
            let channels = self.channels.iter();
            let channels = channels.map(|one| format!("{} with {} axes", one.number, one.axes));
            parts.push(format!("channel {}", joined(channels)));
        }
        let (axes, spindles) = (self.platform_axes, self.spindles);
        parts.push(format!("{axes} axes of the platform, {spindles} spindles"));
        let items: u64 = self.lists.iter().map(|list| u64::from(list.items)).sum();
        parts.push(format!("{items} items in {} lists", self.lists.len()));
        let stopped = self.stopped.as_ref();
        let stopped = stopped.map_or_else(String::new, |why| format!("; no more, because {why}"));
        format!("{}, by {} requests{stopped}", parts.join("; "), self.requests)
    }

    /// The lists that are not read whole, in one line; `None` if all are.
    pub fn sampled(&self) -> Option<String> {
        let sampled: Vec<String> = self
            .lists
            .iter()
            .filter(|list| list.read < list.items)
            .map(|list| format!("{}: {} of {}", list.name, list.read, list.items))
            .collect();
        let named = joined(sampled.iter().take(NAMED_MAX).cloned());
        match sampled.len().saturating_sub(NAMED_MAX) {
            _ if sampled.is_empty() => None,
            0 => Some(format!("{named}; by the seed")),
            more => Some(format!("{named} and {more} more lists; by the seed")),
        }
    }
}
