"""What is written is read back the same, whatever it is."""

import csv
import tempfile
from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from typing import Any, TypeVar

import pytest
from hypothesis import reject
from hypothesis import strategies as st

from rightofway.errors import InputError
from rightofway.io import (
    dump_plan,
    dump_scenario,
    load,
    load_plan,
    parse_plan,
    parse_scenario,
    write_plan,
    write_scenario,
)
from rightofway.kinds.numbers import format_number, read_exact
from rightofway.kinds.table import (
    COUNT,
    NAME,
    NOT_NEGATIVE,
    POSITIVE,
    TRUTH,
    TURNING,
    WHOLE,
    Kind,
)
from rightofway.model import (
    Decision,
    Objective,
    Outcome,
    OutcomeKind,
    Plan,
    PlannerRun,
    Reroute,
    Robot,
    Rules,
    Scenario,
    Status,
    SteadyState,
    Stop,
    Tick,
    Track,
)
from rightofway.model.attributes import Attribute
from rightofway.model.kept_facts import KeptFact, RerouteReason
from rightofway.model.robot import ROBOT_ATTRIBUTES, RULE_ATTRIBUTES
from rightofway.site import Edge, Roadmap, VertexId, make_grid_roadmap, make_roadmap
from tests.builders.any_fleet import any_fleet
from tests.builders.laws import law, leave

names = st.one_of(
    st.text(min_size=1, max_size=8).filter(str.isprintable),
    st.sampled_from(["1", "1e5", "1.5", "true", "no", "null", "~", "=", "<<", "- a", "a: b", "#"]),
    st.sampled_from([" ", "a ", "'", '"', "@", "!x", "&a", "*a", "1:30", "0x1", "2026-01-02", "|"]),
)
lengths = st.fractions(Fraction(1, 60), 60, max_denominator=60)
times = st.fractions(0, 60, max_denominator=60)
turns = st.one_of(st.none(), times)
rates = st.one_of(st.none(), lengths)


coordinates = st.fractions(-(10**6), 10**6, max_denominator=10**6)


@st.composite
def grids(draw: st.DrawFn) -> Roadmap:
    rows, columns = draw(st.integers(1, 5)), draw(st.integers(2, 5))
    cells = draw(st.lists(st.sampled_from("..@"), min_size=rows * columns, max_size=rows * columns))
    cells[:2] = ".."
    lines = ["".join(cells[row * columns : (row + 1) * columns]) for row in range(rows)]
    corners = st.none() | st.tuples(coordinates, coordinates)
    return make_grid_roadmap(
        lines, cell_size=draw(lengths), y_up=draw(st.booleans()), origin=draw(corners)
    )


@st.composite
def drawn_roadmaps(draw: st.DrawFn) -> Roadmap:
    places = st.floats(-1e9, 1e9) | coordinates
    positions = draw(st.dictionaries(names, st.tuples(places, places), min_size=2, max_size=5))
    pairs = st.tuples(st.sampled_from(list(positions)), st.sampled_from(list(positions)))
    ends = draw(st.lists(pairs.filter(lambda pair: pair[0] != pair[1]), unique=True, max_size=8))
    edges = [Edge(tail=tail, head=head, length=draw(lengths)) for tail, head in ends]
    return make_roadmap(positions, edges, y_up=draw(st.booleans()))


@st.composite
def scenarios(draw: st.DrawFn) -> Scenario:
    roadmap = draw(st.one_of(grids(), drawn_roadmaps()))
    rules = Rules(
        occupancy=draw(st.sampled_from(["one", "both"])),
        headway=draw(times),
        turn=draw(turns if roadmap.grid is None else st.one_of(turns, st.just("cell"))),
        laps=draw(st.integers(1, 3)),
        rotations=draw(st.booleans()),
        turn_rate=draw(rates),
    )
    vertices = st.integers(0, roadmap.n_vertices - 1).map(VertexId)
    stops = st.builds(Stop, at=vertices, work=times)
    robots = tuple(
        Robot(
            name=name,
            home=VertexId(home),
            stops=tuple(draw(st.lists(stops, min_size=1, max_size=3))),
            speed=draw(lengths),
            turn=draw(turns),
            ends=draw(st.sampled_from([None, "home"])),
            laps=draw(st.sampled_from([None, 2])),
            turn_rate=draw(rates),
        )
        for home, name in enumerate(draw(st.lists(names, min_size=1, max_size=2, unique=True)))
    )
    try:
        return Scenario(roadmap=roadmap, robots=robots, rules=rules)
    except InputError:  # a turn of more ticks than can be counted
        reject()
        raise


