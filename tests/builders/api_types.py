"""Types of the API for the page, from the types of its routes and their answers."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from types import NoneType, UnionType
from typing import (
    Annotated,
    Any,
    Literal,
    NotRequired,
    Union,
    get_args,
    get_origin,
    get_type_hints,
)

from pydantic import BaseModel
from typing_extensions import is_typeddict

from rightofway.studio.routes import answers
from rightofway.studio.routes.answers import (
    ANSWERS,
    BODIES,
    EVENTS,
    Comparison,
    Payload,
    Phrase,
    RefusalData,
)
from rightofway.studio.routes.models import Document

HEAD = """\
// Generated from studio/routes/answers.py: change it there, then run `just types-refresh`.

import type { PhraseData } from "../../viz/page/assets/payload.d.ts";
import type { ComparisonPayload, ScenarioDocument, SitePayload } from "./types.js";
"""

PLAIN = {
    str: "string",
    int: "number",
    float: "number",
    bool: "boolean",
    NoneType: "null",
    Any: "unknown",
}
NAMED = {
    Document: "ScenarioDocument",
    Payload: "SitePayload",
    Comparison: "ComparisonPayload",
    Phrase: "PhraseData",
}
PLACES = {"number": "${number}"}
"""Parts of paths that are not any text."""


def api_types() -> str:
    """Return the declarations."""
    wanted = [*ANSWERS.values(), *BODIES.values(), *EVENTS.values(), RefusalData]
    shapes = {each.__name__: each for root in wanted for each in _shapes(root, set())}
    declared = [_interface(shapes[name]) for name in sorted(shapes)]
    methods = [_conditional(method) for method in sorted({method for method, _ in ANSWERS})]
    bodies = [f"  {method}: {_bodies(method)};" for method in sorted({each for each, _ in BODIES})]
    events = [f"  {name}: {written(shape)};" for name, shape in EVENTS.items()]
    tables = [
        _block("What a request may hold, by method.", "Bodies", bodies),
        _block("What events hold, by their names.", "Events", events),
    ]
    return "\n".join([HEAD, *declared, *methods, *tables]).rstrip() + "\n"


def written(hint: Any) -> str:
    """Return a Python type as TypeScript writes it."""
    for known, name in NAMED.items():
        if hint == known:
            return name
    given = get_args(hint)
    match get_origin(hint):
        case origin if origin in {Annotated, NotRequired}:
            text = written(given[0])
        case origin if origin is Literal:
            text = " | ".join(f'"{each}"' for each in given)
        case origin if origin in {Union, UnionType}:
            text = " | ".join(dict.fromkeys(map(written, given)))
        case origin if origin is list:
            text = f"Array<{written(given[0])}>"
        case origin if origin is tuple:
            text = f"[{', '.join(map(written, given))}]"
        case origin if origin is dict:
            text = f"Record<string, {written(given[1])}>"
        case _:
            text = PLAIN.get(hint) or hint.__name__
    return text


def _shapes(hint: Any, seen: set[Any]) -> Iterator[Any]:
    """Yield the tables that a type is made of, each once."""
    if any(hint == known for known in NAMED):
        return
    if not (is_typeddict(hint) or _is_model(hint)):
        for each in get_args(hint):
            yield from _shapes(each, seen)
    elif hint not in seen:
        seen.add(hint)
        yield hint
        for _, each, _ in _fields(hint):
            yield from _shapes(each, seen)


def _is_model(hint: Any) -> bool:
    return isinstance(hint, type) and issubclass(hint, BaseModel)


def _fields(shape: Any) -> list[tuple[str, Any, bool]]:
    """Return name, type and whether it may be missing of each key."""
    hints = get_type_hints(shape, include_extras=True)
    if _is_model(shape):
        fields = shape.model_fields
        return [(name, hints[name], not fields[name].is_required()) for name in fields]
    return [(name, hint, get_origin(hint) is NotRequired) for name, hint in hints.items()]


def _interface(shape: Any) -> str:
    lines = [f"  {name}{'?' * left}: {written(hint)};" for name, hint, left in _fields(shape)]
    about = re.split(r"\.(?:\s|$)", " ".join((shape.__doc__ or "").split()))[0]
    if not about or about.startswith("dict("):
        about = _note_of(shape.__name__)
    return _block(f"{about.rstrip('.')}.", shape.__name__, lines)


def _note_of(name: str) -> str:
    """Return the text below an assignment, which is no docstring to Python."""
    text = Path(answers.__file__).read_text("utf-8")
    found = re.search(rf'^{name} = TypedDict\(.*?^\)\n"""(.*?)"""', text, re.MULTILINE | re.DOTALL)
    assert found is not None, name
    return found[1]


def _block(about: str, name: str, lines: list[str]) -> str:
    return "\n".join([f"/** {about} */", f"export interface {name} {{", *lines, "}", ""])


def _conditional(method: str) -> str:
    """Return what each path answers; the longest paths first, so that no other one takes them."""
    paths = [path for known, path in ANSWERS if known == method]
    paths.sort(key=lambda path: (-path.count("/"), "{" in path, path))
    name = f"{method.capitalize()}Answer"
    lines = [f"/** What {method} answers, by the path with what follows it. */"]
    lines.append(f"export type {name}<Path extends string> =")
    for path in paths:
        pattern = re.sub(r"\{(\w+)\}", lambda part: PLACES.get(part[1], "${string}"), path)
        both = f"`{pattern}` | `{pattern}?${{string}}`"
        lines.append(f"  Path extends {both} ? {written(ANSWERS[method, path])} :")
    return "\n".join([*lines, "  unknown;", ""])


def _bodies(method: str) -> str:
    known = [written(shape) for (each, _), shape in BODIES.items() if each == method]
    return " | ".join(dict.fromkeys(known))
