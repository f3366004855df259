//! What the README shows of the tools is what they print.

mod common;

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use common::Serve;

const README: &str = include_str!("../../README.md");

/// Calls that are not made here: they do not end, take long, need more than this project, or show
/// what differs from run to run. Other tests make them.
const ELSEWHERE: [&str; 7] = [
    "cargo ",
    "ads-cnc selftest",
    "ads-cnc run --client ",
    "ads-cnc run --testee ",
    "ads-cnc serve ",
    "ads-cnc stream part.nc",
    "ads-cnc service ",
];

/// A call and what it shows.
#[derive(Debug, Default)]
struct Shown {
    call: String,
    output: String,
}

fn shown() -> Vec<Shown> {
    let mut all: Vec<Shown> = Vec::new();
    for block in README.split("```console\n").skip(1) {
        let (block, _) = block.split_once("```").unwrap();
        let block = block.replace("\\\n", "");
        for line in block.lines() {
            match (line.strip_prefix("$ "), all.last_mut()) {
                (Some(call), _) => all.push(Shown { call: call.to_owned(), ..Shown::default() }),
                (None, Some(last)) => last.output.push_str(&format!("{line}\n")),
                (None, None) => panic!("{line}"),
            }
        }
    }
    all
}

/// The words of a call as a shell has them, without anything that only a shell does.
fn words(call: &str) -> Vec<String> {
    let (mut words, mut quote, mut open) = (vec![String::new()], None, false);
    for character in call.chars() {
        match (character, quote) {
            ('\'' | '"', None) => quote = Some(character),
            (end, Some(begun)) if end == begun => quote = None,
            (' ', None) => open = true,
            _ => {
                if std::mem::take(&mut open) {
                    words.push(String::new());
                }
                words.last_mut().unwrap().push(character);
            }
        }
    }
    words
}

/// A directory with the files that the README has or names, gone in the end.
struct Directory(PathBuf);

impl Directory {
    fn new(shown: &[Shown]) -> Self {
        let path = std::env::temp_dir().join(format!("ads-cnc-readme-{}", std::process::id()));
        fs::create_dir_all(&path).unwrap();
        let directory = Self(path);
        directory.write(
            "loop.nc",
            "N10 G0 X0\n; ten times\nN20 $FOR P1=0,10,1\nN30 X1\nN40 $ENDFOR\nN50 M30\nN60 X2\n",
        );
        for Shown { call, output } in shown {
            if let Some(name) = call.strip_prefix("cat ") {
                directory.write(name, output);
            }
            // What a refusal says is needed goes into the file that the next call has.
            if let Some((_, entry)) = output.split_once("--allow-write:\n\n") {
                let expires = "expires = 9999-12-31T23:59:59Z  #";
                directory.write("test.toml", &entry.replace("expires = …  #", expires));
            }
        }
        directory
    }

    fn write(&self, name: &str, text: &str) {
        fs::write(self.0.join(name), text).unwrap();
    }

    /// All that a call shows, in the order in which it comes.
    fn call(&self, words: &[String]) -> String {
        let path = self.0.join("output");
        let out = File::create(&path).unwrap();
        let mut call = Command::new(env!("CARGO_BIN_EXE_ads-cnc"));
        call.args(words).current_dir(&self.0).stdin(Stdio::null());
        call.stdout(out.try_clone().unwrap()).stderr(out).status().unwrap();
        read(&path)
    }
}

impl Drop for Directory {
    fn drop(&mut self) {
        let _gone = fs::remove_dir_all(&self.0);
    }
}

fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap()
}

#[test]
fn calls_show_what_the_readme_has() {
    let shown = shown();
    let directory = Directory::new(&shown);
    // It stands for the device.
    let device = Serve::start(&["--net-id", "192.0.2.10.1.1"]);
    let mut made = 0;
    for Shown { call, output } in &shown {
        let is_elsewhere = ELSEWHERE.iter().any(|start| call.starts_with(start));
        if is_elsewhere || output.is_empty() || call.starts_with("cat ") {
            continue;
        }
        let mut words = words(call);
        assert_eq!(words.remove(0), "ads-cnc");
        for word in words.iter_mut().filter(|word| *word == "192.0.2.10") {
            word.clone_from(&device.addr);
        }
        assert_eq!(directory.call(&words), *output, "{call}");
        made += 1;
    }
    assert!(made >= 6, "{made} calls");
}

/// Every tool is in it.
#[test]
fn every_tool_is_shown() {
    for tool in [
        "run",
        "check",
        "serve",
        "explain",
        "browse",
        "get",
        "set",
        "stream",
        "service",
        "completions",
        "requirements",
    ] {
        assert!(README.contains(&format!("ads-cnc {tool} ")), "{tool}");
    }
    for tool in ["serve", "explain", "browse", "get", "set", "stream", "service"] {
        let call = format!("ads-cnc {tool} ");
        let has_output = |one: &Shown| one.call.starts_with(&call) && !one.output.is_empty();
        assert!(shown().iter().any(has_output), "{tool}");
    }
}
