"""The tables of the scene format and their keys, from its JSON Schema."""

from __future__ import annotations

import dataclasses
import json
from typing import Any

from . import _noisefall

#: The name of the whole scene file.
_ROOT = "Description"


@dataclasses.dataclass
class Key:
    """A key of a table."""

    name: str
    #: Its type as Python writes it.
    type: str
    doc: str
    is_required: bool


@dataclasses.dataclass
class Table:
    """A table of the scene format."""

    name: str
    doc: str
    keys: list[Key]

    def dataclass(self, module: str) -> type:
        """The dataclass of the table."""
        fields = [(key.name, key.type, _field(key)) for key in self.keys]
        made = dataclasses.make_dataclass(self.name, fields, kw_only=True, namespace={"__module__": module})
        made.__doc__ = "\n\n".join([self.doc, "\n".join(f"{key.name}: {key.doc}" for key in self.keys)]).strip()
        return made


def _field(key: Key) -> Any:
    return dataclasses.field() if key.is_required else dataclasses.field(default=None)


def declarations() -> list[Table]:
    """All tables, each before those that hold it."""
    found = _Tables()
    found.table(json.loads(_noisefall.schema()), _ROOT, "", "A scene file.")
    return found.tables


class _Tables:
    def __init__(self) -> None:
        self.tables: list[Table] = []
        self._schemas: dict[str, Any] = {}

    def table(self, schema: dict[str, Any], name: str, parent: str, doc: str) -> str:
        """Adds the dataclass of a table, and returns its name. Equal tables have one dataclass; of different tables of one name, the
        later one has the name of the table that holds it in front.
        """
        if self._schemas.get(name, schema) != schema:
            name = parent + name
        if name in self._schemas:
            return name
        self._schemas[name] = schema
        required = schema.get("required", [])
        keys = [
            Key(key, self.type(of, _class_name(key), name, of.get("description", "")), of.get("description", ""), key in required)
            for key, of in schema["properties"].items()
        ]
        for key in keys:
            # The version of the format has one value.
            if key.name == "format":
                key.is_required = False
            if not key.is_required:
                key.type += " | None"
        self.tables.append(Table(name, doc, keys))
        return name

    def type(self, schema: dict[str, Any], name: str, parent: str, doc: str) -> str:
        """The type of a value."""
        if "anyOf" in schema:
            types = [self.type(choice, name, parent, doc) for choice in schema["anyOf"]]
            return " | ".join(dict.fromkeys(types))
        if "enum" in schema:
            return f"Literal[{', '.join(map(repr, schema['enum']))}]" if schema["enum"] else "str"
        match schema["type"]:
            case "object" if list(schema.get("properties", {})) == ["texture"]:
                return "Mapping[str, str]"
            case "object" if "properties" in schema:
                return f"{self.table(schema, name, parent, doc)} | Mapping[str, Any]"
            case "object":
                return f"Mapping[str, {self._entry(schema['additionalProperties'], name, parent)}]"
            case "array":
                return f"Sequence[{self._entry(schema['items'], name, parent)}]"
            case "number":
                return "float"
            case "integer":
                return "int"
            case "boolean":
                return "bool"
            case _:
                return "str"

    def _entry(self, schema: dict[str, Any], name: str, parent: str) -> str:
        """The type of an entry of a list, or of a table of tables by name."""
        return self.type(schema, name.removesuffix("s"), parent, f"An entry of `{name.lower()}`.")


def _class_name(key: str) -> str:
    return "".join(word.capitalize() for word in key.split("_"))

