//! The areas of requirements.

/// Each area of requirements with its topic.
const AREAS: [(&str, &str); 10] = [
    ("GEN", "bytes, texts, tasks"),
    ("ADR", "index groups and offsets"),
    ("COM", "objects of the COM task"),
    ("SDA", "elements of SDA and GEO"),
    ("DYN", "P, V.L, V.P, V.S by index"),
    ("VAR", "V. variables"),
    ("ADS", "services and headers"),
    ("STM", "data streaming"),
    ("SVC", "Service Interface"),
    ("OBJ", "lists of objects"),
];

/// The topic of an area of requirements. Any other ID is that of a protocol of the suite: `TESTEE`
/// or `CLIENT`.
pub fn about(area: &str) -> &'static str {
    let found = AREAS.iter().find(|(name, _)| *name == area);
    found.map_or("the protocol with the suite", |(_, about)| about)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn areas_are_those_of_the_catalogue() {
        for one in ads_cnc_vectors::requirements() {
            assert!(AREAS.iter().any(|(area, _)| *area == one.area), "{}", one.area);
        }
    }
}
