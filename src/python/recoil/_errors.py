"""What recoil raises."""

from __future__ import annotations

from typing import NoReturn


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


def refuse(problem: str, suggestion: str) -> NoReturn:
    """Raises ``InputError`` for an argument."""
    raise InputError(f"{problem}; {suggestion}", problem=problem, suggestion=suggestion)


class ComputationError(RuntimeError):
    """A computation that ended without a usable answer; says which parameter or point stood in
    the way."""
