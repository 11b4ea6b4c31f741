"""Parts of pages that are taken from the program itself, so that they cannot drift from it.

``command-help`` shows what ``--help`` prints, ``planner-options`` and ``planner-list`` come from
the registry, ``document-keys`` from the JSON Schema of a format, ``result-columns`` from the
benchmark, ``delay-causes`` from the floor, ``public-names`` from ``__all__``, ``native-headers``
from the comments that C++ headers begin with.
"""  # noqa: INP001 (a Sphinx extension, found by its path)

from __future__ import annotations

import inspect
from collections.abc import Iterable, Iterator, Sequence
from importlib import import_module
from itertools import chain, takewhile
from pathlib import Path
from typing import TYPE_CHECKING, Any

from click.testing import CliRunner
from docutils import nodes
from docutils.statemachine import StringList
from sphinx.util.docutils import SphinxDirective

from rightofway.bench import COLUMNS
from rightofway.cli.main import commands
from rightofway.execution import CAUSES, DEFAULT
from rightofway.io import schema
from rightofway.model import Robot, Rules, Stop
from rightofway.planners import Option, registered

if TYPE_CHECKING:
    from sphinx.application import Sphinx

ROOT = Path(__file__).parents[2]

Row = Sequence[str]

RULES = schema("scenario")["$defs"]["RulesDocument"]["properties"]
"""Keys that stand last where a robot has them too."""


class LiveDirective(SphinxDirective):
    """Writes Markdown in its place."""

    required_arguments = 1
    optional_arguments = 1

    def run(self) -> list[nodes.Node]:
        """Return what the Markdown becomes."""
        container = nodes.container()
        text = "\n".join(self.lines(*self.arguments))
        self.state.nested_parse(StringList(text.splitlines(), "live"), 0, container)
        return container.children

    def lines(self, *_: str) -> Iterable[str]:
        """Return the Markdown."""
        raise NotImplementedError


def table(heads: Row, rows: Iterable[Row]) -> Iterator[str]:
    """Yield a Markdown table."""
    for row in (heads, ["---"] * len(heads), *rows):
        yield "| " + " | ".join(cell.replace("|", "\\|").replace("\n", " ") for cell in row) + " |"


class CommandHelp(LiveDirective):
    """What a command prints with ``--help``."""

    required_arguments = 0

    def lines(self, *path: str) -> Iterable[str]:
        """Return a code block."""
        terminal = CliRunner(env={"COLUMNS": "80"})
        printed = terminal.invoke(
            commands, [*path, "--help"], prog_name="rightofway", catch_exceptions=False
        )
        return ["```text", *printed.output.splitlines(), "```"]


class PlannerList(LiveDirective):
    """The planners there are."""

    required_arguments = 0

    def lines(self, *_: str) -> Iterable[str]:
        """Return a table."""
        rows = [
            (f"[`{spec.name}`]({spec.name}.md)", spec.summary) for spec in registered().values()
        ]
        return table(("planner", "what it does"), rows)


class PlannerOptions(LiveDirective):
    """What a planner can be told."""

    def lines(self, *arguments: str) -> Iterable[str]:
        """Return a table."""
        options = registered()[arguments[0]].options
        rows = (
            (f"`{each.name}`", f"`{each.default}`", _other_values(each), each.summary)
            for each in options
        )
        return table(("option", "default", "other values", "what it does"), rows)


def _other_values(option: Option) -> str:
    return _codes(option.choices[1:]) or f"whole numbers from {option.least}"


class DocumentKeys(LiveDirective):
    """The keys of one part of a format: ``scenario RulesDocument``."""

    optional_arguments = 1

    def lines(self, *arguments: str) -> Iterable[str]:
        """Return a table."""
        kind, *part = arguments
        whole = schema(kind)  # type: ignore[arg-type]  # a wrong kind is refused with a sentence
        node = whole["$defs"][part[0]] if part else whole
        node = node["anyOf"][-1] if "anyOf" in node else node
        required = node.get("required", [])
        defaults = _defaults().get(part[0], {}) if part else {}
        keys = sorted(
            node["properties"].items(), key=lambda item: (item[0] not in required, item[0] in RULES)
        )
        rows = (
            (
                f"`{key}`",
                _text(value, whole),
                "required" if key in required else _default(key, value, defaults),
            )
            for key, value in keys
        )
        return table(("key", "what", "default"), rows)


