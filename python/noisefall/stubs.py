"""Prints the types of `noisefall.description`: `python -m noisefall.stubs > description.pyi`."""

from __future__ import annotations

import json

from .declarations import Table, declarations

_HEAD = '''"""Dataclasses of the scene format. Made by `python -m noisefall.stubs`; do not edit."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal

def to_dict(value: Any) -> Any:
    """A tree of dicts and lists without dataclasses and without fields that are `None`."""
'''


def stubs() -> str:
    """The text of description.pyi."""
    return _HEAD + "".join(map(_stub, declarations()))


def _stub(table: Table) -> str:
    lines = ["", "@dataclass(kw_only=True)", f"class {table.name}:", f"    {_quoted(table.doc)}", ""]
    for key in table.keys:
        lines.append(f"    {key.name}: {key.type}{'' if key.is_required else ' = None'}")
        lines.append(f"    {_quoted(key.doc)}")
    return "\n".join(lines) + "\n"


def _quoted(text: str) -> str:
    return '"""' + json.dumps(text, ensure_ascii=False)[1:-1].replace('\\"', '"').rstrip('"') + '"""'


if __name__ == "__main__":
    print(stubs(), end="")
