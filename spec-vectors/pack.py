#!/usr/bin/env python3
"""Pack the vectors for those who want nothing else of this project.

    python3 pack.py [--out DIR]     writes the archive and its SHA-256, and prints that
    python3 pack.py --check         packs, unpacks, has what came out check itself; writes nothing

The same files give the same bytes on every machine: sorted names, no times, no owners, and nothing
compressed, since what a compressor makes differs between its versions.
"""
import argparse
import hashlib
import io
import json
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent
PACKED = [
    "README.md", "CHANGELOG.md", "LICENSE-APACHE", "LICENSE-MIT", "check.py", "pack.py", "tables.py",
    "checker/*.py", "data/*.json", "data/*/*.json", "schema/*.json",
]


def files():
    """Path in the archive and bytes of everything that is packed, in order."""
    found = {}
    for pattern in PACKED:
        paths = [path for path in ROOT.glob(pattern) if path.is_file()]
        if not paths:
            raise SystemExit("nothing is called %s" % pattern)
        for path in paths:
            data = path.read_bytes()
            if b"\r" in data:
                raise SystemExit("%s: line ends are LF in the archive" % path)
            found[path.relative_to(ROOT).as_posix()] = data
    return sorted(found.items())


def version(packed):
    """The one version that all data states and the changelog begins with."""
    stated = {name: json.loads(data)["version"] for name, data in packed if name.startswith("data/")}
    versions = sorted(set(stated.values()))
    if len(versions) != 1:
        raise SystemExit("the data states several versions: %s" % stated)
    headings = [line for line in dict(packed)["CHANGELOG.md"].decode("utf-8").split("\n") if line.startswith("## ")]
    if headings[:1] != ["## " + versions[0]]:
        raise SystemExit("the changelog begins with %s, the data is %s" % (headings[:1], versions[0]))
    return versions[0]


def archive(packed, folder):
    """The archive, with everything in one folder."""
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_STORED) as target:
        for name, data in packed:
            entry = zipfile.ZipInfo("%s/%s" % (folder, name), (1980, 1, 1, 0, 0, 0))
            entry.create_system = 3  # as on Unix, wherever this runs
            entry.external_attr = (0o100755 if "/" not in name and name.endswith(".py") else 0o100644) << 16
            target.writestr(entry, data)
    return out.getvalue()


def check(data, folder, packed):
    """Unpacks an archive elsewhere, has its vectors judged there, and packs what came out again."""
    with tempfile.TemporaryDirectory() as place:
        with zipfile.ZipFile(io.BytesIO(data)) as source:
            source.extractall(place)
        unpacked = Path(place, folder)
        found = sorted(path.relative_to(unpacked).as_posix() for path in unpacked.rglob("*") if path.is_file())
        if found != [name for name, _ in packed]:
            raise SystemExit("unpacked are %s" % found)
        subprocess.run([sys.executable, "-B", str(unpacked / "check.py")], check=True)
        subprocess.run([sys.executable, "-B", str(unpacked / "pack.py"), "--out", place], check=True,
                       stdout=subprocess.DEVNULL)
        again = Path(place, folder + ".zip").read_bytes()
        if again != data:
            raise SystemExit("packed again, the archive is another")


def main():
    parser = argparse.ArgumentParser(description="Pack the vectors.")
    parser.add_argument("--out", type=Path, default=ROOT / "dist")
    parser.add_argument("--check", action="store_true")
    arguments = parser.parse_args()
    packed = files()
    folder = "ads-cnc-vectors-" + version(packed)
    data = archive(packed, folder)
    line = "%s  %s.zip" % (hashlib.sha256(data).hexdigest(), folder)
    if arguments.check:
        check(data, folder, packed)
    else:
        arguments.out.mkdir(parents=True, exist_ok=True)
        (arguments.out / (folder + ".zip")).write_bytes(data)
        (arguments.out / (folder + ".zip.sha256")).write_bytes(line.encode("ascii") + b"\n")
    print(line)


if __name__ == "__main__":
    main()
