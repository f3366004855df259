"""Streams of the COM task: the number of objects, and their descriptors."""
from .scalars import Malformed, fixed_stream, read_fields, write_fields

DESCRIPTOR = 84
LAYOUT = [
    ("id", "UNS32"), ("size", "UNS32"), ("write_access", "UNS16"), ("not_assigned", "UNS16"),
    ("index_group", "UNS32"), ("index_offset", "UNS32"), ("name", "TEXT32"), ("type", "TEXT32"),
]


def descriptors_write(value, _context):
    parts = []
    for index, item in enumerate(value["descriptors"]):
        parts += write_fields(LAYOUT, item, "descriptors[%d]." % index)
    return parts


def descriptors_read(data, _context):
    if not data or len(data) % DESCRIPTOR:
        raise Malformed("bad-length", len(data) - len(data) % DESCRIPTOR, "descriptors")
    steps = range(0, len(data), DESCRIPTOR)
    return {"descriptors": [read_fields(LAYOUT, data, at)[0] for at in steps]}


STREAMS = {
    "object-count": fixed_stream([("count", "UNS32")]),
    "object-descriptor": fixed_stream(LAYOUT),
    "object-descriptors": (descriptors_write, descriptors_read),
}
