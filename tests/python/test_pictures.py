"""The report's pictures as SVG, and the one plot with matplotlib."""

import matplotlib.pyplot as plt
import numpy as np
import pytest
import recoil


@pytest.fixture(autouse=True)
def close_figures():
    yield
    plt.close("all")


def test_the_pictures_of_a_fit_are_those_of_its_report(here):
    result = recoil.fit("mine.toml")
    assert {"restitution-1", "restitution-2"} <= set(result.pictures)
    assert all(result.pictures.values()), "every picture has a title"
    drawn = result.svg("restitution-2")
    assert drawn.lstrip().startswith("<svg") and drawn.rstrip().endswith("</svg>")
    assert drawn != result.svg("restitution-1")


def test_every_result_with_pictures_draws_them(here, misfit):
    assert "<svg" in misfit.svg(next(iter(misfit.pictures)))
    result = recoil.fit("fits/li1999-sst65-silicon.toml", replicates=39)
    mixture = result.predict("datasets/li1999-sst65-silicon/sizes.csv")
    assert mixture.pictures and "<svg" in mixture.svg(next(iter(mixture.pictures)))


def test_a_picture_that_is_not_there_names_those_that_are(here):
    result = recoil.fit("mine.toml", replicates=0)
    with pytest.raises(ValueError, match="restitution-1"):
        result.svg("restitutoin")


def test_the_plot_shows_the_points_the_curve_and_its_band(here):
    result = recoil.fit("mine.toml")
    _, ax = plt.subplots()
    assert result.plot(ax) is ax
    ax.figure.canvas.draw()
    assert ax.get_xscale() == "log"
    assert "m/s" in ax.get_xlabel()
    assert ax.get_legend_handles_labels()[1] == ["a", "b"]
    shown = {tuple(xy) for line in ax.lines for xy in np.column_stack(line.get_data())}
    for point in result.residuals:
        assert (point.incident_velocity, point.restitution) in shown
    for row in result.curve:
        assert (row.incident_velocity, row.restitution) in shown
    assert sum(type(c).__name__ == "PolyCollection" for c in ax.collections) == 2, "two bands"
    assert recoil.fit("mine.toml", replicates=0).plot() is not ax, "on a figure of its own"
