"""Single paths, term by term."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any


class Path:
    """A path that was traced again, as `noisefall render --pixel` prints it."""

    def __init__(self, tree: dict[str, Any], text: str) -> None:
        #: Everything that is known of the path: the tree of `--json`.
        self.tree = tree
        self._text = text

    @property
    def radiance(self) -> tuple[float, float, float]:
        """The contribution of the sample to its pixel."""
        r, g, b = self.tree["radiance"]
        return r, g, b

    @property
    def end(self) -> str:
        """Why the path ended."""
        return str(self.tree["end"])

    @property
    def vertices(self) -> list[dict[str, Any]]:
        """The vertices in order, with all terms of each."""
        vertices: list[dict[str, Any]] = self.tree["vertices"]
        return vertices

    def table(self) -> list[dict[str, Any]]:
        """A flat row for each vertex, such as `pandas.DataFrame` takes. Keys within keys are joined by dots (`light.pdf`), the
        components of vectors and colours are numbered (`normal.0`). All rows have the same keys.
        """
        rows = [dict(_flat(vertex)) for vertex in self.vertices]
        keys = dict.fromkeys(key for row in rows for key in row)
        return [{key: row.get(key) for key in keys} for row in rows]

    def __str__(self) -> str:
        return self._text

    def __repr__(self) -> str:
        return f"<noisefall.Path of {len(self.vertices)} vertices, {self.end}>"


def _flat(value: Any, name: str = "") -> Iterator[tuple[str, Any]]:
    if not isinstance(value, (Mapping, list)):
        yield name, value
        return
    for key, item in value.items() if isinstance(value, Mapping) else enumerate(value):
        yield from _flat(item, f"{name}.{key}" if name else str(key))
