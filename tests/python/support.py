"""What the tests of the package share: `support.main()` runs one file of them.

    FILE_test.py WHIRL REPOSITORY PACKAGE_FOLDER

Exit status 77, skipped, without the module or numpy.
"""

import importlib.util
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

PROGRAM, REPOSITORY, PACKAGE = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3]
MODELS = REPOSITORY / "models"
sys.path.insert(0, PACKAGE)
try:
    import numpy as np

    import whirl
except ImportError as error:
    print(f"skipped: {error} (Debian: pybind11-dev, python3-dev, python3-numpy; then configure with -DWHIRL_PYTHON=AUTO)")
    sys.exit(77)

FOLDER = tempfile.TemporaryDirectory(prefix="whirl-python-test-")
os.chdir(FOLDER.name)


def needs(*modules):
    missing = [m for m in modules if importlib.util.find_spec(m) is None]
    return unittest.skipIf(missing, f"there is no {', '.join(missing)}")


def model(name):
    return whirl.read(MODELS / f"{name}.toml")


def command_line(*words):
    """Runs the program: its exit status, standard output and standard error."""
    done = subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True)
    return done.returncode, done.stdout, done.stderr


def same_bits(a, b):
    """Whether arrays are the same to the last bit, NaN at the same places."""
    a, b = np.asarray(a), np.asarray(b)
    if a.dtype.kind == "U" or b.dtype.kind == "U":
        return a.shape == b.shape and a.tolist() == b.tolist()
    return a.shape == b.shape and a.dtype == b.dtype and a.tobytes() == b.tobytes()


def main():
    result = unittest.main(argv=sys.argv[:1], exit=False, verbosity=2).result
    sys.exit(0 if result.wasSuccessful() else 1)
