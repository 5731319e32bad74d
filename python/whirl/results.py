"""Results: groups of named arrays, as result files hold them."""

from __future__ import annotations

import hashlib
import html
import json
import os
import pathlib
import re
import shutil
import tempfile
import warnings
import weakref
from builtins import open as _open_file
from typing import Any, Callable, Iterator, Optional, Union

import numpy as np

from . import _whirl, progress as _progress
from .arrays import Array, attributes_of, dimension_of, labelled, need, shown, title_of
from .errors import ModelError, Problem
from .methods import ResultMethods
from .verbs import VERBS, Verb, given_values


class _Arrays:
    """The arrays of a store, each made once."""

    def __init__(self, store: Any) -> None:
        self._store = store
        self._made: dict[str, Array] = {}
        self._axes = {axis for path in store.paths() for axis in store.info(path)[2] if axis}
        self._words = {owner: tuple(value.split(",")) for owner, name, value in store.attributes() if name == "words"}

    def __getitem__(self, path: str) -> Array:
        if path not in self._made:
            self._made[path] = self._make(path)
        return self._made[path]

    def _make(self, path: str) -> Array:
        unit, meaning, axes, shape, names = self._store.info(path)
        values = self._store.values(path)
        if isinstance(values, list):
            values = np.array(values, dtype=str).reshape(shape)
            values.flags.writeable = False
        dims: list[str] = []
        coords = {}
        for i, axis in enumerate(axes):
            if axis:
                along = self[axis]
                dim = dimension_of(axis, along.meaning)
                coords[dim] = along
            elif path in self._axes:
                dim = dimension_of(path, meaning)
            else:
                dim = names[i] if i < len(names) and not names[i].isdigit() else f"dim_{i + 1}"
            dims.append(dim if dim not in dims else f"{dim}_{i + 1}")
        return labelled(values, path.rpartition("/")[2], unit, meaning, tuple(dims), self._words.get(path, ()),
                        coords, path in self._axes)


