"""The scripts that the documentation shows run, and show what they say."""

import subprocess
import sys

import numpy as np
import pytest

import tyndall


def run(script, *arguments):
    done = subprocess.run([sys.executable, script, *map(str, arguments)], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_smoke_of_arrays(tmp_path, checkout):
    said = run(checkout / "docs/python/smoke_from_arrays.py", "--spp", 4, "--resolution", "96x54", "-o", tmp_path / "smoke")
    assert "4 samples a pixel" in said
    image = tyndall.read_image(tmp_path / "smoke.exr")
    assert image.shape == (54, 96) and np.isfinite(image.rgb).all()
    # The column stands in the middle, lit: there is more light than in the dark above the floor beside it.
    assert image.rgb[8:30, 36:60].mean() > 3 * image.rgb[8:20, :12].mean()
    assert tyndall.read_image(tmp_path / "smoke.png").shape == (54, 96)


def test_media_strategies_as_a_plot(tmp_path, checkout, floor_text):
    pytest.importorskip("matplotlib")
    (tmp_path / "floor.pbrt").write_text(floor_text)
    said = run(checkout / "docs/python/media_strategies.py", tmp_path / "floor.pbrt", "--spp", 8, "--seeds", 2, "--resolution", "32x18",
               "--reference-error", 0.01, "-o", tmp_path / "plot.png")
    assert any(name in said.splitlines()[-1] for name in ("vertex", "closest", "integral", "product")), said
    plot = tyndall.read_image(tmp_path / "plot.png")
    colours = {tuple(c) for c in np.round(plot.rgb.reshape(-1, 3) * 255).astype(int)}
    assert plot.shape == (480, 1200) and len(colours) > 50


def run_block(number, folder, checkout, scene):
    """A block of docs/python.md, with another scene under the name it loads."""
    text = (checkout / "docs/python.md").read_text()
    program = text.split("```python\n")[number].split("```")[0]
    (folder / "hall.pbrt").write_text(scene)
    done = subprocess.run([sys.executable, "-c", program], cwd=folder, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


def test_the_documentations_program(tmp_path, checkout, floor_text):
    run_block(1, tmp_path, checkout, floor_text)
    assert (tmp_path / "hall.exr").exists() and (tmp_path / "hall.png").exists()


def test_the_documentations_changes(tmp_path, checkout, floor_text):
    run_block(2, tmp_path, checkout, floor_text)
