"""The report's pictures with matplotlib: every one draws, and shows the numbers of the fit."""

import matplotlib.pyplot as plt
import numpy as np
import pytest
import recoil


@pytest.fixture(autouse=True)
def close_figures():
    yield
    plt.close("all")


def drawn(axes):
    """The axes, rendered."""
    first = axes[0] if isinstance(axes, list) else axes
    first.figure.canvas.draw()
    return axes


def test_every_picture_of_a_fit_has_a_method_and_draws(here):
    for fit in ("fits/wall1990-all.toml", "fits/li1999-sst65-silicon.toml", "uncertain.toml"):
        result = recoil.fit(fit, replicates=39)
        assert result.pictures
        for name in result.pictures:
            result.plot_picture(name)
            method = "plot_" + name.rstrip("0123456789").rstrip("-").replace("-", "_")
            assert callable(getattr(result, method)), name
            plt.close("all")


def test_every_picture_of_a_diagnosis_and_of_a_mixture_draws(here, misfit):
    for method in (misfit.plot_misfit, misfit.plot_ranking, misfit.plot_before_after):
        drawn(method())
    result = recoil.fit("fits/li1999-sst65-silicon.toml", replicates=39)
    mixture = result.predict("datasets/li1999-sst65-silicon/sizes.csv")
    for method in (mixture.plot_average, mixture.plot_sizes, mixture.plot_captured):
        drawn(method())


def test_restitution_shows_the_points_and_the_curve(here):
    result = recoil.fit("mine.toml")
    figure, ax = plt.subplots()
    assert result.plot_restitution(ax=ax) is ax
    drawn(ax)
    assert ax.get_xscale() == "log"
    assert "m/s" in ax.get_xlabel()
    assert "2" in ax.get_title()
    names = ax.get_legend_handles_labels()[1]
    assert "fit to all points" in names
    shown = {tuple(xy) for line in ax.lines for xy in np.column_stack(line.get_data())}
    for point in result.residuals[1:6]:
        assert (point.incident_velocity, point.restitution) in shown
    curve = next(line for line in ax.lines if line.get_label() == "fit to all points")
    rows = {(r.incident_velocity, r.restitution) for r in result.curve if r.diameter_um == 2.0}
    assert rows and {tuple(xy) for xy in np.column_stack(curve.get_data())} <= rows
    # the capture velocity, as a rule
    rules = [line.get_xdata()[0] for line in ax.lines if len(set(line.get_xdata())) == 1]
    assert result.derived.capture_velocity[0].value in rules
    other = result.plot_restitution(2)
    assert other is not ax and "4" in other.get_title()


def test_a_picture_that_is_not_there_says_so(here):
    result = recoil.fit("mine.toml", replicates=0)
    with pytest.raises(ValueError, match="no picture restitution number 3: there are 2"):
        result.plot_restitution(3)
    with pytest.raises(ValueError, match="this result has none"):
        result.plot_mixture_average()
    with pytest.raises(ValueError, match="there are restitution-1"):
        result.plot_picture("restitutoin")
