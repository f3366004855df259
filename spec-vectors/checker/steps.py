"""Execution of the steps of a sequence by a model."""
from .pieces import Bad, agree


def follow(model, given, expect):
    """Execute all steps; return False if the last step has the stated fault. Other faults are errors."""
    for step in given["steps"]:
        cls = model.step(step)
        if cls:
            agree("fault", expect.get("reject"), {"class": cls, "step": step["id"]})
            if step is not given["steps"][-1]:
                raise Bad("steps follow the faulty step")
            return False
    if "reject" in expect:
        raise Bad("no step is faulty, but the case states %s" % expect["reject"])
    return True
