"""The functions of the CNC and the records of its streams. Generated: see generate.py."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Optional, cast

from ._codec import RECORDS, Request, request


@dataclass(frozen=True)
class AmsTcpHeader:
    """AMS/TCP header."""

    reserved: int  # 0 for AMS commands
    length: int  # bytes that follow: AMS header and data


RECORDS["ams-tcp-header"] = AmsTcpHeader


@dataclass(frozen=True)
class AmsHeader:
    """AMS header."""

    target_net_id: str  # NetId of the receiver
    target_port: int  # AMS port of the receiver
    source_net_id: str  # NetId of the sender
    source_port: int  # AMS port of the sender
    command: int  # 2 Read, 3 Write, 9 ReadWrite, …
    state_flags: int  # 0x0004 request, 0x0005 response
    data_length: int  # bytes after this header
    error: int  # AMS error number, 0 for none
    invoke_id: int  # pairs a response with its request


RECORDS["ams-header"] = AmsHeader


@dataclass(frozen=True)
class ReadRequest:
    """ADS Read, request."""

    index_group: int  # index group
    index_offset: int  # index offset
    length: int  # bytes to read at most


RECORDS["read-request"] = ReadRequest


@dataclass(frozen=True)
class ReadReply:
    """ADS Read, reply."""

    result: int  # ADS error number, 0 for success
    data: bytes  # the data


RECORDS["read-reply"] = ReadReply


@dataclass(frozen=True)
class WriteRequest:
    """ADS Write, request."""

    index_group: int  # index group
    index_offset: int  # index offset
    data: bytes  # the data


RECORDS["write-request"] = WriteRequest


@dataclass(frozen=True)
class ReadWriteRequest:
    """ADS ReadWrite, request."""

    index_group: int  # index group
    index_offset: int  # index offset
    read_length: int  # bytes to read at most
    data: bytes  # the data


RECORDS["read-write-request"] = ReadWriteRequest


@dataclass(frozen=True)
class ReadWriteReply:
    """ADS ReadWrite, reply."""

    result: int  # ADS error number, 0 for success
    data: bytes  # the data


RECORDS["read-write-reply"] = ReadWriteReply


@dataclass(frozen=True)
class DeviceInfoReply:
    """ADS ReadDeviceInfo, reply."""

    result: int  # ADS error number, 0 for success
    major: int  # first number of the version
    minor: int  # second number of the version
    build: int  # third number of the version
    name: str  # name of the device


RECORDS["device-info-reply"] = DeviceInfoReply


@dataclass(frozen=True)
class DeviceStateReply:
    """ADS ReadState, reply."""

    result: int  # ADS error number, 0 for success
    ads_state: int  # 5 RUN, 6 STOP, 15 CONFIG, …
    device_state: int  # state of the device's own


RECORDS["device-state-reply"] = DeviceStateReply


@dataclass(frozen=True)
class ObjectDescriptor:
    """Object descriptor, reply."""

    id: int  # unique internal number of the object
    size: int  # bytes of the object's content
    write_access: int  # not 0: writable
    not_assigned: int  # kept as it is, written as 0
    index_group: int  # index group of the content
    index_offset: int  # index offset of the content
    name: str  # name of the object
    type: str  # BOOL, BYTE, SINT, WORD, …


RECORDS["object-descriptor"] = ObjectDescriptor

RECORDS["object-descriptors"] = ObjectDescriptor


@dataclass(frozen=True)
class VariableIndexKind:
    """Variable description by index, request."""

    index: int  # index of the variable, from 0
    kind: str  # V.G, V.E or V.A


RECORDS["variable-index-kind"] = VariableIndexKind


@dataclass(frozen=True)
class VariableDescription:
    """Variable description by index, reply."""

    handle: int  # handle of the variable
    type: int  # 1 BOOLEAN … 9 STRING
    access: int  # 1 READ_ONLY, 2 READ_WRITE
    size: int  # bytes of the whole variable
    dimensions: list[int]  # elements in each dimension
    name: str  # name of the variable


RECORDS["variable-description"] = VariableDescription


@dataclass(frozen=True)
class VariableHandleRead:
    """Read variable value by handle, request."""

    handle: int  # handle of the variable
    indices: list[int]  # index in each dimension, from 0


RECORDS["variable-handle-read"] = VariableHandleRead


@dataclass(frozen=True)
class VariableHandleWrite:
    """Write variable value by handle, request."""

    handle: int  # handle of the variable
    indices: list[int]  # index in each dimension, from 0
    value: bytes  # one element, or all of the array


RECORDS["variable-handle-write"] = VariableHandleWrite


@dataclass(frozen=True)
class VariableNameWrite:
    """Write variable value by name, request."""

    name: str  # name of the variable
    value: bytes  # one element, or all of the array


RECORDS["variable-name-write"] = VariableNameWrite


@dataclass(frozen=True)
class VariableExtendedDescription:
    """Extended variable description by index, reply."""

    synchronisation: int  # 1 NO_SYNC, 2 SYNCHRONIZED
    validity: int  # 1 CHANNEL, 2 GLOBAL


RECORDS["variable-extended-description"] = VariableExtendedDescription


@dataclass(frozen=True)
class ObjectAddressQuery:
    """Object address, request."""

    channel: int  # channel, or index of a spindle; 0 for the platform
    axis: int  # axis; 0 for the channel itself


RECORDS["object-address-query"] = ObjectAddressQuery


@dataclass(frozen=True)
class ObjectAddress:
    """Object address, reply."""

    index_group: int  # index group of the content; 0 for no such instance
    index_offset: int  # index offset of the first element


RECORDS["object-address"] = ObjectAddress


@dataclass(frozen=True)
class VariableDescriptionByName:
    """Variable description by name, reply."""

    handle: int  # handle of the variable
    type: int  # 1 BOOLEAN … 9 STRING
    access: int  # 1 READ_ONLY, 2 READ_WRITE
    size: int  # bytes of the whole variable
    dimensions: list[int]  # elements in each dimension


RECORDS["variable-description-by-name"] = VariableDescriptionByName


def count_objects(channel: int, *, axis: int = 0, by_index: bool = False) -> Request[int]:
    """Number of objects: Read to port 553; changes nothing.

    channel: from 1; 0 is the platform, where there is one
    axis: axis of the channel, from 1; of a list with channel 0, a platform axis
    by_index: whether the channel is counted among the active ones
    """
    return cast("Request[int]", request(0, channel=channel, axis=axis, by_index=by_index))


def read_descriptors(
    channel: int, index: int, count: int, *, axis: int = 0, by_index: bool = False
) -> Request[list[ObjectDescriptor]]:
    """Object descriptors: Read to port 553; changes nothing.

    channel: from 1; 0 is the platform, where there is one
    index: from 0 for variables, from 1 for parameters and objects
    count: descriptors to read
    axis: axis of the channel, from 1; of a list with channel 0, a platform axis
    by_index: whether the channel is counted among the active ones
    """
    return cast(
        "Request[list[ObjectDescriptor]]",
        request(1, channel=channel, index=index, count=count, axis=axis, by_index=by_index),
    )


def count_variables(channel: int, kind: str, *, by_index: bool = False) -> Request[int]:
    """Number of variable elements: ReadWrite to port 552; changes nothing.

    channel: from 1; 0 is the platform, where there is one
    kind: such as V.E, P or decoder
    by_index: whether the channel is counted among the active ones
    """
    return cast("Request[int]", request(2, channel=channel, kind=kind, by_index=by_index))


def describe_by_index(
    channel: int, index: int, kind: str, *, by_index: bool = False
) -> Request[VariableDescription]:
    """Variable description by index: ReadWrite to port 552; changes nothing.

    channel: from 1; 0 is the platform, where there is one
    index: from 0 for variables, from 1 for parameters and objects
    kind: such as V.E, P or decoder
    by_index: whether the channel is counted among the active ones
    """
    return cast(
        "Request[VariableDescription]", request(3, channel=channel, index=index, kind=kind, by_index=by_index)
    )


def handle_by_name(channel: int, name: str, *, by_index: bool = False) -> Request[int]:
    """Variable handle by name: ReadWrite to port 552; changes nothing.

    channel: from 1; 0 is the platform, where there is one
    name: of the variable or parameter
    by_index: whether the channel is counted among the active ones
    """
    return cast("Request[int]", request(4, channel=channel, name=name, by_index=by_index))


def read_by_handle(
    channel: int, handle: int, indices: Sequence[int], *, by_index: bool = False
) -> Request[bytes]:
    """Read variable value by handle: ReadWrite to port 552; changes nothing.

    channel: from 1; 0 is the platform, where there is one
    handle: of the variable
    indices: one for each dimension, from 0; none for the whole
    by_index: whether the channel is counted among the active ones
    """
    return cast(
        "Request[bytes]", request(5, channel=channel, handle=handle, indices=indices, by_index=by_index)
    )


def read_by_name(channel: int, name: str, *, by_index: bool = False) -> Request[bytes]:
    """Read variable value by name: ReadWrite to port 552; changes nothing.

    channel: from 1; 0 is the platform, where there is one
    name: of the variable or parameter
    by_index: whether the channel is counted among the active ones
    """
    return cast("Request[bytes]", request(6, channel=channel, name=name, by_index=by_index))


def write_by_handle(
    channel: int, handle: int, indices: Sequence[int], value: bytes, *, by_index: bool = False
) -> Request[None]:
    """Write variable value by handle: Write to port 552; changes a value.

    channel: from 1; 0 is the platform, where there is one
    handle: of the variable
    indices: one for each dimension, from 0; none for the whole
    value: the bytes to write
    by_index: whether the channel is counted among the active ones
    """
    return cast(
        "Request[None]",
        request(7, channel=channel, handle=handle, indices=indices, value=value, by_index=by_index),
    )


def write_by_name(channel: int, name: str, value: bytes, *, by_index: bool = False) -> Request[None]:
    """Write variable value by name: Write to port 552; changes a value.

    channel: from 1; 0 is the platform, where there is one
    name: of the variable or parameter
    value: the bytes to write
    by_index: whether the channel is counted among the active ones
    """
    return cast("Request[None]", request(8, channel=channel, name=name, value=value, by_index=by_index))


def describe_extended(
    channel: int, index: int, kind: str, *, by_index: bool = False
) -> Request[Optional[VariableExtendedDescription]]:
    """Extended variable description by index: ReadWrite to port 552; changes nothing.

    channel: from 1; 0 is the platform, where there is one
    index: from 0 for variables, from 1 for parameters and objects
    kind: such as V.E, P or decoder
    by_index: whether the channel is counted among the active ones
    """
    return cast(
        "Request[Optional[VariableExtendedDescription]]",
        request(9, channel=channel, index=index, kind=kind, by_index=by_index),
    )


def describe_by_name(
    channel: int, name: str, *, by_index: bool = False
) -> Request[VariableDescriptionByName]:
    """Variable description by name: ReadWrite to port 552; changes nothing.

    channel: from 1; 0 is the platform, where there is one
    name: of the variable or parameter
    by_index: whether the channel is counted among the active ones
    """
    return cast(
        "Request[VariableDescriptionByName]", request(10, channel=channel, name=name, by_index=by_index)
    )


def axis_handle_by_name(channel: int, axis: int, name: str, *, by_index: bool = False) -> Request[int]:
    """Axis variable handle by name: ReadWrite to port 552; changes nothing.

    channel: from 1; 0 is the platform, where there is one
    axis: axis of the channel, from 1; of a list with channel 0, a platform axis
    name: of the variable or parameter
    by_index: whether the channel is counted among the active ones
    """
    return cast("Request[int]", request(11, channel=channel, axis=axis, name=name, by_index=by_index))


def axis_read_by_name(channel: int, axis: int, name: str, *, by_index: bool = False) -> Request[bytes]:
    """Read axis variable value by name: ReadWrite to port 552; changes nothing.

    channel: from 1; 0 is the platform, where there is one
    axis: axis of the channel, from 1; of a list with channel 0, a platform axis
    name: of the variable or parameter
    by_index: whether the channel is counted among the active ones
    """
    return cast("Request[bytes]", request(12, channel=channel, axis=axis, name=name, by_index=by_index))


def axis_write_by_name(
    channel: int, axis: int, name: str, value: bytes, *, by_index: bool = False
) -> Request[None]:
    """Write axis variable value by name: Write to port 552; changes a value.

    channel: from 1; 0 is the platform, where there is one
    axis: axis of the channel, from 1; of a list with channel 0, a platform axis
    name: of the variable or parameter
    value: the bytes to write
    by_index: whether the channel is counted among the active ones
    """
    return cast(
        "Request[None]", request(13, channel=channel, axis=axis, name=name, value=value, by_index=by_index)
    )


def count_dynamic(channel: int, kind: str, *, by_index: bool = False) -> Request[int]:
    """Number of dynamic parameters: Read to port 552; changes nothing.

    channel: from 1; 0 is the platform, where there is one
    kind: such as V.E, P or decoder
    by_index: whether the channel is counted among the active ones
    """
    return cast("Request[int]", request(14, channel=channel, kind=kind, by_index=by_index))


def dynamic_name_by_index(channel: int, kind: str, index: int, *, by_index: bool = False) -> Request[str]:
    """Dynamic parameter name by index: ReadWrite to port 552; changes nothing.

    channel: from 1; 0 is the platform, where there is one
    kind: such as V.E, P or decoder
    index: from 0 for variables, from 1 for parameters and objects
    by_index: whether the channel is counted among the active ones
    """
    return cast("Request[str]", request(15, channel=channel, kind=kind, index=index, by_index=by_index))


def dynamic_value_by_name(channel: int, kind: str, name: str, *, by_index: bool = False) -> Request[float]:
    """Dynamic parameter value by name: ReadWrite to port 552; changes nothing.

    channel: from 1; 0 is the platform, where there is one
    kind: such as V.E, P or decoder
    name: of the variable or parameter
    by_index: whether the channel is counted among the active ones
    """
    return cast("Request[float]", request(16, channel=channel, kind=kind, name=name, by_index=by_index))


def dynamic_value_by_index(channel: int, kind: str, index: int, *, by_index: bool = False) -> Request[float]:
    """Dynamic parameter value by index: ReadWrite to port 552; changes nothing.

    channel: from 1; 0 is the platform, where there is one
    kind: such as V.E, P or decoder
    index: from 0 for variables, from 1 for parameters and objects
    by_index: whether the channel is counted among the active ones
    """
    return cast("Request[float]", request(17, channel=channel, kind=kind, index=index, by_index=by_index))


def find_instance(kind: str, channel: int, axis: int, *, by_index: bool = False) -> Request[ObjectAddress]:
    """Object address: ReadWrite to port 552; changes nothing.

    kind: such as V.E, P or decoder
    channel: from 1; 0 is the platform, where there is one
    axis: axis of the channel, from 1; of a list with channel 0, a platform axis
    by_index: whether the channel is counted among the active ones
    """
    return cast(
        "Request[ObjectAddress]", request(18, kind=kind, channel=channel, axis=axis, by_index=by_index)
    )


def count_elements(index_group: int, index_offset: int) -> Request[int]:
    """Number of element types: Read to port 552; changes nothing.

    index_group: of the element or object
    index_offset: of the element or object
    """
    return cast("Request[int]", request(19, index_group=index_group, index_offset=index_offset))


def read_element(index_group: int, index_offset: int, size: int) -> Request[bytes]:
    """Element content: Read to port 552; changes nothing.

    index_group: of the element or object
    index_offset: of the element or object
    size: the most bytes to read
    """
    return cast("Request[bytes]", request(20, index_group=index_group, index_offset=index_offset, size=size))


def write_element(index_group: int, index_offset: int, value: bytes) -> Request[None]:
    """Write element content: Write to port 552; may move an axis.

    index_group: of the element or object
    index_offset: of the element or object
    value: the bytes to write
    """
    return cast("Request[None]", request(21, index_group=index_group, index_offset=index_offset, value=value))


def read_element_name(index_group: int, index_offset: int) -> Request[str]:
    """Element name: Read to port 552; changes nothing.

    index_group: of the element or object
    index_offset: of the element or object
    """
    return cast("Request[str]", request(22, index_group=index_group, index_offset=index_offset))


def read_element_type(index_group: int, index_offset: int) -> Request[str]:
    """Element type: Read to port 552; changes nothing.

    index_group: of the element or object
    index_offset: of the element or object
    """
    return cast("Request[str]", request(23, index_group=index_group, index_offset=index_offset))


def read_element_length(index_group: int, index_offset: int) -> Request[int]:
    """Element length: Read to port 552; changes nothing.

    index_group: of the element or object
    index_offset: of the element or object
    """
    return cast("Request[int]", request(24, index_group=index_group, index_offset=index_offset))


def read_element_unit(index_group: int, index_offset: int) -> Request[str]:
    """Element unit: Read to port 552; changes nothing.

    index_group: of the element or object
    index_offset: of the element or object
    """
    return cast("Request[str]", request(25, index_group=index_group, index_offset=index_offset))


def read_element_write_flag(index_group: int, index_offset: int) -> Request[bool]:
    """Element write flag: Read to port 552; changes nothing.

    index_group: of the element or object
    index_offset: of the element or object
    """
    return cast("Request[bool]", request(26, index_group=index_group, index_offset=index_offset))


def write_program_stream(channel: int, value: bytes, *, by_index: bool = False) -> Request[None]:
    """Data streaming: Write to port 553; may move an axis.

    channel: from 1; 0 is the platform, where there is one
    value: the bytes to write
    by_index: whether the channel is counted among the active ones
    """
    return cast("Request[None]", request(27, channel=channel, value=value, by_index=by_index))


def read_object(index_group: int, index_offset: int, size: int) -> Request[bytes]:
    """Object content: Read to port 553; changes nothing.

    index_group: of the element or object
    index_offset: of the element or object
    size: the most bytes to read
    """
    return cast("Request[bytes]", request(28, index_group=index_group, index_offset=index_offset, size=size))


def write_object(index_group: int, index_offset: int, value: bytes) -> Request[None]:
    """Write object content: Write to port 553; may move an axis.

    index_group: of the element or object
    index_offset: of the element or object
    value: the bytes to write
    """
    return cast("Request[None]", request(29, index_group=index_group, index_offset=index_offset, value=value))


__all__ = [
    "AmsTcpHeader",
    "AmsHeader",
    "ReadRequest",
    "ReadReply",
    "WriteRequest",
    "ReadWriteRequest",
    "ReadWriteReply",
    "DeviceInfoReply",
    "DeviceStateReply",
    "ObjectDescriptor",
    "VariableIndexKind",
    "VariableDescription",
    "VariableHandleRead",
    "VariableHandleWrite",
    "VariableNameWrite",
    "VariableExtendedDescription",
    "ObjectAddressQuery",
    "ObjectAddress",
    "VariableDescriptionByName",
    "count_objects",
    "read_descriptors",
    "count_variables",
    "describe_by_index",
    "handle_by_name",
    "read_by_handle",
    "read_by_name",
    "write_by_handle",
    "write_by_name",
    "describe_extended",
    "describe_by_name",
    "axis_handle_by_name",
    "axis_read_by_name",
    "axis_write_by_name",
    "count_dynamic",
    "dynamic_name_by_index",
    "dynamic_value_by_name",
    "dynamic_value_by_index",
    "find_instance",
    "count_elements",
    "read_element",
    "write_element",
    "read_element_name",
    "read_element_type",
    "read_element_length",
    "read_element_unit",
    "read_element_write_flag",
    "write_program_stream",
    "read_object",
    "write_object",
]
