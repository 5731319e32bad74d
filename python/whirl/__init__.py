"""Rotordynamics with contact.

    import whirl
    m = whirl.read("rotor.toml")
    run = m.simulate(speed="3650 rpm", revolutions=512)
    run.x.sel(station="seal")

`whirl.read` reads models, whose methods are the verbs of the command line; `whirl.open` reads result files.
"""

from ._whirl import version as __version__
from .arrays import Array
from .errors import FileError, ModelError, NumericalError, Problem
from .model import Matrices, Model, read
from .results import Group, Page, Result, open, report

__all__ = ["Array", "FileError", "Group", "Matrices", "Model", "ModelError", "NumericalError", "Page",
           "Problem", "Result", "open", "read", "report"]
