"""The steps of a sequence, gone through by a model."""
from .pieces import Bad, agree


def follow(model, given, expect):
    """Whether the model did every step; if not, the last one is at fault, as stated."""
    for step in given["steps"]:
        cls = model.step(step)
        if cls:
            agree("fault", expect.get("reject"), {"class": cls, "step": step["id"]})
            if step is not given["steps"][-1]:
                raise Bad("steps behind the one at fault")
            return False
    if "reject" in expect:
        raise Bad("nothing is at fault, but %s" % expect["reject"])
    return True
