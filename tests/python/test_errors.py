"""Errors are exceptions, with the words of the command and its parts."""

import pickle

import pytest
import recoil

MISTAKES = {
    "key": 'dataset = "mine"\n\n[uncertainty]\nreplicats = 99\n',
    "value": 'dataset = "mine"\n[model]\nadhesion = "glue"\n',
    "syntax": 'dataset = "mine\n',
    "folder": 'dataset = "nowhere"\n',
}


@pytest.mark.parametrize("name", MISTAKES)
def test_the_line_is_the_commands(here, command, name):
    (here / "wrong.toml").write_text(MISTAKES[name])
    with pytest.raises(recoil.InputError) as caught:
        recoil.fit("wrong.toml")
    done = command("fit", "wrong.toml")
    assert done.status == 2
    assert str(caught.value) + "\n" == done.err


def test_its_parts(here):
    (here / "wrong.toml").write_text(MISTAKES["key"])
    with pytest.raises(recoil.InputError) as caught:
        recoil.fit("wrong.toml")
    error = caught.value
    assert isinstance(error, ValueError)
    assert (error.file, error.line, error.column) == ("wrong.toml", 4, 1)
    assert "replicats" in error.problem
    assert "replicates" in error.suggestion
    assert isinstance(error.why, str)
    again = pickle.loads(pickle.dumps(error))
    assert (str(again), again.line, again.suggestion) == (str(error), 4, error.suggestion)


def test_a_dataset_with_a_mistake(here):
    text = (here / "mine/points.csv").read_text().replace("0.492", "half")
    (here / "mine/points.csv").write_text(text)
    with pytest.raises(recoil.InputError) as caught:
        recoil.load_dataset("mine")
    assert (caught.value.line, caught.value.column) == (3, 7)
    with pytest.raises(recoil.InputError):
        recoil.load_dataset("nowhere")


def test_options_that_do_not_exist(here):
    for wrong in ({"scheme": "wold"}, {"solver": "slow"}, {"replicates": "many"},
                  {"replicates": -1}, {"model": {"adhesion": "jkr"}}):
        with pytest.raises(recoil.InputError):
            recoil.fit("mine.toml", **wrong)
    with pytest.raises(recoil.InputError, match="adhesoin"):
        recoil.fit("mine", model={"adhesoin": "jkr"})
    with pytest.raises(TypeError):
        recoil.fit("mine.toml", replicats=3)


def test_a_fit_without_an_answer_is_another_error(here):
    lines = (here / "mine/points.csv").read_text().splitlines()
    (here / "mine/points.csv").write_text("\n".join(lines[:2]) + "\n")  # one point, two parameters
    with pytest.raises(recoil.ComputationError) as caught:
        recoil.fit("mine.toml")
    assert isinstance(caught.value, RuntimeError) and "mine.toml" in str(caught.value)


def test_comparing_what_cannot_be_compared(here):
    one = recoil.fit("mine.toml", replicates=0)
    other = recoil.fit("uncertain.toml", replicates=0)
    with pytest.raises(recoil.InputError, match="different data"):
        recoil.compare(one, other)
    with pytest.raises(recoil.InputError, match="two or more"):
        recoil.compare(one)
    with pytest.raises(recoil.InputError, match="nowhere.json"):
        recoil.compare(one, "nowhere.json")
    (here / "old.json").write_text(one.json.replace('"format_version": 2', '"format_version": 0'))
    with pytest.raises(recoil.InputError, match="format_version 0.*older"):
        recoil.compare(one, "old.json")
    with pytest.raises(recoil.InputError, match="format_version 0.*older"):
        recoil.model("mine.toml", fitted="old.json")
