"""Animated plans in pages: each is planned while the documentation is built."""  # noqa: INP001 (a Sphinx extension, found by its path)

from __future__ import annotations

from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

from docutils import nodes
from docutils.parsers.rst import directives
from sphinx.util.docutils import SphinxDirective

import rightofway
from rightofway.cyclic import make_excerpt, run_laps
from rightofway.execution import simulate

if TYPE_CHECKING:
    from sphinx.application import Sphinx

ROOT = Path(__file__).parents[2]


class PlanPage(SphinxDirective):
    """An example of the repository, planned and played: a plan, laps, or what became of a plan."""

    required_arguments = 1
    option_spec: ClassVar = {"delays": directives.unchanged_required, "laps": directives.flag}

    def run(self) -> list[nodes.Node]:
        """Write the page beside the others and return a frame that shows it."""
        scenario = ROOT / self.arguments[0]
        kind = next((f"{kind}-" for kind in ("laps", "delays") if kind in self.options), "")
        page = Path("plans") / f"{kind}{scenario.stem}.html"
        target = Path(self.env.app.outdir) / page
        target.parent.mkdir(parents=True, exist_ok=True)
        self.write(rightofway.load(scenario), target)
        self.env.note_dependency(str(scenario))
        return [nodes.raw("", self.frame(scenario.name, page), format="html")]

    def write(self, scenario: rightofway.Scenario, target: Path) -> None:
        """Write the page."""
        if "laps" in self.options:
            plan, steady = make_excerpt(run_laps(scenario))
            rightofway.write_page(plan, target, steady=steady)
            return
        plan, actual = rightofway.solve(scenario), None
        if "delays" in self.options:
            actual = simulate(plan, self.options["delays"], runs=1).trace()
        rightofway.write_page(plan, target, actual=actual)

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
