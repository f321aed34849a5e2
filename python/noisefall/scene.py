"""Scenes, and what can be asked of them."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterable, Mapping
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from . import _noisefall, description
from .image import Image
from .path import Path

Estimator = Literal["path", "light", "mis", "caustics", "light_tracing", "bidirectional", "auto"]
Directions = Literal["uniform", "cosine", "bsdf"]
Sampler = Literal["independent", "stratified", "sobol", "bluenoise"]
Reuse = Literal["auto", "suffixes", "outliers", "both", "off"]

#: Called with the image so far. Returning `False` stops the render.
Callback = Callable[[Image], "bool | None"]


class Scene:
    """A compiled scene. `load`, `parse` and `build` make it."""

    def __init__(self, native: _noisefall.Scene) -> None:
        self._native = native

    @property
    def title(self) -> str:
        """The title of the scene in the window."""
        return self._native.title

    @property
    def notes(self) -> str:
        """Notes about the scene."""
        return self._native.notes

    @property
    def text(self) -> str:
        """The scene as the text of a scene file, whatever the format it was read from."""
        return self._native.text

    @property
    def size(self) -> tuple[int, int]:
        """Width and height of its image in pixels."""
        return self._native.size

    @property
    def object_count(self) -> int:
        """The number of its objects."""
        return self._native.object_count

    @property
    def warnings(self) -> list[str]:
        """Likely mistakes, as `noisefall check` reports them."""
        return self._native.warnings

    @property
    def remarks(self) -> list[str]:
        """Parts that were not imported exactly from a file of another program."""
        return self._native.remarks

    def render(
        self,
        *,
        spp: int | None = None,
        time: float | None = None,
        noise: float | None = None,
        size: tuple[int, int] | None = None,
        callback: Callback | None = None,
        stops: Iterable[int] = (),
        bounces: bool = False,
        threads: int = 0,
        estimator: Estimator | None = None,
        merging: bool | None = None,
        directions: Directions | None = None,
        sampler: Sampler | None = None,
        max_bounces: int | Literal["none"] | None = None,
        count_crossings: bool | None = None,
        roulette: str | float | None = None,
        reuse: Reuse | None = None,
        adaptive: bool | None = None,
        seed: int | None = None,
    ) -> Image:
        """Renders an image. The GIL is released, and Ctrl+C stops the render.

        The settings are the options of `noisefall render`; `None` takes that of the scene. Equal settings give the bits of the
        program's image.

        spp: stops after this many samples per pixel. Without `spp`, `time` and `noise`: the scene's number, or 256.
        time: stops after this many seconds.
        noise: stops at an estimated relative noise; 0.01 is 1 %. The first of the given targets stops the render.
        size: width and height in pixels.
        callback: called with the image so far, twice a second and at the end. It stops the render by returning `False`; an exception
            stops it too, and is raised here.
        stops: calls `callback` at these numbers of samples per pixel and at the end, instead of twice a second.
        bounces: renders a second time to the same target, for `Image.bounces`.
        threads: the number of threads; 0 is one per core.
        """
        settings = _settings(
            spp=spp,
            time=time,
            noise=noise,
            size=size,
            stops=list(stops),
            bounces=bounces,
            threads=threads,
            estimator=estimator,
            merging=merging,
            directions=directions,
            sampler=sampler,
            max_bounces=max_bounces,
            count_crossings=count_crossings,
            roulette=roulette,
            reuse=reuse,
            adaptive=adaptive,
            seed=seed,
        )
        show = None if callback is None else lambda native: callback(Image(native))
        return Image(self._native.render(settings, show))

    def replay(
        self, x: int, y: int, sample: int = 0, *, size: tuple[int, int] | None = None, **settings: Any
    ) -> Path:
        """Traces one sample of a pixel again, with every term. Further arguments are settings of `render`."""
        tree, text = self._native.replay([x, y], sample, _settings(size=size, **settings))
        return Path(json.loads(tree), text)

    def samples(
        self, x: int, y: int, count: int, *, first: int = 0, size: tuple[int, int] | None = None, **settings: Any
    ) -> NDArray[np.float32]:
        """The radiance of samples of a pixel, one per row. Their mean is the pixel. Further arguments are settings of `render`."""
        return self._native.samples([x, y], (first, first + count), _settings(size=size, **settings))

    def __repr__(self) -> str:
        width, height = self.size
        return f"<noisefall.Scene {self.title!r}, {width} × {height}>"


def load(
    path: str | os.PathLike[str],
    *,
    define: Mapping[str, Any] | None = None,
    at: float | None = None,
    variant: str | None = None,
    allow_outside: bool = False,
) -> Scene:
    """Opens a scene file of any format that the program takes, an image that carries its scene, or a scene of `scenes` by its name.

    define: values of parameters, such as `{"spp": 16}` for `$spp` in a Mitsuba scene.
    at: time of the animations of a glTF scene in seconds.
    variant: variant of the materials of a glTF scene.
    allow_outside: reads files outside the folder of the scene too, if it names them.
    """
    defines = [(name, str(value)) for name, value in (define or {}).items()]
    return Scene(_noisefall.load(path, defines, at, variant, allow_outside))


def parse(text: str, name: str = "scene.toml") -> Scene:
    """Compiles the text of a scene file. Paths in it are relative to the folder of `name`."""
    return Scene(_noisefall.parse(text, name))


def build(scene: Mapping[str, Any] | description.Description, folder: str | os.PathLike[str] = "") -> Scene:
    """Compiles a tree of values: dicts, lists, numbers and texts with the keys of scene files, dataclasses of
    `noisefall.description`, or both mixed. Paths in it are relative to `folder`.
    """
    tree = description.to_dict(scene)
    return Scene(_noisefall.build(json.dumps({"format": 1, **tree}, default=_plain), folder))


def _plain(value: Any) -> Any:
    """A value within a tree that JSON does not know: numbers and arrays of numpy."""
    if hasattr(value, "tolist"):
        return value.tolist()
    raise TypeError(f"a scene cannot hold {value!r}")


def _settings(**settings: Any) -> str:
    return json.dumps({name: value for name, value in settings.items() if value is not None}, default=_plain)