options = st.recursive(
    st.one_of(st.none(), st.booleans(), st.integers(-(2**63), 2**63), st.text(), st.floats(-1, 1)),
    lambda inner: st.one_of(st.lists(inner, max_size=2), st.dictionaries(st.text(), inner)),
    max_leaves=4,
)


@st.composite
def plans(draw: st.DrawFn) -> Plan:
    scenario = draw(scenarios())
    robots = st.integers(0, len(scenario.robots) - 1)
    vertices = st.integers(0, scenario.roadmap.n_vertices - 1).map(VertexId)
    ticks = st.integers(-(2**40), 2**40).map(Tick)
    counts = st.tuples(st.one_of(st.none(), ticks), st.one_of(st.none(), ticks))
    pair = draw(st.tuples(robots, robots))
    decision: st.SearchStrategy[Decision] = st.builds(
        Decision,
        tick=ticks,
        kind=st.sampled_from(["vertex", "head-on"]),
        vertices=st.lists(vertices, max_size=3).map(tuple),
        robots=st.just(pair),
        waits=st.sampled_from(pair),
        waits_at=vertices,
        ticks=ticks,
        level=st.sampled_from(["node", "robot", "only"]),
        conflicts_left=counts,
        completion_sums=st.one_of(st.none(), counts),
    )
    run = PlannerRun(
        name=draw(names),
        options=draw(st.dictionaries(st.text(), options, max_size=2)),
        seed=draw(st.integers(0, 2**64)),
        status=draw(st.none() | STATUSES),
        seconds=draw(st.one_of(st.none(), st.integers(0, 99), st.sampled_from([0.25, 1e-6]))),
        decisions=tuple(draw(st.lists(decision, max_size=2))),
        outcome=draw(st.one_of(st.none(), OUTCOMES)),
        reroutes=tuple(
            draw(st.lists(st.builds(Reroute, robot=robots, because=REASONS), max_size=2))
        ),
    )
    track = st.lists(st.tuples(vertices, ticks), min_size=1, max_size=6)
    tracks = tuple(Track.of(*zip(*draw(track), strict=True)) for _ in scenario.robots)
    return Plan(scenario=scenario, tracks=tracks, run=run, steady=draw(repeating(tracks)))


F = TypeVar("F", bound=KeptFact)


def _facts(of: type[F], inner: st.SearchStrategy[Status]) -> st.SearchStrategy[F]:
    """Return facts of all kinds, with these statuses in them."""
    samples = {
        "text": st.text(max_size=8).filter(str.isprintable),
        "{kind, counts}": inner,
        WHOLE.name: st.integers(0, 2**40),
        "a number": st.fractions(1, 9, max_denominator=9),
        "a list, each text": st.lists(names, max_size=3).map(tuple),
    }
    kinds = [
        st.builds(
            of,
            st.just(kind),
            **{
                name: st.sampled_from(value.words) if value.words else samples[value.name]
                for name, value in values.items()
            },
        )
        for kind, values in of.KINDS.items()
    ]
    return st.one_of(kinds)


STATUSES = st.recursive(
    st.just(Status("waits only")), lambda inner: _facts(Status, inner), max_leaves=4
)
REASONS = _facts(RerouteReason, st.just(Status("waits only")))

OUTCOMES = st.builds(
    Outcome,
    kind=st.sampled_from(OutcomeKind),
    objective=st.sampled_from(Objective),
    bound=st.one_of(st.none(), st.integers(0, 10**6)),
    factor=st.one_of(st.none(), st.fractions(1, 9, max_denominator=99)),
)


@st.composite
def repeating(draw: st.DrawFn, tracks: Sequence[Track]) -> tuple[SteadyState, ...]:
    lasts = [len(track) - 1 for track in tracks]
    robots = draw(st.lists(st.integers(0, len(tracks) - 1), max_size=len(tracks), unique=True))
    return tuple(
        SteadyState(
            robots=(robot,),
            start=Tick(draw(st.integers(0, 2**40))),
            period=Tick(draw(st.integers(1, 2**40))),
            critical=tuple((robot, visit) for visit in range(draw(st.integers(0, lasts[robot])))),
        )
        for robot in robots
    )


@law(st.fractions(-1000, 1000, max_denominator=10**15))
def test_fractions(number: Fraction) -> None:
    assert read_exact(format_number(number)) == number


