"""What the functions and streams have in common; the tables are the library's."""

from __future__ import annotations

import ctypes
import math
import struct
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, Generic, NamedTuple, Optional, TypeVar, Union

from . import _abi
from ._abi import UINT32

T = TypeVar("T")
# What a field may be written from.
Value = Union[int, float, str, bytes, Sequence[int]]


class AdsCncError(ValueError):
    """Bytes, or a value, that cannot be.

    `stream` and `field` are names, `offset` is where the field begins in the stream; the meaning of
    `expected` and `found` depends on `kind`.
    """

    def __init__(self, error: _abi.Error) -> None:
        self.kind: str = error.text.text()
        self.stream: str = error.subject.text()
        self.field: str = error.name.text()
        self.offset: int = error.offset
        self.expected: int = error.expected
        self.found: int = error.found
        # The number that a server returns; 0 for an error of a client.
        self.ads_error = 0
        numbers = f"expected {self.expected}, found {self.found}" if self.expected or self.found else ""
        place = ": ".join(part for part in (self.stream, self.field) if part)
        super().__init__(
            f"{place} at offset {self.offset}: {self.kind}" + (f", {numbers}" if numbers else "")
        )


def _call(name: str, *arguments: Any) -> None:
    error = _abi.Error()
    if not _abi.function(name)(*arguments, ctypes.byref(error)):
        raise AdsCncError(error)


def _sized(name: str, room: int, *arguments: Any) -> bytes:
    """Calls a function that fills a buffer; gives it the room it asks for if this is too little."""
    while True:
        buffer, length, error = (ctypes.c_uint8 * room)(), UINT32(), _abi.Error()
        if _abi.function(name)(*arguments, buffer, UINT32(room), ctypes.byref(length), ctypes.byref(error)):
            return bytes(memoryview(buffer)[: length.value])
        if error.kind not in (15, 37) or error.expected <= room:
            raise AdsCncError(error)
        room = error.expected


def text_from_cp1252(data: bytes) -> str:
    """The text before the first NUL, or all."""
    return _sized("text_to_utf8", 3 * len(data), data, UINT32(len(data))).decode()


def text_to_cp1252(text: str) -> bytes:
    """The text without a NUL."""
    data = text.encode()
    return _sized("text_from_utf8", len(data), data, UINT32(len(data)))


class FieldInfo(NamedTuple):
    """A row of a stream's table."""

    name: str
    meaning: str
    clause: str
    kind: int
    size: int
    is_count: bool
    is_list: bool


class Stream(NamedTuple):
    """A stream, by its table."""

    name: str
    title: str
    max: int
    repeats: bool
    fields: tuple[FieldInfo, ...]
    number: int


class Function(NamedTuple):
    """A function of the CNC."""

    name: str
    operation: str
    port: int
    command: int
    effect: int
    request: Optional[str]
    reply: Optional[str]
    arguments: tuple[str, ...]
    number: int


def _stream(number: int, it: _abi.StreamInfo) -> Stream:
    rows = _abi.each("field_info", _abi.FieldInfo, number)
    fields = tuple(
        FieldInfo(
            row.name.text(),
            row.meaning.text(),
            row.clause.text(),
            row.kind,
            row.size,
            bool(row.is_count),
            bool(row.is_list),
        )
        for row in rows
    )
    return Stream(it.name.text(), it.title.text(), it.max, bool(it.repeats), fields, number)


_STREAMS = [_stream(at, it) for at, it in enumerate(_abi.each("stream_info", _abi.StreamInfo))]
STREAMS = {stream.name: stream for stream in _STREAMS}


def _name(stream: int) -> Optional[str]:
    return None if stream == _abi.NONE else _STREAMS[stream].name


def _argument(number: int) -> str:
    name = _abi.Bytes()
    _abi.function("argument_name")(UINT32(number), ctypes.byref(name))
    return name.text()


FUNCTIONS = [
    Function(
        it.name.text(),
        it.operation.text(),
        it.port,
        it.command,
        it.effect,
        _name(it.request),
        _name(it.reply),
        tuple(map(_argument, it.arguments[: it.argument_count])),
        number,
    )
    for number, it in enumerate(_abi.each("function_info", _abi.FunctionInfo))
]


class Field(NamedTuple):
    """A field of a decoded stream, or an item of a list."""

    name: str
    record: int
    item: int
    offset: int
    data: bytes


