"""Write the generated parts of the pages: `just docs-refresh`; with ``--check`` only compare.

A generated part is plain Markdown, so that it can be read without a build. It is between
``<!-- generated: MAKER ARGUMENTS -->`` and ``<!-- end -->``. `MAKERS` lists the makers. They read
the program itself: help texts, the registry of planners, the JSON Schemas of the
formats, the OpenAPI document of the studio, ``__all__`` and docstrings, and the comments that C++
headers begin with. Notebooks are run, and their results are written below their cells.
"""  # noqa: INP001 (a script, run by its path)

from __future__ import annotations

import ast
import inspect
import re
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import cache
from importlib import import_module
from itertools import chain, pairwise, takewhile
from pathlib import Path
from typing import Any

import click
from click.testing import CliRunner
from notebooks import run_notebook

from rightofway.bench import COLUMNS
from rightofway.cli.main import commands
from rightofway.execution import CAUSES, DEFAULT_DELAYS
from rightofway.io import make_schema
from rightofway.model import Robot, Rules, Stop
from rightofway.planners import Option, find
from rightofway.planners.registry import PLANNERS
from rightofway.studio.app import API, create_app
from rightofway.studio.guard import Access

ROOT = Path(__file__).parents[1]
PAGES = [*sorted(ROOT.glob("*.md")), *sorted((ROOT / "docs").rglob("*.md"))]
NOTEBOOKS = sorted((ROOT / "docs").glob("*.ipynb"))

PART = re.compile(
    r"^<!-- generated: (?P<words>[^\n]*?) -->$(?P<text>.*?)^<!-- end -->$", re.MULTILINE | re.DOTALL
)

PARAMETER = re.compile(r"\{(\w+)\}")

Row = Sequence[str]

RULES = make_schema("scenario")["$defs"]["RulesDocument"]["properties"]
"""Keys that come last, because a robot can have them too."""


def main(arguments: Sequence[str]) -> int:
    """Update every page, or name the stale ones."""
    check = list(arguments) == ["--check"]
    stale = []
    for page in [*PAGES, *NOTEBOOKS]:
        written = page.read_text(encoding="utf-8")
        fresh = run_notebook(page) if page in NOTEBOOKS else PART.sub(part, written)
        if fresh != written:
            stale.append(page.relative_to(ROOT).as_posix())
            if not check:
                page.write_text(fresh, encoding="utf-8")
    for name in stale:
        click.echo(f"{name}: {'stale (run `just docs-refresh`)' if check else 'refreshed'}")
    return 1 if check and stale else 0


def part(match: re.Match[str]) -> str:
    """Return a part with its markers, made again."""
    maker, *arguments = match["words"].split()
    text = "\n".join(MAKERS[maker](*arguments))
    return f"<!-- generated: {match['words']} -->\n\n{text}\n\n<!-- end -->"


def table(heads: Row, rows: Iterable[Row]) -> Iterator[str]:
    """Yield a Markdown table."""
    for row in (heads, ["---"] * len(heads), *rows):
        yield "| " + " | ".join(map(_cell, row)) + " |"


def _cell(text: str) -> str:
    """Return text as one cell: no bar ends it, and ``<`` outside of code begins no tag."""
    parts = re.split(r"(`[^`]*`)", text.replace("|", "\\|").replace("\n", " "))
    return "".join(one if one.startswith("`") else one.replace("<", "\\<") for one in parts)


def command_help(*path: str) -> Iterable[str]:
    """Return the help text of a command as a code block."""
    terminal = CliRunner(env={"COLUMNS": "80"})
    printed = terminal.invoke(
        commands, [*path, "--help"], prog_name="rightofway", catch_exceptions=False
    )
    return ["```text", *printed.output.splitlines(), "```"]


def planner_list() -> Iterable[str]:
    """Return the planners of this package."""
    rows = [
        (f"[`{spec.name}`]({find_planner_page(spec.name).name})", spec.summary) for spec in PLANNERS
    ]
    return table(("planner", "method"), rows)


