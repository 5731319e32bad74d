"""Builds a wheel of the package with CMake (PEP 517), without anything that would have to be downloaded.

The libraries are those of the system, as tools/setup --python installs them. Settings of pip, such as
`--config-settings=-DWHIRL_INSTRUCTION_SETS=all`, go to CMake.
"""

import base64
import hashlib
import os
import pathlib
import re
import subprocess
import sys
import sysconfig
import tarfile
import tempfile
import zipfile

if sys.version_info < (3, 11):
    raise SystemExit(f"whirl needs Python 3.11, such as /usr/bin/python3 of Debian 12; this is {sys.version.split()[0]}")
import tomllib

ROOT = pathlib.Path(__file__).resolve().parents[2]
TAG = "cp{0}{1}-cp{0}{1}-{2}".format(*sys.version_info[:2], re.sub(r"[-.]", "_", sysconfig.get_platform()))


def version() -> str:
    return re.search(r"project\(whirl VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text())[1]


def _metadata() -> str:
    """Facts of pyproject.toml, and those that it leaves to us."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    lines = ["Metadata-Version: 2.1", f"Name: {project['name']}", f"Version: {version()}",
             f"Summary: {project['description']}", "License: BSD-3-Clause",
             f"Requires-Python: {project['requires-python']}"]
    lines += [f"Requires-Dist: {needed}" for needed in project["dependencies"]]
    for extra, names in project["optional-dependencies"].items():
        lines += [f"Provides-Extra: {extra}", *(f"Requires-Dist: {name}; extra == '{extra}'" for name in names)]
    return "\n".join(lines) + "\n"


def _facts() -> dict[str, bytes]:
    """The folder .dist-info but for its RECORD."""
    return {"METADATA": _metadata().encode(), "LICENSE": (ROOT / "LICENSE").read_bytes(),
            "WHEEL": f"Wheel-Version: 1.0\nGenerator: whirl\nRoot-Is-Purelib: false\nTag: {TAG}\n".encode()}


def _build(settings: dict, place: pathlib.Path) -> None:
    """The package as it is installed, below a folder."""
    build = ROOT / "build" / "wheel"
    defined = [f"{name}={value}" for name, value in (settings or {}).items() if name.startswith("-D")]
    try:
        subprocess.run(["cmake", "-S", ROOT, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                        "-DCMAKE_UNITY_BUILD=ON", "-DBUILD_TESTING=OFF", "-DWHIRL_BENCH=OFF", "-DWHIRL_PYTHON=ON",
                        "-DWHIRL_INSTRUCTION_SETS=own", "-DWHIRL_PYTHON_FOLDER=.",
                        f"-DPython3_EXECUTABLE={sys.executable}", *defined], check=True)
        subprocess.run(["cmake", "--build", build, "--target", "whirl_python"], check=True)
        subprocess.run(["cmake", "--install", build, "--component", "python", "--prefix", place, "--strip"], check=True)
    except (OSError, subprocess.CalledProcessError) as error:
        raise SystemExit(f"whirl could not be built: {error}\n"
                         "On Debian 12, tools/setup --python installs all that it is built with.") from None


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    """What pip asks before it builds; without this it would build twice."""
    info = pathlib.Path(metadata_directory, f"whirl-{version()}.dist-info")
    info.mkdir()
    for name, data in _facts().items():
        (info / name).write_bytes(data)
    return info.name


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    name = f"whirl-{version()}-{TAG}.whl"
    info = f"whirl-{version()}.dist-info"
    with tempfile.TemporaryDirectory() as folder:
        _build(config_settings, pathlib.Path(folder))
        contents = {str(path.relative_to(folder)): path.read_bytes()
                    for path in sorted(pathlib.Path(folder).rglob("*")) if path.is_file()}
    contents.update({f"{info}/{name}": data for name, data in _facts().items()})
    record = ""
    with zipfile.ZipFile(os.path.join(wheel_directory, name), "w", zipfile.ZIP_DEFLATED) as wheel:
        for path, data in contents.items():
            digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
            record += f"{path},sha256={digest},{len(data)}\n"
            wheel.writestr(path, data)
        wheel.writestr(f"{info}/RECORD", record + f"{info}/RECORD,,\n")
    return name


def build_sdist(sdist_directory, config_settings=None):
    stem = f"whirl-{version()}"
    files = subprocess.run(["git", "ls-files"], cwd=ROOT, check=True, capture_output=True, text=True).stdout
    with tarfile.open(os.path.join(sdist_directory, f"{stem}.tar.gz"), "w:gz") as archive:
        for path in files.split("\n"):
            if path:
                archive.add(ROOT / path, f"{stem}/{path}")
        with tempfile.NamedTemporaryFile("w") as facts:
            facts.write(_metadata())
            facts.flush()
            archive.add(facts.name, f"{stem}/PKG-INFO")
    return f"{stem}.tar.gz"
