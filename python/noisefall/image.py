"""Rendered images, and their comparison."""

from __future__ import annotations

import json
import math
import os
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _noisefall


class Image:
    """A rendered image. Its arrays are views of the renderer's memory: nothing is copied, and they are read-only."""

    def __init__(self, native: _noisefall.Image) -> None:
        self._native = native

    @cached_property
    def radiance(self) -> NDArray[np.float32]:
        """Linear Rec. 709 radiance in W·sr⁻¹·m⁻²: height × width × 3."""
        return np.asarray(self._native.radiance)

    @cached_property
    def variance(self) -> NDArray[np.float32] | None:
        """The variance of the mean of each pixel and channel, from the variance of its samples: height × width × 3. `None` before
        the second sample. For stratified and Sobol samples it is an upper bound.
        """
        pixels = self._native.variance
        return None if pixels is None else np.asarray(pixels)

    @cached_property
    def standard_error(self) -> NDArray[np.float32]:
        """An upper bound of the standard error of the luminance of each pixel; NaN before the second sample: height × width."""
        return np.asarray(self._native.standard_error)

    @cached_property
    def counts(self) -> NDArray[np.uint32]:
        """The number of samples of each pixel: height × width."""
        pixels = self._native.counts
        if pixels is None:
            return np.full(self.radiance.shape[:2], self.spp, dtype=np.uint32)
        return np.asarray(pixels)

    @cached_property
    def bounces(self) -> list[NDArray[np.float32]] | None:
        """An image for each number of bounces, from 0; the last one has all others. `None` without `render(bounces=True)`. They have
        samples of their own, so that their sum differs from `radiance` by noise.
        """
        pixels = self._native.bounces
        return None if pixels is None else [np.asarray(term) for term in pixels]

    @cached_property
    def figures(self) -> dict[str, Any]:
        """Figures under the names of `noisefall render --json`. With a `[reference]` in the scene they include the true error."""
        figures: dict[str, Any] = json.loads(self._native.figures())
        return figures

    @property
    def spp(self) -> int:
        """The number of samples that every pixel has at least."""
        return int(self.figures["spp"])

    @property
    def seconds(self) -> float:
        """Time spent rendering."""
        return float(self.figures["seconds"])

    @property
    def noise(self) -> float | None:
        """The estimated relative noise: the root of relMSE. `None` before the second sample."""
        estimate = self.figures["rel_mse_estimate"]
        return None if estimate is None else math.sqrt(estimate)

    @property
    def stopped_by(self) -> str:
        """The reason why the render ended: "samples", "time", "noise" or "callback"; "running" within a callback."""
        return str(self.figures["stopped_by"])

    def srgb(self, *, exposure: float | None = None, tone: str | None = None) -> NDArray[np.uint8]:
        """The pixels as displayed, 8-bit sRGB: height × width × 3. `exposure` is in stops, that of the scene by default."""
        return self._native.srgb(exposure, tone)[:, :, :3]

    def save(
        self, path: str | os.PathLike[str], *, exposure: float | None = None, tone: str | None = None
    ) -> None:
        """Writes a PNG (as displayed) or an EXR (linear radiance and variances), by the extension. The file carries its scene, camera
        and settings, and appears whole or not at all.
        """
        self._native.save(path, exposure, tone)

    def compare(self, reference: Comparable, *, floor: float | None = None) -> Comparison:
        """The error of this image against a reference: see `noisefall.compare`."""
        return compare(self, reference, floor=floor)

    def __repr__(self) -> str:
        height, width = self.radiance.shape[:2]
        return f"<noisefall.Image {width} × {height}, {self.spp} spp>"


Comparable = Image | NDArray[Any] | str | os.PathLike[str]


@dataclass(frozen=True)
class Comparison:
    """The error of an image against a reference, under the names of `noisefall compare --json`."""

    #: Root of the mean over pixels and channels of (x − r)².
    rmse: float
    #: Mean over pixels and channels of (x − r)²/(r² + F).
    rel_mse: float
    #: Mean over pixels and channels of x − r.
    bias: float
    #: Standard error of `bias`; `None` if unknown.
    bias_standard_error: float | None
    #: `bias` in standard errors; `None` if these are unknown or zero.
    bias_in_standard_errors: float | None
    #: The samples do not vary, so a difference is not noise.
    exact_samples: bool
    #: Few samples make up most of the variance, so the standard error is unreliable.
    heavy_tails: bool
    #: The standard error is an upper bound, because the samples are stratified.
    upper_bound: bool
    #: Differences of the means over blocks of 32 × 32 pixels in standard errors, row by row.
    block_z: list[float]
    #: The constant F.
    floor: str


def compare(a: Comparable, b: Comparable, *, floor: float | None = None) -> Comparison:
    """The error of an image against the reference `b`. Each is an `Image`, a file, or an array of height × width × 3.

    Variances are known of images and of EXR files of the program; without those of `a`, the standard error is unknown.
    floor: the constant F of relMSE; 0.01 of the mean squared reference by default.
    """
    return Comparison(**json.loads(_noisefall.compare(_native(a), _native(b), floor)))


def _native(image: Comparable) -> Any:
    if isinstance(image, Image):
        return image._native
    if isinstance(image, np.ndarray):
        return np.ascontiguousarray(image, dtype=np.float32)
    return image
