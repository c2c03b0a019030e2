"""Exceptions of recoil, and checks of arguments."""

from __future__ import annotations

from pathlib import Path
from typing import Any, NoReturn


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

    def __init__(
        self,
        message: str,
        file: str = "",
        line: int = 0,
        column: int = 0,
        problem: str = "",
        why: str = "",
        suggestion: str = "",
    ) -> None:
        super().__init__(message)
        self.file = file
        self.line = line
        self.column = column
        self.problem = problem or message
        self.why = why
        self.suggestion = suggestion

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


def within(name: str, value: Any, least: float, most: float, *, whole: bool = False) -> None:
    """Raises ``InputError`` unless ``value`` is None or a (whole) number from ``least`` to
    ``most``."""
    if value is None:
        return
    try:
        good = bool(least <= value <= most) and (not whole or value == int(value))
    except (TypeError, ValueError, OverflowError):
        good = False
    if not good:
        kind = "a whole number" if whole else "a number"
        refuse(f"{name} is {value!r}", f"give {kind} from {least} to {most}")


def one_of(name: str, word: Any, known: tuple[str, ...]) -> None:
    """Raises ``InputError`` unless ``word`` is one of ``known`` or empty (not given)."""
    if word not in ("", *known):
        refuse(f"{name} is {word!r}", f"choose one of {', '.join(known)}")
