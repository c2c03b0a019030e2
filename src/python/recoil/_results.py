"""Results: the contents of the JSON files as attributes, and methods."""

from __future__ import annotations

import csv
import html
import io
import math
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any, Iterator, Optional, Union

from . import _recoil
from ._errors import refuse, refuse_to_replace
from ._facts import Facts, facts_of
from ._impacts import Impacts, Model, broadcast
from ._options import flag_of, given, path_of, shows, takes_options, text_of

if TYPE_CHECKING:
    import numpy.typing as npt
    import pandas
    from matplotlib.axes import Axes

    from ._impacts import Array

PathLike = Union[str, "os.PathLike[str]"]
Quantity = Union[float, str]


_COMPILED = ("_compiled", "_fitted", "_pictures")


class _Result:
    """Base of all results: the keys of their JSON are attributes."""

    _text = ""
    _json = ""

    @property
    def facts(self) -> Facts:
        """All contents of the JSON."""
        found: Optional[Facts] = self.__dict__.get("_facts")
        if found is None:
            found = facts_of(self._json)
            self.__dict__["_facts"] = found
        return found

    @property
    def json(self) -> str:
        """The text of the JSON file, byte for byte as the command writes it."""
        return self._json

    def __getattr__(self, name: str) -> Any:
        if name in _COMPILED and "_json" in self.__dict__:
            raise AttributeError("a result from a pickle has its numbers and its text; "
                                 "fit again for what takes the model")
        if name.startswith("_"):
            raise AttributeError(name)
        return getattr(self.facts, name)

    def __getitem__(self, name: str) -> Any:
        return self.facts[name]

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self.facts]

    def __getstate__(self) -> dict[str, Any]:
        # Only the texts: compiled objects cannot leave their process.
        return {name: value for name, value in self.__dict__.items() if isinstance(value, str)}

    def __copy__(self) -> "_Result":
        return self

    def __deepcopy__(self, memo: Any) -> "_Result":
        return self

    def __str__(self) -> str:
        return self._text

    def _repr_html_(self) -> str:
        return f"<pre>{html.escape(self._text)}</pre>"


class _WithPictures(_Result):
    """A result with the pictures of its report."""

    _pictures: _recoil.Pictures

    @property
    def pictures(self) -> dict[str, str]:
        """The name and title of every picture."""
        return self._pictures.titles()

    def svg(self, name: str) -> str:
        """The picture ``name`` as SVG. Raises ``InputError`` if there is none."""
        if text_of("name", name) not in self.pictures:
            refuse(f"there is no picture {name!r}", f"choose one of {', '.join(self.pictures)}")
        return self._pictures.svg(name)


class _Reported(_WithPictures):
    """A result of the compiled part, with a report in words."""

    def __init__(self, compiled: Any) -> None:
        self._compiled = compiled
        self._json = compiled.json()
        self._text = compiled.text(False)
        self._pictures = compiled.pictures()

    def report(self, verbose: bool = False) -> str:
        """The text that the command prints; ``verbose``: with ``--verbose``."""
        return str(self._compiled.text(True)) if flag_of("verbose", verbose) else self._text

    def _repr_html_(self) -> str:
        if "_compiled" not in self.__dict__:
            return super()._repr_html_()
        return str(self._compiled.summary())


def _next(text: str, call: str) -> str:
    """A report whose last words name a call instead of a command."""
    head, found, _ = text.rpartition("Next: recoil ")
    return f"{head}Next: {call}.\n" if found else text


def _numbers(values: list[Optional[float]]) -> Array:
    """An array, with NaN for missing numbers."""
    import numpy as np

    return np.array([math.nan if v is None else v for v in values], dtype=np.float64)


def _column(rows: list[Facts], name: str) -> Array:
    """The values of one key in all rows."""
    return _numbers([row[name] for row in rows])


