"""A codec for the byte streams that read and write an ISG/TwinCAT CNC over ADS, over any transport.

>>> import ads_cnc
>>> request = ads_cnc.read_by_name(1, "V.E.a")
>>> (request.port, request.command, hex(request.index_group), hex(request.index_offset), request.data)
(552, 9, '0x122301', '0x48', b'V.E.a\\x00')
>>> ads_cnc.unpack("SGN32", request.decode(b"\\x7b\\0\\0\\0"))
123

Each function of the CNC, from `count_objects` to `write_object`, is a function that returns a `Request`.
"""

from ._address import Frame, Group, Path, axis_and_element, axis_offset, group_parts, path, read_frame
from ._codec import (
    FUNCTIONS,
    STREAMS,
    AdsCncError,
    Call,
    Dispatched,
    Field,
    FieldInfo,
    Function,
    Request,
    Stream,
    decode,
    dispatch,
    encode,
    fields,
    join,
    text_from_cp1252,
    text_to_cp1252,
)
from ._functions import *  # noqa: F403: generated from the library's tables
from ._machines import BUSY, REJECTED, Host, Sender, Step
from ._values import TYPES, Type, pack, unpack
