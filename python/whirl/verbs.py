"""Verbs of the command line as methods: their options are keyword arguments of the same names."""

from __future__ import annotations

import difflib
import inspect
import keyword
import os
import textwrap
from typing import Any, Callable, Mapping, NamedTuple, Optional

import numpy as np

from . import _whirl
from .errors import FileError, ModelError, NumericalError


class Option(NamedTuple):
    name: str
    placeholder: str
    meaning: str
    default: str
    is_list: bool

    @property
    def keyword(self) -> str:
        return python_name(self.name)

    @property
    def is_flag(self) -> bool:
        return not self.placeholder


class Verb(NamedTuple):
    name: str
    alias: str
    group: str
    summary: str
    example: str
    takes_results: bool
    """Beside models."""
    options: dict[str, Option]
    """By their keywords."""
    takes_speeds: bool
    takes_over: bool

    @property
    def options_in_order(self) -> list[tuple[Option, bool]]:
        """Its options, the one first that may stand without its name; whether each is that one."""
        first = "speeds" if self.takes_speeds else "over" if self.takes_over else ""
        return sorted(((o, o.name == first) for o in self.options.values()), key=lambda pair: not pair[1])


# what these say is said by Python itself
_LEFT_OUT = {"set", "speed", "json", "quiet"}


def python_name(name: str) -> str:
    """The name of a verb or option in Python: from_ of --from, start_size of --start-size."""
    name = name.replace("-", "_")
    return name + "_" if keyword.iskeyword(name) else name


def _verb(row: tuple) -> Verb:
    name, alias, group, summary, example, takes_results, rows = row
    options = [Option(*option) for option in rows]
    names = {option.name for option in options}
    return Verb(
        name, alias, group, summary, example, takes_results,
        {o.keyword: o for o in options if o.name not in _LEFT_OUT},
        "speeds" in names,
        "over" in names,
    )


VERBS = {verb.name: verb for verb in map(_verb, _whirl.verb_table())}
"""Verbs that take a model."""


def _of_a_motion() -> Verb:
    """identify, where the motion is there: without the options of its integration, and of records."""
    kept = ("modes", "rotations", "mass_weighted", "stiffened", "orders", "slow_roll", "order_revolutions", "order_step",
            "trend", "zones", "alarm", "trip", "out", "force")
    verb = VERBS["identify"]
    return verb._replace(options={k: o for k, o in verb.options.items() if k in kept})


RESULT_VERBS = {"identify": _of_a_motion(), **{v.name: v for v in VERBS.values() if v.takes_results}}
"""Verbs that take a result."""


def text_of(value: Any) -> Optional[str]:
    """A value as the command line would have it; None: it cannot be said there."""
    if isinstance(value, str):
        return value
    if isinstance(value, (bool, np.bool_)):
        return None
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    if isinstance(value, (float, np.floating)):
        return repr(float(value))
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if isinstance(value, (list, tuple, range)) or (isinstance(value, np.ndarray) and value.ndim == 1):
        texts = [text for text in map(text_of, value) if text is not None]
        return ",".join(texts) if len(texts) == len(value) > 0 else None
    if hasattr(value, "_file"):  # a result that was found before
        return value._file()
    return None


def _wrong(verb: Verb, option: Option, value: Any, expected: str) -> TypeError:
    return TypeError(
        f"{python_name(verb.name)}() {option.keyword}: expected {expected}, found {type(value).__name__}"
        f" ({option.meaning})"
    )


def _texts_of(verb: Verb, option: Option, value: Any) -> Optional[list[str]]:
    if option.is_flag:
        if not isinstance(value, (bool, np.bool_)):
            raise _wrong(verb, option, value, "True or False")
        return [""] if value else None
    if not option.is_list:
        text = text_of(value)
        if text is None:
            raise _wrong(verb, option, value, f"a number or a text such as {option.placeholder}")
        return [text]
    if isinstance(value, Mapping):
        texts = [(path, text_of(v)) for path, v in value.items()]
        if all(isinstance(path, str) and text is not None for path, text in texts):
            return [f"{path}={text}" for path, text in texts]
    elif isinstance(value, str):
        return [value]
    elif isinstance(value, (list, tuple)) and all(isinstance(v, str) for v in value):
        return list(value)
    raise _wrong(verb, option, value, f"a dict of paths and values, or texts such as {option.placeholder}")


