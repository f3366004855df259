"""A client of a CNC, written from the manuals with only Python's standard library; with client.py, an example for
`ads-cnc run --client`."""
import re
import socket
import struct
import time

TYPES = {"BOOLEAN": "?", "BOOL": "?", "SGN08": "b", "SINT": "b", "UNS08": "B", "BYTE": "B", "SGN16": "h",
         "INT": "h", "UNS16": "H", "WORD": "H", "SGN32": "i", "DINT": "i", "UNS32": "I", "DWORD": "I",
         "LINT": "q", "LWORD": "Q", "REAL32": "f", "REAL": "f", "REAL64": "d", "LREAL": "d"}
CLASSES = ["position-controller", "interpolator", "decoder", "hld", "path-preparation", "spindle"]
ATTRIBUTES = {"name": 0x100, "type": 0x200, "length": 0x300, "unit": 0x400, "writable": 0x500}
KINDS = {"P": 0, "V.L": 1, "V.P": 2, "V.S": 3}
READ, WRITE, BOTH = 2, 3, 9
SDA, COM = 552, 553


class Rejected(Exception):
    """The reply of the CNC contains an error number."""


class Wrong(Exception):
    """The reply is invalid, or the action cannot be executed."""


def check(condition, why):
    if not condition:
        raise Wrong(why)


def take(layout, data):
    check(len(data) == struct.calcsize(layout), f"{len(data)} bytes where {struct.calcsize(layout)} are expected")
    return struct.unpack(layout, data)


def number(data):
    return take("<I", data)[0]


def text(data):
    return data.split(b"\0")[0].decode("cp1252")


def nul(name):
    return name.encode("cp1252") + b"\0"


class Cnc:
    def __init__(self, where):
        self.socket = socket.create_connection((where["host"], int(where["tcp_port"])), 1.0)
        self.socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self.target = bytes(int(part) for part in where["net_id"].split("."))
        self.invoke = 0

    def receive(self, count):
        data = b""
        while len(data) < count:
            piece = self.socket.recv(count - len(data))
            check(piece, "the connection was closed")
            data += piece
        return data

    def ask(self, command, port, group, offset, data=b"", length=0):
        self.invoke += 1
        body = struct.pack("<II", group, offset)
        body += struct.pack("<I", length) if command != WRITE else b""
        body += struct.pack("<I", len(data)) + data if command != READ else b""
        ams = self.target + struct.pack("<H", port) + bytes([127, 0, 0, 1, 1, 2]) + struct.pack("<H", 0x8000)
        ams += struct.pack("<HHIII", command, 4, len(body), 0, self.invoke)
        self.socket.sendall(struct.pack("<HI", 0, len(ams + body)) + ams + body)
        while True:
            reserved, total = struct.unpack("<HI", self.receive(6))
            check(reserved == 0 and 32 <= total <= 0x10000, "no AMS/TCP header")
            frame = self.receive(total)
            got, flags, size, error, invoke = struct.unpack("<HHIII", frame[16:32])
            check(size == total - 32, "the lengths of the headers differ")
            if invoke == self.invoke:
                break
        check((got, flags) == (command, 5), "no answer to this command")
        if error:
            raise Rejected(error)
        result = number(frame[32:36])
        if result:
            raise Rejected(result)
        if command == WRITE:
            check(total == 36, "the reply to a Write contains data")
            return b""
        check(len(frame) >= 40 and number(frame[36:40]) == len(frame) - 40 <= length, "a wrong length before the data")
        return frame[40:]

    def variable(self, channel, offset, data, length):
        return self.ask(BOTH, SDA, 0x122300 + int(channel), offset, data, length)

    def count_objects(self, channel):
        return number(self.ask(READ, COM, 0x130100 + int(channel), 0, length=4))

    def objects(self, channel):
        found, count = [], self.count_objects(channel)
        while len(found) < count:
            wanted = min(count - len(found), 64) * 84
            data = self.ask(READ, COM, 0x130100 + int(channel), len(found) + 1, length=wanted)
            check(data and len(data) % 84 == 0, "the reply does not consist of whole descriptors")
            for _, size, access, _, group, offset, name, kind in struct.iter_unpack("<IIHHII32s32s", data):
                found.append({"name": text(name), "type": text(kind), "size": size, "writable": access != 0,
                              "group": group, "offset": offset})
        return found


