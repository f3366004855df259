//! Every data file conforms to its schema, and the schemas reject malformed files.

use jsonschema::Validator;
use serde_json::{Value, json};
use std::fs;
use std::path::{Path, PathBuf};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn json_file(path: &Path) -> Value {
    let text = fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    serde_json::from_str(&text).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

fn schema_file(name: &str) -> PathBuf {
    root().join("schema").join(format!("{name}.schema.json"))
}

fn schema(name: &str) -> Validator {
    let schema = json_file(&schema_file(name));
    jsonschema::draft202012::meta::validate(&schema).unwrap_or_else(|e| panic!("{name}: {e}"));
    jsonschema::validator_for(&schema).unwrap_or_else(|e| panic!("{name}: {e}"))
}

fn files_of(folder: &str) -> Vec<PathBuf> {
    let folder = root().join("data").join(folder);
    let mut files: Vec<_> = fs::read_dir(folder)
        .expect("a folder of data")
        .map(|entry| entry.expect("an entry").path())
        .collect();
    files.sort();
    files
}

fn assert_valid(name: &str, validator: &Validator, path: &Path) {
    let document = json_file(path);
    let errors: Vec<_> = validator
        .iter_errors(&document)
        .map(|error| format!("{} at {}", error, error.instance_path()))
        .collect();
    assert!(errors.is_empty(), "{}: {errors:#?}", path.display());
    // The path in `$schema` is that of this schema.
    let named = document["$schema"].as_str().expect("a schema");
    let named = path.parent().expect("a folder").join(named);
    let schema = [named.canonicalize().ok(), schema_file(name).canonicalize().ok()];
    assert!(schema[0].is_some() && schema[0] == schema[1], "{}: {schema:?}", path.display());
}

#[test]
fn requirements_conform() {
    assert_valid("requirements", &schema("requirements"), &root().join("data/requirements.json"));
}

#[test]
fn errata_conform() {
    assert_valid("errata", &schema("errata"), &root().join("data/errata.json"));
}

#[test]
fn vectors_conform() {
    let validator = schema("vectors");
    let files = files_of("vectors");
    assert!(!files.is_empty());
    for file in files {
        assert_valid("vectors", &validator, &file);
    }
}

#[test]
fn sequences_conform() {
    let validator = schema("sequences");
    let files = files_of("sequences");
    assert!(!files.is_empty());
    for file in files {
        assert_valid("sequences", &validator, &file);
    }
}

/// Each change makes a valid document invalid, so a schema that accepts everything fails this test.
#[test]
fn invalid_documents_are_rejected() {
    type Change = fn(&mut Value);
    type Changes = &'static [(&'static str, Change)];
    let cases: [(&str, &str, Changes); 6] = [
        (
            "requirements",
            "data/requirements.json",
            &[
                ("unknown field", |d| d["requirements"][0]["note"] = json!("x")),
                ("ID", |d| d["requirements"][0]["id"] = json!("GEN-01")),
                ("level", |d| d["requirements"][0]["level"] = json!("shall")),
                ("nothing observable", |d| {
                    d["requirements"][0]["observable"] = json!([]);
                }),
            ],
        ),
        (
            "errata",
            "data/errata.json",
            &[
                ("no readings", |d| d["errata"][0]["readings"] = json!([])),
                ("status", |d| d["errata"][0]["status"] = json!("fixed")),
                ("open without a question", |d| {
                    d["errata"][1]["status"] = json!("open");
                }),
                ("question of a ruled erratum", |d| {
                    d["errata"][1]["question"] = json!("x?");
                }),
            ],
        ),
        (
            "vectors",
            "data/vectors/variable-description.json",
            &[
                ("upper-case hex", |d| {
                    d["vectors"][0]["segments"][0]["hex"] = json!("56 2E 45 00");
                }),
                ("hex without spaces", |d| {
                    d["vectors"][0]["segments"][0]["hex"] = json!("562e4500");
                }),
                ("positional ID", |d| d["vectors"][0]["id"] = json!("Case #1")),
                ("ID without a letter", |d| d["vectors"][0]["id"] = json!("12-34")),
                ("rejected without a sibling", |d| {
                    let mut all = d["vectors"].as_array_mut().expect("vectors").iter_mut();
                    let rejected = all.find(|one| one["sibling"].is_string());
                    let rejected = rejected.and_then(|one| one.as_object_mut());
                    rejected.expect("a rejected vector").remove("sibling");
                }),
                ("unknown stream", |d| d["vectors"][0]["stream"] = json!("x")),
                ("no segments", |d| d["vectors"][0]["segments"] = json!([])),
                ("accepted and rejected", |d| {
                    d["vectors"][0]["expect"]["reject"] =
                        json!({"class": "truncated", "offset": 0, "field": "kind"});
                }),
                ("sibling of an accepted one", |d| {
                    d["vectors"][0]["sibling"] = json!("kind-empty");
                }),
                ("number as a number", |d| {
                    d["vectors"][0]["segments"][0]["value"] = json!({"type": "UNS32", "value": 1});
                }),
                ("tail and open at once", |d| {
                    d["vectors"][0]["segments"][0]["value"]["tail"] = json!("00");
                    d["vectors"][0]["segments"][0]["value"]["open"] = json!(true);
                }),
            ],
        ),
        (
            "sequences",
            "data/sequences/nc-text.json",
            &[
                ("unknown field", |d| d["cases"][0]["kind"] = json!("nc-text")),
                ("ID without a letter", |d| d["cases"][0]["id"] = json!("12-34")),
                ("no packets", |d| d["cases"][0]["expect"]["accept"] = json!({})),
                ("sibling of an accepted one", |d| {
                    d["cases"][0]["sibling"] = json!("text-lf");
                }),
                ("text that is not ASCII", |d| d["cases"][0]["given"]["nc-text"] = json!(["ä"])),
                ("empty piece", |d| d["cases"][0]["given"]["nc-text"] = json!([""])),
                ("two kinds at once", |d| d["cases"][0]["given"]["nc-check"] = json!([["X"]])),
            ],
        ),
        (
            "sequences",
            "data/sequences/streaming.json",
            &[
                ("start with bytes", |d| {
                    d["cases"][0]["given"]["streaming"]["steps"][0]["bytes"] = json!(["X"]);
                }),
                ("write without an answer", |d| {
                    let write = &mut d["cases"][0]["given"]["streaming"]["steps"][1];
                    write.as_object_mut().expect("a step").remove("ack");
                }),
                ("step by its number", |d| {
                    d["cases"][0]["given"]["streaming"]["steps"][0]["id"] = json!(1);
                }),
            ],
        ),
        (
            "sequences",
            "data/sequences/service.json",
            &[
                ("no actor", |d| {
                    let step = &mut d["cases"][0]["given"]["service"]["steps"][0];
                    step.as_object_mut().expect("a step").remove("actor");
                }),
                ("program that serves", |d| {
                    d["cases"][0]["given"]["service"]["steps"][0]["action"] = json!("serve");
                }),
                ("unknown variable", |d| {
                    d["cases"][0]["given"]["service"]["steps"][1]["variable"] = json!("V.G.X");
                }),
                ("unknown field of a step", |d| {
                    d["cases"][0]["given"]["service"]["steps"][1]["note"] = json!("x");
                }),
                ("text with a number", |d| {
                    d["cases"][0]["given"]["service"]["steps"][1]["value"] = json!("1");
                }),
            ],
        ),
    ];
    for (name, file, changes) in cases {
        let validator = schema(name);
        let good = json_file(&root().join(file));
        assert!(validator.is_valid(&good), "{file}");
        for (what, change) in changes {
            let mut bad = good.clone();
            change(&mut bad);
            assert_ne!(bad, good, "{file}: {what} changes nothing");
            assert!(!validator.is_valid(&bad), "{file}: {what} was accepted");
        }
    }
}
