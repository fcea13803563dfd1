"""Options of renders and comparisons: the command line's bounds, told before anything is built."""

import numpy as np
import pytest

import tyndall

NAN, INF = float("nan"), float("inf")


@pytest.fixture
def unbuildable():
    """A scene that cannot be built, so that what is said of an option is said before."""
    scene = tyndall.Scene()
    scene.lights = [tyndall.InfiniteLight(path="none.exr")]
    return scene


@pytest.mark.parametrize("options", [
    dict(spp=0), dict(spp=1 << 31), dict(spp=10**30), dict(time=NAN), dict(time=0), dict(time=INF), dict(error=-1), dict(error_max=INF),
    dict(threads=-1), dict(threads=5000), dict(candidates=4097), dict(candidates=-1), dict(shadow_rays=4097), dict(splitting=1.5),
    dict(splitting=NAN), dict(max_depth=-1), dict(max_depth=1 << 21), dict(seed=-1), dict(seed=1 << 64), dict(max_memory=NAN),
    dict(max_memory=INF), dict(max_memory=-1), dict(max_memory=0),
], ids=str)
def test_numbers_that_cannot_be(unbuildable, options):
    with pytest.raises(ValueError, match=next(iter(options)) + " must be"):
        unbuildable.render(**options)


@pytest.mark.parametrize("options", [
    dict(spp="many"), dict(spp=4.5), dict(time="1"), dict(threads=None), dict(splitting=()), dict(lights=7), dict(lights=None),
    dict(aovs=None), dict(aovs="Albedo"), dict(aovs=[7]), dict(crop=4), dict(crop="all"), dict(reproducible="no"), dict(max_memory="8"),
], ids=str)
def test_values_of_another_type(unbuildable, options):
    name = "AOV" if options.get("aovs") == [7] else next(iter(options))
    with pytest.raises(TypeError, match=f"{name} = .* is not understood; give"):
        unbuildable.render(**options)


def test_numbers_of_numpy_are_numbers(floor):
    image = floor.render(spp=np.int64(2), seed=np.uint64(2**64 - 1), threads=np.int8(1), splitting=np.float32(0.5), time=np.float64(100))
    assert image.report["samples"] == 2


def test_no_limit_of_memory_is_beyond_a_number(floor):
    assert floor.render(spp=1, max_memory=1e30).shape == (24, 40)


def test_the_machines_memory_is_the_limit(floor):
    floor.resolution = 65536, 65536
    with pytest.raises(tyndall.Error, match="memory"):
        floor.build(aovs=tyndall.aov_names())


def test_aovs_are_any_names_that_can_be_gone_through(floor):
    for names in (["Albedo", "N"], ("Albedo", "N"), {"Albedo": 1, "N": 2}, (name for name in ("Albedo", "N")), iter(["Albedo", "N"])):
        assert floor.render(spp=1, aovs=names).keys() >= {"Albedo.R", "N.X"}


def test_aovs_have_the_programs_names(tmp_path, program, floor, floor_text):
    (tmp_path / "floor.pbrt").write_text(floor_text)
    done = program("render", tmp_path / "floor.pbrt", "-o", tmp_path / "a.exr", "--spp", 2, "--aov", "Denoise,Cryptomatte", "--quiet")
    assert done.returncode == 0, done.stderr
    assert floor.render(spp=2, aovs=["Denoise", "Cryptomatte"]).keys() == tyndall.read_image(tmp_path / "a.exr").keys()


@pytest.mark.parametrize("limit", ["time", "error", "error_max"])
def test_a_limit_that_is_taken_away_leaves_no_endless_render(floor, limit):
    floor.settings = {limit: 100}
    assert floor.settings["spp"] is None
    floor.settings = {"seed": 3, "spp": None}
    assert floor.settings["spp"] is None and floor.settings[limit] == 100
    floor.settings = {limit: None}
    assert floor.settings["spp"] == tyndall.Scene().settings["spp"]
    floor.settings = {limit: 100, "spp": 4}
    floor.settings = {limit: None}
    assert floor.settings["spp"] == 4


def test_settings_are_options(floor):
    assert np.array_equal(floor.render(**floor.settings).rgb, floor.render().rgb)
    floor.settings = {"time": 100}
    before = floor.settings
    floor.settings = before
    assert floor.settings == before


@pytest.mark.parametrize("option", [dict(max_depth=3), dict(spp=4), dict(seed=3), dict(threads=1), dict(error=0.1), dict(aovs=["N"]),
                                    dict(time=1), dict(crop=(0, 0, 4, 4)), dict(reproducible=True)], ids=str)
def test_methods_have_options_that_leave_the_picture(floor, option):
    name = next(iter(option))
    with pytest.raises(TypeError, match=f'"{name}" is no option of a method; choose from adaptive, candidates.*, lights'):
        floor.compare({"a": {}, "b": option}, spp=1, seeds=2)


def test_methods_differ_in_what_the_program_lets_them(floor):
    floor.resolution = 8, 5
    methods = {"a": {"lights": "power", "candidates": 2, "shadow_rays": 1}, "b": {"splitting": 0.5, "adaptive": True}}
    assert floor.compare(methods, spp=8, seeds=2, reference_error=1).methods == ["a", "b"]


@pytest.mark.parametrize("plan", [dict(spp=0), dict(time=NAN), dict(seeds=1), dict(seeds=1001), dict(seed=-1), dict(threads=-1),
                                  dict(reference_error=0), dict(reference_time=-1)], ids=str)
def test_plans_that_cannot_be(unbuildable, plan):
    name = next(iter(plan))
    with pytest.raises(ValueError, match=f"{name} must be"):
        unbuildable.compare({"a": {}}, **{"spp": None if name == "time" else 4, **plan})
    with pytest.raises(TypeError, match=f"{name} = .* is not understood"):
        unbuildable.compare({"a": {}}, **{"spp": None if name == "time" else 4, name: "x"})


def test_a_comparison_has_a_limit_of_memory(floor):
    with pytest.raises(tyndall.Error, match="memory"):
        floor.compare({"a": {}}, spp=4, max_memory=1e-6)
    with pytest.raises(ValueError, match="max_memory must be"):
        floor.compare({"a": {}}, spp=4, max_memory=0)
