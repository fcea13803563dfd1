"""Tyndall, a volumetric path tracer, from Python.

>>> import tyndall
>>> scene = tyndall.load("hall.pbrt")
>>> image = scene.render(spp=16)
>>> image["R"].mean(), image.rgb.shape

docs/python.md of the project tells the rest.
"""

from ._core import aov_names, denoise_aovs
from ._core import version as _version
from .camera import Camera
from .compare import Comparison
from .diff import Difference, diff
from .errors import Error, SceneWarning
from .image import Image, denoise, read_image
from .lights import (DistantLight, GoniometricLight, InfiniteLight, Light, PointLight, ProjectionLight, SpotLight)
from .media import GridMedium, HomogeneousMedium, Medium
from .render import Progress, World
from .scene import Scene, load, loads

__version__ = _version()
__all__ = [
    "Camera", "Comparison", "Difference", "DistantLight", "Error", "GoniometricLight", "GridMedium", "HomogeneousMedium",
    "Image", "InfiniteLight", "Light", "Medium", "PointLight", "Progress", "ProjectionLight", "Scene", "SceneWarning",
    "SpotLight", "World", "aov_names", "denoise", "denoise_aovs", "diff", "load", "loads", "read_image",
]
