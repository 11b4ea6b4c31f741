"""Maps of squares of several sizes: where they are drawn, and what the page knows of them."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

import rightofway
from rightofway.model import Plan, Robot, Rules, Scenario, Stop
from rightofway.site import VertexId
from rightofway.site.quadtree import build_roadmap_of_squares
from rightofway.viz import make_payload
from rightofway.viz.placement import lay_out_roadmap


@pytest.fixture(name="plan")
def _plan() -> Plan:
    """A square of 1 m at the left, two cells of 0.5 m right of it, a blocked one beside them."""
    free = np.array([[True, True, True, True], [True, True, True, False]])
    roadmap = build_roadmap_of_squares(free, Fraction(1, 2))
    home, target = VertexId(0), VertexId(2)
    robot = Robot(name="R1", home=home, stops=(Stop(at=target, work=Fraction(0)),))
    scenario = Scenario(roadmap=roadmap, robots=(robot,), rules=Rules(turn=Fraction(0)))
    return rightofway.solve(scenario, time_limit=None, options={"iterations": 1})


def test_a_unit_of_the_drawing_is_the_smallest_square(plan: Plan) -> None:
    """The left square reaches from -0.5 to 1.5, so its middle is at (0.5, 0.5)."""
    plane = lay_out_roadmap(plan.scenario.roadmap)
    assert (plane.unit, plane.width, plane.height) == (0.5, 4, 2)
    assert plane.points.tolist() == [[0.5, 0.5], [2, 0], [3, 0], [2, 1]]


def test_the_page_is_given_the_sides_of_squares(plan: Plan) -> None:
    assert dict(make_payload(plan)["map"])["sides"] == [2, 1, 1, 1]
