"""JSON as Python objects."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import pandas


class Facts(dict):  # type: ignore[type-arg]
    """An object of a JSON file: a dictionary whose keys are also attributes.

    ``fit.parameters.C_H.value`` is ``fit["parameters"]["C_H"]["value"]``. Keys that are not Python
    names (``C_A[wall1990-mica]``) or that are methods of dictionaries (``items``) need brackets.
    """

    def __getattr__(self, name: str) -> Any:
        try:
            return self[name]
        except KeyError:
            known = ", ".join(map(str, self))
            raise AttributeError(f"there is no {name!r} here; there are: {known}") from None

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *(key for key in self if key.isidentifier())]


class Table(list):  # type: ignore[type-arg]
    """A list of objects with the same keys: a table."""

    def to_pandas(self) -> "pandas.DataFrame":
        """The table as a frame, one row for each object."""
        import pandas

        return pandas.DataFrame.from_records(list(self))

    def _repr_html_(self) -> str:
        return str(self.to_pandas()._repr_html_())


def _facts(pairs: list[tuple[str, Any]]) -> Facts:
    def is_table(value: Any) -> bool:
        return isinstance(value, list) and bool(value) and all(isinstance(v, Facts) for v in value)

    return Facts((key, Table(value) if is_table(value) else value) for key, value in pairs)


def facts_of(text: str) -> Facts:
    """The JSON in ``text``; numbers keep all of their digits."""
    facts: Facts = json.loads(text, object_pairs_hook=_facts)
    return facts
