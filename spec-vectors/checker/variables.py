"""Streams of the variables with flexible data type."""
from .scalars import (
    Bad, Malformed, STREAM_MAX, TEXT_MAX, count_of, end, fixed_stream, join, number, number_bytes, plain, read_fields,
    request_text, size_of, text, text_bytes, texts, u32, write_field, write_fields,
)


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
        raise Malformed("too-many", 16, "dimension_count")
    value["dimensions"] = [number("UNS32", data[at + 4 * i:at + 4 * i + 4]) for i in range(count)]
    at += 4 * count
    if len(data) == at:
        raise Malformed("truncated", at, "name")
    if len(data) - at > TEXT_MAX or len(data) > STREAM_MAX:
        raise Malformed("too-long", at, "name")
    value["name"] = text(data[at:])
    return value


def handle_read_write(value, _context):
    indices = value["indices"]
    return ([("handle", write_field("UNS32", value["handle"])), ("index_count", u32(len(indices)))]
            + [("indices[%d]" % i, write_field("UNS32", x)) for i, x in enumerate(indices)])


def read_indices(data):
    """Handle, count and indices, and the offset after them."""
    value, at = read_fields([("handle", "UNS32"), ("index_count", "UNS32")], data)
    count = plain(value.pop("index_count"))
    if count > 510 or 4 * count > len(data) - at:
        raise Malformed("too-many", 4, "index_count")
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


def value_write(value, context):
    items = value["value"]
    kind = context["type"]
    if any(item["type"] != kind for item in items):
        raise Bad("an element is not of type %s" % kind)
    if len(items) != count_of(context):
        raise Bad("%d elements for %s%s" % (len(items), kind, context["dimensions"]))
    encode = text_bytes if kind == "STRING" else number_bytes
    return fitting([("value[%d]" % i, encode(item)) for i, item in enumerate(items)])


def value_items(data, at, context):
    """The values of the elements, which are the rest of the stream from offset `at` on."""
    kind = context["type"]
    if kind == "STRING":
        return texts(data, at, count_of(context), "value")
    step, size = size_of(kind), size_of(kind) * count_of(context)
    if len(data) - at < size:
        raise Malformed("truncated", at, "value")
    end(data, at + size, "value")
    return [number(kind, data[start:start + step]) for start in range(at, at + size, step)]


def value_read(data, context):
    if len(data) > STREAM_MAX:
        raise Malformed("too-long", 0, "value")
    return {"value": value_items(data, 0, context)}


def handle_write_write(value, context):
    return fitting(handle_read_write(value, context) + value_write(value, context))


def handle_write_read(data, context):
    value, at = read_indices(data)
    if len(data) > STREAM_MAX:
        raise Malformed("too-long", at, "value")
    value["value"] = value_items(data, at, context)
    return value


def name_write_write(value, context):
    name = text_bytes(value["name"])
    if name[-1:] != b"\0" or len(name) > TEXT_MAX or "tail" in value["name"]:
        raise Bad("the name before a value must end with exactly one NUL, and have at most 256 bytes")
    return fitting([("name", name)] + value_write(value, context))


def name_write_read(data, context):
    name, nul, _ = data[:TEXT_MAX].partition(b"\0")
    if not nul:
        raise Malformed("missing-nul", 0, "name")
    at = len(name) + 1
    if len(data) > STREAM_MAX:
        raise Malformed("too-long", at, "value")
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


STREAMS = {
    "variable-kind": text_stream([], "kind", may_be_absent=True),
    "variable-count": fixed_stream([("count", "UNS32")]),
    "variable-index-kind": text_stream([("index", "UNS32")], "kind"),
    "variable-name": text_stream([], "name"),
    "variable-description": (description_write, description_read),
    "variable-handle": fixed_stream([("handle", "UNS32")]),
    "variable-handle-read": (handle_read_write, handle_read_read),
    "variable-value": (value_write, value_read),
    "variable-handle-write": (handle_write_write, handle_write_read),
    "variable-name-write": (name_write_write, name_write_read),
    "variable-extended-description": (extended_write, extended_read),
}