def find_planner_page(planner: str) -> Path:
    """Return the page with the options of a planner."""
    block = f"<!-- generated: planner-options {planner} -->\n"
    pages = sorted((ROOT / "docs" / "planners").glob("*.md"))
    return next(page for page in pages if block in page.read_text(encoding="utf-8"))


def planner_options(planner: str) -> Iterable[str]:
    """Return the options of a planner."""
    rows = [
        (f"`{each.name}`", f"`{each.default}`", _other_values(each), each.summary)
        for each in find(planner).options
    ]
    if not rows:
        return ["It has no options."]
    return table(("option", "default", "other values", "effect"), rows)


def _other_values(option: Option) -> str:
    return ", ".join(f"`{word}`" for word in option.choices[1:]) or (
        option.kind.name.removeprefix("a ").replace("number", "numbers")
    )


def document_keys(kind: str, *part: str) -> Iterable[str]:
    """Return the keys of one part of a format: ``scenario RulesDocument``."""
    whole = make_schema(kind)  # type: ignore[arg-type]  # a wrong kind is refused with a sentence
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
    return table(("key", "meaning", "default"), rows)


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


@cache
def openapi() -> dict[str, Any]:
    """Return the OpenAPI document of the studio; no studio is started for it."""
    return create_app(None, Access(hosts=None)).openapi()  # type: ignore[arg-type]


def studio_requests() -> Iterable[str]:
    """Return a table of requests for each tag of the API, in the order of the document."""
    rows: dict[str, list[Row]] = {}
    for path, operations in openapi()["paths"].items():
        for method, operation in operations.items():
            place = PARAMETER.sub(lambda match: match[1].upper(), path.removeprefix(API) or "/")
            request = f"`{method.upper()} {place}`"
            row = (request, _first_sentence(operation), _query(operation), _body(operation))
            rows.setdefault(operation["tags"][0], []).append(row)
    for tag, requests in rows.items():
        yield from (f"**{tag.capitalize()}**", "")
        yield from table(("request", "effect", "query", "body"), requests)
        yield ""


def _first_sentence(operation: Mapping[str, Any]) -> str:
    return str(operation["description"]).split("\n\n")[0].replace("``", "`")


def _query(operation: Mapping[str, Any]) -> str:
    parameters = (each for each in operation.get("parameters", ()) if each["in"] == "query")
    return ", ".join(_marked(each["name"], each["required"]) for each in parameters)


def _body(operation: Mapping[str, Any]) -> str:
    """Return the names of the models that a body may fit; one without a model is a file."""
    if "requestBody" not in operation:
        return ""
    body = next(iter(operation["requestBody"]["content"].values()))["schema"]
    models = [
        each["$ref"].rpartition("/")[2] for each in body.get("oneOf", [body]) if "$ref" in each
    ]
    return " or ".join(f"`{name}`" for name in models) or "a file"


def studio_bodies() -> Iterable[str]:
    """Return a table of keys for each model that a body may fit."""
    document = openapi()
    operations = chain.from_iterable(each.values() for each in document["paths"].values())
    bodies = dict.fromkeys(re.findall(r"`(\w+)`", " ".join(map(_body, operations))))
    for name in bodies:
        model = document["components"]["schemas"][name]
        rows = (
            (
                _marked(key, key in model.get("required", ())),
                str(value.get("description", "")),
                _default(key, value, {}) or (f"`{value['const']}`" if "const" in value else ""),
            )
            for key, value in model["properties"].items()
        )
        yield from (f"`{name}`: {model['description']}", "")
        yield from table(("key", "meaning", "default"), rows)
        yield ""


def _marked(key: str, is_required: bool) -> str:
    return f"**`{key}`**" if is_required else f"`{key}`"


def result_columns() -> Iterable[str]:
    """Return the columns of the results of a benchmark."""
    return table(("column", "meaning"), ((f"`{each.name}`", each.meaning) for each in COLUMNS))


