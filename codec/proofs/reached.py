"""Holds the no-panic proof against the public API: every function has to stand in it by its path,
and every reading among those that are read and written. What is new is missed until it is added."""

import pathlib
import re
import sys

HERE = pathlib.Path(__file__).resolve().parent
API = HERE.parent / "api" / "none.txt"
HEAD = re.compile(r"(?:non_exhaustive )?(?:struct|enum|trait) ([\w:]*\w)")
FUNCTION = re.compile(r"(?:const )?fn (\w+)")
# By path, with the reason why the proof cannot have it.
EXEMPT = {}


def public(text):
    """The paths of functions, and the names of what is decoded from bytes."""
    functions, readings, path = [], [], ""
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
    return functions, readings


def missing(functions, readings, proof):
    lost = [path for path in functions if not re.search(rf"(?<![\w:]){path}\b", proof)]
    lost += [name for name in readings if not re.search(rf"\bboth::<{name}\b", proof)]
    return lost


def main():
    functions, readings = public(API.read_text(encoding="utf-8"))
    sources = sorted((HERE / "no_std" / "src").rglob("*.rs"))
    lines = "\n".join(source.read_text(encoding="utf-8") for source in sources).splitlines()
    proof = "\n".join(line for line in lines if not line.strip().startswith("//"))
    faults = [path for path in missing(functions, readings, proof) if path not in EXEMPT]
    faults += [f"exempt, but not public: {path}" for path in EXEMPT if path not in functions]
    # Without each of these lines the proof has to be found wanting.
    for gone in ("text::cp1252_to_char", "streaming::Packets::rest", "both::<ContentRef"):
        if not missing(functions, readings, proof.replace(gone, "")):
            faults.append(f"negative control: {gone} is not missed")
    if len(functions) < 300 or len(readings) < 35:
        faults.append(f"the list has {len(functions)} functions and {len(readings)} readings?")
    print(f"no-panic proof: {len(functions)} public functions, {len(readings)} readings")
    return faults


if __name__ == "__main__":
    faults = main()
    for fault in faults:
        print(f"not in the proof: {fault}")
    sys.exit(bool(faults))
