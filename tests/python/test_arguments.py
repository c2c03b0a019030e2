"""Every argument of every function, with a value of every type: a result, or InputError."""

import inspect
import os

import numpy as np
import pytest
import recoil

circular = {}
circular["self"] = circular
looped = []
looped.append(looped)
VALUES = [
    None, True, 3, -1, 0.5, float("nan"), float("inf"), 10**400, 1e308, 2 + 3j, "", "x", "\ud800",
    "a\0b", b"bytes", [], {}, (), object(), lambda: 1, [1, 2], ["a", None], {"a": 1}, {1: {2: []}},
    circular, looped, np.int64(5), np.uint8(3), np.float32(0.5), np.float64("nan"), np.bool_(True),
    np.array([1.0, 2.0]), np.array(["a"]), np.array([1 + 2j]), np.array([True, False]),
    np.array([object()]), np.ma.array([1.0, 2.0], mask=[True, False]), np.array([[1.0, 2.0]]),
    np.array(3.0), np.datetime64("2020-01-01"), range(3), {1, 2}, -0.0,
    [float("inf"), 1.0], {"C_H": {"initial": np.float32(0.01)}}, {"C_H": None}, iter([1.0]),
]
V = np.array([0.5, 0.8, 1.0, 1.4, 5.0, 25.0])
E = np.array([0.1, 0.505, 0.705, 0.825, 0.937, 0.933])
QUICK = {"replicates": 0, "own_design": False}
pytestmark = pytest.mark.filterwarnings("ignore:.*masked point")


def functions(here):
    """Calls that work, by name: the function and its arguments."""
    fit = recoil.fit("mine.toml", replicates=0, threads=1)
    dataset = recoil.load_dataset("mine")
    (here / "sizes.csv").write_text("diameter,count\n1,2\n2,1\n")
    (here / "e.csv").write_text("time,velocity,diameter\n1,1,30\n1.00225,-0.8,30\n3,1,30\n3.00225,-0.8,30\n")
    arrays = dict(d=4.0, particle="polystyrene", surface="silicon", uncertainty=QUICK, threads=1)
    slopes = fit.simulate(2.0, 4.0, gradient=True)
    frame = pytest.importorskip("pandas").DataFrame(
        {"diameter": 4.0, "incident_velocity": V, "restitution": E})
    return {
        "from_pandas": (recoil.Dataset.from_pandas, dict(
            frame=frame, particle="polystyrene", surface="silicon", provenance="measured")),
        "gradient": (slopes.gradient, dict(name="C_H")),
        "diagnose": (fit.diagnose, dict(seed=1, threads=1)),
        "plot": (fit.plot, dict(what="fit")),
        "fit": (recoil.fit, dict(source=V, e=E, **arrays)),
        "fit of a file": (recoil.fit, dict(source="mine.toml", replicates=0, threads=1)),
        "from_arrays": (recoil.Dataset.from_arrays, dict(
            V=V, e=E, d=4.0, particle="polystyrene", surface="silicon", provenance="measured")),
        "load_dataset": (recoil.load_dataset, dict(folder="mine")),
        "model": (recoil.model, dict(source="mine.toml")),
        "coverage": (recoil.coverage, dict(source="mine.toml", datasets=1, replicates=19, threads=1)),
        "pair": (recoil.pair, dict(passages="e.csv", units={
            "time": "s", "velocity": "m/s", "diameter": "um"})),
        "schema": (recoil.schema, dict(name="fit")),
        "describe": (recoil.describe, dict(key="goodness.rmse", result="fit")),
        "simulate": (fit.simulate, dict(V=2.0, d=4.0)),
        "impact": (fit.impact, dict(V=2.0, d=4.0)),
        "predict": (fit.predict, dict(sizes="sizes.csv")),
        "svg": (fit.svg, dict(name="e")),
        "save": (fit.save, dict(folder="out")),
        "save_page": (fit.save_page, dict(file="out.html")),
        "save dataset": (dataset.save, dict(folder="copy", replace=True)),
    }


def unanswered(inputs, *options):
    """Instead of a fit: its arguments are read already."""
    raise recoil.ComputationError("no fit")


def test_every_type_of_every_argument(here, monkeypatch):
    tried = functions(here)
    monkeypatch.setattr(recoil._recoil, "fit", unanswered)
    monkeypatch.setattr(recoil._recoil, "coverage", unanswered)
    monkeypatch.setattr(recoil._recoil.Analysis, "diagnose", lambda self, *options: unanswered(self, options))
    for name, (function, arguments) in tried.items():
        parameters = inspect.signature(function).parameters
        for parameter in parameters.values():
            if parameter.kind is inspect.Parameter.VAR_KEYWORD:
                continue
            for value in VALUES:
                if isinstance(value, type(iter([]))):
                    value = iter([1.0])
                try:
                    function(**{**arguments, parameter.name: value})
                except (recoil.InputError, recoil.ComputationError) as error:
                    assert str(error) and "\n" not in str(error)
                except Exception as error:  # noqa: BLE001
                    pytest.fail(f"{name}({parameter.name}={value!r:.60}): {error!r:.200}")
    assert sorted(os.listdir(here / "mine")) == ["datapackage.json", "points.csv"]


def test_descriptors_are_no_files(here, capfd):
    for number in (0, 1, 2):
        with pytest.raises(recoil.InputError):
            recoil.compare(number, number)
        with pytest.raises(recoil.InputError):
            recoil.load_dataset(number)
    print("still open")
    assert "still open" in capfd.readouterr().out


def test_numbers_of_numpy_are_numbers(here):
    table = {"material": "polystyrene", "density": np.int64(1050), "youngs_modulus": np.float32(2.5e9),
             "poisson_ratio": np.float64(0.35)}
    one = recoil.fit(V, E, d=np.int32(4), particle=table, surface="silicon", threads=np.int8(1),
                     uncertainty={"replicates": np.int64(0), "seed": np.int64(5), "own_design": np.bool_(False)})
    same = recoil.fit(V, E, d=4.0, particle={**table, "density": 1050.0, "youngs_modulus": 2.5e9},
                      surface="silicon", threads=1,
                      uncertainty={"replicates": 0, "seed": 5, "own_design": False})
    assert one.parameters.C_H.value == same.parameters.C_H.value
