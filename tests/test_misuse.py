"""What the package exports, called with what does not belong there."""

from __future__ import annotations

import functools
import inspect
import os
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from typing import Any

import networkx as nx  # type: ignore[import-untyped]
import numpy as np
import pytest

import rightofway as rw
from rightofway.planners.registry import PLANNERS

DOOR = rw.load(Path(__file__).parents[1] / "examples/door.yaml")

QUANTITIES = rw.Quantities(units=DOOR.units, tick=Fraction(1))
ENDS = np.array([0, 1], np.int32)
SITE = rw.make_layout_of_graph(nx.DiGraph([((0, 0), (1, 0))]))


@functools.cache
def plan() -> rw.Plan:
    """Return a plan of the door, made when a test asks for it, without a time limit."""
    return rw.solve(DOOR, seed=1, time_limit=None, iterations=5)


STRANGE: list[Any] = [
    None,
    -1,
    True,
    float("nan"),
    -0.5,
    10**30,
    10**400,
    Fraction(1, 3),
    "",
    "a\0b",
    "\ud800",
    b"x",
    [None],
    (None, None),
    {"a": 1},
    {"x"},
    object(),
    np.array([1.5]),
    np.array([-1, 2**40]),
    np.array(["a", "b"]),
    iter(()),
    lambda *_: None,
    os.sep,
    Path(os.sep),
]
"""None, numbers out of range, text, lists, arrays, a mapping, a function, paths of folders."""


def fields_of(value: Any) -> dict[str, Any]:
    names = inspect.signature(type(value)).parameters
    return {name: getattr(value, name) for name in names}


def fleet() -> rw.FleetBuilder:
    return rw.FleetBuilder(grid=["..."])


def lanes() -> rw.FleetBuilder:
    return rw.FleetBuilder().add_vertex("a", 0, 0).add_vertex("b", 1, 0).add_edge("a", "b")


