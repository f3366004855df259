#!/usr/bin/env python3
"""Judge the vectors without any codec.

The bytes of every accepted vector are derived again from its value, and its value from its bytes, with
the tables below and `struct` alone. Every rejected vector is decoded too and must be refused with the
class, offset and field it states. Sequences are gone through step by step by the models in `checker`.

    python3 check.py [--data DIR]

Exit code 0 if everything agrees, 1 otherwise.
"""
import argparse
import json
import struct
import sys
from pathlib import Path

from checker import sequences, streaming

# ---------------------------------------------------------------- scalars

NUMBERS = {
    "BOOLEAN": "<B", "UNS08": "<B", "SGN08": "<b", "UNS16": "<H", "SGN16": "<h",
    "UNS32": "<I", "SGN32": "<i", "REAL32": "<f", "REAL64": "<d",
    # the names of the COM task
    "BOOL": "<B", "BYTE": "<B", "SINT": "<b", "WORD": "<H", "INT": "<h", "DWORD": "<I", "DINT": "<i",
    "LWORD": "<Q", "LINT": "<q", "REAL": "<f", "LREAL": "<d",
}
# the integer that shows a float's bits
REALS = {"REAL32": "<I", "REAL64": "<Q", "REAL": "<I", "LREAL": "<Q"}

# CP1252 where it differs from Latin-1. 81 8d 8f 90 9d have no character and read as U+0081 and so on.
CP1252 = dict(zip(
    b"\x80\x82\x83\x84\x85\x86\x87\x88\x89\x8a\x8b\x8c\x8e\x91\x92\x93\x94\x95\x96\x97\x98\x99\x9a\x9b\x9c\x9e\x9f",
    "€‚ƒ„…†‡ˆ‰Š‹ŒŽ‘’“”•–—˜™š›œžŸ",
))

TEXT_MAX = 256
STREAM_MAX = 2048
DESCRIPTOR = 84


class Refuse(Exception):
    """What a decoder says of a malformed stream."""

    def __init__(self, cls, offset, field):
        super().__init__("%s at %d in %s" % (cls, offset, field))
        self.cls, self.offset, self.field = cls, offset, field


class Bad(Exception):
    """A vector that contradicts itself."""


def to_hex(data):
    return " ".join("%02x" % byte for byte in data)


def from_hex(text):
    data = bytes.fromhex(text)
    if to_hex(data) != text:
        raise Bad("hex %r is not lower case with single spaces" % text)
    return data


def text_reading(data):
    return "".join(CP1252.get(byte, chr(byte)) for byte in data)


def number(kind, data):
    (value,) = struct.unpack(NUMBERS[kind], data)
    if kind not in REALS:
        return {"type": kind, "value": str(value)}
    digits = len(data) * 2
    (bits,) = struct.unpack(REALS[kind], data)
    return {"type": kind, "value": repr(value), "bits": "0x%0*x" % (digits, bits)}


def number_bytes(tagged):
    kind = tagged["type"]
    if kind not in REALS:
        if str(int(tagged["value"])) != tagged["value"]:
            raise Bad("%r is not a plain decimal number" % tagged["value"])
        return struct.pack(NUMBERS[kind], int(tagged["value"]))
    data = struct.pack(REALS[kind], int(tagged["bits"], 16))
    value = float(tagged["value"])
    (stored,) = struct.unpack(NUMBERS[kind], data)
    # the bits of a NaN say more than its name
    same = stored != stored if value != value else struct.pack(NUMBERS[kind], value) == data
    if not same:
        raise Bad("%s and %s are two numbers" % (tagged["value"], tagged["bits"]))
    return data


def size_of(kind):
    return struct.calcsize(NUMBERS[kind])


# ---------------------------------------------------------------- texts

def text(data):
    """A text, what stands behind its first NUL, or that it has none."""
    body, nul, tail = data.partition(b"\0")
    tagged = {"type": "STRING", "value": text_reading(body), "hex": to_hex(body)}
    if not nul:
        tagged["open"] = True
    elif tail:
        tagged["tail"] = to_hex(tail)
    return tagged


