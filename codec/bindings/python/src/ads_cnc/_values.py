"""Decodes and encodes values by their types."""

from __future__ import annotations

import math
import struct
from collections.abc import Sequence
from typing import Any, NamedTuple, Union

from . import _abi
from ._codec import text_from_cp1252, text_to_cp1252


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
    raise ValueError(f"no such type: {type}")


def _nested(items: list[Any], dimensions: Sequence[int]) -> Any:
    if not dimensions:
        return items[0]
    if len(dimensions) == 1:
        return items
    step = math.prod(dimensions[1:])
    return [_nested(items[at * step :][:step], dimensions[1:]) for at in range(dimensions[0])]


def unpack(type: Union[str, int], data: bytes, dimensions: Sequence[int] = ()) -> Any:
    """Decodes a value by its type (a name, or a code from a description); an array to nested lists."""
    it, count = _type_of(type), math.prod(dimensions)
    size = it.size or (len(data) if not dimensions else len(data) // max(count, 1))
    if size * count != len(data) or (count and not size and dimensions):
        raise ValueError(f"{it.name}: expected {count} elements of {size} bytes, found {len(data)} bytes")
    parts = [data[at * size :][:size] for at in range(count)]
    if it.format == "s":
        return _nested([text_from_cp1252(part) for part in parts], dimensions)
    return _nested([struct.unpack("<" + it.format, part)[0] for part in parts], dimensions)


def pack(type: Union[str, int], value: Any) -> bytes:
    """Encodes a value, the inverse of `unpack`. A text gets a NUL; pass the texts of an array as bytes."""
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
