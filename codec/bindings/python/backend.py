"""The PEP 517 backend: builds a wheel of pure Python and the library for this platform, which `../build python`
copies into the package. Needs only the standard library."""

import base64
import collections
import hashlib
import pathlib
import re
import sysconfig
import zipfile

HERE = pathlib.Path(__file__).resolve().parent
LICENCES = [HERE.parent.parent / f"LICENSE-{name}" for name in ("APACHE", "MIT")]
LIBRARIES = ("libads_cnc.so", "libads_cnc.dylib", "ads_cnc.dll")

# The metadata of a wheel.
About = collections.namedtuple("About", "name version summary licence python readme")


def field(name):
    return re.search(rf'^{name} = "(.*)"$', (HERE / "pyproject.toml").read_text(encoding="utf-8"), re.M)[1]


def platform():
    name = sysconfig.get_platform().replace("-", "_").replace(".", "_")
    # The library needs no function of a C library that glibc 2.17 lacks; codec/bindings/run verifies that.
    return name.replace("linux_", "manylinux_2_17_") if name.startswith("linux_") else name


def digest(data):
    return base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()


def write_wheel(directory, about, platforms, files, executable=()):
    """Writes a wheel with these files, by path; dots separate `platforms`. Returns the name of the wheel.

    The wheel is reproducible: all its files have the same fixed date, so the same input produces the same bytes on
    the same platform.
    """
    name, tag = about.name.replace("-", "_"), f"py3-none-{platforms}"
    info = f"{name}-{about.version}.dist-info"
    metadata = [
        "Metadata-Version: 2.4",
        f"Name: {about.name}",
        f"Version: {about.version}",
        f"Summary: {about.summary}",
        f"License-Expression: {about.licence}",
        *(f"License-File: {path.name}" for path in LICENCES),
        f"Requires-Python: {about.python}",
        "Description-Content-Type: text/markdown",
        "",
        about.readme,
    ]
    tags = [f"Tag: py3-none-{platform}" for platform in platforms.split(".")]
    wheel = ["Wheel-Version: 1.0", "Generator: backend.py", "Root-Is-Purelib: false", *tags, ""]
    files = dict(files)
    files[f"{info}/METADATA"] = "\n".join(metadata).encode()
    files[f"{info}/WHEEL"] = "\n".join(wheel).encode()
    files |= {f"{info}/licenses/{path.name}": path.read_bytes() for path in LICENCES}
    record = [f"{path},sha256={digest(data)},{len(data)}" for path, data in files.items()]
    files[f"{info}/RECORD"] = "\n".join([*record, f"{info}/RECORD,,", ""]).encode()
    output = f"{name}-{about.version}-{tag}.whl"
    with zipfile.ZipFile(pathlib.Path(directory, output), "w", zipfile.ZIP_DEFLATED) as archive:
        for path, data in files.items():
            entry = zipfile.ZipInfo(path)
            entry.external_attr = (0o100755 if path in executable else 0o100644) << 16
            archive.writestr(entry, data, zipfile.ZIP_DEFLATED)
    return output


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    package = HERE / "src" / "ads_cnc"
    files = {
        f"ads_cnc/{path.name}": path.read_bytes() for path in sorted(package.iterdir()) if path.is_file()
    }
    if not any(f"ads_cnc/{name}" in files for name in LIBRARIES) or "ads_cnc/_functions.py" not in files:
        raise SystemExit("the library or _functions.py is missing in src/ads_cnc: run codec/bindings/build python")
    readme = (HERE / "README.md").read_text(encoding="utf-8")
    described = (field(name) for name in ("name", "version", "description", "license", "requires-python"))
    return write_wheel(wheel_directory, About(*described, readme), platform(), files)
