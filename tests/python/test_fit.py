"""Fits from Python: the digits and the names of the command, and lmfit's habits."""

import json
import math
import subprocess
import sys
import threading
import time

import numpy as np
import pytest
import recoil
from conftest import POINTS, SOURCE, write_dataset


def test_version_is_that_of_the_command(command):
    assert command("--version").out == f"recoil {recoil.__version__}\n"


@pytest.mark.parametrize("name", ["mine", "uncertain", "fits/dahneke1975-quartz"])
def test_fit_json_is_the_commands_byte_for_byte(here, command, name):
    options = ["--replicates", "39", "--seed", "5"]
    done = command("fit", f"{name}.toml", *options, "--json")
    result = recoil.fit(f"{name}.toml", replicates=39, seed=5, threads=1)
    assert result.json == done.out
    assert result.report() == command("fit", f"{name}.toml", *options).out
    assert result.report(verbose=True) == command("fit", f"{name}.toml", *options, "--verbose").out


def test_a_fit_of_datasets_and_tables_is_that_of_the_file(here, command):
    (here / "law.toml").write_text(
        'dataset = ["mine"]\n[model]\nadhesion = "jkr"\n[parameters]\n'
        "C_H = { initial = 2e-3, bounds = [0, 0.5] }\n[uncertainty]\nreplicates = 19\n")
    wanted = json.loads(command("fit", "law.toml", "--json").out)
    tables = {"model": {"adhesion": "jkr"},
              "parameters": {"C_H": {"initial": 2e-3, "bounds": [0, 0.5]}},
              "uncertainty": {"replicates": 19}}
    for source in ("mine", recoil.load_dataset("mine"), [recoil.load_dataset("mine")]):
        found = json.loads(recoil.fit(source, name="law", **tables).json)
        del found["fit"]["sha256"]
        assert found == {**wanted, "fit": {"id": "law"}}


def test_the_names_are_those_of_fit_json(here):
    result = recoil.fit("mine.toml")
    facts = json.loads(result.json)
    assert result.parameters.C_H.value == facts["parameters"]["C_H"]["value"]
    assert result.goodness.chi2 == facts["goodness"]["chi2"]
    assert result["bootstrap"]["replicates"] == 39
    assert result.derived.capture_velocity[0].interval == (
        facts["derived"]["capture_velocity"][0]["interval"])
    for key in facts:
        assert getattr(result, key) == facts[key], key
        assert key in dir(result)
    with pytest.raises(AttributeError, match="paramters.*there are"):
        result.paramters


def test_lmfits_names(here):
    result = recoil.fit("mine.toml")
    assert result.var_names == ["C_H", "C_A"]
    p = result.params["C_H"]
    assert (p.value, p.stderr, p.vary) == (result.parameters.C_H.value,
                                           result.parameters.C_H.std_error, True)
    assert (p.min, p.max, p.init_value) == (0.0, 30.0 / 25.0, 0.003)
    assert p.interval == result.parameters.C_H.intervals[result.parameters.C_H.recommended.interval]
    assert not result.params["f0"].vary
    assert result.best_values["C_A"] == result.parameters.C_A.value
    assert result.nvarys == 2 and result.ndata == 12 and result.nfree == 8 and result.success
    moved = sum(constant["moved_sd"]**2 for constant in result.constants.values())
    assert result.chisqr == pytest.approx(np.sum(result.residual**2) + moved, rel=1e-9)
    assert result.redchi == pytest.approx(result.chisqr / 8)
    assert np.sqrt(np.diag(result.covar)) == pytest.approx([result.params[n].stderr
                                                            for n in result.var_names])
    assert result.conf_interval()["C_A"]["wald"] == result.parameters.C_A.intervals.wald
    v = [r.incident_velocity for r in result.residuals]
    d = [r.diameter_um for r in result.residuals]
    assert result.eval(v, d) == pytest.approx(result.best_fit, abs=1e-9)
    assert "[[" in result.fit_report()
    deviance = result.goodness.minus_two_log_likelihood
    assert (result.aic, result.bic) == (deviance + 4, pytest.approx(deviance + 2 * math.log(12)))
    e = np.array([row.restitution for row in result.residuals])
    assert result.rsquared == pytest.approx(
        1 - np.sum((e - result.best_fit)**2) / np.sum((e - e.mean())**2))
    intervals = result.conf_interval()["C_A"]
    table = result.ci_report().splitlines()
    assert f"[{intervals['wald'][0]:.3g}, {intervals['wald'][1]:.3g}]" in table[3]
    assert table[3].split()[0] == "C_A" and "bca" in table[1]


