#!/usr/bin/env python3
"""The Python package and its C library as a testee; conformance/adapters/README.md describes the protocol.

ads-cnc run --testee "python3 codec/bindings/python/testee.py"
"""

import json
import math
import sys

import ads_cnc

# The field of each stream whose value needs a type in addition to its bytes.
TYPED = {
    "content": "content",
    "variable-value": "value",
    "variable-handle-write": "value",
    "variable-name-write": "value",
}
SERVICES = {
    (2, 4): "read-request",
    (3, 4): "write-request",
    (9, 4): "read-write-request",
    (2, 5): "read-reply",
    (3, 5): "write-reply",
    (9, 5): "read-write-reply",
}
STREAMS = [*ads_cnc.STREAMS, "ams-frame", "variable-path", "index-group", "index-offset"]
TYPES = {name: it for it in ads_cnc.TYPES for name in (it.name, it.object_name)}
OPS, EDITIONS = ["decode", "encode", "packets"], ["en-1.05", "de-1.051"]


class Unsupported(Exception):
    pass


def text(data, is_padded=False):
    head, nul, tail = data.partition(b"\0")
    out = {"type": "STRING", "hex": head.hex(" "), "value": ads_cnc.text_from_cp1252(head)}
    if not nul:
        out["open"] = True
    elif tail and not (is_padded and not tail.strip(b"\0")):
        out["tail"] = tail.hex(" ")
    return out


def number(kind, data):
    if TYPES[kind].format in "fd":
        return {"type": kind, "bits": "0x" + data[::-1].hex()}
    is_signed = TYPES[kind].format in "bhiq"
    return {"type": kind, "value": str(int.from_bytes(data, "little", signed=is_signed))}


def elements(context, data):
    if "type" not in context or context["type"] not in TYPES:
        raise Unsupported("context")
    kind, count = context["type"], math.prod(context.get("dimensions", []))
    # `unpack` raises an error if the data does not have the length of the value.
    ads_cnc.unpack(kind, data, context.get("dimensions", []))
    size = len(data) // max(count, 1)
    parts = [data[at * size : (at + 1) * size] for at in range(count)]
    return [text(part) if kind == "STRING" else number(kind, part) for part in parts]


def value(row, data):
    if row.kind == 1:
        return number(f"UNS{8 * len(data):02}", data)
    if row.kind in (2, 3):
        return number("BOOLEAN" if row.kind == 2 else "REAL64", data)
    if row.kind == 4:
        return text(data, row.size > 0)
    if row.kind == 5:
        return {"type": "NETID", "value": ".".join(map(str, data))}
    return {"type": "BYTES", "hex": data.hex(" ")}


def decode(stream, data, context):
    if stream in OTHERS:
        return OTHERS[stream][0](data, context)
    if stream == "ams-frame":
        return decode_frame(data)
    rows = {row.name: row for row in ads_cnc.STREAMS[stream].fields if not row.is_count}
    records = []
    for field in ads_cnc.fields(stream, data):
        if field.record == len(records):
            records.append({name: [] for name, row in rows.items() if row.is_list})
        row, record = rows.get(field.name), records[field.record]
        if row is None:
            continue
        if TYPED.get(stream) == field.name and (context or stream != "content"):
            record[field.name] = elements(context, field.data)
        elif row.is_list:
            record[field.name].append(value(row, field.data))
        else:
            record[field.name] = value(row, field.data)
    if ads_cnc.STREAMS[stream].repeats:
        return {"descriptors": records}
    return records[0] if records else {}


def named(**words):
    return {name: {"type": "NAME", "value": word} for name, word in words.items() if word}


def open_text(text):
    return {"type": "STRING", "hex": ads_cnc.text_to_cp1252(text).hex(" "), "value": text, "open": True}


def number_of(kind, value):
    return {"type": kind, "value": str(value)}


def decode_path(data, _):
    path = ads_cnc.path(ads_cnc.text_from_cp1252(data))
    if b"\0" in data:
        raise ValueError("a NUL in a name")
    parts = [
        {"name": open_text(name), "indices": [number_of("UNS32", index) for index in indices]}
        for name, indices in path.parts
    ]
    return {"kind": open_text(path.kind), "parts": parts}


def decode_group(data, context):
    # Decode the group as a count, because both are numbers of four bytes.
    number = ads_cnc.decode("object-count", data)
    out = {"index_group": number_of("UNS32", number)}
    if "base" in context and not 0 <= number - int(context["base"], 16) <= 255:
        raise ValueError("index group outside the range of its base")
    group = ads_cnc.group_parts(number)
    if group:
        words = {"object_class": "class", "attribute": "attribute"}
        out |= named(
            **{
                words.get(name, name): word.lower().replace(" ", "-")
                for name, word in zip(group._fields, group[:-1])
            }
        )
        out |= named(task=group.task) | {"instance": number_of("UNS08", group.instance)}
    return out


def decode_offset(data, context):
    if "stride" not in context:
        raise Unsupported("context")
    offset = ads_cnc.decode("object-count", data)
    axis, element = ads_cnc.axis_and_element(offset, int(context["stride"], 16))
    return {"axis": number_of("UNS16", axis), "element": number_of("UNS16", element)}


