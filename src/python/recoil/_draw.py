"""Pictures of the report, drawn with matplotlib."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any, Callable, Optional, Sequence, Union

import numpy as np

from ._facts import Facts

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_POINTS_PER_PIXEL = 0.75
_LETTER = 10.0  # the height of a letter [pt]
_DASHES: dict[str, Any] = {
    "solid": "-",
    "long_dashes": (0, (7, 3)),
    "dashes": "--",
    "dots": ":",
    "dash_dot": "-.",
}
_MARKS = {
    "dot": ("o", True),
    "circle": ("o", False),
    "square": ("s", True),
    "open_square": ("s", False),
    "triangle": ("^", True),
    "triangle_down": ("v", True),
    "open_triangle_down": ("v", False),
    "diamond": ("D", True),
    "cross": ("x", True),
}
_FORMULA = re.compile(r"\b(C_H|C_A|W_A|V_a)\b|\bf0\b")


def _set_symbols(text: str) -> str:
    """The model's symbols as formulas, the rest as it stands."""

    def formula(found: "re.Match[str]") -> str:
        name = found.group(1) or "f_0"
        return f"${name}$"

    return _FORMULA.sub(formula, text.replace("$", r"\$"))


def _numbers(values: Sequence[Optional[float]]) -> "np.ndarray[Any, np.dtype[np.float64]]":
    return np.array([np.nan if v is None else v for v in values], dtype=np.float64)


def _stroke(stroke: Facts) -> dict[str, Any]:
    return {
        "color": stroke.colour,
        "linewidth": stroke.width * _POINTS_PER_PIXEL,
        "linestyle": _DASHES[stroke.dash],
    }


def _marker(mark: str, colour: str, size: float) -> dict[str, Any]:
    shape, filled = _MARKS[mark]
    return {
        "marker": shape,
        "markersize": size * _LETTER,
        "markerfacecolor": colour if filled else "none",
        "markeredgecolor": colour,
    }


def _colour_map(plot: Facts) -> tuple[Any, Any]:
    from matplotlib.colors import LinearSegmentedColormap, Normalize

    scale = plot.colours
    first, last = scale.stops[0][0], scale.stops[-1][0]
    stops = [((at - first) / (last - first), colour) for at, colour in scale.stops]
    return LinearSegmentedColormap.from_list("recoil", stops), Normalize(*scale.range)


def _points(ax: "Axes", layer: Facts, plot: Facts) -> None:
    x, y = _numbers(layer.x), _numbers(layer.y)
    errors = None
    if layer.lower:
        errors = np.abs(np.array([y - _numbers(layer.lower), _numbers(layer.upper) - y]))
    ax.errorbar(
        x,
        y,
        yerr=errors,
        linestyle="none",
        ecolor=layer.colour,
        elinewidth=layer.width * _POINTS_PER_PIXEL,
        label=layer.name and _set_symbols(layer.name),
        **_marker(layer.mark, layer.colour, layer.size),
    )


def _line(ax: "Axes", layer: Facts, plot: Facts) -> None:
    mark = {}
    if layer.mark:
        mark = _marker(layer.mark, layer.stroke.colour, layer.size)
    ax.plot(
        _numbers(layer.x),
        _numbers(layer.y),
        label=layer.name and _set_symbols(layer.name),
        **_stroke(layer.stroke),
        **mark,
    )


def _band(ax: "Axes", layer: Facts, plot: Facts) -> None:
    ax.fill_between(
        _numbers(layer.x),
        _numbers(layer.lower),
        _numbers(layer.upper),
        color=layer.fill.colour,
        alpha=layer.fill.opacity,
        linewidth=0,
        label=layer.name and _set_symbols(layer.name),
    )


def _boxes(ax: "Axes", layer: Facts, plot: Facts) -> None:
    left, bottom = _numbers(layer.left), _numbers(layer.bottom)
    colours: Any = layer.fill.colour
    if layer["values"]:
        colour_map, norm = _colour_map(plot)
        colours = colour_map(norm(_numbers(layer["values"])))
    elif layer.colours:
        colours = layer.colours
    ax.bar(
        left,
        _numbers(layer.top) - bottom,
        _numbers(layer.right) - left,
        bottom,
        align="edge",
        color=colours,
        alpha=layer.fill.opacity,
        edgecolor="white" if layer.fill.rim else "none",
        linewidth=0.6 if layer.fill.rim else 0,
        label=layer.name and _set_symbols(layer.name),
    )


