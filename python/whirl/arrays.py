"""Arrays of results: numpy arrays that know their names, units and axes."""

from __future__ import annotations

import importlib
import unicodedata
from typing import Any, Optional

import numpy as np


def shown(text: Any, keeps: str = "") -> str:
    """A text as it may be printed: names in files come from strangers, and what steers a terminal or turns the
    direction of a text is shown as \ufffd, as the command line does. Line ends, too, unless they are kept."""
    return "".join("\ufffd" if c not in keeps and unicodedata.category(c) in ("Cc", "Cf", "Cs", "Zl", "Zp") else c
                   for c in str(text))


class Array(np.ndarray):
    """Numbers or texts of a result, read-only, with what they are.

    An ordinary numpy array whose memory is that of the result, which it keeps alive; what is computed
    with it, and parts of it, are plain arrays.
    """

    name: str
    unit: str
    """SI unit; empty: none."""
    meaning: str
    dims: tuple[str, ...]
    words: tuple[str, ...]
    """What the numbers stand for, of codes: 0 is the first."""
    _coords: dict[str, "Array"]
    _is_axis: bool  # stands along its own dimension

    def __array_finalize__(self, source: Any) -> None:
        if source is not None and not hasattr(self, "name"):
            self.name = self.unit = self.meaning = ""
            self.dims, self.words, self._coords, self._is_axis = (), (), {}, False

    def __array_wrap__(self, array: np.ndarray, context: Any = None) -> Any:
        return array.view(np.ndarray)[()] if array.ndim == 0 else array.view(np.ndarray)

    def __getitem__(self, key: Any) -> Any:
        return self.view(np.ndarray)[key]

    def __reduce__(self) -> Any:
        return np.array(self).__reduce__()

    @property
    def coords(self) -> dict[str, "Array"]:
        """What stands along its dimensions, by their names, as far as something does."""
        along = {dim: self._along(dim) for dim in self.dims}
        return {dim: array for dim, array in along.items() if array is not None}

    def _along(self, dim: str) -> Optional["Array"]:
        return self if self._is_axis else self._coords.get(dim)

    def sel(self, indexers: Optional[dict[str, Any]] = None, **more: Any) -> "Array":
        """The part at values along dimensions.

        Of texts the one that is so, or has it as a word ('seal' of '7 seal'); of numbers [SI] the nearest.
        """
        part: Array = self
        for dim, value in {**(indexers or {}), **more}.items():
            if dim not in part.dims:
                raise KeyError(f"{self.name} has no dimension {dim!r}, it has {', '.join(part.dims)}")
            along = part._along(dim)
            if along is None:
                raise KeyError(f"nothing stands along {dim!r} of {self.name}; index it by numbers")
            part = part._at(part.dims.index(dim), _place(along, dim, value))
        return part

    def _at(self, axis: int, index: int) -> "Array":
        key = (slice(None),) * axis + (index,)
        values = np.asarray(self)[key]
        dims = self.dims[:axis] + self.dims[axis + 1:]
        return labelled(np.asarray(values), self.name, self.unit, self.meaning, dims, self.words, self._coords)

    def to_xarray(self) -> Any:
        """The same as xarray.DataArray, without a copy. Needs xarray."""
        xarray = need("xarray")
        coords = {dim: ((dim,), np.asarray(c), attributes_of(c)) for dim, c in self.coords.items()}
        return xarray.DataArray(np.asarray(self), dims=self.dims, coords=coords, name=self.name,
                                attrs=attributes_of(self))

    def plot(self, axes: Any = None, **style: Any) -> Any:
        """Draws one or two dimensions over what stands along them; matplotlib axes, which it needs."""
        axes = axes or need("matplotlib.pyplot").subplots()[1]
        if self.ndim not in (1, 2):
            raise ValueError(f"{self.name} has {self.ndim} dimensions ({', '.join(self.dims)}); "
                             "choose among them with sel() until one or two are left")
        x = self._along(self.dims[-1]) if self.dims else None
        is_text = x is not None and x.dtype.kind == "U"
        over = np.arange(self.shape[-1]) if x is None or is_text else np.asarray(x)
        names = self._along(self.dims[0]) if self.ndim == 2 else None
        for i, row in enumerate(np.atleast_2d(np.asarray(self))):
            label = None if self.ndim == 1 else str(i + 1 if names is None else names[i])
            axes.plot(over, row, label=label, **style)
        if x is not None and is_text:
            axes.set_xticks(over, [str(text) for text in x])
        axes.set_xlabel(title_of(x) if x is not None else (self.dims[-1] if self.dims else ""))
        axes.set_ylabel(title_of(self))
        if self.ndim == 2 and len(self) <= 12:
            axes.legend(title=self.dims[0])
        return axes

    def __repr__(self) -> str:
        unit = f" [{self.unit}]" if self.unit else ""
        dims = ", ".join(f"{d}: {n}" for d, n in zip(self.dims, self.shape))
        return f"{shown(f'<{self.name}{unit} ({dims}) {self.meaning}>')}\n{np.array2string(np.asarray(self), threshold=20)}"


def need(module: str) -> Any:
    try:
        return importlib.import_module(module)
    except ImportError as error:
        package = module.split(".")[0]
        raise ImportError(f"this needs {package}: apt-get install python3-{package}, or pip install {package}") from error


def title_of(array: Array) -> str:
    return array.name + (f" [{array.unit}]" if array.unit else "")


def attributes_of(array: Array) -> dict[str, str]:
    facts = {"units": array.unit, "long_name": array.meaning, "words": ",".join(array.words)}
    return {name: value for name, value in facts.items() if value}


def _place(along: Array, dim: str, value: Any) -> int:
    """Number of the element of an axis that a value stands for."""
    if along.dtype.kind == "U":
        texts = [str(text) for text in along]
        found = [i for i, t in enumerate(texts) if t == value] or [
            i for i, t in enumerate(texts) if str(value) in t.split()]
        if len(found) != 1:
            raise KeyError(f"{dim}: {'several' if found else 'none'} of {', '.join(texts)} is {value!r}")
        return found[0]
    if isinstance(value, str):
        raise TypeError(f"{dim}: expected a number{f' [{along.unit}]' if along.unit else ''}, found {value!r}")
    return int(np.nanargmin(np.abs(np.asarray(along) - value)))


def labelled(values: np.ndarray, name: str, unit: str, meaning: str, dims: tuple[str, ...],
             words: tuple[str, ...], coords: dict[str, Array], is_axis: bool = False) -> Array:
    array = values.view(Array)
    array.name, array.unit, array.meaning, array.dims, array.words = name, unit, meaning, dims, words
    array._coords, array._is_axis = coords, is_axis
    return array


def dimension_of(path: str, meaning: str) -> str:
    """The name of the dimension along which a dataset stands."""
    *_, group, name = path.split("/")
    if name.startswith("axis_") and meaning:
        return meaning  # the path of a parameter: operation.speed
    return group.removesuffix("s") if name == "name" and group else name
