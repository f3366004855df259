"""Compares the instructions of the cases with limits and committed counts; writes the tables of the README.

    results.py read GUNGRAUN CASES    prints the counts of one build, from the output files of gungraun
    results.py check RESULTS          compares the counts with the limits and with instructions.tsv
    results.py --renew RESULTS        writes instructions.tsv and the tables, then checks like `check`
    results.py time RESULTS           writes time.tsv and the tables, and prints the ratios above their goals
"""

import json
import platform
import re
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).parent
COUNTS, TIMES = HERE / "instructions.tsv", HERE / "time.tsv"
SIZES = HERE.parent / "proofs" / "size" / "figures.tsv"
README = HERE / "README.md"
BUILDS = ("no_std", "std")
SLACK = 1.05


def rows(path):
    lines = path.read_text(encoding="utf-8").splitlines()
    return [line.split("\t") for line in lines if not line.startswith("#")]


def toolchain():
    """Returns the versions of the toolchain and tools on which the counts depend."""
    def first(*command):
        return subprocess.run(command, capture_output=True, text=True, check=True).stdout.split("\n")[0]
    libc = " ".join(platform.libc_ver())
    return f"{first('rustc', '-V')}, {first('valgrind', '--version')}, {libc}, {platform.machine()}"


class Case:
    """A line of the list of cases."""

    def __init__(self, group, subject, implementation, units, *limits):
        self.group, self.key, self.units = group, (subject, implementation), int(units)
        self.limits = [
            (limits[at], (subject, limits[at + 1]), float(limits[at + 2]))
            for at in range(0, len(limits), 3)
        ]


def read(gungraun, cases):
    """Prints subject, implementation, units and instructions of each counted case."""
    at = {"gated": 0, "other": 0}
    for case in (Case(*row) for row in rows(cases)):
        found = list(gungraun.glob(f"**/{case.group}.case_{at[case.group]}/summary.json"))
        at[case.group] += 1
        if len(found) != 1:
            if case.group == "gated":
                sys.exit(f"{case.key}: {len(found)} results")
            continue
        [profile] = json.loads(found[0].read_text(encoding="utf-8"))["profiles"]
        count = profile["data"]["total"]["metrics"]["Ir"]["values"]["new"]
        print(*case.key, case.units, count, sep="\t")


def counted(results):
    """Returns the counts by case and build: {key: {build: (units, instructions)}}."""
    counts = {}
    for build in BUILDS:
        for subject, implementation, units, instructions in rows(results / f"{build}.tsv"):
            counts.setdefault((subject, implementation), {})[build] = (int(units), int(instructions))
    return counts


def each(counts, key, build):
    units, instructions = counts[key][build]
    return instructions / units


def missed(cases, counts, build):
    """Yields a text for each case that exceeds a limit of instructions."""
    for case in cases:
        if case.key not in counts:
            continue  # Only `--renew` counts long cases.
        for kind, other, most in case.limits:
            here = each(counts, case.key, build)
            if kind == "instructions":
                figure, unit = here / each(counts, other, build), f"times {other[1]}"
            elif kind == "over":
                figure, unit = here - each(counts, other, build), f"instructions over {other[1]}"
            else:
                continue
            if figure > most:
                yield f"{named(case.key)} ({build}): {figure:.2f} {unit}, {most:g} allowed"


def named(key):
    return ": ".join(key)


def committed():
    """Returns the toolchain of the committed counts, and the counts."""
    head = COUNTS.read_text(encoding="utf-8").split("\n")[0].removeprefix("# ")
    counts = {}
    for subject, implementation, units, *builds in rows(COUNTS):
        counts[subject, implementation] = {b: (int(units), int(count)) for b, count in zip(BUILDS, builds)}
    return head, counts


def listed(results):
    return [Case(*row) for row in rows(results / "cases")]


def check(results):
    """Fails if a case exceeds its limit, exceeds its committed count by more than 5 %, or lacks a committed
    count, or if a committed count has no case. Checks only the limits if the committed counts are for a different
    toolchain."""
    counts, cases = counted(results), listed(results)
    exceeded = [text for build in BUILDS for text in missed(cases, counts, build)]
    faults = list(exceeded)
    head, before = committed()
    if head == toolchain():
        faults += grown(counts, before)
        gone = {case.key for case in cases} ^ before.keys()
        faults += [f"{named(key)}: only in the cases or only in {COUNTS.name}" for key in sorted(gone)]
    else:
        print(f"skipped: {COUNTS.name} is for {head}, but this is {toolchain()}; only the limits were checked")
    for fault in faults:
        print(fault)
    if faults:
        hint = "" if exceeded else "; if an increase is intended, run codec/benches/run --renew"
        sys.exit(f"{len(faults)} faults{hint}")
    compared = f", and at most 5 % above {COUNTS.name}" if head == toolchain() else ""
    print(f"{len(counts)} cases, with std and without: within their limits{compared}")


def grown(counts, before):
    for key, builds in counts.items():
        for build, (_, count) in builds.items():
            then = before.get(key, {}).get(build, (0, count))[1]
            if count > then * SLACK:
                yield f"{named(key)} ({build}): {count} instructions, {then} before"


