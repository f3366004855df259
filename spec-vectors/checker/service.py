"""The five variables of the Service Interface, the program that sends requests, and the services."""
import math
import re

from .pieces import Bad, agree, to_bytes
from .steps import follow

TEXT_MAX = 128
TEXTS, STATES = ("UUID", "REQUEST", "RESPONSE"), ("REQUEST_STATE", "RESPONSE_STATE")
PREFIX = "V.G.SERVICE."
UUID = re.compile(r"[0-9A-F]{8}(-[0-9A-F]{4}){3}-[0-9A-F]{12}", re.I)
NUMBER = re.compile(r"\s*[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?", re.I)


def square_root(request):
    """The response and the state that the C code of the example computes with atof, sqrt and %f."""
    number = NUMBER.match(request.decode("latin-1"))
    x = float(number.group()) if number else 0.0
    if x >= 0:
        return b"%f" % math.sqrt(x), 1
    return b"ERROR: cannot calc square root of negative number %f" % x, 99


DOES = {"square-root": square_root}


def u32(number):
    return number.to_bytes(4, "little")


class Interface:
    """The five variables of one channel."""

    def __init__(self):
        self.values = {name: b"\0" for name in TEXTS}
        self.values.update({name: u32(0) for name in STATES})

    def fault(self, name, data):
        if name in STATES:
            return None if len(data) == 4 else "truncated" if len(data) < 4 else "trailing"
        return "too-long" if len(data.split(b"\0")[0]) + 1 > TEXT_MAX else None

    def write(self, name, data):
        if name in STATES:
            self.values[name] = data
            self.values["RESPONSE_STATE" if name == "REQUEST_STATE" else "REQUEST_STATE"] = u32(0)
        else:
            self.values[name] = data.split(b"\0")[0] + b"\0"

    def text(self, name):
        return self.values[name][:-1]

    def state(self, name):
        return int.from_bytes(self.values[name], "little")


class Actor:
    """The state of a program or a service, and the writes that it must perform next."""

    def __init__(self, service=None):
        self.service, self.to_write = service, []
        self.serving = None
        self.keep_waiting, self.longest, self.since = 0, None, None


class Model:
    def __init__(self, services):
        self.interfaces = {}
        self.actors = {name: Actor(service) for name, service in services.items()}
        self.actors["program"] = Actor()
        self.now = 0

    def step(self, step):
        """Execute a step, and return the class of its fault, or None."""
        self.now, before = step.get("at", self.now), self.now
        if self.now < before:
            raise Bad("%s: its time is before that of the previous step" % step["id"])
        interface = self.interfaces.setdefault(step.get("channel", 1), Interface())
        if step["actor"] == "other":
            actor = None
        elif step["actor"] in self.actors:
            actor = self.actors[step["actor"]]
        else:
            raise Bad("%s: no such actor: %s" % (step["id"], step["actor"]))
        return getattr(self, step["action"])(step, actor, interface)

    # actions of any actor

    def read(self, step, _actor, interface):
        return None if interface.values[variable(step)] == to_bytes(step["bytes"]) else "outcome"

    def write(self, step, actor, interface):
        name, data = variable(step), to_bytes(step["bytes"])
        if actor is not None:
            if not actor.to_write or actor.to_write[0] != (name, data):
                return "order"
            actor.to_write.pop(0)
        cls = interface.fault(name, data)
        if cls is None:
            interface.write(name, data)
        if actor is self.actors["program"] and name == "REQUEST_STATE":
            actor.since = self.now
        return cls

    # actions of the program

    def ask(self, step, program, _interface):
        request, state = to_bytes(step["request"]), int(step.get("request_state", "1"))
        wait = {name: int(value) for name, value in step.get("wait", {}).items()}
        if not UUID.fullmatch(step["uuid"]):
            return "truncated" if len(step["uuid"]) < 36 else "trailing" if len(step["uuid"]) > 36 else "unexpected"
        if len(request) + 1 > TEXT_MAX:
            return "too-long"
        if state == 0:
            return "out-of-range"
        if "p2" in wait and "p3" not in wait:
            return "missing"
        program.keep_waiting, program.longest = wait.get("p1", 0), wait.get("p2")
        program.since = None
        program.to_write = [("UUID", step["uuid"].encode() + b"\0"), ("REQUEST", request + b"\0"),
                            ("REQUEST_STATE", u32(state))]
        return None

    def waits_on(self, program, interface):
        if program.since is None or program.to_write:
            raise Bad("the program has not sent a request")
        return interface.state("RESPONSE_STATE") == program.keep_waiting

    def over(self, program):
        return program.longest is not None and self.now >= program.since + program.longest

    def wait(self, _step, program, interface):
        return None if self.waits_on(program, interface) and not self.over(program) else "outcome"

    def timeout(self, _step, program, interface):
        if not self.waits_on(program, interface):
            return "outcome"
        return None if self.over(program) else "too-early"

    def done(self, step, program, interface):
        if self.waits_on(program, interface):
            return "too-early"
        got = (interface.text("RESPONSE"), interface.state("RESPONSE_STATE"))
        return None if got == response(step) else "outcome"

    # actions of a service

    def is_asked(self, service, interface):
        own = service.service["uuid"].encode().lower()
        return interface.text("UUID").lower() == own and interface.state("REQUEST_STATE") != 0

    def idle(self, _step, service, interface):
        return "outcome" if self.is_asked(service, interface) else None

    def serve(self, step, service, interface):
        if not self.is_asked(service, interface):
            return "not-asked"
        service.serving = interface.text("REQUEST")
        got = (service.serving, interface.state("REQUEST_STATE"))
        return None if got == (to_bytes(step["request"]), int(step["request_state"])) else "outcome"

    def answer(self, step, service, _interface):
        text, state = response(step)
        if service.serving is None:
            return "order"
        if len(text) + 1 > TEXT_MAX:
            return "too-long"
        if state == 0:
            return "out-of-range"
        does = service.service.get("does")
        if does is not None and (text, state) != DOES[does](service.serving):
            return "outcome"
        service.serving = None
        service.to_write = [("RESPONSE", text + b"\0"), ("REQUEST_STATE", u32(0)), ("RESPONSE_STATE", u32(state))]
        return None


def response(step):
    return to_bytes(step["response"]), int(step["response_state"])


def variable(step):
    name = step["variable"]
    if not name.startswith(PREFIX) or name[len(PREFIX):] not in TEXTS + STATES:
        raise Bad("%s: no such variable: %s" % (step["id"], name))
    name = name[len(PREFIX):]
    if "value" in step:
        agree("%s: value" % step["id"], step["value"], str(int.from_bytes(to_bytes(step["bytes"]), "little")))
    return name


def check(case):
    given = case["given"]["service"]
    model = Model(given["services"])
    if not follow(model, given, case["expect"]):
        return
    for name, actor in model.actors.items():
        if actor.to_write or actor.serving is not None:
            raise Bad("%s has not finished its writes or its task" % name)
