"""recoil fits a model of microsphere impact to measured restitution and states how uncertain the
parameters are and what the model gets wrong.

    import recoil
    result = recoil.fit(V, e, d=4.9, particle="polystyrene", surface="silicon")
    print(result)
    result.parameters.C_H.value, result.parameters.C_H.intervals.bca
    result.plot()

The functions correspond to the commands of ``recoil``. Results have the keys and the numbers of the
JSON files. ``recoil help python`` prints the page of the manual.
"""

from __future__ import annotations

import json
import os
import re
from importlib import resources
from typing import TYPE_CHECKING, Any, Mapping, Optional, Sequence, Union

from . import _recoil
from ._datasets import Dataset, Material
from ._errors import ComputationError, InputError, one_of, refuse, within
from ._facts import Facts, facts_of
from ._impacts import Impacts, Model
from ._results import Comparison, Diagnosis, FitResult, Pairing, Parameter, Prediction

if TYPE_CHECKING:
    import numpy.typing as npt
    import pandas

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
    "Pairing",
    "Parameter",
    "Prediction",
    "compare",
    "coverage",
    "describe",
    "fit",
    "load_dataset",
    "model",
    "pair",
    "schema",
]

PathLike = Union[str, "os.PathLike[str]"]
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
    given = {key: table for key, table in tables.items() if table is not None}
    if isinstance(source, (str, os.PathLike)) and not os.path.isdir(source):
        if given:
            refuse(
                f"{', '.join(given)} cannot be given together with a fit file",
                "state it in the file, or give the dataset instead of the file",
            )
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
    one_of("scheme", scheme, ("auto", "parametric", "residual", "wild", "case", "cluster"))
    one_of("solver", solver, ("fast", "reference"))
    if replicates != "auto":
        within("replicates", replicates, 0, 1000000, whole=True)
        replicates = None if replicates is None else int(replicates)
    number = "" if replicates is None else str(replicates)
    within("seed", seed, 0, 2**63 - 1, whole=True)
    within("threads", threads, 0, 4096, whole=True)
    seed = None if seed is None else int(seed)
    return _recoil.Options(number, scheme, seed, int(threads), solver)


def load_dataset(folder: PathLike) -> Dataset:
    """Reads and validates a dataset folder, as ``recoil check`` does.

    Raises ``InputError`` with file, line and column of the first mistake.
    """
    return Dataset(folder)


def _points(source: Any, e: Any, stated: Mapping[str, Any]) -> Source:
    """``source``, or a dataset made of a frame or arrays and the other arguments in ``stated``."""
    given: dict[str, Any] = {name: one for name, one in stated.items() if one is not None}
    if hasattr(source, "to_csv"):
        frame: Any = source
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
    if not _is_source(source):
        refuse(f"{type(source).__name__} is no fit file, dataset, folder or frame",
               "give V and e as arrays, or a frame of pandas")
    sources: Source = source
    return sources


_ARRAYS = ("d", "e_sd", "V_sd", "events", "captured", "series")


def _is_source(source: Any) -> bool:
    one = (str, os.PathLike, Dataset)
    if isinstance(source, one):
        return True
    return isinstance(source, (list, tuple)) and all(isinstance(s, one) for s in source) and source != []


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
    replicates: Union[int, str, None] = None,
    scheme: str = "",
    seed: Optional[int] = None,
    threads: int = 0,
    solver: str = "fast",
) -> FitResult:
    """Fits all points, with intervals and the two-point comparison, like ``recoil fit``.

    ``fit(V, e, d=4.9, particle="polystyrene", surface="silicon")`` fits arrays: incident velocity
    [m/s], restitution [1], diameter [um], with the other arguments of ``Dataset.from_arrays``.
    ``fit(frame, particle=..., surface=...)`` fits a frame of pandas with the columns of points.csv;
    ``d`` is then the diameter of all rows, and ``units`` is that of ``Dataset.from_pandas``.
    ``provenance`` is ``"measured"`` unless given.

    Otherwise ``source`` is a fit file, or a dataset, its folder or a list of these. With datasets,
    the tables of a fit file are dictionaries:
    ``parameters={"C_H": {"initial": 3e-3, "bounds": [0, 1]}}``, ``model={"adhesion": "jkr"}``,
    ``noise``, ``uncertainty``, ``diagnosis``; ``name`` is the name of the fit.
    ``recoil help fit-file`` lists the keys.

    ``replicates``: number of bootstrap replicates; 0: none; ``"auto"``: until the intervals are
    precise enough. ``scheme`` and ``seed`` replace those of the fit file. ``threads``: 0: all
    cores; the numbers do not depend on it. ``solver``: ``"fast"`` or ``"reference"``.

    The numbers equal those of the command with the same options. Other Python threads can run
    during the fit.

    Raises ``InputError`` for a mistake in a file or an option, ``ComputationError`` if there is no
    usable result.
    """
    tables = {
        "parameters": parameters,
        "model": model,
        "noise": noise,
        "uncertainty": uncertainty,
        "diagnosis": diagnosis,
    }
    given = {"d": d, "particle": particle, "surface": surface, "e_sd": e_sd, "V_sd": V_sd,
             "events": events, "captured": captured, "series": series,
             "provenance": provenance, "units": units}
    inputs = _inputs(_points(source, e, given), tables, name)
    return FitResult(_recoil.fit(inputs, _options(replicates, scheme, seed, threads, solver)))