class ResultColumns(LiveDirective):
    """The columns of the results of a benchmark."""

    required_arguments = 0

    def lines(self, *_: str) -> Iterable[str]:
        """Return a table."""
        return table(("column", "what"), ((f"`{each.name}`", each.what) for each in COLUMNS))


class DelayCauses(LiveDirective):
    """What makes robots late, and how it is written."""

    required_arguments = 0

    def lines(self, *_: str) -> Iterable[str]:
        """Return a table."""
        examples = chain.from_iterable(cause.examples for cause in CAUSES.values())
        default = {DEFAULT: "; this is the default"}
        rows = ((f"`{text}`", what + default.get(text, "")) for text, what in examples)
        return table(("cause", "what happens"), rows)


def _defaults() -> dict[str, dict[str, Any]]:
    """Return the defaults that the model has, where the schema leaves them to it."""
    rules, robot = Rules(), Robot(name="R1", home=0, stops=(Stop(at=0),))  # type: ignore[arg-type]
    return {
        "RulesDocument": {
            **{
                name: getattr(rules, name) for name in ("occupancy", "headway", "laps", "rotations")
            },
            "return": rules.ends,
        },
        "RobotDocument": {"speed": robot.speed, "work": robot.stops[0].work},
        "StopDocument": {"work": robot.stops[0].work},
    }


def _default(key: str, value: dict[str, Any], defaults: dict[str, Any]) -> str:
    default = defaults.get(key, value.get("default"))
    if default in (None, "", [], {}):
        return ""
    return f"`{str(default).lower() if isinstance(default, bool) else default}`"


def _text(value: dict[str, Any], whole: dict[str, Any]) -> str:
    if "description" in value:
        return str(value["description"])
    name = value.get("$ref", "").rpartition("/")[2]
    return str(whole["$defs"].get(name, {}).get("description", ""))


def _codes(words: Iterable[str]) -> str:
    return ", ".join(f"`{word}`" for word in words)


class PublicNames(LiveDirective):
    """The names a module offers, with the first line of what each says."""

    def lines(self, *arguments: str) -> Iterable[str]:
        """Return a table."""
        module = import_module(arguments[0])
        rows = (_public(name, getattr(module, name)) for name in module.__all__)
        return table(("name", "what"), rows)


def _public(name: str, value: Any) -> Row:
    home = ".".join(value.__module__.split(".")[:2])
    where = name if home == "rightofway.solve" else f"{home.removeprefix('rightofway.')}.{name}"
    summary = (inspect.getdoc(value) or "").splitlines()[0]
    return f"{{py:obj}}`{name} <rightofway.{where}>`", summary


class NativeHeaders(LiveDirective):
    """The headers of the native core, with what each says of itself first."""

    required_arguments = 0

    def lines(self, *_: str) -> Iterable[str]:
        """Return a table."""
        headers = sorted((ROOT / "cpp").glob("[!bt]*/*.hpp"))
        return table(
            ("header", "what it is"),
            ((f"`{each.parent.name}/{each.name}`", _opening(each)) for each in headers),
        )


def _opening(header: Path) -> str:
    """Return the first paragraph of the comment that a file begins with."""
    lines = header.read_text(encoding="utf-8").splitlines()
    return " ".join(line[3:] for line in takewhile(lambda line: line.startswith("// "), lines))


def setup(app: Sphinx) -> dict[str, Any]:
    """Register the directives."""
    app.add_directive("command-help", CommandHelp)
    app.add_directive("planner-list", PlannerList)
    app.add_directive("planner-options", PlannerOptions)
    app.add_directive("document-keys", DocumentKeys)
    app.add_directive("result-columns", ResultColumns)
    app.add_directive("delay-causes", DelayCauses)
    app.add_directive("native-headers", NativeHeaders)
    app.add_directive("public-names", PublicNames)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