def text_bytes(tagged):
    body = from_hex(tagged["hex"])
    if text_reading(body) != tagged["value"]:
        raise Bad("%s reads %r, not %r" % (tagged["hex"], text_reading(body), tagged["value"]))
    if 0 in body:
        raise Bad("a NUL inside the text %r" % tagged["hex"])
    if tagged.get("open"):
        return body
    return body + b"\0" + from_hex(tagged.get("tail", ""))


def text32(data):
    tagged = text(data)
    if not any(from_hex(tagged.get("tail", ""))):
        tagged.pop("tail", None)
    return tagged


def text32_bytes(tagged):
    data = text_bytes(tagged).ljust(32, b"\0")
    if len(data) != 32:
        raise Bad("%r takes %d bytes of 32" % (tagged["value"], len(data)))
    return data


def request_text(data, at, field, may_be_absent=False):
    """A text of a request: one NUL at its end, then at most more NULs."""
    if len(data) > TEXT_MAX:
        raise Refuse("too-long", at, field)
    if not data and may_be_absent:
        return text(data)
    if b"\0" not in data:
        raise Refuse("missing-nul", at, field)
    body, _, tail = data.partition(b"\0")
    for place, byte in enumerate(tail):
        if byte:
            raise Refuse("trailing", at + len(body) + 1 + place, field)
    return text(data)


# ---------------------------------------------------------------- fixed layouts

FIXED = {
    "ams-tcp-header": [("reserved", "UNS16"), ("length", "UNS32")],
    "ams-header": [
        ("target_net_id", "NETID"), ("target_port", "UNS16"), ("source_net_id", "NETID"), ("source_port", "UNS16"),
        ("command", "UNS16"), ("state_flags", "UNS16"), ("data_length", "UNS32"), ("error", "UNS32"),
        ("invoke_id", "UNS32"),
    ],
    "read-request": [("index_group", "UNS32"), ("index_offset", "UNS32"), ("length", "UNS32")],
    "write-reply": [("result", "UNS32")],
    "object-count": [("count", "UNS32")],
    "object-descriptor": [
        ("id", "UNS32"), ("size", "UNS32"), ("write_access", "UNS16"), ("not_assigned", "UNS16"),
        ("index_group", "UNS32"), ("index_offset", "UNS32"), ("name", "TEXT32"), ("type", "TEXT32"),
    ],
    "variable-count": [("count", "UNS32")],
    "variable-handle": [("handle", "UNS32")],
}
SIZES = {"NETID": 6, "TEXT32": 32}


def field_size(kind):
    return SIZES.get(kind) or size_of(kind)


def read_field(kind, data):
    if kind == "NETID":
        return {"type": "NETID", "value": ".".join(str(byte) for byte in data)}
    return text32(data) if kind == "TEXT32" else number(kind, data)


def write_field(kind, tagged):
    if tagged["type"] != {"TEXT32": "STRING"}.get(kind, kind):
        raise Bad("type %s where %s stands" % (tagged["type"], kind))
    if kind == "NETID":
        return bytes(int(part) for part in tagged["value"].split("."))
    return text32_bytes(tagged) if kind == "TEXT32" else number_bytes(tagged)


def read_fields(layout, data, at=0):
    """The fields from `at` on, and the offset behind them."""
    value = {}
    for field, kind in layout:
        part = data[at:at + field_size(kind)]
        if len(part) < field_size(kind):
            raise Refuse("truncated", at, field)
        value[field] = read_field(kind, part)
        at += len(part)
    return value, at


def write_fields(layout, value, prefix=""):
    return [(prefix + field, write_field(kind, value[field])) for field, kind in layout]


def end(data, at, field):
    if len(data) > at:
        raise Refuse("trailing", at, field)


def plain(tagged):
    return int(tagged["value"])


def u32(value):
    return struct.pack("<I", value)


# ---------------------------------------------------------------- streams: write(value, context), read(data, context)

def fixed_stream(layout):
    def write(value, _context):
        return write_fields(layout, value)

    def read(data, _context):
        value, at = read_fields(layout, data)
        end(data, at, layout[-1][0])
        return value

    return write, read


ADDRESS = [("index_group", "UNS32"), ("index_offset", "UNS32")]


