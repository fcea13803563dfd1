"""Scenes: read from files, changed and made by hand, rendered."""

from __future__ import annotations

import warnings
from types import SimpleNamespace
from typing import Any, Callable, Dict, Iterable, List, Mapping, Optional, Tuple, Type, TypeVar

import numpy as np
from numpy.typing import ArrayLike

from . import _core, arrays
from .camera import Camera
from .compare import Comparison, compare
from .errors import SceneWarning
from .image import Image, PathLike
from .lights import Light
from .media import Medium
from .render import ProgressCallback, World, repeatable

Kind = TypeVar("Kind")


def load(path: PathLike, *, frame: Optional[int] = None) -> "Scene":
    """Read a scene file, .pbrt or .pbrt.gz; ``frame`` fills %04d and $F4 in the names of files. Raises Error at the first problem."""
    return _told(_core.read_scene(path, frame))


def loads(text: str, *, name: str = "<text>", folder: PathLike = ".") -> "Scene":
    """Read a scene from text; ``name`` stands for the file in messages, relative paths start at ``folder``."""
    return _told(_core.read_scene_text(text, name, folder))


def _told(read: Tuple[_core.Scene, List[Tuple[str, int, int, str]]]) -> "Scene":
    core, found = read
    for file, line, column, message in found:
        warnings.warn(SceneWarning(message, file, line, column), stacklevel=3)
    scene = Scene()
    scene._core = core
    return scene


def _of(kind: Type[Kind], value: Kind) -> Kind:
    if not isinstance(value, kind):
        raise TypeError(f"{value!r} is no {kind.__name__.lower()}; give one of tyndall's")
    return value


