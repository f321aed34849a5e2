"""Renders scenes with Noisefall, a progressive path tracer.

>>> import noisefall
>>> image = noisefall.load("cornell_box").render(spp=4, size=(64, 64))
>>> image.radiance.shape
(64, 64, 3)

Scenes come from files of any format that the program takes (`load`), from the names of the scenes that come with the program
(`scenes`), from text (`parse`), or from trees of values (`build`): dicts, or the dataclasses of `noisefall.description`, which are
made from the declarations of the scene format.

Errors of scenes are `SceneError`, errors of images `RenderError`. Their texts are those of the program. Arguments out of range
raise `ValueError`.
"""

import json as _json
from typing import Any as _Any

from . import description
from ._noisefall import NoisefallError, RenderError, SceneError, schema as _schema, scenes
from .image import Comparison, Image, compare
from .path import Path
from .scene import Scene, build, load, parse
from .validation import Section, Statement, Validation, validate

__all__ = [
    "Comparison",
    "Image",
    "NoisefallError",
    "Path",
    "RenderError",
    "Scene",
    "SceneError",
    "Section",
    "Statement",
    "Validation",
    "build",
    "compare",
    "description",
    "load",
    "parse",
    "scenes",
    "schema",
    "validate",
]


def schema() -> dict[str, _Any]:
    """The JSON Schema of scene files, as `noisefall schema` prints it."""
    tree: dict[str, _Any] = _json.loads(_schema())
    return tree
