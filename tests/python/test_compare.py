"""diff and compare say what the program says."""

import json

import numpy as np
import pytest

import tyndall


def test_diff_is_the_programs(tmp_path, program, floor):
    a, b = floor.render(spp=4, seed=1, aovs=["Variance"]), floor.render(spp=4, seed=2, aovs=["Variance"])
    a.save(tmp_path / "a.exr"), b.save(tmp_path / "b.exr")
    theirs = json.loads(program("diff", tmp_path / "a.exr", tmp_path / "b.exr", "--json").stdout)
    for ours in (tyndall.diff(a, b), tyndall.diff(tmp_path / "a.exr", str(tmp_path / "b.exr"))):
        assert ours == {name: theirs[name] for name in theirs if name not in ("image", "reference")}
    assert ours.same and ours and ours["criterion"] == "--test"


def test_diff_sees_a_difference(floor):
    a = floor.render(seed=1)
    brighter = tyndall.Image.from_rgb(1.1 * a.rgb)
    found = tyndall.diff(brighter, a.rgb, max_error=1e-6)
    assert not found.same and not found and "channel R is off by" in found["reasons"][0]
    assert found.errors["RGB"]["mse"] == pytest.approx(np.mean((0.1 * a.rgb) ** 2), rel=1e-4)
    assert tyndall.diff(brighter, {name: a[name] for name in "RGB"}, max_relmse=1).same
    with pytest.raises(tyndall.Error, match="Depth"):
        tyndall.diff(a, a, channels=["Depth"])


def test_compare_measures_every_method(floor):
    told = []
    floor.resolution = 16, 10
    methods = {"tree": {}, "uniform, vertex": {"lights": "uniform", "media": "vertex"}}
    found = floor.compare(methods, spp=8, seeds=3, reference_error=0.02, progress=told.append)
    assert found.methods == list(methods) and list(found.images) == list(methods)
    for name in methods:
        curve = found.curve(name)
        assert [point["samples"] for point in curve] == [1, 2, 4, 8]
        assert curve[-1]["relmse"] < curve[0]["relmse"]
        assert found.images[name].shape == found.reference.shape == (10, 16)
    assert found["settings"]["seeds"] == [1, 2, 3] and told and told[-1] == pytest.approx(1)
    again = floor.compare({"tree": {}}, spp=8, seeds=3, reference=found.reference)
    assert [p["mse"] for p in again.curve("tree")] == pytest.approx([p["mse"] for p in found.curve("tree")])


@pytest.mark.parametrize("methods, plan, kind, message", [
    ({}, {}, tyndall.Error, "name a method"),
    ({"a": {}}, dict(spp=4, time=1), tyndall.Error, "either a time or"),
    ({"a": {}}, dict(spp=4, seeds=1), ValueError, "seeds must be a whole number from 2"),
    ({"a": {}}, dict(spp=0), ValueError, "spp must be a whole number from 1"),
    ({"a": {"light": "tree"}}, dict(spp=4), TypeError, "no option"),
    ({"a": {}}, dict(spp=4, reference="none.exr"), tyndall.Error, "none.exr"),
])
def test_comparisons_that_cannot_be(floor, methods, plan, kind, message):
    with pytest.raises(kind, match=message):
        floor.compare(methods, **plan)


def test_methods_have_names(floor):
    found = floor.compare({"a": {}}, spp=1, seeds=2, reference_error=1)
    with pytest.raises(KeyError, match="choose from a"):
        found.curve("b")