def counted_data(head, length_field, result_first):
    """Fixed fields, a length, and as much data as it says."""
    layout = head + [(length_field, "UNS32")]

    def write(value, _context):
        parts = write_fields(head, value)
        if result_first and "data" not in value:
            if plain(value["result"]) == 0:
                raise Bad("success without data")
            return parts
        if value["data"]["type"] != "BYTES":
            raise Bad("data is no BYTES")
        data = from_hex(value["data"]["hex"])
        return parts + [(length_field, u32(len(data))), ("data", data)]

    def read(data, _context):
        if result_first:
            value, at = read_fields(head, data)
            if plain(value["result"]) != 0 and len(data) == at:
                return value
        value, at = read_fields(layout, data)
        length = plain(value.pop(length_field))
        if len(data) - at < length:
            raise Refuse("truncated", at, "data")
        end(data, at + length, "data")
        value["data"] = {"type": "BYTES", "hex": to_hex(data[at:at + length])}
        return value

    return write, read


def descriptors_write(value, _context):
    parts = []
    for place, item in enumerate(value["descriptors"]):
        parts += write_fields(FIXED["object-descriptor"], item, "descriptors[%d]." % place)
    return parts


def descriptors_read(data, _context):
    if not data or len(data) % DESCRIPTOR:
        raise Refuse("bad-length", len(data) - len(data) % DESCRIPTOR, "descriptors")
    steps = range(0, len(data), DESCRIPTOR)
    return {"descriptors": [read_fields(FIXED["object-descriptor"], data, at)[0] for at in steps]}


def text_stream(head, field, may_be_absent=False):
    def write(value, _context):
        return write_fields(head, value) + [(field, text_bytes(value[field]))]

    def read(data, _context):
        value, at = read_fields(head, data)
        value[field] = request_text(data[at:], at, field, may_be_absent)
        return value

    return write, read


DESCRIPTION = [("handle", "UNS32"), ("type", "UNS32"), ("access", "UNS32"), ("size", "UNS32")]


def description_write(value, _context):
    parts = write_fields(DESCRIPTION, value) + [("dimension_count", u32(len(value["dimensions"])))]
    parts += [("dimensions[%d]" % i, write_field("UNS32", d)) for i, d in enumerate(value["dimensions"])]
    name = text_bytes(value["name"])
    if len(name) > TEXT_MAX:
        raise Bad("name field of %d bytes" % len(name))
    return parts + [("name", name)]


def description_read(data, _context):
    value, at = read_fields(DESCRIPTION + [("dimension_count", "UNS32")], data)
    count = plain(value.pop("dimension_count"))
    if count > 506 or 4 * count > len(data) - at:
        raise Refuse("too-many", 16, "dimension_count")
    value["dimensions"] = [number("UNS32", data[at + 4 * i:at + 4 * i + 4]) for i in range(count)]
    at += 4 * count
    if len(data) == at:
        raise Refuse("truncated", at, "name")
    if len(data) - at > TEXT_MAX or len(data) > STREAM_MAX:
        raise Refuse("too-long", at, "name")
    value["name"] = text(data[at:])
    return value


def handle_read_write(value, _context):
    indices = value["indices"]
    return ([("handle", write_field("UNS32", value["handle"])), ("index_count", u32(len(indices)))]
            + [("indices[%d]" % i, write_field("UNS32", x)) for i, x in enumerate(indices)])


def read_indices(data):
    """Handle, count and indices, and the offset behind them."""
    value, at = read_fields([("handle", "UNS32"), ("index_count", "UNS32")], data)
    count = plain(value.pop("index_count"))
    if count > 510 or 4 * count > len(data) - at:
        raise Refuse("too-many", 4, "index_count")
    value["indices"] = [number("UNS32", data[at + 4 * i:at + 4 * i + 4]) for i in range(count)]
    return value, at + 4 * count


def handle_read_read(data, _context):
    value, at = read_indices(data)
    end(data, at, "index_count")
    return value


def fitting(parts):
    if len(join(parts)) > STREAM_MAX:
        raise Bad("more than %d bytes" % STREAM_MAX)
    return parts


