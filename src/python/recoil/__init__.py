"""recoil fits a model of microsphere impact to measured restitution and states how uncertain the
parameters are and what the model gets wrong.

    import recoil
    result = recoil.fit(V, e, d=4.9, particle="polystyrene", surface="silicon")
    print(result)
    result.parameters.C_H.value, result.parameters.C_H.intervals.bca
    result.plot()

The functions correspond to the commands of ``recoil``. Results have the keys and the numbers of the
JSON files. The manual explains them in docs/python.md.
"""

from __future__ import annotations

import json
import os
import re
from importlib import resources
from typing import TYPE_CHECKING, Any, Mapping, Optional, Sequence, Union

from . import _recoil
from ._datasets import Dataset, Material, named
from ._errors import ComputationError, InputError, refuse
from ._facts import Facts, facts_of
from ._impacts import Impacts, Model
from ._options import given, path_of, plain, shows, takes_options, text_of
from ._results import Comparison, Diagnosis, FitResult, Pairing, Parameter, Prediction

if TYPE_CHECKING:
    import numpy.typing as npt
    import pandas

__version__: str = _recoil.__version__

__all__ = ["Comparison", "ComputationError", "Dataset", "Diagnosis", "Facts", "FitResult",
           "Impacts", "InputError", "Model", "Pairing", "Parameter", "Prediction",
           "compare", "coverage", "describe", "fit", "load_dataset", "model", "pair", "schema"]

PathLike = Union[str, "os.PathLike[str]"]
Quantity = Union[float, str]
"""A number in the stated unit, or a text with a unit of its own: ``"20mm"``."""
Source = Union[PathLike, Dataset, Sequence[Union[PathLike, Dataset]]]
Points = Union[Source, "pandas.DataFrame", "npt.ArrayLike"]
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
    """Reads a fit file, or makes a fit from datasets and tables."""
    if not _is_source(source):
        refuse(f"{type(source).__name__} is no fit file, dataset, folder or frame",
               "give V and e as arrays, or a frame of pandas")
    given = {key: plain(key, table) for key, table in tables.items() if table is not None}
    for key, table in given.items():
        if not isinstance(table, dict):
            refuse(f"{key} is {table}", "give a dictionary")
    name = text_of("name", name)
    if isinstance(source, (str, os.PathLike)) and not os.path.isdir(path_of("source", source)):
        if given:
            refuse(f"{', '.join(given)} cannot be given together with a fit file",
                   "state it in the file, or give the dataset instead of the file")
        return _recoil.load_fit(path_of("source", source))
    listed = [source] if isinstance(source, (str, os.PathLike, Dataset)) else list(source)
    datasets = [one if isinstance(one, Dataset) else Dataset(one) for one in listed]
    text = f"dataset = {_toml([one._data.folder for one in datasets])}\n"
    for key, table in given.items():
        text += f"\n[{key}]\n"
        text += "".join(f"{json.dumps(str(k))} = {_toml(v)}\n" for k, v in table.items())
    return _recoil.parse_fit(text, name + ".toml", [one._data for one in datasets])


def load_dataset(folder: PathLike) -> Dataset:
    """Reads and validates a dataset folder, as ``recoil check`` does.

    Raises ``InputError`` with file, line and column of the first mistake.
    """
    return Dataset(folder)


def _points(source: Any, e: Any, stated: Mapping[str, Any]) -> Source:
    """``source``, or a dataset made of a frame or arrays and the other arguments in ``stated``."""
    given: dict[str, Any] = {name: one for name, one in stated.items() if one is not None}
    if hasattr(source, "columns"):
        frame: Any = named(source)
        for name, column in (("e", e), *((n, given.get(n)) for n in _ARRAYS if n != "d")):
            if column is not None:
                refuse(f"{name} is given beside a frame", "make it a column of the frame")
        if "d" in given:
            if "diameter" in frame.columns:
                refuse("d is given, and the frame has a column diameter", "remove one")
            frame = frame.assign(diameter=given.pop("d"))
        given.setdefault("provenance", "measured")
        return Dataset.from_pandas(frame, **given)
    if e is not None:
        for name in ("d", "particle", "surface"):
            if name not in given:
                refuse(f"{name} is not known", f"give {name}=...")
        return Dataset.from_arrays(source, e, **given)
    if given:
        refuse(f"{', '.join(given)} cannot be given together with a file or a dataset",
               "they belong to arrays and frames")
    sources: Source = source
    return sources


