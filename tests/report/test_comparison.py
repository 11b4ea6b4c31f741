"""Plain data on compared plans: figures and differences with their text."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

from rightofway.metrics import compare
from rightofway.model import Closure
from rightofway.report.comparison import describe_change, export_comparison
from rightofway.site import VertexId
from tests.builders.plans import door


def test_figures_have_the_text_of_their_own_scenario() -> None:
    """The second plan has ticks of half a time unit, in which both flowtimes are counted."""
    plan = door()
    first, other = plan.scenario.robots
    faster = replace(plan.scenario, robots=(replace(first, speed=Fraction(2)), other))
    data = export_comparison(compare([plan, replace(plan, scenario=faster)]))
    assert data["scales"] == [2, 1]
    flowtimes = [figures["flowtime"] for figures in data["plans"]]
    assert flowtimes[0] == 2 * flowtimes[1]
    texts = [figures["text"]["flowtime"] for figures in data["plans"]]
    assert texts == [
        ["n_time_units", {"number": "19"}],
        ["n_time_units", {"number": ["figure", {"figure": "9.5"}]}],
    ]


def test_a_change_is_plain_data_with_its_text() -> None:
    plan = door()
    first, other = plan.scenario.robots
    closed = (Closure(edge=(VertexId(0), VertexId(1)), until=Fraction(4)),)
    after = replace(
        plan.scenario, robots=(replace(first, speed=Fraction(2)), other), closures=closed
    )
    _, found = compare([plan, replace(plan, scenario=after)]).changes
    assert list(map(describe_change, found)) == [
        {
            "subject": "R1",
            "robots": ["R1"],
            "jobs": [],
            "key": "speed",
            "before": ["speed", {"value": "1"}],
            "after": ["speed", {"value": "2"}],
            "text": "R1: speed 1 → 2",
        },
        {
            "subject": ["listed edge", {"tail": "N0", "head": "N1"}],
            "robots": [],
            "jobs": [],
            "key": "closed",
            "before": "",
            "after": "",
            "text": "N0 to N1: closed",
        },
    ]
