"""The streaming interface of a CNC, a client that streams a text, and the bytes of one write."""
import re

from . import nc
from .pieces import Bad, agree, to_bytes
from .scalars import Malformed, from_hex, to_hex
from .steps import follow

STREAM_MAX = 4094
LINE_END_ERROR = 21476


def program_stream_write(value, _context):
    return [("data", from_hex(value["data"]["hex"]))]


def program_stream_read(data, _context):
    """Decode the data of one write: any bytes, at least one byte and at most PACKET_MAX bytes."""
    if len(data) > nc.PACKET_MAX:
        raise Malformed("too-long", 0, "data")
    if not data:
        raise Malformed("truncated", 0, "data")
    return {"data": {"type": "BYTES", "hex": to_hex(data)}}


STREAMS = {"program-stream": (program_stream_write, program_stream_read)}


class Model:
    def __init__(self, text):
        self.buffered, self.running, self.program = b"", False, b""
        self.to_send = None if text is None else nc.packets(text)

    def step(self, step):
        """Execute a step and compare its outcome; return the class of its fault, or None."""
        outcome = {"error": None, "discarded": None, "ends": None}
        cls = getattr(self, step["action"])(step, outcome)
        if cls == "not-started":
            return cls  # the stated outcome belongs to the fault, so it is not compared
        for key in outcome:
            agree("%s: %s" % (step["id"], key), step.get(key), outcome[key])
        if cls in ("outcome", "overfull"):
            return cls  # the stated `buffered` belongs to the fault, so it is not compared
        agree("%s: buffered" % step["id"], step["buffered"], len(self.buffered))
        return cls

    def start(self, _step, _outcome):
        self.running, self.program = True, b""

    def reset(self, _step, _outcome):
        self.running, self.buffered = False, b""

    def write(self, step, _outcome):
        data, ack, cls = to_bytes(step["bytes"]), step["ack"], None
        if self.to_send is not None:
            if self.to_send[:1] != [data]:
                cls = "order"
            elif ack == "accepted":
                self.to_send.pop(0)
        if len(data) > nc.PACKET_MAX:
            agree("%s: ack" % step["id"], ack, "rejected")
            return "too-long"
        if len(self.buffered) + len(data) > STREAM_MAX:
            if ack == "accepted":
                return "overfull"
            agree("%s: ack" % step["id"], ack, "later")
            return cls
        agree("%s: ack" % step["id"], ack, "accepted")
        self.buffered += data
        return cls

    def take(self, step, outcome):
        if not self.running:
            return "not-started"
        if to_bytes(step["bytes"]) != self.buffered:
            return "outcome"
        data, self.buffered = self.buffered, b""
        before = len(nc.split(self.program))
        end = missing_end(data)
        if end:
            line, column = end
            error = {"number": LINE_END_ERROR, "line": before + line, "column": column}
            outcome["error"] = error
            return "line-end"
        self.program += data
        program = nc.Program(self.program)
        for cls, line, column, _ in program.findings():
            if line > before and cls in ("loop", "backward-jump"):
                outcome["error"] = {"line": line, "column": column}
                return cls
        if program.ends:
            self.running = False
            line, outcome["ends"] = program.ends[0]
            lines = [one + b"\r\n" for one in nc.split(data)]
            after = b"".join(lines[line - before:])
            if after:
                outcome["discarded"] = text_of(step["discarded"], after)
            if any(position > line for position, _ in program.code):
                return "lost"
        return None


def text_of(pieces, data):
    """Check that the pieces are these bytes, and return the pieces."""
    agree("discarded", to_bytes(pieces), data)
    return pieces


def missing_end(data):
    """The line and the column of the first end of a line that is not CR LF; None if all ends are."""
    line = 1
    for end in re.finditer(rb"\r\n|\r|\n|\Z", data):
        start = max(data.rfind(b"\n", 0, end.start()), data.rfind(b"\r", 0, end.start())) + 1
        if end.group() != b"\r\n" and (end.group() or start < len(data)):
            return line, end.start() - start + 1
        line += 1
    return None


def check(case):
    given = case["given"]["streaming"]
    model = Model(to_bytes(given["text"]) if "text" in given else None)
    if follow(model, given, case["expect"]) and model.to_send:
        raise Bad("%d packets are not sent" % len(model.to_send))