_ARRAYS = ("d", "e_sd", "V_sd", "events", "captured", "series")


def _is_source(source: Any) -> bool:
    one = (str, os.PathLike, Dataset)
    if isinstance(source, one):
        return True
    return isinstance(source, (list, tuple)) and all(isinstance(s, one) for s in source) and source != []


@takes_options("fit")
def fit(
    source: Points,
    e: Optional[npt.ArrayLike] = None,
    *,
    d: Optional[npt.ArrayLike] = None,
    particle: Optional[Material] = None,
    surface: Optional[Material] = None,
    e_sd: Optional[npt.ArrayLike] = None,
    V_sd: Optional[npt.ArrayLike] = None,  # noqa: N803
    events: Optional[npt.ArrayLike] = None,
    captured: Optional[npt.ArrayLike] = None,
    series: Union[str, Sequence[str], None] = None,
    provenance: Optional[str] = None,
    units: Optional[Mapping[str, str]] = None,
    parameters: Optional[Table] = None,
    model: Optional[Table] = None,  # noqa: A002
    noise: Optional[Table] = None,
    uncertainty: Optional[Table] = None,
    diagnosis: Optional[Table] = None,
    name: str = "fit",
    progress: bool = True,
    # made by ./run docs: arguments of fit
    replicates: Optional[Union[int, str]] = None,
    scheme: Optional[str] = None,
    seed: Optional[int] = None,
    threads: int = 0,
    solver: str = "fast",
    # end
) -> FitResult:
    """Fits all points, with intervals and the two-point comparison, like ``recoil fit``.

    ``fit(V, e, d=4.9, particle="polystyrene", surface="silicon")`` fits arrays: incident velocity
    [m/s], restitution [1], diameter [um], with the other arguments of ``Dataset.from_arrays``.
    ``fit(frame, particle=..., surface=...)`` fits a frame of pandas with the columns of points.csv,
    or the short names V, e, d, V_sd and e_sd;
    ``d`` is then the diameter of all rows, and ``units`` is that of ``Dataset.from_pandas``.
    ``provenance`` is ``"measured"`` unless given.

    Otherwise ``source`` is a fit file, or a dataset, its folder or a list of these. With datasets,
    the tables of a fit file are dictionaries:
    ``parameters={"C_H": {"initial": 3e-3, "bounds": [0, 1]}}``, ``model={"adhesion": "jkr"}``,
    ``noise``, ``uncertainty``, ``diagnosis``; ``name`` is the name of the fit.
    docs/fit-file.md lists the keys.

    The numbers equal those of the command with the same options. Other Python threads can run
    during the fit. ``progress=False``: nothing is written to standard error; workers of
    multiprocessing are always silent.

    Raises ``InputError`` for a mistake in a file or an option, ``ComputationError`` if there is no
    usable result.
    """
    options = given("fit", locals())
    tables = {"parameters": parameters, "model": model, "noise": noise,
              "uncertainty": uncertainty, "diagnosis": diagnosis}
    stated = {"d": d, "particle": particle, "surface": surface, "e_sd": e_sd, "V_sd": V_sd,
              "events": events, "captured": captured, "series": series,
              "provenance": provenance, "units": units}
    return FitResult(_recoil.fit(_inputs(_points(source, e, stated), tables, name), options,
                                 shows(progress)))


@takes_options("model")
def model(
    source: Source,
    *,
    # made by ./run docs: arguments of model
    fitted: Optional[PathLike] = None,
    # end
    parameters: Optional[Table] = None,
    model: Optional[Table] = None,  # noqa: A002
) -> Model:
    """Returns the model of a fit for simulation, without fitting it, like ``recoil simulate``.

    ``source``, ``parameters`` and ``model`` are those of ``fit``. The values are the initial ones
    unless ``fitted`` is given.

    Raises ``InputError``, also if ``fitted`` belongs to another fit or has another format.
    """
    options = given("model", locals())
    inputs = _inputs(source, {"parameters": parameters, "model": model}, "fit")
    return Model(_recoil.model_of_fit(inputs, options))


