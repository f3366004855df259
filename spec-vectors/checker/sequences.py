"""Check one sequence, and compare a rejected one with its sibling."""
from . import nc, service, streaming
from .pieces import EDIT_MAX, Bad, edit, to_bytes

KINDS = {"nc-text": nc.check_text, "nc-check": nc.check_program, "streaming": streaming.check, "service": service.check}


def kind_of(case):
    (kind,) = case["given"]
    return kind


def text_of(case):
    given = case["given"][kind_of(case)]
    return to_bytes(given) if kind_of(case) == "nc-text" else b"".join(to_bytes(packet) for packet in given)


def inputs(step, given):
    """The fields of a step that are inputs, without the fields that follow from the inputs."""
    action, actor = step["action"], step.get("actor")
    services = given.get("services", {})
    keys = ["id", "actor", "action", "at", "channel"]
    if action in ("ask", "answer"):
        # the answer of a known service follows from the request
        if action == "ask" or "does" not in services.get(actor, {}):
            keys += ["uuid", "request", "request_state", "wait", "response", "response_state"]
    elif action == "write" and actor in (None, "other") and "text" not in given:
        keys += ["variable", "bytes"]
    return {key: step[key] for key in keys if key in step}


def bytes_of(step):
    return b"".join(to_bytes(step[key]) for key in ("bytes", "request", "response") if key in step)


def lacks_one_step(good, bad):
    """Whether the bad steps are the good steps without one of them."""
    for index, (one, other) in enumerate(zip(good, bad)):
        if one["id"] != other["id"]:
            return good[:index] + good[index + 1:] == bad
    return False


def check_sibling(case, cases):
    sibling = cases.get(case.get("sibling"))
    if sibling is None or "accept" not in sibling["expect"] or kind_of(sibling) != kind_of(case):
        raise Bad("sibling %s is not an accepted case of its kind" % case.get("sibling"))
    if kind_of(case).startswith("nc-"):
        good, bad = text_of(sibling), text_of(case)
        if good == bad or edit(good, bad) > EDIT_MAX:
            raise Bad("sibling %s: %d bytes differ" % (sibling["id"], edit(good, bad)))
        return
    good, bad = sibling["given"][kind_of(case)], case["given"][kind_of(case)]
    if any(good.get(key) != bad.get(key) for key in ("text", "services")):
        raise Bad("sibling %s has a different text or different services" % sibling["id"])
    if len(good["steps"]) < len(bad["steps"]):
        raise Bad("sibling %s has fewer steps" % sibling["id"])
    if lacks_one_step(good["steps"], bad["steps"]):
        return
    pairs = list(zip(good["steps"], bad["steps"]))
    changed = [pair for pair in pairs if inputs(pair[0], good) != inputs(pair[1], bad)]
    if not changed and pairs[-1][0] == pairs[-1][1]:
        raise Bad("sibling %s has the same steps" % sibling["id"])
    if len(changed) > 1:
        ids = ", ".join(step["id"] for _, step in changed)
        raise Bad("sibling %s differs by more than one fault: %s" % (sibling["id"], ids))
    # these faults are in the last step itself, so no earlier step may differ
    inner = case["expect"]["reject"]["class"] in ("order", "outcome", "overfull")
    if inner and any(pair is not pairs[-1] for pair in changed):
        raise Bad("sibling %s also differs before the fault: %s" % (sibling["id"], changed[0][1]["id"]))
    for one, other in changed:
        if one["action"] == other["action"] and edit(bytes_of(one), bytes_of(other)) > EDIT_MAX:
            raise Bad("sibling %s: %d bytes differ in %s" % (sibling["id"], edit(bytes_of(one), bytes_of(other)), other["id"]))


def check(case, cases):
    KINDS[kind_of(case)](case)
    given = case["given"][kind_of(case)]
    if isinstance(given, dict):
        ids = [step["id"] for step in given["steps"]]
        if len(set(ids)) != len(ids):
            raise Bad("two steps have the same id")
    if "reject" in case["expect"]:
        check_sibling(case, cases)
        return "rejected"
    return "accepted"
