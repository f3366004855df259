"""A typical client in Python: struct on the bytes of a reply. Prints nanoseconds per record."""

import struct
import sys
import time
from pathlib import Path
from statistics import median

TURNS = 15


def descriptors(data):
    if not data or len(data) % 84:
        raise ValueError("not a list of descriptors")
    objects = []
    for at in range(0, len(data), 84):
        number, size, access, _, group, offset, name, kind = struct.unpack_from("<IIHHII32s32s", data, at)
        name, kind = (text.split(b"\0", 1)[0].decode("cp1252") for text in (name, kind))
        objects.append((number, size, bool(access), group, offset, name, kind))
    return objects


def description(data):
    if len(data) < 21:
        raise ValueError("truncated")
    handle, kind, access, size, count = struct.unpack_from("<5I", data)
    if count > (len(data) - 21) // 4:
        raise ValueError("too many dimensions")
    dimensions = struct.unpack_from(f"<{count}I", data, 20)
    name = data[20 + 4 * count:].split(b"\0", 1)[0].decode("cp1252")
    return handle, kind, access, size, dimensions, name


def show(what, go, records):
    turns = []
    for _ in range(TURNS):
        start = time.perf_counter_ns()
        go()
        turns.append((time.perf_counter_ns() - start) / records)
    print(what, median(turns), sep="\t")


def main(folder):
    data = (folder / "descriptors.bin").read_bytes()
    everything = (folder / "descriptions.bin").read_bytes()
    each, at = [], 0
    while at < len(everything):
        (length,) = struct.unpack_from("<I", everything, at)
        each.append(everything[at + 4:at + 4 + length])
        at += 4 + length
    objects, last = descriptors(data), description(each[-1])
    assert len(objects) == 10_000 and objects[-1][4:] == (10_000, "gdb[0].object_9999", "DINT"), objects[-1]
    assert len(each) == 10_000 and last[3:] == (60, (3, 5), "V.E.Array_9999"), last
    show("descriptors", lambda: descriptors(data), len(objects))
    show("descriptions", lambda: [description(one) for one in each], len(each))


main(Path(sys.argv[1]))
