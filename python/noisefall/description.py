"""Dataclasses of the scene format, made from its declarations when this module is imported.

>>> from noisefall import build, description as d
>>> scene = build(d.Description(
...     camera=d.Camera(eye=[0, 0, 4], look_at=[0, 0, 0], fov=40.0, resolution=[64, 64]),
...     materials={"white": d.Material(lambertian=d.Lambertian(albedo=0.7))},
...     objects=[d.Object(shape=d.Shape(sphere=d.Sphere(center=[0, 0, 0], radius=1.0)), material="white"),
...              d.Object(shape=d.Shape(sphere=d.Sphere(center=[0, 4, 0], radius=1.0)), emission=d.Emission(radiance=5.0))],
... ))

A field that is `None` is not in the scene file; the scene then has its default. Each class lists its fields with their meaning.
`python -m noisefall.stubs` prints this module with its types, for editors.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import Any

from .declarations import declarations

__all__ = ["to_dict"]


def to_dict(value: Any) -> Any:
    """A tree of dicts and lists without dataclasses and without fields that are `None`."""
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        value = {field.name: getattr(value, field.name) for field in dataclasses.fields(value)}
    if isinstance(value, Mapping):
        return {key: to_dict(item) for key, item in value.items() if item is not None}
    if isinstance(value, (list, tuple)):
        return [to_dict(item) for item in value]
    return value


for _table in declarations():
    globals()[_table.name] = _table.dataclass(__name__)
    __all__.append(_table.name)
