"""What can go wrong."""

from __future__ import annotations

from typing import NamedTuple

from .arrays import shown


class Problem(NamedTuple):
    """One thing that is wrong in a model or a call."""

    file: str
    """File, or the option and its value as the command line has them."""
    line: int
    """From 1; 0: no place within the file."""
    column: int
    key: str
    """Path of the entry, such as contact.seal.stiffness; may be empty."""
    message: str
    """What was found and what would be right."""

    def __str__(self) -> str:
        place = self.file
        if self.line:
            place += f":{self.line}:{self.column}"
        return shown(": ".join(part for part in (place, self.key, self.message) if part), keeps="\n\t")


class ModelError(ValueError):
    """A model or an option is wrong; `problems` says all that is, and what would be right."""

    def __init__(self, problems: list[Problem]) -> None:
        super().__init__("\n".join(str(problem) for problem in problems))
        self.problems = list(problems)

    def __reduce__(self):
        return (ModelError, (self.problems,))


class NumericalError(ArithmeticError):
    """The model is in order, but a computation on it failed; says what was tried."""


class FileError(OSError):
    """A file cannot be read or written; says which one and why."""
