"""The camera as a plain, immutable value: ``dataclasses.replace(camera, fov=30)`` makes a changed one."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Optional, Tuple

from . import _core, arrays


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
        object.__setattr__(self, "to_world", arrays.matrix(self.to_world, "to_world"))
        if not 0 < self.fov < 180:
            raise ValueError(f"fov is an angle between 0 and 180 degrees, not {self.fov!r}")

    @staticmethod
    def look_at(eye: Any, target: Any, up: Any = (0, 1, 0), **fields: Any) -> "Camera":
        """A camera at ``eye`` that looks at ``target``; ``fields`` are the others, such as ``fov``."""
        to_world = _core.camera_to_world(arrays.vector(eye, "eye"), arrays.vector(target, "target"), arrays.vector(up, "up"))
        return Camera(to_world=to_world, **fields)