def elements(context):
    count = 1
    for dimension in context["dimensions"]:
        count *= dimension
    return count


def value_write(value, context):
    items = value["value"]
    kind = context["type"]
    if any(item["type"] != kind for item in items):
        raise Bad("an element is no %s" % kind)
    if len(items) != elements(context):
        raise Bad("%d elements for %s%s" % (len(items), kind, context["dimensions"]))
    encode = text_bytes if kind == "STRING" else number_bytes
    return fitting([("value[%d]" % i, encode(item)) for i, item in enumerate(items)])


def value_items(data, at, context):
    """The elements that take the rest of a stream from `at` on."""
    kind = context["type"]
    if kind == "STRING":
        if context["dimensions"]:
            raise Bad("where the elements of a STRING array end is not documented")
        return [text(data[at:])]
    step, size = size_of(kind), size_of(kind) * elements(context)
    if len(data) - at < size:
        raise Refuse("truncated", at, "value")
    end(data, at + size, "value")
    return [number(kind, data[place:place + step]) for place in range(at, at + size, step)]


def value_read(data, context):
    if len(data) > STREAM_MAX:
        raise Refuse("too-long", 0, "value")
    return {"value": value_items(data, 0, context)}


def handle_write_write(value, context):
    return fitting(handle_read_write(value, context) + value_write(value, context))


def handle_write_read(data, context):
    value, at = read_indices(data)
    if len(data) > STREAM_MAX:
        raise Refuse("too-long", at, "value")
    value["value"] = value_items(data, at, context)
    return value


def name_write_write(value, context):
    name = text_bytes(value["name"])
    if name[-1:] != b"\0" or len(name) > TEXT_MAX or "tail" in value["name"]:
        raise Bad("the name before a value ends with its one NUL, at most 256 bytes")
    return fitting([("name", name)] + value_write(value, context))


def name_write_read(data, context):
    name, nul, _ = data[:TEXT_MAX].partition(b"\0")
    if not nul:
        raise Refuse("missing-nul", 0, "name")
    at = len(name) + 1
    if len(data) > STREAM_MAX:
        raise Refuse("too-long", at, "value")
    return {"name": text(data[:at]), "value": value_items(data, at, context)}


EXTENDED = [("synchronisation", "UNS32"), ("validity", "UNS32")]


def extended_write(value, _context):
    return write_fields(EXTENDED, value) if value else [("synchronisation", b"")]


def extended_read(data, _context):
    if not data:
        return {}
    value, at = read_fields(EXTENDED, data)
    end(data, at, "validity")
    return value


# ---------------------------------------------------------------- names by their parts

INDEX_LAST = 0xFFFFFFFE


def characters(data):
    """A text that has no NUL and needs none."""
    return dict(text(data), open=True)


def path_write(value, _context):
    parts = [("kind", text_bytes(value["kind"]))]
    for place, part in enumerate(value["parts"]):
        parts.append(("parts[%d].name" % place, b"." + text_bytes(part["name"])))
        indices = b"".join(b"[%d]" % plain(index) for index in part["indices"])
        parts.append(("parts[%d].indices" % place, indices))
    return parts


def path_read(data, _context):
    if len(data) >= TEXT_MAX:
        raise Refuse("too-long", TEXT_MAX - 1, "name")
    if 0 in data:
        raise Refuse("not-text", data.index(0), "name")
    at = 0

    def fault(field):
        raise Refuse("unexpected" if at < len(data) else "truncated", at, field)

    def expect(byte, field):
        nonlocal at
        if data[at:at + 1] != byte:
            fault(field)
        at += 1

    def take(wanted, field):
        nonlocal at
        start = at
        while at < len(data) and wanted(data[at:at + 1]):
            at += 1
        if at == start:
            fault(field)
        return data[start:at]

    def word(byte):
        return byte not in (b".", b"[", b"]")

    expect(b"V", "kind")
    expect(b".", "kind")
    kind, parts = b"V." + take(word, "kind"), []
    while not parts or at < len(data):
        expect(b".", "parts")
        name, indices = take(word, "parts"), []
        while data[at:at + 1] == b"[":
            at += 1
            start = at
            index = int(take(bytes.isdigit, "indices"))
            if index > INDEX_LAST:
                raise Refuse("out-of-range", start, "indices")
            expect(b"]", "indices")
            indices.append({"type": "UNS32", "value": str(index)})
        parts.append({"name": characters(name), "indices": indices})
    return {"kind": characters(kind), "parts": parts}