def renew(results):
    counts = counted(results)
    lines = [f"# {toolchain()}", "# subject, implementation, units, instructions without std, instructions with std"]
    for case in listed(results):
        both = [str(counts[case.key][build][1]) for build in BUILDS]
        lines.append("\t".join([*case.key, str(case.units), *both]))
    COUNTS.write_text("\n".join(lines) + "\n", encoding="utf-8")
    tables(results)


def time(results):
    """Records the ratios of time, and reports those above their goals; time never causes a failure."""
    limits = {(case.key, other[1]): most for case in listed(results) for kind, other, most in case.limits
              if kind == "time"}
    builds = [{tuple(row[:3]): row[3:] for row in rows(results / f"{build}.time")} for build in BUILDS]
    lines = ["# subject, implementation, reference; median, least, greatest ratio without std, then with std"]
    for key in builds[0]:
        ratios = [f"{float(ratio):.2f}" for build in builds for ratio in build[key]]
        lines.append("\t".join([*key, *ratios]))
        for build, ratio in zip(BUILDS, (ratios[0], ratios[3])):
            most = limits[key[:2], key[2]]
            if float(ratio) > most:
                print(f"{named(key[:2])} ({build}): {ratio} times the time of {key[2]}, {most:g} is the goal")
    TIMES.write_text("\n".join(lines) + "\n", encoding="utf-8")
    tables(results)


def tables(results):
    """Writes the tables between the markers in the README."""
    _, counts = committed()
    times = {tuple(row[:3]): row[3:] for row in rows(TIMES)} if TIMES.exists() else {}
    subjects = {}
    for case in listed(results):
        subjects.setdefault(case.key[0], []).append(case)
    lines = []
    for subject, cases in subjects.items():
        # The table is only for subjects with a goal of time; instructions.tsv has the figures of all.
        if not any(kind == "time" for case in cases for kind, *_ in case.limits):
            continue
        lines += ["", f"| {subject} | `no_std` | `std` | reference | instructions | time | limit or goal |",
                  "|---|--:|--:|---|--:|--:|---|"]
        lines += [line for case in cases for line in lines_of(case, counts, times)]
    put("counts", "\n".join(lines[1:]))
    sizes()


def sizes():
    """Writes the table of sizes, from the figures that codec/proofs/size/run --renew wrote."""
    figures = {}
    for target, program, *bytes_of in rows(SIZES)[1:]:
        figures.setdefault(program, {})[target] = [int(number) for number in bytes_of]
    limited, borrowed = "views and operations", "all borrowing types"
    lines = ["| | thumbv7em `.text` | read-only data | x86-64 `.text` | read-only data |", "|---|--:|--:|--:|--:|"]
    for program, targets in figures.items():
        base = limited if program.startswith("with ") else borrowed if ", and " in program else None
        cells = []
        for target in ("thumbv7em-none-eabihf", "x86_64-unknown-linux-gnu"):
            for at, number in enumerate(targets[target]):
                added = number - figures[base][target][at] if base else number
                cells.append(f"({added:,})" if base else f"{added:,}")
        name = f"**{program}**, at most 24,576" if program == limited else program
        lines.append(f"| {' | '.join([name, *cells])} |")
    put("size", "\n".join(lines))


WANTED = {"instructions": "≤ {:g} ×", "time": "time ≤ {:g} ×"}


def lines_of(case, counts, times):
    """Yields the lines of the table for a case: one for each reference, or one if it has no reference."""
    if case.key not in counts:
        return
    figures = " | ".join(f"{each(counts, case.key, build):,.1f}" for build in BUILDS)
    against = {}
    for kind, other, most in case.limits:
        against.setdefault(other, {})[kind] = most
    for other, wanted in against.items() or [(None, {})]:
        ratio = spent = ""
        if other in counts:
            pairs = [(each(counts, case.key, build), each(counts, other, build)) for build in BUILDS]
            ratio = [f"{a / b:.2f}" for a, b in pairs]
            ratio = " / ".join(ratio)
        name = other[1] if other else ""
        if row := times.get((*case.key, name)):
            spent = f"{row[0]} / {row[3]}"
        goal = ", ".join(WANTED[kind].format(most) for kind, most in wanted.items())
        yield f"| {case.key[1]} | {figures} | {name} | {ratio} | {spent} | {goal} |"


def put(mark, text):
    readme = README.read_text(encoding="utf-8")
    place = re.compile(rf"(<!-- {mark} -->\n).*?(<!-- /{mark} -->)", re.DOTALL)
    if not place.search(readme):
        sys.exit(f"no markers <!-- {mark} --> and <!-- /{mark} --> in {README.name}")
    README.write_text(place.sub(lambda at: f"{at[1]}{text}\n{at[2]}", readme), encoding="utf-8")


def main():
    match sys.argv[1:]:
        case ["read", gungraun, cases]:
            read(Path(gungraun), Path(cases))
        case ["check", results]:
            check(Path(results))
        case ["--renew", results]:
            renew(Path(results))
            check(Path(results))
        case ["time", results]:
            time(Path(results))
        case _:
            sys.exit(__doc__)


if __name__ == "__main__":
    main()
