"""Time limits and interrupts, as scripts meet them."""

import math
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest

import rightofway
from rightofway import search
from rightofway.errors import GaveUp, InputError
from rightofway.metrics import compute_alone_completions
from rightofway.model import Robot, Rules, Scenario, Stop, Tick
from rightofway.planners import Deadline, PlanRequest
from rightofway.planners.priorities import fixed_priority
from rightofway.planners.two_level import two_level
from rightofway.site import VertexId, make_grid_roadmap
from tests.builders.fleets import random_fleet

HARD = Path(__file__).parents[1] / "data" / "hard"

NO_LIMITS = [-5, -0.001, math.nan, -math.inf, "10", True]


@pytest.fixture(scope="module")
def scenario() -> Scenario:
    return random_fleet(1, size=12, robots=10, rules=Rules())


@pytest.mark.parametrize("limit", NO_LIMITS)
def test_a_time_limit_that_is_no_number_of_seconds_is_refused(
    scenario: Scenario, limit: float
) -> None:
    plan = rightofway.solve(scenario, "lacam")
    for call in (
        lambda: rightofway.solve(scenario, time_limit=limit),
        lambda: rightofway.improve(plan, time_limit=limit),
        lambda: rightofway.run_laps(scenario, time_limit=limit),
        lambda: rightofway.simulate(plan, time_limit=limit),
    ):
        with pytest.raises(InputError, match=r"time_limit: .* is no number of seconds \(give"):
            call()


def test_a_deadline_leaves_time_for_what_follows_but_keeps_half() -> None:
    deadline = Deadline.after(100)
    left = [deadline.bring_forward(seconds).measure_seconds_left() for seconds in (10, 80)]
    assert left == [pytest.approx(90, abs=1), pytest.approx(50, abs=1)]


def test_no_limit_has_no_earlier_one() -> None:
    assert Deadline.after(None).bring_forward(10).measure_seconds_left() is None


@pytest.mark.slow
def test_planning_ends_early_enough_for_what_is_done_with_the_plan(crowd: Scenario) -> None:
    """A second for each visit is more than there is, so that half of the limit is left."""
    began = time.monotonic()
    plan = rightofway.solve(crowd, "lns", time_limit=20, seconds_per_visit=1)
    assert plan.run.seconds is not None
    assert plan.run.seconds < 16
    assert time.monotonic() - began < 20


def test_distances_are_not_measured_beyond_the_time_limit(scenario: Scenario) -> None:
    assert search.compute_least_completions(scenario, time_limit=0) is None
    with pytest.raises(GaveUp, match="time ran out while measuring distances"):
        rightofway.solve(scenario, time_limit=0)


def test_routes_are_not_chosen_beyond_the_time_limit(crowd: Scenario) -> None:
    for planner in (two_level, fixed_priority):
        request = PlanRequest(
            scenario=crowd, options={"routes": "clear"}, deadline=Deadline.after(0)
        )
        with pytest.raises(GaveUp, match="time ran out while choosing routes"):
            planner(request)


def test_a_circle_of_one_way_lanes_does_not_keep_a_call_for_ever() -> None:
    """The walk along the circle looked for its first vertex, which no lane leads back to."""
    script = (
        "import sys, rightofway as rw\n"
        "try: print(rw.solve(rw.load(sys.argv[1]), time_limit=0.12, seed=169, iterations=30))\n"
        "except rw.GaveUp as error: print(error)\n"
    )
    call = [sys.executable, "-c", script, str(HARD / "one-way-circle.json")]
    done = subprocess.run(call, capture_output=True, text=True, timeout=30, check=True)
    is_planned = done.stdout.startswith("Plan(")  # a quick machine ends before the limit
    assert is_planned or "(give a longer time limit" in done.stdout


def test_reports_use_what_planning_computed(scenario: Scenario) -> None:
    plan = rightofway.solve(scenario, "lacam")
    assert plan.run.alone == compute_alone_completions(scenario)
    claimed = replace(plan, run=replace(plan.run, alone=tuple(map(Tick, range(10)))))
    assert rightofway.measure(claimed).flowtime_alone == sum(range(10))


