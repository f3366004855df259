"""Compares the code of the no-panic proof (tests/everything) with the public API without features. The code must
contain the path of every function, `both::<…>` for every type that implements Decode, and `show::<…>` for every type
that implements Display, except those in EXEMPT."""

import pathlib
import re
import sys

HERE = pathlib.Path(__file__).resolve().parent
API = HERE.parent / "api" / "none.txt"
STREAMS = HERE.parent / "src" / "streams.rs"
HEAD = re.compile(r"(?:non_exhaustive )?(?:struct|enum|trait) ([\w:]*\w)")
FUNCTION = re.compile(r"(?:const )?fn (\w+)")
# The items that the proof does not contain, each with the reason.
FLOAT = "the formatting of floating-point numbers in core contains a panic"
EXEMPT = {"Element, shown": FLOAT, "dynamic::DynamicValue, shown": FLOAT}


def public(text):
    """Returns the paths of the functions, the names of the types that implement Decode, and the paths of the types
    that implement Display."""
    functions, readings, shown, path = [], [], [], ""
    for line in text.splitlines():
        if line.startswith("fn "):
            functions.append(re.match(r"fn ([\w:]+)", line)[1])
        elif not line.startswith(" "):
            head = HEAD.match(line)
            path = head[1] if head else ""
        elif found := FUNCTION.match(line.strip()):
            functions.append(f"{path}::{found[1]}")
        elif re.match(r" +impl .*\bDecode<", line):
            readings.append(path.split("::")[-1])
        if re.match(r" +impl .*\bDisplay\b", line):
            shown.append(path)
    return functions, readings, shown


def missing(functions, readings, shown, proof):
    lost = [path for path in functions if not re.search(rf"(?<![\w:]){path}\b", proof)]
    lost += [name for name in readings if not re.search(rf"\bboth::<{name}\b", proof)]
    lost += [f"{path}, shown" for path in shown if not re.search(rf"\bshow::<{path}\b", proof)]
    return lost


def main():
    functions, readings, shown = api = public(API.read_text(encoding="utf-8"))
    sources = sorted((HERE.parent / "tests" / "everything").rglob("*.rs"))
    lines = "\n".join(source.read_text(encoding="utf-8") for source in sources).splitlines()
    proof = "\n".join(line for line in lines if not line.strip().startswith("//"))
    # For each stream, the first type that streams! passes to its macro.
    views = re.findall(r"^ +\w+: \$crate::(?:\w+::)*(\w+)", STREAMS.read_text(encoding="utf-8"), re.M)
    proof = proof.replace("both::<$view>", " ".join(f"both::<{view}>" for view in views))
    faults = [f"not in the proof: {path}" for path in missing(*api, proof) if path not in EXEMPT]
    public_paths = [*functions, *(f"{path}, shown" for path in shown)]
    faults += [f"exempt, but not public: {path}" for path in EXEMPT if path not in public_paths]
    # Negative controls: if one of these texts is removed from the code, the check must fail.
    for gone in ("text::cp1252_to_char", "streaming::Packets::rest", "both::<ContentRef", "show::<Error"):
        if not missing(*api, proof.replace(gone, "")):
            faults.append(f"negative control: the absence of {gone} is not reported")
    counts = f"{len(functions)} public functions, {len(readings)} readings, {len(shown)} texts"
    if len(functions) < 280 or len(readings) < 35 or len(shown) < 20:
        faults.append(f"the lists are incomplete: {counts}")
    print(f"no-panic proof: {counts}")
    return faults


if __name__ == "__main__":
    faults = main()
    for fault in faults:
        print(f"no-panic proof: {fault}")
    sys.exit(bool(faults))
