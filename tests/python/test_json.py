"""--json and its schemas: what every command prints is valid, and what is not valid is noticed."""

import copy
import json
import re

import jsonschema
import pytest
from conftest import SOURCE, command_in, furnish

RESULTS = {
    "fit": [
        ["fit", "mine.toml"],
        ["fit", "mine.toml", "--replicates", "0"],
        ["fit", "uncertain.toml"],
        ["fit", "posterior.toml"],
        ["fit", "mechanism.toml"],
        ["fit", "fixed.toml"],
        ["fit", "unstated.toml"],
        ["fit", "fits/wall1990-all.toml", "--replicates", "19"],
        ["fit", "fits/dahneke1975-quartz.toml", "--replicates", "19"],
        ["fit", "unstated.toml", "--replicates", "auto"],
    ],
    "diagnosis": [
        ["diagnose", "misfit.toml"],
        ["diagnose", "fits/dahneke1975-quartz.toml"],
        ["diagnose", "fits/li1999-sst125-silicon.toml"],
    ],
    "predict": [
        ["predict", "fits/li1999-sst65-silicon.toml", "--replicates", "39", "--sizes",
         "datasets/li1999-sst65-silicon/sizes.csv"],
        ["predict", "mine.toml", "--replicates", "0", "--sizes", "sizes.csv"],
    ],
    "simulate": [
        ["simulate", "mine.toml", "--velocity", "5", "--diameter", "4"],
        ["simulate", "mine.toml", "--velocity", "0.1", "--diameter", "4"],
        ["simulate", "maugis.toml", "--velocity", "5", "--diameter", "4"],
        ["simulate", "mechanism.toml", "--velocity", "5", "--diameter", "4.9"],
    ],
    "coverage": [["coverage", "mine.toml", "--datasets", "3", "--replicates", "19"]],
    "compare": [["compare", "one.json", "two.json"]],
    "plan": [
        ["plan", "mine.toml"],
        ["plan", "maugis.toml", "--impacts", "300", "--diameter", "1,4"],
        ["plan", "fits/wall1990-all.toml", "--impacts", "2000"],
    ],
    "pair": [["pair", "events.csv", "--unit", "time=s,velocity=m/s,diameter=um"]],
}


def schema(name):
    return json.loads((SOURCE / "schemas" / f"{name}.schema.json").read_text())


def validator(name):
    return jsonschema.Draft202012Validator(schema(name))


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    """The files that the commands need, made once."""
    place = furnish(tmp_path_factory.mktemp("json"))
    command = command_in(place)
    head = 'dataset = "mine"\n[uncertainty]\nreplicates = 39\nown_design = false\n'
    (place / "maugis.toml").write_text(head + '[model]\nadhesion = "maugis"\n')
    (place / "posterior.toml").write_text(head + "posterior = true\n")
    (place / "fixed.toml").write_text(head + "[parameters]\nC_A = { free = false }\n")
    (place / "mechanism.toml").write_text(
        'dataset = "datasets/wall1990-molybdenum"\n[uncertainty]\nreplicates = 39\n'
        'own_design = false\n'
        '[model]\nmechanisms = ["plastic_yield"]\n')
    (place / "sizes.csv").write_text("diameter,count\n2,5\n3,8\n4,2\n")
    package = json.loads((place / "mine/datapackage.json").read_text())
    fields = package["resources"][0]["schema"]["fields"]
    package["resources"][0]["schema"]["fields"] = [f for f in fields
                                                   if f["name"] != "restitution_sd"]
    package["name"] = "unstated"
    (place / "unstated").mkdir()
    (place / "unstated/datapackage.json").write_text(json.dumps(package))
    rows = [r.split(",") for r in (place / "mine/points.csv").read_text().splitlines()]
    (place / "unstated/points.csv").write_text(
        "".join(",".join(r[:4] + r[5:]) + "\n" for r in rows))
    (place / "unstated.toml").write_text(head.replace("mine", "unstated"))
    for name, adhesion in (("one", "ring"), ("two", "jkr")):
        (place / f"{name}.toml").write_text(head + f'[model]\nadhesion = "{adhesion}"\n')
        (place / f"{name}.json").write_text(command("fit", f"{name}.toml", "--json").out)
    rows = ["time,velocity,diameter"]
    for i in range(60):  # down at 1 m/s, back at 0.8 m/s from a plane 1 mm above the surface
        rows += [f"{10 * i},1,50", f"{10 * i + 0.00225},-0.8,50"]
    (place / "events.csv").write_text("\n".join(rows) + "\n")
    return place


