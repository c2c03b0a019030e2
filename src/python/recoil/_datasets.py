"""Datasets, and their way from and to pandas."""

from __future__ import annotations

import io
import json
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any, Mapping, Optional, Union

from . import _recoil
from ._errors import InputError

if TYPE_CHECKING:
    import pandas

PathLike = Union[str, "os.PathLike[str]"]

_UNITS = {
    "diameter": "um",
    "diameter_sd": "um",
    "series_diameter_sd": "um",
    "incident_velocity": "m/s",
    "rebound_velocity": "m/s",
    "velocity_sd": "m/s",
    "setting_velocity_sd": "m/s",
    "restitution": "1",
    "restitution_sd": "1",
}
_TEXTS = ("series", "setting")
_COUNTS = ("events", "captured")


class Dataset:
    """Points and materials: a dataset folder as read, or a frame of pandas.

    ``Dataset(folder)`` reads and validates ``folder``, as ``recoil check`` does.

    Raises ``InputError`` with file, line and column of the first mistake.
    """

    def __init__(self, folder: PathLike) -> None:
        self._data = _recoil.load_dataset(os.fspath(folder))
        place = Path(folder)
        self._package: dict[str, Any] = json.loads(
            (place / "datapackage.json").read_text(encoding="utf-8-sig")
        )
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
        particle: Optional[Mapping[str, Any]] = None,
        surface: Optional[Mapping[str, Any]] = None,
        provenance: Optional[str] = None,
        like: Optional["Dataset"] = None,
        title: str = "",
        units: Optional[Mapping[str, str]] = None,
        **more: Any,
    ) -> "Dataset":
        """A dataset of the rows of ``frame``.

        ``frame``: one row per point, columns as in points.csv: ``series``, ``diameter`` [um],
        ``incident_velocity`` [m/s], ``restitution`` [1] or ``rebound_velocity`` [m/s]; optional
        ``restitution_sd``, ``velocity_sd``, ``diameter_sd``, ``series_diameter_sd``, ``events``,
        ``captured``, ``setting``, ``setting_velocity_sd`` and the conditions. Missing values are
        empty cells.
        ``units``: of columns in other units than these, ``{"diameter": "mm"}``.
        ``particle``, ``surface``: ``{"material": ..., "density": 1050, "youngs_modulus": 2.56e9,
        "poisson_ratio": 0.35}`` [kg/m3, Pa, 1]; ``provenance``: ``"measured"``, ``"digitised"``,
        ``"reconstruction"`` or ``"synthetic"``. What is not given is that of ``like``.
        ``more``: other keys of ``recoil`` in datapackage.json, such as ``stiffness_K``,
        ``method`` or ``conditions``.

        Raises ``InputError`` that names the column, or the line as the frame would have it as CSV.
        """
        own: dict[str, Any] = {} if like is None else dict(like._package["recoil"])
        given = {"particle": particle, "surface": surface, "provenance": provenance, **more}
        own.update({key: value for key, value in given.items() if value is not None})
        for key in ("particle", "surface", "provenance"):
            if key not in own:
                raise InputError(
                    f"{key} is not known; give {key}=..., or like= a dataset that has it",
                    problem=f"{key} is not known",
                    suggestion=f"give {key}=..., or like= a dataset that has it",
                )
        said = dict(_UNITS)
        for known in (like.units if like else {}, frame.attrs.get("units", {}), units or {}):
            said.update(known)
        fields = []
        for column in map(str, frame.columns):
            kind = "string" if column in _TEXTS else "integer" if column in _COUNTS else "number"
            if column in _COUNTS and str(frame[column].dtype) in ("bool", "boolean"):
                kind = "boolean"
            field = {"name": column, "type": kind}
            if column in said:
                field["unit"] = said[column]
            fields.append(field)
        resource = {"name": "points", "path": "points.csv", "schema": {"fields": fields}}
        package = {"name": name, "title": title or name, "resources": [resource], "recoil": own}
        csv = frame.to_csv(index=False)
        data = _recoil.parse_dataset(json.dumps(package), csv, name)
        return cls._of(data, package, csv)

    def to_pandas(self) -> "pandas.DataFrame":
        """The points as a frame, one row each, columns and numbers as in the file;
        ``frame.attrs["units"]`` has the units of the columns."""
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

    def save(self, folder: PathLike) -> None:
        """Writes the dataset as a folder that ``recoil check`` reads."""
        target = Path(folder)
        target.mkdir(parents=True, exist_ok=True)
        (target / self._package["resources"][0]["path"]).write_text(self._csv, encoding="utf-8")
        package = json.dumps(self._package, indent=2, ensure_ascii=False) + "\n"
        (target / "datapackage.json").write_text(package, encoding="utf-8")

    @property
    def units(self) -> dict[str, str]:
        """Of the columns that have one: ``{"diameter": "um", ...}``."""
        fields = self._package["resources"][0]["schema"]["fields"]
        return {field["name"]: field["unit"] for field in fields if field.get("unit")}

    @property
    def id(self) -> str:
        """The package's name."""
        return self._data.id

    @property
    def title(self) -> str:
        """For people."""
        return self._data.title

    @property
    def provenance(self) -> str:
        """``measured``, ``digitised``, ``reconstruction`` or ``synthetic``."""
        return self._data.provenance

    @property
    def sha256(self) -> str:
        """Checksum of datapackage.json and the points."""
        return self._data.sha256

    @property
    def sources(self) -> list[str]:
        """One line each."""
        return list(self._data.sources)

    @property
    def package(self) -> dict[str, Any]:
        """A copy of datapackage.json, with the materials under ``recoil``."""
        copy: dict[str, Any] = json.loads(json.dumps(self._package))
        return copy

    def __len__(self) -> int:
        return self._data.points

    def __repr__(self) -> str:
        return f"<recoil.Dataset {self.id}: {len(self)} points, {self.provenance}>"

    def _repr_html_(self) -> str:
        return f"<p>{self.id}: {len(self)} points, {self.provenance}</p>" + str(
            self.to_pandas()._repr_html_()
        )
