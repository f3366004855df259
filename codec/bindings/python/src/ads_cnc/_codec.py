"""Requests, dispatch, and decoding and encoding of streams, by the tables that the library provides."""

from __future__ import annotations

import ctypes
import re
import struct
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Generic, NamedTuple, Optional, TypeVar

from . import _abi
from ._abi import UINT32, checked, length, uint32, unsigned

T = TypeVar("T")


class AdsCncError(ValueError):
    """The error for invalid bytes or values.

    `stream` is the name of the stream or of another subject, such as "call"; `field` is the name of the field or
    argument, or empty; `offset` is the offset of the fault in the stream. The meaning of `expected` and `found`
    depends on `kind`.
    """

    def __init__(self, error: _abi.Error) -> None:
        self.kind: str = error.text.text()
        self.stream: str = error.subject.text()
        self.field: str = error.name.text()
        self.offset: int = error.offset
        self.expected: int = error.expected
        self.found: int = error.found
        # The ADS error number for the response of a server; 0 for a client.
        self.ads_error = 0
        numbers = f"expected {self.expected}, found {self.found}" if self.expected or self.found else ""
        place = ": ".join(part for part in (self.stream, self.field) if part)
        super().__init__(
            f"{place} at offset {self.offset}: {self.kind}" + (f", {numbers}" if numbers else "")
        )


def invoke(name: str, *arguments: Any) -> None:
    error = _abi.Error()
    if not _abi.function(name)(*arguments, ctypes.byref(error)):
        raise AdsCncError(error)


def sized(name: str, room: int, *arguments: Any) -> bytes:
    """Calls a function that fills a buffer. Repeats the call with a larger buffer if necessary."""
    while True:
        size, used, error = uint32("length", room), UINT32(), _abi.Error()
        buffer = (ctypes.c_uint8 * room)()
        if _abi.function(name)(*arguments, buffer, size, ctypes.byref(used), ctypes.byref(error)):
            return bytes(memoryview(buffer)[: used.value])
        if error.kind not in (15, 37) or error.expected <= room:
            raise AdsCncError(error)
        room = error.expected


def text_from_cp1252(data: bytes) -> str:
    """Converts CP1252 to text, up to the first NUL or the end."""
    data = checked(data)
    return sized("text_to_utf8", 3 * len(data), data, length(data)).decode()


def text_to_cp1252(text: str) -> bytes:
    """Converts a text to CP1252, without a NUL."""
    if not isinstance(text, str):
        raise TypeError(f"str expected, found {type(text).__name__}")
    data = text.encode()
    return sized("text_from_utf8", len(data), data, length(data))


class FieldInfo(NamedTuple):
    """A row in the table of a stream."""

    name: str
    meaning: str
    clause: str
    kind: int
    size: int
    is_count: bool
    is_list: bool


class Stream(NamedTuple):
    """The table of a stream."""

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
    room, data = 64, checked(data)
    while True:
        array, count, error = (_abi.Field * room)(), UINT32(), _abi.Error()
        given = (data, length(data), array, UINT32(room), ctypes.byref(count), ctypes.byref(error))
        if _abi.function(name)(*before, *given):
            return [
                Field(
                    stream.fields[it.field].name,
                    it.record,
                    it.item,
                    it.offset,
                    data[it.offset : it.offset + it.length],
                )
                for it in array[: count.value]
            ]
        if error.kind != 37:
            raise AdsCncError(error)
        room = count.value


def fields(stream: str, data: bytes) -> list[Field]:
    """Splits a stream into its fields, with their bytes."""
    it = STREAMS[stream]
    return _fields(it, data, "decode", UINT32(it.number))


def join(stream: str, parts: Sequence[tuple[str, bytes]]) -> bytes:
    """Builds a stream from the bytes of its fields, the inverse of `fields`. Counts may be omitted."""
    it = STREAMS[stream]
    numbers = {row.name: at for at, row in enumerate(it.fields)}
    parts = [(name, checked(data)) for name, data in parts]
    array = (_abi.Part * len(parts))(*(_abi.Part(numbers[name], 0, _some(data)) for name, data in parts))
    room = 64 + sum(len(data) for _, data in parts)
    return sized("build", room, UINT32(it.number), array, length(parts))


_EMPTY = ctypes.create_string_buffer(1)


def _some(data: bytes) -> _abi.Bytes:
    """Returns the struct for `data`. Its pointer is never null, because null would mean that the part is a number."""
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


def net_id_to_bytes(name: str, text: str) -> bytes:
    """The bytes of a NetId. Without the check, ctypes would wrap a number above 255."""
    numbers = list(map(int, text.split("."))) if re.fullmatch(r"[0-9]{1,3}(\.[0-9]{1,3}){5}", text) else []
    if len(numbers) != 6 or max(numbers) > 255:
        raise ValueError(f"{name}: six numbers from 0 to 255 expected, found {text}")
    return bytes(numbers)