@law(scenarios())
def test_scenario_documents(scenario: Scenario) -> None:
    assert parse_scenario(dump_scenario(scenario)) == scenario


@law(any_fleet())
def test_fleets_of_any_kind(scenario: Scenario) -> None:
    assert parse_scenario(dump_scenario(scenario)) == scenario


VALUES: dict[Kind[Any], st.SearchStrategy[Any]] = {
    POSITIVE: lengths,
    NOT_NEGATIVE: times,
    TURNING: times,
    COUNT: st.integers(1, 3),
    NAME: names,
    TRUTH: st.booleans(),
}
"""Values of each kind of attribute."""


def attributes(draw: st.DrawFn, table: Sequence[Attribute]) -> dict[str, Any]:
    """Return values of some of the attributes of a table."""
    some = draw(st.sets(st.sampled_from(table), max_size=3))
    return {
        it.name: draw(st.sampled_from(it.kind.words) if it.kind.words else VALUES[it.kind])
        for it in some
    }


@st.composite
def with_attributes(draw: st.DrawFn) -> Scenario:
    """Return a fleet of any kind whose robots and rules have any attributes of the tables."""
    fleet = draw(any_fleet())
    robots = (replace(it, **attributes(draw, ROBOT_ATTRIBUTES)) for it in fleet.robots)
    rules = replace(fleet.rules, **attributes(draw, RULE_ATTRIBUTES))
    try:
        return replace(fleet, robots=tuple(robots), rules=rules)
    except InputError:  # laps without a way back, a clearance for points, homes too near
        reject()
        raise


def reread(scenario: Scenario, name: str) -> Scenario:
    """Return what a file of a scenario says; a CSV file is the table of its robots."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, name)
        if not name.endswith(".csv"):
            write_scenario(scenario, path)
            return load(path)
        document = dump_scenario(scenario)
        keys = sorted({key for robot in document["robots"] for key in robot})
        stops = range(1, 1 + max(len(robot.stops) for robot in scenario.robots))
        heads = [key for key in keys if key not in {"stops", "target", "work"}]
        heads += [f"{what} {k}" for k in stops for what in ("stop", "work")]
        with path.open("w", encoding="utf-8", newline="") as file:
            table = csv.writer(file)
            table.writerow(heads)
            for robot in document["robots"]:
                row = dict(robot)
                trip = row.pop("stops", None) or [{"at": row["target"], "work": row["work"]}]
                for k, stop in enumerate(trip, 1):
                    row |= {f"stop {k}": stop["at"], f"work {k}": stop["work"]}
                table.writerow([row.get(head, "") for head in heads])
        return parse_scenario({**document, "robots": {"table": name}}, Path(folder))


def has_a_sheet_for_all(scenario: Scenario) -> bool:
    """Return whether a workbook takes the map: it has no sheet for zones and stations."""
    document = dump_scenario(scenario)["map"]
    return not {*document, *document.get("roadmap", ())} & {
        "zones", "stations", "sides", "obstacles", "picture"
    }  # fmt: skip


def fits_into_cells(name: str) -> bool:
    """Return whether a cell of a table holds a name: not one that begins or ends with a blank."""
    return name == name.strip()


@law(with_attributes(), st.sampled_from(["a.yaml", "a.json", "a.xlsx", "a.csv"]))
def test_no_format_loses_an_attribute(scenario: Scenario, name: str) -> None:
    """A format that cannot hold a part of a scenario refuses it; none drops an attribute."""
    if name == "a.xlsx" and not has_a_sheet_for_all(scenario):
        with pytest.raises(InputError, match="a workbook has no place for"):
            reread(scenario, name)
        return
    types = [robot.type for robot in scenario.robots if robot.type is not None]
    if name in {"a.xlsx", "a.csv"} and not all(map(fits_into_cells, types)):
        leave("blanks at the ends of cells")
    assert reread(scenario, name) == scenario


@law(scenarios(), st.sampled_from(["a.yaml", "a.json"]))
def test_scenario_files(scenario: Scenario, name: str) -> None:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, name)
        write_scenario(scenario, path)
        assert load(path) == scenario


@law(plans())
def test_plans(plan: Plan) -> None:
    assert parse_plan(dump_plan(plan, seconds=True)) == plan
    with tempfile.TemporaryDirectory() as folder:
        one, other = Path(folder, "one.json"), Path(folder, "other.json")
        write_plan(plan, one, seconds=True)
        loaded = load_plan(one)
        assert loaded == plan
        write_plan(loaded, other, seconds=True)
        assert one.read_bytes() == other.read_bytes()
