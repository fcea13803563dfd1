"""Lights as plain, immutable values: ``dataclasses.replace(light, I=(1, 2, 3))`` makes a changed one.

Colours are linear Rec.709; of one number it is taken for all three channels.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Callable, Optional, Tuple

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
                self._set(name, arrays.emission(getattr(self, name), name))
        for name in ("position", "direction"):
            if hasattr(self, name):
                self._set(name, arrays.vector(getattr(self, name), name))
        for name in ("illuminance", "power"):
            if getattr(self, name, None) is not None:
                self._check(name, "a number of 0 or more", lambda strength: strength >= 0)
                self._set(name, getattr(self, name) or None)  # 0 is unset, as in scene files
        if hasattr(self, "to_world"):
            self._set("to_world", arrays.matrix(getattr(self, "to_world"), "to_world"))

    def _check(self, name: str, wanted: str, holds: Callable[[float], bool]) -> None:
        self._set(name, arrays.number(getattr(self, name), name, wanted, holds))

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
    """From the origin along +z of ``to_world``; angles in degrees from the axis. ``falloff_start``: 5 before ``cone_angle``, unless
    given."""

    to_world: Optional[ArrayLike] = None
    I: Any = 1.0
    cone_angle: float = 30.0
    falloff_start: Optional[float] = None

    def __post_init__(self) -> None:
        super().__post_init__()
        self._check("cone_angle", "an angle above 0 and at most 180 degrees", lambda angle: 0 < angle <= 180)
        if self.falloff_start is None:
            self._set("falloff_start", min(abs(self.cone_angle - 5), self.cone_angle))  # as scene files have it
        cone = float(np.float32(self.cone_angle))
        self._check("falloff_start", f"an angle from 0 to cone_angle, {cone:g} degrees", lambda angle: 0 <= angle <= cone)


@dataclass(frozen=True, eq=False)
class DistantLight(Light):
    """Parallel light along ``direction``; E is the irradiance of a surface that faces it."""

    direction: Any = (0.0, -1.0, 0.0)
    E: Any = 1.0

    def __post_init__(self) -> None:
        super().__post_init__()
        with np.errstate(over="ignore"):
            length = np.linalg.norm(np.asarray(self.direction, np.float32))
        if not 0 < length < np.inf:
            raise ValueError(f"direction is a vector with a length, not {self.direction!r}")


@dataclass(frozen=True, eq=False)
class InfiniteLight(Light):
    """Radiance L from all around, or L times an environment map."""

    L: Any = 1.0
    path: str = ""
    to_world: Optional[ArrayLike] = None
    illuminance: Optional[float] = None
    portal: Optional[Tuple[Any, Any, Any, Any]] = None
    to_rec709: Tuple[float, ...] = _REC709

    def __post_init__(self) -> None:
        super().__post_init__()
        self._set("to_rec709", arrays.numbers(self.to_rec709, 9, "to_rec709"))
        if self.portal is None:
            return
        if len(self.portal) != 4:
            raise ValueError(f"portal has four corners, in order around the rectangle, not {len(self.portal)}")
        self._set("portal", tuple(arrays.vector(corner, "a corner of portal") for corner in self.portal))


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

    def __post_init__(self) -> None:
        super().__post_init__()
        self._check("fov", "an angle between 0 and 180 degrees", lambda angle: 0 < angle < 180)