def _fields(stream: Stream, data: bytes, name: str, *before: Any) -> list[Field]:
    room = 64
    while True:
        array, count, error = (_abi.Field * room)(), UINT32(), _abi.Error()
        given = (data, UINT32(len(data)), array, UINT32(room), ctypes.byref(count), ctypes.byref(error))
        if _abi.function(name)(*before, *given):
            return [
                Field(
                    stream.fields[it.field].name,
                    it.record,
                    it.item,
                    it.offset,
                    data[it.offset :][: it.length],
                )
                for it in array[: count.value]
            ]
        if error.kind != 37:
            raise AdsCncError(error)
        room = count.value


def fields(stream: str, data: bytes) -> list[Field]:
    """The fields of a stream, with their bytes."""
    it = STREAMS[stream]
    return _fields(it, data, "decode", UINT32(it.number))


def join(stream: str, parts: Sequence[tuple[str, bytes]]) -> bytes:
    """A stream from the bytes of its fields, the reverse of `fields`. Counts may be left out."""
    it = STREAMS[stream]
    numbers = {row.name: at for at, row in enumerate(it.fields)}
    array = (_abi.Part * len(parts))(*(_abi.Part(numbers[name], 0, _some(data)) for name, data in parts))
    room = 64 + sum(len(data) for _, data in parts)
    return _sized("build", room, UINT32(it.number), array, UINT32(len(parts)))


_EMPTY = ctypes.create_string_buffer(1)


def _some(data: bytes) -> _abi.Bytes:
    """Not null, which would mean that the part is a number."""
    return _abi.lent(data) if data else _abi.Bytes(ctypes.cast(_EMPTY, ctypes.c_void_p), 0)


def _read(row: FieldInfo, data: bytes) -> Any:
    if row.kind == 1:
        return int.from_bytes(data, "little")
    if row.kind == 2:
        return data != b"\0"
    if row.kind == 3:
        return struct.unpack("<d", data)[0]
    if row.kind == 4:
        return text_from_cp1252(data)
    return ".".join(map(str, data)) if row.kind == 5 else data


def _write(row: FieldInfo, value: Any) -> bytes:
    if isinstance(value, (bytes, bytearray)):
        return bytes(value)
    if row.kind in (1, 2):
        try:
            return int(value).to_bytes(row.size or 4, "little")
        except OverflowError:
            raise ValueError(f"{row.name}: {value} is no number of {row.size or 4} bytes") from None
    if row.kind == 3:
        return struct.pack("<d", value)
    if row.kind == 4:
        text = text_to_cp1252(value)
        return text if len(text) == row.size > 0 else text + b"\0"
    return bytes(map(int, value.split(".")))


# The class of the records of a stream, filled in by the module that is generated.
RECORDS: dict[str, Any] = {}


def _value(stream: Stream, found: list[Field]) -> Any:
    """The only field, or a record of them; None for a stream without bytes that could have some."""
    rows = [row for row in stream.fields if not row.is_count]
    kinds = {row.name: row for row in rows}
    records: list[dict[str, Any]] = []
    for it in found:
        if it.name in kinds:
            if it.record == len(records):
                records.append({row.name: [] if row.is_list else None for row in rows})
            value = _read(kinds[it.name], it.data)
            if kinds[it.name].is_list:
                records[it.record][it.name].append(value)
            else:
                records[it.record][it.name] = value
    if stream.repeats:
        return [RECORDS[stream.name](**record) for record in records]
    if not records:
        return None
    return records[0][rows[0].name] if len(rows) == 1 else RECORDS[stream.name](**records[0])


def decode(stream: str, data: bytes) -> Any:
    """The value of a stream: its only field, or a record; a list of records of a stream of such."""
    return _value(STREAMS[stream], fields(stream, data))


def encode(stream: str, value: Any) -> bytes:
    """The bytes of a stream. A record is an object with its fields, or a dict; bytes stay as they are."""
    it = STREAMS[stream]
    rows = [row for row in it.fields if not row.is_count]
    parts: list[tuple[str, bytes]] = []
    for record in value if it.repeats else [] if value is None else [value]:
        for row in rows:
            one = record
            if len(rows) > 1:
                one = record.get(row.name) if isinstance(record, dict) else getattr(record, row.name)
            if one is not None:
                items = one if row.is_list else [one]
                parts += [(row.name, _write(row, item)) for item in items]
    return join(stream, parts)


@dataclass(frozen=True)
class Call:
    """A call as ADS carries it: what a client sends, what a server receives."""

    port: int
    command: int
    index_group: int
    index_offset: int
    read_length: int
    data: bytes

    def _c(self) -> _abi.Call:
        numbers = (self.port, self.command, self.index_group, self.index_offset, self.read_length)
        return _abi.Call(*numbers, _abi.lent(self.data))