class Group:
    """A part of a result: arrays and numbers by their names, as attributes and by []."""

    def __init__(self, arrays: _Arrays, path: str) -> None:
        self._arrays = arrays
        self.path = path
        self._paths: dict[str, str] = {}
        self.attributes: dict[str, Any] = {}

    @property
    def name(self) -> str:
        return self.path.strip("/")

    def keys(self) -> list[str]:
        """Names of its arrays."""
        return list(self._paths)

    def __iter__(self) -> Iterator[str]:
        return iter(self._paths)

    def __contains__(self, name: str) -> bool:
        return name in self._paths or name in self.attributes

    def __getitem__(self, name: str) -> Any:
        if name in self._paths:
            return self._arrays[self._paths[name]]
        if name in self.attributes:
            return self.attributes[name]
        raise KeyError(f"{self.path} has no {name!r}; it has {', '.join([*self._paths, *self.attributes])}")

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        try:
            return self[name]
        except KeyError as error:
            raise AttributeError(error.args[0]) from None

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._paths, *self.attributes]

    def to_dataset(self) -> Any:
        """All of it as xarray.Dataset with units, without a copy. Needs xarray.

        Of dimensions without a name (dim_3) that are not as long as each other one is called after its array.
        """
        xarray = need("xarray")
        arrays = {name: self[name] for name in self._paths}
        along = {dim: c for a in arrays.values() for dim, c in a.coords.items()}
        coords = {dim: ((dim,), np.asarray(c), attributes_of(c)) for dim, c in along.items()}
        sizes = {dim: len(c) for dim, c in along.items()}

        def dims_of(name: str, a: Array) -> tuple[str, ...]:
            return tuple(d if sizes.setdefault(d, n) == n else f"{name}_{d}" for d, n in zip(a.dims, a.shape))

        data = {name: (dims_of(name, a), np.asarray(a), attributes_of(a)) for name, a in arrays.items()
                if not (a.dims == (name,) or (len(a.dims) == 1 and along.get(a.dims[0]) is a))}
        return xarray.Dataset(data, coords, attrs=dict(self.attributes))

    def to_dataframe(self, of: Optional[str] = None) -> Any:
        """A table of pandas of the array `of` and of all that have the same dimensions or some of them.

        Left out: of the first one that is no axis. Names of columns have their units. Needs pandas.
        """
        pandas = need("pandas")
        arrays = {name: self[name] for name in self._paths}
        along = [c for a in arrays.values() for c in a.coords.values()]
        is_axis = {name: any(a is c for c in along) for name, a in arrays.items()}
        first = of or next((name for name in arrays if not is_axis[name]), next(iter(arrays), None))
        if first is None:
            return pandas.DataFrame()
        if first not in arrays:
            raise KeyError(f"{self.path} has no {first!r}; it has {', '.join(arrays)}")
        dims, shape = arrays[first].dims, arrays[first].shape
        levels = [np.asarray(arrays[first].coords.get(d, np.arange(1, n + 1))) for d, n in zip(dims, shape)]
        index = pandas.MultiIndex.from_product(levels, names=dims) if len(dims) != 1 else pandas.Index(
            levels[0], name=dims[0])
        columns = {}
        for name, a in arrays.items():
            if name == first or (a.dims and set(a.dims) <= set(dims) and not is_axis[name]):
                place = [a.shape[a.dims.index(d)] if d in a.dims else 1 for d in dims]
                order = sorted(range(a.ndim), key=lambda i: dims.index(a.dims[i]))
                values = np.broadcast_to(np.transpose(np.asarray(a), order).reshape(place), shape)
                columns[title_of(a)] = values.reshape(-1)
        return pandas.DataFrame(columns, index=index)

    def __repr__(self) -> str:
        lines = [shown(f"<whirl.Group {self.path}>")]
        for name in self._paths:
            a = self[name]
            unit = f" [{a.unit}]" if a.unit else ""
            lines.append(shown(f"  {name}{unit} ({', '.join(a.dims)}): {a.meaning}"))
        lines += [shown(f"  {name} = {value!r}") for name, value in self.attributes.items()]
        return "\n".join(lines)


