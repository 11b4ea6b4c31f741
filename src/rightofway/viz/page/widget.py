"""The page as a live part of a notebook: the same scripts in a shadow tree, without a frame."""

from __future__ import annotations

import base64
import json
import re
import sys
from functools import cache
from importlib import import_module
from importlib.util import find_spec
from typing import Any

from rightofway.model import Plan
from rightofway.viz.page.document import FRAME_HEIGHT, make_payload_text, make_style_sheet
from rightofway.viz.page.scripts import make_classic_script, order_scripts

WIDGET_STYLE = f".page{{contain:layout;height:{FRAME_HEIGHT}px;min-height:0;overflow:auto}}"
"""A page in a notebook has a height of its own."""


def bundle_of(plan: Plan) -> dict[str, Any]:
    """Return a plan as a widget of a notebook, by media type; for ``_repr_mimebundle_``.

    Parameters
    ----------
    plan
        The plan.

    Returns
    -------
    dict
        The widget, and a picture for where no widget runs.

    Raises
    ------
    NotImplementedError
        Without anywidget or a notebook's kernel: IPython then takes the next best, which is
        ``_repr_html_`` in a notebook and ``repr`` in a terminal.
    """
    if not (is_in_notebook() and find_spec("anywidget")):
        raise NotImplementedError
    from rightofway.viz.raster.picture import make_png

    shown = _make_widget_class()(payload=make_payload_text(plan))._repr_mimebundle_()
    widget = shown[0] if isinstance(shown, tuple) else shown
    picture = base64.b64encode(make_png(plan)).decode()
    return {
        **widget,
        "text/plain": repr(plan),
        "text/html": f'<img alt="Map of the plan" src="data:image/png;base64,{picture}">',
        "image/png": picture,
    }


def is_in_notebook() -> bool:
    """Return whether this process is the kernel of a notebook."""
    return "ipykernel" in sys.modules


@cache
def make_widget_module() -> str:
    """Return the JavaScript module of the widget: the page's style, its scripts, and `render`."""
    style = re.sub(r":root|\bbody\b", ".page", make_style_sheet("work"))
    shell = f'<style>{style}{WIDGET_STYLE}</style><div class="page" tabindex="-1"></div>'
    scripts = (make_classic_script(name) for name in order_scripts("widget"))
    return "\n".join([f"const SHELL = {json.dumps(shell)};", *scripts])


@cache
def _make_widget_class() -> Any:
    widgets, traits = import_module("anywidget"), import_module("traitlets")
    members = {"_esm": make_widget_module(), "payload": traits.Unicode().tag(sync=True)}
    return type("PlanWidget", (widgets.AnyWidget,), members)
