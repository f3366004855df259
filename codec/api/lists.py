"""Formats the lists of the public API as text."""

import re
import textwrap

WIDTH = 100


def signatures(elements, heads, given):
    """Lists the items, sorted by the depth of their paths and then by path, each followed by its members. `in`
    marks an item that `given` also contains: only its members that `given` lacks are listed."""
    text = []
    for path in sorted({path for path, _ in elements}, key=lambda path: (path.count("::"), path)):
        new = (path, "") in elements or (path, "") not in given
        text.append(heads[path] if new else f"in {heads[path]}")
        lines = {line for owner, line in elements if owner == path and line}
        traits = {line for line in lines if line.startswith("impl ")}
        text += [f"    {line}" for line in sorted(lines - traits, key=order)]
        text += packed("    impl ", ", ", sorted(line.removeprefix("impl ") for line in traits))
    return "".join(f"{line}\n" for line in text)


def order(line):
    """The sort key of a member: first fields, variants and associated types, then constants, then functions."""
    return ("fn " in line) + ("fn " in line or line.startswith("const ")), line


def packed(start, between, words):
    """Distributes the words over lines that begin with `start`. A line exceeds WIDTH characters only if it
    contains a single word."""
    lines = []
    for word in words:
        if lines and len(lines[-1]) + len(between) + len(word) <= WIDTH:
            lines[-1] += between + word
        else:
            lines.append(start + word)
    return lines


def names(crate, elements):
    """Lists only the names, by module. The borrowed and the owned type of a stream share an entry."""
    modules = {}
    for path, line in elements:
        *way, name = path.split("::")
        items = modules.setdefault("::".join((crate, *way)), {})
        members = items.setdefault(name, set())
        if line and not line.startswith(("impl ", "is ")):
            members.add(re.match(r"(?:(?:pub|const|fn|type) )*(\w+)", line)[1])
    return "\n".join(paragraph(way, items) for way, items in sorted(modules.items()))


def paragraph(way, items):
    """The names of a module. Items with the same members share a line."""
    shared = {}
    for name in sorted(items):
        owned = name.removesuffix("Ref")
        if f"{name}Ref" in items:
            continue
        members = items[name] | items.get(owned, set())
        title = f"{name}, {owned}" if owned != name and owned in items else name
        # Omits the members that many types have: the field of a newtype, and the conversions between the borrowed
        # and the owned type.
        members = " ".join(sorted(members - {"0", "as_ref", "to_owned"}))
        shared.setdefault(members, []).append(title)
    plain = shared.pop("", [])
    lines = [f"{', '.join(titles)}: {members}" for members, titles in shared.items()]
    lines += ["; ".join(plain)] if plain else []
    text = (textwrap.wrap(line, WIDTH - 2, subsequent_indent="    ") for line in lines)
    return "".join(f"{line}\n" for line in [way, *(f"  {line}" for part in text for line in part)])
