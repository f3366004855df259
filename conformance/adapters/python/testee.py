#!/usr/bin/env python3
"""A codec for the byte streams of an ISG/TwinCAT CNC, as a testee of `ads-cnc run --testee`.

It needs only Python's standard library. To test your own codec, keep `answer` and call your codec in `work`.
"""
import itertools
import json
import math
import re
import struct
import sys

class Rejected(Exception):
    """The bytes or the value are invalid; the argument is the class of the error."""

class Unsupported(Exception):
    """This testee does not support the part of the case that the argument names."""

# Fields: each function takes bytes, and returns a value as in the JSON and the bytes after it. Only reading
# checks the rules; `write` checks none, because `encode` decodes the encoded bytes again.

FORMS = {"BOOLEAN": "B", "UNS08": "B", "SGN08": "b", "UNS16": "<H", "SGN16": "<h", "UNS32": "<I", "SGN32": "<i",
         "REAL32": "<I", "REAL64": "<Q", "BOOL": "B", "BYTE": "B", "WORD": "<H", "DWORD": "<I", "LWORD": "<Q",
         "SINT": "b", "INT": "<h", "DINT": "<i", "LINT": "<q", "REAL": "<I", "LREAL": "<Q"}

def leaf(kind, value):
    return {"type": kind, "value": str(value)}

def within(data, least, most):
    if not least <= len(data) <= most:
        raise Rejected("truncated" if len(data) < least else "too-long")
    return data

def take(data, size):
    return within(data, size, math.inf)[:size], data[size:]

def numbers(data, count, kind):
    form = struct.Struct(FORMS[kind])
    items, data = take(data, count * form.size)  # check the length before building the list
    found = [item for item, in form.iter_unpack(items)]
    if "REAL" in kind:  # keep the bits: a conversion to float would change some NaNs
        return [{"type": kind, "bits": "0x%0*x" % (2 * form.size, item)} for item in found], data
    return [leaf(kind, item) for item in found], data

def number(kind, least=None):
    def read(data):
        (value,), data = numbers(data, 1, kind)
        if least is not None and int(value["value"]) < least:
            raise Rejected("out-of-range")
        return value, data
    return read

def counted(data):  # items after a field that contains their number
    count, data = UNS32(data)
    return numbers(data, int(count["value"]), "UNS32")

def elements(context):  # the context contains their type and number
    kind, count = context.get("type"), math.prod(context.get("dimensions", []))
    if kind != "STRING" and kind not in FORMS:
        raise Unsupported("context")
    return lambda data: (texts(data, count), b"") if kind == "STRING" else numbers(data, count, kind)

def texts(data, count):  # the texts of an array have the same size, at least one byte
    size = len(data) // max(count, 1)
    if size * count != len(data) or count > 1 and not size:
        raise Rejected("bad-length")
    return [text()(data[size * place:][:size])[0] for place in range(count)]

def net_id(data):
    six, data = take(data, 6)
    return leaf("NETID", ".".join(map(str, six))), data

def raw(least=0, most=math.inf):
    return lambda data: ({"type": "BYTES", "hex": within(data, least, most).hex(" ")}, b"")

def sized(data):
    size, data = UNS32(data)
    found, data = take(data, int(size["value"]))
    return raw()(found)[0], data

def string(data, nul=b"", tail=b""):
    value = {"type": "STRING", "hex": data.hex(" ")}
    return dict(value, open=True) if not nul else dict(value, tail=tail.hex(" ")) if tail else value

def text(least=0, most=math.inf, closed=False, padded=False):
    """A text ends at its first NUL or, unless `closed`, with the stream. `padded`: only NULs may follow."""
    def read(data):
        found, nul, tail = within(data, least, most).partition(b"\0")
        if closed and not nul or padded and tail.strip(b"\0"):
            raise Rejected("trailing" if nul else "missing-nul")
        return string(found, nul, tail), b""
    return read