def test_what_cannot_be_compared_is_nan(here):
    frame = recoil.load_dataset("mine").to_pandas()[["diameter", "incident_velocity", "restitution"]]
    result = recoil.fit(frame, **{body: recoil.load_dataset("mine").package["recoil"][body]
                                  for body in ("particle", "surface")}, replicates=0)
    assert math.isnan(result.aic) and math.isnan(result.bic)


def test_the_next_step_is_a_call(here):
    result = recoil.fit("mine.toml", replicates=0)
    assert "result.diagnose()" in str(result) and "recoil diagnose" not in str(result)
    assert "recoil diagnose mine.toml" in result.report()


def test_save_writes_what_other_commands_read(here, command):
    path = recoil.fit("mine.toml").save("result")
    assert path.read_text() == command("fit", "mine.toml", "--json").out
    done = command("simulate", "mine.toml", "--velocity", 3, "--diameter", 2, "--parameters", path)
    assert done.status == 0, done.err


def test_diagnose_is_the_commands(here, command, misfit):
    done = command("diagnose", "misfit.toml", "--json")
    assert misfit.json == done.out
    assert misfit.verdict == json.loads(done.out)["verdict"] != "adequate"
    for key, value in json.loads(done.out).items():
        assert getattr(misfit, key) == value, key
    assert misfit.save("diagnosed").read_text() == done.out
    extended = recoil.fit("diagnosed/extended.toml", replicates=0)
    assert extended.chisqr == pytest.approx(misfit.extended.chi2, rel=1e-6)


def test_the_report_of_a_diagnosis_is_the_commands(here, command):
    fit = "fits/dahneke1975-quartz.toml"
    diagnosis = recoil.fit(fit, replicates=0).diagnose()
    assert diagnosis.report(verbose=True) == command("diagnose", fit, "--verbose").out


def test_predict_coverage_and_compare_are_the_commands(here, command):
    fit, sizes = "fits/li1999-sst65-silicon.toml", "datasets/li1999-sst65-silicon/sizes.csv"
    result = recoil.fit(fit, replicates=39)
    done = command("predict", fit, "--sizes", sizes, "--replicates", 39, "--json")
    mixture = result.predict(sizes)
    assert mixture.json == done.out
    for key, value in json.loads(done.out).items():
        assert getattr(mixture, key) == value, key
    done = command("coverage", "mine.toml", "--datasets", 3, "--replicates", 19, "--json")
    assert recoil.coverage("mine.toml", 3, replicates=19) == json.loads(done.out)
    one, two = recoil.fit("mine.toml"), recoil.fit("mine", model={"adhesion": "jkr"}, replicates=39)
    compared = recoil.compare(one, two, one.save("one"))
    assert [f.adhesion for f in compared] == ["ring", "jkr", "ring"]
    assert compared.quantities[0].name == "C_H"


def test_other_threads_run_while_a_fit_does(here):
    ticks, done = [], threading.Event()

    def tick():
        while not done.is_set():
            ticks.append(time.perf_counter())
            time.sleep(0.001)

    thread = threading.Thread(target=tick)
    thread.start()
    try:
        begin = time.perf_counter()
        recoil.fit("fits/wall1990-molybdenum.toml", replicates=1999, threads=1)
        end = time.perf_counter()
    finally:
        done.set()
        thread.join()
    during = [t for t in ticks if begin <= t <= end]
    assert end - begin > 0.2
    assert len(during) > 20 * (end - begin), "the interpreter was held while C++ worked"