CLASSES = ["position-controller", "interpolator", "decoder", "hld", "path-preparation", "spindle"]
ATTRIBUTES = ["content", "name", "type", "length", "unit", "write-flag", "object-address"]
TABLES = {1: "channel", 2: "axis"}
FIRST_ATTRIBUTE = 3


def name(value):
    return {"type": "NAME", "value": value}


def group_split(group):
    """What a group means, or nothing for one outside the documented groups."""
    access = {0x2: "element", 0x3: "object"}.get(group >> 16 & 0xf)
    logical, table, cls = group >> 20, group >> 8 & 0xf, group >> 12 & 0xf
    if access is None or logical > 1:
        return {}
    parts = {"access": name(access), "addressing": name("logical" if logical else "index"),
             "instance": {"type": "UNS08", "value": str(group & 0xff)}}
    if table in TABLES and cls == 0:
        return dict(parts, task=name("COM"), table=name(TABLES[table]))
    attribute = table - FIRST_ATTRIBUTE
    if access != "element" or cls >= len(CLASSES) or not 0 <= attribute < len(ATTRIBUTES):
        return {}
    if CLASSES[cls] == "spindle" and logical:
        return {}
    return dict(parts, task=name("SDA/GEO"), **{"class": name(CLASSES[cls]), "attribute": name(ATTRIBUTES[attribute])})


def group_write(value, _context):
    group = plain(value["index_group"])
    if "task" in value:
        text_of = {key: item["value"] for key, item in value.items()}
        total = {"logical": 0x100000, "index": 0}[text_of["addressing"]]
        total += {"element": 0x20000, "object": 0x30000}[text_of["access"]]
        if text_of["task"] == "COM":
            total += {"channel": 0x100, "axis": 0x200}[text_of["table"]]
        else:
            total += 0x300 + 0x1000 * CLASSES.index(text_of["class"]) + 0x100 * ATTRIBUTES.index(text_of["attribute"])
        total += int(text_of["instance"])
        if total != group:
            raise Bad("the parts add up to 0x%x, the group is 0x%x" % (total, group))
    return [("index_group", u32(group))]


def group_read(data, context):
    value, at = read_fields([("index_group", "UNS32")], data)
    end(data, at, "index_group")
    group = plain(value["index_group"])
    if "base" in context and not 0 <= group - int(context["base"], 16) <= 0xFF:
        raise Refuse("out-of-range", 0, "instance")
    return dict(value, **group_split(group))


def offset_write(value, context):
    stride = int(context["stride"], 16)
    axis, element = (plain(value[key]) for key in ("axis", "element"))
    if not (axis < 0x10000 and element < stride):
        raise Bad("axis %d or element %d does not fit its part" % (axis, element))
    return [("index_offset", u32(stride * axis + element))]


def offset_read(data, context):
    value, at = read_fields([("index_offset", "UNS32")], data)
    end(data, at, "index_offset")
    axis, element = divmod(plain(value["index_offset"]), int(context["stride"], 16))
    if axis >= 0x10000:
        raise Refuse("out-of-range", 0, "axis")
    return {key: {"type": "UNS16", "value": str(part)} for key, part in (("axis", axis), ("element", element))}


# ---------------------------------------------------------------- whole frames

SERVICES = {2: "read", 3: "write", 9: "read_write"}
DIRECTIONS = {0x0004: "request", 0x0005: "reply"}
AMS_HEADER = 32
HEADERS = 6 + AMS_HEADER


def part_name(header):
    """The stream that follows an AMS header; just data for what this table has no stream of."""
    service = SERVICES.get(plain(header["command"]))
    direction = DIRECTIONS.get(plain(header["state_flags"]))
    return "%s_%s" % (service, direction) if service and direction else "data"


