"""Selects the functions that a program contains from the lists of the public API, by parts of the API. Generic
functions are not selected: src/generic.rs keeps those that exist without features, with specific types."""

import pathlib
import re

HERE = pathlib.Path(__file__).resolve().parent
API = HERE.parent.parent / "api"
# A path belongs to the first part whose pattern matches its start; the last pattern matches all paths.
PARTS = {
    "text": r"(?:VariableAccess|VariableType|Synchronisation|Validity|WriteAccess|ads::\w+)::name",
    "tables": r"layout::|operation::(?:Function|FunctionSpec|GroupRule|OffsetRule)::",
    "operations": r"operation::|address::",
    "calls": r"(?!)",
    "frames": r"ads::FrameRef",
    "names": r"VariablePath|PathPart",
    "values": r"value::|Elements?\b|\w+::(?:elements?|shape|\w+_type|\w+_size)$",
    "streaming": r"streaming::(?!ProgramStream)",
    "service": r"service::",
    "views": r"",
}
# Traits, the part that their methods belong to (None: the part of the type), and the names of these methods.
TRAITS = [
    ("Decode", None, "decode"),
    ("Encode", None, "encode encoded_len"),
    ("operation::Operation", None,
     "index_group index_offset read_length encoded_len encode decode_reply"),
    # A real program contains these methods only for the operations that it calls. If it needs all operations, it uses
    # `Request::encode` instead.
    ("operation::Operation", "calls", "port service call"),
    ("value::EncodeValue", "values", "data_type element_count value_len encode_value"),
    ("Iterator", None, "next"),
    ("DoubleEndedIterator", None, "next_back"),
    ("FromStr", "text", "from_str"),
    ("Display", "text", "fmt"),
]  # fmt: skip
PATHS = {"FromStr": "core::str::FromStr", "Display": "core::fmt::Display"}


def part(path):
    return next(name for name, start in PARTS.items() if re.match(start, path))


def read(features):
    """Returns the part and the path of each function that is not generic, and the paths of the generic functions."""
    kept, generic, head, name = [], [], "", ""
    for line in (API / f"{features}.txt").read_text(encoding="utf-8").splitlines():
        if line.startswith("fn "):
            path = re.match(r"fn ([\w:]+)", line)[1]
            kept.append((part(path), f"ads_cnc::{path}"))
        if not line.startswith(" "):
            head = line
            name = re.sub(r"^(?:in )?(?:non_exhaustive )?\w+ ([\w:]*).*", r"\1", line)
        elif re.match(r"(?:in )?trait |use |mod |foreign ", head):
            continue
        elif found := re.match(r" +(?:const )?fn (\w+)(.*)", line):
            path = f"{name}::{found[1]}"
            if "T: " in head or re.search(r"\bimpl |^<[^>]*\b[A-Z]", found[2]):
                generic.append(path)
            else:
                kept.append((part(path), f"ads_cnc::{path}"))
        elif line.startswith("    impl ") and "T: " not in head:
            ty = f"ads_cnc::{name}<'_>" if "<'" in head else f"ads_cnc::{name}"
            for trait, of, methods in TRAITS:
                if re.search(rf"[ ,]{trait}\b", line):
                    path = PATHS.get(trait, trait.split("::")[-1])
                    owned = " encode_to_vec" if trait == "Encode" and features == "alloc" else ""
                    for method in (methods + owned).split():
                        kept.append((of or part(name), f"<{ty} as {path}>::{method}"))
    return kept, generic


def source(parts, extra=(), owned=False):
    """Returns Rust code that keeps functions in a program: those of these parts, those of `extra` and, if `owned`,
    those that exist with the feature alloc. Also returns their number, without those of src/generic.rs."""
    paths = [path for of, path in read("none")[0] if of in parts] + list(extra)
    if owned:
        paths += [path for _, path in read("alloc")[0]]
    modules = re.findall(r"pub\(crate\) mod (\w+)", by_hand())
    kept = ["KEPT", *(f"generic::{name}::KEPT" for name in modules if name in parts)]
    lines = "".join(f"    {path},\n" for path in paths)
    keeps = "".join(f"    core::hint::black_box(&{name});\n" for name in kept)
    return f"crate::keep! {{\n{lines}}}\n\npub(super) fn keep_all() {{\n{keeps}}}\n", len(paths)


def by_hand():
    return (HERE / "src" / "generic.rs").read_text(encoding="utf-8")


def missing(gone="\0"):
    """Removes `gone` from the text of src/generic.rs. Returns the generic functions that are not in the rest, and
    the number of other functions."""
    kept, generic = read("none")
    text = re.sub(r"::<[^>]*>", "", by_hand()).replace(gone, "")
    lost = [path for path in generic if not re.search(rf"(?<![\w:]){path}\b", text)]
    return lost, len(kept)
