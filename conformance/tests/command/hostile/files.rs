//! Files of the user that are too long; a device such as /dev/zero never ends.

use std::fs::OpenOptions;

use super::run;
use crate::common::file::TestFile;

#[test]
fn a_file_that_is_too_long_is_not_read() {
    let file = TestFile::new(".toml", b"");
    let opened = OpenOptions::new().write(true).open(&file.0).unwrap();
    opened.set_len(16 * 1024 * 1024 + 1).unwrap();
    for args in [
        &["serve", "--model"][..],
        &["run", "--profile"],
        &["run", "--waivers"],
        &[
            "set",
            "V.E.x",
            "1",
            "--target",
            "127.0.0.1:1",
            "--net-id",
            "127.0.0.1.1.1",
            "--allow-write",
        ],
    ] {
        let ended = run(&[args, &[file.path()]].concat());
        assert_eq!(ended.code, Some(2), "{args:?}: {}", ended.stderr);
        let why = format!("{}: expected at most 16777216 bytes, found more", file.path());
        assert!(ended.stderr.contains(&why), "{args:?}: {}", ended.stderr);
    }
}
