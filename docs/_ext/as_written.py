"""Signatures of the API pages, with annotations as written and defaults as values.

Without this extension autodoc expands aliases, so that ``FaultKind`` becomes a list of a dozen
words, and names every type after the module that defines it, which has no page.
"""  # noqa: INP001 (a Sphinx extension, found by its path)

from __future__ import annotations

import inspect
from collections.abc import Iterable, Iterator
from enum import Enum
from inspect import Parameter
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from docutils import nodes
    from sphinx.application import Sphinx
    from sphinx.environment import BuildEnvironment

LONGEST_DEFAULT = 60
"""Letters of a default that is written out."""


def signature_of(
    _app: Sphinx, what: str, _name: str, value: Any, *_: Any
) -> tuple[str, str | None] | None:
    """Return parameters and result of a function, method or class as the source has them."""
    if what == "class" and getattr(value, "_is_protocol", False):
        return "", None
    if what not in {"function", "method", "class"} or not _is_code(value):
        return None
    signature = inspect.signature(value)
    parameters = list(signature.parameters.values())
    if what == "method" and not inspect.ismethod(value):
        parameters = parameters[1:]
    result = None if what == "class" else _words(signature.return_annotation)
    return f"({', '.join(_parts(parameters))})", result


def _is_code(value: Any) -> bool:
    return inspect.isroutine(value) or inspect.isclass(value)


def _parts(parameters: Iterable[Parameter]) -> Iterator[str]:
    before = None
    for each in parameters:
        if each.kind is Parameter.KEYWORD_ONLY and before is not Parameter.KEYWORD_ONLY:
            yield "*"
        before = each.kind
        text = f"{_STARS.get(each.kind, '')}{each.name}: {_words(each.annotation)}"
        yield text if each.default is each.empty else f"{text} = {_default(each.default)}"


_STARS = {Parameter.VAR_POSITIONAL: "*", Parameter.VAR_KEYWORD: "**"}


def _words(annotation: Any) -> str | None:
    """Return an annotation as text; named tuples keep theirs as forward references."""
    if annotation is Parameter.empty:
        return None
    return str(getattr(annotation, "__forward_arg__", annotation))


def _default(value: Any) -> str:
    """Return a default as a value; a factory, a function and a large value have no text."""
    if isinstance(value, Enum):
        return f"{type(value).__name__}.{value.name}"
    text = repr(value)
    return "..." if text.startswith("<") or len(text) > LONGEST_DEFAULT else text


def is_field(_app: Sphinx, _what: str, _name: str, value: Any, *_: Any) -> bool | None:
    """Leave out the fields of named tuples, which the text of their class describes."""
    return True if type(value).__name__ == "_tuplegetter" else None


def defined_elsewhere(
    app: Sphinx, env: BuildEnvironment, node: nodes.Element, content: nodes.Element
) -> nodes.Node | None:
    """Resolve a name of another package's page, like ``Plan`` in `check`."""
    name = node.get("reftarget", "").rpartition(".")[2]
    domain = env.get_domain("py")
    found = [full for full, *_ in domain.get_objects() if full.split(".")[2:] == [name]]
    if node.get("refdomain") != "py" or len(found) != 1:
        return None
    return domain.resolve_xref(env, node["refdoc"], app.builder, "obj", found[0], node, content)


def setup(app: Sphinx) -> dict[str, Any]:
    """Register the three."""
    app.connect("autodoc-process-signature", signature_of)
    app.connect("autodoc-skip-member", is_field)
    app.connect("missing-reference", defined_elsewhere)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