def _of(it: _abi.Call) -> tuple[int, int, int, int, int, bytes]:
    return it.port, it.command, it.index_group, it.index_offset, it.read_length, it.data.get()


class _Arguments:
    """The struct of a request, and what it points to."""

    def __init__(self, function: int, given: dict[str, Any]) -> None:
        self.it = _abi.Request(function=function)
        self.kept: list[Any] = []
        for name, value in given.items():
            if name in ("name", "kind"):
                value = text_to_cp1252(value) if isinstance(value, str) else value
            if name in ("name", "kind", "value"):
                self.kept.append(value)
                value = _abi.lent(bytes(value))
                self.kept.append(value)
            elif name == "indices":
                self.it.indices_count = len(value)
                value = (UINT32 * len(value))(*value)
                self.kept.append(value)
            elif not 0 <= int(value) <= _abi.NONE:
                raise ValueError(f"{name}: {value} is no unsigned number of 32 bits")
            setattr(self.it, name, value)


@dataclass(frozen=True)
class Request(Call, Generic[T]):
    """What to send; `decode` reads what comes back."""

    function: Function
    arguments: dict[str, Any]

    def decode(self, reply: bytes) -> T:
        """The value of a reply: of all bytes that were received, not of as many as were asked for."""
        given = _Arguments(self.function.number, self.arguments)
        stream = STREAMS.get(self.function.reply or "")
        found = _fields(stream or _STREAMS[0], bytes(reply), "decode_reply", ctypes.byref(given.it))
        value: T = _value(stream, found) if stream else None  # type: ignore[assignment]
        return value


def request(number: int, **arguments: Any) -> Request[Any]:
    """The request of a function with these arguments."""
    given, call = _Arguments(number, arguments), _abi.Call()
    room = 4096 + len(arguments.get("value", b""))
    buffer = (ctypes.c_uint8 * room)()
    _call("encode", ctypes.byref(given.it), buffer, UINT32(room), ctypes.byref(call))
    return Request(*_of(call), FUNCTIONS[number], arguments)


@dataclass(frozen=True)
class Dispatched:
    """What a call received asks for."""

    function: Function
    arguments: dict[str, Any]

    def reply(self, value: Any = None) -> bytes:
        """The data to answer with. A server checks that it is not longer than the call's `read_length`."""
        return encode(self.function.reply, value) if self.function.reply else b""


def dispatch(call: Call) -> Dispatched:
    """The function that a call is to. The `ads_error` of the exception is the number to answer with."""
    it, indices, number, error = _abi.Request(), (UINT32 * 512)(), UINT32(), _abi.Error()
    call = Call(*(getattr(call, name) for name in Call.__dataclass_fields__))
    out = (ctypes.byref(it), ctypes.byref(number), ctypes.byref(error))
    received = call._c()
    if not _abi.function("dispatch")(ctypes.byref(received), indices, UINT32(512), *out):
        refusal = AdsCncError(error)
        refusal.ads_error = number.value
        raise refusal
    function = FUNCTIONS[it.function]
    arguments: dict[str, Any] = {}
    for name in function.arguments:
        found = list(indices[: it.indices_count]) if name == "indices" else getattr(it, name)
        if isinstance(found, _abi.Bytes):
            found = found.get() if name == "value" else text_from_cp1252(found.get())
        arguments[name] = found
    # A list of objects may be that of a platform axis; what is counted may be counted by index.
    optional = {name: getattr(it, name) for name in ("axis", "by_index") if name not in arguments}
    arguments.update({name: value for name, value in optional.items() if value})
    return Dispatched(function, arguments)


class Group(NamedTuple):
    """An index group in words; those that it has not are empty."""

    task: str
    access: str
    addressing: str
    table: str
    object_class: str
    attribute: str
    instance: int


def group_parts(index_group: int) -> Optional[Group]:
    """The parts of an index group; None for one that is not documented."""
    it = _abi.Group()
    if not _abi.function("group")(UINT32(index_group), ctypes.byref(it)):
        return None
    words = (it.task, it.access, it.addressing, it.table, it.object_class, it.attribute)
    return Group._make([*(word.text() for word in words), it.instance])


def axis_offset(axis: int, element: int, stride: int = 0x10000) -> int:
    """The index offset of an element of an axis; axis 0 is the channel itself."""
    offset = UINT32()
    _call("offset", UINT32(stride), UINT32(axis), UINT32(element), ctypes.byref(offset))
    return offset.value


