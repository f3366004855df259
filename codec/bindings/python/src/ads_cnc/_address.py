"""Index groups, index offsets and names, parsed into their parts; AMS/TCP frames."""

from __future__ import annotations

import ctypes
from typing import NamedTuple, Optional

from . import _abi
from ._abi import UINT32, checked, length, uint32, unsigned
from ._codec import Call, call_of, invoke, net_id_to_bytes, sized, text_from_cp1252, text_to_cp1252


class Group(NamedTuple):
    """The parts of an index group, as words; parts that a group does not have are empty."""

    task: str
    access: str
    addressing: str
    table: str
    object_class: str
    attribute: str
    instance: int


def group_parts(index_group: int) -> Optional[Group]:
    """Parses an index group; None if it is not documented."""
    it = _abi.Group()
    if not _abi.function("group")(uint32("index_group", index_group), ctypes.byref(it)):
        return None
    words = (it.task, it.access, it.addressing, it.table, it.object_class, it.attribute)
    return Group._make([*(word.text() for word in words), it.instance])


def axis_offset(axis: int, element: int, stride: int = 0x10000) -> int:
    """The index offset of an element of an axis; axis 0 is the channel itself."""
    offset = UINT32()
    given = (uint32("stride", stride), uint32("axis", axis), uint32("element", element))
    invoke("offset", *given, ctypes.byref(offset))
    return offset.value


def axis_and_element(offset: int, stride: int = 0x10000) -> tuple[int, int]:
    """The axis and the element of an index offset."""
    axis, element = UINT32(), UINT32()
    given = (uint32("stride", stride), uint32("offset", offset))
    invoke("offset_parts", *given, ctypes.byref(axis), ctypes.byref(element))
    return axis.value, element.value


class Path(NamedTuple):
    """The kind of a variable, such as "V.G", and the parts of its name, each with its indices."""

    kind: str
    parts: list[tuple[str, list[int]]]


def path(name: str) -> Path:
    """Parses the name of a variable."""
    data, room, count = text_to_cp1252(name), 256, UINT32()
    array = (_abi.Field * room)()
    invoke("path", data, length(data), array, UINT32(room), ctypes.byref(count))
    parts: list[tuple[str, list[int]]] = []
    for it in array[1 : count.value]:
        if it.field == 2:
            parts[it.record][1].append(it.number)
        else:
            parts.append((text_from_cp1252(data[it.offset : it.offset + it.length]), []))
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
        """Creates the frame of a request."""
        it = call.c()
        data = sized("call_write", 64 + len(call.data), ctypes.byref(it))
        return cls((target, call.port), source, call.command, 4, 0, invoke_id, data)

    def call(self) -> Call:
        """Decodes the call in the frame of a request."""
        it, call = self.c(), _abi.Call()
        invoke("call_read", ctypes.byref(it), ctypes.byref(call))
        return Call(*call_of(call))

    def encode(self) -> bytes:
        """Encodes the frame, including both lengths."""
        it = self.c()
        return sized("frame_write", 38 + len(self.data), ctypes.byref(it))

    def c(self) -> _abi.Frame:
        ends = []
        for name, (net_id, port) in (("target", self.target), ("source", self.source)):
            six = (ctypes.c_uint8 * 6)(*net_id_to_bytes(f"{name} NetId", net_id))
            ends.append(_abi.Address(six, unsigned(f"{name} port", port, 16)))
        numbers = map(unsigned, self._fields[2:6], self[2:6])
        return _abi.Frame(*ends, *numbers, _abi.lent(checked(self.data)))


def read_frame(received: bytes, max_data: int = 0x40_0000) -> Optional[tuple[Frame, int]]:
    """Decodes the first received frame, and returns its length; None if the frame is not complete yet."""
    it, used, received = _abi.Frame(), UINT32(), checked(received)
    limits = (received, length(received), uint32("max_data", max_data))
    invoke("frame_read", *limits, ctypes.byref(it), ctypes.byref(used))
    if not used.value:
        return None
    ends = [(".".join(map(str, end.net_id)), end.port) for end in (it.target, it.source)]
    found = Frame(ends[0], ends[1], it.command, it.state_flags, it.error, it.invoke_id, it.data.get())
    return found, used.value
