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
    """Nests the items, of which there is at least one, from the last dimension to the first. This is not recursive,
    because a value may have more dimensions than Python allows nested calls."""
    for size in reversed(dimensions[1:]):
        items = [items[at : at + size] for at in range(0, len(items), size)]
    return items if dimensions else items[0]


def unpack(type: Union[str, int], data: bytes, dimensions: Sequence[int] = ()) -> Any:
    """Decodes a value by its type (a name, or a code from a description); an array to nested lists.

    The result is an empty list if a dimension is 0.
    """
    it, data = _type_of(type), _abi.checked(data)
    dimensions = [_abi.unsigned(f"dimensions[{at}]", one) for at, one in enumerate(dimensions)]
    count = math.prod(dimensions)
    size = it.size or (len(data) if not dimensions else len(data) // max(count, 1))
    if size * count != len(data) or (count and not size and dimensions):
        raise ValueError(f"{it.name}: expected {count} elements of {size} bytes, found {len(data)} bytes")
    if not count:
        # Without elements, the other dimensions are only numbers: they may stand for billions of empty lists.
        return []
    if it.format != "s":
        return _nested(list(struct.unpack(f"<{count}{it.format}", data)), dimensions)
    parts = [data[at : at + size] for at in range(0, len(data), size)] if size else [data]
    return _nested([text_from_cp1252(part) for part in parts], dimensions)


def pack(type: Union[str, int], value: Any) -> bytes:
    """Encodes a value, the inverse of `unpack`. A text gets a NUL; pass the texts of an array as bytes."""
    it, parts, left = _type_of(type), [], [value]
    # Not recursive, as in `_nested`.
    while left:
        one = left.pop()
        if isinstance(one, (list, tuple)):
            left.extend(reversed(one))
        else:
            parts.append(_packed(it, one))
    return b"".join(parts)


def _packed(it: Type, value: Any) -> bytes:
    if isinstance(value, (bytes, bytearray, memoryview)):
        return _abi.checked(value)
    if it.format == "s":
        return text_to_cp1252(value) + b"\0"
    # struct accepts any object for a BOOLEAN.
    if it.format == "?" and value not in (0, 1):
        raise ValueError(f"{it.name}: {value!r} is not True, False, 0 or 1")
    try:
        return struct.pack("<" + it.format, value)
    except (struct.error, OverflowError) as error:
        raise ValueError(f"{it.name}: {value}: {error}") from None
