"""Images: files, notebooks, windows, attributes."""

import copy

import numpy as np
import pytest

import tyndall
from tyndall import Image


def ramp() -> Image:
    y, x = np.mgrid[0:6, 0:9].astype(np.float32)
    return Image({"R": x / 8, "G": y / 5, "B": 0 * x, "Z": x * y})


def test_files_hold_everything(tmp_path):
    image = Image(ramp(), data_window=(2, 3, 11, 9), display_window=(0, 0, 20, 10), chromaticities=((0.7, 0.3), (0.2, 0.7), (0.1, 0.1), (0.3, 0.3)),
                  attributes={"a": 7, "b": 0.1, "c": np.float32(0.1), "d": "smoke", "e": np.arange(16).reshape(4, 4)})
    image.save(tmp_path / "a.exr")
    read = tyndall.read_image(tmp_path / "a.exr")
    assert sorted(read) == sorted(image) and all(np.array_equal(read[name], image[name]) for name in image)
    assert read.data_window == (2, 3, 11, 9) and read.display_window == (0, 0, 20, 10)
    assert np.array(read.chromaticities) == pytest.approx(np.array(image.chromaticities))
    for name in "abcd":
        assert read.attributes[name] == image.attributes[name] and type(read.attributes[name]) is type(image.attributes[name])
    assert np.array_equal(read.attributes["e"], image.attributes["e"])


def test_files_of_other_formats(tmp_path):
    image = ramp()
    image.save(tmp_path / "a.exr", half=True, compression="piz", parts=True)
    read = tyndall.read_image(tmp_path / "a.exr")
    assert read.keys() == image.keys() and np.array_equal(read["Z"], image["Z"])
    assert np.array_equal(read.rgb, image.rgb.astype(np.float16))
    image.save(tmp_path / "a.pfm")
    assert np.array_equal(tyndall.read_image(tmp_path / "a.pfm").rgb, image.rgb)
    image.save(tmp_path / "a.png", view="agx", exposure=1)
    assert (tmp_path / "a.png").read_bytes() == image.png(view="agx", exposure=1) != image.png(exposure=1)


def test_notebooks_see_a_png(tmp_path):
    image = ramp()
    image.save(tmp_path / "a.png")
    assert image._repr_png_() == (tmp_path / "a.png").read_bytes() == image.png()
    shown = tyndall.read_image(tmp_path / "a.png").rgb
    assert np.abs(shown - image.rgb).max() < 0.01
    assert image.png(exposure=-1) != image.png()
    assert Image({"Z": np.ones((2, 2))})._repr_png_() is None


def test_what_a_render_returns_is_shown(floor):
    assert floor.render(spp=1)._repr_png_().startswith(b"\x89PNG")


def test_arrays_of_colours():
    rgb = np.random.default_rng(1).random((4, 5, 3)).astype(np.float32)
    image = Image.from_rgb(rgb)
    assert image.shape == (4, 5) and np.array_equal(image.rgb, rgb) and repr(image) == "<tyndall.Image 5 x 4: R, G, B>"
    with pytest.raises(ValueError, match="height, width, 3"):
        Image.from_rgb(rgb[:, :, 0])


def test_copies_keep_the_frame():
    image = Image(ramp(), data_window=(2, 3, 11, 9), display_window=(0, 0, 20, 10), attributes={"a": 7}, chromaticities=((0.7, 0.3),) * 4)
    image.report = {"samples": 4}
    more = {"W": np.ones((6, 9))}
    for other in (image.copy(), copy.copy(image), image | more, more | image, image | Image(more)):
        assert type(other) is Image and other.keys() >= image.keys() and other["R"] is image["R"]
        assert other.data_window == (2, 3, 11, 9) and other.display_window == (0, 0, 20, 10)
        assert (other.attributes, other.chromaticities, other.report) == (image.attributes, image.chromaticities, image.report)
    assert (image | more)["W"].dtype == np.float32 and "W" not in image
    image.copy().attributes["a"] = 8
    assert image.attributes == {"a": 7}
    with pytest.raises(TypeError):
        image | 7


def test_arrays_outlive_their_image(floor):
    red = floor.render(spp=1)["R"]
    copy = red.copy()
    for _ in range(3):
        floor.render(spp=1, seed=9)
    assert red.flags.writeable and np.array_equal(red, copy)


def test_images_that_cannot_be_written(tmp_path):
    image = ramp()
    with pytest.raises(tyndall.Error, match="ends in .exr, .png or .pfm"):
        image.save(tmp_path / "a.tif")
    for name, option in (("a.exr", dict(exposure=1)), ("a.exr", dict(view="agx")), ("a.png", dict(half=True)),
                         ("a.pfm", dict(parts=True)), ("a.png", dict(compression="piz"))):
        with pytest.raises(ValueError, match=next(iter(option))):
            image.save(tmp_path / name, **option)
    with pytest.raises(ValueError, match="choose from none, rle"):
        image.save(tmp_path / "a.exr", compression="jpeg")
    with pytest.raises(ValueError, match="choose from srgb, filmic, agx"):
        image.save(tmp_path / "a.png", view="aces")
    for exposure in (float("nan"), 65):
        with pytest.raises(ValueError, match="exposure must be a number from -64"):
            image.save(tmp_path / "a.png", exposure=exposure)
        with pytest.raises(ValueError, match="exposure must be a number from -64"):
            image.png(exposure=exposure)
    for name, option in (("a.exr", dict(half="no")), ("a.exr", dict(compression=7)), ("a.png", dict(exposure="1")), ("a.png", dict(view=None))):
        with pytest.raises(TypeError, match=next(iter(option)) + " = .* is not understood"):
            image.save(tmp_path / name, **option)
    with pytest.raises(TypeError, match="max_error = 'x' is not understood"):
        tyndall.diff(image, image, max_error="x")
    with pytest.raises(tyndall.Error) as caught:
        image.save(tmp_path / "none" / "a.exr")
    assert caught.value.failure == "output"
    image["G"] = np.zeros((2, 2))
    with pytest.raises(ValueError, match="one shape"):
        image.save(tmp_path / "a.exr")
    image = Image(ramp(), data_window=(0, 0, 3, 3))
    with pytest.raises(ValueError, match="data window"):
        image.png()
    assert list(tmp_path.iterdir()) == []


def test_files_that_cannot_be_read(tmp_path):
    (tmp_path / "a.exr").write_bytes(b"no image")
    for name in ("a.exr", "none.exr"):
        with pytest.raises(tyndall.Error, match=name):
            tyndall.read_image(tmp_path / name)
