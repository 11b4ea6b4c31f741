"""One strategy for all laws: small fleets of any kind that a scenario file can describe.

A fleet drives on a grid, on a drawn roadmap, or on a real layout, and may have any of `FEATURES`. A
law leaves features out only where the contract of what it tests refuses them.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from functools import cache
from math import dist
from pathlib import Path
from typing import Any

import numpy as np
from hypothesis import reject
from hypothesis import strategies as st

from rightofway.errors import InputError
from rightofway.io import dump_scenario, load_map, make_example, parse_scenario
from rightofway.io.yaml_text import parse_yaml
from rightofway.model import Scenario

__all__ = ["FEATURES", "LAPS_REFUSE", "any_fleet", "fleet_documents"]

SAMPLES = Path(__file__).parents[1] / "data" / "samples"

FEATURES = (
    "barred",  # types of robots kept off edges
    "both",  # a robot books the vertex that it drives to
    "closures",
    "forbidden turns",  # vertices at which robots may not turn
    "headway",
    "laps",
    "layouts",  # a real site instead of a drawn one
    "limits",  # speed limits of edges, and of types of robots there
    "no rotations",
    "one way",  # the trip ends at the last stop
    "one-way lanes",
    "passed",  # vertices that robots only drive through
    "sizes",
    "spacing",  # lanes cut into pieces
    "speeds",  # own speeds of robots
    "stops",  # several stops of a robot, also at one vertex
    "surcharges",
    "turn rates",
    "turns",  # turning times of stops
    "weights",  # of the robots' completion times
    "zones",
)
"""What a fleet may have; without any of them it is the paper's: points of speed 1 on a grid."""

OF_LANES = {"barred", "forbidden turns", "limits", "one-way lanes", "passed", "spacing",
            "surcharges", "zones"}  # fmt: skip
"""Features that grids do not have."""

LAPS_REFUSE = {"closures", "one way"}
"""Features that repeated laps refuse (test_laps.py has the messages)."""

LAYOUTS = (
    "lif/example_10_7_station_with_two_nodes.lif.json",
    "lif/example_10_9_rotation_station.lif.json",
    "nav2/depot_graph.geojson",
    "nav2/sample_graph.geojson",
    "open_rmf/battle_royale.building.yaml",
    "open_rmf/office.building.yaml",
    "open_rmf/triple_H.building.yaml",
)
"""Sites of 4 to 40 vertices that reach each other."""

WAREHOUSE = SAMPLES / "movingai" / "random-32-32-20.map"

Document = dict[str, Any]


def any_fleet(
    *,
    robots: tuple[int, int] = (1, 4),
    without: Collection[str] = (),
    always: Collection[str] = (),
    apart: bool = False,
    joined: bool = False,
    tiny: bool = False,
) -> st.SearchStrategy[Scenario]:
    """Return fleets of any kind; some have no plan.

    Parameters
    ----------
    robots
        Least and largest number of robots.
    without
        Features that no fleet has: those that the contract of the tested function refuses.
    always
        Features that each fleet has.
    apart
        Whether no robot ends its work at a home.
    joined
        Whether lanes lead from every place to every other one, for robots of every type; drawn
        lanes have a ring through all vertices then.
    tiny
        Whether sites have at most nine vertices, not counting those of `spacing`, for oracles that
        search where all robots may be; none of the layouts is so small.
    """
    drawn = fleet_documents(
        robots=robots, without=without, always=always, apart=apart, joined=joined, tiny=tiny
    )
    return drawn.map(_scenario)


def _scenario(document: Document) -> Scenario:
    try:
        return parse_scenario(document)
    except InputError:  # homes too near to each other, a closure of nothing
        reject()
        raise


