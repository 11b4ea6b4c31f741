"""Puts the page together: one file that needs no other, and lets nothing else in.

The scripts under ``assets/`` are plain classic scripts, one concept each, that share one scope;
they are put into the page as they are, each in an element of its own.
"""

from __future__ import annotations

import base64
import hashlib
import html
import json
import os
import re
from collections.abc import Sequence
from functools import cache
from importlib.resources import files
from typing import Any

from rightofway.files import write_whole
from rightofway.model import ExecutionTrace, Plan, SteadyState
from rightofway.viz.page.payload import payload_of
from rightofway.viz.palette import DARK, LIGHT

__all__ = ["page_of", "write_page"]

SCRIPTS = (
    "observable", "phases", "plan", "floor", "steady", "fleet_memo",
    "motion", "clock", "choice", "use", "words",
    "dom", "theme", "canvas", "shapes",
    "viewport", "bottleneck", "map_base", "map_route", "map_robots", "map_view",
    "axis", "steady_band", "space_time", "robot_rows", "census", "diagram",
    "virtual_list", "robot_list", "decision_list", "card", "summary", "states", "tabs",
    "transport", "loop", "mode_switch", "deep_link", "keys", "main",
)  # fmt: skip
"""In the order they run; each may use those before it at once, and all others later."""

MARKUP = str.maketrans({character: f"\\u{ord(character):04x}" for character in "<>&"})
"""Escapes that mean the same in JSON, and nothing in HTML."""


def page_of(
    plan: Plan, *, steady: Sequence[SteadyState] = (), actual: ExecutionTrace | None = None
) -> str:
    """Return a page that plays a plan, as one HTML document.

    Parameters
    ----------
    plan
        The plan.
    steady
        Where it repeats itself, if the plan does not say it: the page marks the periods and plays
        one for ever.
    actual
        What became of it on the floor: the page shows it against the plan.

    Returns
    -------
    str
        HTML. Its content security policy forbids any connection, and any script but our own.

    Raises
    ------
    InputError
        If ``steady`` or ``actual`` are not of this plan.
    """
    style, scripts = _style(), [_asset(f"{name}.js") for name in SCRIPTS]
    return _filled(
        _asset("template.html"),
        title=_title(plan),
        policy=_policy(style, scripts),
        style=style,
        payload=_json(payload_of(plan, steady=steady, actual=actual)),
        scripts="\n".join(f"<script>{script}</script>" for script in scripts),
    )


def write_page(
    plan: Plan,
    path: str | os.PathLike[str],
    *,
    steady: Sequence[SteadyState] = (),
    actual: ExecutionTrace | None = None,
) -> None:
    """Write a page that plays a plan; the file is there whole or not at all.

    Parameters
    ----------
    plan
        The plan.
    path
        Where, usually ``….html``.
    steady
        Where it repeats itself, if the plan does not say it: the page marks the periods and plays
        one for ever.
    actual
        What became of it on the floor: the page shows it against the plan.

    Raises
    ------
    InputError
        If the file cannot be written, or ``steady`` or ``actual`` are not of this plan.
    """
    write_whole(path, page_of(plan, steady=steady, actual=actual))


def _title(plan: Plan) -> str:
    count = len(plan.scenario.robots)
    title = html.escape(f"{count} robot{'s' * (count != 1)}, planned by {plan.run.name}")
    return title.encode("ascii", "xmlcharrefreplace").decode()


def _style() -> str:
    return "\n".join(
        [
            f":root{{{LIGHT.css()}}}",
            f"@media (prefers-color-scheme:dark){{:root{{{DARK.css()}}}}}",
            _asset("style.css"),
        ]
    )


def _json(payload: dict[str, Any]) -> str:
    """Return JSON that may stand in an HTML element whatever the names in it are."""
    return json.dumps(payload, separators=(",", ":"), allow_nan=False).translate(MARKUP)


def _policy(style: str, scripts: list[str]) -> str:
    allowed = " ".join(_hash(script) for script in scripts)
    return f"default-src 'none'; img-src data:; style-src {_hash(style)}; script-src {allowed}"


def _hash(text: str) -> str:
    digest = base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()
    return f"'sha256-{digest}'"


def _filled(template: str, **parts: str) -> str:
    """Fill each ``{{name}}`` once; what is filled in is not looked at again."""
    return re.sub(r"\{\{(\w+)\}\}", lambda match: parts[match[1]], template)


@cache
def _asset(name: str) -> str:
    return files(__package__).joinpath("assets", name).read_text("utf-8")
