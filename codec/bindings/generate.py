#!/usr/bin/env python3
"""Generates functions and types of the Python and npm packages from the tables of the C library.

    generate.py python OUTPUT      the module with the functions and records of the Python package
    generate.py javascript OUTPUT  the type declarations of the functions and records of the npm package
    generate.py exports OUTPUT     the functions of the npm package

The tables are read from the C library in the Python package, so this script lists no functions or fields.
"""

import pathlib
import re
import sys
import types

HERE = pathlib.Path(__file__).resolve().parent
package = types.ModuleType("ads_cnc")
# Registers the package without running its __init__.py, which imports the module that this script generates.
package.__path__ = [str(HERE / "python" / "src" / "ads_cnc")]
sys.modules["ads_cnc"] = package
from ads_cnc import _codec  # noqa: E402

KINDS = {
    "python": {1: "int", 2: "bool", 3: "float", 4: "str", 5: "str", 6: "bytes"},
    "javascript": {1: "number", 2: "boolean", 3: "number", 4: "string", 5: "string", 6: "Uint8Array"},
}
ARGUMENTS = {
    "python": {
        "kind": "str",
        "name": "str",
        "value": "bytes",
        "indices": "Sequence[int]",
        "by_index": "bool",
    },
    "javascript": {
        "kind": "string",
        "name": "string",
        "value": "Uint8Array",
        "indices": "ArrayLike<number>",
        "by_index": "boolean",
    },
}
MEANINGS = {
    "channel": "from 1; 0 is the platform, for functions that support it; for the object address of a spindle, the "
    "index of the spindle",
    "axis": "axis of the channel, from 1; for a list of objects with channel 0, a platform axis; for an object "
    "address, 0 is the channel itself",
    "index": "from 0 for variables, from 1 for parameters and objects",
    "count": "number of descriptors to read",
    "size": "maximum number of bytes to read",
    "handle": "handle of the variable",
    "index_group": "index group of the element or object",
    "index_offset": "index offset of the element or object",
    "kind": "kind or class, such as V.E, P or decoder",
    "name": "name of the variable or parameter",
    "value": "the bytes to write",
    "indices": "one for each dimension, from 0; empty for the whole variable",
    "by_index": "whether `channel` is the index among the active channels, from 1, not the logical number",
}
EFFECTS = ("changes nothing", "changes a value", "may move an axis")
COMMANDS = {2: "Read", 3: "Write", 9: "ReadWrite"}


def snake(name):
    return re.sub(r"(?<!^)([A-Z])", r"_\1", name).lower()


def camel(name):
    return re.sub(r"_(\w)", lambda found: found[1].upper(), name)


def record(name):
    """Returns the class name of a record. A stream of records uses the class of the stream with one record."""
    one = name[:-1] if _codec.STREAMS[name].repeats else name
    return "".join(word.capitalize() for word in (one if one in _codec.STREAMS else name).split("-"))


def rows(stream):
    return [row for row in stream.fields if not row.is_count]


def of_row(row, language):
    kind = KINDS[language][row.kind]
    if not row.is_list:
        return kind
    return f"list[{kind}]" if language == "python" else f"{kind}[]"


def is_optional(stream):
    try:
        return bool(stream.fields) and not _codec.fields(stream.name, b"")
    except _codec.AdsCncError:
        return False


def of_stream(name, language):
    """Returns the type of the value of a stream; `name` is None for a function whose reply has no data."""
    if name is None:
        return "None" if language == "python" else "undefined"
    stream = _codec.STREAMS[name]
    found = rows(stream)
    if stream.repeats:
        name = record(name)
        return f"list[{name}]" if language == "python" else f"{name}[]"
    kind = record(name) if len(found) > 1 else of_row(found[0], language)
    if is_optional(stream):
        return f"Optional[{kind}]" if language == "python" else f"{kind} | null"
    return kind