class Scene:
    """A scene as plain data. What it gives out are values: assign a changed one to change the scene."""

    def __init__(self) -> None:
        self._core = _core.Scene()

    def copy(self) -> "Scene":
        """Another scene of the same content."""
        other = Scene()
        other._core = self._core.copy()
        return other

    __copy__ = copy

    def __deepcopy__(self, memo: Dict[int, Any]) -> "Scene":
        return self.copy()

    def __reduce__(self) -> Any:
        raise TypeError("a Scene cannot be pickled; pass on its file, or what it is made of")

    # ------------------------------------------------------------------------------------------- what it holds

    @property
    def lights(self) -> Tuple[Light, ...]:
        """All but shapes that emit: ``scene.lights = [...]`` replaces them, ``scene.lights += (light,)`` adds one."""
        return tuple(self._core.lights())

    @lights.setter
    def lights(self, lights: Iterable[Light]) -> None:
        self._core.set_lights(list(lights))

    @property
    def camera(self) -> Camera:
        """``scene.camera = dataclasses.replace(scene.camera, fov=30)`` changes it; the medium around it and lenses stay."""
        return self._core.camera()

    @camera.setter
    def camera(self, camera: Camera) -> None:
        self._core.set_camera(_of(Camera, camera))

    @property
    def resolution(self) -> Tuple[int, int]:
        """Width and height of the frame; a new one takes crops away."""
        return self._core.resolution()

    @resolution.setter
    def resolution(self, size: Tuple[int, int]) -> None:
        width, height = (arrays.whole(n, "a width or height") for n in size)
        if not (1 <= width <= 65536 and 1 <= height <= 65536):
            raise ValueError(f"a resolution is a width and a height of 1 to 65536 pixels, not {width} x {height}")
        self._core.set_resolution(width, height)

    @property
    def settings(self) -> Dict[str, Any]:
        """What the scene asks for where ``render`` is not told otherwise; of those assigned, the ones that are named change.

        ``spp`` is None where ``time``, ``error`` or ``error_max`` alone ends a render; when these are taken away it is that of a
        new scene. Assigned as None it stays.
        """
        return self._core.settings()

    @settings.setter
    def settings(self, options: Mapping[str, Any]) -> None:
        self._core.set_settings(dict(options))

    @property
    def media(self) -> List[str]:
        """Names of media."""
        return self._core.media()

    @property
    def materials(self) -> List[str]:
        """Names of materials."""
        return self._core.materials()

    # ----------------------------------------------------------------------------------------------- adding to it

    def add_medium(self, medium: Medium) -> None:
        """Add a medium in its box; it overlaps with others that are there."""
        self._core.add_medium(_of(Medium, medium))

    def replace_medium(self, name: str, medium: Medium) -> None:
        """Put ``medium`` in place of the one called ``name``, in the shapes that hold that one."""
        self._core.replace_medium(name, _of(Medium, medium))

    def add_material(self, name: str, reflectance: arrays.Color) -> None:
        """Add a diffuse material; ``reflectance`` is at most 1."""
        self._core.add_material(name, arrays.color(reflectance, "reflectance", most=1))

    def add_mesh(self, positions: ArrayLike, triangles: ArrayLike, *, material: str, normals: Optional[ArrayLike] = None,
                 uvs: Optional[ArrayLike] = None, emission: Optional[arrays.Color] = None, group: str = "",
                 to_world: Optional[ArrayLike] = None) -> None:
        """Add triangles: ``positions`` (n, 3), ``triangles`` (m, 3) of their indices; ``emission``: radiance."""
        points = arrays.rows(positions, 3, "positions")
        indices = np.asarray(triangles)
        if indices.ndim != 2 or indices.shape[1] != 3 or not np.issubdtype(indices.dtype, np.integer):
            raise ValueError(f"triangles is an array of integers of shape (m, 3), not {indices.dtype} of {indices.shape}")
        if indices.size and not (0 <= indices.min() and indices.max() < len(points)):
            raise ValueError(f"triangles has indices from {indices.min()} to {indices.max()} for {len(points)} positions")
        others = arrays.rows(normals, 3, "normals"), arrays.rows(uvs, 2, "uvs")
        for name, rows in zip(("normals", "uvs"), others):
            if len(rows) not in (0, len(points)):
                raise ValueError(f"{name} has {len(rows)} rows for {len(points)} positions")
        self._core.add_mesh(points, indices, *others, self._look(material, emission, group, to_world))

    def add_sphere(self, center: Any, radius: float, *, material: str, emission: Optional[arrays.Color] = None,
                   group: str = "") -> None:
        """Add a sphere; ``emission``: radiance."""
        size = arrays.number(radius, "radius", "a number above 0", lambda r: r > 0)
        self._core.add_sphere(size, self._look(material, emission, group, arrays.translation(center)))

    @staticmethod
    def _look(material: str, emission: Optional[arrays.Color], group: str, to_world: Optional[ArrayLike]) -> SimpleNamespace:
        radiance = None if emission is None else arrays.color(emission, "emission")
        return SimpleNamespace(material=material, emission=radiance, group=group, to_world=arrays.matrix(to_world, "to_world"))

    # ---------------------------------------------------------------------------------------------- pictures of it

    def build(self, *, sanitize: bool = False, max_memory: Optional[float] = None, **options: Any) -> World:
        """Make it ready to render, once for several renders: ``options`` are those of ``render`` that matter here, ``lights``,
        ``emission`` and ``threads``. ``sanitize``: NaN voxels become 0; ``max_memory``: GB, refused above, where None is what the
        machine or a container's limit allows."""
        core = self._core.copy()
        return World(_core.build(core, options, sanitize, max_memory), core)

    def render(self, *, progress: Optional[ProgressCallback] = None, sanitize: bool = False,
               max_memory: Optional[float] = None, **options: Any) -> Image:
        """Render it. ``options`` are those of the command line, with underscores: ``spp``, ``time``, ``error``, ``max_depth``,
        ``seed``, ``threads``, ``crop`` (x0, y0, x1, y1), ``aovs``, ``lights``, ``media`` ... ``progress`` is called a few times a
        second with a Progress. Other Python threads go on meanwhile. Ctrl-C ends it with KeyboardInterrupt."""
        options = repeatable(options)
        return self.build(sanitize=sanitize, max_memory=max_memory, **options).render(progress=progress, **options)

    def compare(self, methods: Mapping[str, Mapping[str, Any]], *, time: Optional[float] = None, spp: Optional[int] = None,
                seeds: int = 5, seed: int = 1, reference: Any = None, reference_error: float = 1e-3,
                reference_time: Optional[float] = None, threads: int = 0, max_memory: Optional[float] = None,
                progress: Optional[Callable[[float], object]] = None) -> Comparison:
        """Methods side by side, each a name and its options: ``{"tree": {"lights": "tree"}, "power": {"lights": "power"}}``. What
        would change the right picture, such as ``max_depth``, is no option of one: it is for all, in ``settings``.

        Every one renders ``seeds`` times for ``time`` seconds (20, unless ``spp`` is given). Errors are measured against
        ``reference`` (an Image or a path), or one that is rendered with the first method. ``max_memory`` is as of ``render``.
        """
        plan = dict(time=time, spp=spp, seeds=seeds, seed=seed, reference=reference, reference_error=reference_error,
                    reference_time=reference_time, threads=threads, max_memory=max_memory)
        return compare(self._core, methods, plan, progress)
