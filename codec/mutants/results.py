"""What became of the mutants.

`shard OUT K/N` keeps what a shard has left in OUT, `merge` adds the shards up to results.tsv and
holds the survivors against survivors.md, `check` looks at what is committed.
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
    """Of each mutant that was tried, by its name with the place, what became of it."""
    found = {}
    file = folder / "mutants.out" / "outcomes.json"
    for outcome in json.loads(file.read_text(encoding="utf-8"))["outcomes"]:
        if outcome["scenario"] == "Baseline":
            continue
        verdict = SUMMARIES[outcome["summary"]]
        if verdict == "caught":
            log = (file.parent / outcome["log_path"]).read_text(encoding="utf-8", errors="replace")
            # Ended for its processor time: noticed, but by no assertion.
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


def shard(out, name):
    at, of = map(int, name.split("/"))
    folder = out / f"{at}-of-{of}"
    found = verdicts(folder / "fast")
    if (folder / "thorough" / "mutants.out").is_dir():
        again = verdicts(folder / "thorough")
        found.update({mutant: again[mutant] for mutant in found if mutant in again})
    by_file = {}
    for mutant, verdict in found.items():
        by_file.setdefault(mutant.split(":")[0], Counter())[verdict] += 1
    missed = sorted(without_place(mutant) for mutant in found if found[mutant] == "missed")
    text = "\t".join(["file", *COLUMNS]) + "\n" + table(by_file)
    text += "".join(f"missed\t{mutant}\n" for mutant in missed)
    SHARDS.mkdir(exist_ok=True)
    (SHARDS / f"{at:02}-of-{of}.tsv").write_text(text, encoding="utf-8")
    print(f"shard {name}: {dict(sum(by_file.values(), Counter()))}")


def measured():
    """The shards there are, what they add up to for each file, and how often what survived."""
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
        sys.exit(f"no shards, or of different runs: {shards}")
    return by_file, survivors, shards


def listed():
    """The survivors that are written down, and how often each."""
    rows = re.findall(
        r"^\| `(codec/src/.+?)` \| (\d+) \| .+ \|$", SURVIVORS.read_text(encoding="utf-8"), re.M
    )
    return {name.replace("\\|", "|"): int(times) for name, times in rows}


def results():
    """results.tsv as it has to be, the share that is caught, and what is wrong with it."""
    by_file, survivors, shards = measured()
    total = sum(by_file.values(), Counter())
    caught = total["caught"] + total["timeout"]
    share = 100.0 * caught / max(1, caught + total["missed"])
    text = f"shards\t{' '.join(shards)}\n" + "\t".join(["file", *COLUMNS]) + "\n"
    text += table(by_file) + table({"total": total}) + f"share\t{share:.2f} %\n"
    known, faults = listed(), []
    for name in sorted({*survivors, *known}):
        if survivors[name] != known.get(name, 0):
            faults.append(f"survives {survivors[name]}×, is listed {known.get(name, 0)}×: {name}")
    if share < LEAST:
        faults.append(f"{share:.2f} % is too little")
    of = int(shards[0].split("-of-")[1])
    print(f"{len(shards)} of {of} shards, {sum(total.values())} mutants, {dict(total)}, {share:.2f} %")
    return text, faults


def merge():
    text, faults = results()
    RESULTS.write_text(text, encoding="utf-8")
    return faults


def check():
    """Cheap: the figures add up, enough is caught, and each survivor still has its place."""
    text, faults = results()
    if RESULTS.read_text(encoding="utf-8") != text:
        faults.append("results.tsv is not what the shards add up to")
    for name in listed():
        file, what = name.split(": ", 1)
        source = ROOT / file
        place = what.rsplit(" in ", 1)[-1] if " in " in what else what.split(" -> ")[0]
        function = re.findall(r"[A-Za-z_0-9]+", re.sub(r" with .*", "", place))[-1]
        if not source.is_file():
            faults.append(f"the file is gone: {name}")
            continue
        text = source.read_text(encoding="utf-8")
        # A constant's mutant names no function.
        if function != "replace" and not re.search(rf"\bfn {function}\b", text):
            faults.append(f"no function {function} any more: {name}")
    return faults


if __name__ == "__main__":
    match sys.argv[1:]:
        case ["shard", out, name]:
            sys.exit(shard(pathlib.Path(out), name))
        case ["merge"]:
            sys.exit("\n".join(merge()) or None)
        case ["check"]:
            sys.exit("\n".join(check()) or None)
        case _:
            sys.exit("usage: results.py shard OUT K/N | merge | check")
