//! The ports, channels, axes, spindles and lists that the run found by queries before the first
//! case.

use serde::{Deserialize, Serialize};

use crate::text::plural;

/// The result of the queries before the cases.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FoundReport {
    /// Number of the queries before the cases.
    pub requests: usize,
    /// Approximate number of requests that the cases will send, without those of `--allow-write`.
    pub expected: u64,
    /// The AMS ports that reply; empty if a profile states the claims, because the ports are then
    /// not queried.
    pub ports: Vec<u16>,
    /// The channels that are judged.
    pub channels: Vec<FoundChannel>,
    /// Number of axes of the platform; 0 if unknown.
    pub platform_axes: u32,
    /// Number of spindles.
    pub spindles: u32,
    /// Number of axes of the platform that the file of `--profile` claims, if any.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub claimed_axes: Option<u32>,
    /// Number of spindles that the profile claims, if any.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub claimed_spindles: Option<u32>,
    /// Channels that the profile claims, but that do not reply.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub silent_channels: Vec<u32>,
    /// The lists with a known number of items.
    pub lists: Vec<FoundList>,
    /// The reason why the queries ended early.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stopped: Option<String>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FoundChannel {
    pub number: u32,
    /// Number of axis indices of the channel, including indices without an axis.
    pub axes: u32,
}

/// A list of objects, elements, variables or parameters.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FoundList {
    /// The name of the list, as shown by `browse`.
    pub name: String,
    /// Number of items.
    pub items: u32,
    /// Number of items that the cases read; less than `items` for a sample, which the seed selects.
    pub read: u32,
}

/// Maximum number of sampled lists named in a text.
const NAMED_MAX: usize = 6;

fn joined(texts: impl Iterator<Item = String>) -> String {
    texts.collect::<Vec<_>>().join(", ")
}

/// The found number, after the claimed number if the two numbers differ; only the claimed number if
/// none was found.
fn claimed(found: u32, claimed: Option<u32>, noun: &str) -> Option<String> {
    Some(match claimed.filter(|claimed| *claimed != found) {
        // 0 may also mean that the number was not queried.
        Some(claimed) if found == 0 => format!("claimed {}", plural(claimed, noun)),
        Some(claimed) => format!("claimed {}, found {found}", plural(claimed, noun)),
        None => plural(found, noun),
    })
}

impl FoundReport {
    /// Whether queries found ports. The ports are queried only if the claims come from queries
    /// instead of a profile.
    pub fn is_by_queries(&self) -> bool {
        !self.ports.is_empty()
    }

    /// The result on one line.
    pub fn summary(&self) -> String {
        let mut parts = Vec::new();
        if !self.ports.is_empty() {
            parts.push(format!("ports {}", joined(self.ports.iter().map(ToString::to_string))));
        }
        if !self.channels.is_empty() {
            let channels = self.channels.iter();
            let channels = channels
                .map(|one| format!("{} with {}", one.number, plural(one.axes, "axis index")));
            parts.push(format!("channel {}", joined(channels)));
        }
        if !self.silent_channels.is_empty() {
            let silent = joined(self.silent_channels.iter().map(ToString::to_string));
            parts.push(format!("no reply from the claimed channel {silent}"));
        }
        let axes = claimed(self.platform_axes, self.claimed_axes, "platform axis");
        // If `platform_axes` is 0, the number of axes may be unknown.
        let axes = axes.filter(|_| self.platform_axes > 0 || self.claimed_axes.is_some());
        let spindles = claimed(self.spindles, self.claimed_spindles, "spindle");
        parts.extend(axes.into_iter().chain(spindles));
        let items: u64 = self.lists.iter().map(|list| u64::from(list.items)).sum();
        let lists = plural(self.lists.len(), "list");
        parts.push(format!("{} in {lists}", plural(items, "item")));
        let stopped = self.stopped.as_ref();
        let stopped = stopped.map_or_else(String::new, |why| format!("; no more, because {why}"));
        format!("{}, by {}{stopped}", parts.join("; "), plural(self.requests, "request"))
    }

    /// The lists of which only a sample is read, on one line; `None` if all lists are read
    /// completely.
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
            more => Some(format!("{named} and {}; by the seed", plural(more, "more list"))),
        }
    }
}
