"""The cases in Octave: octave_case.m, with the case written before it. Octave itself measures the time."""
import pathlib

import numpy as np

from .cases import REVOLUTIONS
from .timing import rows_of_process

SCRIPT = pathlib.Path(__file__).with_name("octave_case.m")
NAMES = {"end": "finish"}  # words of Octave


def matrix(value):
    """A number, column or matrix."""
    value = np.asarray(value)
    rows = value.reshape(-1, 1) if value.ndim < 2 else value
    return "[" + ";".join(" ".join(f"{x:.17g}" for x in row) for row in rows) + "]"


def script(case):
    lines = [f"c.{NAMES.get(key, key)} = {matrix(value)};" for key, value in vars(case).items() if key != "name"]
    return "\n".join([*lines, f"name = '{case.name}';", f"revolutions = {REVOLUTIONS};", SCRIPT.read_text()])


def run(case, program, folder):
    path = folder / "case.m"
    path.write_text(script(case))
    return rows_of_process([program, "--norc", "--quiet", path], folder)