def model(
    source: Source,
    *,
    fitted: Optional[PathLike] = None,
    parameters: Optional[Table] = None,
    model: Optional[Table] = None,  # noqa: A002
) -> Model:
    """Returns the model of a fit for simulation, without fitting it, like ``recoil simulate``.

    ``source``, ``parameters`` and ``model`` are those of ``fit``. The values are the initial ones,
    or those of the fit.json ``fitted``.

    Raises ``InputError``, also if ``fitted`` belongs to another fit or has another format.
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
    """Measures how often the intervals contain the known truth in ``datasets`` simulated data sets.

    Returns the JSON of ``recoil coverage --json``. Raises ``InputError`` and ``ComputationError``
    as ``fit`` does."""
    tables = {"parameters": parameters, "model": model, "uncertainty": uncertainty}
    within("datasets", datasets, 1, 1000000, whole=True)
    inputs = _inputs(source, tables, "fit")
    options = _options(replicates, scheme, seed, threads, "fast")
    return facts_of(_recoil.coverage(inputs, int(datasets), options))


def compare(*fits: Union[FitResult, PathLike]) -> Comparison:
    """Compares fits of the same data (results or fit.json files), like ``recoil compare``.

    Raises ``InputError`` if the data differ, or if a file is not a fit.json.
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
        refuse(f"a comparison needs two or more fits, not {len(named)}", "give another one")
    return Comparison(*_recoil.compare(named))


def pair(
    passages: PathLike,
    *,
    units: Optional[Mapping[str, str]] = None,
    columns: Optional[Mapping[str, str]] = None,
    positive: str = "towards",
    height: float = 1.0,
    height_range: float = 1.5,
    keep_height: bool = False,
    diameter_tolerance: float = 0.2,
    velocity_tolerance: float = 0.15,
    keep_later: bool = False,
    threshold: Optional[float] = None,
    angle: Optional[float] = None,
    lost_share: Optional[float] = None,
    per_bin: int = 40,
    size_classes: int = 1,
    size_edges: Sequence[float] = (),
    mean_diameter: bool = False,
) -> Pairing:
    """Finds impacts in the passages of a phase Doppler instrument and averages them into points.

    The options, units and defaults are those of ``recoil pair``; ``recoil help pair`` explains
    them. ``passages``: a CSV file with one row per passage and the columns ``time``, ``velocity``,
    ``diameter`` and optionally ``tangential_velocity`` and ``series``.
    ``units={"time": "s", "velocity": "m/s"}``: needed if no datapackage.json next to the file
    states them. ``columns={"velocity": "LDA1"}``: other column names. ``positive``: ``"towards"``
    the surface or ``"away"`` from it. ``height``: of the measuring plane [mm]. ``threshold`` [m/s];
    ``angle`` [degrees]; ``size_edges`` [um].

    Raises ``InputError`` for a mistake in the file or an option, ``ComputationError`` if no impact
    is found.
    """
    one_of("positive", positive, ("towards", "away"))
    within("height", height, 1e-3, 1e3)
    within("height_range", height_range, 1.01, 10)
    within("diameter_tolerance", diameter_tolerance, 1e-3, 2)
    within("velocity_tolerance", velocity_tolerance, 1e-3, 0.5)
    within("threshold", threshold, 0, 1e4)
    within("angle", angle, 0, 90)
    within("lost_share", lost_share, 0, 0.9)
    within("per_bin", per_bin, 2, 1000000, whole=True)
    within("size_classes", size_classes, 1, 100, whole=True)
    edges = [float(edge) for edge in size_edges]
    if len(edges) == 1 or any(not low < high for low, high in zip([0.0, *edges], edges)):
        refuse(f"size_edges is {edges!r}", "give two limits or more that ascend: [20, 40, 60]")
    if edges and size_classes != 1:
        refuse("size_edges and size_classes are both given", "remove one")
    arguments = {
        "units": dict(units or {}), "columns": dict(columns or {}),
        "positive_away": positive == "away", "height": float(height),
        "height_range": float(height_range), "keep_height": bool(keep_height),
        "diameter_tolerance": float(diameter_tolerance),
        "velocity_tolerance": float(velocity_tolerance), "keep_later": bool(keep_later),
        "threshold": threshold, "angle": angle, "lost_share": lost_share,
        "per_bin": int(per_bin), "size_classes": int(size_classes), "size_edges": edges,
        "mean_diameter": bool(mean_diameter),
    }
    return Pairing(_recoil.pair(os.fspath(passages), json.dumps(arguments, default=float)))


def schema(name: str) -> dict[str, Any]:
    """The JSON Schema of a result: ``fit``, ``diagnosis``, ``predict``, ``simulate``,
    ``coverage``, ``compare``, ``pair`` or ``plan``. Raises ``InputError`` for another name."""
    folder = resources.files(__name__) / "schemas"
    file = folder / f"{name}.schema.json"
    if not file.is_file():
        known = sorted(f.name.split(".")[0] for f in folder.iterdir())
        refuse(f"there is no schema {name!r}", f"choose one of {', '.join(known)}")
    found: dict[str, Any] = json.loads(file.read_text(encoding="utf-8"))
    return found


def describe(key: str, result: str = "fit") -> str:
    """The meaning and the unit of a key of a result: ``describe("goodness.rmse")``,
    ``describe("parameters.C_H.value")``, ``describe("candidates[0].p_value", "diagnosis")``.

    ``result``: as for ``schema``. Raises ``InputError`` if the result has no such key."""
    node = schema(result)
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