class Parameter:
    """A parameter of a fit, with the attribute names of lmfit."""

    def __init__(self, name: str, facts: Facts, options: Facts) -> None:
        self.name = name
        self.value: float = facts.value
        self.stderr: Optional[float] = facts.std_error
        self.vary: bool = facts.free
        self.unit: str = facts.unit
        self.init_value: Optional[float] = options.initial
        bounds = options.bounds
        self.min: float = -math.inf if bounds[0] is None else bounds[0]
        self.max: float = math.inf if bounds[1] is None else bounds[1]
        self.facts = facts

    @property
    def interval(self) -> Optional[list[float]]:
        """The recommended interval, [lower, upper] or None."""
        kind = self.facts.recommended.interval
        interval: Optional[list[float]] = self.facts.intervals[kind] if kind else None
        return interval

    def __repr__(self) -> str:
        error = "(fixed)" if not self.vary else f"+/- {self.stderr}"
        return f"<Parameter {self.name} = {self.value} {error} [{self.unit}]>"


class FitResult(_Reported):
    """A fit: the keys of fit.json are attributes (``result.parameters.C_H.value``,
    ``result.goodness.chi2``, ``result.derived.capture_velocity[0].interval``); docs/fit-json.md
    lists them. The names of lmfit's ModelResult also work."""

    fit: Facts
    dataset: Facts
    datasets: list[Facts]
    provenance_sentence: str
    options: Facts
    model: Facts
    parameters: Facts
    derived: Facts
    model_verdict: Facts
    goodness: Facts
    identifiability: Facts
    validity: list[Facts]
    bootstrap: Facts
    noise: Facts
    two_point: Optional[Facts]
    full: Facts
    curve: list[Facts]
    residuals: list[Facts]
    warnings: list[str]

    def __init__(self, analysis: _recoil.Analysis) -> None:
        super().__init__(analysis)
        self._fitted = Model(analysis.model())

    def __str__(self) -> str:
        return _next(self._text, "result.diagnose(); as a page: result.save_page(file); "
                                 "all details: result.report(verbose=True)")

    # -- methods --

    def simulate(self, V: npt.ArrayLike, d: npt.ArrayLike, *,  # noqa: N803
                 dataset: str = "", gradient: bool = False) -> Impacts:
        """Impacts with the fitted values: ``Model.simulate``."""
        return self._fitted.simulate(V, d, dataset=dataset, gradient=gradient)

    def impact(self, V: float, d: float, *, dataset: str = "") -> Facts:  # noqa: N803
        """One impact with the fitted values in detail: ``Model.impact``."""
        return self._fitted.impact(V, d, dataset=dataset)

    @takes_options("diagnose")
    def diagnose(
        self,
        *,
        # made by ./run docs: arguments of diagnose
        seed: Optional[int] = None,
        threads: int = 0,
        # end
        progress: bool = True,
    ) -> "Diagnosis":
        """Finds systematic errors of the model and their causes, like ``recoil diagnose``."""
        options = given("diagnose", locals())
        return Diagnosis(self._compiled.diagnose(options, shows(progress)))

    @takes_options("predict")
    def predict(
        self,
        sizes: PathLike,
        *,
        # made by ./run docs: arguments of predict
        unit: Optional[str] = None,
        height_mm: Optional[Quantity] = None,
        midpoints: bool = False,
        dataset: Optional[str] = None,
        # end
        progress: bool = True,
    ) -> "Prediction":
        """Predicts the mean restitution of a mixture of sizes, like ``recoil predict``.

        ``sizes``: a CSV file with the columns diameter and count.
        """
        options = given("predict", locals())
        return Prediction(
            self._compiled.predict(path_of("sizes", sizes), options, shows(progress)))

    def to_pandas(self) -> "pandas.DataFrame":
        """The parameters as a frame: value, standard error, ends of the recommended interval and
        unit. Needs pandas."""
        import pandas

        rows = {}
        for name, one in self.params.items():
            lower, upper = one.interval or (None, None)
            rows[name] = {"value": one.value, "std_error": one.stderr, "lower": lower,
                          "upper": upper, "unit": one.unit}
        return pandas.DataFrame.from_dict(rows, orient="index")

    def draws(self) -> dict[str, dict[str, Array]]:
        """The draws of the posterior, in the format of ``arviz.from_dict(result.draws())``;
        ArviZ 0.x takes them as ``arviz.from_dict(**result.draws())``.

        The arrays [chain, draw] are ``posterior`` (parameters and capture velocities in SI units)
        and ``sample_stats`` (``lp``, ln posterior; ``log_likelihood``; ``log_prior``).
        ``log_likelihood`` [chain, draw, point] is that of every point; it is missing if points
        share errors or residuals are Student's t. ``observed_data`` contains the restitution.

        Raises ``InputError`` if the posterior was not sampled or has no draws."""
        import numpy

        if not self.facts.posterior:
            refuse("the posterior was not sampled", "fit with uncertainty={'posterior': True}")
        text, pointwise = self._compiled.posterior()
        names, *rows = csv.reader(io.StringIO(text))
        if not rows:
            refuse(self.facts.posterior.missing, "there are no draws")
        numbers = numpy.array([[float(cell or "nan") for cell in row] for row in rows])
        shape = (int(numbers[-1, 0]), int(numbers[-1, 1]))
        values = {name: numbers[:, k].reshape(shape) for k, name in enumerate(names)}
        stats = {name: values.pop(name) for name in ("log_likelihood", "log_prior")}
        stats["lp"] = stats["log_likelihood"] + stats["log_prior"]
        del values["chain"], values["draw"]
        found = {"posterior": values, "sample_stats": stats,
                 "observed_data": {"restitution": _column(self.residuals, "restitution")}}
        if pointwise:
            found["log_likelihood"] = {
                "restitution": numpy.array(pointwise).T.reshape(*shape, len(pointwise))}
        return found

    def save(self, folder: PathLike, *, replace: bool = False) -> Path:
        """Writes ``folder``/fit.json, and returns its path.

        Raises ``InputError`` for a file that this process has read, unless ``replace`` is true.
        """
        path = Path(path_of("folder", folder)) / "fit.json"
        _recoil.write_whole_files([(path, self._json)], flag_of("replace", replace))
        return path

    def save_page(self, file: PathLike, *, replace: bool = False) -> None:
        """Writes the page of ``recoil report``: one HTML file that contains its pictures.

        Raises ``InputError`` for a file that this process has read, a points.csv or a
        datapackage.json, unless ``replace`` is true.
        """
        path, replace = Path(path_of("file", file)), flag_of("replace", replace)
        _recoil.write_whole_files([(path, self._compiled.page())], replace)

    def plot(self, ax: "Optional[Axes]" = None, what: str = "fit", *, parameter: str = "") -> "Axes":
        """Draws with matplotlib on ``ax``, or on a new figure; returns the axes.

        ``what``: ``"fit"``: e against V with the errors of the points and the band of the curve,
        one colour per series. ``"residuals"``: weighted residuals against V. ``"profile"``: the
        rise of chi-square along ``parameter`` (the first free one by default) with the others
        refitted, and the rise at which the interval ends.
        """
        if ax is not None and not hasattr(ax, "errorbar"):
            refuse(f"ax is {type(ax).__name__}", "give axes of matplotlib")
        known = ("fit", "residuals", "profile")
        if text_of("what", what) not in known:
            refuse(f"what is {what!r}", f"choose one of {', '.join(known)}")
        if text_of("parameter", parameter) and what != "profile":
            refuse(f"parameter is given, and what is {what!r}", 'give what="profile"')
        if ax is None:
            import matplotlib.pyplot as plt

            ax = plt.figure().add_subplot()
        if what == "profile":
            self._draw_profile(ax, parameter)
        else:
            self._draw_points(ax, what)
        ax.legend()
        return ax

    def _draw_points(self, ax: "Axes", what: str) -> None:
        series = dict.fromkeys((row.dataset, row.series) for row in self.residuals)
        for number, one in enumerate(series):
            look: dict[str, Any] = {"fmt": "o", "color": f"C{number % 10}", "label": one[1] or one[0]}
            points = [r for r in self.residuals if (r.dataset, r.series) == one]
            velocity = _column(points, "incident_velocity")
            if what == "residuals":
                ax.errorbar(velocity, _column(points, "weighted_residual"), **look)
                continue
            ax.errorbar(velocity, _column(points, "restitution"),
                        yerr=_column(points, "sd_used"), **look)
            curve = [r for r in self.curve if (r.dataset, r.series) == one]
            velocity = _column(curve, "incident_velocity")
            ax.plot(velocity, _column(curve, "restitution"), color=look["color"])
            bands = [r.band or [None, None] for r in curve]
            lower, upper = (_numbers([band[end] for band in bands]) for end in (0, 1))
            ax.fill_between(velocity, lower, upper, color=look["color"], alpha=0.2, linewidth=0)
        ax.set(xscale="log", xlabel="incident velocity V [m/s]", ylabel="restitution e")
        if what == "residuals":
            ax.axhline(0.0, color="0.5", linewidth=1)
            ax.set(ylabel="weighted residual")

    def _draw_profile(self, ax: "Axes", parameter: str) -> None:
        profiles = self._compiled.profiles()
        if not profiles:
            refuse("no parameter is free", "there is no profile to plot")
        name = parameter or next(iter(profiles))
        if name not in profiles:
            refuse(f"parameter is {name!r}", f"choose one of {', '.join(profiles)}")
        value, rise, allowed = (_numbers(list(column)) for column in profiles[name])
        ax.plot(value, rise, "o-", color="C0")
        ax.plot(value, allowed, "--", color="0.5", label="where the interval ends")
        ax.axvline(self.parameters[name].value, color="0.5", linewidth=1)
        ax.set(xlabel=f"{name} [{self.parameters[name].unit}]", ylabel="rise of chi-square")

    plot_fit = plot

    # -- names of lmfit --

    @property
    def params(self) -> dict[str, Parameter]:
        """The parameters with ``value``, ``stderr``, ``vary``, ``min``, ``max``, ``init_value``."""
        stated = self.options.parameters
        return {name: Parameter(name, p, stated[name]) for name, p in self.parameters.items()}

    @property
    def var_names(self) -> list[str]:
        """The names of the free parameters."""
        return [name for name, p in self.parameters.items() if p.free]

    @property
    def best_values(self) -> dict[str, float]:
        """The values by name."""
        return {name: p.value for name, p in self.parameters.items()}

    @property
    def init_values(self) -> dict[str, float]:
        """The initial values by name."""
        return {name: p.initial for name, p in self.options.parameters.items()}

    @property
    def covar(self) -> Array:
        """Covariance of ``var_names``; NaN if missing."""
        rows, names = self.facts.covariance, self.var_names
        return _numbers([rows[a][b] for a in names for b in names]).reshape(len(names), len(names))

    @property
    def chisqr(self) -> float:
        """Sum of squares of the weighted residuals."""
        return float(self.goodness.chi2)

    @property
    def nfree(self) -> int:
        """Degrees of freedom."""
        return int(self.goodness.dof)

    @property
    def redchi(self) -> float:
        """``chisqr / nfree``; NaN without degrees of freedom."""
        return self.chisqr / self.nfree if self.nfree > 0 else float("nan")

    @property
    def ndata(self) -> int:
        """Number of points."""
        return int(self.dataset.points)

    @property
    def nvarys(self) -> int:
        """Number of free parameters."""
        return len(self.var_names)

    @property
    def success(self) -> bool:
        """False if the fit ended where some parameter has no effect (``solver.ended`` is ``flat``).
        A fit without a usable result raises ``ComputationError`` instead."""
        return bool(self.solver.ended != "flat")

    @property
    def residual(self) -> Array:
        """The weighted residuals of e^2, in the order of ``residuals``."""
        return _column(self.residuals, "weighted_residual")

    @property
    def best_fit(self) -> Array:
        """e of the model at every point [1], in the order of ``residuals``; 0: captured."""
        return _column(self.residuals, "predicted")

    def eval(self, V: npt.ArrayLike, d: npt.ArrayLike, *, dataset: str = "") -> Array:  # noqa: N803
        """e at ``V`` [m/s] and ``d`` [um] [1]; 0: captured."""
        return self.simulate(V, d, dataset=dataset).restitution

    def eval_band(self, V: npt.ArrayLike, d: npt.ArrayLike, *,  # noqa: N803
                  dataset: str = "") -> "tuple[Array, Array]":
        """The lower and the upper end of the band of ``eval(V, d)`` [1], pointwise at the level of
        the fit: quantiles over the replicates that give the bands of the page and of ``curve``.

        Raises ``InputError`` if the fit has too few replicates.
        """
        import numpy as np

        velocity, diameter = broadcast(V, d)
        lower, upper = np.full(velocity.shape, np.nan), np.full(velocity.shape, np.nan)
        for size in np.unique(diameter):
            at = diameter == size
            lower[at], upper[at] = self._compiled.band(
                velocity[at].tolist(), float(size), text_of("dataset", dataset))
        return lower, upper

    @property
    def aic(self) -> float:
        """-2 ln L + 2 ``nvarys``; NaN without stated standard deviations, because every fit then
        estimates its own noise (compare such fits by ``compare``)."""
        return self._criterion(2.0)

    @property
    def bic(self) -> float:
        """-2 ln L + ln(``ndata``) ``nvarys``; NaN where ``aic`` is."""
        return self._criterion(math.log(self.ndata))

    def _criterion(self, each: float) -> float:
        deviance = self.goodness.minus_two_log_likelihood
        return math.nan if deviance is None else float(deviance) + each * self.nvarys

    @property
    def rsquared(self) -> float:
        """1 - sum (e - ``best_fit``)^2 / sum (e - mean e)^2 over the points with a measured e [1];
        NaN if these have one value of e."""
        import numpy as np

        e = _column(self.residuals, "restitution")
        measured = np.isfinite(e)
        total = float(((e[measured] - e[measured].mean()) ** 2).sum()) if measured.any() else 0.0
        left = float(((e - self.best_fit)[measured] ** 2).sum())
        return 1.0 - left / total if total > 0.0 else math.nan

    def ci_report(self) -> str:
        """All intervals of the free parameters as a table in text."""
        found = self.conf_interval()
        kinds = [kind for kind in next(iter(found.values()), {})
                 if any(one[kind] for one in found.values())]
        rows = [["", "estimate", *kinds]]
        for name, intervals in found.items():
            ends = [f"[{one[0]:.3g}, {one[1]:.3g}]" if one else "-"
                    for one in (intervals[kind] for kind in kinds)]
            rows.append([f"{name} [{self.parameters[name].unit}]", f"{self.parameters[name].value:.3g}", *ends])
        widths = [max(len(row[k]) for row in rows) for k in range(len(rows[0]))]
        head = f"{100 * self.options.level:g} % intervals"
        return "\n".join([head, *("  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip()
                                  for row in rows)])

    def fit_report(self) -> str:
        """``report(verbose=True)``."""
        return self.report(verbose=True)

    def conf_interval(self) -> dict[str, dict[str, Optional[list[float]]]]:
        """Every interval of every free parameter, [lower, upper] or None, by name and kind."""
        kinds = ("wald", "profile", "percentile", "bca", "studentized", "posterior")
        return {name: {kind: self.parameters[name].intervals[kind] for kind in kinds}
                for name in self.var_names}

    # -- display --

    def __repr__(self) -> str:
        values = ", ".join(f"{name} = {self.parameters[name].value:.4g}" for name in self.var_names)
        return f"<recoil.FitResult {self.fit.id}: {values}>"


