"""--json and its schemas: what every command prints is valid, and what is not valid is noticed."""

import copy
import json
import re

import jsonschema
import pytest
from conftest import PACKAGE, SOURCE, command_in, furnish, write_dataset

RESULTS = {
    "fit": [
        ["fit", "mine.toml"],
        ["fit", "mine.toml", "--replicates", "0"],
        ["fit", "uncertain.toml"],
        ["fit", "posterior.toml"],
        ["fit", "mechanism.toml"],
        ["fit", "fixed.toml"],
        ["fit", "unstated.toml"],
        ["fit", "partly.toml"],
        ["fit", "dry.toml"],
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
        ["simulate", "dry.toml", "--velocity", "5", "--diameter", "4"],
    ],
    "coverage": [
        ["coverage", "mine.toml", "--datasets", "3", "--replicates", "19"],
        ["coverage", "dry.toml", "--datasets", "3", "--replicates", "19"],
    ],
    "compare": [["compare", "one.json", "two.json"]],
    "plan": [
        ["plan", "mine.toml"],
        ["plan", "maugis.toml", "--impacts", "300", "--diameter", "1,4"],
        ["plan", "fits/wall1990-all.toml", "--impacts", "2000"],
        ["plan", "dry.toml", "--velocity", "1,10"],
    ],
    "pair": [["pair", "events.csv", "--unit", "time=s,velocity=m/s,diameter=um"]],
}


PARTLY = 6  # the line of partly/points.csv that states no restitution_sd


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
    lines = (place / "mine/points.csv").read_text().splitlines()
    lines[PARTLY] = lines[PARTLY].replace(",0.015,", ",,")
    write_dataset(place / "partly", "\n".join(lines) + "\n")
    (place / "partly.toml").write_text(head.replace("mine", "partly"))
    (place / "dry").mkdir()
    rebounds = [line for line in lines if not line.endswith(",20,20")]
    (place / "dry/points.csv").write_text("\n".join(rebounds) + "\n")
    (place / "dry/datapackage.json").write_text(json.dumps(
        {**PACKAGE, "name": "dry", "recoil": {**PACKAGE["recoil"], "adhesion_energy": 0}}))
    (place / "dry.toml").write_text(head.replace("mine", "dry"))
    for name, adhesion in (("one", "ring"), ("two", "jkr")):
        (place / f"{name}.toml").write_text(head + f'[model]\nadhesion = "{adhesion}"\n')
        (place / f"{name}.json").write_text(command("fit", f"{name}.toml", "--json").out)
    rows = ["time,velocity,diameter"]
    for i in range(60):  # down at 1 m/s, back at 0.8 m/s from a plane 1 mm above the surface
        rows += [f"{10 * i},1,50", f"{10 * i + 0.00225},-0.8,50"]
    (place / "events.csv").write_text("\n".join(rows) + "\n")
    return place


@pytest.fixture(scope="module")
def printed(place):
    """What a command prints with --json, run once."""
    command = command_in(place)
    done = {}

    def run(words):
        if tuple(words) not in done:
            done[tuple(words)] = command(*words, "--json")
        return done[tuple(words)]

    return run


def words_of(parameter):
    """The name of a test: the result, the command and its first argument."""
    return parameter if isinstance(parameter, str) else "-".join(parameter[:2])


EVERY = pytest.mark.parametrize("name, words", [(n, w) for n in RESULTS for w in RESULTS[n]],
                                ids=words_of)


@EVERY
def test_stdout_is_valid_json_and_nothing_else(printed, name, words):
    done = printed(words)
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


# What is made wrong, and the keys (ends of their paths) that need not be there, besides reasons.
MADE_WRONG = [
    ("fit", ["fit", "uncertain.toml"]),
    ("fit", ["fit", "posterior.toml"]),
    ("diagnosis", ["diagnose", "misfit.toml"]),
    ("predict", RESULTS["predict"][0]),
    ("simulate", ["simulate", "mechanism.toml", "--velocity", "5", "--diameter", "4.9"]),
    ("coverage", RESULTS["coverage"][0]),
    ("compare", RESULTS["compare"][0]),
    ("plan", ["plan", "mine.toml"]),
    ("pair", RESULTS["pair"][0])]
OPTIONAL = {
    "fit": ("/separation_m", "/capture_velocity/0/why", "/budget", "/budget_linear",
            "/move", "/budget_sd_without_first_constant", "/materials_exact", "/spread",
            "/capture_velocity/0/intervals/posterior"),
    "diagnosis": ("/interval", "/condition", "/value", "/doing", "/own_design"),
    "simulate": ("/whole_impact_J", "/dashpot_force_uN"),
    "plan": ("/parameter", "/dataset", "/diameter_um")}
OTHER_TYPES = {str: 7, int: "seven", float: "seven", bool: "yes", list: {}, dict: []}
BY_NAME = {"parameters", "covariance", "correlation", "spread", "exponents", "relative_sd",
           "two_point_by_dataset", "full_by_dataset", "two_point_failed", "intervals_note",
           "constants", "why"}


def shortened(node):
    """With the first entry of every list of objects."""
    if isinstance(node, dict):
        return {key: shortened(value) for key, value in node.items()}
    if isinstance(node, list):
        return [shortened(item) for item in (node[:1] if node[:1] and isinstance(node[0], dict)
                                             else node)]
    return node


