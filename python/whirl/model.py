"""Models: read, changed by paths, and computed with."""

from __future__ import annotations

import copy
import dataclasses
import json
import os
import re
import tempfile
import tomllib
import warnings
from typing import Any, Iterator, Mapping, Optional, Union

import numpy as np

from . import _whirl
from .arrays import shown
from .methods import TABLES, Methods
from .results import Result, run_verb
from .state_space import StateSpace, state_space
from .verbs import Verb, given_values, text_of


def _toml(value: Any) -> str | None:
    """A value as it stands in a model file; None: it cannot."""
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, (list, tuple)) or (isinstance(value, np.ndarray) and value.ndim == 1):
        items = [text for text in map(_toml, value) if text is not None]
        return f"[{', '.join(items)}]" if len(items) == len(value) else None
    if isinstance(value, Mapping):
        pairs = [(key, _toml(v)) for key, v in value.items()]
        if any(not isinstance(key, str) or text is None for key, text in pairs):
            return None
        return "{" + ", ".join(f"{_key(key)} = {text}" for key, text in pairs) + "}"
    return text_of(value)


def _key(key: str) -> str:
    return key if re.fullmatch(r"[A-Za-z0-9_-]+", key) else str(_toml(key))


def _assignment(path: Any, value: Any) -> str:
    if not isinstance(path, str):
        raise TypeError(f"expected the path of a value such as 'contact.seal.friction', found {path!r}")
    text = value if isinstance(value, str) else _toml(value)
    if text is None:
        raise TypeError(f"{path}: expected a number, a text with a unit, True or False, a list or a dict, "
                        f"found {type(value).__name__}")
    return f"{path}={text}"


def _assignments(values: Union[Mapping[str, Any], list, None]) -> list[str]:
    if values is None:
        return []
    if isinstance(values, Mapping):
        return [_assignment(path, value) for path, value in values.items()]
    if isinstance(values, (list, tuple)) and all(isinstance(v, str) for v in values):
        return list(values)
    raise TypeError(f"set: expected a dict of paths and values, found {type(values).__name__}")


def _keys(table: str, keys: Mapping[str, Any]) -> dict[str, Any]:
    """Keys of a table, which those that are words of Python end in _: in_, from_."""
    made = {}
    for name, value in keys.items():
        if _toml(value) is None:
            raise TypeError(f"{table}() {name}: expected a number, a text with a unit, True or False, a list or a "
                            f"dict, found {type(value).__name__}")
        made[name.removesuffix("_")] = value
    return made


def _toml_of(tree: Mapping[str, Any]) -> str:
    """A model as a file."""
    lines = [f"{key} = {_toml(value)}" for key, value in tree.items() if key not in TABLES]
    for table, kind in TABLES.items():
        if table not in tree:
            continue
        value = tree[table]
        parts = ([(f"[[{table}]]", v) for v in value] if kind == "several" else
                 [(f"[{table}.{_key(name)}]", v) for name, v in value.items()] if kind == "named" else
                 [(f"[{table}]", value)])
        for head, keys in parts:
            lines += ["", head, *(f"{_key(key)} = {_toml(v)}" for key, v in keys.items())]
    return "\n".join(lines) + "\n"


@dataclasses.dataclass(frozen=True)
class Matrices:
    """M q'' + (C + speed G) q' + K q = f of the rotor, supports eliminated, nothing condensed.

    What damping that rotates with the shaft adds to the stiffness at the speed is in K.
    They can be taken apart: M, C, G, K = m.matrices().
    """

    M: Any
    """Mass, scipy.sparse.csc_array [kg, kg m^2]."""
    C: Any
    """Damping [N s/m, N m s/rad]."""
    G: Any
    """Gyroscopic matrix, times the speed [kg m^2]."""
    K: Any
    """Stiffness [N/m, N m/rad]."""
    dofs: list[str]
    """What each q is: 'node 3 x', 'node 3 theta_y', ..."""
    z: np.ndarray
    """Where each q is along the shaft [m]; NaN for bodies and internal shape functions."""
    speed: float
    """[rad/s]"""

    def __iter__(self) -> Iterator[Any]:
        return iter((self.M, self.C, self.G, self.K))

    def __repr__(self) -> str:
        return shown(f"<whirl.Matrices M, C, G, K of {len(self.dofs)} coordinates ({self.dofs[0]}, ..., {self.dofs[-1]}) "
                     f"at {self.speed:.6g} rad/s>")


