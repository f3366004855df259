"""The ADS services, the headers before them, and whole frames."""
from .scalars import (
    Bad, Malformed, end, fixed_stream, from_hex, join, plain, read_fields, to_hex, u32, write_fields,
)

TCP_HEADER = [("reserved", "UNS16"), ("length", "UNS32")]
HEADER = [
    ("target_net_id", "NETID"), ("target_port", "UNS16"), ("source_net_id", "NETID"), ("source_port", "UNS16"),
    ("command", "UNS16"), ("state_flags", "UNS16"), ("data_length", "UNS32"), ("error", "UNS32"),
    ("invoke_id", "UNS32"),
]
ADDRESS = [("index_group", "UNS32"), ("index_offset", "UNS32")]


def counted_data(head, length_field, result_first):
    """The functions for a stream of fixed fields, a length, and data of this length."""
    layout = head + [(length_field, "UNS32")]

    def write(value, _context):
        parts = write_fields(head, value)
        if result_first and "data" not in value:
            if plain(value["result"]) == 0:
                raise Bad("success without data")
            return parts
        if value["data"]["type"] != "BYTES":
            raise Bad("data is not of type BYTES")
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
            raise Malformed("truncated", at, "data")
        end(data, at + length, "data")
        value["data"] = {"type": "BYTES", "hex": to_hex(data[at:at + length])}
        return value

    return write, read


SERVICES = {2: "read", 3: "write", 9: "read_write"}
DIRECTIONS = {0x0004: "request", 0x0005: "reply"}
AMS_HEADER = 32
HEADERS = 6 + AMS_HEADER


def part_name(header):
    """The name of the part after an AMS header: the stream of a service, or `data` for other commands."""
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
    return (write_fields(TCP_HEADER, dict(value["ams_tcp_header"], **counts), "ams_tcp_header.")
            + write_fields(HEADER, dict(header, **counts), "ams_header.") + parts)


def within(prefix, at, read):
    """Decode a part, with the position of a fault relative to the whole stream."""
    try:
        return read()
    except Malformed as why:
        raise Malformed(why.cls, at + why.offset, "%s.%s" % (prefix, why.field)) from None


def frame_read(data, context):
    tcp, at = within("ams_tcp_header", 0, lambda: read_fields(TCP_HEADER, data))
    if plain(tcp["reserved"]) != 0:
        raise Malformed("mismatch", 0, "ams_tcp_header.reserved")
    length = plain(tcp.pop("length"))
    if length < AMS_HEADER:
        raise Malformed("out-of-range", 2, "ams_tcp_header.length")
    header, _ = within("ams_header", at, lambda: read_fields(HEADER, data[at:]))
    if plain(header.pop("data_length")) != length - AMS_HEADER:
        raise Malformed("mismatch", 26, "ams_header.data_length")
    value = {"ams_tcp_header": tcp, "ams_header": header}
    rest, name = data[HEADERS:], part_name(header)
    if len(rest) < length - AMS_HEADER:
        raise Malformed("truncated", HEADERS, name)
    end(data, 6 + length, name)
    if not rest and plain(header["error"]) != 0:
        return value
    if name == "data":
        return dict(value, data={"type": "BYTES", "hex": to_hex(rest)})
    read = STREAMS[name.replace("_", "-")][1]
    return dict(value, **{name: within(name, HEADERS, lambda: read(rest, context))})


STREAMS = {
    "ams-tcp-header": fixed_stream(TCP_HEADER),
    "ams-header": fixed_stream(HEADER),
    "read-request": fixed_stream(ADDRESS + [("length", "UNS32")]),
    "read-reply": counted_data([("result", "UNS32")], "length", True),
    "write-request": counted_data(ADDRESS, "length", False),
    "write-reply": fixed_stream([("result", "UNS32")]),
    "read-write-request": counted_data(ADDRESS + [("read_length", "UNS32")], "write_length", False),
    "read-write-reply": counted_data([("result", "UNS32")], "length", True),
    "device-info-reply": fixed_stream([
        ("result", "UNS32"), ("major", "UNS08"), ("minor", "UNS08"), ("build", "UNS16"), ("name", "TEXT16"),
    ]),
    "device-state-reply": fixed_stream([("result", "UNS32"), ("ads_state", "UNS16"), ("device_state", "UNS16")]),
    "ams-frame": (frame_write, frame_read),
}
