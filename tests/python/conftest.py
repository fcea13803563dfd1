"""What the tests share. PYTHONPATH has the module, TYNDALL_BIN the program, TYNDALL_SOURCE_DIR the checkout."""

import os
import subprocess
from pathlib import Path

import pytest

import tyndall

FLOOR = """
Film "rgb" "integer xresolution" 40 "integer yresolution" 24
Sampler "independent" "integer pixelsamples" 4
Integrator "volpath" "integer maxdepth" 3
LookAt 0 1 -4  0 0.5 0  0 1 0
Camera "perspective" "float fov" 45
WorldBegin
LightSource "point" "point3 from" [1 3 -1] "rgb I" [9 9 9]
MakeNamedMaterial "grey" "string type" "diffuse" "rgb reflectance" [0.5 0.5 0.5]
NamedMaterial "grey"
Shape "trianglemesh" "point3 P" [-4 0 -4 4 0 -4 4 0 4 -4 0 4] "integer indices" [0 1 2 0 2 3]
AttributeBegin
  MakeNamedMedium "fog" "string type" "homogeneous" "rgb sigma_s" [1 1 1] "rgb sigma_a" [0.2 0.2 0.2]
  Material "interface"
  MediumInterface "fog" ""
  Translate 0 0.6 0
  Shape "sphere" "float radius" 0.5
AttributeEnd
"""


@pytest.fixture
def floor_text() -> str:
    return FLOOR


@pytest.fixture
def floor() -> tyndall.Scene:
    """A floor and a ball of fog under a point light."""
    return tyndall.loads(FLOOR)


@pytest.fixture
def program():
    """Runs the command line."""

    def run(*arguments: object) -> subprocess.CompletedProcess:
        return subprocess.run([os.environ["TYNDALL_BIN"], *map(str, arguments)], capture_output=True, text=True)

    return run


@pytest.fixture
def checkout() -> Path:
    return Path(os.environ["TYNDALL_SOURCE_DIR"])


@pytest.fixture
def backlit():
    """An orthographic look along +z at [-2, 2]^2 through what is added, from z = -5, with radiance 1 behind: pixels are transmittances."""
    scene = tyndall.Scene()
    scene.resolution = (16, 16)
    scene.camera = tyndall.Camera.look_at((0, 0, -5), (0, 0, 0), kind="orthographic", screen_window=(-2, 2, -2, 2))
    scene.lights = [tyndall.InfiniteLight(L=1)]
    return scene
