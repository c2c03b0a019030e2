"""Exceptions of recoil, and checks of arguments."""

from __future__ import annotations

from pathlib import Path
from typing import NoReturn


class InputError(ValueError):
    """An error that you can correct: in a file, a key or a value.

    ``str(error)`` is the line that the command prints, ``file:line:column: problem (why);
    suggestion``. The parts have attributes of their own.
    """

    file: str
    """The file; empty if the error is not in a file."""
    line: int
    """The line, from 1; 0 if the error has no line."""
    column: int
    """The column, from 1; 0 if the error has no column."""
    problem: str
    """The problem."""
    why: str
    """Why this is a problem; may be empty."""
    suggestion: str
    """What to do; may be empty."""

    def __init__(self, message: str, file: str = "", line: int = 0, column: int = 0,
                 problem: str = "", why: str = "", suggestion: str = "") -> None:
        super().__init__(message)
        self.file, self.line, self.column = file, line, column
        self.problem, self.why, self.suggestion = problem or message, why, suggestion

    def __reduce__(self) -> tuple[type, tuple[object, ...]]:
        parts = (self.file, self.line, self.column, self.problem, self.why, self.suggestion)
        return (type(self), (str(self), *parts))


class ComputationError(RuntimeError):
    """A computation ended without a usable result; the message names the parameter or point."""


def refuse(problem: str, suggestion: str) -> NoReturn:
    """Raises ``InputError`` for an argument."""
    raise InputError(f"{problem}; {suggestion}", problem=problem, suggestion=suggestion)


def refuse_to_replace(*files: Path) -> None:
    """Raises ``InputError`` if one of the files exists."""
    for file in files:
        if file.exists():
            refuse(f"{file} is there", "name another place, or pass replace=True")
