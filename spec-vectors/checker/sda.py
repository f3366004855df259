"""Streams of SDA and GEO, of the dynamic parameters, of content, and the description by name."""
from .scalars import (
    Bad, NUMBERS, Malformed, STREAM_MAX, count_of, end, fixed_stream, from_hex, number, number_bytes, plain, read_fields,
    size_of, text, text_bytes, texts, to_hex, u32, write_field, write_fields,
)

ELEMENT_TEXT_MAX = 256
CONTENT_MAX = 4194304
DYNAMIC_NAME_MAX = 96
DIMENSIONS_MAX = (STREAM_MAX - 20) // 4


def open_text(field, shortest, longest):
    """The functions that write and read a text that ends at its first NUL or at the end of the stream, with a tail."""
    def write(value, _context):
        data = text_bytes(value[field])
        if not shortest <= len(data) <= longest:
            raise Bad("%s of %d bytes" % (field, len(data)))
        return [(field, data)]

    def read(data, _context):
        if len(data) < shortest:
            raise Malformed("truncated", 0, field)
        if len(data) > longest:
            raise Malformed("too-long", 0, field)
        return {field: text(data)}

    return write, read


def name_request():
    """The functions that write and read a name that may end in a NUL; only more NULs may follow that NUL."""
    write, read_open = open_text("name", 1, DYNAMIC_NAME_MAX)

    def read(data, context):
        value = read_open(data, context)
        body, _, tail = data.partition(b"\0")
        for index, byte in enumerate(tail):
            if byte:
                raise Malformed("trailing", len(body) + 1 + index, "name")
        return value

    return write, read


WIDTHS = {1: "UNS08", 2: "UNS16", 4: "UNS32"}


def length_write(value, _context):
    if value["length"]["type"] not in WIDTHS.values():
        raise Bad("a length of type %s" % value["length"]["type"])
    return [("length", number_bytes(value["length"]))]


def length_read(data, _context):
    if len(data) > 4:
        raise Malformed("trailing", 4, "length")
    if len(data) not in WIDTHS:
        raise Malformed("truncated", 0, "length")
    return {"length": number(WIDTHS[len(data)], data)}


def index_read(data, _context):
    value, at = read_fields([("index", "UNS32")], data)
    if plain(value["index"]) == 0:
        raise Malformed("out-of-range", 0, "index")
    end(data, at, "index")
    return value


def index_write(value, _context):
    if plain(value["index"]) == 0:
        raise Bad("index 0")
    return write_fields([("index", "UNS32")], value)


def content_write(value, context):
    items, kind = value["content"], context.get("type")
    if kind is None:
        if items["type"] != "BYTES":
            raise Bad("type %s where the context has none" % items["type"])
        return [("content", from_hex(items["hex"]))]
    count = count_of(context)
    if len(items) != count or any(item["type"] != kind for item in items):
        raise Bad("%s instead of %d items of %s" % ([item["type"] for item in items], count, kind))
    encode = text_bytes if kind == "STRING" else number_bytes
    return [("content[%d]" % i, encode(item)) for i, item in enumerate(items)]


def content_read(data, context):
    kind = context.get("type")
    if len(data) > CONTENT_MAX:
        raise Malformed("too-long", 0, "content")
    if kind is None:
        return {"content": {"type": "BYTES", "hex": to_hex(data)}}
    if kind == "STRING":
        return {"content": texts(data, 0, count_of(context), "content")}
    if kind not in NUMBERS:
        raise Bad("a content cannot have the type %s" % kind)
    step, size = size_of(kind), size_of(kind) * count_of(context)
    if len(data) < size:
        raise Malformed("truncated", 0, "content")
    end(data, size, "content")
    return {"content": [number(kind, data[at:at + step]) for at in range(0, size, step)]}


BY_NAME = [("handle", "UNS32"), ("type", "UNS32"), ("access", "UNS32"), ("size", "UNS32")]


def by_name_write(value, _context):
    dimensions = value["dimensions"]
    if len(dimensions) > DIMENSIONS_MAX:
        raise Bad("%d dimensions" % len(dimensions))
    return (write_fields(BY_NAME, value) + [("dimension_count", u32(len(dimensions)))]
            + [("dimensions[%d]" % i, write_field("UNS32", d)) for i, d in enumerate(dimensions)])


def by_name_read(data, _context):
    value, at = read_fields(BY_NAME + [("dimension_count", "UNS32")], data)
    count = plain(value.pop("dimension_count"))
    if len(data) > STREAM_MAX:
        raise Malformed("too-long", at, "dimensions")
    if count > DIMENSIONS_MAX or 4 * count > len(data) - at:
        raise Malformed("too-many", 16, "dimension_count")
    end(data, at + 4 * count, "dimension_count")
    value["dimensions"] = [number("UNS32", data[at + 4 * i:at + 4 * i + 4]) for i in range(count)]
    return value


STREAMS = {
    "object-address-query": fixed_stream([("channel", "UNS32"), ("axis", "UNS32")]),
    "object-address": fixed_stream([("index_group", "UNS32"), ("index_offset", "UNS32")]),
    "element-count": fixed_stream([("count", "UNS32")]),
    "element-text": open_text("text", 0, ELEMENT_TEXT_MAX),
    "element-length": (length_write, length_read),
    "element-write-flag": fixed_stream([("flag", "BOOLEAN")]),
    "content": (content_write, content_read),
    "dynamic-count": fixed_stream([("count", "UNS32")]),
    "dynamic-index": (index_write, index_read),
    "dynamic-name": open_text("name", 1, DYNAMIC_NAME_MAX),
    "dynamic-name-request": name_request(),
    "dynamic-value": fixed_stream([("value", "REAL64")]),
    "variable-description-by-name": (by_name_write, by_name_read),
}


def plain_truth(tagged):
    is_true = tagged["type"] in ("BOOLEAN", "BOOL") and plain(tagged) != 0
    return dict(tagged, value="1") if is_true else tagged


def plain_content(value):
    """The canonical form of a content. It has the length of its object, so its texts keep their tails."""
    content = value["content"]
    return {"content": [plain_truth(item) for item in content] if isinstance(content, list) else content}


# The canonical forms of values, for streams in which the general canonical form does not apply.
CANONICAL = {
    "element-length": lambda value: {"length": dict(value["length"], type="UNS32")},
    "element-write-flag": lambda value: {"flag": plain_truth(value["flag"])},
    "content": plain_content,
}
