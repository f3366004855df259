"""Converts types and signatures from rustdoc's JSON to Rust syntax. `names` maps IDs to public paths."""


class Signature:
    def __init__(self):
        self.names = {}

    def type(self, ty):
        if ty == "infer":
            return "_"
        (kind, inner), = ty.items()
        match kind:
            case "generic" | "primitive":
                return inner
            case "resolved_path":
                return self.path(inner)
            case "borrowed_ref":
                words = [inner["lifetime"], "mut" if inner["is_mutable"] else None]
                return "&" + "".join(f"{word} " for word in words if word) + self.type(inner["type"])
            case "slice":
                return f"[{self.type(inner)}]"
            case "array":
                return f"[{self.type(inner['type'])}; {inner['len']}]"
            case "tuple":
                return f"({', '.join(map(self.type, inner))})"
            case "impl_trait":
                return "impl " + " + ".join(map(self.bound, inner))
            case "dyn_trait":
                traits = [self.path(trait["trait"]) for trait in inner["traits"]]
                return "dyn " + " + ".join(filter(None, [*traits, inner["lifetime"]]))
            case "qualified_path":
                arguments = self.arguments(inner["args"])
                return f"{self.type(inner['self_type'])}::{inner['name']}{arguments}"
            case "function_pointer":
                inputs = [self.type(ty) for _, ty in inner["sig"]["inputs"]]
                return f"fn({', '.join(inputs)}){self.output(inner['sig']['output'])}"
        raise ValueError(f"a type that is a {kind}")

    def output(self, ty):
        return f" -> {self.type(ty)}" if ty else ""

    def path(self, path):
        name = self.names.get(str(path["id"]), path["path"].split("::")[-1])
        return name + self.arguments(path["args"])

    def arguments(self, arguments):
        if not arguments:
            return ""
        if "parenthesized" in arguments:
            inner = arguments["parenthesized"]
            return f"({', '.join(map(self.type, inner['inputs']))}){self.output(inner['output'])}"
        inner = arguments["angle_bracketed"]
        words = [self.argument(one) for one in inner["args"]]
        for constraint in inner["constraints"]:
            (how, what), = constraint["binding"].items()
            if how == "equality":
                words.append(f"{constraint['name']} = {self.argument(what)}")
            else:
                words.append(f"{constraint['name']}{self.bounds(what)}")
        return f"<{', '.join(words)}>" if words else ""

    def argument(self, argument):
        (kind, inner), = argument.items()
        if kind in ("type", "term"):
            return self.type(inner)
        return inner if kind == "lifetime" else inner["expr"]

    def bounds(self, bounds):
        return f": {' + '.join(map(self.bound, bounds))}" if bounds else ""

    def bound(self, bound):
        (kind, inner), = bound.items()
        if kind == "trait_bound":
            maybe = "?" if inner["modifier"] == "maybe" else ""
            binder = ", ".join(one["name"] for one in inner["generic_params"])
            return (f"for<{binder}> " if binder else "") + maybe + self.path(inner["trait"])
        if kind == "use":
            return f"use<{', '.join(next(iter(one.values())) for one in inner)}>"
        return inner

    def generics(self, inner):
        words = []
        for parameter in inner["generics"]["params"]:
            (kind, what), = parameter["kind"].items()
            if kind == "lifetime":
                words.append(parameter["name"])
            elif kind == "const":
                words.append(f"const {parameter['name']}: {self.type(what['type'])}")
            elif not what["is_synthetic"]:
                words.append(parameter["name"] + self.bounds(what["bounds"]))
        return f"<{', '.join(words)}>" if words else ""

    def where(self, inner):
        words = []
        for predicate in inner["generics"]["where_predicates"]:
            (kind, what), = predicate.items()
            if kind == "bound_predicate":
                words.append(self.type(what["type"]) + self.bounds(what["bounds"]))
            else:
                words.append(f"{what['lifetime']}: {' + '.join(what['outlives'])}")
        return f" where {', '.join(words)}" if words else ""