class Model(Methods):
    """A rotor with its bearings, seals and contacts.

    Values are read and set by their paths in the model file, with units as there::

        m = whirl.read("rotor.toml")
        m["contact.seal.friction"] = 0.2
        m["operation.speed"] = "3000 rpm"
        run = m.simulate(revolutions=512)

    Every verb of the command line is a method; its options are keyword arguments.

    Models are built in code, too: tables of the model file are methods, their keys keyword arguments::

        m = (whirl.Model(title="a disk", gravity=9.81)
             .operation(speed="3000 rpm")
             .material(name="steel", density="7800 kg/m^3", youngs_modulus="210 GPa", poisson_ratio=0.3)
             .shaft(material="steel", length="1 m", outer_diameter="30 mm", elements=10)
             .disk(at="500 mm", mass="12 kg", polar_inertia=0.1, diametral_inertia=0.05)
             .bearing(at=0.0, stiffness="10 MN/m")
             .bearing(at=1.0, stiffness="10 MN/m"))
    """

    def __init__(self, text: Optional[str] = None, name: Union[str, os.PathLike] = "model.toml", **keys: Any) -> None:
        """A model of a TOML text; or one to be built, of keys that stand in no table (title, gravity).

        `name` is for messages; files that the model names are looked for in its folder.
        Raises ModelError, with all `problems`, where the text is no model.
        """
        self._name = os.fspath(name)
        self._tree: Optional[dict[str, Any]] = None
        self._made: Optional[_whirl.ModelText] = None
        if text is None:
            self._tree = {"format": 1, **_keys("Model", keys)}
        elif keys:
            raise TypeError(f"Model() takes a text or keys, not both; found a text and {', '.join(keys)}")
        elif not isinstance(text, str):
            raise TypeError(f"Model() takes the text of a model, found {type(text).__name__}; whirl.read() reads files")
        else:
            self._made = _whirl.ModelText(self._name, text, [])

    @property
    def _text(self) -> _whirl.ModelText:
        if self._made is None:
            self._made = _whirl.ModelText(self._name, _toml_of(self._tree or {}), [])
        return self._made

    def add(self, table: str, **keys: Any) -> Model:
        """Adds a table of the model file, or one more of those that there may be several of; the model itself.

        Methods of these names do the same, but of 'unbalance', which is a verb. The model is looked at as a
        whole when it is used first: ModelError then tells all problems.
        """
        if table not in TABLES:
            raise TypeError(f"there is no table {table!r}; there are {', '.join(TABLES)}")
        if self._tree is None:
            self._tree = tomllib.loads(self.to_toml())
        self._made = None
        keys = _keys(table, keys)
        if TABLES[table] == "several":
            self._tree.setdefault(table, []).append(keys)
        elif TABLES[table] == "named":
            if "name" not in keys:
                raise TypeError(f"{table}() needs a name")
            self._tree.setdefault(table, {})[keys.pop("name")] = keys
        else:
            self._tree.setdefault(table, {}).update(keys)
        return self

    @property
    def title(self) -> str:
        return self._text.title

    @property
    def path(self) -> str:
        """The file that it was read from."""
        return self._text.file

    @property
    def sets(self) -> list[str]:
        """What was set of it since: 'PATH=VALUE', as --set of the command line has it."""
        return self._text.sets

    def __getitem__(self, path: str) -> Any:
        """A value as it is written: a number [SI], a text with its unit, a list or a dict."""
        if not isinstance(path, str):
            raise TypeError(f"expected the path of a value such as 'contact.seal.friction', found {path!r}")
        return self._text.value(path)

    def __setitem__(self, path: str, value: Any) -> None:
        """Sets a value; where it makes no model, ModelError says why and the model stays as it was."""
        self._change([_assignment(path, value)])

    def _change(self, assignments: list[str]) -> None:
        self._made = self._text.with_sets(assignments)
        self._tree = None

    def update(self, values: Mapping[str, Any]) -> None:
        """Sets several values, all or none."""
        self._change(_assignments(values))

    def copy(self) -> Model:
        """Another model, which begins as this one is."""
        other = object.__new__(type(self))
        other._name, other._tree, other._made = self._name, copy.deepcopy(self._tree), self._made
        return other

    def to_toml(self) -> str:
        """The model as a file, with everything that was set and with the tables that it names in it."""
        return self._text.source

    def save(self, path: Union[str, os.PathLike]) -> None:
        """Writes the model as a file."""
        with open(path, "w", encoding="utf-8") as file:
            file.write(self.to_toml())

    def _with(self, speed: Any, sets: Any) -> _whirl.ModelText:
        assignments = _assignments(sets)
        if speed is not None:
            assignments.append(_assignment("operation.speed", speed))
        return self._text.with_sets(assignments) if assignments else self._text

    def matrices(self, speed: Any = None) -> Matrices:
        """Mass, damping, gyroscopic and stiffness matrix at a speed, with what each coordinate is.

        Oil films are linear about their journals' equilibrium, tables of bearings are those of the speed.
        Needs scipy.
        """
        try:
            from scipy.sparse import csc_array
        except ImportError as error:
            raise ImportError("matrices() gives sparse matrices of scipy: apt-get install python3-scipy") from error
        found = self._with(speed, None).matrices()
        n = len(found["names"])
        M, C, G, K = (csc_array(found[name], shape=(n, n), copy=False) for name in "MCGK")
        return Matrices(M, C, G, K, found["names"], np.array(found["z"]), found["speed"])

    def state_space(self, inputs: Any = None, outputs: Any = None, quantity: Any = "displacement",
                    modes: Optional[int] = None, speed: Any = None) -> StateSpace:
        """A, B, C, D of the linear rotor at a speed, of the matrices of `matrices`: forces to motions.

        `inputs` and `outputs` are those of `frf`: stations by number or name with a direction of x, y, theta_x
        and theta_y, "7:x,ring:y" or a list of such, or names of probes. Left out: x and y of all that have a
        name; of outputs: the inputs. `quantity` is displacement, velocity or acceleration, or several. `modes`
        keeps the lowest modes only; left out: all, which is the whole model.

        Needs scipy. Raises ModelError for unknown ends, NumericalError where something has no mass.
        """
        return state_space(self, inputs, outputs, quantity, modes, speed)

    def _call(self, verb: Verb, args: tuple, options: dict[str, Any]) -> Result:
        model, wanted = self._text, None
        if options:
            speed, sets = options.pop("speed", None), options.pop("set", None)
            wanted = options.pop("progress", None)
            if speed is not None or sets is not None:
                model = self._with(speed, sets)
        given = given_values(verb, args, options)
        return run_verb(verb.name, wanted, lambda progress: _whirl.run(verb.name, model, given, progress))

    def __repr__(self) -> str:
        title = f" {self.title!r}" if self.title else ""
        return shown(f"<whirl.Model{title} of {self.path}>")


def read(path: Union[str, os.PathLike]) -> Model:
    """Reads a model file (TOML) and all that it names. Raises ModelError with all problems."""
    path = os.fspath(path)
    return Model(_whirl.file_text(path), path)


def from_ross(path: Union[str, os.PathLike]) -> Model:
    """Reads a rotor saved by ROSS, TOML or JSON, as `whirl import` does; tables are in the model then.

    A UserWarning tells what the model does not have, or takes differently. Raises ModelError with the places of
    all problems, FileError if the file cannot be read.
    """
    path = os.fspath(path)
    stem = os.path.splitext(os.path.basename(path))[0]
    with tempfile.TemporaryDirectory(prefix="whirl-") as folder:
        place = os.path.join(folder, f"{stem}.toml")
        left_out, taken_differently = _whirl.import_file(path, place)
        text = read(place).to_toml()
    for what, lines in (("taken differently", taken_differently), ("left out", left_out)):
        for line in lines:
            warnings.warn(f"{path}: {what}: {line}", UserWarning, stacklevel=2)
    return Model(text, f"{stem}.toml")