def text32(data):
    field, data = take(data, 32)
    found, nul, tail = field.partition(b"\0")
    return string(found, nul, tail.strip(b"\0") and tail), data  # omit a tail that consists of NULs

def name_before(data):  # the name before a value ends with its first NUL
    name, data = take(data, data.find(b"\0") + 1 or len(data))
    return text(1, 256, closed=True)(name)[0], data

def descriptors(data):
    return [DESCRIPTOR.get(data[at:at + 84]) for at in range(0, len(within(data, 84, math.inf)), 84)], b""

def write(value):
    if isinstance(value, list):
        return b"".join(map(write, value))
    if isinstance(value["type"], dict):  # a field called `type`: only descriptors are records in a list
        return DESCRIPTOR.put(value)
    if value["type"] == "NETID":
        return bytes(map(int, value["value"].split(".")))
    if "hex" not in value:
        return struct.pack(FORMS[value["type"]], int(value.get("bits") or value["value"], 0))
    nul = "00" if value["type"] == "STRING" and "open" not in value else ""
    return bytes.fromhex(value["hex"] + nul + value.get("tail", ""))

# Streams: `get` decodes all bytes to a value, `put` encodes a value.

class Record:
    """Fields in order. The stream may end after the fields in `value` if `ends(value)`. `width`: size of texts."""
    def __init__(self, most=math.inf, ends=lambda value: False, width=0, **fields):
        self.most, self.ends, self.width, self.fields = most, ends, width, fields

    def get(self, data):
        value, data = {}, within(data, 0, self.most)
        for name, read in self.fields.items():
            if data or not self.ends(value):
                value[name], data = read(data)
        if data:
            raise Rejected("trailing")
        return value

    def put(self, value):
        stream = b""
        for name, read in self.fields.items():
            if name in value:
                part = write(value[name])
                if read in (counted, sized):
                    stream += struct.pack("<I", len(value[name] if read is counted else part))
                stream += part.ljust(self.width, b"\0") if "hex" in value[name] else part
        return stream

class Frame:
    """An AMS/TCP frame. Its value omits the lengths in both headers, because the data determines them."""
    SERVICES = {("2", "4"): "read_request", ("3", "4"): "write_request", ("9", "4"): "read_write_request",
                ("2", "5"): "read_reply", ("3", "5"): "write_reply", ("9", "5"): "read_write_reply"}

    def get(self, data):
        tcp, ams, data = STREAMS["ams_tcp_header"].get(data[:6]), STREAMS["ams_header"].get(data[6:38]), data[38:]
        lengths = int(tcp.pop("length")["value"]) - 32, int(ams.pop("data_length")["value"])
        if tcp["reserved"]["value"] != "0" or lengths != (len(data), len(data)):
            raise Rejected("mismatch")
        value = {"ams_tcp_header": tcp, "ams_header": ams}
        service = self.SERVICES.get((ams["command"]["value"], ams["state_flags"]["value"]))
        if data or ams["error"]["value"] == "0":  # an error reply may have no data
            value[service or "data"] = STREAMS[service].get(data) if service else raw()(data)[0]
        return value

    def put(self, value):
        data = b"".join(write(part) if name == "data" else STREAMS[name].put(part)
                        for name, part in value.items() if name not in ("ams_tcp_header", "ams_header"))
        tcp = dict(value["ams_tcp_header"], length=leaf("UNS32", len(data) + 32))
        ams = dict(value["ams_header"], data_length=leaf("UNS32", len(data)))
        return STREAMS["ams_tcp_header"].put(tcp) + STREAMS["ams_header"].put(ams) + data