def frame_write(value, context):
    header = value["ams_header"]
    name, parts = part_name(header), []
    if name in value:
        if name == "data":
            parts = [("data", from_hex(value["data"]["hex"]))]
        else:
            inner = STREAMS[name.replace("_", "-")][0](value[name], context)
            parts = [(name + "." + field, data) for field, data in inner]
    length = len(join(parts))
    counts = {"length": {"type": "UNS32", "value": str(AMS_HEADER + length)},
              "data_length": {"type": "UNS32", "value": str(length)}}
    return (write_fields(FIXED["ams-tcp-header"], dict(value["ams_tcp_header"], **counts), "ams_tcp_header.")
            + write_fields(FIXED["ams-header"], dict(header, **counts), "ams_header.") + parts)


def within(prefix, at, read):
    """Reads a part, and says of a fault where in the whole it is."""
    try:
        return read()
    except Refuse as why:
        raise Refuse(why.cls, at + why.offset, "%s.%s" % (prefix, why.field)) from None


def frame_read(data, context):
    tcp, at = within("ams_tcp_header", 0, lambda: read_fields(FIXED["ams-tcp-header"], data))
    if plain(tcp["reserved"]) != 0:
        raise Refuse("mismatch", 0, "ams_tcp_header.reserved")
    length = plain(tcp.pop("length"))
    if length < AMS_HEADER:
        raise Refuse("out-of-range", 2, "ams_tcp_header.length")
    header, _ = within("ams_header", at, lambda: read_fields(FIXED["ams-header"], data[at:]))
    if plain(header.pop("data_length")) != length - AMS_HEADER:
        raise Refuse("mismatch", 26, "ams_header.data_length")
    value = {"ams_tcp_header": tcp, "ams_header": header}
    rest, name = data[HEADERS:], part_name(header)
    if len(rest) < length - AMS_HEADER:
        raise Refuse("truncated", HEADERS, name)
    end(data, 6 + length, name)
    if not rest and plain(header["error"]) != 0:
        return value
    if name == "data":
        return dict(value, data={"type": "BYTES", "hex": to_hex(rest)})
    read = STREAMS[name.replace("_", "-")][1]
    return dict(value, **{name: within(name, HEADERS, lambda: read(rest, context))})


# Started as a program this module has another name; what imports it from there is to find this one.
sys.modules["check"] = sys.modules[__name__]
from checker import sda  # noqa: E402  (needs what stands above)

STREAMS = {stream: fixed_stream(layout) for stream, layout in FIXED.items()}
STREAMS.update(sda.STREAMS)
STREAMS.update({
    "read-reply": counted_data([("result", "UNS32")], "length", True),
    "write-request": counted_data(ADDRESS, "length", False),
    "read-write-request": counted_data(ADDRESS + [("read_length", "UNS32")], "write_length", False),
    "read-write-reply": counted_data([("result", "UNS32")], "length", True),
    "object-descriptors": (descriptors_write, descriptors_read),
    "variable-kind": text_stream([], "kind", may_be_absent=True),
    "variable-index-kind": text_stream([("index", "UNS32")], "kind"),
    "variable-name": text_stream([], "name"),
    "variable-description": (description_write, description_read),
    "variable-handle-read": (handle_read_write, handle_read_read),
    "variable-value": (value_write, value_read),
    "variable-handle-write": (handle_write_write, handle_write_read),
    "variable-name-write": (name_write_write, name_write_read),
    "variable-extended-description": (extended_write, extended_read),
    "variable-path": (path_write, path_read),
    "ams-frame": (frame_write, frame_read),
    "index-group": (group_write, group_read),
    "index-offset": (offset_write, offset_read),
    "program-stream": streaming.program_stream(Refuse, to_hex, from_hex),
})


# ---------------------------------------------------------------- one vector

def canonical_value(value):
    """The value without what a careful writer leaves out: tails, open ends, odd TRUEs."""
    if isinstance(value, list):
        return [canonical_value(item) for item in value]
    if isinstance(value.get("type"), str):
        if value["type"] == "BOOLEAN" and value["value"] != "0":
            return {"type": "BOOLEAN", "value": "1"}
        return {key: item for key, item in value.items() if key not in ("tail", "open")}
    value = {key: canonical_value(item) for key, item in value.items()}
    if value.get("write_access", {}).get("value", "0") != "0":
        value["write_access"] = {"type": "UNS16", "value": "1"}
    return value


