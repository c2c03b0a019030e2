"""recoil: how well does a model of microsphere impact fit measured restitution, and how sure are
its parameters?

    import recoil
    result = recoil.fit("fits/dahneke1975-quartz.toml")
    result.parameters.C_H.value, result.parameters.C_H.intervals.bca
    result.plot_restitution()

The functions are those of the command; results have the names of its JSON files and the same
digits. ``recoil help python`` is the page of the manual.
"""

from __future__ import annotations

import json
import os
from importlib import resources
from typing import Any, Mapping, Optional, Sequence, Union

from . import _recoil
from ._datasets import Dataset
from ._errors import ComputationError, InputError
from ._facts import Facts, facts_of
from ._impacts import Impacts, Model
from ._results import Comparison, Diagnosis, FitResult, Parameter, Prediction

__version__: str = _recoil.__version__

__all__ = [
    "Comparison",
    "ComputationError",
    "Dataset",
    "Diagnosis",
    "Facts",
    "FitResult",
    "Impacts",
    "InputError",
    "Model",
    "Parameter",
    "Prediction",
    "compare",
    "coverage",
    "fit",
    "load_dataset",
    "model",
    "schema",
]

PathLike = Union[str, "os.PathLike[str]"]
Source = Union[PathLike, Dataset, Sequence[Union[PathLike, Dataset]]]
Table = Mapping[str, Any]


