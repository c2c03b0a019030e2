"""The pictures of each result by name."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any, Optional, Sequence, Union

from ._facts import Facts, facts_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    On = Union[Axes, Sequence[Axes], None]
    Drawn = Union[Axes, list[Axes]]


class _Pictures:
    """Pictures are those of the report. Each method draws one with matplotlib: on ``ax``, or on a
    figure of its own, and returns its axes (a list where the picture has several).

    Where there are several of a kind, one per size, parameter or dataset, ``which`` counts them
    from 1; ``pictures`` has their titles. A picture that this result does not have raises
    ``ValueError``."""

    def _read_pictures(self) -> str:
        raise NotImplementedError

    def _all_pictures(self) -> list[Facts]:
        found: Optional[list[Facts]] = self.__dict__.get("_drawn")
        if found is None:
            found = facts_of('{"all": ' + self._read_pictures() + "}")["all"]
            self.__dict__["_drawn"] = found
        return found

    @property
    def pictures(self) -> dict[str, str]:
        """The pictures that there are: name and title."""
        return {picture.name: picture.title for picture in self._all_pictures()}

    def _draw(self, kind: str, which: int, ax: Any) -> Any:
        from ._draw import draw

        found = [p for p in self._all_pictures() if re.fullmatch(kind + r"(-\d+)?", p.name)]
        if not 1 <= which <= len(found):
            there = f"there are {len(found)}" if found else "this result has none"
            raise ValueError(f"no picture {kind} number {which}: {there}")
        return draw(found[which - 1], ax)

    def plot_picture(self, name: str, ax: "On" = None) -> "Drawn":
        """The picture of that name, one of ``pictures``."""
        from ._draw import draw

        for picture in self._all_pictures():
            if picture.name == name:
                return draw(picture, ax)
        raise ValueError(f"no picture {name!r}; there are {', '.join(self.pictures)}")


class FitPictures(_Pictures):
    """The pictures of a fit."""

    def plot_restitution(self, which: int = 1, ax: "On" = None) -> "Drawn":
        """e against V of one size: points, fit and its band, the two-point calibration, the
        capture velocity with its interval."""
        return self._draw("restitution", which, ax)

    def plot_residuals(self, which: int = 1, ax: "On" = None) -> "Drawn":
        """Weighted residuals against velocity, of one dataset."""
        return self._draw("residuals", which, ax)

    def plot_overview(self, which: int = 1, ax: "On" = None) -> "Drawn":
        """e against V of all sizes."""
        return self._draw("overview", which, ax)

    def plot_capture_models(self, which: int = 1, ax: "On" = None) -> "Drawn":
        """Capture velocity against diameter, beside other models, of one dataset."""
        return self._draw("capture-models", which, ax)

    def plot_mixture_average(self, which: int = 1, ax: "On" = None) -> "Drawn":
        """Averages over the sizes, of a dataset that comes with a size distribution."""
        return self._draw("mixture-average", which, ax)

    plot_fit = plot_restitution
    plot = plot_restitution


class DiagnosisPictures(_Pictures):
    """The pictures of a diagnosis."""

    def plot_misfit(self, which: int = 1, ax: "On" = None) -> "Drawn":
        """Where the model is too high or too low, over velocity and diameter, of one dataset."""
        return self._draw("misfit", which, ax)

    def plot_ranking(self, which: int = 1, ax: "On" = None) -> "Drawn":
        """The candidates by what they gain."""
        return self._draw("ranking", which, ax)

    def plot_before_after(self, which: int = 1, ax: "On" = None) -> "Drawn":
        """e(V) under the base and the extended model, of one dataset."""
        return self._draw("before-after", which, ax)


class MixturePictures(_Pictures):
    """The pictures of a prediction for a mixture of sizes."""

    def plot_average(self, which: int = 1, ax: "On" = None) -> "Drawn":
        """Averages over the sizes under three conventions."""
        return self._draw("mixture-average", which, ax)

    def plot_sizes(self, which: int = 1, ax: "On" = None) -> "Drawn":
        """The smallest sphere, the mean one, the largest."""
        return self._draw("mixture-sizes", which, ax)

    def plot_captured(self, which: int = 1, ax: "On" = None) -> "Drawn":
        """How many spheres stay, or are not seen again."""
        return self._draw("mixture-captured", which, ax)


class PairingPictures(_Pictures):
    """The pictures of an experiment, after those of Li, Dunn & Brach (1999)."""

    def plot_sizes(self, which: int = 1, ax: "On" = None) -> "Drawn":
        """The diameters of the incoming spheres."""
        return self._draw("sizes", which, ax)

    def plot_velocities(self, which: int = 1, ax: "On" = None) -> "Drawn":
        """The velocities of all passages (1) and of the impacts (2)."""
        return self._draw("velocities-(raw|paired)", which, ax)

    def plot_restitution(self, which: int = 1, ax: "On" = None) -> "Drawn":
        """The points: e against V."""
        return self._draw("restitution", which, ax)

    plot = plot_restitution
