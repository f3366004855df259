//! Generates a constant for each ID of a requirement or a part, so that a program that cites an unknown ID
//! fails to compile. Also generates the lists of the data files that the crate embeds.

use std::path::Path;
use std::{env, fs, io};

fn main() -> io::Result<()> {
    let data = "data/requirements.json";
    println!("cargo::rerun-if-changed={data}");
    let ids = constants(&fs::read_to_string(data)?);
    let out = env::var_os("OUT_DIR").ok_or_else(|| io::Error::other("cargo sets OUT_DIR"))?;
    let out = Path::new(&out);
    fs::write(out.join("ids.rs"), ids)?;
    for kind in ["vectors", "sequences"] {
        fs::write(out.join(format!("{kind}.rs")), included(&format!("data/{kind}"))?)?;
    }
    Ok(())
}

/// The code of a constant for each ID, documented by the title of the requirement or the text of the
/// part, and of the constant `EVERY`.
fn constants(requirements: &str) -> String {
    let (mut items, mut names) = (String::new(), Vec::new());
    for entry in requirements.split("\"id\": \"").skip(1) {
        let text_after = |key: &str| entry.split_once(key)?.1.split('"').next();
        let id = entry.split('"').next().unwrap_or_default();
        // The ID of a part has a dot.
        let doc = text_after(if id.contains('.') { "\"text\": \"" } else { "\"title\": \"" });
        // Escape brackets, which rustdoc would interpret as links.
        let doc = doc.unwrap_or_default().replace('[', r"\\[");
        let name = id.replace(['-', '.'], "_");
        let item = format!("pub const {name}: ClauseId = ClauseId::new(\"{id}\");");
        items.push_str(&format!("#[doc = \"{doc}\"]\n{item}\n"));
        names.push(name);
    }
    let names = names.join(", ");
    format!("{items}pub(crate) const EVERY: &[ClauseId] = &[{names}];\n")
}

/// The code of a list with the path and the text of each JSON file in a folder, sorted by name.
fn included(folder: &str) -> io::Result<String> {
    println!("cargo::rerun-if-changed={folder}");
    let files = fs::read_dir(folder)?.map(|file| Ok(file?.file_name()));
    let mut files = files.collect::<io::Result<Vec<_>>>()?;
    // Ignore other files in the folder, such as those of an editor.
    files.retain(|file| Path::new(file).extension().is_some_and(|extension| extension == "json"));
    files.sort();
    let files = files.iter().map(|file| {
        let path = format!("{folder}/{}", file.to_string_lossy());
        format!("({path:?}, include_str!(concat!(env!(\"CARGO_MANIFEST_DIR\"), \"/\", {path:?})))")
    });
    Ok(format!("&[{}]", files.collect::<Vec<_>>().join(", ")))
}
