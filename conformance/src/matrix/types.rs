//! The Rust types of each stream, and the modules of each area of requirements.

use ads_cnc::layout::Stream;

macro_rules! types {
    ($( $stream:ident: $view:ty $( , $owned:ty )?; )+) => {
        /// The types that decode and encode a stream.
        pub(super) fn of_stream(stream: Stream) -> Vec<&'static str> {
            let paths: &[&str] = match stream {
                $( Stream::$stream => &[stringify!($view) $( , stringify!($owned) )?], )+
                _ => &[],
            };
            let name = |path: &&'static str| {
                let name = path.rsplit("::").next()?;
                name.split('<').next().map(str::trim)
            };
            paths.iter().filter_map(name).collect()
        }
    };
}

ads_cnc::streams! { types }

/// An area of requirements.
pub(super) struct Area {
    pub(super) area: &'static str,
    /// The main chapters of the area.
    pub(super) chapters: &'static str,
    /// The codec's modules and types for the area.
    pub(super) modules: &'static str,
}

const fn area(area: &'static str, chapters: &'static str, modules: &'static str) -> Area {
    Area { area, chapters, modules }
}

pub(super) const AREAS: &[Area] = &[
    area("GEN", "ads 1, 2", "`text`, `operation::Task`"),
    area("ADR", "ads 1, 2", "`address`"),
    area("COM", "ads 2.1", "`Descriptor`, `Content`"),
    area("SDA", "ads 2.2", "`sda`"),
    area("DYN", "ads 3", "`dynamic`"),
    area("VAR", "ads 4", "`Description`, `Handle`, `Value`, `value`"),
    area("ADS", "ads 5", "`ads`"),
    area("STM", "stream 2, 3, 4, 5", "`streaming`"),
    area("SVC", "service 1, 2, 3", "`service`"),
    area("OBJ", "ads 1", "`operation::ObjectList`"),
];

#[cfg(test)]
mod tests {
    use super::*;
    use ads_cnc_vectors::requirements;

    /// Fails if `of_stream` returns no types for a stream of the codec.
    #[test]
    fn every_stream_has_types() {
        for stream in Stream::all() {
            assert!(!of_stream(stream).is_empty(), "{stream}");
        }
    }

    /// Each area of the catalogue is listed once, and its requirements cite each of its chapters.
    #[test]
    fn areas_are_those_of_the_catalogue() {
        for one in requirements() {
            let here = AREAS.iter().filter(|area| area.area == one.area);
            assert_eq!(here.count(), 1, "{}", one.area);
        }
        for Area { area, chapters, .. } in AREAS {
            let (manual, chapters) = chapters.split_once(' ').unwrap();
            for chapter in chapters.split(", ") {
                let cites = |source: &ads_cnc_vectors::Source| {
                    source.document.starts_with(manual)
                        && (source.section == chapter
                            || source.section.starts_with(&format!("{chapter}.")))
                };
                let mut of_area = requirements().iter().filter(|one| one.area == *area);
                assert!(of_area.any(|one| one.sources.iter().any(cites)), "{area}: {chapter}");
            }
        }
    }
}
