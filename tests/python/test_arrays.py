"""Fits of arrays and frames, their tables and their plots."""

import math

import numpy as np
import pandas as pd
import pytest
import recoil
from conftest import PARTICLE, SURFACE

V = [0.8, 1.0, 1.4, 2.4, 5.0, 12.0, 25.0]
E = [0.505, 0.705, 0.825, 0.909, 0.937, 0.930, 0.913]
BODIES = {"particle": PARTICLE, "surface": SURFACE}
FRAME = pd.DataFrame({"incident_velocity": V, "restitution": E, "restitution_sd": 0.015})


def saved(folder):
    """The same points as a dataset folder that the command reads."""
    lines = ["series,diameter,incident_velocity,restitution,restitution_sd"]
    lines += [f"one,4,{v},{e},0.015" for v, e in zip(V, E)]
    recoil.load_dataset("mine").save(folder)
    package = folder / "datapackage.json"
    text = package.read_text()
    for column in ("events", "captured"):
        start = text.rindex("{", 0, text.index(f'"{column}"'))
        stop = text.index("}", start) + 1
        text = text[:start].rstrip().rstrip(",") + text[stop:]
    package.write_text(text)
    (folder / "points.csv").write_text("\n".join(lines) + "\n")
    return folder


def test_arrays_frames_and_files_are_the_same_fit(here):
    of_arrays = recoil.fit(V, E, d=4, e_sd=0.015, replicates=0, **BODIES)
    of_frame = recoil.fit(FRAME, d=4, replicates=0, **BODIES)
    of_files = recoil.fit(saved(here / "one"), replicates=0)
    wanted = of_files.parameters.C_H.value, of_files.chisqr
    assert (of_arrays.parameters.C_H.value, of_arrays.chisqr) == wanted
    assert (of_frame.parameters.C_H.value, of_frame.chisqr) == wanted
    assert of_arrays.dataset.provenance == "measured"
    assert {row.series for row in of_arrays.residuals} == {"4 um"}
    short = FRAME.rename(columns={"incident_velocity": "V", "restitution": "e", "restitution_sd": "e_sd"})
    assert recoil.fit(short, d=4, replicates=0, **BODIES).dataset.sha256 == of_frame.dataset.sha256
    in_mm = short.assign(V=1000 * short["V"], d=4.0)
    found = recoil.fit(in_mm, units={"V": "mm/s"}, replicates=0, **BODIES)
    assert found.parameters.C_H.value == pytest.approx(wanted[0], rel=1e-9)
    of_series = recoil.fit(short["V"], short["e"], d=4, e_sd=short["e_sd"], replicates=0, **BODIES)
    assert of_series.dataset.sha256 == of_arrays.dataset.sha256


def test_materials_by_name():
    named = recoil.fit(np.array(V), np.array(E), d=4.0, particle="polystyrene", surface="silicon",
                       replicates=0)
    stated = recoil.Dataset.from_arrays(V, E, d=4.0, particle="polystyrene", surface="silicon")
    assert stated.package["recoil"]["particle"]["poisson_ratio"] == {"value": 0.33, "sd": 0.01}
    assert named.dataset.sha256 == stated.sha256
    with pytest.raises(recoil.InputError, match="particle 'polystirene'.*'polystyrene'"):
        recoil.fit(V, E, d=4, particle="polystirene", surface="silicon")


def test_captures_of_arrays():
    counted = recoil.Dataset.from_arrays(
        [0.4, *V], [math.nan, *E], d=4, events=20, captured=[20, *[0] * len(V)], **BODIES)
    assert counted.to_pandas()["captured"].tolist() == [20, *[0] * len(V)]
    assert math.isnan(counted.to_pandas()["restitution"][0])


