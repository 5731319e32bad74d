"""What `pip install .` makes, of a package that is built already: a wheel that pip takes and that can be imported,
whose facts are those of pyproject.toml."""

import email
import hashlib
import os
import pathlib
import shutil
import subprocess
import sys
import tarfile
import tempfile
import unittest
import zipfile

import support
from support import whirl

sys.dont_write_bytecode = True
sys.path.insert(0, str(support.REPOSITORY / "python/wheel"))
import whirl_build  # noqa: E402


class Wheel(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        def copy(settings, place):
            shutil.copytree(pathlib.Path(support.PACKAGE, "whirl"), place / "whirl",
                            ignore=shutil.ignore_patterns("__pycache__"))

        build, whirl_build._build = whirl_build._build, copy
        cls.path = pathlib.Path(tempfile.mkdtemp(dir=support.FOLDER.name))
        cls.name = whirl_build.build_wheel(cls.path)
        whirl_build._build = build

    def test_facts_are_those_of_the_project(self):
        info = pathlib.Path(whirl_build.prepare_metadata_for_build_wheel(str(self.path)))
        with zipfile.ZipFile(self.path / self.name) as wheel:
            for fact in ("METADATA", "WHEEL", "LICENSE"):
                self.assertEqual((self.path / info / fact).read_bytes(), wheel.read(f"{info}/{fact}"))
        facts = email.message_from_string((self.path / info / "METADATA").read_text())
        self.assertEqual((facts["Name"], facts["Version"]), ("whirl", whirl.__version__))
        self.assertEqual(facts["Requires-Python"], ">=3.11")
        needed = facts.get_all("Requires-Dist")
        self.assertEqual(needed[0].split(">")[0], "numpy")
        self.assertIn("matplotlib; extra == 'all'", needed)

    def test_every_file_is_recorded(self):
        with zipfile.ZipFile(self.path / self.name) as wheel:
            record = [line.split(",") for line in wheel.read(f"whirl-{whirl.__version__}.dist-info/RECORD").decode().split()]
            self.assertEqual({name for name, _, _ in record}, set(wheel.namelist()))
            for name, digest, size in record:
                if digest:
                    data = wheel.read(name)
                    self.assertEqual(int(size), len(data))
                    self.assertEqual(digest, "sha256=" + whirl_build.base64.urlsafe_b64encode(
                        hashlib.sha256(data).digest()).rstrip(b"=").decode())
            self.assertIn("whirl/py.typed", wheel.namelist())
            self.assertIn("whirl/_whirl.pyi", wheel.namelist())

    def test_can_be_installed_and_imported(self):
        place = self.path / "installed"
        pip = subprocess.run([sys.executable, "-m", "pip", "install", "--quiet", "--no-index", "--no-deps", "--target", place,
                              self.path / self.name], capture_output=True, text=True)
        if "No module named pip" in pip.stderr:
            zipfile.ZipFile(self.path / self.name).extractall(place)
        else:
            self.assertEqual(pip.returncode, 0, pip.stderr)
        code = "import whirl, sys; print(whirl.__file__, len(whirl.read(sys.argv[1]).modes(modes=2).frequency))"
        done = subprocess.run([sys.executable, "-c", code, support.MODELS / "jeffcott.toml"], capture_output=True, text=True,
                              env={**os.environ, "PYTHONPATH": str(place)})
        self.assertEqual(done.stdout.split(), [str(place / "whirl/__init__.py"), "2"], done.stderr)

    def test_what_is_missing_is_told(self):
        path, os.environ["PATH"] = os.environ["PATH"], self.path.as_posix()
        try:
            with self.assertRaisesRegex(SystemExit, "No such file or directory: 'cmake'\n.*tools/setup --python"):
                whirl_build._build({}, self.path)
        finally:
            os.environ["PATH"] = path

    @unittest.skipUnless(shutil.which("git") and (support.REPOSITORY / ".git").exists(), "there is no git repository")
    def test_sources_are_packed(self):
        name = whirl_build.build_sdist(self.path)
        with tarfile.open(self.path / name) as archive:
            names = set(archive.getnames())
        stem = f"whirl-{whirl.__version__}"
        for file in ("PKG-INFO", "CMakeLists.txt", "pyproject.toml", "python/wheel/whirl_build.py", "libbase/error.cpp"):
            self.assertIn(f"{stem}/{file}", names)


support.main()
