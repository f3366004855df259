#!/usr/bin/env python3
"""Pack the vectors for use without the rest of this project.

    python3 pack.py [--out DIR]     write the archive and its SHA-256, and print the SHA-256
    python3 pack.py --check         pack, unpack, and check the unpacked copy; write nothing

The same files give the same bytes on every machine: names are sorted, times and owners are fixed, and
nothing is compressed, because the output of a compressor depends on its version.
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
    """The path in the archive and the bytes of each packed file, sorted by path."""
    found = {}
    for pattern in PACKED:
        paths = [path for path in ROOT.glob(pattern) if path.is_file()]
        if not paths:
            raise SystemExit("no file matches %s" % pattern)
        for path in paths:
            data = path.read_bytes()
            if b"\r" in data:
                raise SystemExit("%s has a CR: line ends must be LF" % path)
            found[path.relative_to(ROOT).as_posix()] = data
    return sorted(found.items())


def version(packed):
    """The version, which all data files and the first heading of the changelog must state."""
    stated = {name: json.loads(data)["version"] for name, data in packed if name.startswith("data/")}
    versions = sorted(set(stated.values()))
    if len(versions) != 1:
        raise SystemExit("the data files state different versions: %s" % stated)
    headings = [line for line in dict(packed)["CHANGELOG.md"].decode("utf-8").split("\n") if line.startswith("## ")]
    if headings[:1] != ["## " + versions[0]]:
        raise SystemExit("the changelog begins with %s, but the data states %s" % (headings[:1], versions[0]))
    return versions[0]


def archive(packed, folder):
    """The bytes of the archive, with all files in one folder."""
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_STORED) as target:
        for name, data in packed:
            entry = zipfile.ZipInfo("%s/%s" % (folder, name), (1980, 1, 1, 0, 0, 0))
            entry.create_system = 3  # Unix, whatever system this runs on
            entry.external_attr = (0o100755 if "/" not in name and name.endswith(".py") else 0o100644) << 16
            target.writestr(entry, data)
    return out.getvalue()


def check(data, folder, packed):
    """Unpack the archive in another folder, run the check there, and compare a new archive of the copy."""
    with tempfile.TemporaryDirectory() as parent:
        with zipfile.ZipFile(io.BytesIO(data)) as source:
            source.extractall(parent)
        unpacked = Path(parent, folder)
        found = sorted(path.relative_to(unpacked).as_posix() for path in unpacked.rglob("*") if path.is_file())
        if found != [name for name, _ in packed]:
            raise SystemExit("the unpacked files differ from the packed ones: %s" % found)
        subprocess.run([sys.executable, "-B", str(unpacked / "check.py")], check=True)
        subprocess.run([sys.executable, "-B", str(unpacked / "pack.py"), "--out", parent], check=True,
                       stdout=subprocess.DEVNULL)
        again = Path(parent, folder + ".zip").read_bytes()
        if again != data:
            raise SystemExit("packing the unpacked copy gives a different archive")


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
