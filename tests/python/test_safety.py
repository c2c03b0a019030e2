"""Arguments are checked, results can be copied and pickled, and no thread takes Python down."""

import copy
import json
import math
import multiprocessing
import os
import pickle
import shutil
import stat
import subprocess
import sys

import pytest
import recoil

OPTIONS = [
    ("replicates", 2.7), ("replicates", math.nan), ("replicates", -1), ("replicates", 1e30),
    ("replicates", "many"), ("replicates", [1]), ("seed", -1), ("seed", 1.5), ("seed", 2**63),
    ("seed", math.inf), ("seed", "one"), ("threads", -1), ("threads", 100000), ("threads", 0.5),
    ("threads", "two"), ("scheme", 3), ("solver", ""), ("seed", True),
]


@pytest.mark.parametrize("name, value", OPTIONS)
def test_options_of_a_fit(here, name, value):
    with pytest.raises(recoil.InputError, match=name):
        recoil.fit("mine.toml", **{name: value})


def test_other_options(here):
    for datasets in (0, -1, 2.5, math.nan, 10**9, "two"):
        with pytest.raises(recoil.InputError, match="datasets"):
            recoil.coverage("mine.toml", datasets, replicates=19)
    fit = recoil.fit("mine.toml", replicates=19)
    (here / "sizes.csv").write_text("diameter,count\n1,2\n2,1\n")
    for height in (math.nan, -1, math.inf, "high"):
        with pytest.raises(recoil.InputError, match="height_mm"):
            fit.predict("sizes.csv", height_mm=height)
    for options in ({"seed": -1}, {"seed": 1.5}, {"threads": 100000}):
        with pytest.raises(recoil.InputError):
            fit.diagnose(**options)
    for name in ("per_bin", "size_classes"):
        with pytest.raises(recoil.InputError, match=name):
            recoil.pair("sizes.csv", **{name: 2.5})
    for velocity, diameter in ((math.nan, 4), (2, math.nan), (math.inf, 4), (-1, 4)):
        with pytest.raises(recoil.InputError):
            fit.simulate(velocity, diameter)
        with pytest.raises(recoil.InputError):
            fit.impact(velocity, diameter)


def test_as_many_threads_as_the_command_takes(here):
    few = recoil.fit("mine.toml", replicates=19, threads=1)
    assert recoil.fit("mine.toml", replicates=19, threads=64).json == few.json


def refit(dataset):
    return recoil.fit(dataset, replicates=0, threads=1)


def test_copies_and_pickles(here):
    dataset = recoil.load_dataset("mine")
    fit = recoil.fit("mine.toml", replicates=19)
    again = pickle.loads(pickle.dumps(dataset))
    assert (again.id, again.sha256, len(again)) == (dataset.id, dataset.sha256, len(dataset))
    assert refit(again).json == refit(dataset).json
    for result in (fit, fit.diagnose()):
        kept = pickle.loads(pickle.dumps(result))
        assert (kept.json, str(kept), kept.facts) == (result.json, str(result), result.facts)
        assert kept.report() == result.report() and "<pre>" in kept._repr_html_()
        assert copy.copy(result).json == copy.deepcopy(result).json == result.json
    assert copy.deepcopy(fit).simulate(2.0, 4.0).restitution == fit.simulate(2.0, 4.0).restitution
    with pytest.raises(AttributeError, match="fit again"):
        pickle.loads(pickle.dumps(fit)).simulate(2.0, 4.0)
    with multiprocessing.get_context("spawn").Pool(2) as pool:
        fits = pool.map(refit, [dataset, dataset])
    assert [one.json for one in fits] == [refit(dataset).json] * 2


def progress_of(_):
    from recoil import _options

    return _options.shows(True)


def test_workers_and_those_who_ask_are_silent(here):
    assert progress_of(0)
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        assert pool.map(progress_of, [0]) == [False]
    with pytest.raises(recoil.InputError, match="give True or False"):
        recoil.fit("mine.toml", progress="no")