class Diagnosis(_Reported):
    """The systematic errors of a model and their causes. The keys of diagnosis.json are attributes
    (``verdict``, ``named``, ``candidates``); docs/diagnosis-json.md lists them."""

    model_verdict: Facts
    verdict: str
    headline: str
    text: str
    named: list[str]
    rivals: list[str]
    resembles: list[str]
    misfit: Facts
    candidates: list[Facts]
    gain: Optional[Facts]
    next_experiment: list[Facts]
    inseparable: list[Facts]
    warnings: list[str]

    def __str__(self) -> str:
        return _next(self._text, "result.save(folder) writes the extended model as a fit file; "
                                 "all details: result.report(verbose=True)")

    def save(self, folder: PathLike, *, replace: bool = False) -> Path:
        """Writes diagnosis.json and extended.toml (a fit file of the extended model) into
        ``folder``, and returns the path of the first.

        Raises ``InputError`` for a file that this process has read, unless ``replace`` is true.
        """
        path = Path(path_of("folder", folder)) / "diagnosis.json"
        extended = self._compiled.extended_toml(os.fspath(path.parent))
        _recoil.write_whole_files(
            [(path.with_name("extended.toml"), extended), (path, self._json)], flag_of("replace", replace))
        return path

    def __repr__(self) -> str:
        return f"<recoil.Diagnosis: {self.verdict} {', '.join(self.named)}>"


