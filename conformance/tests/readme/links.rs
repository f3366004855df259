//! Links between the documents lead to existing files and anchors.

use super::documents::texts;
use super::root;

#[test]
fn links_have_targets() {
    let (mut seen, texts) = (0, texts());
    for (path, text) in &texts {
        let folder = path.rsplit_once('/').map_or("", |(folder, _)| folder);
        for link in text.split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
            // rustdoc itself checks links to items.
            let is_item = link.starts_with("crate::");
            if is_item || link.contains("://") || link.contains(char::is_whitespace) {
                continue;
            }
            let (file, anchor) = link.split_once('#').unwrap_or((link, ""));
            let target =
                if file.is_empty() { root().join(path) } else { root().join(folder).join(file) };
            assert!(target.exists(), "{path}: {link}");
            if !anchor.is_empty() {
                let text = std::fs::read_to_string(&target).unwrap();
                let headings = text.lines().filter(|line| line.starts_with('#'));
                assert!(headings.map(slug).any(|slug| slug == anchor), "{path}: {link}");
            }
            seen += 1;
        }
    }
    assert!(seen > 40, "{seen} links");
}

/// The anchor of a heading, as Git hosts create it.
fn slug(heading: &str) -> String {
    let heading = heading.trim_start_matches('#').trim().to_lowercase();
    let kept = heading.chars().filter(|one| one.is_alphanumeric() || " -_".contains(*one));
    kept.map(|one| if one == ' ' { '-' } else { one }).collect()
}