GOOD: dict[str, Callable[[], tuple[Callable[..., Any], dict[str, Any]]]] = {
    "Background": lambda: (rw.Background, {"picture": "a.png"}),
    "Background.of": lambda: (rw.Background.of, {}),
    "FleetBuilder": lambda: (rw.FleetBuilder, {}),
    "FleetBuilder.add_vertex": lambda: (lanes().add_vertex, {"name": "c", "x": 2, "y": 0}),
    "FleetBuilder.add_edge": lambda: (lanes().add_edge, {"tail": "b", "head": "a"}),
    "FleetBuilder.add_zone": lambda: (lanes().add_zone, {"name": "z", "vertices": ["a"]}),
    "FleetBuilder.add_robot": lambda: (fleet().add_robot, {"name": "R", "home": (0, 0)}),
    "FleetBuilder.add_job": lambda: (fleet().add_job, {"name": "J", "at": (0, 1)}),
    "FleetBuilder.add_actions": lambda: (fleet().add_actions, {"place": (0, 1), "work": "scan"}),
    "FleetBuilder.add_battery": lambda: (fleet().add_battery, {"name": "b"}),
    "FleetBuilder.add_charging": lambda: (fleet().add_charging, {"places": [(0, 1)]}),
    "FleetBuilder.add_closure": lambda: (fleet().add_closure, {"at": (0, 1)}),
    "SimulationResult.trace": lambda: (rw.simulate(plan(), runs=1).trace, {}),
    "Plan": lambda: (rw.Plan, fields_of(plan())),
    "Quantities": lambda: (rw.Quantities, {"units": DOOR.units, "tick": Fraction(1)}),
    "Robot": lambda: (rw.Robot, fields_of(DOOR.robots[0])),
    "Rules": lambda: (rw.Rules, {}),
    "Scenario": lambda: (rw.Scenario, fields_of(DOOR)),
    "SteadyState": lambda: (rw.SteadyState, {"robots": (0,), "start": 0, "period": 1}),
    "Stop": lambda: (rw.Stop, {"at": 0}),
    "Track": lambda: (rw.Track, fields_of(plan().tracks[0])),
    "Track.of": lambda: (rw.Track.of, {"vertices": [0, 1], "enter": [0, 1]}),
    "find_best_timetable": lambda: (rw.find_best_timetable, {"scenario": DOOR, "rounds": 0}),
    "check": lambda: (rw.check, {"plan": plan()}),
    "improve": lambda: (rw.improve, {"plan": plan(), "time_limit": 0.01}),
    "Layout.get_level": lambda: (SITE.get_level, {}),
    "LostTime.as_dict": lambda: (plan().lost_time[0].as_dict, {}),
    "Objective.compute_cost": lambda: (
        rw.Objective.FLOWTIME.compute_cost,
        {"scenario": DOOR, "tracks": plan().tracks},
    ),
    "Plan.__getitem__": lambda: (plan().__getitem__, {"name": "R1"}),
    "Plan.compute_value": lambda: (
        plan().compute_value,
        {"objective": rw.Objective.MAKESPAN},
    ),
    "Plan.compute_once": lambda: (plan().compute_once, {"figure": "of a test", "compute": list}),
    "Plan.to_dataframe": lambda: (plan().to_dataframe, {"library": "pandas"}),
    "Quantities.of": lambda: (rw.Quantities.of, {"scenario": DOOR}),
    "Quantities.format_cell": lambda: (QUANTITIES.format_cell, {"ticks": 1}),
    "Quantities.format_duration": lambda: (QUANTITIES.format_duration, {"ticks": 1}),
    "Quantities.format_length": lambda: (QUANTITIES.format_length, {"value": 1}),
    "Quantities.format_moment": lambda: (QUANTITIES.format_moment, {"ticks": 1}),
    "Quantities.format_speed": lambda: (QUANTITIES.format_speed, {"value": 1}),
    "Quantities.format_point": lambda: (QUANTITIES.format_point, {"ticks": 1}),
    "Quantities.format_heading": lambda: (QUANTITIES.format_heading, {"words": "time"}),
    "Roadmap.find_edge": lambda: (DOOR.roadmap.find_edge, {"tail": 0, "head": 1}),
    "Roadmap.get_edge_class": lambda: (DOOR.roadmap.get_edge_class, {"edge": 0}),
    "Roadmap.is_along_one_lane": lambda: (DOOR.roadmap.is_along_one_lane, {"vertices": (0, 1)}),
    "Roadmap.find_ways_along": lambda: (DOOR.roadmap.find_ways_along, {"ends": (0, 1)}),
    "Roadmap.find_edges": lambda: (DOOR.roadmap.find_edges, {"tails": ENDS[:1], "heads": ENDS[1:]}),
    "Roadmap.get_drawn": lambda: (DOOR.roadmap.get_drawn, {"vertex": 0}),
    "Roadmap.is_drawn": lambda: (DOOR.roadmap.is_drawn, {"tail": 0, "head": 1}),
    "Roadmap.is_passed": lambda: (DOOR.roadmap.is_passed, {"vertex": 0}),
    "Roadmap.list_edges": lambda: (DOOR.roadmap.list_edges, {"tail": 0, "head": 1}),
    "Roadmap.list_pieces": lambda: (DOOR.roadmap.list_pieces, {"ends": (0, 1)}),
    "Roadmap.unfold_route": lambda: (DOOR.roadmap.unfold_route, {"vertices": [0, 1]}),
    "Roadmap.name": lambda: (DOOR.roadmap.name, {"vertex": 0}),
    "Roadmap.get_point": lambda: (DOOR.roadmap.get_point, {"vertex": 0}),
    "Roadmap.get_vertex": lambda: (DOOR.roadmap.get_vertex, {"name": "N0"}),
    "Roadmap.get_place": lambda: (DOOR.roadmap.get_place, {"name": "N0"}),
    "Roadmap.get_position": lambda: (DOOR.roadmap.get_position, {"vertex": 0}),
    "Roadmap.exclude": lambda: (DOOR.roadmap.exclude, {"closed": {1}, "edges": [(0, 1)]}),
    "make_layout_of_graph": lambda: (rw.make_layout_of_graph, {}),
    "load": lambda: (rw.load, {"path": "fleet.yaml"}),
    "load_plan": lambda: (rw.load_plan, {"path": "plan.json"}),
    "compute_lost_time": lambda: (rw.compute_lost_time, {}),
    "measure": lambda: (rw.measure, {}),
    "plan_of_laps": lambda: (rw.plan_of_laps, {"result": rw.run_laps(DOOR)}),
    "plan_of_paths": lambda: (rw.plan_of_paths, {"scenario": DOOR, "paths": {}}),
    "run_laps": lambda: (rw.run_laps, {"scenario": DOOR}),
    "simulate": lambda: (rw.simulate, {"plan": plan(), "runs": 1}),
    "solve": lambda: (rw.solve, {"scenario": DOOR, "time_limit": 0.01}),
    "waits": lambda: (rw.waits, {}),
    "write_gif": lambda: (
        rw.write_gif,
        {"plan": plan(), "path": os.sep, "max_frames": 2, "scale": 2},
    ),
    "write_page": lambda: (rw.write_page, {"plan": plan(), "path": os.sep}),
    "write_plan": lambda: (rw.write_plan, {"plan": plan(), "path": os.sep}),
    "write_png": lambda: (rw.write_png, {"plan": plan(), "path": os.sep, "scale": 2}),
    "write_scenario": lambda: (rw.write_scenario, {"scenario": DOOR, "path": os.sep}),
}
"""What callers call: how it is reached, and arguments that fit or are refused."""

