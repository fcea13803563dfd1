"""Methods side by side on one scene: error against time."""

from __future__ import annotations

import json
from typing import Any, Dict, List, Mapping

from . import _core
from .image import Image, as_image


class Comparison(Dict[str, Any]):
    """What ``tyndall compare`` writes to results.json, with ``images`` by method and the ``reference``."""

    def __init__(self, results: Mapping[str, Any], reference: Image, images: Dict[str, Image]) -> None:
        super().__init__(results)
        self.reference = reference
        self.images = images

    @property
    def methods(self) -> List[str]:
        """Names, in the order given."""
        return [variant["name"] for variant in self["variants"]]

    def curve(self, method: str) -> List[Dict[str, float]]:
        """Of a method, at 1, 2, 4 ... samples: "seconds", "samples", "mse", "relmse", "relmse_low", "relmse_high"."""
        for variant in self["variants"]:
            if variant["name"] == method:
                return list(variant["checkpoints"])
        raise KeyError(f"no method is called {method!r}; choose from {', '.join(self.methods)}")


def compare(scene: _core.Scene, methods: Mapping[str, Mapping[str, Any]], plan: Dict[str, Any], progress: Any) -> Comparison:
    """See Scene.compare."""
    if plan["time"] is None and plan["spp"] is None:
        plan["time"] = 20.0
    if plan["reference"] is not None:
        plan["reference"] = as_image(plan["reference"])
    text, reference, images = _core.compare(scene, {name: dict(options) for name, options in methods.items()}, plan, progress)
    return Comparison(json.loads(text), reference, images)