def test_infinity_is_no_limit(scenario: Scenario) -> None:
    first = rightofway.solve(scenario, time_limit=math.inf, options={"iterations": 5})
    again = rightofway.solve(scenario, time_limit=None, options={"iterations": 5})
    assert [track.enter.tolist() for track in first.tracks] == [
        track.enter.tolist() for track in again.tracks
    ]


def test_a_queue_of_robots_that_push_each_other_needs_no_deep_stack() -> None:
    """10 000 robots go one cell on; a thread has the stack that threads have on macOS."""
    script = (
        "import threading, rightofway as rw\n"
        "from tests.builders.fleets import grid_fleet\n"
        "ways = [(f'N{k}', f'N{k + 1}') for k in range(10_000)]\n"
        "fleet = grid_fleet(['.' * 10_001], ways, rules=rw.Rules(ends='none'))\n"
        "def run(): print(rw.solve(fleet, 'lacam', time_limit=None).makespan)\n"
        "threading.stack_size(512 * 1024)\n"
        "thread = threading.Thread(target=run)\n"
        "thread.start()\n"
        "thread.join()\n"
    )
    call = [sys.executable, "-c", script]
    done = subprocess.run(call, capture_output=True, text=True, timeout=120, check=True)
    assert done.stdout == "1\n"


@pytest.fixture
def interrupted() -> Iterator[None]:
    """Have this thread interrupted after two seconds, whatever the runner does with interrupts."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    main = threading.main_thread().ident
    assert main is not None
    timer = threading.Timer(2, signal.pthread_kill, (main, signal.SIGINT))
    timer.start()
    yield
    timer.cancel()
    signal.signal(signal.SIGINT, before)


@pytest.fixture(scope="module")
def crowd() -> Scenario:
    """Return a fleet that is improved for longer than any test waits."""
    return random_fleet(1, size=40, robots=200, rules=Rules(occupancy="both"))


@pytest.mark.usefixtures("interrupted")
def test_an_interrupt_of_solve_reaches_the_loop_of_a_script(crowd: Scenario) -> None:
    """Large neighbourhood search has a plan by then, and must not swallow the interrupt."""
    with pytest.raises(KeyboardInterrupt):
        rightofway.solve(crowd, time_limit=60)


@pytest.mark.usefixtures("interrupted")
def test_an_interrupt_hands_out_the_best_plan_where_that_is_asked_for(crowd: Scenario) -> None:
    plan = rightofway.solve(crowd, time_limit=60, keep_best=True)
    assert str(plan.run.status).startswith("interrupted: ")
    assert rightofway.check(plan).ok


def test_the_laps_of_one_robot_alone_do_not_count_as_meetings() -> None:
    """A robot alone visits each vertex of a corridor 100 000 times or more."""
    scenario = corridor(laps=40_000, homes=(0,))
    plan = rightofway.solve(scenario, "two-level", time_limit=None)
    assert rightofway.measure(plan).gap == 0


def test_more_meetings_than_can_be_counted_are_an_input_error() -> None:
    """Two robots pass the vertices between their places 2 x 40 000 times each."""
    with pytest.raises(InputError, match=r"^robots: \d+ pairs .* \(plan fewer laps"):
        rightofway.solve(corridor(laps=40_000, homes=(0, 1)), "two-level", time_limit=None)


def corridor(laps: int, homes: tuple[int, ...]) -> Scenario:
    """Return robots that go to the fourth vertex of a corridor and back home."""
    robots = tuple(
        Robot(name=f"R{home}", home=VertexId(home), stops=(Stop(at=VertexId(3)),)) for home in homes
    )
    roadmap = make_grid_roadmap(["....."])
    return Scenario(roadmap=roadmap, robots=robots, rules=Rules(laps=laps))
