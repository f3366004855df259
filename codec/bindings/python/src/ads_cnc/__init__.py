"""The byte streams with which an ISG/TwinCAT CNC is read and written over ADS, over any transport.

>>> import ads_cnc
>>> request = ads_cnc.read_by_name(1, "V.E.a")
>>> (request.port, request.command, hex(request.index_group), hex(request.index_offset), request.data)
(552, 9, '0x122301', '0x48', b'V.E.a\\x00')
>>> ads_cnc.unpack("SGN32", request.decode(b"\\x7b\\0\\0\\0"))
123

The functions are those of the CNC, from `count_objects` to `write_object`; each returns a `Request`.
"""

from ._codec import (
    BUSY,
    FUNCTIONS,
    REJECTED,
    STREAMS,
    TYPES,
    AdsCncError,
    Call,
    Dispatched,
    Field,
    FieldInfo,
    Frame,
    Function,
    Group,
    Host,
    Path,
    Request,
    Sender,
    Step,
    Stream,
    Type,
    axis_and_element,
    axis_offset,
    decode,
    dispatch,
    encode,
    fields,
    group_parts,
    join,
    pack,
    path,
    read_frame,
    text_from_cp1252,
    text_to_cp1252,
    unpack,
)
from ._functions import *  # noqa: F403: generated from the library's tables