def _spans(ax: "Axes", layer: Facts, plot: Facts) -> None:
    lower, upper = _numbers(layer.lower), _numbers(layer.upper)
    middle = (lower + upper) / 2
    ax.errorbar(
        middle,
        _numbers(layer.y),
        xerr=[middle - lower, upper - middle],
        fmt="none",
        ecolor=layer.stroke.colour,
        elinewidth=layer.stroke.width * _POINTS_PER_PIXEL,
        capsize=4 if layer.stops else 0,
        label=layer.name and _set_symbols(layer.name),
    )


def _discs(ax: "Axes", layer: Facts, plot: Facts) -> None:
    colour_map, norm = _colour_map(plot)
    values = _numbers(layer["values"])
    largest = max(abs(norm.vmin), abs(norm.vmax))
    area = 20.0 + 380.0 * np.clip(np.abs(values) / largest, 0.0, 1.0)
    ax.scatter(
        _numbers(layer.x),
        _numbers(layer.y),
        s=area,
        c=values,
        cmap=colour_map,
        norm=norm,
        edgecolors="#6b6b6b",
        linewidths=0.5,
        label=layer.name and _set_symbols(layer.name),
    )


def _rule(ax: "Axes", layer: Facts, plot: Facts) -> None:
    draw = ax.axvline if layer.vertical else ax.axhline
    order = {"zorder": 5.0} if layer.in_front else {}
    draw(
        layer["at"],
        label=layer.name and _set_symbols(layer.name),
        **_stroke(layer.stroke),
        **order,
    )


def _contour(ax: "Axes", layer: Facts, plot: Facts) -> None:
    rows = np.array([_numbers(row) for row in layer.rows])
    (left, right), (bottom, top) = layer.x, layer.y
    ax.contour(
        np.linspace(left, right, rows.shape[1]),
        np.linspace(bottom, top, rows.shape[0]),
        rows,
        levels=[layer.level],
        colors=[layer.stroke.colour],
        linewidths=[layer.stroke.width * _POINTS_PER_PIXEL],
        linestyles=[_DASHES[layer.stroke.dash]],
    )
    if layer.name:
        ax.plot([], [], label=_set_symbols(layer.name), **_stroke(layer.stroke))


def _words(ax: "Axes", layer: Facts, plot: Facts) -> None:
    from matplotlib.transforms import blended_transform_factory

    transform = blended_transform_factory(
        ax.transAxes if layer.x.share else ax.transData,
        ax.transAxes if layer.y.share else ax.transData,
    )
    ax.annotate(
        _set_symbols(layer.text),
        (layer.x["at"], layer.y["at"]),
        xycoords=transform,
        xytext=(layer["shift"][0] * 0.6 * _LETTER, layer["shift"][1] * _LETTER),
        textcoords="offset points",
        ha=layer.align,
        va="center",
        fontsize=layer["size"] * _POINTS_PER_PIXEL,
        color=layer.colour,
        rotation=layer.turned,
        weight="bold" if layer.bold else "normal",
    )


def _region(ax: "Axes", layer: Facts, plot: Facts) -> None:
    from matplotlib.patches import Rectangle

    x, y = ax.get_xlim(), ax.get_ylim()
    left = x[0] if layer.left is None else layer.left
    right = x[1] if layer.right is None else layer.right
    bottom = y[0] if layer.bottom is None else layer.bottom
    top = y[1] if layer.top is None else layer.top
    ax.add_patch(
        Rectangle(
            (left, bottom),
            right - left,
            top - bottom,
            color=layer.fill.colour,
            alpha=layer.fill.opacity,
            linewidth=0,
            zorder=0.5,
            label=layer.name and _set_symbols(layer.name),
        )
    )
    ax.set_xlim(x)
    ax.set_ylim(y)


