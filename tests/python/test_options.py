"""Options are those of the commands: names, defaults, units, mistakes."""

import inspect
import re

import numpy as np
import pytest
import recoil

FUNCTIONS = {
    "fit": recoil.fit, "model": recoil.model, "coverage": recoil.coverage, "pair": recoil.pair,
    "diagnose": recoil.FitResult.diagnose, "predict": recoil.FitResult.predict,
}


@pytest.mark.parametrize("name", FUNCTIONS)
def test_every_option_is_an_argument_with_a_meaning(name):
    function = FUNCTIONS[name]
    arguments = inspect.signature(function).parameters
    meanings = recoil._recoil.option_meanings(name)
    assert meanings
    for argument, meaning, _ in meanings:
        assert argument in arguments
        assert f"``{argument}``: " in function.__doc__
        assert meaning.split()[0] in function.__doc__


def test_defaults_are_those_of_the_help(command):
    told = " ".join(command("help", "pair").out.split())
    for name, argument in inspect.signature(recoil.pair).parameters.items():
        if isinstance(argument.default, (int, float)) and argument.default is not False:
            option = name.replace("_", "-")
            assert re.search(rf"--{option} .*?\(default: {argument.default}\)", told), name


def test_a_quantity_may_state_its_unit(here):
    fit = recoil.fit("mine.toml", replicates=19)
    (here / "sizes.csv").write_text("diameter,count\n2,2\n4,1\n")
    wanted = fit.predict("sizes.csv", height_mm=20).json
    for height in ("20", "20 mm", "2cm", np.float64(20), np.int64(20)):
        assert fit.predict("sizes.csv", height_mm=height).json == wanted
    with pytest.raises(recoil.InputError, match="height_mm is '20 kg'") as caught:
        fit.predict("sizes.csv", height_mm="20 kg")
    assert "0 to 1000 mm (units: um" in caught.value.suggestion


def test_whole_numbers_are_decimal(here):
    seeds = [recoil.fit("mine.toml", replicates=19, seed=seed).bootstrap.seed
             for seed in (10, "010", 10.0, np.int64(10))]
    assert seeds == [10] * 4
