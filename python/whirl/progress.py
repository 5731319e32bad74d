"""How far something long is, on a terminal or in a notebook."""

from __future__ import annotations

import sys
import time
from typing import Any, Callable, Optional

Progress = Callable[[str, int, int], None]
"""Called with what goes on, how much of it is done, and how much there is."""


def _is_notebook() -> bool:
    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython else None
    return shell is not None and hasattr(shell, "kernel")


class Bar:
    """A line that is rewritten, and gone at the end. What takes less than a second shows none."""

    def __init__(self) -> None:
        self._begin = time.monotonic()
        self._shown: Any = None
        self._is_notebook = _is_notebook()

    def __call__(self, what: str, done: int, total: int) -> None:
        elapsed = time.monotonic() - self._begin
        if elapsed < 1.0:
            return
        share = done / total if total else 0.0
        left = f", {elapsed / share - elapsed:.0f} s left" if 0.0 < share < 1.0 else ""
        text = f"{what}: {done} of {total}{left}"
        if self._is_notebook:
            from IPython.display import HTML, display

            bar = HTML(f'<progress value="{done}" max="{total}"></progress> {text}')
            if self._shown is None:
                self._shown = display(bar, display_id=True)
            else:
                self._shown.update(bar)
        else:
            self._shown = True
            sys.stderr.write(f"\r{text:<72}")
            sys.stderr.flush()

    def close(self) -> None:
        if self._shown is None:
            return
        if self._is_notebook:
            from IPython.display import HTML

            self._shown.update(HTML(""))
        else:
            sys.stderr.write("\r" + " " * 72 + "\r")
            sys.stderr.flush()


def bar() -> Optional[Bar]:
    """One where somebody looks: in a notebook, or on a terminal."""
    return Bar() if _is_notebook() or (sys.stderr is not None and sys.stderr.isatty()) else None