def kind_of(name):
    """Splits a type such as `SGN16[2,3]` into its name and the number of elements.

    >>> kind_of("SGN16[2,3]")
    ('SGN16', 6)
    >>> kind_of("STRING")
    ('STRING', 1)
    >>> for name in "SGN99", "STRING(32)", "":
    ...     try:
    ...         kind_of(name)
    ...     except Wrong as wrong:
    ...         print(wrong)
    the type 'SGN99' is unknown
    the type 'STRING(32)' is unknown
    the type '' is unknown
    """
    parts = re.fullmatch(r"(\w+)(?:\[(.*)\])?", name)
    check(parts and parts[1] in (*TYPES, "STRING"), f"the type {name!r} is unknown")
    count = 1
    for size in (parts[2] or "1").split(","):
        count *= int(size)
    return parts[1], count


def decode(kind, data):
    name, count = kind_of(kind)
    return text(data) if name == "STRING" else list(take(f"<{count}{TYPES[name]}", data))


def encode(kind, value):
    name, count = kind_of(kind)
    if name == "STRING":
        return nul(value)
    parse = {"?": lambda one: one == "TRUE", "f": float, "d": float}.get(TYPES[name], int)
    values = [parse(one) for one in value.split(",")]
    return struct.pack(f"<{count}{TYPES[name]}", *values)


def element(cnc, word, kind, channel, axis, place=0):
    attribute, place = ATTRIBUTES.get(word, 0), int(place)
    index, axis = CLASSES.index(kind), int(axis)
    group = (0x020300 if kind == "spindle" else 0x120300) + index * 0x1000 + attribute + int(channel)
    offset = axis * 0x10000 + place
    if kind == "hld" and axis or kind == "position-controller":
        group, first = struct.unpack("<II", find(cnc, kind, channel, axis))
        group, offset = group + attribute, first + place
    return lambda length: cnc.ask(READ, SDA, group, offset, length=length), group, offset


def find(cnc, kind, channel, axis):
    base = 0x020900 if kind == "spindle" else 0x120900
    return cnc.ask(BOTH, SDA, base + CLASSES.index(kind) * 0x1000, 0, struct.pack("<II", int(channel), int(axis)), 8)


def describe(cnc, channel, index, kind):
    data = cnc.variable(channel, 0x45, struct.pack("<I", int(index)) + nul(kind), 2048)
    handle, ty, access, size, count = take("<5I", data[:20])
    check(20 + 4 * count <= len(data), "the reply has fewer dimensions than its count states")
    dimensions = list(struct.unpack_from(f"<{count}I", data, 20))
    return {"name": text(data[20 + 4 * count:]), "handle": handle, "type": ty, "access": access, "size": size,
            "dimensions": dimensions}


def handled(handle, indices):
    places = [] if indices == "-" else [int(one) for one in indices.split(",")]
    return struct.pack(f"<II{len(places)}I", int(handle), len(places), *places)


def without_comments(line):
    """Returns a line with spaces instead of comments and quoted text; parentheses nest.

    >>> without_comments(b'N10 (a (b) " c) "d ; (" G1 ;e').split()
    [b'N10', b'G1']
    """
    kept, depth = b"", 0
    while line:
        token = re.match(rb"." if depth else rb'"[^"]*"|;.*|.', line)[0]
        line = line[len(token):]
        depth += token == b"("
        kept += b" " if depth or len(token) > 1 else token
        depth -= token == b")" and depth > 0
    return kept


def has_loop(lines):
    """Returns whether a line contains a keyword of a loop outside comments and quoted text. A block of comments
    without an end continues to the last line.

    >>> all(has_loop([line]) for line in (b"N10 $FOR", b"X1 $for", b"(a (b)) $Do", b'"(" $DO', b"$UNTIL1"))
    True
    >>> any(has_loop([line]) for line in (b"N10 ;$FOR", b"(a (b) $FOR", b'#MSG ["$FOR"]', b"$FORX", b"FOR"))
    False
    >>> has_loop([b"N1 #comment begin", b"$DO", b"/ N2 #COMMENT END", b"X1"])
    False
    >>> has_loop([b"#COMMENT BEGIN", b"#COMMENT END", b"$DO"])
    True
    >>> has_loop([b"\\x0b#COMMENT BEGIN", b"$DO"])
    True
    """
    in_comment = False
    for line in lines:
        block = re.match(rb"[ \t]*(?:/\d*[ \t]*)?(?:N[ \t]*\d+[ \t]*)?#COMMENT[ \t]+(BEGIN|END)(?![\w.])", line, re.I)
        if block:
            in_comment = block[1].upper() == b"BEGIN"
        elif not in_comment and re.search(
                rb"\$(FOR|ENDFOR|DO|ENDDO|REPEAT|UNTIL|WHILE|ENDWHILE)(?![A-Z])", without_comments(line), re.I):
            return True
    return False