def test_no_progress_on_a_terminal(here):
    script = ("import recoil, sys\n"
              "r = recoil.fit('mine.toml', replicates=199, progress=eval(sys.argv[1]))\n"
              "r.simulate(1.0, 2.0)\n")
    for asked in (True, False):
        ours, theirs = os.openpty()
        subprocess.run([sys.executable, "-c", script, str(asked)], stderr=theirs, check=True,
                       env={**os.environ, "TERM": "xterm"})
        os.set_blocking(ours, False)
        try:
            seen = os.read(ours, 100000)
        except BlockingIOError:
            seen = b""
        os.close(ours), os.close(theirs)
        assert (b"bootstrap" in seen) == asked


def test_names_in_notebooks_are_no_markup(here):
    pytest.importorskip("pandas")
    name = "<img src=x onerror=alert(1)>"
    (here / "mine").rename(here / name)
    text = (here / name / "datapackage.json").read_text()
    package = json.loads(text)
    package.pop("name", None)
    (here / name / "datapackage.json").write_text(json.dumps(package))
    assert "<img" not in recoil.load_dataset(here / name)._repr_html_()


def test_a_thread_that_fits_at_exit_takes_nothing_down(here):
    script = (
        "import recoil, threading, time\n"
        "work = lambda: recoil.fit('mine.toml', replicates=1000000)\n"
        "threading.Thread(target=work, daemon=True).start()\n"
        "until = time.process_time() + 0.3\n"
        "while time.process_time() < until: time.sleep(0.01)\n"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=60)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")


def test_every_file_is_saved_by_the_safe_writer(here):
    """Through a link, with the old permissions, whole or not at all, and with nothing beside it."""
    fit, dataset = recoil.fit("mine.toml", replicates=0), recoil.load_dataset("mine")
    def replace(folder):
        dataset.save(folder, replace=True)

    for name, save in (("fit.json", fit.save), ("points.csv", replace),
                       ("datapackage.json", replace)):
        (here / "kept").mkdir()
        (here / "kept" / name).write_text("old")
        (here / "kept" / name).chmod(0o600)
        (here / "out").mkdir()
        (here / "out" / name).symlink_to(here / "kept" / name)
        save("out")
        assert (here / "out" / name).is_symlink()
        assert (here / "kept" / name).read_text() != "old"
        assert stat.S_IMODE((here / "kept" / name).stat().st_mode) == 0o600
        assert os.listdir(here / "kept") == [name]
        shutil.rmtree(here / "kept")
        shutil.rmtree(here / "out")
    # the second of two files has no place: the first one stays as it was
    (here / "out" / "datapackage.json").mkdir(parents=True)
    (here / "out" / "points.csv").write_text("old")
    with pytest.raises(recoil.InputError, match="datapackage.json"):
        dataset.save("out", replace=True)
    assert (here / "out" / "points.csv").read_text() == "old"


def test_data_that_are_there_are_kept(here):
    points = (here / "mine" / "points.csv").read_text()
    with pytest.raises(recoil.InputError, match="points.csv is there; .* replace=True"):
        recoil.load_dataset("mine").save("mine")
    assert (here / "mine" / "points.csv").read_text() == points


def test_the_locale_of_the_process_changes_no_byte(here, tmp_path):
    made = subprocess.run(["localedef", "-i", "de_DE", "-f", "UTF-8", str(tmp_path / "de_DE.UTF-8")],
                          capture_output=True)
    if not (tmp_path / "de_DE.UTF-8" / "LC_NUMERIC").exists():
        pytest.skip(f"no locale with a decimal comma can be made: {made.stderr.decode()}")
    script = (
        "import locale, recoil\n"
        "def page(name):\n"
        "    recoil.fit('mine.toml', replicates=19).save_page(name)\n"
        "    return open(name, 'rb').read()\n"
        "plain = page('plain.html')\n"
        "locale.setlocale(locale.LC_ALL, 'de_DE.UTF-8')\n"
        "assert locale.localeconv()['decimal_point'] == ','\n"
        "assert page('german.html') == plain\n"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True,
                          env={**os.environ, "LOCPATH": str(tmp_path)})
    assert done.returncode == 0, done.stderr
