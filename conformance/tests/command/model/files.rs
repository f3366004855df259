//! Data models in files: the default model that `serve` prints is valid, and invalid models are rejected.

use std::time::{Duration, Instant};

use ads_cnc_conformance::simulator::{DEFAULT_MODEL, Model};

use super::{CHANNEL_1, Cnc};
use crate::common::file::TestFile;
use crate::common::run_tool;

fn serve(options: &[&str]) -> (Option<i32>, String, String) {
    run_tool(&[&["serve"], options].concat())
}

/// An error in the encoding of a file has a line number, like an error in its content.
#[test]
fn a_file_in_another_encoding_has_a_line() {
    let file = TestFile::new(".toml", b"# a comment\nname = \"L\xE4nge\"\n");
    let (code, _, why) = serve(&["--model", file.path()]);
    assert_eq!(code, Some(2), "{why}");
    assert!(why.ends_with(".toml:2: the file must be UTF-8; byte 0xE4 is not\n"), "{why}");
}

#[test]
fn the_printed_model_is_the_default_model() {
    let (code, printed, errors) = serve(&["--print-model"]);
    assert_eq!((code, errors.as_str()), (Some(0), ""));
    let model = Model::from_toml(&printed, "printed").unwrap();
    assert_eq!(model, Model::default_model().unwrap());
    // The printed model contains the comments of the default model.
    assert!(printed.lines().filter(|line| line.starts_with('#')).count() > 50);
    // Without its comments, the printed model is also valid.
    let bare = printed.lines().filter(|line| !line.trim_start().starts_with('#'));
    let bare: Vec<&str> = bare.collect();
    assert_eq!(Model::from_toml(&bare.join("\n"), "bare"), Ok(model));
    // The simulated CNC with this model replies.
    let file = TestFile::new(".toml", printed.as_bytes());
    let cnc = Cnc::start(&["--model", file.path()]);
    assert_eq!(cnc.sda().ask(CHANNEL_1, 0x44, b"V.E\0"), Ok(vec![123, 0, 0, 0]));
}

/// A CNC whose model has only a channel has no variables except those of the Service Interface, and
/// no objects, elements or axes.
#[test]
fn a_minimal_model_is_valid() {
    let file = TestFile::new(".toml", b"[[channel]]\nnumber = 3\n");
    let cnc = Cnc::start(&["--model", file.path()]);
    assert_eq!(cnc.sda().ask(0x12_2303, 0x44, b"V.E\0"), Ok(vec![0; 4]));
    assert_eq!(cnc.sda().ask(0x02_2301, 0x44, b"V.G\0"), Ok(vec![5, 0, 0, 0]));
    assert_eq!(cnc.com().read(0x13_0103, 0, 4), Ok(vec![0; 4]));
    assert_eq!(cnc.sda().read(0x12_3303, 0, 4), Ok(vec![0; 4]));
    assert_eq!(cnc.sda().ask(0x12_3900, 0, &[0, 0, 0, 0, 1, 0, 0, 0]), Ok(vec![0; 8]));
}

#[test]
fn invalid_models_are_usage_errors() {
    let file =
        TestFile::new(".toml", b"[[channel]]\nnumber = 1\nvariables = [\n  { name = \"x\" },\n]\n");
    let (code, out, errors) = serve(&["--model", file.path()]);
    assert_eq!((code, out.as_str()), (Some(2), ""));
    let place = format!("{}:4: ", file.path());
    assert!(errors.contains(&place) && errors.contains("type"), "{errors}");
    let (code, _, errors) = serve(&["--model", "no such file"]);
    assert_eq!(code, Some(2));
    assert!(errors.contains("no such file: "), "{errors}");
}

/// The default handles of axis variables end before the bits of the place and the channel.
#[test]
fn the_257th_axis_variable_needs_a_handle() {
    let row = |number| format!("{{ name = \"V.A.x{number}\", type = \"UNS08\" }},\n");
    let rows: String = (1..=257).map(row).collect();
    let model = format!("[[channel]]\nnumber = 1\n[channel-axis]\nvariables = [\n{rows}]\n");
    let error = Model::from_toml(&model, "m").unwrap_err().to_string();
    assert!(error.starts_with("m:261: only the first 256 axis variables"), "{error}");
}

