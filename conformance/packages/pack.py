"""Packs the command `ads-cnc` of one target: an archive and a wheel.

    conformance/packages/pack.py TARGET FOLDER      FOLDER contains the command
"""

import gzip
import io
import pathlib
import re
import subprocess
import sys
import tarfile
import zipfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
sys.path.insert(0, str(ROOT / "codec/bindings/python"))
sys.dont_write_bytecode = True
import backend  # noqa: E402

# The platforms of wheels, except those of macOS. A static program runs with any C library.
PLATFORMS = {
    "x86_64-unknown-linux-musl": "manylinux_2_17_x86_64.musllinux_1_1_x86_64",
    "aarch64-unknown-linux-musl": "manylinux_2_17_aarch64.musllinux_1_1_aarch64",
    "x86_64-pc-windows-gnu": "win_amd64",
}
# Files and folders that are packed under the same paths as in the repository, so that links between
# documents, and paths in help texts and messages, are valid in the package too.
PACKED = [
    *("README.md", "LICENSE-APACHE", "LICENSE-MIT", "spec-vectors/README.md"),
    *("conformance/TOOLS.md", "conformance/CHANGELOG.md", "conformance/adapters", "conformance/schema"),
]
SUMMARY = "Conformance suite and simulated CNC for the ADS interface of ISG and TwinCAT CNCs"
EXECUTABLE = 0o755


def version():
    manifest = (ROOT / "Cargo.toml").read_text(encoding="utf-8")
    return re.search(r'^version = "(.*)"$', manifest, re.M)[1]


def platform(target, command):
    """The platform of the wheel: for macOS with the oldest version that the program declares to run on."""
    if "apple" not in target:
        return PLATFORMS[target]
    at, build_version = 32, 0x32
    while int.from_bytes(command[at : at + 4], "little") != build_version:
        at += int.from_bytes(command[at + 4 : at + 8], "little")
    _, minor, major = command[at + 12 : at + 15]
    return f"macosx_{major}_{minor}_{target.split('-')[0].replace('aarch64', 'arm64')}"


def documents():
    """The packed documents, adapters and schemas, by path; without untracked files, such as programs built there."""
    git = ["git", "-C", ROOT, "ls-files", "-z", "--", *PACKED]
    paths = subprocess.run(git, check=True, stdout=subprocess.PIPE, encoding="utf-8").stdout.split("\0")
    return {path: (ROOT / path).read_bytes() for path in paths if path}


def archive(target, name, command):
    """A .zip for Windows, and a .tar.gz for the others; the same bytes whenever it is made."""
    folder = f"ads-cnc-{version()}-{target}"
    files = {name: command} | documents()
    if "windows" in target:
        path = HERE / "dist" / f"{folder}.zip"
        with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as out:
            for one, data in files.items():
                out.writestr(zipfile.ZipInfo(f"{folder}/{one}"), data, zipfile.ZIP_DEFLATED)
        return path
    path = HERE / "dist" / f"{folder}.tar.gz"
    with open(path, "wb") as raw, gzip.GzipFile("", "wb", mtime=0, fileobj=raw) as packed:
        with tarfile.open(fileobj=packed, mode="w") as out:
            for one, data in files.items():
                about = tarfile.TarInfo(f"{folder}/{one}")
                about.size, about.mode = len(data), EXECUTABLE if one == name else 0o644
                out.addfile(about, io.BytesIO(data))
    return path


def wheel(target, name, command):
    readme = (ROOT / "conformance/README.md").read_text(encoding="utf-8")
    about = backend.About("ads-cnc", version(), SUMMARY, "MIT OR Apache-2.0", ">=3.9", readme)
    data = f"ads_cnc-{version()}.data"
    script = f"{data}/scripts/{name}"
    files = {script: command} | {f"{data}/data/share/ads-cnc/{path}": text for path, text in documents().items()}
    output = backend.write_wheel(HERE / "dist", about, platform(target, command), files, {script})
    return HERE / "dist" / output


def main():
    target, folder = sys.argv[1:]
    name = "ads-cnc.exe" if "windows" in target else "ads-cnc"
    command = pathlib.Path(folder, name).read_bytes()
    for pack in (archive, wheel):
        path = pack(target, name, command)
        print(f"{path.relative_to(HERE)}  {path.stat().st_size} bytes")


if __name__ == "__main__":
    main()
