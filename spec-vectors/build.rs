//! Writes the IDs of the requirements as a constant, so that a program can check them when it is compiled.

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
    fs::write(Path::new(&out).join("requirement_ids.rs"), format!("&{ids:?}"))
}
