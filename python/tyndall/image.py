"""Images: dicts of numpy arrays by channel, which notebooks show."""

from __future__ import annotations

import os
from typing import Any, Dict, Mapping, Optional, Tuple, Union

import numpy as np
from numpy.typing import NDArray

from . import _core

Window = Tuple[int, int, int, int]
PathLike = Union[str, bytes, "os.PathLike[str]", "os.PathLike[bytes]"]


class Image(Dict[str, NDArray[np.float32]]):
    """Float arrays [y, x] by channel: ``image["R"]``, ``image["Albedo.G"]`` ...

    ``attributes`` are those of an OpenEXR header, ``data_window`` and ``display_window`` (x0, y0, x1, y1), ends excluded;
    ``report`` tells what a render counted.
    """

    def __init__(self, channels: Optional[Mapping[str, Any]] = None, *, data_window: Optional[Window] = None,
                 display_window: Optional[Window] = None, attributes: Optional[Mapping[str, Any]] = None,
                 chromaticities: Optional[Tuple[Tuple[float, float], ...]] = None) -> None:
        super().__init__({name: np.asarray(values, dtype=np.float32) for name, values in dict(channels or {}).items()})
        self._data_window = data_window
        self._display_window = display_window
        self.attributes: Dict[str, Any] = dict(attributes or {})
        self.chromaticities = chromaticities
        self.report: Dict[str, Any] = {}

    @staticmethod
    def from_rgb(rgb: Any) -> "Image":
        """Of an array [y, x, 3]."""
        pixels = np.asarray(rgb, dtype=np.float32)
        if pixels.ndim != 3 or pixels.shape[2] != 3:
            raise ValueError(f"an array of shape (height, width, 3) is needed, not {pixels.shape}")
        return Image({name: pixels[:, :, i] for i, name in enumerate("RGB")})

    @property
    def shape(self) -> Tuple[int, int]:
        """Height and width, which all channels have."""
        shapes = {values.shape for values in self.values()}
        if len(shapes) > 1 or any(len(s) != 2 for s in shapes):
            raise ValueError(f"the channels of an image are arrays [y, x] of one shape, not of {sorted(shapes)}")
        height, width = next(iter(shapes), (0, 0))
        return height, width

    @property
    def data_window(self) -> Window:
        """Pixels of the full frame that the arrays hold."""
        height, width = self.shape
        x0, y0, x1, y1 = self._data_window or (0, 0, width, height)
        if (y1 - y0, x1 - x0) != (height, width):
            raise ValueError(f"the arrays are {width} x {height} where the data window is {x1 - x0} x {y1 - y0}")
        return x0, y0, x1, y1

    @property
    def display_window(self) -> Window:
        """The full frame."""
        return self._display_window or self.data_window

    @property
    def rgb(self) -> NDArray[np.float32]:
        """R, G and B as one array [y, x, 3]."""
        return np.stack([self[name] for name in "RGB"], axis=-1)

    def save(self, path: PathLike, *, half: bool = False, compression: str = "zip", parts: bool = False,
             exposure: float = 0, view: str = "srgb") -> None:
        """Write an .exr of all channels, an 8-bit .png of R, G, B or a .pfm of them.

        For .exr: ``half``, colours as 16-bit floats; ``compression``, "none", "rle", "zips", "zip", "piz", "dwaa" or "dwab";
        ``parts``, one for each group of channels. For .png: stops of ``exposure`` and ``view``, "srgb", "filmic" or "agx".
        """
        name = os.fsdecode(path)
        if (half or parts or compression != "zip") and not name.endswith(".exr"):
            raise ValueError(f"{name}: half, compression and parts are for .exr")
        if (exposure != 0 or view != "srgb") and not name.endswith(".png"):
            raise ValueError(f"{name}: exposure and view are for .png")
        _core.write_image(self, name, dict(half=half, compression=compression, parts=parts, exposure=exposure, view=view))

    def png(self, *, exposure: float = 0, view: str = "srgb") -> bytes:
        """R, G, B (or Y) as an 8-bit PNG after ``exposure`` stops, by the ``view`` "srgb", "filmic" or "agx"."""
        return _core.encode_png(self, exposure, view)

    def _repr_png_(self) -> Optional[bytes]:
        return self.png() if self.keys() >= set("RGB") or "Y" in self else None

    def copy(self) -> "Image":
        """Another image of the same arrays, with windows, attributes and report."""
        return self._like(self)

    def __or__(self, other: Mapping[str, Any]) -> "Image":  # type: ignore[override]
        return self._like({**self, **other}) if isinstance(other, Mapping) else NotImplemented

    def __ror__(self, other: Mapping[str, Any]) -> "Image":  # type: ignore[override]
        return self._like({**other, **self}) if isinstance(other, Mapping) else NotImplemented

    def _like(self, channels: Mapping[str, Any]) -> "Image":
        """Of other channels in the same frame."""
        image = Image(channels, data_window=self._data_window, display_window=self._display_window, attributes=self.attributes,
                      chromaticities=self.chromaticities)
        image.report = dict(self.report)
        return image

    def __repr__(self) -> str:
        height, width = self.shape
        return f"<tyndall.Image {width} x {height}: {', '.join(self)}>"


def read_image(path: PathLike) -> Image:
    """Read .exr, .png, .pfm, .hdr, .jpg, .tga or .bmp; 8-bit values become linear."""
    return _core.read_image(path)


def as_image(value: Any) -> Image:
    """An image, the path of one, a dict of channels or an array [y, x, 3]."""
    if isinstance(value, Image):
        return value
    if isinstance(value, (str, bytes, os.PathLike)):
        return read_image(value)
    return Image(value) if isinstance(value, Mapping) else Image.from_rgb(value)


def denoise(image: Any, *, threads: int = 0) -> Image:
    """The noise taken away of an Image or its path; best where it was rendered with ``aovs=tyndall.denoise_aovs()``."""
    clean, report = _core.denoise(as_image(image), threads)
    clean.report = report
    return clean
