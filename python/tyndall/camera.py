"""The camera as a plain, immutable value: ``dataclasses.replace(camera, fov=30)`` makes a changed one."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Callable, Optional, Tuple

import numpy as np

from . import _core, arrays


def _window(value: Any) -> Tuple[float, float, float, float]:
    x0, x1, y0, y1 = arrays.numbers(value, 4, "screen_window")
    if np.float32(x0) == np.float32(x1) or np.float32(y0) == np.float32(y1):
        raise ValueError(f"screen_window is empty: x0 and x1, y0 and y1 of {value!r} must differ")
    return x0, x1, y0, y1


@dataclass(frozen=True, eq=False)
class Camera:
    """``kind``: "perspective", "orthographic", "spherical_equal_area", "spherical_equirectangular", or "realistic" of a scene file.

    Camera space has +z forward and +y up; ``fov`` is in degrees, of the shorter screen axis.
    """

    kind: str = "perspective"
    to_world: Any = None
    fov: float = 90.0
    lens_radius: float = 0.0
    focal_distance: float = 1e6
    screen_window: Optional[Tuple[float, float, float, float]] = None
    frame_aspect_ratio: Optional[float] = None

    def __post_init__(self) -> None:
        def check(name: str, wanted: str, holds: Callable[[float], bool]) -> None:
            self._set(name, arrays.number(getattr(self, name), name, wanted, holds))

        self._set("to_world", arrays.matrix(self.to_world, "to_world"))
        check("fov", "an angle between 0 and 180 degrees", lambda angle: 0 < angle < 180)
        check("lens_radius", "a number of 0 or more", lambda radius: radius >= 0)
        check("focal_distance", "a number above 0", lambda distance: distance > 0)
        if self.frame_aspect_ratio is not None:
            check("frame_aspect_ratio", "a number above 0", lambda ratio: ratio > 0)
        if self.screen_window is not None:
            self._set("screen_window", _window(self.screen_window))

    def _set(self, name: str, value: Any) -> None:
        object.__setattr__(self, name, value)

    @staticmethod
    def look_at(eye: Any, target: Any, up: Any = (0, 1, 0), **fields: Any) -> "Camera":
        """A camera at ``eye`` that looks at ``target``; ``fields`` are the others, such as ``fov``."""
        to_world = _core.camera_to_world(arrays.vector(eye, "eye"), arrays.vector(target, "target"), arrays.vector(up, "up"))
        return Camera(to_world=to_world, **fields)
