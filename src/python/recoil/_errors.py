"""What recoil raises, and what checks arguments."""

from __future__ import annotations

from pathlib import Path
from typing import Any, NoReturn


class InputError(ValueError):
    """Something that you can put right: a file, a key, a value.

    ``str(error)`` is the line that the command prints, ``file:line:column: problem (why);
    suggestion``. The parts have attributes of their own.
    """

    file: str
    """The file; empty where the mistake is in none."""
    line: int
    """From 1; 0 where no line is to blame."""
    column: int
    """From 1; 0 where no column is to blame."""
    problem: str
    """What is there."""
    why: str
    """Why that is a problem; may be empty."""
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
    """A computation that ended without a usable answer; says which parameter or point stood in
    the way."""


def refuse(problem: str, suggestion: str) -> NoReturn:
    """Raises ``InputError`` for an argument."""
    raise InputError(f"{problem}; {suggestion}", problem=problem, suggestion=suggestion)


def refuse_to_replace(*files: Path) -> None:
    """Refuses files that are there: data may be all that is left of an experiment."""
    for file in files:
        if file.exists():
            refuse(f"{file} is there", "name another place, or pass replace=True")


def within(name: str, value: Any, least: float, most: float, *, whole: bool = False) -> None:
    """Refuses what is no number from ``least`` to ``most``, or no whole one; None is none given."""
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
    """Refuses a word that is not known; the empty one stands for none given."""
    if word not in ("", *known):
        refuse(f"{name} is {word!r}", f"choose one of {', '.join(known)}")
