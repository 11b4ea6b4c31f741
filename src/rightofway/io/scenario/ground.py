"""What the places of a scenario document are looked up on."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from rightofway.model import Floor, Roadmap

__all__ = ["Ground"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Ground:
    """A roadmap and what only its document knows.

    Attributes
    ----------
    roadmap
        What robots drive on.
    lines
        The rows of a grid as they were written; empty on other roadmaps.
    floor
        The floor that the grid was cut from, if any.
    file
        The file it was read from, if any.
    """

    roadmap: Roadmap
    lines: tuple[str, ...] = ()
    floor: Floor | None = None
    file: Path | None = None

    def notes(self) -> tuple[str, ...]:
        """Return sentences on what was made of the document."""
        grid = self.roadmap.grid
        if self.floor is None or grid is None:
            return ()
        cells = f"{grid.columns} x {grid.rows} = {grid.columns * grid.rows}"
        return (f"floor cut into {cells} cells of {grid.cell_size}",)
