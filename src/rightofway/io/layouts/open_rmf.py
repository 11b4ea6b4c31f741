"""Open-RMF: navigation graphs, and the buildings of the traffic editor.

A navigation graph is in metres, y up, and has a lane for each direction. A building is in pixels of
a drawing, y down; its measurements say how long a pixel is.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from functools import partial
from itertools import combinations
from math import atan2, hypot
from pathlib import Path
from typing import Any, NamedTuple

from rightofway.errors import InputError, quote
from rightofway.facts import Fact
from rightofway.io.faults import read_both
from rightofway.io.layouts.draft import LayoutDraft, LevelDraft
from rightofway.io.source import Source
from rightofway.site.drawing import Picture
from rightofway.site.geometry import Point
from rightofway.site.layout import Layout, LayoutVertex, name_lanes
from rightofway.site.zones import NamedZone

Transform = Callable[[Point], Point]

Groups = dict[str, tuple[list[str], list[tuple[str, str]]]]
"""For each mutex its vertices, and the ends of its lanes."""

MAX_FIDUCIALS = 200
"""The most fiducials of a level; each pair of them counts."""

IN_METRES = ("cartesian_meters",)
IN_PIXELS = (None, "reference_image")


VERTEX_KEYS = {"name", "is_charger", "is_parking_spot", "mutex"}
LANE_KEYS = {"speed_limit", "mutex", "graph_idx", "bidirectional", "is_bidirectional"}
"""The parameters that are read."""


def recognizes(document: Any) -> bool:
    """Return whether a document has levels, one of them with vertices and lanes."""
    levels = document.get("levels") if isinstance(document, dict) else None
    return isinstance(levels, dict) and any(
        isinstance(level, dict) and "vertices" in level for level in levels.values()
    )


def read(document: Any, path: Path) -> Layout:
    """Return the layout of a navigation graph or a building; its pictures lie beside the file.

    Raises
    ------
    InputError
        With every vertex and lane that cannot be used; for a building in degrees, or without scale.
    """
    root = Source(document)
    is_building = any(
        _is_of_building(level.value) for _, level in root.need("levels").read_entries()
    )
    draft = LayoutDraft("Open-RMF building" if is_building else "Open-RMF navigation graph")
    transforms = _compute_transforms(root, draft) if is_building else {}
    for name, part in root.need("levels").read_entries():
        level = draft.begin_level(name)
        draft.faults.attempt("", _read_level, level, part, transforms.get(name), draft)
        if is_building and root.value.get("coordinate_system") in IN_PIXELS:
            level.picture = _read_picture(part, transforms[name], path.parent, draft)
    _note_doors(root, draft)
    _note_lifts(root, draft)
    return draft.make_layout()


def _is_of_building(level: Any) -> bool:
    """Return whether the first vertex of a level has a height beside x and y."""
    match level:
        case {"vertices": [[_, _, height, *_], *_]}:
            return not isinstance(height, dict)
    return False


def _note_doors(root: Source, draft: LayoutDraft) -> None:
    """Note the doors of a navigation graph, which has them by name, and those of a building."""
    of_graph = root.value.get("doors")
    for name in of_graph if isinstance(of_graph, dict) else ():
        draft.note_unused_key("door", quote(name).strip("'"))
    for _, level in root.need("levels").read_entries():
        doors = level.value.get("doors") if isinstance(level.value, dict) else None
        for index, door in enumerate(doors if isinstance(doors, list) else ()):
            match door:
                case [_, _, {"name": [_, str(name)] | str(name)}, *_]:
                    draft.note_unused_key("door", quote(name).strip("'"))
                case _:
                    draft.note_unused_key("door", str(index))


def _note_lifts(root: Source, draft: LayoutDraft) -> None:
    """Note that plans use no lift, and which levels there are to choose from."""
    given = root.get("lifts")
    if given is None or not given.read_mapping():
        return
    names = [quote(name).strip("'") for name, _ in given.read_entries()]
    lifts = Fact("lift", lift=names[0])
    if len(names) > 1:
        lifts = Fact("lifts", lifts=tuple(names))
    levels = [level.name for level in draft.levels if level.vertices]
    note = Fact("lifts unused", lifts=lifts)
    if len(levels) > 1:
        note = Fact("lifts unused, levels", note=note, levels=tuple(levels))
    draft.repair(note)


def _read_picture(
    level: Source, transform: Transform, folder: Path, draft: LayoutDraft
) -> Picture | None:
    """Return the picture that a level is drawn over, and where its pixels lie."""
    drawing = level.value.get("drawing")
    name = drawing.get("filename") if isinstance(drawing, dict) else None
    if not isinstance(name, str) or not name:
        return None
    try:
        inside = (folder / name).resolve().is_relative_to(folder.resolve())
        is_there = inside and (folder / name).is_file()
    except (OSError, ValueError):
        is_there = False
    if not is_there:
        draft.repair(Fact("picture missing", file=quote(name)))
        return None
    far = Fraction(1000)  # pixels, so that rounding to a nanometre does not matter
    (x, y), (to_x, to_y) = transform((Fraction(0), Fraction(0))), transform((far, Fraction(0)))
    right, up = to_x - x, to_y - y
    try:
        pixel = right / far if up == 0 < right else Fraction(repr(hypot(right, up) / float(far)))
        yaw = Fraction(repr(atan2(up, right)))
    except (OverflowError, ValueError):
        pixel, yaw = Fraction(0), Fraction(0)
    if pixel <= 0:
        draft.repair(Fact("picture without size", file=quote(name)))
        return None
    return Picture(file=folder / name, pixel=pixel, corner=(x, y), yaw=yaw)


class _Reading(NamedTuple):
    """The level that is read, its layout, and the mutexes so far."""

    level: LevelDraft
    draft: LayoutDraft
    groups: Groups


def _read_level(
    level: LevelDraft, part: Source, transform: Transform | None, draft: LayoutDraft
) -> None:
    """Read vertices and lanes; with a transform, of a building."""
    reading = _Reading(level, draft, {})
    names = [
        draft.faults.attempt("", _add_vertex, reading, vertex, index, transform)
        for index, vertex in enumerate(part.read_items_under("vertices"))
    ]
    lanes = part.read_items_under("lanes")
    owns = [draft.faults.attempt("", _own, lane, 2) or {} for lane in lanes]
    has_graphs = len({str(own.get("graph_idx", 0)) for own in owns}) > 1
    for lane in lanes:
        draft.faults.attempt("", _add_lane, reading, lane, names, has_graphs)
    if transform is not None:  # corners of walls and floors are no vertices of the graph
        ends = {*level.lanes.tails, *level.lanes.heads}
        drawn = len(level.vertices)
        level.vertices = {name: vertex for name, vertex in level.vertices.items() if name in ends}
        level.unused = drawn - len(level.vertices)
    for name, (vertices, edges) in reading.groups.items():
        level.zones.append(NamedZone(name=name, vertices=tuple(vertices), edges=tuple(edges)))


def _own(item: Source, at: int) -> dict[str, Any]:
    """Return the parameters of a vertex or lane; those of a building are [type, value]."""
    parameters = item.read_items()[at:]
    if not parameters or parameters[0].value is None:
        return {}
    return {
        key: value[1] if isinstance(value, list) and len(value) == 2 else value  # noqa: PLR2004
        for key, value in parameters[0].read_mapping().items()
        if not isinstance(value, dict)
    }


def _name_in(own: dict[str, Any], key: str, item: Source) -> str:
    """Return a name among the parameters of a vertex or lane."""
    return item.make_child(key, own[key]).read_text()


def _add_vertex(reading: _Reading, vertex: Source, index: int, transform: Transform | None) -> str:
    level, draft, groups = reading
    items = vertex.read_items()
    if len(items) < 2:  # noqa: PLR2004 - x and y
        raise vertex.make_fault("is no vertex (give [x, y, {name: …}])")
    at = read_both(items[0].number, items[1].number)
    if transform is None:
        own = _own(vertex, 2)
        given = own.get("name")
    else:
        at, own = transform(at), _own(vertex, 4)
        given = items[3].value if len(items) > 3 else None  # noqa: PLR2004 - x, y, z, name
    name = Source(given, vertex.path).read_text() if given else f"v{index}"
    if name in level.vertices:
        name = f"{name} (v{index})"
        draft.repair(Fact("vertex with a name twice"), name)
    level.add(
        LayoutVertex(
            name=name,
            at=at,
            is_parking=own.get("is_parking_spot") is True,
            is_charging=own.get("is_charger") is True,
            is_passed=own.get("is_passthrough_point") is True,
        ),
        vertex,
    )
    draft.note_unused(Source(own), name, VERTEX_KEYS)
    if own.get("mutex"):
        groups.setdefault(_name_in(own, "mutex", vertex), ([], []))[0].append(name)
    return name


def _add_lane(reading: _Reading, lane: Source, names: list[str | None], has_graphs: bool) -> None:
    level, draft, groups = reading
    items = lane.read_items()
    if len(items) < 2:  # noqa: PLR2004 - from and to
        raise lane.make_fault("is no lane (give [from, to, {…}])")
    tail, head = read_both(*(partial(_read_vertex, item, names) for item in items[:2]))
    if tail is None or head is None:
        return  # the vertex has a fault of its own
    own = _own(lane, 2)
    (name,) = name_lanes([(tail, head)])
    draft.note_unused(Source(own), name, LANE_KEYS)
    speed = lane.make_child("speed_limit", own.get("speed_limit", 0)).number()
    both = own.get("bidirectional") is True or own.get("is_bidirectional") is True
    own.setdefault("graph_idx", 0)
    types = frozenset([f"graph {_name_in(own, 'graph_idx', lane)}"]) if has_graphs else None
    max_speed = speed if speed > 0 else None
    for start, end in ((tail, head), (head, tail)) if both else ((tail, head),):
        level.connect(lane, start, end, max_speed=max_speed, types=types)
        if own.get("mutex"):
            groups.setdefault(_name_in(own, "mutex", lane), ([], []))[1].append((start, end))


def _read_vertex(item: Source, names: list[str | None]) -> str | None:
    index = item.value
    if isinstance(index, bool) or not isinstance(index, int) or not 0 <= index < len(names):
        last = len(names) - 1
        raise item.make_fault(f"{quote(index)} is no vertex (give a number from 0 to {last})")
    return names[index]


def _compute_transforms(root: Source, draft: LayoutDraft) -> dict[str, Transform]:
    """Return for each level of a building how its points become metres of the site."""
    system = root.value.get("coordinate_system")
    levels = dict(root.need("levels").read_entries())
    if system in IN_METRES:
        return {name: lambda point: point for name in levels}
    if system not in IN_PIXELS:
        message = f"coordinates are {quote(system)} (give the building's navigation graph instead)"
        raise InputError.at("coordinate_system", message)
    named = root.value.get("reference_level_name")
    reference = named if isinstance(named, str) and named in levels else next(iter(levels), "")
    scales = {name: draft.faults.attempt("", _scale, level) for name, level in levels.items()}
    draft.faults.stop()
    base, transforms = scales.get(reference), dict[str, Transform]()
    for name, level in levels.items():
        laid = None if name == reference else _compute_overlay(levels[reference], level)
        if laid is not None and base is not None:
            transforms[name] = _make_transform(laid, base)
            continue
        scale = scales[name] or base
        if scale is None:
            message = "has no measurement, so the length of a pixel is not known (add one)"
            draft.faults.note(level.location, message)
            continue
        if name != reference:
            draft.repair(Fact("level without fiducials"), name)
        transforms[name] = _make_transform((1 + 0j, 0j), scale)
    draft.faults.stop()
    return transforms


def _make_transform(laid: tuple[complex, complex], scale: Fraction) -> Transform:
    """Return how a pixel of a level becomes a point in metres; y is negated."""
    turn, shift = laid

    def move(point: Point) -> Point:
        x, y = point
        if (turn, shift) != (1, 0):
            at = turn * complex(float(x), float(y)) + shift
            x, y = Fraction(repr(at.real)), Fraction(repr(at.imag))
        return Fraction(round(x * scale * 10**9), 10**9), Fraction(round(-y * scale * 10**9), 10**9)

    return move


def _scale(level: Source) -> Fraction | None:
    """Return the length of a pixel [m], the mean of all measurements; None without one."""
    vertices, lengths = level.read_items_under("vertices"), list[float]()
    for measurement in level.read_items_under("measurements"):
        items = measurement.read_items()
        ends = []
        for item in items[:2]:
            index = item.value
            if not isinstance(index, int) or not 0 <= index < len(vertices):
                raise item.make_fault(f"{quote(index)} is no vertex (mend the measurement)")
            x, y, *_ = [*vertices[index].read_items(), Source(0), Source(0)]
            ends.append((float(x.number()), float(y.number())))
        metres = Source(_own(measurement, 2).get("distance"), measurement.path).number()
        pixels = hypot(*(a - b for a, b in zip(*ends, strict=True))) if len(ends) == 2 else 0.0  # noqa: PLR2004
        if pixels <= 0 or metres <= 0:
            raise measurement.make_fault("has no length (take it out)")
        lengths.append(float(metres) / pixels)
    return Fraction(repr(sum(lengths) / len(lengths))) if lengths else None


def _read_fiducials(level: Source) -> dict[str, complex]:
    points, items = {}, level.read_items_under("fiducials")
    if len(items) > MAX_FIDUCIALS:
        message = f"{len(items)} fiducials are more than {MAX_FIDUCIALS} (a few are enough)"
        raise level.need("fiducials").make_fault(message)
    for fiducial in items:
        parts = fiducial.read_items()
        if len(parts) < 3:  # noqa: PLR2004 - x, y, name
            raise fiducial.make_fault("is no fiducial (give [x, y, name])")
        points[parts[2].read_text()] = complex(float(parts[0].number()), float(parts[1].number()))
    return points


def _compute_overlay(reference: Source, level: Source) -> tuple[complex, complex] | None:
    """Return turn-and-scale and shift that lay a level's fiducials over those of another.

    Of all pairs of common fiducials, the turn is the circular mean of the differences of bearings,
    and the scale the inverse mean of the ratios of distances: RMF's own generator takes these, so
    that its positions and ours are the same. None with fewer than two common fiducials.

    References
    ----------
    Open-RMF, *rmf_building_map_tools*: ``Transform.set_from_fiducials`` in ``transform.py``.
    """
    theirs, own = _read_fiducials(reference), _read_fiducials(level)
    common = [(to, own[name]) for name, to in theirs.items() if name in own]
    spans = [(to - to_2, at - at_2) for (to, at), (to_2, at_2) in combinations(common, 2)]
    if not spans or any(abs(to) == 0 or abs(at) == 0 for to, at in spans):
        return None  # two points fix turn, scale and shift
    turns = sum(to / abs(to) * (at / abs(at)).conjugate() for to, at in spans)
    if abs(turns) == 0:
        return None
    ratio = sum(abs(at) / abs(to) for to, at in spans) / len(spans)
    turn = turns / abs(turns) / ratio
    return turn, sum(to - turn * at for to, at in common) / len(common)