OPTIONS: dict[str, Callable[[], tuple[Callable[..., Any], dict[str, Any]]]] = {
    spec.options_type.__name__: functools.partial(lambda owner: (owner, {}), spec.options_type)
    for spec in PLANNERS
}
"""The options of each planner."""

TRIED = GOOD | OPTIONS

RESULTS = (
    {
        "CyclicResult",
        "Decision",
        "ExecutionTrace",
        "Fact",
        "Fault",
        "Film",
        "Layout",
        "Loss",
        "LostTime",
    }
    | {
        "LostTime",
        "Metrics",
        "SimulationResult",
        "Objective",
        "Outcome",
        "OutcomeKind",
        "PlannerOptions",
        "PlannerRun",
        "Report",
        "Reroute",
        "Roadmap",
    }
    | {"RobotPlan", "Theme", "Wait", "GaveUp", "InputError", "InvalidPlan", "NoPlanExists"}
    | {"RightOfWayError", "SimulationResult"}
)
"""What the package makes and callers only read: its constructors check nothing."""


OF_THE_PACKAGE = {
    "Fact.bind",
    "Fact.detach",
    "InputError.at",
    "Objective.compute_values",
    "Roadmap.get_original",
    "Roadmap.list_copies",
    "Roadmap.list_place",
    "Roadmap.list_whole_edges",
}
"""Methods that only the package calls."""


def test_every_export_is_either_tried_or_made_by_the_package() -> None:
    assert set(rw.__all__) == RESULTS | {name for name in GOOD if "." not in name}


def methods() -> set[str]:
    """Return the methods that exported classes add and that take arguments."""
    return {
        f"{name}.{method}"
        for name in rw.__all__
        if inspect.isclass(cls := getattr(rw, name))
        for method in vars(cls)
        if not method.startswith("_") or method == "__getitem__"
        if inspect.isroutine(inspect.unwrap(call := getattr(cls, method)))
        if set(inspect.signature(call).parameters) - {"self"}
    }


def test_every_method_of_an_export_is_tried() -> None:
    assert methods() == OF_THE_PACKAGE | {name for name in GOOD if "." in name}


@pytest.mark.parametrize("name", TRIED)
def test_an_argument_of_another_kind_is_accepted_or_refused_with_a_reason(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    for argument, parameter in inspect.signature(TRIED[name]()[0]).parameters.items():
        call, good = TRIED[name]()
        for strange in STRANGE if parameter.kind is not parameter.VAR_KEYWORD else ():
            try:
                call(**good | {argument: strange})
            except rw.RightOfWayError as refusal:
                message = str(refusal)
                assert message.strip(), (argument, strange)
                assert "truth value" not in message  # NumPy's words on an array that is compared


CALLBACKS: dict[str, Callable[[Callable[..., Any]], Any]] = {
    "find_best_timetable": lambda call: rw.find_best_timetable(DOOR, rounds=1, report=call),
    "improve": lambda call: rw.improve(plan(), time_limit=None, on_plan=call, iterations=5),
    "run_laps": lambda call: rw.run_laps(DOOR, report=call),
    "simulate": lambda call: rw.simulate(plan(), runs=2, report=call),
    "solve": lambda call: rw.solve(DOOR, time_limit=None, on_plan=call, iterations=5),
}


@pytest.mark.parametrize("name", CALLBACKS)
def test_an_error_of_a_function_that_the_caller_gave_reaches_the_caller(name: str) -> None:
    def fails(*_: object) -> None:
        raise KeyError("of the caller")

    with pytest.raises(KeyError, match="of the caller"):
        CALLBACKS[name](fails)
