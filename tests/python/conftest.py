"""What the tests share: the built command, the shipped fits, small fits of their own."""

import json
import os
import subprocess
from pathlib import Path

import pytest

SOURCE = Path(os.environ["RECOIL_SOURCE"])
BINARY = os.environ["RECOIL_BINARY"]

# Two sizes of polystyrene on silicon: the base model with noise.
POINTS = """\
series,diameter,incident_velocity,restitution,restitution_sd,events,captured
a,2,1.6,0,0.015,20,20
a,2,2,0.492,0.015,20,0
a,2,2.4,0.651,0.015,20,0
a,2,3.2,0.761,0.015,20,0
a,2,8,0.866,0.015,20,0
a,2,25,0.900,0.015,20,0
b,4,0.65,0,0.015,20,20
b,4,0.8,0.505,0.015,20,0
b,4,1,0.705,0.015,20,0
b,4,1.4,0.825,0.015,20,0
b,4,5,0.937,0.015,20,0
b,4,25,0.933,0.015,20,0
"""
PACKAGE = {
    "name": "my-spheres",
    "title": "Polystyrene spheres on silicon (a synthetic example)",
    "resources": [{"name": "points", "path": "points.csv", "schema": {"fields": [
        {"name": "series", "type": "string"},
        {"name": "diameter", "type": "number", "unit": "um"},
        {"name": "incident_velocity", "type": "number", "unit": "m/s"},
        {"name": "restitution", "type": "number", "unit": "1"},
        {"name": "restitution_sd", "type": "number", "unit": "1"},
        {"name": "events", "type": "integer"},
        {"name": "captured", "type": "integer"}]}}],
    "recoil": {
        "provenance": "synthetic",
        "particle": {"material": "polystyrene", "density": 1050, "youngs_modulus": 2.56e9,
                     "poisson_ratio": 0.35},
        "surface": {"material": "silicon", "youngs_modulus": 131e9, "poisson_ratio": 0.28}}}
PARTICLE = PACKAGE["recoil"]["particle"]
SURFACE = PACKAGE["recoil"]["surface"]


def write_dataset(folder, points=POINTS, particle=PARTICLE):
    folder.mkdir()
    (folder / "points.csv").write_text(points)
    package = {"name": folder.name, "resources": PACKAGE["resources"],
               "recoil": {**PACKAGE["recoil"], "particle": particle}}
    (folder / "datapackage.json").write_text(json.dumps(package))


def too_little_at_high_velocity():
    """The points with a loss that the model does not have: a diagnosis goes through its search."""
    lines = POINTS.splitlines()
    for i, line in enumerate(lines[1:], 1):
        cells = line.split(",")
        cells[3] = f"{float(cells[3]) * (1 - 0.03 * float(cells[2]) ** 0.5):.3f}"
        lines[i] = ",".join(cells)
    return "\n".join(lines) + "\n"


def furnish(folder):
    for name in ("datasets", "fits"):
        (folder / name).symlink_to(SOURCE / name)
    write_dataset(folder / "mine")
    write_dataset(folder / "misfit", too_little_at_high_velocity())
    uncertain = {**PARTICLE, "youngs_modulus": {"value": 2.56e9, "sd": 0.5e9}}
    write_dataset(folder / "uncertain", POINTS, uncertain)
    for name in ("mine", "misfit", "uncertain"):
        (folder / f"{name}.toml").write_text(
            f'dataset = "{name}"\n[uncertainty]\nreplicates = 39\nown_design = false\n'
            # else constants or laws take it up
            + ("materials = false\n[diagnosis]\nlaw_error = 0.1\n" if name == "misfit" else ""))
    return folder


@pytest.fixture
def place(tmp_path):
    """A folder with the shipped datasets and fits, and small ones: `mine` (two sizes), `misfit`
    (not as the model has it) and `uncertain` (a constant of the materials with an error)."""
    return furnish(tmp_path)


@pytest.fixture(scope="session")
def fitted(tmp_path_factory):
    """The fit of `mine.toml`, made once."""
    import recoil

    return recoil.fit(furnish(tmp_path_factory.mktemp("fitted")) / "mine.toml")


@pytest.fixture(scope="session")
def misfit(tmp_path_factory):
    """The diagnosis of `misfit.toml`, which takes seconds, made once."""
    import recoil

    folder = furnish(tmp_path_factory.mktemp("misfit"))
    return recoil.fit(folder / "misfit.toml").diagnose()


class Outcome:
    def __init__(self, done):
        self.status, self.out, self.err = done.returncode, done.stdout, done.stderr


def command_in(folder):
    """Runs recoil in `folder`."""

    def run(*words):
        return Outcome(subprocess.run([BINARY, *map(str, words)], cwd=folder, text=True,
                                      capture_output=True, stdin=subprocess.DEVNULL))

    return run


@pytest.fixture
def command(place):
    """Runs recoil in `place`."""
    return command_in(place)


@pytest.fixture
def here(place, monkeypatch):
    """The same folder, gone into."""
    monkeypatch.chdir(place)
    return place
