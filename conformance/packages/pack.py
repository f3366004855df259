"""Packs the command `ads-cnc` of one target: an archive and a wheel.

    conformance/packages/pack.py TARGET FOLDER      FOLDER contains the command
"""

import gzip
import io
import pathlib
import re
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
DOCUMENTS = {
    "README.md": ROOT / "README.md",
    "TOOLS.md": ROOT / "conformance/TOOLS.md",
    "LICENSE-APACHE": ROOT / "LICENSE-APACHE",
    "LICENSE-MIT": ROOT / "LICENSE-MIT",
}
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


def archive(target, name, command):
    """A .zip for Windows, and a .tar.gz for the others; the same bytes whenever it is made."""
    folder = f"ads-cnc-{version()}-{target}"
    files = {name: command} | {name: path.read_bytes() for name, path in DOCUMENTS.items()}
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
    script = f"ads_cnc-{version()}.data/scripts/{name}"
    output = backend.write_wheel(HERE / "dist", about, platform(target, command), {script: command}, {script})
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
