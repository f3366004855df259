"""The structs and calls of the C library. ads_cnc.h documents them."""

from __future__ import annotations

import ctypes
import operator
import pathlib
import sys
from collections.abc import Callable, Iterator, Sized
from typing import Any

ABI = 2
NONE = 0xFFFFFFFF
UINT32 = ctypes.c_uint32

_FILES = {"win32": "ads_cnc.dll", "darwin": "libads_cnc.dylib"}
_file = pathlib.Path(__file__).parent / _FILES.get(sys.platform, "libads_cnc.so")
# PyDLL holds the GIL during a call, which CDLL releases: two threads that use one `Sender` or `Host` must not change
# its memory at the same time. All calls are short, so other threads do not wait long; a build of Python
# without the GIL has no such protection.
library = ctypes.PyDLL(str(_file))
if library.ads_cnc_abi() != ABI:
    raise ImportError(f"{_file} has ABI {library.ads_cnc_abi()}, but this package needs {ABI}")


class Bytes(ctypes.Structure):
    _fields_ = [("data", ctypes.c_void_p), ("length", UINT32)]

    def get(self) -> bytes:
        return ctypes.string_at(self.data, self.length) if self.length else b""

    def text(self) -> str:
        return self.get().decode()


def _numbers(names: str) -> list[tuple[str, Any]]:
    return [(name, UINT32) for name in names.split()]


class Error(ctypes.Structure):
    _fields_ = [
        *_numbers("kind stream field offset expected found"),
        ("subject", Bytes),
        ("name", Bytes),
        ("text", Bytes),
    ]


class Request(ctypes.Structure):
    _fields_ = [
        *_numbers("function channel by_index axis index count size handle index_group index_offset"),
        ("kind", Bytes),
        ("name", Bytes),
        ("value", Bytes),
        ("indices", ctypes.POINTER(UINT32)),
        ("indices_count", UINT32),
    ]


class Call(ctypes.Structure):
    _fields_ = [*_numbers("port command index_group index_offset read_length"), ("data", Bytes)]


class Field(ctypes.Structure):
    _fields_ = _numbers("field record item offset length number")


class Part(ctypes.Structure):
    _fields_ = [*_numbers("field number"), ("data", Bytes)]


class FunctionInfo(ctypes.Structure):
    _fields_ = [
        ("name", Bytes),
        ("operation", Bytes),
        *_numbers("port command effect request reply argument_count"),
        ("arguments", UINT32 * 8),
    ]


class StreamInfo(ctypes.Structure):
    _fields_ = [("name", Bytes), ("title", Bytes), *_numbers("max field_count repeats")]


class FieldInfo(ctypes.Structure):
    _fields_ = [
        ("name", Bytes),
        ("meaning", Bytes),
        ("clause", Bytes),
        *_numbers("kind size is_count is_list"),
    ]


class Type(ctypes.Structure):
    _fields_ = [("name", Bytes), ("object_name", Bytes), *_numbers("code kind size")]


class Address(ctypes.Structure):
    _fields_ = [("net_id", ctypes.c_uint8 * 6), ("port", ctypes.c_uint16)]


class Frame(ctypes.Structure):
    _fields_ = [
        ("target", Address),
        ("source", Address),
        *_numbers("command state_flags error invoke_id"),
        ("data", Bytes),
    ]


class Group(ctypes.Structure):
    _fields_ = [
        *((name, Bytes) for name in "task access addressing table object_class attribute".split()),
        ("instance", UINT32),
    ]


class Sender(ctypes.Structure):
    _fields_ = [("opaque", ctypes.c_uint64 * 152)]


class Progress(ctypes.Structure):
    _fields_ = _numbers("state packets lines bytes left_lines left_bytes busy_count")


class Host(ctypes.Structure):
    _fields_ = [("opaque", ctypes.c_uint64 * 72)]


class HostStep(ctypes.Structure):
    _fields_ = [*_numbers("kind service request_state"), ("variable", Bytes), ("data", Bytes)]


def unsigned(name: str, value: Any, bits: int = 32) -> int:
    """Checks a number of the caller, because ctypes wraps a number that does not fit."""
    try:
        number = operator.index(value)
    except TypeError:
        raise TypeError(f"{name}: int expected, found {value!r}") from None
    if not 0 <= number < 1 << bits:
        raise ValueError(f"{name}: {value} is not an unsigned number of {bits} bits")
    return number


def uint32(name: str, value: Any) -> ctypes.c_uint32:
    return UINT32(unsigned(name, value))


def checked(data: Any) -> bytes:
    """Checks that data is bytes, because `bytes` makes zeros of an int, and ctypes passes a str as wide characters."""
    if isinstance(data, bytes):
        return data
    if isinstance(data, (bytearray, memoryview)):
        return bytes(data)
    raise TypeError(f"bytes expected, found {type(data).__name__}")


def length(data: Sized) -> ctypes.c_uint32:
    return uint32("length", len(data))


def function(name: str, result: Any = ctypes.c_bool) -> Callable[..., Any]:
    it = getattr(library, "ads_cnc_" + name)
    it.restype = result
    return it  # type: ignore[no-any-return]


def lent(data: bytes) -> Bytes:
    """A struct that points to `data`. ctypes keeps `data` alive as long as the struct, or a struct that contains it."""
    at = ctypes.cast(ctypes.c_char_p(data), ctypes.c_void_p) if data else None
    return Bytes(at, length(data))


def each(name: str, kind: type[Any], *before: int) -> Iterator[Any]:
    """Yields the rows of a table of the library, in the order of their numbers."""
    give, number = function(name), 0
    while True:
        info = kind()
        if not give(*map(UINT32, before), UINT32(number), ctypes.byref(info)):
            return
        yield info
        number += 1