@pytest.mark.parametrize("name, words", [(n, w) for n in RESULTS for w in RESULTS[n]],
                         ids=lambda x: x if isinstance(x, str) else "-".join(x[:2]))
def test_stdout_is_valid_json_and_nothing_else(command, name, words):
    done = command(*words, "--json")
    assert done.status == 0, done.err
    found = json.loads(done.out)
    errors = [f"{list(e.absolute_path)}: {e.message[:200]}"
              for e in validator(name).iter_errors(found)]
    assert not errors
    assert found["format_version"] == 2
    # what else there is to say goes to stderr: of these only one has something
    assert ("note: without --height" in done.err) == ("sizes.csv" in words)
    notes = [line for line in done.err.splitlines() if not line.endswith("s left")]  # progress
    assert len(notes) == ("sizes.csv" in words)


@pytest.mark.parametrize("name", RESULTS)
def test_schemas_are_schemas_and_close_every_object(name):
    found = schema(name)
    jsonschema.Draft202012Validator.check_schema(found)
    assert found["$id"] == f"recoil:{name}.schema.json"

    def look(node, where):
        if not isinstance(node, dict):
            return
        if "properties" in node:
            assert node["additionalProperties"] is False, where
            assert set(node.get("required", [])) <= set(node["properties"]), where
        for key, inner in node.items():
            for item in inner if isinstance(inner, list) else [inner]:
                look(item, f"{where}/{key}")

    look(found, name)


@pytest.mark.parametrize("name", ["fit", "diagnosis"])
def test_the_manual_has_every_key_of_the_schema(name):
    pages = sorted((SOURCE / "docs").glob(f"{name}-json*.md"))
    page = set(re.findall(r"\w+", " ".join(one.read_text() for one in pages)))

    def keys(node):
        if isinstance(node, dict):
            yield from node.get("properties", {})
            for inner in node.values():
                yield from keys(inner)
        elif isinstance(node, list):
            for inner in node:
                yield from keys(inner)

    missing = sorted(set(keys(schema(name))) - page)
    assert not missing


def test_a_schema_for_every_json_and_no_other():
    files = {f.name for f in (SOURCE / "schemas").iterdir()}
    assert files == {f"{name}.schema.json" for name in RESULTS}


def test_a_wrong_file_is_not_valid(command):
    good = json.loads(command("fit", "mine.toml", "--json").out)
    check = validator("fit")
    assert check.is_valid(good)

    def broken(change):
        wrong = copy.deepcopy(good)
        change(wrong)
        return not check.is_valid(wrong)

    assert not broken(lambda fit: fit["model"].update(separation_m=4e-10))  # only maugis has it
    assert broken(lambda fit: fit.update(format_version=3))
    assert broken(lambda fit: fit.pop("parameters"))
    assert broken(lambda fit: fit.update(parametres={}))
    assert broken(lambda fit: fit["parameters"]["C_H"].update(value="0.003"))
    assert broken(lambda fit: fit["parameters"]["C_H"].pop("unit"))
    assert broken(lambda fit: fit["parameters"]["C_H"]["intervals"].update(wald=[1.0]))
    assert broken(lambda fit: fit["derived"]["capture_velocity"][0].update(unit="cm/s"))
    assert broken(lambda fit: fit["identifiability"].update(verdict="perhaps"))
    assert broken(lambda fit: fit["dataset"].update(sha256="abc"))


def test_what_is_written_is_what_is_printed(command, place):
    printed = command("fit", "mine.toml", "--json", "--out", "written").out
    assert (place / "written/fit.json").read_text() == printed
    fit = "fits/dahneke1975-quartz.toml"
    printed = command("diagnose", fit, "--json", "--out", "written").out
    assert (place / "written/diagnosis.json").read_text() == printed


@pytest.mark.parametrize("version, words", [(0, "which is older"), (3, "which is newer"),
                                            (None, "states no format_version")])
def test_another_format_version_is_said_in_one_line(command, place, version, words):
    fit = json.loads((place / "one.json").read_text())
    fit["format_version"] = version
    if version is None:
        del fit["format_version"]
    (place / "other.json").write_text(json.dumps(fit))
    for reader in (["compare", "two.json", "other.json"],
                   ["simulate", "one.toml", "--velocity", "2", "--diameter", "2", "--parameters",
                    "other.json"],
                   ["export", "one.toml", "--to", "table", "--parameters", "other.json", "--out",
                    "exported"]):
        done = command(*reader)
        assert done.status == 2
        assert done.out == ""
        assert done.err.count("\n") == 1
        assert done.err.startswith("other.json: the file ") and words in done.err
        assert "reads 2" in done.err
    assert not (place / "exported").exists()
