"""Builds the wheel, as PEP 517 has it: pure Python and the library of this platform, which `../build python`
puts beside it. Needs only the standard library, as does installing the wheel."""

import base64
import hashlib
import pathlib
import re
import sysconfig
import zipfile

HERE = pathlib.Path(__file__).resolve().parent
LICENCES = [HERE.parent.parent / f"LICENSE-{name}" for name in ("APACHE", "MIT")]
LIBRARIES = ("libads_cnc.so", "libads_cnc.dylib", "ads_cnc.dll")


def field(name):
    return re.search(rf'^{name} = "(.*)"$', (HERE / "pyproject.toml").read_text(encoding="utf-8"), re.M)[1]


def platform():
    name = sysconfig.get_platform().replace("-", "_").replace(".", "_")
    # It needs memcpy, memset and bcmp of any C library: codec/bindings/run sees to it.
    return name.replace("linux_", "manylinux_2_17_") if name.startswith("linux_") else name


def digest(data):
    return base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    package = HERE / "src" / "ads_cnc"
    files = {
        f"ads_cnc/{path.name}": path.read_bytes() for path in sorted(package.iterdir()) if path.is_file()
    }
    if not any(f"ads_cnc/{name}" in files for name in LIBRARIES) or "ads_cnc/_functions.py" not in files:
        raise SystemExit("no library to pack: codec/bindings/build python puts it there")
    name, version = field("name").replace("-", "_"), field("version")
    info, tag = f"{name}-{version}.dist-info", f"py3-none-{platform()}"
    metadata = [
        "Metadata-Version: 2.4",
        f"Name: {field('name')}",
        f"Version: {version}",
        f"Summary: {field('description')}",
        f"License-Expression: {field('license')}",
        *(f"License-File: {path.name}" for path in LICENCES),
        f"Requires-Python: {field('requires-python')}",
        "Description-Content-Type: text/markdown",
        "",
        (HERE / "README.md").read_text(encoding="utf-8"),
    ]
    wheel = ["Wheel-Version: 1.0", "Generator: backend.py", "Root-Is-Purelib: false", f"Tag: {tag}", ""]
    files[f"{info}/METADATA"] = "\n".join(metadata).encode()
    files[f"{info}/WHEEL"] = "\n".join(wheel).encode()
    files |= {f"{info}/licenses/{path.name}": path.read_bytes() for path in LICENCES}
    record = [f"{path},sha256={digest(data)},{len(data)}" for path, data in files.items()]
    files[f"{info}/RECORD"] = "\n".join([*record, f"{info}/RECORD,,", ""]).encode()
    output = f"{name}-{version}-{tag}.whl"
    with zipfile.ZipFile(pathlib.Path(wheel_directory, output), "w", zipfile.ZIP_DEFLATED) as archive:
        for path, data in files.items():
            # All wheels of one version are the same, whenever they are made.
            archive.writestr(zipfile.ZipInfo(path), data, zipfile.ZIP_DEFLATED)
    return output
