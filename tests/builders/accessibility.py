"""What axe finds on a page."""

from __future__ import annotations

from importlib.resources import files
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from tests.builders.browsers import Viewer

PACKAGE = "axe_playwright_python"
"""The package that has axe."""

RUN = """async () => {
  const { violations } = await axe.run(document, { resultTypes: ["violations"] });
  return violations.filter(({ impact }) => ["serious", "critical"].includes(impact))
    .flatMap(({ id, nodes }) => nodes.map(({ html, failureSummary, target }) =>
      `${id}: ${target} ${html.slice(0, 200)} ${failureSummary.split("\\n")[1]}`));
}"""


def serious(viewer: Viewer) -> Any:
    """Return what axe calls serious or critical on a page, contrast included."""
    if not viewer.page.evaluate("Boolean(window.axe)"):
        viewer.page.evaluate(files(PACKAGE).joinpath("axe.min.js").read_text("utf-8"))
    return viewer.page.evaluate(RUN)