/// Large values of many owners, many initial values, and the handles of axis variables at many places are
/// rejected before they are allocated.
#[test]
fn the_memory_of_a_model_is_limited() {
    let axes: String = (0..255).map(|axis| format!("[[axis]]\nname = \"A{axis}\"\n")).collect();
    let channel = "[[channel]]\nnumber = 1\n";
    let rows = |count, row: &dyn Fn(u32) -> String| -> String {
        (0..count).map(|number| format!("{{ {} }},\n", row(number))).collect()
    };
    let large = |number| format!("name = \"e{number}\", type = \"STRING\", size = 65528");
    let of_axes = format!("elements = [\n{}]\n", rows(4, &large));
    let of_axes = axes + channel + "[class.interpolator.axis]\nname = \"{}\"\n" + &of_axes;
    let values = format!("{}, offset = 1, values = [{}]", large(0), "\"\", ".repeat(1100));
    let values =
        format!("{channel}[platform-axis]\nobjects = [\n{}]\n", rows(1, &|_| values.clone()));
    let variable = |number| format!("name = \"V.A.x{number}\", type = \"BOOLEAN\"");
    let variables = format!("[channel-axis]\nvariables = [\n{}]\n", rows(20, &variable));
    let places = "0, ".repeat(255);
    let handles: String = (1..=255)
        .map(|number| format!("[[channel]]\nnumber = {number}\nplaces = [{places}]\n"))
        .collect::<String>()
        + &variables;
    for (model, line) in [(of_axes, 519), (values, 5), (handles, 783)] {
        let error = Model::from_toml(&model, "m").map(drop).unwrap_err();
        assert_eq!(error.line(), Some(line), "{error}");
        assert!(error.reason().ends_with(" of memory; the maximum is 67108864"), "{error}");
    }
}

/// The objects that parameters need are found in a time that is not proportional to the product of the
/// numbers of parameters and objects.
#[test]
fn many_parameters_need_one_of_many_objects() {
    let object =
        |number| format!("{{ name = \"o{number}\", type = \"BOOL\", offset = {number} }},\n");
    let parameter = |number| format!("{{ name = \"P{number}\", while = \"o20000\" }},\n");
    let objects: String = (1..=20_000).map(object).collect();
    let parameters: String = (1..=10_000).map(parameter).collect();
    let model =
        format!("[[channel]]\nnumber = 1\nobjects = [{objects}]\nparameters = [{parameters}]\n");
    let begun = Instant::now();
    let error = Model::from_toml(&model, "m").unwrap_err();
    assert_eq!(error.reason(), "20000 objects in a list; the maximum is 780");
    assert!(begun.elapsed() < Duration::from_secs(20), "{:?}", begun.elapsed());
    let more = model.replace("parameters = [", "parameters = [\n{ name = \"P0\" },\n");
    let error = Model::from_toml(&more, "m").unwrap_err();
    assert_eq!(error.reason(), "10001 parameters of a channel; the maximum is 10000");
}

/// A handle belongs to its channel, so two channels may have the same handle.
#[test]
fn channels_may_have_equal_handles() {
    let channel = |number: u8| {
        let row = format!("name = \"V.E.x\", type = \"UNS08\", handle = 5, value = {number}");
        format!("[[channel]]\nnumber = {number}\nvariables = [{{ {row} }}]\n")
    };
    let file = TestFile::new(".toml", (channel(1) + &channel(2)).as_bytes());
    let cnc = Cnc::start(&["--model", file.path()]);
    let read = |group| cnc.sda().ask(group, 0x47, &[5, 0, 0, 0, 0, 0, 0, 0]);
    assert_eq!((read(0x12_2301), read(0x12_2302)), (Ok(vec![1]), Ok(vec![2])));
}

