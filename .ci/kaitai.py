"""Read golden vectors with the Python reader made by Kaitai Struct, and judge the fields that a reader found.

    .ci/kaitai.py read VECTORS.json …               prints the fields that the reader finds, by vector ID
    .ci/kaitai.py judge FOUND.json TABLES.json VECTORS.json …
                                                    compares these fields with each accepted vector
"""

import json
import re
import struct
import sys

# The tables, and therefore the description, do not list these streams.
WITHOUT_READER = {"ams-frame", "index-group", "index-offset", "variable-path"}
# Slightly fewer vectors than the readers accept and reject now, so that a check that omits many vectors fails. The
# readers accept other vectors that are to be rejected, because the description has no relations between values.
ACCEPTED_MIN = 530
REJECTED_MIN = 180


def vectors(files):
    for file in files:
        with open(file, encoding="utf-8") as text:
            yield from json.load(text)["vectors"]


def data(vector):
    return b"".join(bytes.fromhex(segment["hex"]) for segment in vector["segments"])


def camel(name):
    return "".join(word.capitalize() for word in re.split("[-_]", name))


def plain(value):
    if isinstance(value, (bytes, bytearray)):
        return {"hex": value.hex()}
    if isinstance(value, list):
        return [plain(one) for one in value]
    if value != value:
        # JSON has no NaN, so it is printed as its bytes.
        return plain(struct.pack("<d", value))
    if not hasattr(value, "__dict__"):
        return value
    return {name: plain(one) for name, one in vars(value).items() if not name.startswith("_")}


def read(files):
    from ads_cnc import AdsCnc
    from kaitaistruct import KaitaiStream

    import io

    found = {}
    for vector in vectors(files):
        stream = getattr(AdsCnc, camel(vector["stream"]), None)
        if stream is None:
            continue
        try:
            found[vector["id"]] = plain(stream(KaitaiStream(io.BytesIO(data(vector)))))
        except Exception as error:
            found[vector["id"]] = f"{type(error).__name__}: {error}"
    print(json.dumps(found))


def is_same(expected, value, is_text=False):
    """Returns whether `value`, which a reader found, is the value that the bytes `expected` encode."""
    if isinstance(value, dict):
        # The value that a reader finds for a text lacks the NUL and the bytes after it.
        return value["hex"] == expected.hex() or (is_text and value["hex"] == expected.split(b"\0")[0].hex())
    if isinstance(value, list):
        size = len(expected) // max(len(value), 1)
        items = [expected[size * index : size * (index + 1)] for index in range(len(value))]
        return b"".join(items) == expected and all(map(is_same, items, value))
    if len(expected) == 8:
        return value is not None and struct.pack("<d", value) == expected
    # A reader has no value for an absent field.
    return value == int.from_bytes(expected, "little") if expected else value is None


def fields(vector):
    """Returns the bytes of each field of a vector; the items of a list are joined."""
    found = {}
    for segment in vector["segments"]:
        record, name = re.fullmatch(r"(?:descriptors\[(\d+)\]\.)?(\w+)(?:\[\d+\])?", segment["field"]).groups()
        found[record, name] = found.get((record, name), b"") + bytes.fromhex(segment["hex"])
    return found


def in_javascript(name):
    first, *others = name.split("_")
    return first + "".join(word.capitalize() for word in others)


def judge(found, tables, files):
    with open(found, encoding="utf-8") as text:
        found = json.load(text)
    with open(tables, encoding="utf-8") as text:
        streams = json.load(text)["streams"]
    texts = {(one["name"], field["name"]) for one in streams for field in one["fields"] if field["type"] == "STRING"}
    accepted = rejected = compared = 0
    faults, without = [], set()
    for vector in vectors(files):
        read = found.get(vector["id"])
        if read is None:
            without.add(vector["stream"])
            continue
        if "accept" not in vector["expect"]:
            rejected += isinstance(read, str)
            continue
        accepted += 1
        if isinstance(read, str):
            faults.append(f"{vector['id']}: {read}")
            continue
        for (record, name), expected in fields(vector).items():
            values = read if record is None else read["records"][int(record)]
            value = values.get(name, values.get(in_javascript(name)))
            compared += 1
            if not is_same(expected, value, (vector["stream"], name) in texts):
                faults.append(f"{vector['id']}: {name}: {expected.hex()} was read as {value!r}")
    print(f"{accepted} accepted vectors, {compared} fields, {len(faults)} faults; {rejected} others rejected; "
          f"no reader for {', '.join(sorted(without))}")
    print(*faults, sep="\n", end="\n" if faults else "")
    if without != WITHOUT_READER:
        sys.exit(f"the streams without a reader must be {', '.join(sorted(WITHOUT_READER))}")
    if accepted < ACCEPTED_MIN or rejected < REJECTED_MIN:
        sys.exit(f"at least {ACCEPTED_MIN} accepted and {REJECTED_MIN} rejected vectors are needed")
    sys.exit(bool(faults))


if __name__ == "__main__":
    action, *arguments = sys.argv[1:]
    read(arguments) if action == "read" else judge(*arguments[:2], arguments[2:])