@pytest.mark.parametrize(("arguments", "words"), [
    ({"d": None}, "d is not known"),
    ({"particle": None}, "particle is not known"),
    ({"d": [4, 5]}, "d has 2 entries; give 7 entries"),
    ({"e": E[:-1]}, "e has 6 entries"),
    ({"e": [*E[:-1], 1.7]}, r"entry 6 \(from 0\): restitution = 1.7"),
    ({"e": [*E[:-1], math.nan]}, r"e\[6\] is nan"),
    ({"e": [*E[:-1], "x"]}, "e has an entry that is no number"),
    ({"events": 2.5}, r"events\[0\] is 2.5"),
    ({"series": ["a"]}, "series has 1 entries"),
])
def test_a_mistake_names_the_argument(arguments, words):
    good = {"e": E, "d": 4, "particle": "glass", "surface": "steel"}
    given = {**good, **arguments}
    with pytest.raises(recoil.InputError, match=words):
        recoil.fit(V, given.pop("e"), **given)


@pytest.mark.parametrize(("source", "words"), [
    (FRAME, "particle is not known"),
    (V, "list is no fit file"),
    (np.array(V), "ndarray is no fit file"),
    ([], "list is no fit file"),
    (4.0, "float is no fit file"),
])
def test_a_source_that_is_none(source, words):
    with pytest.raises(recoil.InputError, match=words):
        recoil.fit(source)


def test_arguments_that_exclude_each_other(here):
    for wrong in ({"e": E}, {"e_sd": 0.01}):
        with pytest.raises(recoil.InputError, match="beside a frame"):
            recoil.fit(FRAME, d=4, **wrong, **BODIES)
    with pytest.raises(recoil.InputError, match="remove one"):
        recoil.fit(FRAME.assign(diameter=4.0), d=4, **BODIES)
    with pytest.raises(recoil.InputError, match="together with a file"):
        recoil.fit("mine.toml", particle="glass")
    with pytest.raises(recoil.InputError, match=r"entry 6 \(from 0\)"):
        recoil.fit(FRAME.assign(restitution=[*E[:-1], 1.7]), d=4, **BODIES)


def test_tables_are_frames():
    result = recoil.fit(FRAME, d=4, replicates=39, **BODIES)
    parameters = result.to_pandas()
    assert parameters.loc["C_H", "value"] == result.parameters.C_H.value
    assert parameters.loc["C_H", "lower"] <= parameters.loc["C_H", "value"]
    assert math.isnan(parameters.loc["f0", "lower"])
    residuals = result.residuals.to_pandas()
    assert residuals["incident_velocity"].tolist() == V
    assert len(result.curve.to_pandas()) == len(result.curve)


def test_prints_are_short():
    result = recoil.fit(FRAME, d=4, replicates=39, **BODIES)
    assert len(repr(result)) < 100
    assert len(str(result).splitlines()) < len(result.report(verbose=True).splitlines()) / 2
    assert set(dir(recoil)) == {*recoil.__all__, "__version__"}


def test_plots():
    result = recoil.fit(FRAME, d=4, replicates=39, **BODIES)
    residuals = result.plot(what="residuals")
    assert residuals.lines[0].get_xdata().tolist() == V
    profile = result.plot(what="profile", parameter="C_A").lines[0]
    value, rise = profile.get_xdata(), profile.get_ydata()
    assert abs(value[np.argmin(rise)] / result.parameters.C_A.value - 1) < 0.2
    # chi-square with C_A held, the rest refitted, over its least value
    exact = {**BODIES, "uncertainty": {"materials": True}}
    result = recoil.fit(FRAME, d=4, replicates=0, **exact)
    profile = result.plot(what="profile", parameter="C_A").lines[0]
    value, rise = profile.get_xdata(), profile.get_ydata()
    last = len(value) - 1
    held = recoil.fit(FRAME, d=4, replicates=0, **exact,
                      parameters={"C_A": {"free": False, "initial": float(value[last])}})
    assert held.chisqr - result.chisqr == pytest.approx(rise[last], rel=1e-3)
    with pytest.raises(recoil.InputError, match="choose one of C_H, C_A"):
        result.plot(what="profile", parameter="C_B")
    with pytest.raises(recoil.InputError, match="choose one of fit"):
        result.plot(what="everything")


