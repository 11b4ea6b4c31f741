"""Plans that play in the page: each is planned while the documentation is built."""  # noqa: INP001 (a Sphinx extension, found by its path)

from __future__ import annotations

from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any

from docutils import nodes
from sphinx.util.docutils import SphinxDirective

import rightofway

if TYPE_CHECKING:
    from sphinx.application import Sphinx

ROOT = Path(__file__).parents[2]


class PlanPage(SphinxDirective):
    """An example of the repository, planned and played."""

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        """Write the page beside the others and return a frame that shows it."""
        scenario = ROOT / self.arguments[0]
        page = Path("plans") / f"{scenario.stem}.html"
        target = Path(self.env.app.outdir) / page
        target.parent.mkdir(parents=True, exist_ok=True)
        rightofway.write_page(rightofway.solve(rightofway.load(scenario)), target)
        self.env.note_dependency(str(scenario))
        return [nodes.raw("", self.frame(scenario.name, page), format="html")]

    def frame(self, name: str, page: Path) -> str:
        """Return the frame, and a link to see the page alone."""
        address = "../" * self.env.docname.count("/") + page.as_posix()
        title = escape(f"the plan of {name}")
        return (
            f'<iframe class="plan" src="{address}" title="{title}"></iframe>\n'
            f'<p><a href="{address}">Open it alone</a></p>'
        )


def setup(app: Sphinx) -> dict[str, Any]:
    """Register the directive."""
    app.add_directive("plan-page", PlanPage)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
