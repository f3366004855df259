"""Write the AMS frames of a TCP capture to a pcap file, each in an EtherCAT frame as in a file of the ADS Monitor.

    .ci/ads_monitor.py <FIELDS >PCAP

FIELDS is the output of tshark with a line for each packet: time, TCP stream, source port, and payload in hex.
"""
import struct
import sys

ETHERCAT = bytes.fromhex("01010501000002000000000188a4")
begun = {}
frames = 0
out = sys.stdout.buffer
out.write(struct.pack("<IHHiIII", 0xA1B2C3D4, 2, 4, 0, 0, 0x40000, 1))
for row in sys.stdin:
    time, stream, port, payload = row.rstrip("\n").split("\t")
    seconds, micros = divmod(round(float(time) * 1_000_000), 1_000_000)
    data = begun.get((stream, port), b"") + bytes.fromhex(payload)
    while len(data) >= 6 and len(data) >= 6 + int.from_bytes(data[2:6], "little"):
        length = int.from_bytes(data[2:6], "little")
        ams, data = data[6 : 6 + length], data[6 + length :]
        packet = ETHERCAT + struct.pack("<H", length & 0x7FF | 2 << 12) + ams
        out.write(struct.pack("<IIII", seconds, micros, len(packet), len(packet)) + packet)
        frames += 1
    begun[stream, port] = data
print(frames, "AMS frames", file=sys.stderr)
