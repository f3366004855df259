#!/usr/bin/env python3
"""Print Markdown tables of the counts by area and of the printed examples with their vectors.

    python3 tables.py
"""
import json
from collections import Counter
from pathlib import Path

DATA = Path(__file__).resolve().parent / "data"


def entries():
    """All vectors and sequences."""
    for folder, key in (("vectors", "vectors"), ("sequences", "cases")):
        for path in sorted((DATA / folder).glob("*.json")):
            yield from json.loads(path.read_text(encoding="utf-8"))[key]


def areas(requirements, listed):
    """For each area, the numbers of its requirements and of the vectors and sequences that cite them."""
    rows = []
    for area in dict.fromkeys(requirement["area"] for requirement in requirements):
        own = [requirement for requirement in requirements if requirement["area"] == area]
        counts = Counter()
        for entry in listed:
            if any(cited.split("-")[0] == area for cited in entry["requirements"]):
                kind = "sequence" if "given" in entry else "vector"
                counts[kind, "accept" in entry["expect"]] += 1
        rows.append([area, len(own), sum("codec" in one["observable"] for one in own),
                     sum("excluded" in one for one in own), counts["vector", True], counts["vector", False],
                     counts["sequence", True], counts["sequence", False]])
    return rows


def section_order(section):
    return [int(part) if part.isdigit() else 0 for part in section.split(",")[0].split(".")]


def examples(listed):
    """By document and section: each printed example, and the IDs of the entries that transcribe it."""
    found = {}
    for entry in listed:
        if entry["provenance"]["kind"] == "manual":
            for source in entry["provenance"]["sources"]:
                example = (source["document"], source["section"], source["example"])
                found.setdefault(example, []).append("`%s`" % entry["id"])
    order = sorted(found, key=lambda example: (example[0], section_order(example[1])))
    return [[*example, " ".join(found[example])] for example in order]


def table(head, rows):
    print("| " + " | ".join(head) + " |")
    print("|" + "---|" * len(head))
    for row in rows:
        print("| " + " | ".join(str(cell) for cell in row) + " |")
    print()


def main():
    requirements = json.loads((DATA / "requirements.json").read_text(encoding="utf-8"))["requirements"]
    listed = list(entries())
    table(["area", "requirements", "about bytes", "excluded", "accepted vectors", "rejected", "accepted sequences",
           "rejected"], areas(requirements, listed))
    table(["document", "section", "example", "vectors and sequences"], examples(listed))


if __name__ == "__main__":
    main()
