"""Impacts of a model, one or many."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Optional

from . import _recoil
from ._errors import refuse
from ._facts import Facts, facts_of
from ._options import flag_of, number_of, numbers_of, text_of

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    Array = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Impacts:
    """Many impacts of one model; all arrays have the shape of the velocities and diameters."""

    incident_velocity: Array
    """V [m/s]"""
    diameter_um: Array
    """d [um]"""
    restitution: Array
    """e = rebound / incident velocity [1]; 0 if the sphere is captured, NaN if an impact has no
    solution."""
    restitution_squared: Array
    """e^2 [1], continued below zero for a capture: 2 H / (m V^2), with H the mechanical energy of
    the captured sphere. It is smooth across the capture velocity, so use it for fits."""
    captured: npt.NDArray[np.bool_]
    """Is the sphere captured?"""
    slopes: Optional[dict[str, Array]]
    """d e^2 / d p [1 / unit of p] by the name of p: each parameter of the model (C_H, C_A [s/m],
    f0 [N/m], ...), ``incident_velocity`` [s/m] and ``diameter_um`` [1/um], with f0 proportional to
    r^(1/3) (eq. 12). None unless requested."""

    def gradient(self, name: str) -> Array:
        """d e / d p = (d e^2 / d p) / (2 e) [1 / unit of p] of the parameter ``name``; 0 if the
        sphere is captured."""
        import numpy as np

        if self.slopes is None:
            refuse("the gradient was not asked for", "simulate with gradient=True")
        if text_of("name", name) not in self.slopes:
            refuse(f"there is no parameter {name!r}", f"choose one of {', '.join(self.slopes)}")
        slope = self.slopes[name]
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.where(self.captured, 0.0, slope / (2.0 * self.restitution))


def broadcast(V: npt.ArrayLike, d: npt.ArrayLike) -> "tuple[Array, Array]":  # noqa: N803
    """Velocities and diameters as arrays of one shape. Raises ``InputError``."""
    import numpy as np

    velocity, diameter = numbers_of("V", V), numbers_of("d", d)
    try:
        velocity, diameter = np.broadcast_arrays(velocity, diameter)
    except ValueError:
        refuse(f"V has the shape {velocity.shape} and d {diameter.shape}", "give arrays of one shape")
    return velocity, diameter


class Model:
    """The impact model of a fit with values for its parameters."""

    def __init__(self, model: _recoil.Model) -> None:
        self._model = model

    @property
    def parameters(self) -> dict[str, float]:
        """The values by name, with the units of fit.json, including material constants that have an
        error."""
        return dict(zip(self._model.labels, self._model.values))

    def simulate(self, V: npt.ArrayLike, d: npt.ArrayLike, *,  # noqa: N803
                 dataset: str = "", gradient: bool = False) -> Impacts:
        """Simulates impacts at incident velocities ``V`` [m/s] of spheres of diameter ``d`` [um].

        ``V`` and ``d`` are numbers or arrays that broadcast against each other. ``dataset``: id of
        a dataset of the fit; the first by default. ``gradient``: also compute the slopes. Other
        Python threads can run during the simulation.

        Raises ``InputError`` if a velocity is not between 1e-7 and 1e4 m/s, or a diameter not
        between 1e-3 and 1e6 um.
        """
        import numpy as np

        velocity, diameter = broadcast(V, d)
        gradient = flag_of("gradient", gradient)
        shape = velocity.shape
        squared, captured, columns = self._model.simulate(
            np.ascontiguousarray(velocity).reshape(-1),
            np.ascontiguousarray(diameter).reshape(-1), text_of("dataset", dataset), gradient)
        slopes = None
        if gradient:
            names = [*self._model.labels, "incident_velocity", "diameter_um"]
            slopes = {name: column.reshape(shape) for name, column in zip(names, columns)}
            slopes["diameter_um"] = slopes["diameter_um"] * 1e-6
        return Impacts(
            incident_velocity=velocity.copy(),
            diameter_um=diameter.copy(),
            restitution=np.sqrt(np.maximum(squared, 0.0)).reshape(shape),
            restitution_squared=squared.reshape(shape),
            captured=captured.astype(bool).reshape(shape),
            slopes=slopes,
        )

    def impact(self, V: float, d: float, *, dataset: str = "") -> Facts:  # noqa: N803
        """Simulates one impact at ``V`` [m/s] of a sphere of diameter ``d`` [um] in detail.

        Returns the JSON of ``recoil simulate --json``, with contact time, forces, energies and,
        under ``history``, the forces against time.

        Raises ``ComputationError`` if the impact has no solution.
        """
        return facts_of(
            self._model.impact(number_of("V", V), number_of("d", d), text_of("dataset", dataset)))