def test_it_shows_itself_in_a_notebook(here, misfit):
    result = recoil.fit("mine.toml")
    page = result._repr_html_()
    assert "<table>" in page and "<i>C</i><sub>H</sub>" in page and "synthetic" in page
    assert repr(result).startswith("<recoil.FitResult mine: C_H = ")
    assert "<p" in misfit._repr_html_()
    assert not any('class="label"' in one._repr_html_() for one in (result, misfit))
    assert "<table" in recoil.load_dataset("mine")._repr_html_()


def test_the_band_is_that_of_the_page(fitted):
    table = fitted.curve.to_pandas()
    lower, upper = fitted.eval_band(table["incident_velocity"], table["diameter_um"])
    bands = [row.band for row in fitted.curve]
    # fit.json has nine digits of the velocity: near capture e changes fast
    assert np.allclose(np.transpose([lower, upper]), bands, atol=1e-5)
    lower, upper = fitted.eval_band([[1.0, 5.0]], [[2.0], [4.0]])
    assert lower.shape == (2, 2) and (lower <= upper).all()
    assert (lower[1] == fitted.eval_band([1.0, 5.0], 4.0)[0]).all()
    with pytest.raises(recoil.InputError, match="give no band"):
        recoil.fit([4, 5, 6], [0.9, 0.91, 0.9], d=4, particle="glass", surface="glass",
                   replicates=0).eval_band(1.0, 2.0)


def test_numbers_that_are_missing_are_none(here):
    result = recoil.fit("mine.toml", replicates=0)
    assert result.parameters.C_H.intervals.bca is None
    assert result.parameters.C_H.intervals.why.bca
    assert math.isfinite(result.parameters.C_H.value)


def test_the_schemas_come_along():
    import jsonschema

    jsonschema.Draft202012Validator.check_schema(recoil.schema("fit"))
    assert recoil.schema("fit") == json.loads((SOURCE / "schemas/fit.schema.json").read_text())
    with pytest.raises(recoil.InputError, match="choose one of compare, coverage"):
        recoil.schema("fits")


def test_a_key_is_described_with_its_unit():
    assert recoil.describe("goodness.rmse") == "root mean square of e - e_model [1]"
    assert recoil.describe("parameters.C_H.free") == "whether it was fitted"
    assert recoil.describe("derived.capture_velocity[0].interval").endswith("[m/s]")
    assert "p-value" in recoil.describe("candidates[].p_value", "diagnosis")
    with pytest.raises(recoil.InputError, match="no key 'goodness.rms'.*choose one of chi2, chi2_why, dof"):
        recoil.describe("goodness.rms")
    with pytest.raises(recoil.InputError, match="no key 'goodness.rmse.value'"):
        recoil.describe("goodness.rmse.value")


def test_what_comes_from_elsewhere_is_not_needed_to_import():
    code = ("import sys, recoil; "
            "assert not {'matplotlib', 'pandas', 'numpy'} & set(sys.modules), 'imported too early'")
    subprocess.run([sys.executable, "-c", code], check=True)


def test_a_fit_on_flat_ground_says_so(here):
    lines = [line.split(",") for line in POINTS.splitlines()]
    captured = [",".join([*row[:2], str(0.01 * float(row[2])), "0", "0.015", "20", "20"])
                for row in lines[1:]]
    write_dataset(here / "stuck", "\n".join([",".join(lines[0]), *captured]) + "\n")
    result = recoil.fit("stuck", replicates=0)
    assert result.solver.ended == "flat" and not result.success
    assert any("do not depend on C_H, C_A" in text for text in result.warnings)
    assert {start.ended for start in result.starts} == {"flat"}
    assert not any(start.converged for start in result.starts)
    assert recoil.fit("mine", replicates=0).solver.ended == "minimum"
