"""Datasets from and to pandas, and what is wrong with them."""

import json
import os

import numpy as np
import pandas as pd
import pytest
import recoil
from conftest import PARTICLE, SURFACE

SHIPPED = ["wall1990-molybdenum", "dahneke1975-quartz", "li1999-sst65-silicon"]


@pytest.mark.parametrize("name", SHIPPED)
def test_there_and_back_again_is_the_same_fit(here, name):
    read = recoil.load_dataset(f"datasets/{name}")
    frame = read.to_pandas()
    assert len(frame) == len(read)
    again = recoil.Dataset.from_pandas(frame, read.id, like=read)
    pd.testing.assert_frame_equal(again.to_pandas(), frame)
    two = recoil.fit(again, replicates=0)
    assert two.dataset.provenance == "reconstruction"
    if name.startswith("li1999"):
        return  # which sizes its points average over is not taken from another dataset
    one = recoil.fit(read, replicates=0)
    assert one.parameters == two.parameters
    assert one.residuals == two.residuals


def test_a_frame_of_ones_own(here):
    frame = pd.read_csv("mine/points.csv")
    made = recoil.Dataset.from_pandas(frame, "own", particle=PARTICLE, surface=SURFACE,
                                      provenance="synthetic")
    assert (made.id, made.provenance, len(made)) == ("own", "synthetic", 12)
    assert recoil.fit(made, replicates=0).parameters == (
        recoil.fit("mine.toml", replicates=0).parameters)
    assert repr(made) == "<recoil.Dataset own: 12 points, synthetic>"


def test_units_of_columns(here):
    like = recoil.load_dataset("mine")
    frame = like.to_pandas()
    assert frame.attrs["units"] == {"diameter": "um", "incident_velocity": "m/s",
                                    "restitution": "1", "restitution_sd": "1"}
    frame["diameter"] /= 1000.0
    frame.attrs = {}
    wanted = recoil.fit(like, replicates=0).parameters.C_H.value
    millimetres = recoil.Dataset.from_pandas(frame, like=like, units={"diameter": "mm"})
    assert recoil.fit(millimetres, replicates=0).parameters.C_H.value == pytest.approx(
        wanted, rel=1e-6)
    assert millimetres.to_pandas().attrs["units"]["diameter"] == "mm"
    # the units of a frame stay with what is made of it
    again = recoil.Dataset.from_pandas(millimetres.to_pandas(), like=like)
    assert again.to_pandas().attrs["units"]["diameter"] == "mm"


def test_saved_folders_are_datasets(here, command):
    frame = recoil.load_dataset("mine").to_pandas()
    frame["restitution_sd"] = np.where(frame.index % 2 == 0, np.nan, 0.02)
    frame["velocity_sd"] = 0.01
    made = recoil.Dataset.from_pandas(frame.drop(columns="restitution_sd"), "saved",
                                      like=recoil.load_dataset("mine"), method="video")
    made.save("saved")
    assert command("check", "saved").status == 0
    read = recoil.load_dataset("saved")
    assert read.sha256 and read.package["recoil"]["method"] == "video"
    pd.testing.assert_frame_equal(read.to_pandas(), made.to_pandas())
    recoil.load_dataset("mine").save("copy")
    assert recoil.fit("copy", replicates=0).parameters == recoil.fit("mine", replicates=0).parameters


def test_a_column_that_is_not_known_names_the_nearest(here):
    like = recoil.load_dataset("mine")
    frame = like.to_pandas().rename(columns={"restitution": "restitutoin"})
    with pytest.raises(recoil.InputError, match="restitution"):
        recoil.Dataset.from_pandas(frame, like=like)


def test_a_wrong_cell_is_named_by_row_and_column(here):
    like = recoil.load_dataset("mine")
    frame = like.to_pandas()
    frame.loc[3, "restitution"] = 1.9
    with pytest.raises(recoil.InputError) as caught:
        recoil.Dataset.from_pandas(frame, like=like)
    assert caught.value.problem == "entry 3 (from 0): restitution = 1.9"


def test_materials_that_are_missing_are_asked_for(here):
    frame = pd.read_csv("mine/points.csv")
    with pytest.raises(recoil.InputError, match="surface is not known; give surface="):
        recoil.Dataset.from_pandas(frame, particle=PARTICLE, provenance="synthetic")
    with pytest.raises(recoil.InputError, match="provenance is not known"):
        recoil.Dataset.from_pandas(frame, particle=PARTICLE, surface=SURFACE)


def test_true_and_false_are_captures(here):
    frame = pd.DataFrame({"series": ["a", "a"], "diameter": [4.0, 4.0],
                          "incident_velocity": [0.5, 2.0], "restitution": [np.nan, 0.8],
                          "captured": [True, False]})
    made = recoil.Dataset.from_pandas(frame, "own", particle=PARTICLE, surface=SURFACE,
                                      provenance="synthetic")
    again = made.to_pandas()
    assert list(again["captured"]) == [True, False]
    assert made.package["resources"][0]["schema"]["fields"][-1]["type"] == "boolean"


def test_marks_of_numbers_are_those_of_the_package(here):
    fields = [{"name": "series", "type": "string"},
              {"name": "diameter", "type": "number", "unit": "um", "decimalChar": ","},
              {"name": "incident_velocity", "type": "number", "unit": "mm/s", "decimalChar": ",",
               "groupChar": "."},
              {"name": "restitution", "type": "number", "unit": "1", "decimalChar": ","}]
    package = recoil.load_dataset("mine").package
    package["resources"] = [{"path": "points.csv", "dialect": {"delimiter": ";"},
                             "schema": {"fields": fields}}]
    os.mkdir("german")
    with open("german/datapackage.json", "w", encoding="utf-8") as file:
        json.dump(package, file)
    with open("german/points.csv", "w", encoding="utf-8") as file:
        file.write("series;diameter;incident_velocity;restitution\na;4,9;2.500;0,57\n")
    frame = recoil.load_dataset("german").to_pandas()
    assert list(frame["incident_velocity"]) == [2500]
    assert list(frame["diameter"]) == [4.9]
