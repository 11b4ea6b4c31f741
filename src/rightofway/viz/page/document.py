"""The page as one HTML document that needs no other file, and as a frame for notebooks.

Its scripts stand in the page in the order in which they run, each in an element of its own.
"""

from __future__ import annotations

import base64
import hashlib
import html
import json
import os
import re
from collections.abc import Mapping, Sequence
from functools import cache

from rightofway.errors import NoPlanExists
from rightofway.files import write_whole
from rightofway.kinds.arguments import checks_arguments
from rightofway.kinds.table import TEXT
from rightofway.model import ExecutionTrace, Plan, SteadyState
from rightofway.viz.page.background import Background
from rightofway.viz.page.payload import make_payload
from rightofway.viz.page.scripts import make_classic_script, order_scripts, read_asset
from rightofway.viz.page.texts import find_texts
from rightofway.viz.palette import DARK, LIGHT

FRAME_HEIGHT = 680
"""Room for map and diagram [pixels]."""

PART_SHEETS = {"work": "jobs.css", "shift": "shift.css", "driven": "live.css"}
"""Style that only some pages need, by the part of their content that it is for."""

MARKUP = str.maketrans({character: f"\\u{ord(character):04x}" for character in "<>&"})
"""Escapes that mean the same in JSON, and nothing in HTML."""


def make_page(
    plan: Plan,
    *,
    steady: Sequence[SteadyState] = (),
    actual: ExecutionTrace | None = None,
    no_plan: NoPlanExists | None = None,
    title: str = "",
    background: Background | None = None,
    others: Sequence[tuple[Plan, str]] = (),
) -> str:
    """Return a page that plays a plan, as one HTML document.

    Parameters
    ----------
    plan
        The plan.
    steady
        The steady state of the plan, if the plan has none itself: the page marks the periods and
        repeats one endlessly.
    actual
        An execution of the plan: the page shows it next to the plan.
    no_plan
        Why the fleet has no plan; ``plan`` then holds every robot at its home.
    title
        The subject of the page, usually the name of the file; its heading begins with it.
    background
        A picture under the map.
    others
        Other plans with their titles: the page shows all side by side. Robots are compared by
        their names, so scenarios may differ.

    Returns
    -------
    str
        HTML. Its content security policy forbids any connection, and any script but our own.

    Raises
    ------
    InputError
        If ``steady`` or ``actual`` are not of this plan, the background cannot be read, or the
        plans cannot be compared: too many, or times in a unit and in none.
    """
    count = len(plan.scenario.robots)
    title = TEXT.read_at("title", title)
    robots = f"{count} robot{'s' * (count != 1)}"
    about = f"{title}: {robots}" if title else f"{robots}, planned by {plan.run.name}"
    payload = make_payload(
        plan,
        steady=steady,
        actual=actual,
        no_plan=no_plan,
        title=title,
        background=background,
        others=others,
    )
    return make_document(about, payload, "jobs_main" if "work" in payload else "main")


def make_document(
    about: str, payload: Mapping[str, object], entry: str, *, connects: bool = False
) -> str:
    """Return a page of style, texts, plain data and scripts, as one HTML document.

    Its content security policy forbids any script but these and any connection, but with
    ``connects`` those to the server that it comes from. That server sends further facts.
    """
    own = "connect-src 'self'; "
    style, scripts = (
        make_style_sheet(*(part for part in PART_SHEETS if part in payload)),
        [make_classic_script(name) for name in order_scripts(entry)],
    )
    parts = {
        "title": html.escape(about).encode("ascii", "xmlcharrefreplace").decode(),
        "policy": f"default-src 'none'; img-src data:; {own * connects}"
        f"style-src {_compute_hash(style)}; script-src {' '.join(map(_compute_hash, scripts))}",
        "style": style,
        "payload": as_script({"texts": find_texts(payload, is_whole=connects), **payload}),
        "scripts": "\n".join(f"<script>{script}</script>" for script in scripts),
    }
    # Each {{name}} is filled once; what is filled in is not looked at again.
    return re.sub(r"\{\{(\w+)\}\}", lambda match: parts[match[1]], read_asset("template.html"))


@checks_arguments
def write_page(
    plan: Plan,
    path: str | os.PathLike[str],
    *,
    steady: Sequence[SteadyState] = (),
    actual: ExecutionTrace | None = None,
    no_plan: NoPlanExists | None = None,
    title: str = "",
    background: Background | None = None,
    others: Sequence[tuple[Plan, str]] = (),
) -> None:
    """Write a page that plays a plan; the file is complete, or not written.

    Parameters
    ----------
    plan, steady, actual, no_plan, title, background, others
        As for `make_page`.
    path
        Where, usually ``….html``.

    Raises
    ------
    InputError
        As for `make_page`, or if the file cannot be written.
    """
    page = make_page(
        plan,
        steady=steady,
        actual=actual,
        no_plan=no_plan,
        title=title,
        background=background,
        others=others,
    )
    write_whole(path, page)


def make_frame(
    plan: Plan,
    *,
    height: int = FRAME_HEIGHT,
    steady: Sequence[SteadyState] = (),
    actual: ExecutionTrace | None = None,
) -> str:
    """Return HTML that shows a plan in a notebook: its page, over a picture; for ``_repr_html_``.

    Parameters
    ----------
    plan, steady, actual
        As for `make_page`.
    height
        Height of the frame [pixels].

    Notes
    -----
    The frame is sandboxed: no name in a plan can reach the notebook. Where frames are taken out of
    notebooks, as code hosts do, the picture below it remains.
    """
    from rightofway.viz.raster.picture import make_png

    document = html.escape(make_page(plan, steady=steady, actual=actual))
    picture = base64.b64encode(make_png(plan)).decode()
    all_over = "position:absolute;inset:0;width:100%;height:100%;border:0;border-radius:8px"
    return (
        f'<div style="position:relative;height:{height}px">'
        f'<img alt="Map of the plan" src="data:image/png;base64,{picture}"'
        ' style="max-width:100%;max-height:100%">'
        f'<iframe sandbox="allow-scripts" srcdoc="{document}" style="{all_over}"></iframe></div>'
    )


def make_payload_text(plan: Plan) -> str:
    """Return the plan and the texts for the page, as JSON that may stand in a script element."""
    payload = make_payload(plan)
    return as_script({"texts": find_texts(payload), **payload})


def as_script(payload: Mapping[str, object]) -> str:
    """Return plain data as JSON that may stand in a script element."""
    return as_compact_json(payload).translate(MARKUP)


def as_compact_json(payload: Mapping[str, object]) -> str:
    """Return plain data as JSON without spaces."""
    return json.dumps(payload, separators=(",", ":"), allow_nan=False)


@cache
def make_style_sheet(*parts: str) -> str:
    """Return the style of the page, light and dark, with that of the parts of its content."""
    themes = (
        f":root{{{LIGHT.as_css()}}}",
        f"@media (prefers-color-scheme:dark){{:root:not(.on-paper){{{DARK.as_css()}}}}}",
    )
    sheets = (PART_SHEETS[part] for part in parts)
    return "\n".join([*themes, *map(read_asset, ("style.css", *sheets))])


def _compute_hash(text: str) -> str:
    digest = base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()
    return f"'sha256-{digest}'"
