"""Summarises the results of cargo-mutants.

`ran FOLDER K/N` writes the results of a shard to shards/. `ran FOLDER FILE` prints the results of one file.
`merge` combines the shards into results.tsv and compares the survivors with survivors.md. `check` checks that
the committed files are consistent.
"""

import json
import pathlib
import re
import sys
from collections import Counter

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
SHARDS = HERE / "shards"
RESULTS = HERE / "results.tsv"
SURVIVORS = HERE / "survivors.md"
COLUMNS = ("caught", "timeout", "missed", "unviable")
LEAST = 95.0
SUMMARIES = {
    "CaughtMutant": "caught",
    "MissedMutant": "missed",
    "Timeout": "timeout",
    "Unviable": "unviable",
}


def verdicts(folder):
    """Returns the result of each mutant by its name, which contains its line and column."""
    found = {}
    file = folder / "mutants.out" / "outcomes.json"
    for outcome in json.loads(file.read_text(encoding="utf-8"))["outcomes"]:
        if outcome["scenario"] == "Baseline":
            continue
        verdict = SUMMARIES[outcome["summary"]]
        if verdict == "caught":
            log = (file.parent / outcome["log_path"]).read_text(encoding="utf-8", errors="replace")
            # The limit of processor time ended the tests: the mutant is detected, but not by an assertion.
            verdict = "timeout" if "SIGXCPU" in log or "SIGKILL" in log else verdict
        found[outcome["scenario"]["Mutant"]["name"]] = verdict
    return found


def without_place(name):
    return re.sub(r":\d+:\d+: ", ": ", name)


def table(by_file):
    return "".join(
        "\t".join([file, *(str(by_file[file][column]) for column in COLUMNS)]) + "\n"
        for file in sorted(by_file)
    )


def ran(folder, name):
    found = verdicts(folder / "fast")
    if (folder / "thorough" / "mutants.out").is_dir():
        again = verdicts(folder / "thorough")
        found.update({mutant: again[mutant] for mutant in found if mutant in again})
    by_file = {}
    for mutant, verdict in found.items():
        by_file.setdefault(mutant.split(":")[0], Counter())[verdict] += 1
    total = sum(by_file.values(), Counter())
    print(f"{name}: {dict(total)}, {share(total):.2f} %")
    missed = sorted(without_place(mutant) for mutant in found if found[mutant] == "missed")
    if (ROOT / name).is_file():
        print("".join(f"{mutant}\n" for mutant in missed), end="")
        return
    at, of = map(int, name.split("/"))
    text = "\t".join(["file", *COLUMNS]) + "\n" + table(by_file)
    text += "".join(f"missed\t{mutant}\n" for mutant in missed)
    SHARDS.mkdir(exist_ok=True)
    (SHARDS / f"{at:02}-of-{of}.tsv").write_text(text, encoding="utf-8")


def share(total):
    caught = total["caught"] + total["timeout"]
    return 100.0 * caught / max(1, caught + total["missed"])


def measured():
    """Returns the totals for each file, how often each mutant survived, and the names of the shards."""
    by_file, survivors, shards = {}, Counter(), []
    for file in sorted(SHARDS.glob("*.tsv")):
        shards.append(file.stem)
        for row in file.read_text(encoding="utf-8").splitlines()[1:]:
            first, *rest = row.split("\t")
            if first == "missed":
                survivors[rest[0]] += 1
            else:
                by_file.setdefault(first, Counter()).update(dict(zip(COLUMNS, map(int, rest))))
    if len({name.split("-of-")[1] for name in shards}) != 1:
        sys.exit(f"there are no shards, or they are of different runs: {shards}")
    return by_file, survivors, shards


def listed():
    """Returns the mutants that survivors.md lists, and how often each is to survive."""
    rows = re.findall(
        r"^\| `(codec/src/.+?)` \| (\d+) \| .+ \|$", SURVIVORS.read_text(encoding="utf-8"), re.M
    )
    return {name.replace("\\|", "|"): int(times) for name, times in rows}


def results():
    """Returns the text that results.tsv must have, and the faults of the results."""
    by_file, survivors, shards = measured()
    total = sum(by_file.values(), Counter())
    percent = share(total)
    text = f"shards\t{' '.join(shards)}\n" + "\t".join(["file", *COLUMNS]) + "\n"
    text += table(by_file) + table({"total": total}) + f"share\t{percent:.2f} %\n"
    known, faults = listed(), []
    for name in sorted({*survivors, *known}):
        if survivors[name] != known.get(name, 0):
            faults.append(f"survives {survivors[name]} times, but is listed {known.get(name, 0)} times: {name}")
    if percent < LEAST:
        faults.append(f"{percent:.2f} % are caught, at least {LEAST} % are required")
    of = int(shards[0].split("-of-")[1])
    print(f"{len(shards)} of {of} shards, {sum(total.values())} mutants, {dict(total)}, {percent:.2f} %")
    return text, faults


def merge():
    text, faults = results()
    RESULTS.write_text(text, encoding="utf-8")
    return faults


def check():
    """A quick check: results.tsv has the totals of the shards, enough mutants are caught, each mutant survives as
    often as survivors.md states, and the functions of all listed survivors exist."""
    text, faults = results()
    if RESULTS.read_text(encoding="utf-8") != text:
        faults.append("results.tsv does not equal the totals of the shards")
    for name in listed():
        file, what = name.split(": ", 1)
        source = ROOT / file
        place = what.rsplit(" in ", 1)[-1] if " in " in what else what.split(" -> ")[0]
        function = re.findall(r"[A-Za-z_0-9]+", re.sub(r" with .*", "", place))[-1]
        if not source.is_file():
            faults.append(f"the file does not exist: {name}")
            continue
        text = source.read_text(encoding="utf-8")
        # The mutant of a constant has no function.
        if function != "replace" and not re.search(rf"\bfn {function}\b", text):
            faults.append(f"the function {function} does not exist: {name}")
    return faults


if __name__ == "__main__":
    match sys.argv[1:]:
        case ["ran", folder, name]:
            sys.exit(ran(pathlib.Path(folder), name))
        case ["merge"]:
            sys.exit("\n".join(merge()) or None)
        case ["check"]:
            sys.exit("\n".join(check()) or None)
        case _:
            sys.exit("usage: results.py ran FOLDER K/N|FILE | merge | check")