def test_masked_points_are_left_out():
    bad = np.array(E)
    bad[2] = 0.1
    arguments = {"d": 4.0, "replicates": 0, "threads": 1, **BODIES}
    rest = recoil.fit(np.delete(V, 2), np.delete(E, 2), **arguments)
    with pytest.warns(UserWarning, match="1 masked point is left out"):
        masked = recoil.fit(V, np.ma.masked_less(bad, 0.3), **arguments)
    assert masked.json == rest.json
    # a mask of one argument and another one of another, beside values that are not masked
    sd = np.ma.masked_array(np.full(len(V), 0.015), mask=np.arange(len(V)) == 0)
    with pytest.warns(UserWarning, match="2 masked points are left out"):
        both = recoil.fit(np.ma.masked_greater(V, 20), E, e_sd=sd, **arguments)
    inner = recoil.fit(V[1:-1], E[1:-1], e_sd=0.015, **arguments)
    assert both.json == inner.json
    # what is masked may be anything
    with pytest.warns(UserWarning):
        recoil.fit(V, np.ma.masked_invalid([math.nan, *E[1:]]), **arguments)


@pytest.mark.parametrize(("arguments", "words"), [
    ({"e": np.array(E) + 0.1j}, "e has complex numbers"),
    ({"V": np.array(V, dtype=complex)}, "V has complex numbers"),
    ({"e": np.array(E) > 0.8}, "e has booleans"),
    ({"e": np.array(E, dtype=object)}, "e has an entry that is no number"),
    ({"V": np.array(V).astype(str)}, "V has an entry that is no number"),
    ({"e": [*E[:-1], None]}, "e has an entry that is no number"),
    ({"d": "4"}, "d has an entry that is no number"),
    ({"e": [E, E[:2]]}, "e has an entry that is no number"),
])
def test_what_numpy_would_make_another_number_of(arguments, words):
    good = {"V": V, "e": E, "d": 4, "particle": "glass", "surface": "steel"}
    given = {**good, **arguments}
    with pytest.raises(recoil.InputError, match=words):
        recoil.fit(given.pop("V"), given.pop("e"), **given)


def test_columns_of_a_frame_are_arrays():
    frame = pd.DataFrame({"V": V, "e": E})
    wanted = recoil.fit(V, E, d=4, replicates=0, **BODIES).json
    assert recoil.fit(frame.V, frame.e, d=4, replicates=0, **BODIES).json == wanted
    nullable = frame.convert_dtypes()
    assert recoil.fit(nullable.V, nullable.e, d=4, replicates=0, **BODIES).json == wanted


def test_numbers_of_numpy_are_numbers():
    glass = {"material": "glass", "density": np.int64(2500), "youngs_modulus": np.float64(70e9),
             "poisson_ratio": np.float32(0.25)}
    plain = {"material": "glass", "density": 2500, "youngs_modulus": 70e9, "poisson_ratio": 0.25}
    table = {"C_H": {"initial": np.float64(3e-3), "bounds": np.array([0.0, 1.0])}}
    one = recoil.fit(V, E, d=np.float32(4), particle=glass, surface="steel", parameters=table,
                     uncertainty={"seed": np.int64(5)}, replicates=np.int64(19), threads=np.int8(1))
    other = recoil.fit(V, E, d=4, particle=plain, surface="steel",
                       parameters={"C_H": {"initial": 3e-3, "bounds": [0.0, 1.0]}},
                       uncertainty={"seed": 5}, replicates=19, threads=1)
    assert one.json == other.json
    assert one.bootstrap.seed == 5
    simulated = one.simulate(np.float32(2), np.int64(4))
    assert simulated.restitution == one.simulate(2.0, 4.0).restitution


@pytest.mark.parametrize("density", [None, 2500 + 0j, "heavy", [2500, None], math.nan, 10**400])
def test_a_material_with_a_constant_that_is_none(density):
    with pytest.raises(recoil.InputError, match="density"):
        recoil.fit(V, E, d=4, surface="steel",
                   particle={"density": density, "youngs_modulus": 7e10, "poisson_ratio": 0.2})
