"""Runs the clients of all languages alternately on the same bytes, and writes the medians to the README."""

import os
import subprocess
import sys
import tempfile
from pathlib import Path
from statistics import median

sys.path.insert(0, str(Path(__file__).parent.parent))
import results

HERE = Path(__file__).parent
ROUNDS = 9
OURS = Path(os.environ["CARGO_TARGET_DIR"]) / "release" / "clients"


def run(command):
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    return [(what, float(time)) for what, time in (line.split("\t") for line in done.stdout.splitlines())]


def main():
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([OURS, "write", folder], check=True)
        clients = {
            "`ads-cnc`": [OURS, "time", folder],
            "Node's `Buffer`": ["node", HERE / "decode.mjs", folder],
            "Python's `struct`": ["python3", HERE / "decode.py", folder],
        }
        times = {}
        for _ in range(ROUNDS):
            for who, command in clients.items():
                for what, time in run(command):
                    times.setdefault((who, what), []).append(time)
    middle = {key: median(all_of_it) for key, all_of_it in times.items()}
    lines = ["| who | what | ns a record | least … greatest | times `ads-cnc`, owned |", "|---|---|--:|--:|--:|"]
    for (who, what), all_of_it in times.items():
        ours = middle["`ads-cnc`", what.split(",")[0] + ", owned"]
        here = middle[who, what]
        spread = f"{min(all_of_it):,.1f} … {max(all_of_it):,.1f}"
        lines.append(f"| {who} | {what} | {here:,.1f} | {spread} | {here / ours:,.1f} |")
    print("\n".join(lines))
    results.put("scripts", "\n".join(lines))


main()