@takes_options("coverage")
def coverage(
    source: Source,
    # made by ./run docs: arguments of coverage
    datasets: int = 100,
    posterior: bool = False,
    replicates: Optional[Union[int, str]] = None,
    seed: Optional[int] = None,
    threads: int = 0,
    # end
    *,
    parameters: Optional[Table] = None,
    model: Optional[Table] = None,  # noqa: A002
    uncertainty: Optional[Table] = None,
    progress: bool = True,
) -> Facts:
    """Measures how often the intervals contain the known truth in simulated data sets.

    Returns the JSON of ``recoil coverage --json``. Raises ``InputError`` and ``ComputationError``
    as ``fit`` does."""
    options = given("coverage", locals())
    tables = {"parameters": parameters, "model": model, "uncertainty": uncertainty}
    return facts_of(
        _recoil.coverage(_inputs(source, tables, "fit"), options, shows(progress)))


def compare(*fits: Union[FitResult, PathLike]) -> Comparison:
    """Compares fits of the same data (results or fit.json files), like ``recoil compare``.

    Raises ``InputError`` if the data differ, or if a file is not a fit.json.
    """
    named = []
    for number, one in enumerate(fits, 1):
        if isinstance(one, FitResult):
            named.append((f"fit {number}", one.json))
        else:
            file = path_of(f"fit {number}", one)
            named.append((file, _recoil.read_text_file(file)))
    if len(named) < 2:
        refuse(f"a comparison needs two or more fits, not {len(named)}", "give another one")
    return Comparison(*_recoil.compare(named))


@takes_options("pair")
def pair(
    passages: PathLike,
    *,
    # made by ./run docs: arguments of pair
    units: Optional[Mapping[str, str]] = None,
    columns: Optional[Mapping[str, str]] = None,
    decimal_comma: bool = False,
    positive: str = "towards",
    height: Quantity = 1,
    height_range: Quantity = 1.5,
    diameter_tolerance: Quantity = 0.2,
    velocity_tolerance: Quantity = 0.15,
    keep_later: bool = False,
    threshold: Optional[Quantity] = None,
    angle: Optional[Quantity] = None,
    lost_share: Optional[Quantity] = None,
    per_bin: int = 40,
    size_classes: int = 1,
    size_edges: Optional[Sequence[Quantity]] = None,
    mean_diameter: bool = False,
    # end
) -> Pairing:
    """Finds impacts in the passages of a phase Doppler instrument and averages them into points.

    ``passages``: a CSV file with one row per passage and the columns ``time``, ``velocity``,
    ``diameter`` and optionally ``tangential_velocity`` and ``series``.
    ``units={"time": "s", "velocity": "m/s"}``: needed if neither the header nor a datapackage.json
    next to the file states them. ``columns={"velocity": "LDA1"}``: other column names.

    Raises ``InputError`` for a mistake in the file or an option, ``ComputationError`` if no impact
    is found.
    """
    return Pairing(_recoil.pair(path_of("passages", passages), given("pair", locals())))


def schema(name: str) -> dict[str, Any]:
    """The JSON Schema of a result: ``fit``, ``diagnosis``, ``predict``, ``simulate``,
    ``coverage``, ``compare``, ``pair`` or ``plan``. Raises ``InputError`` for another name."""
    folder = resources.files(__name__) / "schemas"
    known = sorted(f.name.split(".")[0] for f in folder.iterdir())
    if text_of("name", name) not in known:
        refuse(f"there is no schema {name!r}", f"choose one of {', '.join(known)}")
    found: dict[str, Any] = json.loads((folder / f"{name}.schema.json").read_text(encoding="utf-8"))
    return found


def describe(key: str, result: str = "fit") -> str:
    """The meaning and the unit of a key of a result: ``describe("goodness.rmse")``,
    ``describe("parameters.C_H.value")``, ``describe("candidates[0].p_value", "diagnosis")``.

    ``result``: as for ``schema``. Raises ``InputError`` if the result has no such key."""
    key, node = text_of("key", key), schema(result)
    for name in re.sub(r"\[\d*\]", "", key).split("."):
        while "items" in node:
            node = node["items"]
        inside = node.get("properties", {})
        found = inside.get(name, node.get("additionalProperties"))
        if not found:
            refuse(f"the JSON of {result} has no key {key!r}",
                   f"choose one of {', '.join(inside)}" if inside else "it ends before")
        node = {"description": node.get("description", ""), **found}
    return str(node["description"])


def __dir__() -> list[str]:
    return [*__all__, "__version__"]
