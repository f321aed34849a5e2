"""Small scenes with known images."""

from pathlib import Path

import noisefall
import pytest

SCENES = Path(__file__).parents[2] / "scenes"


@pytest.fixture(scope="session")
def box() -> noisefall.Scene:
    """The classical Cornell box."""
    return noisefall.load("cornell_box")


@pytest.fixture(scope="session")
def furnace() -> noisefall.Scene:
    """A closed sphere in which the radiance is 2 everywhere."""
    return noisefall.load("furnace")
