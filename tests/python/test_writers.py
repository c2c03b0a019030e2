"""No function of Python replaces what was read, a points.csv or a datapackage.json, unless it is told
to."""

import inspect

import pytest
import recoil


def writers():
    """Every public method that takes a place to write to, found by its name or its parameters."""
    found = set()
    for name in recoil.__all__:
        one = getattr(recoil, name)
        members = inspect.getmembers(one, inspect.isfunction) if inspect.isclass(one) else [("", one)]
        for member, function in members:
            if member.startswith("_") or not inspect.isfunction(function):
                continue
            doc = (function.__doc__ or "").lower()
            if "save" in member or "write" in member or doc.startswith("writes"):
                found.add(f"{name}.{member}")
    return found


def passages():
    rows, time = ["time,velocity,diameter"], 0.0
    for i in range(60):
        time += 1.0
        v = 1.0 + 0.3 * (i % 7)
        rows.append(f"{time},{v},30")
        rows.append(f"{time + 0.001 / v + 0.001 / (0.8 * v)},{-0.8 * v},30")
    return "\n".join(rows) + "\n"


def test_every_writer_keeps_what_was_read_and_data(here):
    (here / "e.csv").write_text(passages())
    fit = recoil.fit("mine.toml", replicates=0, threads=1)
    diagnosis = recoil.fit("mine.toml", replicates=0, threads=1).diagnose(threads=1)
    dataset = recoil.load_dataset("mine")
    pairing = recoil.pair("e.csv", units={"time": "s", "velocity": "m/s", "diameter": "um"})
    files = ["mine/points.csv", "mine/datapackage.json", "mine.toml", "e.csv"]
    # folders with files of the names that the writers choose, which this process has read
    for name, text in (("fit.json", fit.json), ("diagnosis.json", "{}"), ("extended.toml", "")):
        (here / "read").mkdir(exist_ok=True)
        (here / "read" / name).write_text(text)
        with open(here / "read" / name) as file:
            file.read()
    recoil.model("mine.toml", fitted="read/fit.json")
    with pytest.raises(recoil.InputError):
        recoil.compare("read/diagnosis.json", "read/fit.json")
    with pytest.raises(recoil.InputError):
        recoil.fit("read/extended.toml")
    calls = {
        "FitResult.save": [(fit.save, "read", "read/fit.json")],
        "FitResult.save_page": [(fit.save_page, file, file) for file in files],
        "Diagnosis.save": [(diagnosis.save, "read", "read/diagnosis.json")],
        "Dataset.save": [(dataset.save, "mine", "mine/points.csv")],
        "Pairing.save": [(pairing.save, file, file) for file in files],
    }
    assert writers() == set(calls)
    for name, tried in calls.items():
        for write, place, file in tried:
            before = (here / file).read_bytes()
            with pytest.raises(recoil.InputError):
                write(place)
            assert (here / file).read_bytes() == before, (name, file)
            listing = sorted(one.name for one in (here / file).parent.iterdir())
            write(place, replace=True)
            assert sorted(one.name for one in (here / file).parent.iterdir()) == listing
            if name != "Dataset.save":
                assert (here / file).read_bytes() != before or file.endswith("fit.json"), (name, file)
            (here / file).write_bytes(before)
            recoil.load_dataset("mine")  # read again: the restored file is another one
            if file == "mine.toml":
                recoil.fit("mine.toml", replicates=0, threads=1)
            if file == "e.csv":
                recoil.pair("e.csv", units={"time": "s", "velocity": "m/s", "diameter": "um"})
    # what was only written is replaced freely
    for _ in range(2):
        fit.save("out")
        fit.save_page("out/page.html")
        diagnosis.save("out")
