"""Compares the lines that no test runs with uncovered.txt: `uncovered.py <lcov file> [--renew]`.

A line is identified by its file, its function and its text, so that edits elsewhere in the file do not
change the list. It is an error if a listed line is run or does not exist any more.
"""

import collections
import pathlib
import re
import sys

HERE = pathlib.Path(__file__).resolve().parent
LIST = HERE / "uncovered.txt"
LEAST = 98.0
HEAD = """\
# The lines of codec/src that no test of the codec runs. codec/coverage/run compares this list with the
# measured coverage; codec/coverage/run --renew rewrites it. The comment above each group states why no test
# can run its lines.
"""
WANTED = "# (no reason yet)"
FUNCTION = re.compile(r"^(\s*)(?:pub(?:\([^)]*\))? )?(?:const )?fn (\w+|\$\w+)")


def function(source, number):
    """Returns the name of the function that contains line `number`: the nearest line with `fn` at or above it that
    has less indentation. Returns `-` if no such line exists."""
    depth = len(source[number - 1]) - len(source[number - 1].lstrip())
    for at in range(number, 0, -1):
        found = FUNCTION.match(source[at - 1])
        if found and (len(found[1]) < depth or at == number):
            return found[2]
        # The closing brace of a function has the same indentation as the line with `fn`.
        if found and len(found[1]) == depth and source[number - 1].strip() == "}":
            return found[2]
    return "-"


def counted(path):
    """Returns the number of lines, and the lines that are not run as (file, function, text), sorted by file."""
    total, missed, file, source = 0, [], "", []
    for line in path.read_text(encoding="utf-8").splitlines():
        key, _, rest = line.partition(":")
        if key == "SF":
            # On Windows, paths contain backslashes.
            file = rest.replace("\\", "/").split("/codec/src/")[-1]
            source = pathlib.Path(rest).read_text(encoding="utf-8").splitlines()
        elif key == "DA":
            number, count = map(int, rest.split(",")[:2])
            total += 1
            if not count:
                missed.append((file, function(source, number), source[number - 1].strip()))
    return total, sorted(missed, key=lambda line: line[0])


def listed(text):
    """Parses uncovered.txt. Each entry is a line of code as (file, function, text), with its reason."""
    entries, reason, place = [], "", None
    for line in text.removeprefix(HEAD).splitlines():
        if line.startswith("#"):
            # A reason may have several lines.
            reason = f"{reason}\n{line}" if place == "reason" else line
            place = "reason"
        elif line.startswith(" "):
            entries.append(((*place, line.strip()), reason))
        elif line:
            place = tuple(line.rsplit(" ", 1))
    return entries


def written(entries):
    """Formats the text of uncovered.txt. Entries with the same reason form a group; the groups and their entries
    keep the order of `entries`."""
    groups = collections.defaultdict(list)
    for key, reason in entries:
        groups[reason].append(key)
    text = HEAD
    for reason, keys in groups.items():
        text += f"\n{reason}\n"
        place = None
        for file, name, line in keys:
            if place != (file, name):
                text += f"{file} {name}\n"
            place = (file, name)
            text += f"    {line}\n"
    return text


def renewed(missed, entries):
    reasons = collections.defaultdict(list)
    for key, reason in entries:
        reasons[key].append(reason)
    return [(key, reasons[key].pop(0) if reasons[key] else WANTED) for key in missed]


def main(path, renew):
    total, missed = counted(path)
    entries = listed(LIST.read_text(encoding="utf-8")) if LIST.exists() else []
    if renew:
        entries = renewed(missed, entries)
        LIST.write_text(written(entries), encoding="utf-8")
    there, known = (collections.Counter(keys) for keys in (missed, [key for key, _ in entries]))
    faults = [f"not run, not listed: {': '.join(key)}" for key in (there - known).elements()]
    faults += [f"listed, but run or gone: {': '.join(key)}" for key in (known - there).elements()]
    faults += [f"no reason in uncovered.txt: {': '.join(key)}" for key, reason in entries if reason in ("", WANTED)]
    if faults:
        faults.append("write a test, or run codec/coverage/run --renew and add the reason to uncovered.txt")
    percent = 100 * (total - len(missed)) / max(total, 1)
    print(f"{total - len(missed)} of {total} lines run: {percent:.2f} %, {len(missed)} listed")
    if percent < LEAST:
        faults.append(f"the tests run less than {LEAST} % of the lines")
    return faults


if __name__ == "__main__":
    faults = main(pathlib.Path(sys.argv[1]), renew=sys.argv[2:] == ["--renew"])
    print(*faults, sep="\n", end="\n" if faults else "")
    sys.exit(bool(faults))