_LAYERS: dict[str, Callable[["Axes", Facts, Facts], None]] = {
    "points": _points,
    "line": _line,
    "band": _band,
    "boxes": _boxes,
    "spans": _spans,
    "discs": _discs,
    "rule": _rule,
    "contour": _contour,
    "words": _words,
}


def _axis(ax: "Axes", which: str, axis: Facts) -> None:
    """Limits and looks, after the layers: an end that is not stated is where they end."""
    set_limits = ax.set_xlim if which == "x" else ax.set_ylim
    drawn = ax.xaxis if which == "x" else ax.yaxis
    ends = ("left", "right") if which == "x" else ("bottom", "top")
    limits = dict(zip(ends, (axis["from"], axis.to)))
    set_limits(**{end: at for end, at in limits.items() if at is not None})
    drawn.set_label_text(_set_symbols(axis.title) if axis.shown else "")
    if axis.ticks:
        drawn.set_ticks([tick["at"] for tick in axis.ticks],
                        [_set_symbols(tick.label) for tick in axis.ticks])
        drawn.set_minor_locator(_no_ticks())
    if not axis.shown:
        ax.tick_params(which, **{"labelbottom" if which == "x" else "labelleft": False})
    if axis.upright:
        ax.tick_params(which, rotation=90)
    if axis.grid:
        ax.grid(True, axis="x" if which == "x" else "y", color="#dddddd", linewidth=0.5)


def _no_ticks() -> Any:
    from matplotlib.ticker import NullLocator

    return NullLocator()


def _legend(ax: "Axes", place: str, own: bool) -> None:
    names = ax.get_legend_handles_labels()[1]
    looks: dict[str, Any] = {"fontsize": "small", "frameon": False}
    if names and own and place in ("below", "above"):
        columns = 3 if max(map(len, names)) < 24 else 2
        ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.18), ncol=columns, **looks)
    elif names:
        ax.legend(loc=place if place in ("lower right", "upper right") else "best", **looks)


def _draw_plot(ax: "Axes", plot: Facts) -> None:
    ax.set_axisbelow(True)
    if plot.x.logarithmic:
        ax.set_xscale("log")
    if plot.y.logarithmic:
        ax.set_yscale("log")
    for layer in plot.layers:
        if layer.kind != "region":
            _LAYERS[layer.kind](ax, layer, plot)
    for which in ("x", "y"):
        _axis(ax, which, plot[which])
    for layer in plot.layers:
        if layer.kind == "region":
            _region(ax, layer, plot)
    title = _set_symbols(plot.heading)
    if plot.remark:
        title += ("\n" if title else "") + _set_symbols(plot.remark)
    ax.set_title(title, fontsize="medium")
    if plot.bare:
        ax.set_axis_off()


def draw(
    picture: Facts, ax: Union["Axes", Sequence["Axes"], None] = None
) -> Union["Axes", list["Axes"]]:
    """Draws ``picture`` on ``ax``, or on a figure of its own where that is None.

    Of a picture of several plots ``ax`` has as many axes, and a list of them is returned.
    """
    plots = picture.plots
    if ax is None:
        import matplotlib.pyplot as plt

        figure = plt.figure(figsize=(picture.width / 80, picture.height / 80))
        if len(plots) == 1:
            axes = [figure.add_subplot()]
            figure.set_layout_engine("constrained")
        else:
            axes = [figure.add_axes(_frame(plot, picture)) for plot in plots]
    else:
        axes = list(ax) if isinstance(ax, (list, tuple, np.ndarray)) else [ax]
    if len(axes) != len(plots):
        raise ValueError(f"{picture.name} has {len(plots)} plots, and ax has {len(axes)} axes")
    for number, (one, plot) in enumerate(zip(axes, plots)):
        _draw_plot(one, plot)
        if plot.key != "none":
            _legend(one, plot.key, ax is None and len(plots) == 1)
        elif picture.key != "none" and number == 0:
            _legend(one, "best", False)
    return axes[0] if len(plots) == 1 else axes


def _frame(plot: Facts, picture: Facts) -> tuple[float, float, float, float]:
    left, bottom, right, top = plot.frame or (60, 50, picture.width - 10, picture.height - 40)
    wide, high = picture.width, picture.height
    return (left / wide, bottom / high, (right - left) / wide, (top - bottom) / high)
