"""Numbers and arrays as they come from users, checked: what is wrong is a ValueError that says what was expected."""

from __future__ import annotations

from typing import Any, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

Vector = Tuple[float, float, float]
Color = Union[float, Sequence[float]]
Matrix = NDArray[np.float64]


def vector(value: Any, name: str) -> Vector:
    """Three finite numbers."""
    v = np.asarray(value, dtype=np.float64)
    if v.shape != (3,) or not np.isfinite(v).all():
        raise ValueError(f"{name} is three finite numbers, not {value!r}")
    return float(v[0]), float(v[1]), float(v[2])


def color(value: Any, name: str) -> Vector:
    """Linear Rec.709 R, G, B, or one number for all three; none below 0."""
    v = np.asarray(value, dtype=np.float64)
    if v.shape == ():
        v = np.repeat(v, 3)
    if v.shape != (3,) or not np.isfinite(v).all() or (v < 0).any():
        raise ValueError(f"{name} is one or three numbers, finite and not negative, not {value!r}")
    return float(v[0]), float(v[1]), float(v[2])


def matrix(value: Optional[ArrayLike], name: str) -> Matrix:
    """A 4 x 4 matrix for column vectors; None is the identity."""
    m = np.eye(4) if value is None else np.array(value, dtype=np.float64)
    if m.shape != (4, 4) or not np.isfinite(m).all() or not np.array_equal(m[3], (0, 0, 0, 1)):
        raise ValueError(f"{name} is a 4 x 4 matrix of finite numbers whose last row is 0 0 0 1")
    if np.linalg.matrix_rank(m) < 4:
        raise ValueError(f"{name} is singular: it takes space to a plane, a line or a point")
    return m


def translation(offset: Any) -> Matrix:
    """The matrix that moves by ``offset``."""
    m = np.eye(4)
    m[:3, 3] = vector(offset, "a translation")
    return m


def grid(value: ArrayLike, name: str, *, negative: bool = False) -> NDArray[np.float32]:
    """Voxels [x, y, z], or [x, y, z, channel] of three channels; finite."""
    v = np.asarray(value, dtype=np.float32)
    if v.ndim not in (3, 4) or v.size == 0 or (v.ndim == 4 and v.shape[3] != 3):
        raise ValueError(f"{name} is an array [x, y, z] or [x, y, z, 3], not one of shape {v.shape}")
    if not np.isfinite(v).all():
        raise ValueError(f"{name} has values that are NaN or infinite; numpy.nan_to_num removes them")
    if not negative and (v < 0).any():
        raise ValueError(f"{name} has values below 0; numpy.maximum({name}, 0) removes them")
    return v


def rows(value: Optional[ArrayLike], columns: int, name: str) -> NDArray[np.float32]:
    """An n x ``columns`` array of finite numbers; None has no rows."""
    v = np.zeros((0, columns), np.float32) if value is None else np.asarray(value, dtype=np.float32)
    if v.ndim != 2 or v.shape[1] != columns or not np.isfinite(v).all():
        raise ValueError(f"{name} is an array of finite numbers of shape (n, {columns}), not {v.shape}")
    return np.ascontiguousarray(v)