def parameters(function):
    """Returns the names of the required and of the optional parameters of a function."""
    optional = ["axis"] if function.reply in ("object-count", "object-descriptors") else []
    return list(function.arguments), optional + (["by_index"] if "channel" in function.arguments else [])


def about(function):
    return f"{COMMANDS[function.command]} to port {function.port}; {EFFECTS[function.effect]}"


def records():
    return [stream for stream in _codec.STREAMS.values() if len(rows(stream)) > 1]


def python():
    yield '"""The functions of the CNC and the records of its streams. Generated: see generate.py."""\n'
    yield "from __future__ import annotations\n"
    yield "from collections.abc import Sequence\nfrom dataclasses import dataclass"
    yield "from typing import Optional, cast\n"
    yield "from ._codec import RECORDS, Request, request\n"
    names = []
    for stream in records():
        if stream.repeats:
            yield f'RECORDS["{stream.name}"] = {record(stream.name)}\n'
            continue
        names.append(record(stream.name))
        yield f'\n@dataclass(frozen=True)\nclass {names[-1]}:\n    """{stream.title}."""\n'
        for row in rows(stream):
            yield f"    {row.name}: {of_row(row, 'python')}  # {row.meaning}"
        yield f'\n\nRECORDS["{stream.name}"] = {names[-1]}\n'
    for function in _codec.FUNCTIONS:
        names.append(name := snake(function.operation))
        kinds = {**dict.fromkeys(MEANINGS, "int"), **ARGUMENTS["python"]}
        needed, optional = parameters(function)
        given = [f"{one}: {kinds[one]}" for one in needed]
        defaults = [f"{one}: {kinds[one]} = {'False' if one == 'by_index' else 0}" for one in optional]
        given += ["*", *defaults] if defaults else []
        reply = f"Request[{of_stream(function.reply, 'python')}]"
        yield f"\ndef {name}({', '.join(given)}) -> {reply}:"
        yield f'    """{function.name[0].upper() + function.name[1:]}: {about(function)}.\n'
        yield "\n".join(f"    {one}: {MEANINGS[one]}" for one in needed + optional)
        passed = ", ".join(f"{one}={one}" for one in needed + optional)
        yield f'    """\n    return cast("{reply}", request({function.number}, {passed}))\n'
    yield "\n__all__ = [\n" + "".join(f'    "{name}",\n' for name in names) + "]"


def javascript():
    yield "// The functions of the CNC and the records of its streams. Generated: see generate.py."
    for stream in records():
        if stream.repeats:
            continue
        yield f"\n/** {stream.title}. */\nexport interface {record(stream.name)} {{"
        for row in rows(stream):
            yield f"  /** {row.meaning} */\n  {camel(row.name)}: {of_row(row, 'javascript')};"
        yield "}"
    for function in _codec.FUNCTIONS:
        kinds = {**dict.fromkeys(MEANINGS, "number"), **ARGUMENTS["javascript"]}
        needed, optional = parameters(function)
        given = [f"{camel(one)}: {kinds[one]}" for one in needed]
        more = "; ".join(f"{camel(one)}?: {kinds[one]}" for one in optional)
        given += [f"optional?: {{ {more} }}"] if more else []
        yield f"\n/**\n * {function.name[0].upper() + function.name[1:]}: {about(function)}.\n *"
        yield "\n".join(f" * @param {camel(one)} {MEANINGS[one]}" for one in needed)
        yield f" */\nexport function {camel(snake(function.operation))}({', '.join(given)}):"
        yield f"  Request<{of_stream(function.reply, 'javascript')}>;"


def exports():
    for function in _codec.FUNCTIONS:
        yield f"export const {camel(snake(function.operation))} = operation({function.number});"


if __name__ == "__main__":
    language, output = sys.argv[1:]
    write = {"python": python, "javascript": javascript, "exports": exports}[language]
    pathlib.Path(output).write_text("\n".join(write()) + "\n", encoding="utf-8")