@st.composite
def fleet_documents(
    draw: st.DrawFn,
    *,
    robots: tuple[int, int],
    without: Collection[str],
    always: Collection[str],
    apart: bool = False,
    joined: bool = False,
    tiny: bool = False,
) -> Document:
    """Return scenario files, read."""
    unknown = {*without, *always} - set(FEATURES)
    assert not unknown, f"no such features: {unknown}"
    may = [feature for feature in FEATURES if feature not in {*without, *always}]
    has = {*always, *draw(st.sets(st.sampled_from(may), max_size=7) if may else st.just(set()))}
    kind = has - {"layouts"} if tiny else has
    site, places = _site(draw, kind, 3 if tiny else 6, joined=joined)
    if len(places) // 2 < robots[0]:
        reject()
    count = draw(st.sampled_from(range(robots[0], min(robots[1], len(places) // 2) + 1)))
    homes = draw(st.lists(st.sampled_from(places), min_size=count, max_size=count, unique=True))
    left = [place for place in places if not apart or place not in homes]
    targets = draw(st.lists(st.sampled_from(left), min_size=count, max_size=count, unique=True))
    ways = site.get("roadmap", {}).get("edges", [])
    return {
        "format": "rightofway-scenario/1",
        "map": site,
        "robots": [
            {"name": f"R{number}", **_trip(draw, has, trip, places), **_own(draw, has)}
            for number, trip in enumerate(zip(homes, targets, strict=True), start=1)
        ],
        "rules": _rules(draw, has),
        "closures": _closures(draw, places, ways) if "closures" in has else [],
    }


def _site(draw: st.DrawFn, has: set[str], side: int, *, joined: bool) -> tuple[Document, list[str]]:
    """Return a map, and the places where robots may start and work."""
    if "layouts" in has:
        name = draw(st.sampled_from(("grid", *LAYOUTS)))
        if name == "grid":
            return _grid(_window(draw), joined=joined)
        roadmap, found = _layout(name)
        return _on_lanes(draw, has, roadmap, found, open_lanes=len(roadmap["edges"]) * joined)
    if not has & OF_LANES and draw(st.booleans()):
        width = draw(st.integers(3, side))
        cells = st.lists(st.sampled_from("....@"), min_size=width, max_size=width).map("".join)
        rows = ["." * width, *draw(st.lists(cells, min_size=1, max_size=side - 1))]
        return _grid(rows, joined=joined)
    roadmap, found = _drawn(draw, has, side, joined=joined)
    return _on_lanes(draw, has, roadmap, found, open_lanes=len(found) * joined)


def _window(draw: st.DrawFn) -> list[str]:
    """Return a window of a benchmark map, 8 cells wide and 6 high."""
    rows = load_map(WAREHOUSE)
    top, left = draw(st.integers(0, len(rows) - 6)), draw(st.integers(0, len(rows[0]) - 8))
    return [row[left : left + 8] for row in rows[top : top + 6]]


def _grid(rows: list[str], *, joined: bool) -> tuple[Document, list[str]]:
    """Return a grid and its free cells; joined, those that the first one is joined to."""
    width = len(rows[0])
    free = [
        row * width + column
        for row, cells in enumerate(rows)
        for column, cell in enumerate(cells)
        if cell == "."
    ]
    if joined and free:
        steps = [
            step
            for cell in free
            for step in ((cell, cell + width), *([(cell, cell + 1)] * ((cell + 1) % width > 0)))
            if step[1] in free
        ]
        free = sorted(_reached(free[0], [*steps, *(step[::-1] for step in steps)]))
    if len(free) < 4:
        reject()
    return {"grid": rows}, [f"N{cell}" for cell in free]


def _reached(start: int, edges: Iterable[tuple[int, int]]) -> set[int]:
    """Return the vertices that edges lead to from a vertex, itself included."""
    heads: dict[int, list[int]] = {}
    for tail, head in edges:
        heads.setdefault(tail, []).append(head)
    reached, left = {start}, [start]
    while left:
        found = set(heads.get(left.pop(), ())) - reached
        reached |= found
        left += found
    return reached


def _drawn(
    draw: st.DrawFn, has: set[str], side: int, *, joined: bool
) -> tuple[Document, list[str]]:
    """Return vertices anywhere, lanes that join all of them, and lanes that may cross those."""
    lattice = st.tuples(st.integers(0, side), st.integers(0, side - 1))
    at = draw(st.lists(lattice, min_size=4, max_size=side + 4, unique=True))
    if joined:
        first = [(k - 1, k % len(at)) for k in range(1, len(at) + 1)]
    else:
        first = [(draw(st.integers(0, k - 1)), k) for k in range(1, len(at))]
    ends = st.integers(0, len(at) - 1)
    more = draw(st.lists(st.tuples(ends, ends), max_size=6))
    lanes = {frozenset(lane): lane for lane in first}
    for tail, head in more:
        if tail != head:
            lanes.setdefault(frozenset((tail, head)), (tail, head))
    names = [f"v{k}" for k in range(len(at))]
    one_way = st.booleans() if "one-way lanes" in has else st.just(False)
    edges = [
        {
            "from": names[tail],
            "to": names[head],
            "length": _quarters(dist(at[tail], at[head])),
            "both_ways": not draw(one_way),
        }
        for tail, head in lanes.values()
    ]
    return {"vertices": dict(zip(names, map(list, at), strict=True)), "edges": edges}, names


def _quarters(length: float) -> str:
    """Return the least multiple of 1/4 that is not below a length."""
    return f"{next(n for n in range(1, 99) if n * n >= 16 * round(length**2))}/4"


@cache
def _layout(name: str) -> tuple[Document, list[str]]:
    """Return the roadmap of a layout, and the vertices that its first robot can go to and back."""
    document = parse_yaml(make_example(SAMPLES / name, SAMPLES / "scenario.yaml").text)
    scenario = parse_scenario(document, SAMPLES)
    inlined = dump_scenario(scenario)["map"]
    roadmap, start = scenario.roadmap, int(scenario.robots[0].home)
    tails = np.repeat(np.arange(len(roadmap.indptr) - 1), np.diff(roadmap.indptr)).tolist()
    heads = roadmap.heads.tolist()
    there = _reached(start, zip(tails, heads, strict=True))
    back = _reached(start, zip(heads, tails, strict=True))
    return inlined["roadmap"], [roadmap.name(vertex) for vertex in sorted(there & back)]


def _on_lanes(
    draw: st.DrawFn,
    has: set[str],
    roadmap: Mapping[str, Any],
    places: list[str],
    *,
    open_lanes: int,
) -> tuple[Document, list[str]]:
    """Return a roadmap with what lanes may have; the first lanes are open to all types."""
    edges = [dict(edge) for edge in roadmap["edges"]]
    some = st.lists(st.sampled_from(range(len(edges))), max_size=3)
    if "limits" in has:
        for edge in draw(some):
            edges[edge]["max_speed"] = draw(st.sampled_from(["1/2", "1"]))
        for edge in draw(some):
            edges[edge]["max_speed_by_type"] = {"wide": draw(st.sampled_from(["1/3", "2"]))}
    if "barred" in has:
        for edge in draw(some):
            if edge >= open_lanes:
                edges[edge]["barred"] = ["wide"]
    if "surcharges" in has:
        for edge in draw(some):
            edges[edge]["surcharge"] = 3
    changed = {**roadmap, "edges": edges}
    if "zones" in has:
        lanes = [[edge["from"], edge["to"]] for edge in edges]
        changed["zones"] = [
            {
                "name": f"Z{k}",
                "vertices": draw(st.lists(st.sampled_from(places), max_size=2, unique=True)),
                "edges": draw(
                    st.lists(st.sampled_from(lanes), min_size=1, max_size=3, unique_by=tuple)
                ),
            }
            for k in range(draw(st.integers(1, 2)))
        ]
    few = st.lists(st.sampled_from(places), min_size=1, max_size=3, unique=True)
    passed = draw(few) if "passed" in has else []
    fixed = draw(few) if "forbidden turns" in has else []
    vertices = _change(roadmap["vertices"], passed, **{"pass": True})
    changed["vertices"] = _change(vertices, fixed, turning=False)
    places = [place for place in places if place not in passed]
    spacing = {"spacing": draw(st.sampled_from([2, "4/3"]))} if "spacing" in has else {}
    return {"roadmap": changed, **spacing}, places


def _change(vertices: Mapping[str, Any], names: Collection[str], **own: bool) -> Document:
    """Return vertices of which some have a property more."""
    drawn = {name: at if isinstance(at, dict) else {"at": at} for name, at in vertices.items()}
    return {name: {**drawn[name], **own} if name in names else at for name, at in vertices.items()}


def _trip(draw: st.DrawFn, has: set[str], trip: tuple[str, str], places: list[str]) -> Document:
    home, target = trip
    work = st.integers(0, 3)
    if "stops" not in has:
        return {"home": home, "target": target, "work": draw(work)}
    before = draw(st.lists(st.sampled_from([*places, home, target]), max_size=2))
    return {"home": home, "stops": [{"at": at, "work": draw(work)} for at in [*before, target]]}


def _own(draw: st.DrawFn, has: set[str]) -> Document:
    """Return what a robot has of its own."""
    robot: Document = {}
    if "speeds" in has:
        robot["speed"] = draw(st.sampled_from(["1", "1/2", "2", "1/3"]))
    if "sizes" in has:
        robot["radius"] = draw(st.sampled_from(["0.3", "0", "0.2", "0.45", "0.7"]))
    if "turn rates" in has:
        robot["turn_rate"] = draw(st.sampled_from([45, 30, 90]))
    if "turns" in has:
        robot["turn"] = draw(st.sampled_from([0, "1/2", 2]))
    if not has.isdisjoint({"barred", "limits"}) and draw(st.booleans()):
        robot["type"] = "wide"
    if "weights" in has:
        robot["weight"] = draw(st.sampled_from([1, 3, "1/2"]))
    return robot


def _rules(draw: st.DrawFn, has: set[str]) -> Document:
    rules: Document = {}
    if "both" in has:
        rules["occupancy"] = "both"
    if "headway" in has:
        rules["headway"] = draw(st.sampled_from([1, "1/2"]))
    if "one way" in has:
        rules["return"] = "none"
    elif "laps" in has:
        rules["laps"] = draw(st.integers(2, 3))
    if "no rotations" in has:
        rules["rotations"] = False
    return rules


def _closures(draw: st.DrawFn, places: list[str], edges: list[Document]) -> list[Document]:
    found = []
    for _ in range(draw(st.integers(1, 2))):
        start = draw(st.integers(0, 15))
        closure: Document = {"from": start, "until": start + draw(st.integers(1, 15))}
        on_an_edge: bool = draw(st.booleans())
        if edges and on_an_edge:
            edge = draw(st.sampled_from(edges))
            closure["edge"] = [edge["from"], edge["to"]]
        else:
            closure["at"] = draw(st.sampled_from(places))
        if draw(st.booleans()):
            closure["radius"] = "1/2"
        found.append(closure)
    return found
