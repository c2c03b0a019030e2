"""Keyword arguments as values that the compiled part takes."""

from __future__ import annotations

import math
import multiprocessing
import numbers
import os
import textwrap
from typing import TYPE_CHECKING, Any, Callable, Mapping, TypeVar

from . import _recoil
from ._errors import refuse

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

_DEEPEST = 16  # tables in tables
_Function = TypeVar("_Function", bound=Callable[..., Any])


def plain(name: str, value: Any, depth: int = 0) -> Any:
    """``value`` with numbers of NumPy as numbers of Python, and arrays as lists.

    Raises ``InputError`` for what is no number, text, list or dictionary.
    """
    if depth > _DEEPEST:
        refuse(f"{name} is nested too deeply", "give a table of numbers and texts")
    if isinstance(value, Mapping):
        return {str(key): plain(f"{name}.{key}", one, depth + 1) for key, one in value.items()}
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, (list, tuple)):
        return [plain(f"{name}[{i}]", one, depth + 1) for i, one in enumerate(value)]
    if isinstance(value, os.PathLike):
        value = os.fspath(value)
    if isinstance(value, str) and not any("\ud800" <= c <= "\udfff" or c == "\0" for c in value):
        return value
    if isinstance(value, bool) or (isinstance(value, int) and -(2**63) <= value < 2**63):
        return value
    if isinstance(value, numbers.Real) and not isinstance(value, int) and math.isfinite(value):
        return float(value)
    shown = "beyond 64 bits" if isinstance(value, int) else ascii(str(value)[:40])
    refuse(f"{name} is {shown}", "give a finite number or a text")


def path_of(name: str, value: Any) -> str:
    """``value``, a text or a path, as a text. A number is no path, not even of an open file.

    Raises ``InputError``.
    """
    if not isinstance(value, (str, os.PathLike)):
        refuse(f"{name} is {type(value).__name__}", "give the path of a file or folder")
    path = os.fsdecode(value)
    try:
        encoded = os.fsencode(path)
    except UnicodeEncodeError:
        encoded = b""
    if not encoded or b"\0" in encoded:
        refuse(f"{name} is {ascii(path)}, which names no file", "give the path of a file or folder")
    return path


def text_of(name: str, value: Any) -> str:
    """``value``, which has to be a text. Raises ``InputError``."""
    if not isinstance(value, str) or not isinstance(plain(name, value), str):
        refuse(f"{name} is {type(value).__name__}", "give a text")
    return value


def flag_of(name: str, value: Any) -> bool:
    """``value``, which has to be True or False. Raises ``InputError``."""
    if isinstance(value, bool) or type(value).__name__ in ("bool_", "bool"):
        return bool(value)
    refuse(f"{name} is {type(value).__name__}", "give True or False")


def shows(progress: Any) -> bool:
    """Is progress shown? Workers of multiprocessing, joblib and dask never show it.

    Raises ``InputError``.
    """
    return flag_of("progress", progress) and multiprocessing.current_process().name == "MainProcess"


def number_of(name: str, value: Any) -> float:
    """``value``, which has to be one number. Raises ``InputError``."""
    array = numbers_of(name, value)
    if array.size != 1:
        refuse(f"{name} has {array.size} entries", "give one number")
    return float(array.reshape(-1)[0])


def numbers_of(name: str, values: Any, *, boolean: bool = False) -> npt.NDArray[np.float64]:
    """``values`` as an array of numbers. ``boolean``: True and False are 1 and 0.

    Raises ``InputError`` for complex numbers, booleans, texts, objects and masked entries, which
    NumPy would turn into other numbers.
    """
    import numpy as np

    if hasattr(values, "to_numpy") and not isinstance(values.dtype, np.dtype):
        values = values.to_numpy(dtype=np.float64, na_value=np.nan)  # a nullable column of pandas
    try:
        array = np.asanyarray(values)
    except ValueError:  # lists of different lengths
        array = np.asarray(None)
    if isinstance(array, np.ma.MaskedArray) and np.any(array.mask):
        refuse(f"{name} has masked entries", "leave them out")
    if array.dtype.kind not in ("iufb" if boolean else "iuf"):
        what = {"c": "complex numbers", "b": "booleans"}.get(
            array.dtype.kind, "an entry that is no number")
        refuse(f"{name} has {what}", f"give real numbers as {name}")
    return np.asarray(array, dtype=np.float64)


def _texts(name: str, value: Any, several: bool) -> list[str]:
    """The words that state ``value`` on the command line."""
    value = plain(name, value)
    if isinstance(value, dict):
        return [f"{key}={one}" for key, one in value.items()]
    if isinstance(value, list) and not several:
        refuse(f"{name} is {value}", "give one value")
    words = value if isinstance(value, list) else [value]
    # 199.0 is a whole number
    return [str(int(one) if isinstance(one, float) and one.is_integer() else one) for one in words]


def given(function: str, arguments: Mapping[str, Any]) -> _recoil.Options:
    """The options among the ``arguments`` of a function.

    Raises ``InputError`` for a value that an option does not accept.
    """
    return _recoil.Options(function, {
        name: _texts(name, arguments[name], several)
        for name, _, several in _recoil.option_meanings(function) if arguments[name] is not None})


def takes_options(function: str) -> Callable[[_Function], _Function]:
    """Adds the meanings of the options of a function to its docstring."""

    def documented(decorated: _Function) -> _Function:
        lines = [f"``{name}``: {meaning}." for name, meaning, _ in _recoil.option_meanings(function)]
        text = "\n".join(textwrap.fill(line, 95, subsequent_indent="    ") for line in lines)
        own = textwrap.dedent("    " + (decorated.__doc__ or ""))
        decorated.__doc__ = f"{own.rstrip()}\n\nOptions, as those of the command:\n\n{text}\n"
        return decorated

    return documented