def packets_of(program):
    """Divides a program into packets of whole lines. CR LF, LF and CR each end a line.

    >>> packets_of(b"N10\\rN20\\n\\r\\nM30")
    [b'N10\\r\\nN20\\r\\n\\r\\nM30\\r\\n']
    >>> [len(packet) for packet in packets_of(b"x" * 489 + b"\\r" + b"x" * 499 + b"\\ny")]
    [992, 3]
    """
    lines = program.splitlines()
    can_stream = [len(line) <= 990 and line.isascii() and b"\0" not in line for line in lines]
    check(all(can_stream), "a line cannot be streamed")
    check(not has_loop(lines), "the program contains a loop")
    packets = []
    for line in lines:
        if not packets or len(packets[-1] + line) + 2 > 992:
            packets.append(b"")
        packets[-1] += line + b"\r\n"
    return packets


def stream(cnc, channel, file):
    with open(file, "rb") as program:
        packets = packets_of(program.read())
    for packet in packets:
        for tries in range(100):
            try:
                cnc.ask(WRITE, COM, 0x120100 + int(channel), 0x90, packet)
                break
            except Rejected as rejected:
                # These errors are permanent; any other error may mean that the CNC is busy now.
                if rejected.args[0] in (0x701, 0x702, 0x703, 0x704, 0x705) or tries == 99:
                    raise
                time.sleep(0.02)


def service(cnc, channel, name, value=None):
    name = nul("V.G.SERVICE." + name)
    if value is None:
        return cnc.variable(channel, 0x48, name, 2048)
    return cnc.ask(WRITE, SDA, 0x122300 + int(channel), 0x4A, name + value)


def serve(cnc, channel, uuid, requests, seconds):
    answered, end = 0, time.monotonic() + float(seconds)
    while answered < int(requests) and time.monotonic() < end:
        asked = number(service(cnc, channel, "REQUEST_STATE")) != 0
        if not asked or text(service(cnc, channel, "UUID")).lower() != uuid.lower():
            time.sleep(0.02)
            continue
        response = nul(text(service(cnc, channel, "REQUEST")))
        service(cnc, channel, "RESPONSE", response)
        service(cnc, channel, "REQUEST_STATE", struct.pack("<I", 0))
        service(cnc, channel, "RESPONSE_STATE", struct.pack("<I", 1))
        answered += 1
    return answered


def ask_service(cnc, channel, uuid, request):
    service(cnc, channel, "UUID", nul(uuid))
    service(cnc, channel, "REQUEST", nul(request))
    service(cnc, channel, "REQUEST_STATE", struct.pack("<I", 1))
    end = time.monotonic() + 3
    while number(service(cnc, channel, "RESPONSE_STATE")) == 0:
        check(time.monotonic() < end, "no response in time")
        time.sleep(0.02)
    return text(service(cnc, channel, "RESPONSE"))


def element_content(cnc, *where, kind):
    name, count = kind_of(kind)
    read, _, _ = element(cnc, "", *where)
    return decode(kind, read(struct.calcsize(f"<{count}{TYPES[name]}")))


def write_element(cnc, kind, channel, axis, place, ty, value):
    _, group, offset = element(cnc, "", kind, channel, axis, place)
    cnc.ask(WRITE, SDA, group, offset, encode(ty, value))


def named(cnc, channel, name):
    found = [one for one in cnc.objects(channel) if one["name"] == name]
    check(found, "there is no such object")
    return found[0]


def read_object(cnc, channel, name):
    one = named(cnc, channel, name)
    return decode(one["type"], cnc.ask(READ, COM, one["group"], one["offset"], length=one["size"]))


def write_object(cnc, channel, name, value):
    one = named(cnc, channel, name)
    cnc.ask(WRITE, COM, one["group"], one["offset"], encode(one["type"], value))


def extended(cnc, channel, index, kind):
    data = cnc.variable(channel, 0x4B, struct.pack("<I", int(index)) + nul(kind), 8)
    return dict(zip(("synchronisation", "validity"), take("<II", data))) if data else None


def instance(cnc, *where):
    group, offset = take("<II", find(cnc, *where))
    return [group, offset] if group or offset else None


def write_variable(cnc, channel, offset, data):
    cnc.ask(WRITE, SDA, 0x122300 + int(channel), offset, data)


def parameter(cnc, channel, kind, offset, data, length):
    return cnc.variable(channel, offset + 3 * KINDS[kind], data, length)


def index(number):
    return struct.pack("<I", int(number))
