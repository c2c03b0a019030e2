"""recoil.pair: the command's digits, frames and mistakes."""

import io
import json
import math
import random

import pytest
import recoil

UNITS = {"time": "s", "velocity": "m/s", "diameter": "um"}


def passages(spheres=400, height=1e-3, e=0.7):
    """Spheres that fall through the plane one after the other, hit, and come up again: velocities
    at the plane from those at the surface, v^2 = v_s^2 - 2 g h, measured to 1 %."""
    g = 9.80665
    random.seed(7)
    rows = []
    time = 0.0
    for _ in range(spheres):
        time += random.expovariate(1 / 0.5)
        down = random.uniform(0.8, 3.0)
        diameter = random.uniform(20.0, 60.0)
        hit = math.sqrt(down**2 + 2 * g * height)
        left = e * hit * (1 + random.gauss(0, 0.01))
        up = math.sqrt(left**2 - 2 * g * height)
        flight = (hit - down) / g + (left - up) / g
        rows.append((time, down * (1 + random.gauss(0, 0.01)), diameter))
        rows.append((time + flight, -up * (1 + random.gauss(0, 0.01)),
                     diameter * (1 + random.gauss(0, 0.01))))
    rows.sort()
    return "time,velocity,diameter\n" + "".join(f"{t:.9f},{v:.6f},{d:.4f}\n" for t, v, d in rows)


@pytest.fixture
def run7(here):
    (here / "run7.csv").write_text(passages())
    return "run7.csv"


def test_the_digits_are_the_commands(run7, here, command):
    found = recoil.pair(run7, units=UNITS, size_edges=[20, 40, 60], per_bin=30)
    done = command("pair", run7, "--unit", "time=s,velocity=m/s,diameter=um", "--size-edges",
                   "20,40,60", "--per-bin", 30, "--json", "--out", "points.csv", "--impacts",
                   "impacts.csv")
    assert done.status == 0, done.err
    assert found.json == done.out
    assert found.save("mine.csv").read_text() == (here / "points.csv").read_text()
    told = command("pair", run7, "--unit", "time=s,velocity=m/s,diameter=um", "--size-edges",
                   "20,40,60", "--per-bin", 30)
    assert str(found) == told.out
    pandas = pytest.importorskip("pandas")
    impacts = pandas.read_csv(io.StringIO((here / "impacts.csv").read_text()))
    assert found.impacts_to_pandas().equals(impacts)
    assert len(found.to_pandas()) == len(found.points)


def test_what_was_put_in_is_found(run7):
    found = recoil.pair(run7, units=UNITS)
    frame = found.to_pandas()
    assert abs(frame.restitution.mean() - 0.7) < 0.01
    data = recoil.Dataset.from_pandas(
        frame, "run7", provenance="synthetic", like=recoil.load_dataset("datasets/wall1990-mica"))
    assert len(data) == len(frame)


MISTAKES = [
    ({"positive": "up"}, "towards, away"),
    ({"height": 0.0}, "0.001 to 1000"),
    ({"size_edges": [40, 20]}, "ascend"),
    ({"size_edges": [20]}, "two limits"),
    ({"size_edges": [20, 40], "size_classes": 2}, "remove one"),
    ({"per_bin": 1}, "2 to"),
    ({"units": {**UNITS, "speed": "m/s"}}, ""),
    ({"units": {**UNITS, "time": "week"}}, ""),
]


@pytest.mark.parametrize("options, words", MISTAKES)
def test_a_mistake_is_an_input_error(run7, options, words):
    with pytest.raises(recoil.InputError) as caught:
        recoil.pair(run7, **{"units": UNITS, **options})
    assert words in caught.value.suggestion


def test_a_file_without_impacts(here):
    (here / "falling.csv").write_text("time,velocity,diameter\n0,1,20\n1,1,20\n2,1,20\n")
    with pytest.raises(recoil.ComputationError) as caught:
        recoil.pair("falling.csv", units=UNITS)
    assert "--" not in str(caught.value)
    with pytest.raises(recoil.InputError):
        recoil.pair("nowhere.csv", units=UNITS)


def test_the_schema_holds(run7):
    jsonschema = pytest.importorskip("jsonschema")
    found = recoil.pair(run7, units=UNITS)
    jsonschema.validate(json.loads(found.json), recoil.schema("pair"))
