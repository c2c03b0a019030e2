"""Impacts of a model: digits, shapes, slopes, what has no answer."""

import json

import numpy as np
import pytest
import recoil


@pytest.fixture
def result(fitted):
    return fitted


def test_one_impact_is_the_commands(here, command, result):
    path = result.save("result")
    done = command("simulate", "mine.toml", "--velocity", 3, "--diameter", 2, "--parameters", path,
                   "--json")
    wanted = json.loads(done.out)
    found = result.impact(3, 2)
    assert {**found, "values_from": str(path)} == wanted
    assert result.simulate(3.0, 2.0).restitution == pytest.approx(wanted["restitution"], abs=1e-8)
    model = recoil.model("mine.toml", fitted=path)
    assert model.impact(3, 2) == wanted
    assert model.parameters["C_H"] == result.parameters.C_H.value
    assert recoil.model("mine.toml").parameters["C_H"] == 0.003


def test_energy_is_conserved(result):
    for velocity in (0.2, 1.0, 5.0, 30.0):
        energy = result.impact(velocity, 4.0).contact.energy_J
        parts = sum(value for name, value in energy.items() if name != "incident")
        assert parts == pytest.approx(energy.incident, rel=1e-6)


def test_shapes_are_those_of_numpy(result):
    v, d = np.geomspace(0.5, 50, 7), np.array([[2.0], [4.0], [8.0]])
    many = result.simulate(v, d, gradient=True)
    assert many.restitution.shape == many.captured.shape == (3, 7)
    assert many.slopes["C_H"].shape == many.gradient("C_A").shape == (3, 7)
    for i in range(3):
        for k in range(7):
            one = result.simulate(v[k], d[i, 0])
            assert one.restitution.shape == ()
            # all of them fly together: the last digits depend on the company
            assert one.restitution_squared == pytest.approx(many.restitution_squared[i, k],
                                                            abs=1e-9)
    assert result.simulate([], []).restitution.shape == (0,)
    assert result.simulate(v[::2], 4).restitution == pytest.approx(many.restitution[1, ::2],
                                                                  abs=1e-8)


def test_captured_spheres_have_e_zero_and_a_square_below(result):
    capture = next(c for c in result.derived.capture_velocity if abs(c.diameter_um - 4) < 1e-6)
    slow, fast = result.simulate(np.array([0.99, 1.01]) * capture.value, 4.0).captured
    assert slow and not fast
    below = result.simulate(0.9 * capture.value, 4.0, gradient=True)
    assert below.restitution == 0 and below.restitution_squared < 0
    assert below.gradient("C_H") == 0 and below.slopes["C_H"] != 0


@pytest.mark.parametrize("velocity", [0.7, 1.0, 4.0, 30.0])
def test_slopes_are_those_of_differences(here, velocity):
    tables = {"parameters": {"C_H": {"initial": 2e-3}, "C_A": {"initial": 2e-2}}}
    at = recoil.model("mine", **tables).simulate(velocity, 4.0, gradient=True)

    def square(v=velocity, d=4.0, **values):
        moved = {n: {"initial": values.get(n, t["initial"])}
                 for n, t in tables["parameters"].items()}
        return recoil.model("mine", parameters=moved).simulate(v, d).restitution_squared

    for name, value in (("C_H", 2e-3), ("C_A", 2e-2)):
        step = 1e-3 * value
        slope = (square(**{name: value + step}) - square(**{name: value - step})) / (2 * step)
        assert at.slopes[name] == pytest.approx(slope, rel=1e-4, abs=1e-6), name
    slope = (square(v=velocity * 1.001) - square(v=velocity * 0.999)) / (0.002 * velocity)
    assert at.slopes["incident_velocity"] == pytest.approx(slope, rel=1e-4, abs=1e-6)
    slope = (square(d=4.004) - square(d=3.996)) / 0.008
    assert at.slopes["diameter_um"] == pytest.approx(slope, rel=1e-4, abs=1e-6)


def test_which_dataset(here):
    model = recoil.model("fits/wall1990-all.toml")
    ids = ["wall1990-molybdenum", "wall1990-silicon", "wall1990-mica"]
    e = [float(model.simulate(4.0, 4.9, dataset=name).restitution) for name in ids]
    assert len(set(e)) == 3
    assert float(model.simulate(4.0, 4.9).restitution) in e
    with pytest.raises(recoil.InputError, match="did you mean wall1990-mica"):
        model.simulate(4.0, 4.9, dataset="wall1990-mika")


@pytest.mark.parametrize("v, d, word", [
    (0.0, 4.0, "velocity of impact 0"), (-1.0, 4.0, "velocity"), (np.nan, 4.0, "velocity"),
    (np.inf, 4.0, "velocity"), ([1.0, 2e4], 4.0, "velocity of impact 1"),
    (1.0, 0.0, "diameter of impact 0"), (1.0, [4.0, np.nan], "diameter of impact 1"),
])
def test_what_is_no_velocity_or_diameter_is_refused(result, v, d, word):
    with pytest.raises(recoil.InputError, match=word):
        result.simulate(v, d)


def test_shapes_that_do_not_fit_are_refused(result):
    with pytest.raises(ValueError):
        result.simulate([1.0, 2.0], [1.0, 2.0, 3.0])
    with pytest.raises(ValueError, match="gradient=True"):
        result.simulate(1.0, 2.0).gradient("C_H")
