"""NC text: its division into packets, and the constructs that streaming does not permit."""
import re

from .pieces import Bad, agree, to_bytes

PACKET_MAX = 992
LINE_MAX = PACKET_MAX - len(b"\r\n")


def split(data):
    """The lines of a text, without their line ends."""
    lines = re.split(rb"\r\n|\r|\n", data)
    return lines[:-1] if lines[-1] == b"" else lines


def packets(data):
    """The packets of a text: each packet has as many whole lines as fit."""
    made = []
    for line in split(data):
        line += b"\r\n"
        if made and len(made[-1]) + len(line) <= PACKET_MAX:
            made[-1] += line
        else:
            made.append(line)
    return made


def fault_of(data):
    """The first fault because of which a text cannot be sent; None if it can be sent."""
    for number, line in enumerate(split(data), 1):
        for column, byte in enumerate(line, 1):
            if column > LINE_MAX:
                return {"class": "too-long", "line": number, "column": column}
            if byte == 0 or byte > 0x7F:
                return {"class": "nul" if byte == 0 else "not-ascii", "line": number, "column": column}
    return None


def check_text(case):
    data, expect = to_bytes(case["given"]["nc-text"]), case["expect"]
    fault = fault_of(data)
    if "reject" in expect:
        agree("fault", expect["reject"], fault)
        return
    if fault:
        raise Bad("the case states that the text is accepted, but it has the fault %s" % fault)
    stated = [to_bytes(packet) for packet in expect["accept"]["packets"]]
    agree("packets", stated, packets(data))


# ---------------------------------------------------------------- constructs that are not permitted

LOOPS = ("FOR", "ENDFOR", "DO", "ENDDO", "REPEAT", "UNTIL", "WHILE", "ENDWHILE")
CLAUSES = {"loop": "STM-8", "backward-jump": "STM-8", "open-comment": "STM-9", "after-end": "STM-10"}
HEAD = r"\s*(?:/\d*\s*)?(?:N\s*\d+\s*)?"
BLOCK_BEGIN = re.compile(HEAD + r"(#COMMENT\s+BEGIN)(?![\w.])", re.I)
BLOCK_END = re.compile(HEAD + r"#COMMENT\s+END(?![\w.])", re.I)
LABEL = re.compile(r"\s*(?:/\d*\s*)?N\s*0*(\d+)\s*:", re.I)
COMMAND = re.compile(r"\$([A-Z]+)", re.I)
GOTO = re.compile(r"\$GOTO\s*N\s*0*(\d+)\s*(?![-+*/.\[_=\d])", re.I)
# a program end, but not one that is part of a name, such as V.E.M30
PROGRAM_END = re.compile(r"(?<![A-Z_])(?<![A-Z_\]]\.)M0*(2|30|17|29)(?![\d._])", re.I)


def masked(line):
    """The line with spaces in place of comments and quoted text."""
    out, depth, at = "", 0, 0
    while at < len(line):
        quoted = re.match(r'"[^"]*"', line[at:]) if depth == 0 else None
        if quoted:
            out += " " * len(quoted.group())
            at += len(quoted.group())
            continue
        character = line[at]
        if character == ";" and depth == 0:
            return out.ljust(len(line))
        hidden = depth > 0 or character == "("
        if character == "(":
            depth += 1
        elif character == ")" and depth:
            depth -= 1
        out += " " if hidden else character
        at += 1
    return out


class Program:
    """A text, parsed line by line: its code, labels, jumps, loop keywords and program ends."""

    def __init__(self, data):
        self.labels, self.jumps, self.loops, self.ends, self.code = [], [], [], [], []
        self.open_block = None
        for number, raw in enumerate(split(data), 1):
            self.line(number, raw.decode("latin-1"))

    def line(self, number, line):
        if self.open_block:
            if BLOCK_END.match(line):
                self.open_block = None
            return
        begin = BLOCK_BEGIN.match(line)
        if begin:
            self.open_block = (number, begin.start(1) + 1)
            return
        line = masked(line)
        if not line.strip():
            return
        self.code.append((number, len(line) - len(line.lstrip()) + 1))
        if line.startswith("%"):
            return
        label = LABEL.match(line)
        if label:
            self.labels.append((int(label.group(1)), number))
        for word in COMMAND.finditer(line):
            if word.group(1).upper() in LOOPS:
                self.loops.append((number, word.start() + 1))
        for jump in GOTO.finditer(line):
            self.jumps.append((number, jump.start() + 1, int(jump.group(1))))
        for end in PROGRAM_END.finditer(line):
            self.ends.append((number, "M" + end.group(1)))

    def findings(self):
        found = [("loop", line, column, None) for line, column in self.loops]
        for line, column, label in self.jumps:
            targets = [target for name, target in self.labels if name == label]
            if targets and max(targets) <= line:
                found.append(("backward-jump", line, column, max(targets)))
        for end in sorted({line for line, _ in self.ends}):
            after = [position for position in self.code if position[0] > end]
            if after:
                found.append(("after-end", *after[0], end))
        if self.open_block:
            found.append(("open-comment", *self.open_block, None))
        return sorted(found, key=lambda one: one[1:3])


def check_program(case):
    data = b"".join(to_bytes(packet) for packet in case["given"]["nc-check"])
    if fault_of(data) or not data.endswith(b"\r\n"):
        raise Bad("the packets are not a text of whole lines")
    derived = []
    for cls, line, column, refers_to in Program(data).findings():
        derived.append({"class": cls, "clause": CLAUSES[cls], "line": line, "column": column})
        if refers_to is not None:
            derived[-1]["refers_to"] = refers_to
    expect = case["expect"]
    agree("findings", [expect["reject"]] if "reject" in expect else [], derived)
