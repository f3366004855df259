"""Check the manifest, the files and the size of a packed crate, and print each fault.

    .ci/packed.py CRATE UNPACKED SOURCE     the packed file, the folder of its unpacked contents, the folder
                                            of the crate in the repository

Needs Python 3.11 or later.
"""

import os
import pathlib
import re
import sys
import tomllib

ROOT = pathlib.Path(__file__).resolve().parent.parent
LICENCES = ("LICENSE-APACHE", "LICENSE-MIT")
FIELDS = ("description", "documentation", "license", "readme", "rust-version")
# The keywords that crates.io accepts.
KEYWORD = re.compile(r"[A-Za-z0-9][A-Za-z0-9_+-]{0,19}")
# Twice the size in bytes of the largest crate, that of the suite: a larger crate contains files by mistake.
PACKED_MAX = 2 << 20
# The files that cargo rewrites or adds when it packs a crate.
CARGOS = ("Cargo.toml", "Cargo.toml.orig", "Cargo.lock", ".cargo_vcs_info.json")
# Home folders and other paths of this machine, which a packed file must not contain. A path such as /tmp/a
# in an example is permitted.
HOMES = (r"/home/\w", r"/root/", r"/Users/\w", r"[A-Z]:\\\\?Users")
PATHS = (str(ROOT), os.environ.get("CARGO_HOME"), os.environ.get("CARGO_TARGET_DIR"))
MACHINE = re.compile("|".join([*HOMES, *(re.escape(path) for path in PATHS if path)]).encode())


def metadata(package):
    yield from (f"no {field}" for field in FIELDS if not package.get(field))
    keywords, categories = package.get("keywords", []), package.get("categories", [])
    if not 1 <= len(keywords) <= 5 or not 1 <= len(categories) <= 5:
        yield "the manifest needs one to five keywords and one to five categories"
    yield from (f"keyword {word}" for word in keywords if not KEYWORD.fullmatch(word))
    if package["license"] != "MIT OR Apache-2.0":
        yield f"licence {package['license']}"


def dependencies(manifest):
    """Yields each dependency that is not from a registry: a packed crate cannot use it."""
    for kind in ("dependencies", "dev-dependencies", "build-dependencies"):
        for name, what in manifest.get(kind, {}).items():
            if "path" in what or "git" in what or "version" not in what:
                yield f"{kind}: {name} = {what}"


def files(folder, version, source):
    for name in LICENCES:
        if not (folder / name).exists() or (folder / name).read_bytes() != (ROOT / name).read_bytes():
            yield f"{name} differs from that of the workspace"
    changelog = folder / "CHANGELOG.md"
    if not changelog.exists() or f"\n## {version}\n" not in changelog.read_text(encoding="utf-8"):
        yield f"CHANGELOG.md has no {version}"
    for path in sorted(path for path in folder.rglob("*") if path.is_file()):
        name, given = path.relative_to(folder), path.read_bytes()
        if found := MACHINE.search(given):
            yield f"{name} contains the path {found[0].decode(errors='replace')}"
        if str(name) not in CARGOS and given != (source / name).read_bytes():
            yield f"{name} differs from that in {source}"


def main(crate, folder, source):
    manifest = tomllib.loads((folder / "Cargo.toml").read_text(encoding="utf-8"))
    package = manifest["package"]
    packed = crate.stat().st_size
    faults = [*metadata(package), *dependencies(manifest), *files(folder, package["version"], source)]
    if not (folder / package.get("readme", "README.md")).exists():
        faults.append("no README")
    if packed > PACKED_MAX:
        faults.append(f"{packed} bytes exceed the maximum of {PACKED_MAX}")
    sizes = [path.stat().st_size for path in folder.rglob("*") if path.is_file()]
    print(f"{crate.name}: {packed / 1024:.0f} KiB, {len(sizes)} files of {sum(sizes) / 1024:.0f} KiB")
    return [f"{crate.name}: {fault}" for fault in faults]


if __name__ == "__main__":
    faults = main(*map(pathlib.Path, sys.argv[1:]))
    print(*faults, sep="\n", end="\n" if faults else "")
    sys.exit(bool(faults))