class Result(ResultMethods):
    """What a verb found, or what a result file holds.

    Its groups are attributes (`run.trajectory`), and so are arrays and numbers whose name only one group has
    (`run.x`) and what the command line says with --json (`run.revolutions`). `text` is what it prints.
    """

    verb: str
    text: str
    notes: list[str]
    """What the numbers leave out or go beyond."""
    failure: str
    """Why it ended early; empty: it did not."""
    is_whole: bool
    """Whether all was computed that was asked for: nothing failed, nobody stopped it."""
    _store: Any
    _found: Any
    _record: Optional[dict[str, Any]]
    _groups_known: Optional[dict[str, Group]]
    _root: dict[str, Any]
    _path: Optional[str]  # of a file with this result in it
    _is_opened: bool
    _drawn: Any

    def __init__(self) -> None:
        raise TypeError("results come from the methods of a model, and from whirl.open")

    @classmethod
    def _from(cls, store: Any, verb: str) -> Result:
        self = object.__new__(cls)
        self._store, self.verb = store, verb
        self.text, self.notes, self.failure, self.is_whole = "", [], "", True
        self._found = self._record = self._groups_known = self._path = self._drawn = None
        self._root, self._is_opened = {}, False
        return self

    @classmethod
    def _of(cls, found: Any, verb: str) -> Result:
        self = cls._from(found.store(), verb)
        self._found = found
        self.text, self.notes, self.failure = found.text, found.notes, found.failure
        self.is_whole = found.status == 0
        return self

    @property
    def groups(self) -> dict[str, Group]:
        """By their names, in the order of a result file."""
        if self._groups_known is None:
            groups: dict[str, Group] = {}
            arrays = _Arrays(self._store)

            def group_of(path: str) -> Group:
                return groups.setdefault(path.strip("/"), Group(arrays, path))

            paths = self._store.paths()
            for path in paths:
                folder, _, name = path.rpartition("/")
                if folder and folder != "/call":
                    group_of(folder)._paths[name] = path
            for owner, name, value in self._store.attributes():
                if owner == "/":
                    self._root[name] = value
                elif owner not in paths and owner != "/call":
                    group_of(owner).attributes[name] = value
            self._groups_known = groups
        return self._groups_known

    @property
    def attributes(self) -> dict[str, Any]:
        """What a result file says of itself: command, whirl_version, created, ..."""
        self.groups
        return self._root

    @property
    def model(self) -> str:
        """The model as it was, as the text of a file."""
        return self._store.values("/model")[0]

    def __getitem__(self, path: str) -> Any:
        """An array or number by its path in a result file, such as '/trajectory/x'; or a group."""
        name = path.strip("/")
        if name in self.groups:
            return self.groups[name]
        group, _, member = name.rpartition("/")
        if group in self.groups and member:
            return self.groups[group][member]
        raise KeyError(f"there is no {path!r}; there are {', '.join(self.groups)}")

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        if name in self.groups:
            return self.groups[name]
        having = [group for group in self.groups.values() if name in group]
        if len(having) == 1:
            return having[0][name]
        if len(having) > 1:
            own = [group for group in having if group.name == self.verb]
            if own:
                return own[0][name]
            raise AttributeError(f"{name} is in several groups: "
                                 + " or ".join(f"{group.name}.{name}" for group in having))
        record = self.to_dict()
        if name in record:
            return record[name]
        raise AttributeError(f"this result of {self.verb} has no {name!r}; its groups are "
                             f"{', '.join(self.groups)}, its numbers {', '.join(record)}")

    def __dir__(self) -> list[str]:
        names = [name for group in self.groups.values() for name in (group.name, *group.keys(), *group.attributes)]
        return sorted({*super().__dir__(), *names, *self.to_dict()})

    def to_dict(self) -> dict[str, Any]:
        """What --json of the command line says: numbers, texts, lists and dicts; None where nothing is known.

        Of an opened file its attributes, as a file does not hold that.
        """
        if self._record is None:
            self._record = ({**json.loads(self._found.json), "notes": list(self.notes)} if self._found
                            else dict(self.attributes))
        return self._record

    def _main(self, name: Optional[str]) -> Group:
        if name is not None:
            return self.groups[name.strip("/")]
        known = [g for g in self.groups.values() if g.keys() and g.name not in ("points", "from")]
        if not known:
            raise KeyError(f"this result of {self.verb} has no arrays")
        own = [g for g in known if g.name == self.verb]
        return own[0] if own else known[0]

    def to_dataset(self, group: Optional[str] = None) -> Any:
        """A group as xarray.Dataset with units; left out: that of the verb. Needs xarray."""
        return self._main(group).to_dataset()

    def to_datasets(self) -> dict[str, Any]:
        """All groups as xarray.Dataset, by their names."""
        return {name: group.to_dataset() for name, group in self.groups.items()}

    def to_dataframe(self, group: Optional[str] = None, of: Optional[str] = None) -> Any:
        """A table of pandas, see Group.to_dataframe; left out: of the group of the verb."""
        return self._main(group).to_dataframe(of)

    def to_mat(self, path: Union[str, os.PathLike]) -> None:
        """Writes a file of MATLAB (version 5, which Octave reads too): one struct per group. Needs scipy.

        Arrays and numbers keep their names, their dimensions and their order, so that x(station, time) is as
        here; a single dimension is a column, texts are a cell array. `units` has structs of the same names with
        the SI unit of each array. `verb` and `model`, the text of its file, are beside them. What is no name in
        MATLAB has _ for its other signs.
        """
        made: dict[str, Any] = {"verb": self.verb, "model": self.model, "units": {}}
        for name, group in self.groups.items():
            arrays = {_matlab_name(key): group[key] for key in group}
            values = {key: np.asarray(a, dtype=object) if a.dtype.kind == "U" else np.asarray(a)
                      for key, a in arrays.items()}
            numbers = {_matlab_name(key): value for key, value in group.attributes.items()}
            made[_matlab_name(name)] = {**values, **numbers}
            made["units"][_matlab_name(name)] = {key: a.unit for key, a in arrays.items()}
        need("scipy.io").savemat(path, made, appendmat=False, long_field_names=True, do_compression=True,
                                 oned_as="column")

    def to_csv(self, name: Union[str, os.PathLike], **options: Any) -> list[str]:
        """Writes its tables for spreadsheets, one file per group; their names.

        The files are those of `whirl export --format csv`, NAME_trajectory_time.csv of to_csv("NAME"), and
        options are those of `export`, such as revolutions=4 of a motion.
        """
        return self.export(format="csv", out=name, **options).files

    def _call(self, verb: Verb, args: tuple, options: dict[str, Any]) -> Result:
        wanted = options.pop("progress", None)
        given = given_values(verb, args, options)
        if verb.name == "identify":
            return self._identified(given, wanted)
        if "out" not in given:  # not beside a file that nobody knows of
            given["out"] = [pathlib.Path(self._path).stem if self._path and self._is_opened else self.verb]
        file = self._file()
        return run_verb(verb.name, wanted, lambda progress: _whirl.run_on_file(verb.name, file, given, progress))

    def _identified(self, given: dict[str, list[str]], wanted: Any) -> Result:
        """As if the call of this result had been one of identify; its motion is taken from here."""
        paths, call = self._store.paths(), {n: v for owner, n, v in self._store.attributes() if owner == "/call"}
        if "/trajectory/coordinates" not in paths:
            raise ModelError([Problem(self.verb, 0, 0, "", "holds no motion; simulate and identify record one")])
        before, sets = (self._store.values(p) if p in paths else [] for p in ("/call/option", "/call/set"))
        for option in before:
            name, _, value = option.removeprefix("--").partition("=")
            if name in _INTEGRATION:
                given.setdefault(name, [value])
        model = _whirl.ModelText(str(call.get("file", "model.toml")), self.model, [], stored=True)
        file = self._file()
        return run_verb("identify", wanted, lambda progress: _whirl.run(
            "identify", model, given, progress, file, sets))

    def save(self, path: Union[str, os.PathLike], force: bool = False) -> None:
        """Writes a result file, as --out of the command line does. With `force` over any file."""
        self._store.save(os.fspath(path), force)

    def _file(self) -> str:
        """A file with this result in it, which lives as long as it does."""
        if self._path is None:
            folder = tempfile.mkdtemp(prefix="whirl-")
            weakref.finalize(self, shutil.rmtree, folder, ignore_errors=True)
            path = os.path.join(folder, f"{self.verb}.h5")
            self.save(path)
            self._path = path
        return self._path

    def _pictures(self) -> Any:
        if self._drawn is None:
            self._drawn = _whirl.Drawn(self._file())
        return self._drawn

    def figures(self) -> dict[str, list[str]]:
        """Kinds of figures that it can be drawn as, and of which stations, contacts or planes each."""
        return {kind: variants for kind, _, variants, _ in self._pictures().kinds()}

    def _usual(self) -> Optional[str]:
        kinds = self._pictures().kinds()
        usual = ([kind for kind, _, _, verb in kinds if verb == self.verb]
                 or [kind for kind, *_ in kinds if kind != "layout"] or [kind for kind, *_ in kinds])
        return usual[0] if usual else None

    def svg(self, kind: Optional[str] = None, which: str = "") -> str:
        """A figure as `whirl plot` draws it. Left out: the first kind of this verb, the first station."""
        kind = kind or self._usual()
        if kind is None:
            raise ValueError(f"this result of {self.verb} holds nothing that can be drawn")
        return self._pictures().svg(kind, which)

    def plot(self, kind: Optional[str] = None, which: str = "", figure: Any = None) -> Any:
        """A figure as matplotlib axes, to be changed; an array of them where there are several."""
        from .pictures import draw

        kind = kind or self._usual()
        if kind is None:
            raise ValueError(f"this result of {self.verb} holds nothing that can be drawn")
        return draw(self._pictures().figure(kind, which), need("matplotlib.pyplot"), figure)

    def report(self) -> Page:
        """The page of `whirl report`: every figure, and what moves."""
        return report(self)

    def _repr_svg_(self) -> Optional[str]:
        return _for_a_page(self.svg()) if self._usual() else None

    def _repr_html_(self) -> str:
        picture = self._repr_svg_() or ""
        # lines of tables are kept whole, whatever the page says of <pre>, and long ones can be scrolled
        return (f'{picture}<pre style="white-space:pre;overflow:auto;max-height:60em">'
                f"{html.escape(self.text or repr(self))}</pre>")

    def __repr__(self) -> str:
        groups = ", ".join(name for name, group in self.groups.items() if group.keys())
        ended = "" if self.is_whole else f"; {self.failure or 'stopped'}"
        return shown(f"<whirl.Result of {self.verb}: {groups or 'no arrays'}{ended}>")