def mutations(node, root, name, path=()):
    """Wrong JSON made of `root` by one change at or below `node`, with its description. Of a list,
    only the first entry is changed."""
    where = "/".join(map(str, path))
    if isinstance(node, list):
        if node:
            yield from mutations(node[0], root, name, (*path, 0))
        return
    if not isinstance(node, dict):
        return
    by_name = path and path[-1] in BY_NAME or path[-2:-1] in (("covariance",), ("correlation",))
    by_name = by_name or (name == "coverage" and path[-1:] == ("intervals",))
    for key, value in list(node.items()):
        kept = dict(node)
        if value is not None:
            node[key] = OTHER_TYPES[type(value)]
            yield root, f"{where}/{key} of another type"
        else:
            node[key] = {"neither": "null nor a value"}
            yield root, f"{where}/{key} neither null nor a value"
        node[key] = value
        optional = f"/{where}/{key}".endswith(("_why", *OPTIONAL.get(name, ())))
        if not by_name and not optional:
            del node[key]
            yield root, f"{where} without {key}"
            node.clear()
            node.update(kept)
        yield from mutations(value, root, name, (*path, key))
    if not by_name:
        node["unknown"] = 1
        yield root, f"{where} with an unknown key"
        del node["unknown"]


@pytest.mark.parametrize("name, words", MADE_WRONG, ids=words_of)
def test_what_lacks_a_key_or_has_another_type_is_not_valid(printed, name, words):
    found = shortened(json.loads(printed(words).out))
    before = copy.deepcopy(found)
    check = validator(name)
    accepted = []
    count = 0
    for wrong, change in mutations(found, found, name):
        count += 1
        if check.is_valid(wrong):
            accepted.append(change)
    assert found == before  # every change was taken back
    assert count > 20
    assert not accepted


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


@pytest.mark.parametrize("name", RESULTS)
def test_every_key_has_a_meaning_and_every_number_a_unit(name):
    def numbers(node):
        types = node.get("type", [])
        return "number" in ([types] if isinstance(types, str) else types) or any(
            numbers(node[key]) for key in ("items", "additionalProperties")
            if isinstance(node.get(key), dict) and "properties" not in node[key])

    def look(node, where):
        for key, inner in node.get("properties", {}).items():
            text = inner.get("description", "")
            assert len(text) > 1, f"{where}.{key}"
            has_unit = re.search(r" \[[^],]+\]$", text) is not None
            assert has_unit == numbers(inner), f"{where}.{key}: {text}"
            look(inner, f"{where}.{key}")
        for key in ("items", "additionalProperties"):
            if isinstance(node.get(key), dict):
                look(node[key], where)

    look(schema(name), name)


def documented(name):
    """The keys in the tables of the manual."""
    pages = {"fit": ["fit-json", "fit-json-points"], "diagnosis": ["diagnosis-json"]}
    text = "".join((SOURCE / f"docs/{page}.md").read_text()
                   for page in pages.get(name, ["other-json"]))
    if name not in pages:
        text = text.split(f"## recoil {name}\n")[1].split("\n## ")[0]
    rows = re.findall(r"^\| `([^`]+)` \| (.*) \|$", text, re.MULTILINE)
    keys = {key for key, _ in rows}
    for key, meaning in rows:  # the keys of an object that was listed before
        like = re.search(r"; keys as in `([^`]+)`$", meaning)
        if like:
            start = like[1] + "."
            keys |= {f"{key}.{k[len(start):]}" for k in keys if k.startswith(start)}
    return keys


@EVERY
def test_the_manual_has_every_key(printed, name, words):
    keys = documented(name)

    def look(node, path):
        if isinstance(node, list):
            for item in node:
                if isinstance(item, dict):
                    look(item, path + "[]")
        elif isinstance(node, dict):
            for key, inner in node.items():
                if key.endswith("_why"):
                    continue
                below = f"{path}.{key}" if path else key
                if any(k == f"{path}.NAME" or k.startswith(f"{path}.NAME.") for k in keys):
                    below = f"{path}.NAME"
                elif not any(k.startswith((f"{below}.", f"{below}[")) for k in keys):
                    assert below in keys
                look(inner, below)

    look(json.loads(printed(words).out), "")


def test_a_point_without_a_stated_error_has_none_in_the_result(printed, place):
    residuals = json.loads(printed(["fit", "partly.toml"]).out)["residuals"]
    stated = [row["restitution_sd"] for row in residuals]
    lines = (place / "partly/points.csv").read_text().splitlines()[1:]
    assert stated == [float(sd) if sd else None for sd in (line.split(",")[4] for line in lines)]
    assert stated.count(None) == 1
    assert residuals[PARTLY - 1]["sd_used"] > 0  # the fit gives it the median of the others


def test_without_adhesion_no_capture_velocity_is_counted(printed):
    rows = json.loads(printed(RESULTS["coverage"][1]).out)["rows"]
    assert rows and not [row["parameter"] for row in rows if row["parameter"].startswith("V*")]
    rows = json.loads(printed(RESULTS["coverage"][0]).out)["rows"]
    assert [row["parameter"] for row in rows][-2:] == ["V*(2 um)", "V*(4 um)"]


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
