"""How long large layouts take, and how much memory: a LIF, a GraphML file and a map in pixels.

``python -m benchmarks.large_layouts`` measures each in a process of its own: reading the file, and
reading a scenario that has it as its map.
"""

from __future__ import annotations

import json
import multiprocessing
import resource
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from fractions import Fraction
from pathlib import Path

SIDE = 220
"""Rows and columns of the nodes of the LIF: 48 400 of them."""

GRAPH_SIDE = 159
"""Rows and columns of the GraphML file: 100 488 edges."""

PIXELS = 4000
"""Rows and columns of the map."""

Ends = tuple[tuple[int, int], tuple[int, int]]


def _lanes(side: int) -> Iterator[Ends]:
    """Yield the lanes between neighbours of a square, both ways."""
    for row in range(side):
        for column in range(side):
            for other in ((row, column + 1), (row + 1, column)):
                if max(other) < side:
                    yield (row, column), other
                    yield other, (row, column)


def lif(folder: Path) -> Path:
    """Write a LIF with a vehicle type and a speed limit on every lane."""
    nodes = [
        {
            "nodeId": f"n{row}_{column}",
            "nodePosition": {"x": column * 1.25, "y": row * 0.8},
            "vehicleTypeNodeProperties": [{"vehicleTypeId": "tugger", "theta": 0.0}],
        }
        for row in range(SIDE)
        for column in range(SIDE)
    ]
    edges = [
        {
            "edgeId": f"e{number}",
            "startNodeId": "n{}_{}".format(*tail),
            "endNodeId": "n{}_{}".format(*head),
            "vehicleTypeEdgeProperties": [
                {"vehicleTypeId": "tugger", "rotationAllowed": True, "maxSpeed": 1.2}
            ],
        }
        for number, (tail, head) in enumerate(_lanes(SIDE))
    ]
    path = folder / "large.lif.json"
    layout = {"layoutId": "hall", "nodes": nodes, "edges": edges, "stations": []}
    path.write_text(json.dumps({"layouts": [layout]}), encoding="utf-8")
    return path


def graphml(folder: Path) -> Path:
    """Write a GraphML file with lengths and speed limits."""
    lines = ["<graphml>", '<graph edgedefault="directed">']
    for row in range(GRAPH_SIDE):
        for column in range(GRAPH_SIDE):
            x, y = f'<data key="x">{column * 1.1:.1f}</data>', f'<data key="y">{row}</data>'
            lines.append(f'<node id="{row}-{column}">{x}{y}</node>')
    for tail, head in _lanes(GRAPH_SIDE):
        ends = 'source="{}-{}" target="{}-{}"'.format(*tail, *head)
        data = '<data key="length">1.2</data><data key="max_speed">1.0</data>'
        lines.append(f"<edge {ends}>{data}</edge>")
    path = folder / "large.graphml"
    path.write_text("\n".join([*lines, "</graph>", "</graphml>", ""]), encoding="utf-8")
    return path


def ros_map(folder: Path) -> Path:
    """Write a map with 3000 random obstacles."""
    import numpy as np
    from PIL import Image

    rng = np.random.default_rng(0)
    pixels = np.full((PIXELS, PIXELS), 254, np.uint8)
    for _ in range(3000):
        row, column, high, wide = rng.integers((0, 0, 5, 5), (PIXELS, PIXELS, 60, 60))
        pixels[row : row + high, column : column + wide] = 0
    Image.fromarray(pixels).save(folder / "large.pgm")
    path = folder / "large.yaml"
    path.write_text(
        "image: large.pgm\nresolution: 0.05\norigin: [-10, -20, 0]\nnegate: 0\n"
        "occupied_thresh: 0.65\nfree_thresh: 0.2\n",
        encoding="utf-8",
    )
    return path


def _peak() -> float:
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def measured(path: Path) -> None:
    """Print CPU time and the most memory of a process that opens a layout."""
    from rightofway.io import parse_scenario, read_layout
    from rightofway.site.layout import Layout

    begin = time.process_time()
    found = read_layout(path)
    if not isinstance(found, Layout):
        found.cut_cells(Fraction(1, 2), radius=Fraction(1, 3))  # type: ignore[union-attr]
    report = f"{path.name}: {time.process_time() - begin:.2f} s, {_peak():.0f} MB"
    if isinstance(found, Layout):
        one, other, *_ = (vertex.name for vertex in found.levels[0].vertices)
        del found
        begin = time.process_time()
        parse_scenario(
            {
                "format": "rightofway-scenario/1",
                "map": {"layout": path.name},
                "robots": [{"name": "R1", "home": one, "target": other}],
            },
            path.parent,
        )
        report += f"; as a scenario {time.process_time() - begin:.2f} s, {_peak():.0f} MB"
    sys.stdout.write(f"{report}\n")
    sys.stdout.flush()


def main() -> None:
    """Measure each layout in a process of its own."""
    makers: tuple[Callable[[Path], Path], ...] = (lif, graphml, ros_map)
    with tempfile.TemporaryDirectory() as name:
        for make in makers:
            process = multiprocessing.get_context("spawn").Process(
                target=measured, args=(make(Path(name)),)
            )
            process.start()
            process.join()


if __name__ == "__main__":
    main()
