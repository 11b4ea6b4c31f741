"""Layouts, written for other programs; parts without a place in a format are named.

Reading a written layout gives the same one, apart from the losses of `list_losses`.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import dist, radians, remainder, tau
from typing import Any

from rightofway.errors import InputError
from rightofway.facts import Fact
from rightofway.io.json_text import format_json_line
from rightofway.kinds.table import make_words
from rightofway.site.geometry import Point, measure_squared_distance
from rightofway.site.lane_table import LayoutEdge
from rightofway.site.layout import Layout, LayoutVertex, Level, Turns, name_lanes

LISTS = {"layouts", "nodes", "edges", "stations", "features"}
"""Keys of lists that are spread over lines."""

PASSED_VERTICES = "vertices that robots only drive through"
"""The note of formats that cannot contain `LayoutVertex.is_passed`."""

FREE_FOR_ALL = "any"
"""The vehicle type of a LIF lane with a speed limit that is open to all, where no type is named."""


@dataclass(frozen=True, slots=True, kw_only=True)
class LayoutWriter:
    """A format that layouts are written in.

    Attributes
    ----------
    summary
        Its kind, in a few words.
    write
        Returns the text of a layout.
    says
        Its parts apart from vertices, directed lanes and speed limits.
    """

    summary: str
    write: Callable[[Layout], str]
    says: frozenset[str]


def format_layout(layout: Layout, name: str) -> tuple[str, tuple[Fact, ...]]:
    """Return a layout as the text of a file for another program.

    Parameters
    ----------
    layout
        The layout.
    name
        A key of `LAYOUT_WRITERS`.

    Returns
    -------
    tuple
        The text, and the content of the layout that the format leaves out.

    Raises
    ------
    InputError
        If the name is unknown, or the layout has several levels and the format only one.
    """
    writer = LAYOUT_WRITERS[make_words(*sorted(LAYOUT_WRITERS)).read_at("name", name)]
    if len(layout.levels) > 1 and "levels" not in writer.says:
        message = f"{len(layout.levels)} levels, and {name} knows one (write lif or open-rmf)"
        raise InputError.at("", message)
    return writer.write(layout), tuple(list_losses(layout, writer.says))


def list_losses(layout: Layout, says: frozenset[str]) -> Iterator[Fact]:
    """Yield the content of a layout, other than vertices and lanes, that a format leaves out."""
    levels = layout.levels
    vertices = [vertex for level in levels for vertex in level.vertices]
    edges = [edge for level in levels for edge in level.edges]
    pieces: dict[str, Sequence[str]] = {
        "names of vertices": [vertex.name for vertex in vertices if not _is_number(vertex.name)],
        "stations": [station.name for level in levels for station in level.stations],
        "parking places": [vertex.name for vertex in vertices if vertex.is_parking],
        "charging places": [vertex.name for vertex in vertices if vertex.is_charging],
        **_list_actions(vertices),
        PASSED_VERTICES: [vertex.name for vertex in vertices if vertex.is_passed],
        "headings at vertices": [vertex.name for vertex in vertices if vertex.heading is not None],
        "orientations along lanes": [
            name for level in levels for name in name_lanes(level.orientations)
        ],
        "ids of lanes": [
            own for level in levels for ends, own in level.edge_ids.items() if own != "-".join(ends)
        ],
        "forbidden turns": [name for level in levels for name in name_lanes(_list_fixed(level))],
        "lanes longer than the straight line": [
            name for level in levels for name in _name_curved(level)
        ],
        "drawn curves": _name_edges(
            edge for edge in edges if edge.shape and edge.chord_error is None
        ),
        "curves that robots drive along": _name_edges(
            edge for edge in edges if edge.chord_error is not None
        ),
        "vehicle types": sorted({name for edge in edges for name in edge.types or ()}),
        "zones": [zone.name for level in levels for zone in level.zones],
        "further zones of one place": [name for level in levels for name in _name_overlaps(level)],
        "lanes to other levels": [name for level in levels for name in name_lanes(level.links)],
    }
    lost = tuple(
        Fact("loss", loss=loss, count=len(names), names=tuple(names))
        for loss, names in pieces.items()
        if names and loss not in says
    )
    if lost:
        yield Fact("left out of format", losses=lost)


def _list_actions(vertices: Iterable[LayoutVertex]) -> dict[str, list[str]]:
    """Return the vertices with actions: LIF has those that change the load, see its reader."""
    has = {vertex.name: {use for use, _ in vertex.actions} for vertex in vertices}
    return {
        "actions of vertices": [name for name, uses in has.items() if uses - {"work"}],
        "actions of vertices without loads": [name for name, uses in has.items() if "work" in uses],
    }


def _name_edges(edges: Iterable[LayoutEdge]) -> list[str]:
    return name_lanes((edge.tail, edge.head) for edge in edges)


def _is_number(name: str) -> bool:
    return name.isascii() and name.isdecimal() and str(int(name)) == name


def _name_overlaps(level: Level) -> Iterator[str]:
    """Yield the vertices and lanes in a zone beside their first one, each time."""
    seen = set[str | tuple[str, str]]()
    for zone in level.zones:
        members: list[str | tuple[str, str]] = [*zone.vertices, *zone.edges]
        for member in members:
            if member in seen:
                yield member if isinstance(member, str) else name_lanes([member])[0]
            seen.add(member)


def _name_curved(level: Level) -> list[str]:
    """Return the lanes that are longer than the straight line, by more than rounding.

    Lanes along a known curve do not count.
    """
    at = {vertex.name: vertex.at for vertex in level.vertices}
    near = {name: (float(x), float(y)) for name, (x, y) in at.items()}
    step = Fraction(1, 1000)
    return _name_edges(
        edge
        for edge in level.edges
        if edge.chord_error is None
        and edge.length > step
        # Lengths and distances of floats are off by far less than half a step.
        and float(edge.length) > dist(near[edge.tail], near[edge.head]) + float(step) / 2
        and (edge.length - step) ** 2 > measure_squared_distance(at[edge.tail], at[edge.head])
    )


def _write_lif(layout: Layout) -> str:
    layouts = [_make_lif_level(level) for level in layout.levels]
    about = {
        "projectIdentification": "layout",
        "creator": "rightofway",
        "exportTimestamp": "1970-01-01T00:00:00Z",
        "lifVersion": "1.0.0",
    }
    return _write_json({"metaInformation": about, "layouts": layouts}) + "\n"


def _make_lif_level(level: Level) -> dict[str, Any]:
    everybody = level.vehicle_types or (FREE_FOR_ALL,)
    at = {vertex.name: vertex.at for vertex in level.vertices}
    return {
        "layoutId": level.name or "0",
        "layoutVersion": "1",
        "layoutLevelId": level.name or "0",
        "nodes": [_make_lif_node(vertex, everybody) for vertex in level.vertices],
        "edges": [
            {"edgeId": edge_id, **_make_lif_edge(edge, sorted(edge.types or everybody), level, at)}
            for edge_id, edge in zip(_choose_edge_ids(level), level.edges, strict=True)
        ],
        "stations": [
            {"stationId": station.name, "interactionNodeIds": list(station.vertices)}
            for station in level.stations
        ],
    }


def _write_json(value: dict[str, Any], margin: str = "\n") -> str:
    """Return JSON with one node, edge, station or feature on a line."""
    if LISTS.isdisjoint(value):
        return format_json_line(value)
    inner = margin + "  "
    parts = []
    for key, child in value.items():
        if key in LISTS and child:
            rows = f",{inner}  ".join(_write_json(item, f"{inner}  ") for item in child)
            text = f"[{inner}  {rows}{inner}]"
        else:
            text = format_json_line(child)
        parts.append(f"{format_json_line(key)}: {text}")
    return f"{{{inner}{f',{inner}'.join(parts)}{margin}}}"


def _make_lif_node(vertex: LayoutVertex, types: Sequence[str]) -> dict[str, Any]:
    actions = [
        {"actionType": name, "requirementType": "CONDITIONAL", "blockingType": "HARD"}
        for name in ("startCharging", "stopCharging")
        if vertex.is_charging
    ] + [_make_lif_action(json.loads(text)) for use, text in vertex.actions if use != "work"]
    more: dict[str, Any] = {"actions": actions} if actions else {}
    if vertex.heading is not None:
        more["theta"] = _convert_to_radians(vertex.heading)
    return {
        "nodeId": vertex.name,
        "nodePosition": {"x": float(vertex.at[0]), "y": float(vertex.at[1])},
        "vehicleTypeNodeProperties": [{"vehicleTypeId": name, **more} for name in types],
    }


def _convert_to_radians(angle: Fraction) -> float:
    """Return an angle in radians, from -pi to pi."""
    return remainder(radians(angle), tau)


def _make_lif_action(own: dict[str, Any]) -> dict[str, Any]:
    """Return an action of a scenario as LIF has it."""
    action = {
        "actionType": own["action"],
        "requirementType": "CONDITIONAL",
        "blockingType": own.get("blocking", "hard").upper(),
    }
    if "description" in own:
        action["actionDescription"] = own["description"]
    if "parameters" in own:
        pairs = own["parameters"].items()
        action["actionParameters"] = [{"key": key, "value": value} for key, value in pairs]
    return action


def _choose_edge_ids(level: Level) -> Iterator[str]:
    """Yield an id for each lane: its own for the first lane that has it."""
    taken = set[str]()
    for number, edge in enumerate(level.edges):
        own = level.edge_ids.get((edge.tail, edge.head))
        edge_id = f"{edge.tail}-{edge.head} {number}" if own is None or own in taken else own
        taken.add(edge_id)
        yield edge_id


def _make_lif_edge(
    edge: LayoutEdge, types: Sequence[str], level: Level, at: Mapping[str, Point]
) -> dict[str, Any]:
    more: dict[str, Any] = {}
    if (edge.tail, edge.head) in level.orientations:
        more["vehicleOrientation"] = _convert_to_radians(level.orientations[edge.tail, edge.head])
    turns = level.turns.get((edge.tail, edge.head), {})
    if edge.max_speed is not None:
        more["maxSpeed"] = float(edge.max_speed)
    if edge.chord_error is not None:
        more["trajectory"] = _make_trajectory(edge, at)
    return {
        "startNodeId": edge.tail,
        "endNodeId": edge.head,
        "vehicleTypeEdgeProperties": [
            {"vehicleTypeId": name, **_write_turns(turns.get(name, Turns())), **more}
            for name in types
        ],
    }


def _list_fixed(level: Level) -> Iterator[tuple[str, str]]:
    """Yield the lanes at whose ends some type of robots may not turn."""
    for ends, turns in level.turns.items():
        if not all(own.at_begin and own.at_end for own in turns.values()):
            yield ends


def _write_turns(turns: Turns) -> dict[str, Any]:
    """Return where robots may turn; what LIF requires is allowed where it is unknown."""
    ends = {"rotationAtStartNodeAllowed": turns.at_begin, "rotationAtEndNodeAllowed": turns.at_end}
    return {
        "rotationAllowed": turns.along is not False,
        **{key: "NONE" for key, is_allowed in ends.items() if not is_allowed},
    }


def _make_trajectory(edge: LayoutEdge, at: Mapping[str, Point]) -> dict[str, Any]:
    """Return the curve of an edge as straight lines between its points: a NURBS of degree 1."""
    points = [at[edge.tail], *edge.shape, at[edge.head]]
    last = len(points) - 1
    return {
        "degree": 1,
        "knotVector": [0.0, *(k / last for k in range(last + 1)), 1.0],
        "controlPoints": [{"x": float(x), "y": float(y)} for x, y in points],
    }


def _write_nav2(layout: Layout) -> str:
    level = layout.levels[0]
    are_numbers = all(_is_number(vertex.name) for vertex in level.vertices)
    ids = {
        vertex.name: int(vertex.name) if are_numbers else number
        for number, vertex in enumerate(level.vertices)
    }
    at = {vertex.name: _make_pair(vertex.at) for vertex in level.vertices}
    first = max([9_999, *ids.values()]) + 1
    nodes = [
        _make_feature({"id": ids[name], "frame": "map"}, "Point", point)
        for name, point in at.items()
    ]
    edges = [
        _make_feature(
            {
                "id": number,
                "startid": ids[edge.tail],
                "endid": ids[edge.head],
                **({"metadata": {"speed_limit": float(edge.max_speed)}} if edge.max_speed else {}),
            },
            "LineString",
            [at[edge.tail], *map(_make_pair, edge.shape), at[edge.head]],
        )
        for number, edge in enumerate(level.edges, start=first)
    ]
    return (
        _write_json({"type": "FeatureCollection", "name": "graph", "features": [*nodes, *edges]})
        + "\n"
    )


def _make_feature(properties: dict[str, Any], kind: str, coordinates: Any) -> dict[str, Any]:
    geometry = {"type": kind, "coordinates": coordinates}
    return {"type": "Feature", "properties": properties, "geometry": geometry}


def _make_pair(point: tuple[Fraction, Fraction]) -> list[float]:
    return [float(point[0]), float(point[1])]


def _open_rmf(layout: Layout) -> str:
    import yaml

    levels = {level.name or "L1": _make_rmf_level(level) for level in layout.levels}
    return str(
        yaml.safe_dump(
            {"building_name": "site", "levels": levels},
            default_flow_style=None,
            sort_keys=False,
            allow_unicode=True,
        )
    )


def _make_rmf_level(level: Level) -> dict[str, Any]:
    numbers = {vertex.name: number for number, vertex in enumerate(level.vertices)}
    zones = level.zones[::-1]  # the first zone of a place stands
    of_vertex = {name: zone.name for zone in zones for name in zone.vertices}
    of_lane = {ends: zone.name for zone in zones for ends in zone.edges}
    return {
        "vertices": [
            [
                *_make_pair(vertex.at),
                {
                    "name": vertex.name,
                    **({"is_charger": True} if vertex.is_charging else {}),
                    **({"is_parking_spot": True} if vertex.is_parking else {}),
                    **({"is_passthrough_point": True} if vertex.is_passed else {}),
                    **({"mutex": of_vertex[vertex.name]} if vertex.name in of_vertex else {}),
                },
            ]
            for vertex in level.vertices
        ],
        "lanes": [
            [
                numbers[edge.tail],
                numbers[edge.head],
                {
                    "speed_limit": float(edge.max_speed or 0),
                    **(
                        {"mutex": of_lane[edge.tail, edge.head]}
                        if (edge.tail, edge.head) in of_lane
                        else {}
                    ),
                },
            ]
            for edge in level.edges
        ],
    }


NODE_KEYS = {"x": "double", "y": "double", "parking": "boolean", "charging": "boolean"}
NODE_KEYS_OF_PASSED = {"pass": "boolean"}
EDGE_KEYS = {"length": "double", "max_speed": "double"}


def _write_graphml(layout: Layout) -> str:
    from xml.sax.saxutils import quoteattr  # here, because it imports urllib

    level = layout.levels[0]
    lines = ['<?xml version="1.0" encoding="UTF-8"?>']
    lines.append('<graphml xmlns="http://graphml.graphdrawing.org/xmlns">')
    has_passed = any(vertex.is_passed for vertex in level.vertices)
    node_keys = NODE_KEYS | NODE_KEYS_OF_PASSED if has_passed else NODE_KEYS
    for kind, keys in (("node", node_keys), ("edge", EDGE_KEYS)):
        lines += [
            f'  <key id="{key}" for="{kind}" attr.name="{key}" attr.type="{type_}"/>'
            for key, type_ in keys.items()
        ]
    lines.append('  <graph id="G" edgedefault="directed">')
    for vertex in level.vertices:
        x, y = _make_pair(vertex.at)
        data = {"x": x, "y": y, "parking": vertex.is_parking, "charging": vertex.is_charging,
                "pass": vertex.is_passed}  # fmt: skip
        lines.append(f"    <node id={quoteattr(vertex.name)}>{_write_data(data)}</node>")
    for edge in level.edges:
        ends = f"source={quoteattr(edge.tail)} target={quoteattr(edge.head)}"
        data = {"length": float(edge.length)}
        if edge.max_speed is not None:
            data["max_speed"] = float(edge.max_speed)
        lines.append(f"    <edge {ends}>{_write_data(data)}</edge>")
    return "\n".join([*lines, "  </graph>", "</graphml>", ""])


def _write_data(values: dict[str, Any]) -> str:
    from xml.sax.saxutils import escape

    return "".join(
        f'<data key="{key}">{escape(format_json_line(value))}</data>'
        for key, value in values.items()
        if value is not False
    )


LAYOUT_WRITERS: dict[str, LayoutWriter] = {
    "lif": LayoutWriter(
        summary="LIF 1.0.0", write=_write_lif,
        says=frozenset({"names of vertices", "levels", "stations", "charging places",
                        "actions of vertices", "vehicle types", "ids of lanes",
                        "curves that robots drive along",
                        "headings at vertices", "orientations along lanes",
                        "forbidden turns"}),
    ),
    "nav2": LayoutWriter(
        summary="route graph of Nav2, GeoJSON", write=_write_nav2, says=frozenset({"drawn curves"}),
    ),
    "open-rmf": LayoutWriter(
        summary="navigation graph of Open-RMF", write=_open_rmf,
        says=frozenset({"names of vertices", "levels", "parking places", "charging places",
                        "zones", PASSED_VERTICES}),
    ),
    "graphml": LayoutWriter(
        summary="GraphML, metres", write=_write_graphml,
        says=frozenset({"names of vertices", "parking places", "charging places",
                        "lanes longer than the straight line", PASSED_VERTICES}),
    ),
}  # fmt: skip
"""The formats by name."""