def canonical_bytes(stream, write, value, context, given):
    """None where the canonical form is the stream itself, or would not fit."""
    # the texts of a name's parts end with the part
    canonical = sda.CANONICAL.get(stream, canonical_value)
    plain_value = value if write is path_write else canonical(value)
    try:
        data = join(write(plain_value, context))
    except Bad:
        # a text that fills its field has no room for a NUL, so its only form is the open one
        return None
    return None if data == given else data


def join(parts):
    return b"".join(data for _, data in parts)


def segment_bytes(segment, width):
    """The bytes a segment's own value stands for; `width` is the length of its hex."""
    value = segment["value"]
    if isinstance(value, list):
        return b"".join(number_bytes(item) for item in value)
    kind = value["type"]
    if kind == "STRING":
        # in the 32-byte fields the zeros behind the text are left out of the value
        is_field = segment["field"].split(".")[-1] in ("name", "type") and width == 32 and "tail" not in value
        return text32_bytes(value) if is_field else text_bytes(value)
    if kind == "BYTES":
        return from_hex(value["hex"])
    return write_field(kind, value)


def check_segments(vector):
    for segment in vector["segments"]:
        data = from_hex(segment["hex"])
        if "value" in segment:
            own = segment_bytes(segment, len(data))
            if own != data:
                raise Bad("segment %s: hex %s, its value gives %s" % (segment["field"], to_hex(data), to_hex(own)))
    if not vector["segments"]:
        raise Bad("no segments")


def check_order(vector, parts):
    """The segments are the stream's fields, in order; one segment may take a whole list."""
    rest = [part for part in parts if part[1]]
    for segment in vector["segments"]:
        field, data = segment["field"], b""
        while rest and (rest[0][0] == field or rest[0][0].startswith((field + "[", field + "."))):
            data += rest.pop(0)[1]
        if not data and (field, b"") not in parts:
            raise Bad("segment %s: the stream has no such field here" % field)
        if data != from_hex(segment["hex"]):
            raise Bad("segment %s: hex %s, the value gives %s" % (field, segment["hex"], to_hex(data)))
    if rest:
        raise Bad("field %s has no segment" % rest[0][0])


def differing(path, stated, derived):
    """The innermost field in which two values differ, and both readings."""
    if isinstance(stated, dict) and isinstance(derived, dict):
        for key in list(stated) + [key for key in derived if key not in stated]:
            if stated.get(key) != derived.get(key):
                return differing(path + "." + key, stated.get(key), derived.get(key))
    if isinstance(stated, list) and isinstance(derived, list) and len(stated) == len(derived):
        for place, (one, other) in enumerate(zip(stated, derived)):
            if one != other:
                return differing("%s[%d]" % (path, place), one, other)
    return path.lstrip("."), stated, derived


def check_accept(vector, write, read):
    accept = vector["expect"]["accept"]
    data = join((s["field"], from_hex(s["hex"])) for s in vector["segments"])
    context = vector.get("context", {})
    parts = write(accept["value"], context)
    check_order(vector, parts)
    if join(parts) != data:
        raise Bad("bytes: stated %s, from the value %s" % (to_hex(data), to_hex(join(parts))))
    try:
        derived = read(data, context)
    except Refuse as why:
        raise Bad("accepted, but its bytes are refused: %s" % why) from None
    if derived != accept["value"]:
        raise Bad("value %s: stated %s, from the bytes %s" % differing("", accept["value"], derived))
    canonical = canonical_bytes(vector["stream"], write, accept["value"], context, data)
    stated = from_hex(accept["canonical"]) if "canonical" in accept else None
    if canonical != stated:
        raise Bad("canonical: stated %s, derived %s" % tuple(None if x is None else to_hex(x) for x in (stated, canonical)))


EDIT_MAX = 8  # a count and the item it adds