def given_values(verb: Verb, args: tuple, options: Mapping[str, Any]) -> dict[str, list[str]]:
    """Texts of options by their names on the command line."""
    given: dict[str, list[str]] = {}
    if args:
        options = dict(options)
        options.update(_positional(verb, args, options))
    for name, value in options.items():
        option = verb.options.get(name)
        if option is None:
            raise _unknown(verb, name)
        if value is None:
            continue
        texts = _texts_of(verb, option, value)
        if texts is not None:
            given[option.name] = texts
    return given


def _positional(verb: Verb, args: tuple, options: Mapping[str, Any]) -> dict[str, Any]:
    name = python_name(verb.name)
    is_over = isinstance(args[0], Mapping) or not verb.takes_speeds
    key = "over" if is_over else "speeds"
    if len(args) > 1 or not (verb.takes_over if is_over else verb.takes_speeds):
        takes = [w for w, is_so in (("speeds", verb.takes_speeds), ("over", verb.takes_over)) if is_so]
        what = f"one argument without a name at most ({' or '.join(takes)})" if takes else "named arguments only"
        raise TypeError(f"{name}() takes {what}, such as {_example(verb)}")
    if key in options:
        raise TypeError(f"{name}() got {key} twice")
    return {key: args[0]}


def _example(verb: Verb) -> str:
    first = next(iter(verb.options.values()))
    return f"{python_name(verb.name)}({first.keyword}=...)"


def _unknown(verb: Verb, name: str) -> TypeError:
    known = [*verb.options, *(("speed", "set") if verb is VERBS[verb.name] else ()), "progress"]
    near = difflib.get_close_matches(name, known, 1)
    hint = f"did you mean {near[0]}?" if near else f"there are {', '.join(known)}"
    return TypeError(f"{python_name(verb.name)}() has no option {name}; {hint}")


def _signature(verb: Verb, is_of_model: bool) -> inspect.Signature:
    P = inspect.Parameter
    parameters = [P("self", P.POSITIONAL_ONLY)]
    for option, is_first in verb.options_in_order:
        kind = P.POSITIONAL_OR_KEYWORD if is_first else P.KEYWORD_ONLY
        parameters.append(P(option.keyword, kind, default=False if option.is_flag else None))
    for name in (*(("speed", "set") if is_of_model else ()), "progress"):
        parameters.append(P(name, P.KEYWORD_ONLY, default=None))
    return inspect.Signature(parameters)


def _doc(verb: Verb, is_of_model: bool) -> str:
    lines = [f"{verb.summary[0].upper()}{verb.summary[1:]}.", "", f"The command line: {verb.example}", "",
             "Parameters", "----------"]

    def add(name: str, what: str, meaning: str) -> None:
        lines.append(f"{name} : {what}")
        lines.extend(textwrap.wrap(meaning, 76, initial_indent="    ", subsequent_indent="    "))

    for option in verb.options.values():
        meaning = option.meaning + (f" ({option.default})" if option.default else "")
        add(option.keyword, "bool" if option.is_flag else option.placeholder, meaning)
    if is_of_model:
        add("speed", "S", "operating speed, a text with its unit such as '3650 rpm', or a number in rad/s")
        add("set", "dict", "values of the model by their paths, for this call only")
    add("progress", "bool or callable", "whether a bar is shown, or what is called with "
        "(what, done, total); left out: in notebooks and on terminals")
    lines += ["", "Numbers are in SI (speeds in rad/s); texts say their unit, as on the command line.", "",
              "Returns", "-------", "Result", "", "Raises", "------",
              "ModelError", "    for a wrong value; its `problems` say what would be right",
              "NumericalError", "    if the computation fails",
              "TypeError", "    for an option that does not exist or a value of another type"]
    return "\n".join(lines)


def method_of(verb: Verb, call: Callable, of: str = "Model") -> Callable:
    """The method of a verb, of a class Model or Result."""

    def method(self, /, *args, **options):
        try:
            return call(self, verb, args, options)
        except (ModelError, NumericalError, FileError) as error:
            raise error.with_traceback(None)  # what is wrong is not in here

    method.__name__ = python_name(verb.name)
    method.__qualname__ = f"{of}.{method.__name__}"
    method.__doc__ = _doc(verb, of == "Model")
    method.__signature__ = _signature(verb, of == "Model")  # type: ignore[attr-defined]
    return method
