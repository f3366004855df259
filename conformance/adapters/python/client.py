#!/usr/bin/env python3
"""Executes the actions of `ads-cnc run --client` with the client in cnc.py. See ../CLIENTS.md.

    ads-cnc run --client "python3 client.py"

This program executes the actions that it reads from stdin. If the environment variable ADS_CNC_DO contains an
action, the program executes only that action and exits.
"""
import json
import os
import struct
import sys

from cnc import *


def axis(number):
    return int(number) * 0x10000


ACTIONS = {
    "count-objects": lambda cnc, ch: cnc.count_objects(ch),
    "list-objects": lambda cnc, ch: cnc.objects(ch),
    "read-object": read_object,
    "write-object": write_object,
    "count-variables": lambda cnc, ch, kind: number(cnc.variable(ch, 0x44, nul("" if kind == "all" else kind), 4)),
    "describe": describe,
    "describe-extended": extended,
    "handle": lambda cnc, ch, name: number(cnc.variable(ch, 0x46, nul(name), 4)),
    "read-by-name": lambda cnc, ch, name, ty: decode(ty, cnc.variable(ch, 0x48, nul(name), 2048)),
    "write-by-name": lambda cnc, ch, name, ty, value: write_variable(cnc, ch, 0x4A, nul(name) + encode(ty, value)),
    "read-by-handle": lambda cnc, ch, handle, at, ty: decode(ty, cnc.variable(ch, 0x47, handled(handle, at), 2048)),
    "write-by-handle": lambda cnc, ch, handle, at, ty, value:
        write_variable(cnc, ch, 0x49, handled(handle, at) + encode(ty, value)),
    "axis-handle": lambda cnc, ch, ax, name: number(cnc.variable(ch, axis(ax) + 4, nul(name), 4)),
    "read-axis": lambda cnc, ch, ax, name, ty: decode(ty, cnc.variable(ch, axis(ax) + 5, nul(name), 2048)),
    "write-axis": lambda cnc, ch, ax, name, ty, value:
        write_variable(cnc, ch, axis(ax) + 6, nul(name) + encode(ty, value)),
    "count-parameters": lambda cnc, ch, kind: number(cnc.ask(READ, SDA, 0x122300 + int(ch), 2 + KINDS[kind], length=4)),
    "parameter-name": lambda cnc, ch, kind, at: text(parameter(cnc, ch, kind, 0x1B, index(at), 96)),
    "parameter-by-name": lambda cnc, ch, kind, name: take("<d", parameter(cnc, ch, kind, 0x1C, nul(name), 8)),
    "parameter-by-index": lambda cnc, ch, kind, at: take("<d", parameter(cnc, ch, kind, 0x1D, index(at), 8)),
    "find-instance": instance,
    "count-elements": lambda cnc, *at: number(element(cnc, "", *at)[0](4)),
    "element-name": lambda cnc, *at: text(element(cnc, "name", *at)[0](256)),
    "element-type": lambda cnc, *at: text(element(cnc, "type", *at)[0](256)),
    "element-unit": lambda cnc, *at: text(element(cnc, "unit", *at)[0](256)),
    "element-length": lambda cnc, *at: int.from_bytes(element(cnc, "length", *at)[0](4), "little"),
    "element-writable": lambda cnc, *at: take("<?", element(cnc, "writable", *at)[0](1)),
    "read-element": lambda cnc, *at: element_content(cnc, *at[:-1], kind=at[-1]),
    "write-element": write_element,
    "stream": stream,
    "serve-echo": serve,
    "ask-service": ask_service,
}


def act(where, action, args):
    if action not in ACTIONS:
        return {"unsupported": action}
    try:
        return {"result": ACTIONS[action](Cnc(where), *args)}
    except Rejected as rejected:
        return {"error": f"ADS error {rejected.args[0]:#x}"}
    except (Wrong, OSError, struct.error, ValueError) as error:
        return {"error": str(error)}


def say(answer):
    print(json.dumps(answer), flush=True)


def main():
    words = os.environ.get("ADS_CNC_DO", "hello").split()
    if words[0] != "hello":
        where = {"host": os.environ["ADS_CNC_HOST"], "tcp_port": os.environ["ADS_CNC_TCP_PORT"],
                 "net_id": os.environ["ADS_CNC_NET_ID"]}
        say(act(where, words[0], words[1:]))
        return
    say({"protocol": 1, "client": {"name": "example", "version": "1", "language": "Python"},
         "actions": list(ACTIONS), "stays": True})
    for line in sys.stdin:
        command = json.loads(line)
        if command["cmd"] == "bye":
            break
        say(act(command, command["action"], command["args"]))


if __name__ == "__main__":
    main()
