"""Methods of models and results that stand in no list of their own: verbs of the program, and tables of model
files.

`tools/python-stubs` writes methods.pyi of it, for editors and type checkers.
"""

from __future__ import annotations

from typing import Any, Callable

from . import _whirl
from .verbs import RESULT_VERBS, VERBS, method_of, python_name

TABLES = dict(sorted(_whirl.model_tables(), key=lambda table: ("one", "several", "named").index(table[1])))
"""Tables of model files: whether there is one, or several; of materials one of each name."""


class Methods:
    """What Model has beside its own methods."""


class ResultMethods:
    """What Result has beside its own methods."""


def _table_method(table: str) -> Callable:
    def method(self: Any, /, **keys: Any) -> Any:
        return self.add(table, **keys)

    method.__name__ = table
    method.__qualname__ = f"Model.{table}"
    method.__doc__ = f"Adds [{table}] of the model file, with its keys (docs/model-file.md); the model itself."
    return method


def _call(self: Any, verb: Any, args: tuple, options: dict[str, Any]) -> Any:
    return self._call(verb, args, options)


for _table in TABLES:
    if _table not in VERBS:
        setattr(Methods, _table, _table_method(_table))
for _verb in VERBS.values():
    for _name in filter(None, (_verb.name, _verb.alias)):
        setattr(Methods, python_name(_name), method_of(_verb, _call))
for _verb in RESULT_VERBS.values():
    setattr(ResultMethods, python_name(_verb.name), method_of(_verb, _call, "Result"))