def axis_and_element(offset: int, stride: int = 0x10000) -> tuple[int, int]:
    """The axis and the element of an index offset."""
    axis, element = UINT32(), UINT32()
    _call("offset_parts", UINT32(stride), UINT32(offset), ctypes.byref(axis), ctypes.byref(element))
    return axis.value, element.value


class Path(NamedTuple):
    """The name of a variable, by its parts: each a name and its indices."""

    kind: str
    parts: list[tuple[str, list[int]]]


def path(name: str) -> Path:
    """Takes the name of a variable apart."""
    data, room, count = text_to_cp1252(name), 256, UINT32()
    array = (_abi.Field * room)()
    _call("path", data, UINT32(len(data)), array, UINT32(room), ctypes.byref(count))
    parts: list[tuple[str, list[int]]] = []
    for it in array[1 : count.value]:
        if it.field == 2:
            parts[it.record][1].append(it.number)
        else:
            parts.append((text_from_cp1252(data[it.offset :][: it.length]), []))
    return Path(text_from_cp1252(data[: array[0].length]), parts)


class Frame(NamedTuple):
    """An AMS/TCP frame. A NetId is text, such as "192.0.2.7.1.1"."""

    target: tuple[str, int]
    source: tuple[str, int]
    command: int
    state_flags: int
    error: int
    invoke_id: int
    data: bytes

    @classmethod
    def of_call(cls, call: Call, target: str, source: tuple[str, int], invoke_id: int) -> Frame:
        """The frame of a request."""
        it = call._c()
        data = _sized("call_write", 64 + len(call.data), ctypes.byref(it))
        return cls((target, call.port), source, call.command, 4, 0, invoke_id, data)

    def call(self) -> Call:
        """The call of a request's frame."""
        it, call = self._c(), _abi.Call()
        _call("call_read", ctypes.byref(it), ctypes.byref(call))
        return Call(*_of(call))

    def encode(self) -> bytes:
        """The bytes, with both lengths."""
        it = self._c()
        return _sized("frame_write", 38 + len(self.data), ctypes.byref(it))

    def _c(self) -> _abi.Frame:
        ends = []
        for net_id, port in (self.target, self.source):
            ends.append(_abi.Address((ctypes.c_uint8 * 6)(*map(int, net_id.split("."))), port))
        return _abi.Frame(*ends, *self[2:6], _abi.lent(self.data))


def read_frame(received: bytes, max_data: int = 0x40_0000) -> Optional[tuple[Frame, int]]:
    """The frame at the front of what was received and its length; None if bytes are missing."""
    it, used = _abi.Frame(), UINT32()
    limits = (received, UINT32(len(received)), UINT32(max_data))
    _call("frame_read", *limits, ctypes.byref(it), ctypes.byref(used))
    if not used.value:
        return None
    ends = [(".".join(map(str, end.net_id)), end.port) for end in (it.target, it.source)]
    found = Frame(ends[0], ends[1], it.command, it.state_flags, it.error, it.invoke_id, it.data.get())
    return found, used.value


class Type(NamedTuple):
    """A type of variables, elements and objects."""

    name: str
    object_name: str
    code: int
    format: str
    size: int


def _type(it: _abi.Type) -> Type:
    letter = {0: "?", 1: " BH I   Q", 2: " bh i   q", 3: "    f   d", 4: "s"}[it.kind]
    letter = letter if it.kind in (0, 4) else letter[it.size]
    return Type(it.name.text(), it.object_name.text(), it.code, letter, it.size)


TYPES = [_type(it) for it in _abi.each("type", _abi.Type)]


def _type_of(type: Union[str, int]) -> Type:
    for it in TYPES:
        if type in (it.name, it.object_name) or type == it.code > 0:
            return it
    raise ValueError(f"{type} is no type")


def _nested(items: list[Any], dimensions: Sequence[int]) -> Any:
    if not dimensions:
        return items[0]
    if len(dimensions) == 1:
        return items
    step = math.prod(dimensions[1:])
    return [_nested(items[at * step :][:step], dimensions[1:]) for at in range(dimensions[0])]


