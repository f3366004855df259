//! Writes the IDs of the requirements as a constant, so that a program can check them when it is compiled,
//! and the lists of the files that the loader includes.

use std::path::Path;
use std::{env, fs, io};

fn main() -> io::Result<()> {
    let data = "data/requirements.json";
    println!("cargo::rerun-if-changed={data}");
    // An ID of a requirement, and not of one of its parts, has no dot.
    let text = fs::read_to_string(data)?;
    let ids = text.lines().filter_map(|line| {
        line.trim().strip_prefix("\"id\": \"")?.split('"').next().filter(|id| !id.contains('.'))
    });
    let ids: Vec<&str> = ids.collect();
    let out = env::var_os("OUT_DIR").ok_or_else(|| io::Error::other("cargo sets OUT_DIR"))?;
    let out = Path::new(&out);
    fs::write(out.join("requirement_ids.rs"), format!("&{ids:?}"))?;
    for kind in ["vectors", "sequences"] {
        fs::write(out.join(format!("{kind}.rs")), included(&format!("data/{kind}"))?)?;
    }
    Ok(())
}

/// The path and the text of each file of a folder, in the order of their names.
fn included(folder: &str) -> io::Result<String> {
    println!("cargo::rerun-if-changed={folder}");
    let files = fs::read_dir(folder)?.map(|file| Ok(file?.file_name()));
    let mut files = files.collect::<io::Result<Vec<_>>>()?;
    // An editor may leave other files there.
    files.retain(|file| Path::new(file).extension().is_some_and(|extension| extension == "json"));
    files.sort();
    let files = files.iter().map(|file| {
        let path = format!("{folder}/{}", file.to_string_lossy());
        format!("({path:?}, include_str!(concat!(env!(\"CARGO_MANIFEST_DIR\"), \"/\", {path:?})))")
    });
    Ok(format!("&[{}]", files.collect::<Vec<_>>().join(", ")))
}
