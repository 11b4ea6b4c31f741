"""What JavaScript has from the models of Python: types of JSON, and attributes of robots.

``python -m tests.builders.typescript`` writes all files; with ``--check`` it fails where one is
stale.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from textwrap import indent
from typing import Any

from pydantic import TypeAdapter

from rightofway.kinds.numbers import format_number
from rightofway.languages import list_names, read_texts
from rightofway.model.robot import ROBOT_ATTRIBUTES
from rightofway.viz.page.schema import InspectionPayload, Payload
from tests.builders.api_types import api_types

ROOT = Path(__file__).parents[2]
PLAIN = {"string": "string", "integer": "number", "number": "number", "boolean": "boolean"}
Schema = Mapping[str, Any]


def payload_types() -> str:
    """Return the types of what pages are given."""
    plan, inspection = TypeAdapter(Payload), TypeAdapter(InspectionPayload)
    _, schemas = TypeAdapter.json_schemas(
        [("plan", "serialization", plan), ("inspection", "serialization", inspection)]
    )
    return declarations("viz/page/schema.py", schemas["$defs"])


def robot_attributes() -> str:
    """Return the attributes of robots, for the columns of the studio."""
    rows = []
    for it in ROBOT_ATTRIBUTES:
        usual = str(format_number(it.default)) if it.default else "\N{EN DASH}"
        words = {part: f"{part} of {it.key}" for part in ("title", "hint")}
        parts = {"isText": it.is_text, **words, "usual": usual}
        lines = (
            f"    {key}: {json.dumps(value, ensure_ascii=False)},\n" for key, value in parts.items()
        )
        rows.append(f"  {it.key}: {{\n{''.join(lines)}  }},\n")
    return (
        "// Generated from model/robot.py and texts/en.json: change it there, then run "
        "`just types-refresh`.\n\n"
        "/** Attributes of a robot other than its name and its trip, by key. */\n"
        f"export const ATTRIBUTES = /** @type {{const}} */ ({{\n{''.join(rows)}}});\n"
    )


def label_types() -> str:
    """Return the types of the labels of the page and of the studio."""
    texts = read_texts()
    return (
        "// Generated from texts/en.json: change it there, then run `just types-refresh`.\n\n"
        'import type { Value } from "./templates.js";\n\n'
        "/** The text of a template with values. */\n"
        "type Text<Name extends string> = (values: Record<Name, Value>) => string;\n"
        "type Texts<Name extends string> = (values: Record<Name, Value>) => string[];\n\n"
        f"export interface PageTexts {_type_of_label(texts['page'])}\n\n"
        f"export interface StudioTexts {_type_of_label(texts['studio'])}\n"
    )


def _type_of_label(node: Any) -> str:
    """Return the type of a label as ``labelsOf`` of ``templates.js`` makes it."""
    if isinstance(node, list) and isinstance(node[0], list):
        return "string[][]"
    if isinstance(node, list):
        names = [*dict.fromkeys(name for each in node for name in list_names(each))]
        return _type_of_function(names, "Texts") if names else "string[]"
    if isinstance(node, str) or "other" in node:
        names = list_names(node)
        return _type_of_function(names, "Text") if names else "string"
    rows = [
        f"{key if key.isidentifier() else json.dumps(key)}: {_type_of_label(each)};"
        for key, each in node.items()
    ]
    kinds = {_type_of_label(each) for each in node.values()}
    if len(kinds) == 1 and "<" not in (kind := kinds.pop()):  # modules compute keys
        rows.append(f"[key: string]: {kind};")
    return "{\n" + indent("\n".join(rows), "  ") + "\n}"


def _type_of_function(names: Sequence[str], result: str) -> str:
    return f"{result}<{' | '.join(map(json.dumps, names))}>"


FILES: dict[str, Callable[[], str]] = {
    "src/rightofway/viz/page/assets/payload.d.ts": payload_types,
    "src/rightofway/viz/page/assets/language/texts.d.ts": label_types,
    "src/rightofway/studio/assets/api_types.d.ts": api_types,
    "src/rightofway/studio/assets/robots/attributes.js": robot_attributes,
}
"""What is written where."""


def declarations(source: str, schemas: Mapping[str, Schema]) -> str:
    """Return an exported type for each named schema.

    Parameters
    ----------
    source
        Where the models are, for the first line.
    schemas
        JSON Schemas by name: ``$defs`` of pydantic, or ``components/schemas`` of OpenAPI.
    """
    head = f"// Generated from {source}: change it there, then run `just types-refresh`.\n"
    return "\n".join([head, *(_declaration(name, schemas[name]) for name in sorted(schemas))])


def _declaration(name: str, schema: Schema) -> str:
    about = f"/** {' '.join(schema.get('description', '').split())} */\n"
    about = "" if "description" not in schema else about
    if "properties" not in schema:
        return f"{about}export type {name} = {type_of(schema)};\n"
    return f"{about}export interface {name} {{\n{''.join(_properties(schema))}}}\n"


def _properties(schema: Schema) -> Iterator[str]:
    required = schema.get("required", ())
    for key, value in schema["properties"].items():
        shown = key if key.isidentifier() else json.dumps(key)
        yield f"  {shown}{'' if key in required else '?'}: {type_of(value)};\n"


def type_of(schema: Schema) -> str:
    """Return the type of a schema; `unknown` where it allows anything.

    Parameters
    ----------
    schema
        A JSON Schema as pydantic writes it.
    """
    if "$ref" in schema:
        return str(schema["$ref"]).rsplit("/", 1)[1]
    if "const" in schema or "enum" in schema:
        return " | ".join(map(json.dumps, schema.get("enum") or [schema["const"]]))
    if any_of := schema.get("anyOf") or schema.get("oneOf"):
        return " | ".join(dict.fromkeys(map(type_of, any_of)))
    kind = schema.get("type")
    if kind == "array":
        return _array(schema)
    if kind == "object":
        return _object(schema)
    return PLAIN.get(str(kind), "null" if kind == "null" else "unknown")


def _array(schema: Schema) -> str:
    if "prefixItems" in schema:
        return f"[{', '.join(map(type_of, schema['prefixItems']))}]"
    items = type_of(schema.get("items", {}))
    return f"({items})[]" if " " in items and items[0] not in "[{" else f"{items}[]"


def _object(schema: Schema) -> str:
    if "properties" in schema:
        return f"{{ {' '.join(''.join(_properties(schema)).split())} }}"
    values = schema.get("additionalProperties", True)
    return f"Record<string, {type_of(values) if isinstance(values, Mapping) else 'unknown'}>"


def stale() -> list[str]:
    """Return the files that are not what the models say."""
    return [name for name, made in FILES.items() if _read(ROOT / name) != made()]


def _read(path: Path) -> str:
    return path.read_text(encoding="utf-8") if path.exists() else ""


if __name__ == "__main__":
    if "--check" in sys.argv:
        sys.exit(f"stale: {', '.join(stale())} (run `just types-refresh`)" if stale() else 0)
    for name, made in FILES.items():
        (ROOT / name).write_text(made(), encoding="utf-8")