class Path:
    """The name of a variable, such as V.G.NP[0].V[1], split into its parts."""
    PART = rb"\.([^.\[\]\0]+)((?:\[[0-9]+\])*)"
    def get(self, data):
        found = re.fullmatch(rb"(V\.[^.\[\]\0]+)((?:%s)+)" % self.PART, within(data, 0, 255))
        if not found or any(int(n) > 4294967294 for n in re.findall(rb"\[([0-9]+)", found[2])):
            raise Rejected("unexpected")
        return {"kind": string(found[1]), "parts": [
            {"name": string(name), "indices": [leaf("UNS32", int(n)) for n in re.findall(rb"[0-9]+", indices)]}
            for name, indices in re.findall(self.PART, found[2])]}

    def put(self, value):
        return write(value["kind"]) + b"".join(b"." + write(part["name"]) + b"".join(
            b"[%d]" % int(index["value"]) for index in part["indices"]) for part in value["parts"])

class Group(Record):
    """An index group, with its parts if its bits match the tables of COM, or of SDA and GEO."""
    CLASSES = ["position-controller", "interpolator", "decoder", "hld", "path-preparation", "spindle"]
    ATTRIBUTES = ["content", "name", "type", "length", "unit", "write-flag", "object-address"]
    def __init__(self, context):
        super().__init__(index_group=UNS32)
        self.base = context.get("base")

    def get(self, data):
        value = super().get(data)
        group = int(value["index_group"]["value"])
        if self.base and not 0 <= group - int(self.base, 16) <= 255:
            raise Rejected("out-of-range")
        access, logical, block, table = group >> 16 & ~16, group >> 20 & 1, group >> 12 & 15, group >> 8 & 15
        if access in (2, 3) and block == 0 and table in (1, 2):
            words = {"task": "COM", "table": ["channel", "axis"][table - 1]}
        elif access == 2 and 3 <= table <= 9 and block <= 5 - logical:  # spindles have no logical address
            words = {"task": "SDA/GEO", "class": self.CLASSES[block], "attribute": self.ATTRIBUTES[table - 3]}
        else:
            return value
        words.update(access=["element", "object"][access - 2], addressing=["index", "logical"][logical])
        named = {name: leaf("NAME", word) for name, word in words.items()}
        return dict(value, **named, instance=leaf("UNS08", group & 255))

class Offset(Record):
    """An index offset, split into axis and element; the context contains the stride."""
    def __init__(self, context):
        super().__init__(offset=UNS32)
        if context.get("stride") not in ("0x1000", "0x10000"):
            raise Unsupported("context")
        self.stride = int(context["stride"], 16)

    def get(self, data):
        axis, element = divmod(int(super().get(data)["offset"]["value"]), self.stride)
        if axis > 0xFFFF:
            raise Rejected("out-of-range")
        return {"axis": leaf("UNS16", axis), "element": leaf("UNS16", element)}

    def put(self, value):
        return struct.pack("<I", int(value["axis"]["value"]) * self.stride + int(value["element"]["value"]))

UNS16, UNS32, REQUEST = number("UNS16"), number("UNS32"), text(0, 256, closed=True, padded=True)
ADDRESS, HANDLE = {"index_group": UNS32, "index_offset": UNS32}, {"handle": UNS32, "indices": counted}
DESCRIPTION = {"handle": UNS32, "type": UNS32, "access": UNS32, "size": UNS32, "dimensions": counted}
DESCRIPTOR = Record(id=UNS32, size=UNS32, write_access=UNS16, not_assigned=UNS16, **ADDRESS,
                    name=text32, type=text32, width=32)
COUNT = Record(count=UNS32)
REPLY = Record(result=UNS32, data=sized, ends=lambda value: value and value["result"]["value"] != "0")

