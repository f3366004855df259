//! `clients write FOLDER` writes the bytes for clients in other languages; `clients time FOLDER`
//! measures the time of this crate for the same bytes.

use std::path::Path;
use std::{env, io};

use ads_cnc_benches::clients;

fn main() -> io::Result<()> {
    let arguments: Vec<String> = env::args().skip(1).collect();
    match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["write", folder] => clients::write(Path::new(folder)),
        ["time", folder] => clients::time(Path::new(folder)),
        _ => Err(io::Error::other("usage: clients write FOLDER | clients time FOLDER")),
    }
}
