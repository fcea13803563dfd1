"""How far two images are apart, and whether more than noise is between them."""

from __future__ import annotations

import json
from typing import Any, Dict, Optional, Sequence

from . import _core
from .image import as_image


class Difference(Dict[str, Any]):
    """What ``tyndall diff --json`` prints: "same", "criterion", "reasons", "channels", "groups", "flip", "test". True when same."""

    @property
    def same(self) -> bool:
        return bool(self["same"])

    def __bool__(self) -> bool:
        return self.same

    @property
    def errors(self) -> Dict[str, Dict[str, float]]:
        """Metrics by group of channels: ``errors["RGB"]["relmse"]``."""
        names = ("mse", "relmse", "relmse_trimmed", "mape", "smape")
        return {group["name"]: {name: group[name] for name in names} for group in self.get("groups", [])}


def diff(image: Any, reference: Any, *, channels: Sequence[str] = (), test: bool = False, exact: bool = False,
         max_error: Optional[float] = None, max_relmse: Optional[float] = None, max_flip: Optional[float] = None,
         flip: bool = True, reference_noise: bool = False) -> Difference:
    """Hold ``image`` against ``reference``; each is an Image, a path, a dict of channels or an array [y, x, 3].

    The criteria that are given must all hold; with none it is the statistical test where both images have variances, else
    equality.
    """
    question = dict(channels=list(channels), test=test, exact=exact, max_error=max_error, max_relmse=max_relmse,
                    max_flip=max_flip, flip=flip, reference_noise=reference_noise)
    return Difference(json.loads(_core.diff(as_image(image), as_image(reference), question)))
