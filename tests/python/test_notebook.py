"""The notebook: valid, with its outputs, and every cell runs and prints what is committed."""

import ast
import json
from pathlib import Path

import matplotlib.pyplot as plt
import nbformat
import pandas
import pytest
from conftest import SOURCE

TOUR = SOURCE / "docs/tour.ipynb"


@pytest.fixture(autouse=True)
def close_figures():
    yield
    plt.close("all")


def test_the_tour_is_a_notebook_that_ran_from_the_first_cell_to_the_last():
    tour = nbformat.read(TOUR, as_version=nbformat.NO_CONVERT)
    nbformat.validate(tour)
    code = [cell for cell in tour.cells if cell.cell_type == "code"]
    assert [cell.execution_count for cell in code] == list(range(1, len(code) + 1))
    kinds = [output.output_type for cell in code for output in cell.outputs]
    assert "error" not in kinds and kinds.count("display_data") >= 3
    assert all(output.get("name") != "stderr" for cell in code for output in cell.outputs)


def run_cell(source, names):
    """As a notebook does: the last expression, unless it ends with a semicolon, is shown."""
    tree = ast.parse(source)
    last = None
    if isinstance(tree.body[-1], ast.Expr):
        last = ast.Expression(tree.body.pop().value)
    exec(compile(tree, "<cell>", "exec"), names)
    shown = eval(compile(last, "<cell>", "eval"), names) if last else None
    return None if source.rstrip().endswith(";") else shown


def test_every_cell_of_the_tour_prints_what_is_committed(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    names = {}
    for cell in json.loads(TOUR.read_text())["cells"]:
        if cell["cell_type"] != "code":
            continue
        capsys.readouterr()
        run_cell("".join(cell["source"]), names)
        for number in plt.get_fignums():
            plt.figure(number).canvas.draw()
        streams = [o for o in cell["outputs"] if o["output_type"] == "stream"]
        assert capsys.readouterr().out == "".join("".join(o["text"]) for o in streams)
    assert Path("my-result/fit.json").is_file()
    assert "<svg" in Path("my-result/my-spheres.html").read_text()


def test_its_points_are_those_of_the_tutorial(tmp_path):
    text = (SOURCE / "docs/tutorial.md").read_text().split("```csv\n")[1].split("```")[0]
    (tmp_path / "measured.csv").write_text(text)
    wanted = pandas.read_csv(tmp_path / "measured.csv")
    names = {"pd": pandas}
    source = next("".join(c["source"]) for c in json.loads(TOUR.read_text())["cells"]
                  if "".join(c["source"]).startswith("points ="))
    run_cell(source, names)
    found = names["points"][["diameter", "incident_velocity", "restitution", "restitution_sd",
                             "events", "captured"]]
    found.columns = wanted.columns
    pandas.testing.assert_frame_equal(found, wanted, check_dtype=False)