def delay_causes() -> Iterable[str]:
    """Return what makes robots late, and how it is written."""
    examples = chain.from_iterable(cause.examples for cause in CAUSES.values())
    default = {DEFAULT_DELAYS: "; this is the default"}
    rows = ((f"`{text}`", what + default.get(text, "")) for text, what in examples)
    return table(("cause", "effect"), rows)


def public_names(module: str) -> Iterable[str]:
    """Return the names that a module offers, with the first sentence of each docstring."""
    offered = import_module(module)
    values = {name: getattr(offered, name) for name in offered.__all__}
    rows = (
        (
            _link(name, value) if module == "rightofway" else f"`{name}`",
            _first(name, value, module),
        )
        for name, value in values.items()
    )
    return table(("name", "description"), rows)


def _link(name: str, value: Any) -> str:
    """Return a name that links to the page of the room that defines it."""
    room = value.__module__.split(".")[1]
    return f"[`{name}`]({room}.md)"


def _first(name: str, value: Any, module: str) -> str:
    """Return the first sentence of a docstring, in Markdown."""
    documented = inspect.isclass(value) or inspect.isroutine(value)
    text = (inspect.getdoc(value) or "") if documented else _constant(name, module)
    return text.split("\n\n")[0].replace("``", "`")


def _constant(name: str, module: str) -> str:
    """Return the sentence below a constant, in a module or in the one that it is imported from."""
    source = ast.parse(inspect.getsource(import_module(module)))
    for statement, below in pairwise(source.body):
        targets = getattr(statement, "targets", [getattr(statement, "target", None)])
        if name in [getattr(each, "id", None) for each in targets]:
            text = getattr(below, "value", None)
            return str(text.value) if isinstance(text, ast.Constant) else ""
    for statement in ast.walk(source):  # also imports for the checker of types alone
        if isinstance(statement, ast.ImportFrom) and statement.module and not statement.level:
            names = {each.asname or each.name: each.name for each in statement.names}
            if name in names:
                return _constant(names[name], statement.module)
    return ""


def decisions() -> Iterable[str]:
    """Return the decisions by their titles."""
    pages = sorted((ROOT / "docs" / "decisions").glob("0*.md"))
    titles = [page.read_text(encoding="utf-8").split("\n", 1)[0].lstrip("# ") for page in pages]
    return [f"- [{title}]({page.name})" for title, page in zip(titles, pages, strict=True)]


def native_headers() -> Iterable[str]:
    """Return the headers of the native core, with the first sentence of each."""
    headers = sorted((ROOT / "cpp").glob("[!bt]*/*.hpp"))
    return table(
        ("header", "content"),
        ((f"`{each.parent.name}/{each.name}`", _opening(each)) for each in headers),
    )


def _opening(header: Path) -> str:
    """Return the first paragraph of the comment that a file begins with."""
    lines = header.read_text(encoding="utf-8").splitlines()
    return " ".join(line[3:] for line in takewhile(lambda line: line.startswith("// "), lines))


def test_counts() -> Iterable[str]:
    """Return how many laws and other tests there are, rounded down, as a sentence."""
    laws = others = 0
    for path in (ROOT / "tests").rglob("test_*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.FunctionDef) and node.name.startswith("test_"):
                is_law = any("law" in ast.unparse(each) for each in node.decorator_list)
                laws, others = laws + is_law, others + (not is_law)
    counts = f"more than {laws // 10 * 10} laws and {others // 100 * 100} other functions"
    return [f"The tests are {counts}, many of which run for each of a list of cases."]


MAKERS: dict[str, Callable[..., Iterable[str]]] = {
    "command-help": command_help,
    "planner-list": planner_list,
    "planner-options": planner_options,
    "document-keys": document_keys,
    "studio-requests": studio_requests,
    "studio-bodies": studio_bodies,
    "result-columns": result_columns,
    "delay-causes": delay_causes,
    "decisions": decisions,
    "public-names": public_names,
    "native-headers": native_headers,
    "test-counts": test_counts,
}

if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
