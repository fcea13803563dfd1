"""Media made by hand: homogeneous ones, and grids of numpy arrays."""

from __future__ import annotations

from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any, Optional, Tuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import arrays


def _corners(bounds: Any) -> Tuple[arrays.Vector, arrays.Vector]:
    low, high = (arrays.vector(corner, "a corner of bounds") for corner in bounds)
    if not all(a < b for a, b in zip(low, high)):
        raise ValueError(f"bounds are two corners, the first below the second on each axis, not {bounds!r}")
    return low, high


def _x_fastest(voxels: NDArray[np.float32]) -> NDArray[np.float32]:
    """As Tyndall keeps a grid: x runs fastest, then y, then z; channels of a voxel together."""
    return np.ascontiguousarray(np.moveaxis(voxels, (0, 1, 2), (2, 1, 0))).ravel()


@dataclass(frozen=True, eq=False, kw_only=True)
class Medium:
    """What all media have. ``sigma_a`` and ``sigma_s``, absorption and scattering, are in 1/scene unit at density 1; ``g`` is the
    mean cosine of the Henyey-Greenstein phase function."""

    name: str = ""
    sigma_a: Any = 1.0
    sigma_s: Any = 1.0
    g: float = 0.0
    group: str = ""

    def _check(self) -> None:
        for name in ("sigma_a", "sigma_s"):
            object.__setattr__(self, name, arrays.color(getattr(self, name), name))
        g = arrays.number(self.g, "g", "a number between -1 and 1, both excluded", lambda g: -1 < g < 1)
        object.__setattr__(self, "g", g)


@dataclass(frozen=True, eq=False)
class HomogeneousMedium(Medium):
    """The same everywhere in a box. ``Le``: radiance scale of its emission sigma_a * Le."""

    bounds: Any = ((0, 0, 0), (1, 1, 1))
    Le: Any = 0.0
    to_world: Optional[ArrayLike] = None

    def __post_init__(self) -> None:
        self._check()
        object.__setattr__(self, "bounds", _corners(self.bounds))
        object.__setattr__(self, "Le", arrays.color(self.Le, "Le"))
        object.__setattr__(self, "to_world", arrays.matrix(self.to_world, "to_world"))

    def voxels(self) -> SimpleNamespace:
        """For the module: what the medium is made of."""
        return SimpleNamespace(kind="homogeneous", bounds=self.bounds, Le=self.Le)


@dataclass(frozen=True, eq=False)
class GridMedium(Medium):
    """Voxels of arrays indexed [x, y, z]; ``density`` may have three channels, [x, y, z, 3].

    Placed by ``bounds``, a box whose equal cells the voxels are the centres of, with nothing outside of it (pbrt's uniformgrid), or
    by ``transform``, a 4 x 4 matrix from index to world space with voxel (0, 0, 0) at index 0, interpolated to 0 around (OpenVDB's
    grids). ``temperature``, in kelvin, makes it emit as a black body, ``Le`` alone in one colour, both times ``Le_scale``.
    """

    density: Any = None
    bounds: Any = None
    transform: Optional[ArrayLike] = None
    temperature: Any = None
    Le: Any = 0.0
    Le_scale: float = 1.0

    def __post_init__(self) -> None:
        self._check()
        if self.density is None:
            raise ValueError("a grid medium has a density, an array [x, y, z]")
        if (self.bounds is None) == (self.transform is None):
            raise ValueError("a grid medium is placed by either bounds or transform")
        density = arrays.grid(self.density, "density")
        if self.temperature is not None:
            temperature = arrays.grid(self.temperature, "temperature", negative=True)
            if density.ndim == 4 or temperature.shape != density.shape:
                raise ValueError(f"temperature has the shape of a density of one channel, {density.shape[:3]}, not {temperature.shape}")
            object.__setattr__(self, "temperature", temperature)
        object.__setattr__(self, "density", density)
        object.__setattr__(self, "Le", arrays.color(self.Le, "Le"))
        scale = arrays.number(self.Le_scale, "Le_scale", "a number of 0 or more", lambda scale: scale >= 0)
        object.__setattr__(self, "Le_scale", scale)
        arrays.color(np.multiply(scale, self.Le), "Le times Le_scale")
        if self.bounds is not None:
            object.__setattr__(self, "bounds", _corners(self.bounds))
        else:
            object.__setattr__(self, "transform", arrays.matrix(self.transform, "transform"))

    @property
    def to_world(self) -> arrays.Matrix:
        """From the space that the box is in."""
        return arrays.matrix(self.transform, "transform")

    @staticmethod
    def from_openvdb(grid: Any, **fields: Any) -> "GridMedium":
        """Of a float grid of OpenVDB's Python module (Debian: python3-openvdb), by its active voxels and its transform."""
        low, high = grid.evalActiveVoxelBoundingBox()
        density = np.zeros([b - a + 1 for a, b in zip(low, high)], np.float32)
        grid.copyToArray(density, ijk=low)
        origin = np.array(grid.transform.indexToWorld(low), dtype=np.float64)
        transform = np.eye(4)
        for axis in range(3):
            step = [low[i] + (i == axis) for i in range(3)]
            transform[:3, axis] = np.array(grid.transform.indexToWorld(step)) - origin
        transform[:3, 3] = origin
        return GridMedium(density=density, transform=transform, **fields)

    def _placed(self, values: NDArray[np.float32]) -> NDArray[np.float32]:
        """By a transform, with the voxels of 0 around that interpolation reaches."""
        if self.bounds is not None:
            return values
        return np.pad(values, [(1, 1)] * 3 + [(0, 0)] * (values.ndim - 3))

    def voxels(self) -> SimpleNamespace:
        """For the module: what the medium is made of."""
        density = self._placed(self.density)
        size = density.shape[:3]
        bounds = self.bounds or ((-1.5, -1.5, -1.5), tuple(n - 1.5 for n in size))
        placed = SimpleNamespace(size=size, bounds=bounds)
        if density.ndim == 4:
            return self._rgb_voxels(placed, density)
        placed.kind = "grid"
        placed.density = _x_fastest(density)
        placed.temperature = None if self.temperature is None else _x_fastest(self._placed(self.temperature))
        placed.Le = self.Le
        placed.Le_scale = self.Le_scale if self.temperature is not None else 1.0
        if self.temperature is None:
            placed.Le = tuple(self.Le_scale * c for c in self.Le)
        return placed

    def _rgb_voxels(self, placed: SimpleNamespace, density: NDArray[np.float32]) -> SimpleNamespace:
        placed.kind = "rgb"
        for name in ("sigma_a", "sigma_s"):
            setattr(placed, name, _x_fastest(density * np.asarray(getattr(self, name), np.float32)))
        emission = self.Le_scale * np.asarray(self.Le, np.float32)
        placed.Le = _x_fastest(np.broadcast_to(emission, density.shape)) if emission.any() else None
        return placed
