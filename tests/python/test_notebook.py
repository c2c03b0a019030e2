"""The tour as a notebook: valid, without outputs, and every cell runs from the first to the last."""

import ast
import json
from pathlib import Path

import matplotlib.pyplot as plt
import nbformat
import pytest
from conftest import SOURCE

TOUR = SOURCE / "docs/tour.ipynb"


@pytest.fixture(autouse=True)
def close_figures():
    yield
    plt.close("all")


def test_the_tour_is_a_notebook_without_outputs():
    tour = nbformat.read(TOUR, as_version=nbformat.NO_CONVERT)
    nbformat.validate(tour)
    for cell in tour.cells:
        assert cell.cell_type != "code" or (cell.outputs == [] and cell.execution_count is None)


def run_cell(source, names):
    """As a notebook does: the last expression, unless it ends with a semicolon, is shown."""
    tree = ast.parse(source)
    last = None
    if isinstance(tree.body[-1], ast.Expr):
        last = ast.Expression(tree.body.pop().value)
    exec(compile(tree, "<cell>", "exec"), names)
    shown = eval(compile(last, "<cell>", "eval"), names) if last else None
    return None if source.rstrip().endswith(";") else shown


def test_every_cell_of_the_tour_runs(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    names, shown = {}, []
    for cell in json.loads(TOUR.read_text())["cells"]:
        if cell["cell_type"] != "code":
            continue
        value = run_cell("".join(cell["source"]), names)
        if value is not None:
            shown.append(getattr(value, "_repr_html_", value.__repr__)())
        for number in plt.get_fignums():
            plt.figure(number).canvas.draw()
    assert any("<i>C</i><sub>H</sub>" in page for page in shown)
    assert Path("my-result/fit.json").is_file()
    assert "<svg" in Path("my-result/my-spheres.html").read_text()
    readme = (SOURCE / "README.md").read_text()
    rows = readme.split("```csv\n")[1].split("```")[0].splitlines()[1:]
    found = names["data"].to_pandas()
    assert len(rows) == len(found)
    for row, (_, point) in zip(rows, found.iterrows()):  # the same points as in the README's tour
        series, d, v, e, sd, events, captured = row.split(",")
        assert series == point.series and int(events) == point.events
        assert (float(d), float(v), float(e), float(sd), int(captured)) == (
            point.diameter, point.incident_velocity, point.restitution, point.restitution_sd,
            point.captured)