STREAMS = dict(  # names with _ instead of -; a stream that needs the context is a function of it
    ams_tcp_header=Record(reserved=UNS16, length=UNS32),
    ams_header=Record(target_net_id=net_id, target_port=UNS16, source_net_id=net_id, source_port=UNS16,
                      command=UNS16, state_flags=UNS16, data_length=UNS32, error=UNS32, invoke_id=UNS32),
    ams_frame=Frame(), read_request=Record(**ADDRESS, length=UNS32), read_reply=REPLY,
    write_request=Record(**ADDRESS, data=sized), write_reply=Record(result=UNS32),
    read_write_request=Record(**ADDRESS, read_length=UNS32, data=sized), read_write_reply=REPLY,
    object_count=COUNT, object_descriptor=DESCRIPTOR, object_descriptors=Record(descriptors=descriptors),
    content=lambda context: Record(4194304, content=elements(context) if context else raw()),
    object_address_query=Record(channel=UNS32, axis=UNS32), object_address=Record(**ADDRESS),
    element_count=COUNT, element_text=Record(text=text(0, 256)), element_write_flag=Record(flag=number("BOOLEAN")),
    element_length=Record(length=lambda data: number({1: "UNS08", 2: "UNS16"}.get(len(data), "UNS32"))(data)),
    dynamic_count=COUNT, dynamic_index=Record(index=number("UNS32", 1)), dynamic_value=Record(value=number("REAL64")),
    dynamic_name=Record(name=text(1, 96)), dynamic_name_request=Record(name=text(1, 96, padded=True)),
    variable_kind=Record(kind=lambda data: REQUEST(data) if data else text()(data)),  # may be empty
    variable_count=COUNT, variable_index_kind=Record(index=UNS32, kind=REQUEST),
    variable_description=Record(2048, **DESCRIPTION, name=text(1, 256)),
    variable_description_by_name=Record(2048, **DESCRIPTION), variable_handle_read=Record(2048, **HANDLE),
    variable_name=Record(name=REQUEST), variable_handle=Record(handle=UNS32),
    variable_handle_write=lambda context: Record(2048, **HANDLE, value=elements(context)),
    variable_name_write=lambda context: Record(2048, name=name_before, value=elements(context)),
    variable_value=lambda context: Record(2048, value=elements(context)),
    variable_extended_description=Record(synchronisation=UNS32, validity=UNS32, ends=lambda value: not value),
    variable_path=Path(), program_stream=Record(data=raw(1, 992)), index_group=Group, index_offset=Offset)

def encode(stream, value):
    try:
        data = stream.put(value)
    except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError, struct.error):
        raise Rejected("mismatch") from None  # the value does not have the structure of the stream
    if stream.get(data) != value:
        raise Rejected("mismatch")
    return data

OPS, EDITIONS = ["decode", "encode"], ["en-1.05", "de-1.051"]  # the streams do not depend on the edition
NAMES = [name.replace("_", "-") for name in STREAMS]
HELLO = {"protocol": 1, "testee": {"name": "example", "version": "1.0", "language": "Python"},
         "capabilities": {"ops": OPS, "streams": NAMES, "editions": EDITIONS}}

def deciding(part):  # removes the readable `value` if `bits` or `hex` is present
    return {name: part[name] for name in part if name != "value" or not {"bits", "hex"} & set(part)}

def work(case):
    for what, known in (("op", OPS), ("stream", NAMES), ("edition", EDITIONS)):
        if case[what] not in known:
            raise Unsupported(what)
    stream = STREAMS[case["stream"].replace("-", "_")]
    stream = stream(case["context"]) if callable(stream) else stream
    if case["op"] == "decode":
        return {"value": stream.get(bytes.fromhex(case["hex"]))}
    return {"hex": encode(stream, case["value"]).hex()}

def answer(line):
    seq = None
    try:
        asked = json.loads(line, object_hook=deciding)
        if asked["cmd"] in ("hello", "bye"):
            return HELLO if asked["cmd"] == "hello" else None
        seq = asked["seq"]
        return {"seq": seq, "ok": work(asked)}
    except Rejected as fault:
        return {"seq": seq, "reject": {"class": fault.args[0]}}
    except Unsupported as fault:
        return {"seq": seq, "unsupported": {"what": fault.args[0]}}
    except Exception as fault:  # answer any other error, too, to continue with the next line
        return {"seq": seq, "error": {"message": repr(fault)}}

if __name__ == "__main__":
    for reply in itertools.takewhile(bool, map(answer, sys.stdin.buffer)):
        print(json.dumps(reply), flush=True)
