"""Reads the public API of a crate from rustdoc's JSON: its items, and the types of other crates that it exposes."""

from signature import Signature

FORMATS = {57}  # The versions of rustdoc's JSON that were tested; another version may have different keys.
KINDS = ("struct", "enum", "union", "trait", "function", "constant", "static", "type_alias", "macro")
MARKERS = ("StructuralPartialEq", "TrivialClone")  # Traits that the compiler implements in addition to a derived one.


class Api(Signature):
    """`elements`: pairs of the path of an item and one of its members as a line. The line is empty for the item
    itself.
    `heads`: for each path, the first line of its item.
    `strangers`: pairs of the path of an item and a type or trait that it exposes from another crate. Types of
    core, alloc and the crates in `shown` are permitted. Traits of the crates in `hosts` may be implemented,
    because features exist for these implementations.
    """

    def __init__(self, document, hosts=(), shown=()):
        super().__init__()
        self.index, self.paths = document["index"], document["paths"]
        crates = document["external_crates"]
        self.crates = {int(number): crate["name"] for number, crate in crates.items()}
        self.root = self.index[str(document["root"])]
        self.crate = self.root["name"]
        self.allowed, self.hosts = {self.crate, "core", "alloc", *shown}, set(hosts)
        self.elements, self.strangers, self.heads = set(), set(), {}
        self.again, self.found = [], []
        self.collect(self.root, ())
        for number, path in self.found:
            self.item(self.index[number], path)
        for path, target in self.again:
            self.elements.add((path, f"is {self.names[target]}"))
            self.heads[path] = f"use {path}"
        self.foreign_impls()

    # Collects the paths of all items. The shortest path of an item is its name.

    def collect(self, module, way):
        """Searches breadth-first, so that it finds a shorter path of an item before a longer one."""
        queue = [(module, way)]
        while queue:
            module, way = queue.pop(0)
            for number in sorted(module["inner"]["module"]["items"]):
                self.member(str(number), way, queue)

    def member(self, number, way, queue):
        item = self.index[number]
        kind, inner = self.inner(item)
        name = item["name"]
        if kind == "use":
            name, number = inner["name"], str(inner["id"])
            if number not in self.index:
                path = "::".join((*way, name))
                self.stranger(path, inner["id"], inner["source"])
                self.elements.add((path, f"is {inner['source']}"))
                self.heads[path] = f"use {path}"
                return
            item = self.index[number]
            if inner["is_glob"]:
                queue.append((item, way))
                return
            kind, inner = self.inner(item)
        path = "::".join((*way, name))
        if kind == "module":
            self.elements.add((path, ""))
            self.heads[path] = f"mod {path}"
            queue.append((item, (*way, name)))
        elif number in self.names:
            self.again.append((path, number))
        elif kind in KINDS:
            self.names[number] = path
            self.found.append((number, path))

    @staticmethod
    def inner(item):
        return next(iter(item["inner"].items()))

    # Collects the members of an item.

    def item(self, item, path):
        kind, inner = self.inner(item)
        if isinstance(inner, dict):
            own = {key: inner[key] for key in inner if key not in ("impls", "implementations")}
            self.look(path, own)
        if kind == "function":
            head, lines = self.function(path, inner), []
        elif kind in ("constant", "static"):
            head, lines = f"{kind} {path}: {self.type(inner['type'])}", []
        elif kind == "type_alias":
            head = f"type {path}{self.generics(inner)} = {self.type(inner['type'])}"
            lines = []
        elif kind == "trait":
            head = f"trait {path}{self.generics(inner)}{self.bounds(inner['bounds'])}"
            lines = [self.line(path, self.index[str(number)]) for number in inner["items"]]
        elif kind in ("struct", "union", "enum"):
            head = f"{kind} {path}{self.generics(inner)}"
            lines = self.body(path, inner) + self.impls(path, inner["impls"])
        else:
            head, lines = f"{kind} {path}", []
        if "non_exhaustive" in item["attrs"]:
            head = f"non_exhaustive {head}"
        self.heads[path] = head
        self.elements.add((path, ""))
        self.elements.update((path, line) for line in lines)

    def body(self, path, inner):
        if "variants" in inner:
            return [self.variant(path, self.index[str(number)]) for number in inner["variants"]]
        kind = inner.get("kind", {"plain": inner})
        if kind == "unit":
            return []
        fields = kind.get("tuple") or kind.get("plain", {}).get("fields", [])
        return [self.line(path, self.index[str(number)]) for number in fields if number is not None]

    def variant(self, path, item):
        kind = item["inner"]["variant"]["kind"]
        if kind == "plain":
            return item["name"]
        if "tuple" in kind:
            fields = [self.index[str(number)] for number in kind["tuple"]]
            types = [self.type(field["inner"]["struct_field"]) for field in fields]
            text = f"{item['name']}({', '.join(types)})"
        else:
            fields = [self.index[str(number)] for number in kind["struct"]["fields"]]
            types = [f"{field['name']}: {self.type(field['inner']['struct_field'])}" for field in fields]
            text = f"{item['name']} {{ {', '.join(types)} }}"
        for field in fields:
            self.look(f"{path}::{item['name']}", field["inner"])
        return text

    def impls(self, path, numbers):
        lines = []
        for number in numbers:
            implementation = self.index[str(number)]["inner"]["impl"]
            trait, target = implementation["trait"], self.target(implementation)
            if implementation["blanket_impl"] or implementation["is_synthetic"]:
                continue
            if trait is None:
                self.look(path, [implementation["generics"], implementation["for"]])
                members = [self.index[str(member)] for member in implementation["items"]]
                public = (member for member in members if member["visibility"] == "public")
                lines += [self.line(path, member) for member in public]
            # rustdoc also lists impls for other types that mention this type; these are omitted.
            elif self.names.get(target) == path and trait["path"] not in MARKERS:
                lines.append(self.implementation(path, implementation))
        return lines

    @staticmethod
    def target(implementation):
        """The ID of the type that implements the trait; "None" for a type without an ID, such as `u32`."""
        target = implementation["for"]
        while "borrowed_ref" in target:
            target = target["borrowed_ref"]["type"]
        return str(target.get("resolved_path", {}).get("id"))

    def implementation(self, path, implementation):
        trait = implementation["trait"]
        text = f"impl {self.path(trait)}"
        place = f"{path}: {text}"
        if self.crate_of(trait["id"]) in self.hosts:
            return text
        self.look(place, [trait, implementation["generics"], implementation["for"]])
        named = []
        for member in implementation["items"]:
            member = self.index[str(member)]
            self.look(place, member["inner"])
            if "assoc_type" in member["inner"]:
                inner = member["inner"]["assoc_type"]
                named.append(f"{member['name']}{self.generics(inner)} = {self.type(inner['type'])}")
        return text + (f" with {', '.join(named)}" if named else "")

    def foreign_impls(self):
        """Collects the impls of this crate for types of other crates, such as `impl From<Own> for u32`."""
        for item in list(self.index.values()):
            kind, inner = self.inner(item)
            if item["crate_id"] != 0 or kind != "impl" or not inner["trait"] or inner["blanket_impl"]:
                continue
            target = self.target(inner)
            if target == "None" or self.crate_of(target) != self.crate:
                path = self.type(inner["for"])
                self.heads[path] = f"foreign {path}"
                self.elements |= {(path, ""), (path, self.implementation(path, inner))}

    def line(self, path, item):
        kind, inner = self.inner(item)
        name = item["name"]
        place = f"{path}::{name}"
        self.look(place, inner)
        if kind == "struct_field":
            return f"pub {name}: {self.type(inner)}"
        if kind == "function":
            return self.function(name, inner)
        if kind == "assoc_const":
            return f"const {name}: {self.type(inner['type'])}"
        if kind == "assoc_type":
            return f"type {name}{self.generics(inner)}{self.bounds(inner['bounds'])}"
        raise ValueError(f"{place} is a {kind}")

    def function(self, name, inner):
        header, signature = inner["header"], inner["sig"]
        words = [word for word in ("const", "async", "unsafe") if header[f"is_{word}"]]
        inputs = ", ".join(self.input(*pair) for pair in signature["inputs"])
        start = " ".join([*words, "fn", name + self.generics(inner)])
        end = self.output(signature["output"]) + self.where(inner)
        return f"{start}({inputs}){end}{'' if inner['has_body'] else ';'}"

    def input(self, name, ty):
        text = self.type(ty)
        selves = {"Self": "self", "&Self": "&self", "&mut Self": "&mut self"}
        return selves[text] if name == "self" and text in selves else f"{name}: {text}"

    # Collects the exposed types of other crates.

    def look(self, place, node):
        """Checks every path below `node` in rustdoc's JSON; `place` is the path of the item."""
        if isinstance(node, dict):
            if "path" in node and "id" in node:
                self.stranger(place, node["id"], node["path"])
            for value in node.values():
                self.look(place, value)
        elif isinstance(node, list):
            for value in node:
                self.look(place, value)

    def stranger(self, place, number, path):
        crate = self.crate_of(number)
        if crate not in self.allowed:
            self.strangers.add((place, f"{crate}: {path}"))

    def crate_of(self, number):
        path = self.paths.get(str(number))
        if path is None:
            return self.crate if str(number) in self.index else "an unknown crate"
        return self.crates.get(path["crate_id"], self.crate)
