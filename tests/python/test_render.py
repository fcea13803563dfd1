"""Renders: the program's bits, options, progress, other threads."""

import threading
import time

import numpy as np
import pytest

import tyndall


def test_the_bits_are_the_programs(tmp_path, program, floor_text):
    scene = tmp_path / "floor.pbrt"
    scene.write_text(floor_text)
    done = program("render", scene, "-o", tmp_path / "floor.exr", "--spp", 3, "--seed", 5, "--media", "vertex", "--aov", "Albedo,Variance",
                   "--crop", "4,20,2,12", "--reproducible", "--quiet")
    assert done.returncode == 0, done.stderr
    theirs = tyndall.read_image(tmp_path / "floor.exr")
    ours = tyndall.load(scene).render(spp=3, seed=5, media="vertex", aovs=["Albedo", "Variance"], crop=(4, 2, 20, 12),
                                      reproducible=True, threads=1)
    assert ours.keys() == theirs.keys() and ours.keys() >= {"R", "G", "B", "A", "Albedo.G", "Variance.B"}
    assert all(np.array_equal(ours[name], theirs[name]) for name in ours)
    assert ours.data_window == theirs.data_window == (4, 2, 20, 12)
    assert ours.display_window == theirs.display_window == (0, 0, 40, 24)
    ours.attributes.pop("tyndall/scene"), theirs.attributes.pop("tyndall/scene")
    assert ours.attributes.keys() == theirs.attributes.keys()


def test_worlds_are_rendered_again_and_again(floor):
    world = floor.build()
    floor.lights = ()  # the world is as it was built
    floor.settings = {"spp": 1}
    first, second, other = world.render(seed=1), world.render(seed=1), world.render(seed=2)
    assert first.report["samples"] == 4 and np.array_equal(first.rgb, second.rgb) and not np.array_equal(first.rgb, other.rgb)
    assert first.rgb.mean() == pytest.approx(other.rgb.mean(), rel=0.1) and first.rgb.any()


def test_what_is_counted_is_reported(floor):
    report = floor.render(spp=2).report
    assert report["notes"] == floor.build().notes
    assert report["samples"] == 2 and report["paths"] == 2 * 40 * 24 and report["non_finite"] == 0 and not report["stopped"]


def test_a_time_ends_a_render(floor):
    began = time.monotonic()
    report = floor.render(time=0.3).report
    assert report["samples"] > 4 and time.monotonic() - began < 5


def test_progress_is_told_and_ends_at_1(floor):
    told = []
    floor.resolution = 160, 96
    floor.render(spp=64, progress=told.append)
    assert told and all(isinstance(p, tyndall.Progress) for p in told)
    fractions = [p.fraction for p in told]
    assert fractions == sorted(fractions) and 0 <= fractions[0] and fractions[-1] == 1
    assert told[-1].samples_done == 64


def test_an_exception_of_the_callback_ends_the_render(floor):
    def refuse(progress):
        raise LookupError("enough")

    floor.resolution = 320, 192
    with pytest.raises(LookupError, match="enough"):
        floor.render(spp=1 << 24, progress=refuse)


def test_other_threads_run_meanwhile(floor):
    floor.resolution = 320, 192
    world = floor.build()
    ticks = []
    done = threading.Event()

    def tick():
        while not done.wait(0.01):
            ticks.append(time.monotonic())

    ticker = threading.Thread(target=tick)
    ticker.start()
    began = time.monotonic()
    world.render(time=1.0, threads=1)
    ended = time.monotonic()
    done.set()
    ticker.join()
    assert len([t for t in ticks if began < t < ended]) > 20


def test_a_render_in_another_thread(floor):
    found = []
    thread = threading.Thread(target=lambda: found.append(floor.render(seed=3)))
    thread.start()
    here = floor.render(seed=3)
    thread.join()
    assert np.array_equal(found[0].rgb, here.rgb)


@pytest.mark.parametrize("options, kind, message", [
    (dict(sp=4), TypeError, '"sp" is no option of a render; choose from spp'),
    (dict(spp="many"), TypeError, "spp = 'many' is not understood"),
    (dict(lights="best"), ValueError, "choose from uniform"),
    (dict(aovs=["Depth"]), ValueError, "aov_names"),
    (dict(crop=(4, 4, 4, 8)), ValueError, "crop is"),
    (dict(crop=(0, 0, 41, 24)), ValueError, "crop is .* within 40 x 24"),
    (dict(spp=0), ValueError, "spp must be a whole number from 1 to"),
    (dict(max_memory=1e-6), tyndall.Error, "memory"),
])
def test_options_that_cannot_be(floor, options, kind, message):
    with pytest.raises(kind, match=message):
        floor.render(**options)


def test_strategies_that_the_world_was_not_built_for(floor):
    with pytest.raises(tyndall.Error) as caught:
        floor.build(lights="tree").render(lights="power")
    assert caught.value.failure == "usage" and caught.value.file is None
    assert np.isfinite(floor.build(lights="power").render(lights="power", spp=1).rgb).all()


def test_the_denoiser(tmp_path, floor):
    noisy = floor.render(spp=4, aovs=tyndall.denoise_aovs())
    clean = tyndall.denoise(noisy)
    noisy.save(tmp_path / "noisy.exr")
    assert np.array_equal(tyndall.denoise(tmp_path / "noisy.exr").rgb, clean.rgb)
    for threads in (-1, 5000):
        with pytest.raises(ValueError, match="threads must be"):
            tyndall.denoise(noisy, threads=threads)
    truth = floor.render(spp=512, seed=9)
    assert clean.report["missing"] == [] and clean.report["relmse"] < clean.report["noisy_relmse"]
    error = [tyndall.diff(i, truth, channels=["RGB"], exact=True, flip=False).errors["RGB"]["relmse"] for i in (clean, noisy)]
    assert error[0] < 0.7 * error[1]
