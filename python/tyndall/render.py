"""Worlds, which are scenes ready to render."""

from __future__ import annotations

from typing import Any, Callable, Dict, Iterator, List, Mapping, NamedTuple, Optional

from . import _core
from .image import Image


class Progress(NamedTuple):
    """Where a render stands."""

    samples_done: int  #: a pixel
    fraction: float  #: of the whole, 0 to 1
    seconds: float  #: since the start
    remaining: float  #: seconds, estimated
    preparing: bool  #: no sample has begun


ProgressCallback = Callable[[Progress], object]


def repeatable(options: Mapping[str, Any]) -> Dict[str, Any]:
    """Options that can be read several times: what an iterator gives, once."""
    return {name: list(value) if isinstance(value, Iterator) else value for name, value in options.items()}


class World:
    """A scene as it was when it was built: immutable, and built for one strategy of lights."""

    def __init__(self, core: _core.World, scene: _core.Scene) -> None:
        self._core = core
        self._scene = scene

    @property
    def notes(self) -> List[str]:
        """Grids chosen, voxels mended, and other things to be seen."""
        return self._core.notes()

    def render(self, *, progress: Optional[ProgressCallback] = None, **options: Any) -> Image:
        """As Scene.render."""
        image, report = self._core.render(self._scene, options, progress)
        image.report = {**report, "notes": self.notes}
        return image