_INTEGRATION = {o.name for keyword, o in VERBS["simulate"].options.items()
                if keyword in VERBS["identify"].options} - {"out", "force", "threads"}


def run_verb(verb: str, wanted: Any, start: Callable[[Any], Any]) -> Result:
    """What a verb finds that `start` runs with a progress to tell; `wanted` is as methods have `progress`."""
    show = wanted if callable(wanted) else None
    bar = _progress.bar() if wanted is None or wanted is True else None
    try:
        found = start(bar or show)
    except BaseException as error:
        if hasattr(error, "found"):  # stopped: what was found until then
            error.result = Result._of(error.found, verb)  # type: ignore[attr-defined]
            del error.found
        raise
    finally:
        if bar:
            bar.close()
    if found.failure:
        warnings.warn(f"{verb}: {found.failure}", RuntimeWarning, stacklevel=5)
    return Result._of(found, verb)


def _for_a_page(svg: str) -> str:
    """A figure beside others, as wide as there is room: names within it are those of the whole page, where the
    first of a name counts."""
    of_its_own = f"whirl-{hashlib.sha256(svg.encode()).hexdigest()[:12]}-"
    svg = re.sub(r'(\bid="|url\(#)', lambda found: found[1] + of_its_own, svg)
    return svg[svg.index("<svg"):].replace("<svg", '<svg style="max-width:100%;height:auto"', 1)


