//! The fuzz targets for the streams of vectors and the kinds of sequences. The crate of the fuzz
//! targets depends on this crate, and a test in that crate verifies that these targets exist.

use std::collections::BTreeSet;

/// The fuzz targets for the streams and sequences with these names.
pub(super) fn targets<'n>(names: impl IntoIterator<Item = &'n str>) -> BTreeSet<&'static str> {
    names.into_iter().flat_map(of).copied().collect()
}

/// The fuzz targets for the dispatch of requests and replies.
pub(super) const FUNCTIONS: &[&str] =
    &["operation_dispatch", "operation_request", "operation_reply"];

fn of(name: &str) -> &'static [&'static str] {
    match name {
        "ams-frame" => &["ads_frames"],
        "ams-tcp-header" | "ams-header" | "read-request" | "read-reply" | "write-request"
        | "write-reply" | "read-write-request" | "read-write-reply" | "device-info-reply"
        | "device-state-reply" => &["ads_bytes", "ads_value"],
        "content" => &["com_bytes", "com_value"],
        "program-stream" => &["streaming_bytes", "streaming_value", "streaming_sender"],
        "variable-path" => &["variable_path"],
        "index-group" | "index-offset" => &["operation_dispatch", "operation_request"],
        "nc-text" => &["streaming_packets"],
        "nc-check" => &["streaming_checker"],
        "streaming" => &["streaming_sender"],
        "service" => &["service_host"],
        _ if name.starts_with("object-address") || name.starts_with("element-") => {
            &["sda_bytes", "sda_value"]
        }
        _ if name.starts_with("object-") => &["com_bytes", "com_value"],
        _ if name.starts_with("dynamic-") => &["dynamic_bytes", "dynamic_value"],
        _ if name.starts_with("variable-") => &["variable_bytes", "variable_value"],
        _ => &[],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ads_cnc_vectors::{sequences, vectors};

    /// Every stream with a vector, and every kind of sequence, has a fuzz target.
    #[test]
    fn every_stream_with_a_vector_has_a_fuzz_target() {
        let names = vectors().iter().map(|vector| vector.stream.as_str());
        for name in names.chain(sequences().iter().map(|sequence| sequence.kind())) {
            assert!(!of(name).is_empty(), "{name}");
        }
    }
}
