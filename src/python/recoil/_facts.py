"""JSON as Python objects."""

from __future__ import annotations

import json
from typing import Any


class Facts(dict):  # type: ignore[type-arg]
    """An object of a JSON file: a dictionary whose keys are attributes too.

    ``fit.parameters.C_H.value`` is ``fit["parameters"]["C_H"]["value"]``. Keys that are no Python
    names (``C_A[wall1990-mica]``) and those that dictionaries have as methods (``items``) are
    reached with brackets only.
    """

    def __getattr__(self, name: str) -> Any:
        try:
            return self[name]
        except KeyError:
            known = ", ".join(map(str, self))
            raise AttributeError(f"there is no {name!r} here; there are: {known}") from None

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *(key for key in self if key.isidentifier())]


def facts_of(text: str) -> Facts:
    """The JSON in ``text``; numbers keep all of their digits."""
    facts: Facts = json.loads(text, object_pairs_hook=Facts)
    return facts