class Prediction(_WithPictures):
    """The prediction for a mixture of sizes. The keys of its JSON are attributes."""

    def __init__(self, predicted: _recoil.Predicted) -> None:
        self._json = predicted.json
        self._text = predicted.text
        self._pictures = predicted.pictures

    def __repr__(self) -> str:
        return f"<recoil.Prediction of {self.facts.fit}>"


class Comparison(_Result):
    """A comparison of fits: ``fits``, and ``quantities`` with the values of each fit."""

    def __init__(self, json_text: str, text: str) -> None:
        self._json, self._text = json_text, text

    def __iter__(self) -> Iterator[Facts]:
        return iter(self.facts.fits)


def frame_of(text: str) -> "pandas.DataFrame":
    """The text of a CSV file as a frame."""
    import pandas

    return pandas.read_csv(io.StringIO(text))


class Pairing(_Result):
    """Impacts found in passages. The keys of the JSON of ``recoil pair`` are attributes."""

    def __init__(self, texts: _recoil.PairTexts) -> None:
        self._points, self._impacts = texts.points, texts.impacts
        self._json = texts.json
        self._text = texts.text

    def to_pandas(self) -> "pandas.DataFrame":
        """The points as a frame for ``Dataset.from_pandas``: one row per point, with the columns
        of points.csv (diameters in um, velocities in m/s)."""
        return frame_of(self._points)

    def impacts_to_pandas(self) -> "pandas.DataFrame":
        """All impacts, and all passages that belong to none, as in ``recoil pair --impacts``."""
        return frame_of(self._impacts)

    def save(self, file: PathLike, *, replace: bool = False) -> Path:
        """Writes the points to ``file`` (CSV), like ``recoil pair --out``, and returns its path.

        Raises ``InputError`` if the file exists, unless ``replace`` is true.
        """
        path = Path(path_of("file", file))
        replace = flag_of("replace", replace)
        if not replace:
            refuse_to_replace(path)
        _recoil.write_whole_files([(path, self._points)], replace)
        return path

    def __repr__(self) -> str:
        return f"<recoil.Pairing: {self._points.count(chr(10)) - 1} points>"


__all__ = ["Comparison", "Diagnosis", "FitResult", "Pairing", "Parameter", "Prediction"]