def encode_path(given, _):
    def text(part):
        return ads_cnc.text_from_cp1252(bytes.fromhex(part["hex"]))

    parts = [
        text(part["name"]) + "".join(f"[{int(one['value'])}]" for one in part["indices"])
        for part in given["parts"]
    ]
    name = ".".join([text(given["kind"]), *parts])
    ads_cnc.path(name)
    return ads_cnc.text_to_cp1252(name)


def encode_group(given, _):
    return ads_cnc.encode("object-count", int(given["index_group"]["value"]))


def encode_offset(given, context):
    axis, element = (int(given[name]["value"]) for name in ("axis", "element"))
    return ads_cnc.encode("object-count", ads_cnc.axis_offset(axis, element, int(context["stride"], 16)))


# Subjects that are not streams of the table, except `ams-frame`.
OTHERS = {
    "variable-path": (decode_path, encode_path),
    "index-group": (decode_group, encode_group),
    "index-offset": (decode_offset, encode_offset),
}


def decode_frame(data):
    found = ads_cnc.read_frame(data)
    if found is None or found[1] != len(data):
        raise ValueError("not exactly one frame")
    frame, out = found[0], {}
    for stream, part in (("ams-tcp-header", data[:6]), ("ams-header", data[6:38])):
        out[stream.replace("-", "_")] = decode(stream, part, {})
    del out["ams_tcp_header"]["length"], out["ams_header"]["data_length"]
    if frame.data or not frame.error:
        service = SERVICES.get((frame.command, frame.state_flags))
        name = service.replace("-", "_") if service else "data"
        out[name] = (
            decode(service, frame.data, {}) if service else {"type": "BYTES", "hex": frame.data.hex(" ")}
        )
    return out


def write(part):
    if isinstance(part, list):
        return b"".join(map(write, part))
    if part["type"] == "NETID":
        return bytes(map(int, part["value"].split(".")))
    if "hex" in part:
        nul = b"" if "open" in part or part["type"] == "BYTES" else b"\0"
        return bytes.fromhex(part["hex"]) + nul + bytes.fromhex(part.get("tail", ""))
    kind = TYPES[part["type"]]
    if "bits" in part:
        return int(part["bits"], 16).to_bytes(kind.size, "little")
    return int(part["value"]).to_bytes(kind.size, "little", signed=kind.format in "bhiq")


def encode(stream, given, context):
    if stream in OTHERS:
        return OTHERS[stream][1](given, context)
    if stream == "ams-frame":
        return encode_frame(given)
    parts = []
    for record in given["descriptors"] if ads_cnc.STREAMS[stream].repeats else [given]:
        for row in ads_cnc.STREAMS[stream].fields:
            if row.name in record:
                part = record[row.name]
                items = part if row.is_list else [part]
                data = [write(item) for item in items]
                # A text that fills its field has no NUL.
                parts += [(row.name, one[: row.size] if row.kind == 4 and row.size else one) for one in data]
    return ads_cnc.join(stream, parts)


def encode_frame(given):
    header = {name: part["value"] for name, part in given["ams_header"].items()}
    target, source = ((header[f"{end}_net_id"], int(header[f"{end}_port"])) for end in ("target", "source"))
    service = next((name for name in given if name not in ("ams_tcp_header", "ams_header")), None)
    data = b""
    if service:
        part = given[service]
        data = write(part) if service == "data" else encode(service.replace("_", "-"), part, {})
    numbers = (int(header[name]) for name in ("command", "state_flags", "error", "invoke_id"))
    return ads_cnc.Frame(target, source, *numbers, data).encode()


def work(case):
    for what, known in (("op", OPS), ("edition", EDITIONS)):
        if case[what] not in known:
            raise Unsupported(what)
    if case["op"] == "packets":
        sender, packets = ads_cnc.Sender(bytes.fromhex(case["hex"])), []
        for packet in sender:
            packets.append(packet.hex())
            sender.acknowledge(0)
        return {"packets": packets}
    if case["stream"] not in STREAMS:
        raise Unsupported("stream")
    if case["op"] == "decode":
        return {"value": decode(case["stream"], bytes.fromhex(case["hex"]), case["context"])}
    return {"hex": encode(case["stream"], case["value"], case["context"]).hex()}


def answer(line):
    seq = None
    try:
        asked = json.loads(line)
        if asked["cmd"] == "hello":
            capabilities = {"ops": OPS, "streams": STREAMS, "editions": EDITIONS}
            testee = {"name": "ads-cnc for Python", "version": "0.2.0", "language": "Python"}
            return {"protocol": 1, "testee": testee, "capabilities": capabilities}
        if asked["cmd"] == "bye":
            return None
        seq = asked["seq"]
        return {"seq": seq, "ok": work(asked)}
    except Unsupported as what:
        return {"seq": seq, "unsupported": {"what": what.args[0]}}
    except ads_cnc.AdsCncError as error:
        return {"seq": seq, "reject": {"class": error.kind, "at": error.offset, "message": str(error)}}
    except ValueError as error:
        if seq is None:
            return {"seq": None, "error": {"message": "the line is not valid JSON"}}
        return {"seq": seq, "reject": {"class": "value", "message": str(error)}}
    except Exception as error:  # answer with the error, and continue with the next line
        return {"seq": seq, "error": {"message": repr(error)}}


if __name__ == "__main__":
    for line in sys.stdin.buffer:
        reply = answer(line)
        if reply is None:
            break
        print(json.dumps(reply), flush=True)
