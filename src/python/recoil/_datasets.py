"""Datasets, and their conversion from and to pandas."""

from __future__ import annotations

import csv
import html
import io
import json
import math
import os
import warnings
from pathlib import Path
from typing import TYPE_CHECKING, Any, Iterable, Mapping, Optional, Sequence, Union

from . import _recoil
from ._errors import InputError, refuse, refuse_to_replace
from ._options import flag_of, numbers_of, path_of, plain, text_of

if TYPE_CHECKING:
    import numpy.typing as npt
    import pandas

PathLike = Union[str, "os.PathLike[str]"]
Material = Union[str, Mapping[str, Any]]

_UNITS = {
    "diameter": "um", "diameter_sd": "um", "series_diameter_sd": "um",
    "incident_velocity": "m/s", "rebound_velocity": "m/s",
    "velocity_sd": "m/s", "setting_velocity_sd": "m/s",
    "restitution": "1", "restitution_sd": "1", "tangential_restitution": "1",
}
_ALIASES = {"V": "incident_velocity", "e": "restitution", "d": "diameter",
            "V_sd": "velocity_sd", "e_sd": "restitution_sd"}
_TEXTS = ("series", "setting", "launch")
_COUNTS = ("events", "captured")


def named(frame: "pandas.DataFrame") -> "pandas.DataFrame":
    """``frame`` with the names of points.csv for V, e, d, V_sd and e_sd."""
    short = {column: name for column, name in _ALIASES.items()
             if column in frame.columns and name not in frame.columns}
    return frame.rename(columns=short) if short else frame


def _material(body: str, stated: Any) -> Any:
    """``stated``, or if it is a name, the material of that name in the table of materials."""
    stated = plain(body, stated)
    return json.loads(_recoil.material(stated, body)) if isinstance(stated, str) else stated


def _stated(like: Optional["Dataset"], **given: Any) -> dict[str, Any]:
    """The object ``recoil`` of datapackage.json: the given values, then those of ``like``."""
    own: dict[str, Any] = {} if like is None else dict(like._package["recoil"])
    for key, value in given.items():
        if value is not None:
            bodies = key in ("particle", "surface")
            own[key] = _material(key, value) if bodies else plain(key, value)
    for key in ("particle", "surface", "provenance"):
        if key not in own:
            refuse(f"{key} is not known", f"give {key}=..., or like= a dataset that has it")
    return own


def _fields(columns: Iterable[str], units: Mapping[str, str]) -> list[dict[str, str]]:
    """The fields of datapackage.json."""
    return [{"name": column,
             "type": "string" if column in _TEXTS else "integer" if column in _COUNTS else "number",
             **({"unit": units[column]} if column in units else {})} for column in columns]


def _series_of(diameters: Any, unit: str) -> list[str]:
    """One series for each diameter if there are at most 12, else one for all."""
    few = len(set(diameters)) <= 12
    try:
        return [f"{float(d):g} {unit}" if few else "points" for d in diameters]
    except (TypeError, ValueError):  # the reader of the points reports the error
        return ["points"] * len(diameters)


def _cells(
    name: str, values: Any, points: Optional[int], *, empty: bool = False, whole: bool = False
) -> list[str]:
    """The CSV cells of one column. ``points``: number of points, None: any; ``empty``: NaN is a
    missing value; ``whole``: whole numbers."""
    import numpy as np

    array = numbers_of(name, values, boolean=name == "captured")
    if array.ndim == 0 and points is not None:
        array = np.full(points, float(array))
    if array.ndim != 1 or (points is not None and len(array) != points):
        shape = " x ".join(map(str, array.shape)) or "one"
        wanted = "one entry per point" if points is None else f"{points} entries, as V has"
        refuse(f"{name} has {shape} entries", f"give {wanted}")
    cells = []
    for i, value in enumerate(array.tolist()):
        if empty and math.isnan(value):
            cells.append("")
            continue
        if not math.isfinite(value):
            refuse(f"{name}[{i}] is {value}", "leave the point out")
        if whole and value != int(value):
            refuse(f"{name}[{i}] is {value}", "give whole numbers")
        cells.append(str(int(value)) if whole else repr(value))
    return cells