/// Each change makes the default model invalid; the error contains the reason and the line.
#[test]
fn each_error_has_its_line() {
    let mut wrong = Vec::new();
    for (from, to, reason) in FAULTS {
        assert_eq!(DEFAULT_MODEL.matches(from).count(), 1, "{from}");
        let model = DEFAULT_MODEL.replace(from, to);
        let at = DEFAULT_MODEL.find(from).unwrap();
        let line = DEFAULT_MODEL[..at].matches('\n').count() + 1;
        match Model::from_toml(&model, "m") {
            Ok(_) => wrong.push(format!("{to}: taken")),
            Err(error) => {
                let said = error.to_string();
                if !said.starts_with(&format!("m:{line}: ")) || !error.reason().contains(reason) {
                    wrong.push(format!("{to}: at {line}: {reason}\n  said: {said}"));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

const FAULTS: &[(&str, &str, &str)] = &[
    // Invalid TOML, unknown keys, and values of a wrong type.
    ("spindles = 2", "spindles = ", "expected a value"),
    ("spindles = 2", "spindels = 2", "the key spindels is unknown"),
    ("spindles = 2", "spindles = -2", "found the number -2"),
    ("spindles = 2", "spindles = \"2\"", "found the text"),
    ("spindles = 2", "spindles = 256", "at most 255 spindles"),
    ("offset = 0x251, value", "offset = 0x251, vlaue", "the key vlaue is unknown"),
    ("[class.hld.axis]", "[class.hdl.axis]", "the key hdl is unknown"),
    // Settings.
    ("edition = \"en-1.05\"", "edition = \"fr-1.05\"", "editions: en-1.05 and de-1.051"),
    ("cnc-version = \"V4.29.0\"", "cnc-version = \"V4\"", "cnc-version: minor"),
    // Axes.
    ("name = \"Y\"", "name = \"Y.1\"", "without . [ ]"),
    ("name = \"Y\"", "name = \"\"", "expected a name of an axis"),
    ("name = \"Y\"", "name = \"\u{3A9}\"", "not in CP1252"),
    (
        "name = \"Y\"",
        "name = \"YYYYYYYYYYYYYYYYYYYYYYYYYYYYYYYYYYYYYYYYYYYYYYYYYYYYYYYYYYYYYYYY\"",
        "at most 63 bytes",
    ),
    ("name = \"Y\"", "number = 0\nname = \"Y\"", "greater than 0"),
    ("name = \"Y\"", "number = 1 # again\nname = \"Y\"", "two axes have the logical number 1"),
    // Channels and their places.
    ("number = 1\n", "number = 0\n", "1 to 255"),
    ("number = 1\n", "number = 256\n", "1 to 255"),
    ("number = 6", "number = 2 # again", "channel 2 is configured twice"),
    ("places = [1, 2, 3]", "places = [1, 2, 7]", "no axis has the logical number 7"),
    ("places = [1, 2, 3]", "places = [1, 2, 1]", "already has another place"),
    ("places = [5, 0, 0]", "places = [4, 0, 0] # too", "already has another place"),
    ("places = [4, 0, 0]", "places = [4, 5, 0]", "two axes of a channel are named X"),
    // Objects.
    ("\"example_byte_r\"", "\"example_name_of_33_characters____r\"", "name"),
    ("type = \"BYTE\"", "type = \"UNS08\"", "types: BOOL SINT BYTE"),
    ("0x11, value = 0xB5", "0x11, value = 0x100", "expected a number from 0 to 255, found 256"),
    ("0x11, value = 0xB5", "0x11, value = 1.5", "a float is not a value"),
    ("0x11, value = 0xB5", "0x11, value = [1]", "not a value"),
    ("0x11, value = 0xB5", "0x10, value = 1", "two objects have the offset 0x10"),
    ("0x11, value = 0xB5", "0x251, value = 1", "an object of the platform has the offset 0x251"),
    ("0x11, value = 0xB5", "0x10011, value = 1", "belong to axes"),
    ("0x11, value = 0xB5", "0x11, size = 1", "size is only for a STRING"),
    ("0x11, value = 0xB5", "0x11, values = [1]", "several instances"),
    ("0x11, value = 0xB5", "0x11, is = \"axis-number\"", "only for objects and elements of axes"),
    ("id = 83", "id = 82, value = 0", "two objects have the ID 82"),
    (
        "size = 128, writable = true },\n  { name = \"example_L",
        "size = 0 },\n  { name = \"example_L",
        "includes a NUL",
    ),
    (
        "size = 128, writable = true },\n  { name = \"example_L",
        "size = 65536 },\n  { name = \"example_L",
        "the maximum is 65528",
    ),
    ("value = \"L\u{e4}nge 5\u{20ac}\"", "value = \"twenty-one characters\"", "are more than 21"),
    ("value = \"L\u{e4}nge 5\u{20ac}\"", "value = \"\u{3A9}\"", "not in CP1252"),
    ("offset = 3, is = \"axis-number\"", "offset = 3, is = \"axis\"", "axis-number"),
    (
        "offset = 3, is = \"axis-number\"",
        "offset = 3, writable = true, is = \"axis-number\" ",
        "not on the platform",
    ),
    (
        "type = \"WORD\", offset = 3, writable",
        "type = \"BYTE\", offset = 3, writable",
        "at least two bytes",
    ),
    (
        "type = \"WORD\", offset = 3, writable",
        "type = \"WORD\", offset = 3, id = 1, writable",
        "its own ID",
    ),
    // Variables.
    ("\"V.E.test\"", "\"V.E.vartest\"", "V.E.vartest is configured twice"),
    ("\"V.E.array_sgn32\"", "\"V.E.Testvar\"", "V.E.Testvar is configured twice"),
    ("\"V.E.vartest\"", "\"V.X.vartest\"", "V.E, V.G or V.CYC"),
    ("\"V.E.vartest\"", "\"V.E.vartest[1]\"", "not of an element"),
    ("\"V.E.vartest\"", "\"V.E.var..test\"", "unexpected '.'"),
    ("\"V.E.vartest\"", "\"V.A.vartest\"", "belong to axes"),
    (
        "\"V.E.channel\", type = \"UNS32\", value = 1",
        "\"V.E.channel\", type = \"DWORD\", value = 1",
        "types: BOOLEAN",
    ),
    ("handle = 0x2000004", "handle = 0x2000002", "has the same handle 0x2000002 as another"),
    ("name = \"V.CYC.count\"", "handle = 5, name = \"V.CYC.count\"", "by name only"),
    ("dimensions = [2, 3, 4]", "dimensions = [2, 0, 4]", "a dimension is 0"),
    (
        "dimensions = [2, 3, 4]",
        "dimensions = [4294967295, 4294967295, 4294967295]",
        "too many elements",
    ),
    (
        "value = [[11, 12, 13], [21, 22, 23]]",
        "value = [11, 12, 13, 21, 22]",
        "expected 6 values, found 5",
    ),
    ("dimensions = [512]", "dimensions = [513]", "the maximum is 2048"),
    (
        "\"UNS32\", synchronisation = \"NO_SYNC\"",
        "\"UNS32\", synchronisation = \"SYNC\"",
        "NO_SYNC or SYNCHRONIZED",
    ),
    ("validity = \"CHANNEL\"", "validity = \"LOCAL\"", "CHANNEL or GLOBAL"),
    (
        "\"V.CYC.count\", type = \"UNS32\"",
        "\"V.CYC.count\", type = \"UNS32\", validity = \"GLOBAL\"",
        "only V.E",
    ),
    ("\"V.G.NP[1].V\"", "\"V.G.SERVICE.UUID\"", "are built in"),
    ("handle = 0x0100001B", "handle = 0x0101001B", "bits 8 to 23"),
    ("\"V.A.WCS\"", "\"V.E.WCS\"", "expected a V.A variable"),
    // Parameters.
    ("\"P1\", value = 4711", "\"X1\", value = 4711", "begins with P, V.L., V.P. or V.S."),
    ("\"P1\", value = 4711", "\"P\", value = 4711", "begins with P, V.L., V.P. or V.S."),
    ("name = \"V.P.offset\"", "name = \"V.P.count\"", "configured twice"),
    ("while = \"example_subroutine_w\"", "while = \"nobody\"", "no own object \"nobody\""),
    ("while = \"example_subroutine_w\"", "while = \"mc_program_stream_w\"", "is a STRING"),
    ("value = 4711 },\n  # While", "comes = \"2\" },\n  # While", "a number with the unit"),
    ("value = 4711 },\n  # While", "goes = 2 },\n  # While", "expected a text"),
    ("value = 4711 },\n  # While", "goes = \"0s\" },\n  # While", "goes must be later than comes"),
    ("value = 4711 },\n  # While", "goes = \"25000min\" },\n  # While", "the maximum is 24 hours"),
    ("value = 4711 },\n  # While", "period = \"2s\" },\n  # While", "the whole period"),
    (
        "value = 4711 },\n  # While",
        "comes = \"1s\", goes = \"3s\", period = \"2s\" },\n  # While",
        "within the period",
    ),
    // Streaming.
    ("pace = \"1000 lines/s\"", "pace = 0", "lines per second from 1"),
    ("pace = \"1000 lines/s\"", "pace = \"1000 blocks/s\"", "lines per second from 1"),
    ("pace = \"1000 lines/s\"", "pace = 1.5", "lines per second from 1"),
    ("pace = \"1000 lines/s\"", "start = \"now\"", "again, once or by-hand"),
    ("pace = \"1000 lines/s\"", "speed = 1000", "the key speed is unknown"),
    // Elements.
    (
        "\"feedhold.enable\", type = \"BOOLEAN\"",
        "\"feedhold.enable\", type = \"BOOL\"",
        "types: BOOLEAN",
    ),
    ("unit = \"1/min\", writable", "unit = \"1/min\u{3A9}\", writable", "not in CP1252"),
];