def _write(row: FieldInfo, value: Any) -> bytes:
    if isinstance(value, (bytes, bytearray, memoryview)):
        return checked(value)
    if row.kind in (1, 2):
        size = row.size or 4
        return unsigned(row.name, value, 8 * size).to_bytes(size, "little")
    if row.kind == 3:
        try:
            return struct.pack("<d", value)
        except struct.error:
            raise TypeError(f"{row.name}: float expected, found {value!r}") from None
    if row.kind == 4:
        text = text_to_cp1252(value)
        return text if len(text) == row.size > 0 else text + b"\0"
    if row.kind == 5:
        return net_id_to_bytes(row.name, value)
    raise TypeError(f"{row.name}: bytes expected, found {type(value).__name__}")


# The classes of records, by the name of the stream, for the streams whose value is a record or a list of
# records. The generated module `_functions` fills them in.
RECORDS: dict[str, Any] = {}


def _value(stream: Stream, found: list[Field]) -> Any:
    """The value of a stream: its only field, a record of its fields, or a list of records if the stream repeats.
    None if no field was found."""
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
    """Decodes a stream: to its only field, to a record, or to a list of records if the stream repeats; to None if
    the data contains no field."""
    return _value(STREAMS[stream], fields(stream, data))


def encode(stream: str, value: Any) -> bytes:
    """Encodes a stream. A record is an object with the fields, or a dict; bytes are written unchanged."""
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
    """An ADS call, as a client sends it and a server receives it."""

    port: int
    command: int
    index_group: int
    index_offset: int
    read_length: int
    data: bytes

    def c(self) -> _abi.Call:
        names = ("port", "command", "index_group", "index_offset", "read_length")
        numbers = (unsigned(name, getattr(self, name)) for name in names)
        return _abi.Call(*numbers, _abi.lent(checked(self.data)))


def call_of(it: _abi.Call) -> tuple[int, int, int, int, int, bytes]:
    return it.port, it.command, it.index_group, it.index_offset, it.read_length, it.data.get()


class _Arguments:
    """The struct of a request, and the memory that it points to."""

    def __init__(self, function: int, given: dict[str, Any]) -> None:
        self.it = _abi.Request(function=function)
        self.kept: list[Any] = []
        for name, value in given.items():
            if name in ("name", "kind") and isinstance(value, str):
                value = text_to_cp1252(value)
            if name in ("name", "kind", "value"):
                value = _abi.lent(checked(value))
                self.kept.append(value)
            elif name == "indices":
                self.it.indices_count = length(value)
                indices = (unsigned(f"indices[{at}]", index) for at, index in enumerate(value))
                value = (UINT32 * len(value))(*indices)
                self.kept.append(value)
            else:
                value = unsigned(name, value)
            setattr(self.it, name, value)


@dataclass(frozen=True)
class Request(Call, Generic[T]):
    """A request to send. Pass the reply to `decode`."""

    function: Function
    arguments: dict[str, Any]

    def decode(self, reply: bytes) -> T:
        """Decodes a reply. Pass the received bytes only, not a buffer of `read_length` bytes."""
        given = _Arguments(self.function.number, self.arguments)
        stream = STREAMS.get(self.function.reply or "")
        found = _fields(stream or _STREAMS[0], reply, "decode_reply", ctypes.byref(given.it))
        value: T = _value(stream, found) if stream else None  # type: ignore[assignment]
        return value


def request(number: int, **arguments: Any) -> Request[Any]:
    """Creates the request of a function with these arguments."""
    given, call = _Arguments(number, arguments), _abi.Call()
    room = 4096 + given.it.value.length
    buffer = (ctypes.c_uint8 * room)()
    invoke("encode", ctypes.byref(given.it), buffer, uint32("length", room), ctypes.byref(call))
    return Request(*call_of(call), FUNCTIONS[number], arguments)


@dataclass(frozen=True)
class Dispatched:
    """A dispatched call: its function and arguments."""

    function: Function
    arguments: dict[str, Any]

    def reply(self, value: Any = None) -> bytes:
        """Encodes the reply. The server must check that it is not longer than the `read_length` of the call."""
        return encode(self.function.reply, value) if self.function.reply else b""


def dispatch(call: Call) -> Dispatched:
    """Dispatches a received call. If it raises, answer with the `ads_error` of the exception."""
    it, indices, number, error = _abi.Request(), (UINT32 * 512)(), UINT32(), _abi.Error()
    call = Call(*(getattr(call, name) for name in Call.__dataclass_fields__))
    out = (ctypes.byref(it), ctypes.byref(number), ctypes.byref(error))
    received = call.c()
    if not _abi.function("dispatch")(ctypes.byref(received), indices, UINT32(512), *out):
        exception = AdsCncError(error)
        exception.ads_error = number.value
        raise exception
    function = FUNCTIONS[it.function]
    arguments: dict[str, Any] = {}
    for name in function.arguments:
        found = list(indices[: it.indices_count]) if name == "indices" else getattr(it, name)
        if isinstance(found, _abi.Bytes):
            found = found.get() if name == "value" else text_from_cp1252(found.get())
        arguments[name] = found
    # Optional arguments: `axis` is set for lists of objects of a platform axis, `by_index` for addressing by index.
    optional = {name: getattr(it, name) for name in ("axis", "by_index") if name not in arguments}
    arguments.update({name: value for name, value in optional.items() if value})
    return Dispatched(function, arguments)