def edit(good, bad):
    """Bytes in the one place where two streams differ; 0 if one of them is the other, cut or continued."""
    short = min(len(good), len(bad))
    front = 0
    while front < short and good[front] == bad[front]:
        front += 1
    if front == short:
        return 0
    back = 0
    while back < short - front and good[-1 - back] == bad[-1 - back]:
        back += 1
    return max(len(good), len(bad)) - front - back


def check_reject(vector, read, vectors):
    data = join((s["field"], from_hex(s["hex"])) for s in vector["segments"])
    stated = vector["expect"]["reject"]
    try:
        derived = read(data, vector.get("context", {}))
    except Refuse as why:
        for key, found in (("class", why.cls), ("offset", why.offset), ("field", why.field)):
            if stated[key] != found:
                raise Bad("%s: stated %s, derived %s" % (key, stated[key], found)) from None
    else:
        raise Bad("to be refused as %s, but its bytes read as %s" % (stated["class"], derived))
    if "sibling" in vector:
        sibling = vectors.get(vector["sibling"])
        if sibling is None:
            raise Bad("sibling %s does not exist" % vector["sibling"])
        if "accept" not in sibling["expect"]:
            raise Bad("sibling %s is not accepted" % vector["sibling"])
        if sibling["stream"] != vector["stream"]:
            raise Bad("sibling: stream %s, not %s" % (sibling["stream"], vector["stream"]))
        good = join((s["field"], from_hex(s["hex"])) for s in sibling["segments"])
        if good == data:
            raise Bad("sibling %s has the same bytes" % vector["sibling"])
        if edit(good, data) > EDIT_MAX:
            raise Bad("sibling %s differs by more than one fault: %s, not %s" % (vector["sibling"], to_hex(data), to_hex(good)))


def check(vector, vectors):
    if vector["stream"] not in STREAMS:
        raise Bad("unknown stream %s" % vector["stream"])
    write, read = STREAMS[vector["stream"]]
    check_segments(vector)
    if list(vector["expect"]) == ["accept"]:
        check_accept(vector, write, read)
        return "accepted"
    if list(vector["expect"]) == ["reject"]:
        check_reject(vector, read, vectors)
        return "rejected"
    raise Bad("neither accepted nor rejected: %s" % list(vector["expect"]))


# ---------------------------------------------------------------- all files

def main():
    parser = argparse.ArgumentParser(description="Judge the vectors without any codec.")
    parser.add_argument("--data", type=Path, default=Path(__file__).resolve().parent / "data")
    data = parser.parse_args().data
    folder = data / "vectors"
    files = {path: json.loads(path.read_text(encoding="utf-8"))["vectors"] for path in sorted(folder.glob("*.json"))}
    listed = [vector for found in files.values() for vector in found]
    vectors = {vector["id"]: vector for vector in listed}
    failures = []
    if not listed:
        failures.append("no vectors in %s" % folder)
    if len(vectors) != len(listed):
        failures.append("%d vectors share an id with another" % (len(listed) - len(vectors)))
    total = {"accepted": 0, "rejected": 0}
    for path, found in files.items():
        counts = {"accepted": 0, "rejected": 0}
        if not found:
            failures.append("%s: no vectors" % path.name)
        for vector in found:
            try:
                counts[check(vector, vectors)] += 1
            except Bad as why:
                failures.append("%s: %s" % (vector["id"], why))
            except (KeyError, TypeError, ValueError, AttributeError, IndexError, struct.error) as why:
                failures.append("%s: malformed: %s: %s" % (vector["id"], type(why).__name__, why))
        print("%s: %d accepted, %d rejected, %d wrong"
              % (path.name, counts["accepted"], counts["rejected"], len(found) - sum(counts.values())))
        for key in total:
            total[key] += counts[key]
    cases, wrong = sequences.check_all(data / "sequences", edit)
    failures += wrong
    for failure in failures:
        print("FAIL %s" % (failure if len(failure) < 600 else failure[:600] + " …"))
    print("%d sequences: %d accepted and %d rejected agree, %d failures"
          % (sum(cases.values()) + len(wrong), cases["accepted"], cases["rejected"], len(wrong)))
    print("%d vectors: %d accepted and %d rejected agree, %d failures"
          % (len(listed), total["accepted"], total["rejected"], len(failures) - len(wrong)))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
