"""The parts of names, index groups and index offsets."""
import re

from .scalars import Bad, Malformed, TEXT_MAX, end, plain, read_fields, text, text_bytes, u32

INDEX_LAST = 0xFFFFFFFE


def characters(data):
    """The value of a text without a NUL."""
    return dict(text(data), open=True)


def path_write(value, _context):
    parts = [("kind", text_bytes(value["kind"]))]
    for number, part in enumerate(value["parts"]):
        parts.append(("parts[%d].name" % number, b"." + text_bytes(part["name"])))
        indices = b"".join(b"[%d]" % plain(index) for index in part["indices"])
        parts.append(("parts[%d].indices" % number, indices))
    return parts


def path_plain(data):
    """The path without the leading zeros of its indices, which the value of a path does not keep."""
    return re.sub(rb"(?<=\[)0+(?=[0-9])", b"", data)


def path_read(data, _context):
    if len(data) >= TEXT_MAX:
        raise Malformed("too-long", TEXT_MAX - 1, "name")
    if 0 in data:
        raise Malformed("not-text", data.index(0), "name")
    at = 0

    def fault(field):
        raise Malformed("unexpected" if at < len(data) else "truncated", at, field)

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
                raise Malformed("out-of-range", start, "indices")
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
    """The parts of an index group; empty for a group whose bits do not match the table in the README."""
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
            raise Bad("the parts add up to 0x%x, but the group is 0x%x" % (total, group))
    return [("index_group", u32(group))]


def group_read(data, context):
    value, at = read_fields([("index_group", "UNS32")], data)
    end(data, at, "index_group")
    group = plain(value["index_group"])
    if "base" in context and not 0 <= group - int(context["base"], 16) <= 0xFF:
        raise Malformed("out-of-range", 0, "instance")
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
        raise Malformed("out-of-range", 0, "axis")
    return {key: {"type": "UNS16", "value": str(part)} for key, part in (("axis", axis), ("element", element))}


STREAMS = {
    "variable-path": (path_write, path_read),
    "index-group": (group_write, group_read),
    "index-offset": (offset_write, offset_read),
}
