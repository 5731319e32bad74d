"""Rotordynamics with contact.

    import whirl
    m = whirl.read("rotor.toml")
    run = m.simulate(speed="3650 rpm", revolutions=512)
    run.x.sel(station="seal")

`whirl.read` reads models, whose methods are the verbs of the command line; `whirl.open` reads result files.
"""

import sys as _sys

try:
    from ._whirl import version as __version__
    from .arrays import Array
except ImportError as error:
    raise ImportError(f"{error}: whirl needs numpy and the Python that it was built with, such as /usr/bin/python3; "
                      f"this is {_sys.executable}") from error
from .errors import FileError, ModelError, NumericalError, Problem
from .model import Matrices, Model, from_ross, read
from .results import Group, Page, Result, open, report
from .state_space import StateSpace

__all__ = ["Array", "FileError", "Group", "Matrices", "Model", "ModelError", "NumericalError", "Page",
           "Problem", "Result", "StateSpace", "from_ross", "open", "read", "report"]