def unpack(type: Union[str, int], data: bytes, dimensions: Sequence[int] = ()) -> Any:
    """A value by its type, which is a name or the code of a description; of arrays, nested lists."""
    it, count = _type_of(type), math.prod(dimensions)
    size = it.size or (len(data) if not dimensions else len(data) // max(count, 1))
    if size * count != len(data) or (count and not size and dimensions):
        raise ValueError(f"{it.name}: {count} elements of {size} bytes expected, {len(data)} bytes found")
    parts = [data[at * size :][:size] for at in range(count)]
    if it.format == "s":
        return _nested([text_from_cp1252(part) for part in parts], dimensions)
    return _nested([struct.unpack("<" + it.format, part)[0] for part in parts], dimensions)


def pack(type: Union[str, int], value: Any) -> bytes:
    """The bytes of a value, the reverse of `unpack`. A text gets a NUL; texts in an array need bytes."""
    it = _type_of(type)
    if isinstance(value, (list, tuple)):
        return b"".join(pack(type, one) for one in value)
    if isinstance(value, bytes):
        return value
    if it.format == "s":
        return text_to_cp1252(value) + b"\0"
    try:
        return struct.pack("<" + it.format, value)
    except struct.error as error:
        raise ValueError(f"{it.name}: {value}: {error}") from None


BUSY, REJECTED = 1, 2


class Sender:
    """Sends an NC program: hands out packets to write, and takes what became of them.

    >>> sender = Sender(b"N10 G0 X0\\nN20 M30")
    >>> for packet in sender:
    ...     sender.acknowledge(0)  # the ADS result; after BUSY the same packet comes again
    """

    def __init__(self, program: bytes) -> None:
        self._program, self._it = bytes(program), _abi.Sender()
        _call("sender_start", ctypes.byref(self._it), self._program, UINT32(len(self._program)))

    def __iter__(self) -> Iterator[bytes]:
        packet = _abi.Bytes()
        while _abi.function("sender_packet")(ctypes.byref(self._it), ctypes.byref(packet)):
            yield packet.get()
            if self.progress["state"] == 1:
                raise RuntimeError("the packet in flight was not acknowledged")

    def acknowledge(self, ads_error: Optional[int]) -> int:
        """What the CNC answered: an ADS result, or None if the answer was lost.

        Returns 0, BUSY (then wait about half a second) or REJECTED.
        """
        number = REJECTED
        if ads_error is not None:
            number = _abi.function("acknowledgement", UINT32)(UINT32(ads_error))
        if not _abi.function("sender_acknowledge")(ctypes.byref(self._it), UINT32(number)):
            raise RuntimeError("no packet is in flight")
        return number

    @property
    def progress(self) -> dict[str, int]:
        """Packets, lines and bytes that were accepted, what is left, the state."""
        it = _abi.Progress()
        _abi.function("sender_progress")(ctypes.byref(self._it), ctypes.byref(it))
        return {name: getattr(it, name) for name, _ in it._fields_}


class Step(NamedTuple):
    """What a host wants done: "wait", "read", "write" or "serve"."""

    kind: str
    variable: str
    data: bytes
    service: int
    request: str
    request_state: int


class Host:
    """Hosts services of one channel: returns the variable to read or write next."""

    def __init__(self, services: Sequence[str]) -> None:
        self._it, self._ids = _abi.Host(), (ctypes.c_uint8 * (36 * len(services)))()
        for at, service in enumerate(services):
            text = service.encode()
            _call("service_id", text, UINT32(len(text)), ctypes.byref(self._ids, 36 * at))
        _call("host_start", ctypes.byref(self._it), self._ids, UINT32(len(services)))

    def step(self) -> Step:
        """What to do next; the same until it is done."""
        it = _abi.HostStep()
        _abi.function("host_step")(ctypes.byref(self._it), ctypes.byref(it))
        kind, data = ("wait", "read", "write", "serve")[it.kind], it.data.get()
        request = text_from_cp1252(data) if kind == "serve" else ""
        return Step(kind, it.variable.text(), data, it.service, request, it.request_state)

    def read(self, value: bytes) -> None:
        """The value that was read."""
        _call("host_read", ctypes.byref(self._it), value, UINT32(len(value)))

    def answer(self, response: str, state: int) -> None:
        """The response to the request, and its state, not 0."""
        data = text_to_cp1252(response)
        _call("host_answer", ctypes.byref(self._it), data, UINT32(len(data)), UINT32(state))

    def _event(self, number: int) -> None:
        _abi.function("host_event")(ctypes.byref(self._it), UINT32(number))

    def written(self) -> None:
        """The write was done."""
        self._event(0)

    def failed(self) -> None:
        """The step failed: a write may have been done."""
        self._event(1)

    def poll(self) -> None:
        """The wait is over."""
        self._event(2)

    def restart(self) -> None:
        """The CNC was reset, or the connection is new."""
        self._event(3)

    @property
    def outcome(self) -> Optional[str]:
        """What became of the last answer: "answered" or "abandoned"."""
        return (None, "answered", "abandoned")[_abi.function("host_outcome", UINT32)(ctypes.byref(self._it))]
