"""Reads and writes the simulated CNC with pyads, over the AdsLib in its wheel.

python pyads_client.py HOST EXPECTED.json: AdsLib always connects to TCP port 48898.
"""

import ctypes
import json
import sys

import ads_cnc
import pyads
from pyads.pyads_ex import _adsDLL as ads_lib

NET_ID = "127.0.0.1.1.1"


# Sends a request and decodes only the received bytes of the reply. Calls AdsLib, because Connection.read_write of
# pyads does not return their number.
def send(request):
    reply, received = ctypes.create_string_buffer(request.read_length), ctypes.c_uint32()
    to = local_port, ctypes.byref(pyads.AmsAddr(NET_ID, request.port).amsAddrStruct())
    at = ctypes.c_uint32(request.index_group), ctypes.c_uint32(request.index_offset)
    room = ctypes.c_uint32(request.read_length), reply
    data = ctypes.c_uint32(len(request.data)), ctypes.c_char_p(request.data)
    if request.command == 2:
        code = ads_lib.AdsSyncReadReqEx2(*to, *at, *room, ctypes.byref(received))
    elif request.command == 3:
        code = ads_lib.AdsSyncWriteReqEx(*to, *at, *data)
    else:
        code = ads_lib.AdsSyncReadWriteReqEx2(*to, *at, *room, *data, ctypes.byref(received))
    if code:
        raise pyads.ADSError(code)
    return request.decode(reply.raw[: received.value])


def check(what, found, expected):
    if found != expected:
        sys.exit(f"{what}: {found!r}, expected {expected!r}")


def shown(what, found, expected):
    check(what, found, expected)
    print(f"{what}: {json.dumps(found, ensure_ascii=False, separators=(',', ':'))}")


def read(name):
    description = send(ads_cnc.describe_by_name(1, name))
    value = send(ads_cnc.read_by_name(1, name))
    return ads_cnc.unpack(description.type, value, description.dimensions)


host, expected_file = sys.argv[1:]
with open(expected_file, encoding="utf-8") as file:
    expected = json.load(file)
local_port = pyads.open_port()
pyads.set_local_address("127.0.0.1.1.7")
pyads.add_route(NET_ID, host)

# Describe all variables of the kind V.E, by index.
types = {type.code: type.name for type in ads_cnc.TYPES}
count = send(ads_cnc.count_variables(1, "V.E"))
listed = [send(ads_cnc.describe_by_index(1, index, "V.E")) for index in range(count)]
check("V.E", [[it.name, types[it.type], it.dimensions] for it in listed], expected["variables"])
print(f"V.E: {count} variables, {listed[0].name} to {listed[-1].name}")

for name, value in expected["read"].items():
    shown(name, read(name), value)
for name, (type, value) in expected["write"].items():
    send(ads_cnc.write_by_name(1, name, ads_cnc.pack(type, value)))
    shown(f"{name}, written", read(name), value)

# Find an element of SDA by its name: query the instance of the class, then read the names of its elements.
instance = send(ads_cnc.find_instance("HLD", 1, 0))
group, first = instance.index_group, instance.index_offset
for at in range(first + 1, first + 1 + send(ads_cnc.count_elements(group, first))):
    name = send(ads_cnc.read_element_name(group, at))
    if name == expected["element"][0]:
        type, size = send(ads_cnc.read_element_type(group, at)), send(ads_cnc.read_element_length(group, at))
        value = ads_cnc.unpack(type, send(ads_cnc.read_element(group, at, size)))
        shown(f"{name} at {group:#x}, {at}", [type, value], expected["element"][1:])
        break
else:
    sys.exit(f"no element {expected['element'][0]}")

try:
    sys.exit(f"V.E.nothing: {read('V.E.nothing')}")
except pyads.ADSError as error:
    shown("V.E.nothing, ADS error", error.err_code, 0x710)

# Connection.read_write raises an exception for a reply shorter than its buffer, or appends zeros to it.
request = ads_cnc.describe_by_index(1, 0, "V.E")
room, data = ctypes.c_ubyte * request.read_length, ctypes.c_ubyte * len(request.data)
ask = request.index_group, request.index_offset, room, list(request.data), data
with pyads.Connection(NET_ID, request.port, host) as plc:
    try:
        sys.exit(f"not rejected: {plc.read_write(*ask)}")
    except RuntimeError as error:
        check("a short reply", str(error).split(" (")[0], "Insufficient data")
    padded = bytes(plc.read_write(*ask, check_length=False))
try:
    sys.exit(f"padded: {request.decode(padded)}")
except ads_cnc.AdsCncError as error:
    shown("a padded reply", [error.stream, error.field, error.offset], ["variable-description", "name", 20])
