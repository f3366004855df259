"""Numbers, texts and fixed fields, and the error of a malformed stream."""
import struct

from .pieces import Bad

NUMBERS = {
    "BOOLEAN": "<B", "UNS08": "<B", "SGN08": "<b", "UNS16": "<H", "SGN16": "<h",
    "UNS32": "<I", "SGN32": "<i", "REAL32": "<f", "REAL64": "<d",
    # type names of the COM task
    "BOOL": "<B", "BYTE": "<B", "SINT": "<b", "WORD": "<H", "INT": "<h", "DWORD": "<I", "DINT": "<i",
    "LWORD": "<Q", "LINT": "<q", "REAL": "<f", "LREAL": "<d",
}
# the format of the unsigned integer that has the bits of a float
REALS = {"REAL32": "<I", "REAL64": "<Q", "REAL": "<I", "LREAL": "<Q"}

# CP1252 where it differs from Latin-1. 81 8d 8f 90 9d have no character and decode as U+0081 and so on.
CP1252 = dict(zip(
    b"\x80\x82\x83\x84\x85\x86\x87\x88\x89\x8a\x8b\x8c\x8e\x91\x92\x93\x94\x95\x96\x97\x98\x99\x9a\x9b\x9c\x9e\x9f",
    "€‚ƒ„…†‡ˆ‰Š‹ŒŽ‘’“”•–—˜™š›œžŸ",
))

TEXT_MAX = 256
STREAM_MAX = 2048


class Malformed(Exception):
    """The error that a decoder raises for a malformed stream."""

    def __init__(self, cls, offset, field):
        super().__init__("%s at %d in %s" % (cls, offset, field))
        self.cls, self.offset, self.field = cls, offset, field


def to_hex(data):
    return " ".join("%02x" % byte for byte in data)


def from_hex(text):
    data = bytes.fromhex(text)
    if to_hex(data) != text:
        raise Bad("hex %r is not lower case with single spaces" % text)
    return data


def cp1252_text(data):
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
    # a NaN has many bit patterns, so its value does not determine the bits
    same = stored != stored if value != value else struct.pack(NUMBERS[kind], value) == data
    if not same:
        raise Bad("%s and %s are different numbers" % (tagged["value"], tagged["bits"]))
    return data


def count_of(context):
    """The number of elements: the product of the dimensions."""
    count = 1
    for dimension in context["dimensions"]:
        count *= dimension
    return count


def size_of(kind):
    return struct.calcsize(NUMBERS[kind])


def text(data):
    """A text with the bytes after its first NUL as `tail`, or with `open` if it has no NUL."""
    body, nul, tail = data.partition(b"\0")
    tagged = {"type": "STRING", "value": cp1252_text(body), "hex": to_hex(body)}
    if not nul:
        tagged["open"] = True
    elif tail:
        tagged["tail"] = to_hex(tail)
    return tagged


def text_bytes(tagged):
    body = from_hex(tagged["hex"])
    if cp1252_text(body) != tagged["value"]:
        raise Bad("%s decodes as %r, not %r" % (tagged["hex"], cp1252_text(body), tagged["value"]))
    if 0 in body:
        raise Bad("a NUL inside the text %r" % tagged["hex"])
    if tagged.get("open"):
        return body
    return body + b"\0" + from_hex(tagged.get("tail", ""))


def texts(data, at, count, field):
    """The texts in the rest of a stream: a single text has all bytes, several texts have equal shares."""
    size = len(data) - at
    if count > size and count > 1:
        raise Malformed("truncated", at, field)
    share = size // count
    if share * count != size:
        raise Malformed("bad-length", at + share * count, field)
    return [text(data[at + share * index:at + share * index + share]) for index in range(count)]


def text_field(data):
    """The value of a text in a field of fixed size: without `tail` if only zeros follow the text."""
    tagged = text(data)
    if not any(from_hex(tagged.get("tail", ""))):
        tagged.pop("tail", None)
    return tagged


def text_field_bytes(tagged, size):
    data = text_bytes(tagged).ljust(size, b"\0")
    if len(data) != size:
        raise Bad("%r takes %d bytes of %d" % (tagged["value"], len(data), size))
    return data


def request_text(data, at, field, may_be_absent=False):
    """A text of a request: a NUL ends it, and only NULs may follow."""
    if len(data) > TEXT_MAX:
        raise Malformed("too-long", at, field)
    if not data and may_be_absent:
        return text(data)
    if b"\0" not in data:
        raise Malformed("missing-nul", at, field)
    body, _, tail = data.partition(b"\0")
    for index, byte in enumerate(tail):
        if byte:
            raise Malformed("trailing", at + len(body) + 1 + index, field)
    return text(data)


TEXTS = {"TEXT16": 16, "TEXT32": 32}
SIZES = {"NETID": 6, **TEXTS}


def field_size(kind):
    return SIZES.get(kind) or size_of(kind)


def read_field(kind, data):
    if kind == "NETID":
        return {"type": "NETID", "value": ".".join(str(byte) for byte in data)}
    return text_field(data) if kind in TEXTS else number(kind, data)


def write_field(kind, tagged):
    if tagged["type"] != ("STRING" if kind in TEXTS else kind):
        raise Bad("type %s instead of %s" % (tagged["type"], kind))
    if kind == "NETID":
        return bytes(int(part) for part in tagged["value"].split("."))
    return text_field_bytes(tagged, TEXTS[kind]) if kind in TEXTS else number_bytes(tagged)


def read_fields(layout, data, at=0):
    """The fields from `at` on, and the offset after them."""
    value = {}
    for field, kind in layout:
        part = data[at:at + field_size(kind)]
        if len(part) < field_size(kind):
            raise Malformed("truncated", at, field)
        value[field] = read_field(kind, part)
        at += len(part)
    return value, at


def write_fields(layout, value, prefix=""):
    return [(prefix + field, write_field(kind, value[field])) for field, kind in layout]


def end(data, at, field):
    if len(data) > at:
        raise Malformed("trailing", at, field)


def plain(tagged):
    return int(tagged["value"])


def u32(value):
    return struct.pack("<I", value)


def join(parts):
    return b"".join(data for _, data in parts)


def fixed_stream(layout):
    def write(value, _context):
        return write_fields(layout, value)

    def read(data, _context):
        value, at = read_fields(layout, data)
        end(data, at, layout[-1][0])
        return value

    return write, read
