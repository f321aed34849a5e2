"""The renderer compared with exact solutions."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from . import _noisefall


@dataclass(frozen=True)
class Statement:
    """A measurement beside its exact value."""

    #: The measured quantity.
    what: str
    #: The measurement.
    measured: float
    #: Its exact value; `None` for claims of another form.
    exact: float | None
    #: Whether it holds.
    holds: bool
    #: All columns of report.json.
    tree: dict[str, Any]


@dataclass(frozen=True)
class Section:
    """A claim with its measurements."""

    title: str
    claim: str
    holds: bool
    statements: list[Statement]


@dataclass(frozen=True)
class Validation:
    """The report of `noisefall validate`."""

    holds: bool
    sections: list[Section]


def validate(
    *, quick: bool = True, seed: int = 0, callback: Callable[[int, str, bool], bool | None] | None = None
) -> Validation:
    """Compares the renderer with exact solutions, as `noisefall validate` does: half a minute, or minutes without `quick`.

    callback: called with number, title and verdict of each section when it is finished. It stops the run by returning `False`; the
        report then has the sections that are finished. Ctrl+C stops the run after the section that it is in.
    """
    report = json.loads(_noisefall.validate(quick, seed, callback))
    return Validation(report["holds"], [_section(section) for section in report["sections"]])


def _section(tree: dict[str, Any]) -> Section:
    statements = [Statement(s["what"], s["measured"], s["exact"], s["holds"], s) for s in tree["statements"]]
    return Section(tree["title"], tree["claim"], tree["holds"], statements)