def _matlab_name(name: str) -> str:
    made = re.sub(r"\W", "_", name, flags=re.ASCII)
    if made in ("break", "case", "continue", "end", "for", "global", "if", "otherwise", "return", "switch", "while"):
        return made + "_"
    return made if made[:1].isalpha() else f"a_{made}"


class Page:
    """A page of HTML, shown in a frame in a notebook."""

    def __init__(self, text: str) -> None:
        self.html = text

    def save(self, path: Union[str, os.PathLike]) -> None:
        with _open_file(path, "w", encoding="utf-8") as file:
            file.write(self.html)

    def _repr_html_(self) -> str:
        return (f'<iframe srcdoc="{html.escape(self.html)}" style="width:100%;height:700px;border:0">'
                "</iframe>")


def report(*results: Result) -> Page:
    """The page of `whirl report` of one result, or of several."""
    if not results or not all(isinstance(r, Result) for r in results):
        raise TypeError("expected one result or more")
    return Page(_whirl.report_html([r._file() for r in results]))


def open(path: Union[str, os.PathLike]) -> Result:  # noqa: A001
    """Opens a result file of any verb; its arrays are read when they are asked for.

    Raises FileError if it cannot be read or is no result of whirl.
    """
    path = os.fspath(path)
    store = _whirl.Store(path)
    verb = next((str(value) for owner, name, value in store.attributes() if (owner, name) == ("/call", "verb")), "?")
    self = Result._from(store, verb)
    self._path, self._is_opened = path, True
    self.notes = [n for n in str(self.attributes.get("notes", "")).split("\n") if n]
    return self
