"""The faults of a plan, listed below its picture."""

from __future__ import annotations

from collections.abc import Iterator

from PIL import Image

from rightofway.viz.raster.canvas import Pen, Scene

MOST_LISTED = 5
"""Faults in the list; further ones are counted."""

TYPE, LINE, PAD = 14.0, 20.0, 24.0
"""Size of letters, height of a line, and room around the list [pixels]."""


class FaultList:
    """The list below a picture that is so wide [pixels]; its `height` is 0 without faults."""

    def __init__(self, scene: Scene, width: int) -> None:
        self.scene = scene
        self._lines = list(_lines(scene, width - 2 * PAD))
        self.height = len(self._lines) * LINE + PAD if self._lines else 0.0

    def draw(self, pen: Pen) -> None:
        """Write the heading in red, then the faults."""
        theme = self.scene.theme
        for number, line in enumerate(self._lines):
            colour = theme.held if number == 0 else theme.ink
            pen.write_text((PAD, (number + 0.5) * LINE), line, colour, size=TYPE)


def _lines(scene: Scene, width: float) -> Iterator[str]:
    verdict = scene.verdict
    if verdict.ok:
        return
    count = "1 fault" if verdict.total == 1 else f"{verdict.total} faults"
    yield f"{count}: do not run this plan"
    for fault in verdict.faults[:MOST_LISTED]:
        yield from _wrap_lines(str(fault), width)
    if verdict.total > MOST_LISTED:
        yield f"… and {verdict.total - MOST_LISTED} more"


def _wrap_lines(sentence: str, width: float) -> Iterator[str]:
    """Yield the lines of a sentence that are at most so wide [pixels]."""
    pen = Pen(Image.new("RGB", (1, 1)), origin=(0, 0), scale=1, fineness=1)
    line = ""
    for word in sentence.split(" "):
        longer = f"{line} {word}" if line else word
        if line and pen.measure_text(longer, TYPE) > width:
            yield line
            longer = f"    {word}"
        line = longer
    yield line
