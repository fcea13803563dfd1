"""Numbers and arrays as they come from users, checked: what is wrong is a ValueError that says what was expected.

Tyndall's numbers are floats of 32 bits: one that these cannot hold is as wrong as one that is not finite. What values keep is
copied, and cannot be written.
"""

from __future__ import annotations

import operator
from typing import Any, Callable, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core

Vector = Tuple[float, float, float]
Color = Union[float, Sequence[float]]
Matrix = NDArray[np.float64]

_LARGEST = float(np.finfo(np.float32).max)


def _is_held(values: Any) -> bool:
    """Whether a float holds them; NaN is above everything here."""
    return bool((np.abs(values) <= _LARGEST).all())


def number(value: Any, name: str, wanted: str, holds: Callable[[float], bool]) -> float:
    """A number of which ``holds`` is true, as the float that it becomes too; ``wanted`` says it in words."""
    try:
        given = float(operator.pos(value))  # which texts have not
    except TypeError:
        raise TypeError(f"{name} is {wanted}, not {value!r}") from None
    if not _is_held(given) or not holds(float(np.float32(given))):
        raise ValueError(f"{name} is {wanted}, not {value!r}")
    return given


def whole(value: Any, name: str) -> int:
    """A whole number; one with a fraction, or in a text, is a TypeError."""
    try:
        return operator.index(value)
    except TypeError:
        raise TypeError(f"{name} is a whole number, not {value!r}") from None


def numbers(value: Any, count: int, name: str) -> Tuple[float, ...]:
    """So many finite numbers."""
    v = np.asarray(value, dtype=np.float64)
    if v.shape != (count,) or not _is_held(v):
        raise ValueError(f"{name} is {count} finite numbers, not {value!r}")
    return tuple(v.tolist())


def vector(value: Any, name: str) -> Vector:
    """Three finite numbers."""
    x, y, z = numbers(value, 3, name)
    return x, y, z


def color(value: Any, name: str, *, most: float = _LARGEST) -> Vector:
    """Linear Rec.709 R, G, B, or one number for all three; none below 0 or above ``most``."""
    v = np.asarray(value, dtype=np.float64)
    if v.shape == ():
        v = np.repeat(v, 3)
    if v.shape != (3,) or not _is_held(v) or (v < 0).any() or (v > most).any():
        wanted = "finite and not negative" if most == _LARGEST else f"from 0 to {most:g}"
        raise ValueError(f"{name} is one or three numbers, {wanted}, not {value!r}")
    return float(v[0]), float(v[1]), float(v[2])


def emission(value: Any, name: str) -> Vector:
    """Linear Rec.709 as ``color``; one that lies outside of it, as scene files can give, has channels below 0 beside others."""
    v = np.asarray(value, dtype=np.float64)
    if v.shape == (3,) and _is_held(v) and v.max() > 0:
        return float(v[0]), float(v[1]), float(v[2])
    return color(value, name)


def matrix(value: Optional[ArrayLike], name: str) -> Matrix:
    """A 4 x 4 matrix for column vectors; None is the identity."""
    m = np.eye(4) if value is None else np.array(value, dtype=np.float64)
    if m.shape != (4, 4) or not _is_held(m) or not np.array_equal(m[3], (0, 0, 0, 1)):
        raise ValueError(f"{name} is a 4 x 4 matrix of finite numbers whose last row is 0 0 0 1")
    if not _core.is_invertible(m):
        raise ValueError(f"{name} is singular: it takes space to a plane, a line or a point")
    m.setflags(write=False)
    return m


def translation(offset: Any) -> Matrix:
    """The matrix that moves by ``offset``."""
    m = np.eye(4)
    m[:3, 3] = vector(offset, "a translation")
    return m


def _floats(value: ArrayLike) -> NDArray[np.float32]:
    """A copy; numbers that a float cannot hold become infinite."""
    with np.errstate(over="ignore"):
        return np.array(value, dtype=np.float32)


def grid(value: ArrayLike, name: str, *, negative: bool = False) -> NDArray[np.float32]:
    """Voxels [x, y, z], or [x, y, z, channel] of three channels; finite."""
    v = _floats(value)
    if v.ndim not in (3, 4) or v.size == 0 or (v.ndim == 4 and v.shape[3] != 3):
        raise ValueError(f"{name} is an array [x, y, z] or [x, y, z, 3], not one of shape {v.shape}")
    if not np.isfinite(v).all():
        raise ValueError(f"{name} has values that are NaN or infinite; numpy.nan_to_num removes them")
    if not negative and (v < 0).any():
        raise ValueError(f"{name} has values below 0; numpy.maximum({name}, 0) removes them")
    v.setflags(write=False)
    return v


def rows(value: Optional[ArrayLike], columns: int, name: str) -> NDArray[np.float32]:
    """An n x ``columns`` array of finite numbers; None has no rows."""
    v = np.zeros((0, columns), np.float32) if value is None else _floats(value)
    if v.ndim != 2 or v.shape[1] != columns:
        raise ValueError(f"{name} is an array of finite numbers of shape (n, {columns}), not {v.shape}")
    if not np.isfinite(v).all():
        raise ValueError(f"{name} has values that are NaN, infinite or too large for a float; take them out")
    return np.ascontiguousarray(v)