def _without_masked(arguments: Mapping[str, Any]) -> dict[str, Any]:
    """The arguments without the points that are masked in any of them."""
    import numpy as np

    masks = [np.broadcast_to(one.mask, one.shape) for one in arguments.values()
             if isinstance(one, np.ma.MaskedArray) and one.ndim == 1]
    points = {len(mask) for mask in masks}
    if len(points) != 1 or not any(mask.any() for mask in masks):
        return dict(arguments)
    kept = ~np.any(masks, axis=0)
    left_out = int(len(kept) - kept.sum())
    warnings.warn(f"{left_out} masked point{'s are' if left_out > 1 else ' is'} left out", stacklevel=4)

    def rows(one: Any) -> Any:
        if isinstance(one, str) or np.ndim(one) != 1 or len(one) != len(kept):
            return one
        if isinstance(one, np.ma.MaskedArray):
            return one.data[kept]
        return [entry for entry, keep in zip(one, kept) if keep]

    return {name: rows(one) for name, one in arguments.items()}


class Dataset:
    """Points and materials, from a dataset folder or a pandas frame.

    ``Dataset(folder)`` reads and validates ``folder``, as ``recoil check`` does.

    Raises ``InputError`` with file, line and column of the first mistake.
    """

    def __init__(self, folder: PathLike) -> None:
        named_folder = path_of("folder", folder)
        self._data = _recoil.load_dataset(named_folder)
        place = Path(named_folder)
        package = (place / "datapackage.json").read_text(encoding="utf-8-sig")
        self._package: dict[str, Any] = json.loads(package)
        self._csv = (place / self._package["resources"][0]["path"]).read_text(encoding="utf-8-sig")

    @classmethod
    def _of(cls, data: _recoil.Dataset, package: dict[str, Any], csv: str) -> "Dataset":
        made = cls.__new__(cls)
        made._data, made._package, made._csv = data, package, csv
        return made

    @classmethod
    def from_pandas(
        cls,
        frame: "pandas.DataFrame",
        name: str = "points",
        *,
        particle: Optional[Material] = None,
        surface: Optional[Material] = None,
        provenance: Optional[str] = None,
        like: Optional["Dataset"] = None,
        title: str = "",
        units: Optional[Mapping[str, str]] = None,
        **more: Any,
    ) -> "Dataset":
        """Makes a dataset from the rows of ``frame``.

        ``frame``: one row per point, columns as in points.csv: ``series``, ``diameter`` [um],
        ``incident_velocity`` [m/s], ``restitution`` [1] or ``rebound_velocity`` [m/s]; optional
        ``restitution_sd``, ``velocity_sd``, ``diameter_sd``, ``series_diameter_sd``, ``events``,
        ``captured``, ``setting``, ``setting_velocity_sd``, ``incidence_angle`` (its unit, ``"deg"``
        or ``"rad"``, has to be in ``units``), ``tangential_restitution`` and the conditions.
        Missing values are empty cells. ``V``, ``e``, ``d``, ``V_sd`` and ``e_sd`` are short names.
        Without ``series``, the points of each diameter form a series.
        ``units``: of columns in other units than these, ``{"diameter": "mm"}``.
        ``particle``, ``surface``: a name (``recoil materials`` lists them), or ``{"material": ...,
        "density": 1050, "youngs_modulus": 2.56e9, "poisson_ratio": 0.35}`` [kg/m3, Pa, 1].
        ``provenance``: ``"measured"``, ``"digitised"``, ``"reconstruction"`` or ``"synthetic"``.
        ``like``: a dataset that provides the values that are not given.
        ``more``: other keys of ``recoil`` in datapackage.json, such as ``stiffness_K``,
        ``method`` or ``conditions``.

        Raises ``InputError``, which names the column and the row, counted from 0.
        """
        if not hasattr(frame, "columns") or not hasattr(frame, "to_csv"):
            refuse(f"{type(frame).__name__} is no frame of pandas", "give a DataFrame")
        if like is not None and not isinstance(like, Dataset):
            refuse(f"like is {type(like).__name__}", "give a Dataset")
        units = plain("units", {} if units is None else units)
        if not isinstance(units, dict):
            refuse(f"units is {units}", "give a dictionary")
        own = _stated(like, particle=particle, surface=surface, provenance=provenance, **more)
        frame = named(frame)
        said = dict(_UNITS)
        for known in (like.units if like else {}, frame.attrs.get("units", {}), units):
            said.update({_ALIASES.get(column, column): unit for column, unit in known.items()})
        if "series" not in frame.columns and "diameter" in frame.columns:
            frame = frame.assign(series=_series_of(frame["diameter"], said["diameter"]))
        fields = _fields(map(str, frame.columns), said)
        for field in fields:
            if field["name"] in _COUNTS and str(frame[field["name"]].dtype) in ("bool", "boolean"):
                field["type"] = "boolean"
        return cls._parsed(name, title, fields, own, frame.to_csv(index=False))

    @classmethod
    def from_arrays(
        cls,
        V: npt.ArrayLike,  # noqa: N803
        e: npt.ArrayLike,
        *,
        d: npt.ArrayLike,
        particle: Material,
        surface: Material,
        e_sd: Optional[npt.ArrayLike] = None,
        V_sd: Optional[npt.ArrayLike] = None,  # noqa: N803
        events: Optional[npt.ArrayLike] = None,
        captured: Optional[npt.ArrayLike] = None,
        series: Union[str, Sequence[str], None] = None,
        provenance: str = "measured",
        name: str = "points",
        **more: Any,
    ) -> "Dataset":
        """Makes a dataset from arrays.

        ``V``: incident velocity [m/s]; ``e``: restitution [1], NaN if every sphere is captured;
        ``d``: diameter [um]; ``e_sd``, ``V_sd``: standard deviations of ``e`` and ``V``;
        ``events``, ``captured``: number of impacts, and of captured ones. A single number applies
        to all points. Points that are masked in any of the arrays are left out, with a warning.
        Arrays of complex numbers, booleans (but ``captured``), texts or objects are refused.
        ``series``: names; unless given, the points of each diameter form a series.
        ``particle``, ``surface``, ``provenance``, ``more``: see ``from_pandas``.

        Raises ``InputError``, which names the argument and its entry.
        """
        rows = _without_masked({"V": V, "e": e, "d": d, "e_sd": e_sd, "V_sd": V_sd,
                                "events": events, "captured": captured, "series": series})
        velocity = _cells("V", rows["V"], None)
        points = len(velocity)
        diameters = _cells("d", rows["d"], points)
        series = rows["series"]
        if series is None:
            names = _series_of(diameters, "um")
        else:
            series = plain("series", series)
            if not isinstance(series, (str, list)):
                refuse(f"series is {series}", "give a name, or a list with one per point")
            names = [series] * points if isinstance(series, str) else [str(one) for one in series]
        if len(names) != points:
            refuse(f"series has {len(names)} entries and V has {points}", "give one per point")
        columns = {"series": names, "diameter": diameters, "incident_velocity": velocity,
                   "restitution": _cells("e", rows["e"], points, empty=captured is not None)}
        given = {"restitution_sd": "e_sd", "velocity_sd": "V_sd", "events": "events",
                 "captured": "captured"}
        for column, argument in given.items():
            if rows[argument] is not None:
                columns[column] = _cells(argument, rows[argument], points, whole=column in _COUNTS)
        text = io.StringIO()
        writer = csv.writer(text, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows(zip(*columns.values()))
        own = _stated(None, particle=particle, surface=surface, provenance=provenance, **more)
        return cls._parsed(name, "", _fields(columns, _UNITS), own, text.getvalue())

    @classmethod
    def _parsed(
        cls, name: str, title: str, fields: list[dict[str, str]], own: dict[str, Any], points: str
    ) -> "Dataset":
        name, title = text_of("name", name), text_of("title", title)
        resource = {"name": "points", "path": "points.csv", "schema": {"fields": fields}}
        package = {"name": name, "title": title or name, "resources": [resource], "recoil": own}
        try:
            data = _recoil.parse_dataset(json.dumps(package), points, name)
        except InputError as error:  # remove the name of a file that does not exist
            problem = error.problem
            if error.file.endswith("points.csv") and error.line > 1:
                problem = f"entry {error.line - 2} (from 0): {problem}"
            message = problem + (f" ({error.why})" if error.why else "")
            message += f"; {error.suggestion}" if error.suggestion else ""
            raise InputError(message, problem=problem, why=error.why,
                             suggestion=error.suggestion) from None
        return cls._of(data, package, points)

    def to_pandas(self) -> "pandas.DataFrame":
        """The points as a frame with one row per point, columns and numbers as in the file;
        ``frame.attrs["units"]`` contains the units of the columns. Needs pandas."""
        import pandas

        resource = self._package["resources"][0]
        dialect = resource.get("dialect", {})
        fields = resource["schema"]["fields"]
        numbers: dict[str, Any] = next((field for field in fields if "decimalChar" in field), {})
        frame = pandas.read_csv(
            io.StringIO(self._csv),
            sep=dialect.get("delimiter", ","),
            comment=dialect.get("commentChar"),
            decimal=numbers.get("decimalChar", "."),
            thousands=next((f["groupChar"] for f in fields if "groupChar" in f), None),
            **({} if dialect.get("header", True) else {"names": [f["name"] for f in fields]}),
            dtype={name: str for name in _TEXTS},
            keep_default_na=False,
            na_values=["", *resource["schema"].get("missingValues", [])],
            float_precision="round_trip",
        )
        frame.attrs["units"] = self.units
        return frame

    def save(self, folder: PathLike, *, replace: bool = False) -> None:
        """Writes the dataset as a folder that ``recoil check`` reads.

        Raises ``InputError`` if its files exist, unless ``replace`` is true.
        """
        place = Path(path_of("folder", folder))
        points = place / self._package["resources"][0]["path"]
        replace = flag_of("replace", replace)
        if not replace:
            refuse_to_replace(points, place / "datapackage.json")
        package = json.dumps(self._package, indent=2, ensure_ascii=False) + "\n"
        _recoil.write_whole_files(
            [(points, self._csv), (place / "datapackage.json", package)], replace)

    @property
    def units(self) -> dict[str, str]:
        """Units by column, for columns with a unit: ``{"diameter": "um", ...}``."""
        fields = self._package["resources"][0]["schema"]["fields"]
        return {field["name"]: field["unit"] for field in fields if field.get("unit")}

    @property
    def id(self) -> str:
        """Name of the dataset in datapackage.json."""
        return self._data.id

    @property
    def title(self) -> str:
        """Title of the dataset."""
        return self._data.title

    @property
    def provenance(self) -> str:
        """``measured``, ``digitised``, ``reconstruction`` or ``synthetic``."""
        return self._data.provenance

    @property
    def sha256(self) -> str:
        """SHA-256 of datapackage.json and the points."""
        return self._data.sha256

    @property
    def sources(self) -> list[str]:
        """Sources of the data, one line each: title and address."""
        return list(self._data.sources)

    @property
    def package(self) -> dict[str, Any]:
        """A copy of datapackage.json, with the materials under ``recoil``."""
        copy: dict[str, Any] = json.loads(json.dumps(self._package))
        return copy

    def __len__(self) -> int:
        return self._data.points

    def __reduce__(self) -> Any:
        return (_dataset_of, (self._package, self._csv, self._data.folder))

    def __copy__(self) -> "Dataset":
        return self

    def __deepcopy__(self, memo: Any) -> "Dataset":
        return self

    def __repr__(self) -> str:
        return f"<recoil.Dataset {self.id}: {len(self)} points, {self.provenance}>"

    def _repr_html_(self) -> str:
        head = f"<p>{html.escape(self.id)}: {len(self)} points, {self.provenance}</p>"
        return head + str(self.to_pandas()._repr_html_())


def _dataset_of(package: dict[str, Any], csv: str, folder: str) -> Dataset:
    """Restores a dataset from the texts in a pickle."""
    return Dataset._of(_recoil.parse_dataset(json.dumps(package), csv, folder), package, csv)
