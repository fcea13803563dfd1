"""Lights as plain, immutable values: ``dataclasses.replace(light, I=(1, 2, 3))`` makes a changed one.

Colours are linear Rec.709; of one number it is taken for all three channels.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Optional, Tuple

import numpy as np
from numpy.typing import ArrayLike

from . import arrays

_REC709 = (1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)


@dataclass(frozen=True, eq=False, kw_only=True)
class Light:
    """What all lights have: a light group, and the place in the scene file that they come from."""

    group: str = ""
    where: Tuple[str, int, int] = ("", 0, 0)

    def __post_init__(self) -> None:
        for name in ("I", "E", "L"):
            if hasattr(self, name):
                self._set(name, arrays.color(getattr(self, name), name))
        for name in ("position", "direction"):
            if hasattr(self, name):
                self._set(name, arrays.vector(getattr(self, name), name))
        if hasattr(self, "to_world"):
            self._set("to_world", arrays.matrix(getattr(self, "to_world"), "to_world"))

    def _set(self, name: str, value: Any) -> None:
        object.__setattr__(self, name, value)

    def __eq__(self, other: object) -> bool:
        if type(self) is not type(other):
            return NotImplemented
        mine, theirs = vars(self), vars(other)
        return all(np.array_equal(mine[name], theirs[name]) for name in mine)

    __hash__ = None  # type: ignore[assignment]


@dataclass(frozen=True, eq=False)
class PointLight(Light):
    """Intensity I (W/sr) from a point."""

    position: Any = (0.0, 0.0, 0.0)
    I: Any = 1.0


@dataclass(frozen=True, eq=False)
class SpotLight(Light):
    """From the origin along +z of ``to_world``; angles in degrees from the axis."""

    to_world: Optional[ArrayLike] = None
    I: Any = 1.0
    cone_angle: float = 30.0
    falloff_start: float = 25.0


@dataclass(frozen=True, eq=False)
class DistantLight(Light):
    """Parallel light along ``direction``; E is the irradiance of a surface that faces it."""

    direction: Any = (0.0, -1.0, 0.0)
    E: Any = 1.0


@dataclass(frozen=True, eq=False)
class InfiniteLight(Light):
    """Radiance L from all around, or L times an environment map."""

    L: Any = 1.0
    path: str = ""
    to_world: Optional[ArrayLike] = None
    illuminance: Optional[float] = None
    portal: Optional[Tuple[Any, Any, Any, Any]] = None
    to_rec709: Tuple[float, ...] = _REC709


@dataclass(frozen=True, eq=False)
class GoniometricLight(Light):
    """A point whose intensity depends on direction by a map or a photometric file (.ies)."""

    to_world: Optional[ArrayLike] = None
    I: Any = 1.0
    path: str = ""
    power: Optional[float] = None


@dataclass(frozen=True, eq=False)
class ProjectionLight(Light):
    """A point that projects an image along +z of ``to_world``."""

    to_world: Optional[ArrayLike] = None
    I: Any = 1.0
    path: str = ""
    fov: float = 90.0
    power: Optional[float] = None
