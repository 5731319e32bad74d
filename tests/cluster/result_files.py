"""Result files of studies, compared."""

import shutil
import subprocess
import sys


def python_with_h5py():
    """This Python, or that of the system, whose package it is; None where neither has it."""
    for python in (sys.executable, "/usr/bin/python3"):
        imports = [python, "-c", "import h5py"]
        if shutil.which(python) and subprocess.run(imports, capture_output=True).returncode == 0:
            return python
    return None


def is_complete(path, group):
    import h5py

    if not path.exists():
        return False
    with h5py.File(path) as file:
        return group in file and bool(file[group].attrs["complete"])


def differences(one, other, group):
    """Names of datasets that are not the same, bit by bit, beside the calls that made them; ["complete"] where the
    group of one of the files says that it is not."""
    import h5py

    if not (is_complete(one, group) and is_complete(other, group)):
        return ["complete"]
    with h5py.File(one) as a, h5py.File(other) as b:
        names = set()
        for file in (a, b):
            file.visititems(lambda name, item: names.add(name) if isinstance(item, h5py.Dataset) else None)
        names = {name for name in names if name != "arguments" and not name.startswith("call/")}

        def content(file, name):
            if name not in file:
                return None
            item = file[name]
            value = item[()]
            return item.dtype, item.shape, value.tobytes() if item.dtype.kind != "O" else value.tolist()

        return sorted(name for name in names if content(a, name) != content(b, name))