def _toml(value: Any) -> str:
    """``value`` as TOML on one line."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, Mapping):
        inner = ", ".join(f"{json.dumps(str(k))} = {_toml(v)}" for k, v in value.items())
        return "{ " + inner + " }"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(_toml, value)) + "]"
    if isinstance(value, (int, str)):
        return json.dumps(value, ensure_ascii=False)
    return repr(float(value))


def _inputs(source: Source, tables: Mapping[str, Optional[Table]], name: str) -> _recoil.Inputs:
    """A fit file as read, or one made of datasets and tables."""
    given = {key: table for key, table in tables.items() if table is not None}
    if isinstance(source, (str, os.PathLike)) and not os.path.isdir(source):
        if given:
            problem = f"{', '.join(given)} cannot be given together with a fit file"
            suggestion = "state it in the file, or give the dataset instead of the file"
            raise InputError(f"{problem}; {suggestion}", problem=problem, suggestion=suggestion)
        return _recoil.load_fit(os.fspath(source))
    listed = [source] if isinstance(source, (str, os.PathLike, Dataset)) else list(source)
    datasets = [one if isinstance(one, Dataset) else Dataset(one) for one in listed]
    text = f"dataset = {_toml([one._data.folder for one in datasets])}\n"
    for key, table in given.items():
        text += f"\n[{key}]\n"
        text += "".join(f"{json.dumps(str(k))} = {_toml(v)}\n" for k, v in table.items())
    return _recoil.parse_fit(text, name + ".toml", [one._data for one in datasets])


def _options(
    replicates: Union[int, str, None],
    scheme: str,
    seed: Optional[int],
    threads: int,
    solver: str,
) -> _recoil.Options:
    schemes = ("", "auto", "parametric", "residual", "wild", "case", "cluster")
    for what, word, known in (("scheme", scheme, schemes), ("solver", solver, ("fast", "reference"))):
        if word not in known:
            problem = f"{what} is {word!r}"
            suggestion = f"choose one of {', '.join(k for k in known if k)}"
            raise InputError(f"{problem}; {suggestion}", problem=problem, suggestion=suggestion)
    automatic = replicates == "auto"
    if replicates is not None and not automatic:
        if isinstance(replicates, str) or not 0 <= int(replicates) <= 1000000:
            problem = f"replicates is {replicates!r}"
            suggestion = "give a number from 0 to 1000000, or 'auto'"
            raise InputError(f"{problem}; {suggestion}", problem=problem, suggestion=suggestion)
    number = None if replicates is None or automatic else int(replicates)
    return _recoil.Options(number, automatic, scheme, seed, threads, solver)


def load_dataset(folder: PathLike) -> Dataset:
    """Reads and validates a dataset folder, as ``recoil check`` does.

    Raises ``InputError`` with file, line and column of the first mistake.
    """
    return Dataset(folder)


def fit(
    source: Source,
    *,
    parameters: Optional[Table] = None,
    model: Optional[Table] = None,  # noqa: A002
    noise: Optional[Table] = None,
    uncertainty: Optional[Table] = None,
    diagnosis: Optional[Table] = None,
    name: str = "fit",
    replicates: Union[int, str, None] = None,
    scheme: str = "",
    seed: Optional[int] = None,
    threads: int = 0,
    solver: str = "fast",
) -> FitResult:
    """Fits all points, with intervals and the two-point comparison: ``recoil fit``.

    ``source``: a fit file; or a dataset, a dataset's folder, or a list of them, with the tables of
    a fit file as dictionaries: ``parameters={"C_H": {"initial": 3e-3, "bounds": [0, 1]}}``,
    ``model={"adhesion": "jkr"}``, ``noise``, ``uncertainty``, ``diagnosis``, and its ``name``.
    ``recoil help fit-file`` lists their keys.
    ``replicates``: of the bootstrap, 0 none, ``"auto"`` as many as it takes; ``scheme``, ``seed``
    (both the fit file's), ``threads`` (0: all cores; no digit depends on it), ``solver``
    (``"fast"`` or ``"reference"``).

    The digits are those of the command with the same options. Other threads of Python run
    meanwhile.

    Raises ``InputError`` for a mistake in a file or an option, ``ComputationError`` when there is
    no usable answer.
    """
    tables = {
        "parameters": parameters,
        "model": model,
        "noise": noise,
        "uncertainty": uncertainty,
        "diagnosis": diagnosis,
    }
    inputs = _inputs(source, tables, name)
    return FitResult(_recoil.fit(inputs, _options(replicates, scheme, seed, threads, solver)))


def model(
    source: Source,
    *,
    fitted: Optional[PathLike] = None,
    parameters: Optional[Table] = None,
    model: Optional[Table] = None,  # noqa: A002
) -> Model:
    """The model of a fit without fitting it, to be simulated: ``recoil simulate``.

    ``source``, ``parameters``, ``model`` as of ``fit``. The values are the initial ones, or those
    of the fit.json ``fitted``.

    Raises ``InputError``, also when ``fitted`` is of another fit or another format.
    """
    inputs = _inputs(source, {"parameters": parameters, "model": model}, "fit")
    return Model(_recoil.model_of_fit(inputs, "" if fitted is None else os.fspath(fitted)))


def coverage(
    source: Source,
    datasets: int = 100,
    *,
    parameters: Optional[Table] = None,
    model: Optional[Table] = None,  # noqa: A002
    uncertainty: Optional[Table] = None,
    replicates: Union[int, str, None] = None,
    scheme: str = "",
    seed: Optional[int] = None,
    threads: int = 0,
) -> Facts:
    """How often the intervals contain a known truth, in ``datasets`` simulated data sets: the JSON
    of ``recoil coverage --json``."""
    tables = {"parameters": parameters, "model": model, "uncertainty": uncertainty}
    inputs = _inputs(source, tables, "fit")
    options = _options(replicates, scheme, seed, threads, "fast")
    return facts_of(_recoil.coverage(inputs, datasets, options))


def compare(*fits: Union[FitResult, PathLike]) -> Comparison:
    """Fits of the same data side by side, results or files: ``recoil compare``.

    Raises ``InputError`` when they are not of the same data, or a file is no fit.json.
    """
    named = []
    for number, one in enumerate(fits, 1):
        if isinstance(one, FitResult):
            named.append((f"fit {number}", one.json))
        else:
            try:
                with open(one, encoding="utf-8") as file:
                    named.append((os.fspath(one), file.read()))
            except OSError as error:
                message = f"{os.fspath(one)}: {error.strerror}"
                raise InputError(message, file=os.fspath(one), problem=str(error.strerror)) from error
    if len(named) < 2:
        problem = "a comparison needs two or more fits"
        raise InputError(problem, problem=problem)
    return Comparison(*_recoil.compare(named))


def schema(name: str) -> dict[str, Any]:
    """The JSON Schema of a result: ``fit``, ``diagnosis``, ``predict``, ``simulate``,
    ``coverage``, ``compare`` or ``pair``."""
    folder = resources.files(__name__) / "schemas"
    file = folder / f"{name}.schema.json"
    if not file.is_file():
        known = sorted(f.name.split(".")[0] for f in folder.iterdir())
        problem = f"there is no schema {name!r}"
        suggestion = f"there are {', '.join(known)}"
        raise InputError(f"{problem}; {suggestion}", problem=problem, suggestion=suggestion)
    found: dict[str, Any] = json.loads(file.read_text(encoding="utf-8"))
    return found
