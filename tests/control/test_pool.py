"""Jobs that arrive, change and are withdrawn while robots drive, planned in rounds."""

from __future__ import annotations

import json
import random
from fractions import Fraction
from typing import Any

import pytest

import rightofway
from rightofway.control import FleetControl
from rightofway.control.commands import read_duration
from rightofway.control.dispatcher import Dispatcher
from rightofway.control.driven_ends import list_driven_jobs
from rightofway.control.journal import Entry
from rightofway.control.laps import LapsToDrive
from rightofway.control.ledger import Ledger
from rightofway.control.messages import LOOK_AHEAD
from rightofway.control.round_worker import RoundRequest, RoundsAtOnce
from rightofway.control.work_items import find_stop
from rightofway.dispatch import Round
from rightofway.errors import GaveUp, InputError
from rightofway.execution.drive_result import DrivenEnd, measure_punctuality
from rightofway.facts import Fact
from rightofway.io import parse_scenario
from rightofway.model import Plan, Tick
from tests.builders.chaos import MemoryJournal
from tests.builders.floor_jobs import floor_document, floor_plan
from tests.builders.floors import Floor


class Shift:
    """The robots of a plan with jobs, a second after another, and people who ask for more."""

    def __init__(
        self,
        plan: Plan | None = None,
        rounds: RoundsAtOnce | None = None,
        look_ahead: int = LOOK_AHEAD,
    ) -> None:
        self.plan, self.now = plan or floor_plan(), 0
        self.journal, self.said = MemoryJournal(), list[str]()
        roadmap = self.plan.scenario.roadmap
        control = FleetControl(self.journal, look_ahead=look_ahead, roadmap=roadmap)
        self.dispatcher = Dispatcher(control, self.plan, rounds=rounds or RoundsAtOnce(None))
        self.dispatcher.keep_time(lambda: self.now)
        assert self.dispatcher.rounds is not None
        self.rounds = self.dispatcher.rounds
        self.rounds.tell = lambda fact: self.said.append(str(fact))
        self.dispatcher.report = lambda fact, _: self.said.append(str(fact))
        self.dispatcher.begin("run")
        self.floor = Floor(self.dispatcher)

    @property
    def pool(self) -> Any:
        return self.dispatcher.ledger.pool

    def ask(self, kind: str, **values: Any) -> dict[str, Any]:
        """Carry out a command; return the answer."""
        messages, answer = self.floor.operator._run_command({"kind": kind, **values})
        self.floor.send(messages)
        return dict(answer)

    def drive(self, seconds: int) -> None:
        """Have robots drive."""
        for _ in range(seconds):
            self.now += 1
            self.floor.drive(1)
            self.floor.send(self.dispatcher.follow_time())

    def list_done(self) -> list[str]:
        """Return the finished stops in their order."""
        return [
            entry["job"]
            for entry in self.journal.written
            if entry["kind"] == "finished" and find_stop(entry["job"])
        ]

    def list_ends(self) -> tuple[DrivenEnd, ...]:
        """Return the planned, actual and expected ends of jobs."""
        scenario = self.plan.scenario
        return list_driven_jobs(self.dispatcher.ledger, scenario, Tick(self.now))

    def list_jobs(self) -> dict[str, str]:
        return {job["name"]: job["state"] for job in self.ask("list")["jobs"]}


def test_jobs_that_arrive_are_done_each_stop_once_and_in_order() -> None:
    shift = Shift()
    shift.drive(3)
    shift.ask("add", name="A1", pickup="N14", dropoff="N0", due="10")
    shift.drive(5)
    shift.ask("add", name="A2", stops=[{"at": "N2", "work": 2}, {"at": "N10"}], after=["A1"])
    shift.drive(120)
    assert dict.fromkeys(shift.pool.left.values()) == {"done": None}
    done = shift.list_done()
    assert sorted(done) == ["A1/0", "A1/1", "A2/0", "A2/1", "J1/0", "J1/1", "J2/0", "J3/0", "J3/1"]
    for first, later in (("A1/0", "A1/1"), ("A1/1", "A2/0"), ("A2/0", "A2/1"), ("J1/1", "J2/0")):
        assert done.index(first) < done.index(later)


def test_the_planned_end_of_a_job_that_is_added_is_that_of_its_first_round() -> None:
    """A1 is behind the next stops of its robot: only a later round plans times for it."""
    shift = Shift()

    def find_end() -> DrivenEnd:
        return {end.name: end for end in shift.list_ends()}["A1"]

    assert all(end.planned == end.expected for end in shift.list_ends())
    shift.drive(3)
    shift.ask("add", name="A1", pickup="N14", dropoff="N0", due="100")
    assert (find_end().planned, find_end().end) == (None, None)
    while find_end().planned is None:
        shift.drive(1)
    first = find_end()
    assert first.planned is not None
    assert first.expected == first.planned > shift.now
    assert (first.ended, first.due, first.delay) == (None, 103, 0)
    shift.drive(120)
    last = find_end()
    assert last.planned == first.planned
    assert last.delay == (last.ended or 0) - first.planned
    assert all(end.delay is not None for end in shift.list_ends())
    measured = measure_punctuality(shift.list_ends())
    assert (measured.done, measured.open) == (4, 0)


def test_jobs_of_a_robot_that_is_overdue_are_expected_later() -> None:
    """R1 is on hold from the begin: its jobs end later with each second."""
    shift = Shift()
    shift.ask("hold", name="R1")
    shift.drive(70)
    held = [end for end in shift.list_ends() if end.robot == 0 and end.ended is None]
    assert held
    assert all((end.expected or 0) >= 70 for end in held)
    assert all(end.is_late for end in held)


def test_waits_are_counted_over_snapshots_of_the_journal() -> None:
    ledger = Shift().dispatcher.ledger
    ledger.robots[1].waits = 3
    again = Ledger(floor_plan().scenario.roadmap)
    again.apply(json.loads(json.dumps(ledger.make_snapshot())))
    assert [own.waits for own in again.robots] == [0, 3]


def test_a_job_of_a_known_name_is_added_once() -> None:
    shift = Shift()
    first = shift.ask("add", name="A1", at="N2")
    again = shift.ask("add", name="A1", at="N12")
    assert (first["fact"]["kind"], again["fact"]["kind"]) == ("job known", "job known already")
    shift.drive(80)
    assert shift.list_done().count("A1/0") == 1
    assert shift.ask("add", name="A1", at="N12")["fact"]["kind"] == "job known already"
    shift.drive(40)
    assert shift.list_done().count("A1/0") == 1


def test_jobs_without_a_name_get_names_of_their_own() -> None:
    shift = Shift()
    names = [shift.ask("add", at="N2")["name"] for _ in range(3)]
    assert len({*names}) == 3
    assert {*names} <= shift.pool.jobs.keys()


def test_a_job_that_is_withdrawn_is_not_done_and_one_that_is_begun_cannot_be() -> None:
    shift = Shift()
    shift.ask("add", name="A1", at="N2", earliest=30)
    shift.drive(2)
    shift.ask("withdraw", name="A1")
    assert shift.ask("withdraw", name="A1")["done"]
    with pytest.raises(InputError, match="'A1' is withdrawn already"):
        shift.ask("change", name="A1", at="N2")
    shift.drive(15)  # J1 begins at 12
    assert shift.list_jobs()["J1"] == "begun"
    with pytest.raises(InputError, match="'J1' is begun already"):
        shift.ask("withdraw", name="J1")
    shift.drive(80)
    assert "A1/0" not in shift.list_done()
    assert shift.pool.left["A1"] == "withdrawn"
    with pytest.raises(InputError, match="'J1' is done already"):
        shift.ask("change", name="J1", at="N2")


def test_a_job_that_has_changed_is_done_where_it_is_now() -> None:
    shift = Shift()
    shift.ask("add", name="A1", at="N2", work=1, earliest=20)
    shift.drive(2)
    shift.ask("change", name="A1", at="N12")
    assert shift.pool.jobs["A1"].job.stops[0].work == 0
    assert shift.pool.jobs["A1"].job.earliest == 20
    shift.drive(100)
    orders = [entry for entry in shift.journal.written if entry["kind"] == "order"]
    places = {
        node["place"]
        for entry in orders
        for node in entry["order"]["nodes"]
        for action in node["actions"]
        if "-A1/0-" in action
    }
    assert places == {"N12"}


def test_a_change_to_nothing_removes_a_key_and_the_others_stay() -> None:
    shift = Shift()
    shift.ask("add", name="A1", at="N2", earliest=20, due=30, latest=40)
    shift.ask("change", name="A1", latest=None, due=35)
    job = shift.pool.jobs["A1"].job
    assert (job.earliest, job.due, job.stops[-1].latest) == (20, 35, None)


def test_an_urgent_job_is_begun_before_others_that_are_not_due() -> None:
    """R1 drives six edges to N14, of which at most four are released to it."""
    shift = Shift()
    shift.ask("add", name="A1", pickup="N14", dropoff="N10", load=2, robot="R1")
    shift.ask("add", name="A2", pickup="N12", dropoff="N2", robot="R1", urgent=True)
    shift.drive(120)
    done = shift.list_done()
    assert done.index("A2/0") < done.index("A1/0")


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"at": "N99"}, "N99"),
        ({"at": "N2", "robot": "R9"}, "'R9' is no robot"),
        ({"at": "N2", "after": ["X"]}, "'X' is no other job"),
        ({"at": "N2", "due": "soon"}, "'soon' is no duration"),
        ({"at": "N2", "due": "5min"}, "has a unit, and the times of the plan have none"),
        ({"pickup": "N2"}, "has no dropoff"),
        ({"at": "N2", "colour": "red"}, "colour"),
    ],
)
def test_a_job_with_faults_is_refused_and_changes_nothing(
    given: dict[str, Any], message: str
) -> None:
    shift = Shift()
    with pytest.raises(InputError) as caught:
        shift.ask("add", name="A1", **given)
    assert message in str(caught.value)
    assert "A1" not in shift.pool.jobs


@pytest.mark.parametrize(
    ("text", "time"), [("90", 90), ("1/2", Fraction(1, 2)), ("15min", 900), ("2 h", 7200), (3, 3)]
)
def test_durations_have_units_where_the_plan_has_one(text: object, time: Fraction) -> None:
    assert read_duration(text, Fraction(1)) == time


def test_a_job_that_no_robot_can_do_is_reported_once() -> None:
    shift = Shift()
    shift.ask("add", name="A1", pickup="N2", dropoff="N0", load=5)
    shift.drive(30)
    assert [line for line in shift.said if "A1" in line] == [
        "A1 is not served: no robot may do it and can carry it"
    ]
    assert shift.list_jobs()["A1"] == "waiting"


class SlowRounds(RoundsAtOnce):
    """Rounds whose plans come only when they are asked for."""

    def __init__(self) -> None:
        super().__init__(None)
        self.is_ready = False
        self.requests = list[RoundRequest]()

    def begin(self, request: RoundRequest) -> None:
        self.requests.append(request)
        super().begin(request)

    def poll(self) -> Round | None:
        return super().poll() if self.is_ready else None


def test_nothing_beyond_the_kept_parts_is_released_while_a_round_is_under_way() -> None:
    rounds = SlowRounds()
    shift = Shift(rounds=rounds)
    shift.drive(2)
    shift.ask("add", name="A1", pickup="N12", dropoff="N0")
    kept_parts = shift.dispatcher.control.kept_parts
    assert kept_parts is not None
    begun = {name for name, own in shift.pool.jobs.items() if own.is_begun}
    shift.drive(30)
    robots = shift.dispatcher.ledger.robots
    assert all(own.released <= last for own, last in zip(robots, kept_parts, strict=True))
    assert {name for name, own in shift.pool.jobs.items() if own.is_begun} == begun
    assert len(rounds.requests) == 1
    rounds.is_ready = True
    shift.drive(120)
    assert dict.fromkeys(shift.pool.left.values()) == {"done": None}
    assert len(shift.pool.left) == 4


class NoRounds(RoundsAtOnce):
    """Rounds that find nothing."""

    def begin(self, request: RoundRequest) -> None:
        assert request.view.robots
        fact = Fact("old plan stands", reason=Fact("robots would rotate"))
        self._planned = [Round(tracks=(), steps=(), stands=True, facts=(fact,))]


def test_the_old_plan_goes_on_where_a_round_finds_none_and_this_is_reported_once() -> None:
    shift = Shift(rounds=NoRounds(None))
    shift.drive(2)
    shift.ask("add", name="A1", pickup="N12", dropoff="N0")
    shift.drive(100)
    assert sorted(shift.pool.left) == ["J1", "J2", "J3"]
    assert len([line for line in shift.said if line.startswith("the old plan stands")]) == 1


def test_a_job_withdrawn_during_a_round_is_not_done_by_its_plan() -> None:
    rounds = SlowRounds()
    shift = Shift(rounds=rounds)
    shift.ask("add", name="A1", at="N12")
    shift.ask("withdraw", name="A1")
    rounds.is_ready = True
    shift.drive(120)
    assert "A1/0" not in shift.list_done()
    assert len(shift.pool.left) == 4


def test_a_round_begins_with_the_old_tracks_at_the_times_that_are_expected() -> None:
    """Robots take two seconds for an edge: R1 is at N5 at 2, and at N10 at 3, if it drives on.

    There J1 begins at 12 and ends at 15; then its way home leads over six edges.
    """
    rounds = SlowRounds()
    shift = Shift(rounds=rounds)
    shift.drive(2)
    shift.ask("add", name="A1", pickup="N12", dropoff="N0")
    view = rounds.requests[0].view.robots[0]
    name = shift.plan.scenario.roadmap.name
    assert view.free == 1
    assert view.track is not None
    places = [name(vertex) for vertex in view.track.vertices.tolist()]
    assert places == ["N10", "N11", "N12", "N7", "N2", "N1", "N0"]
    assert view.track.enter.tolist() == [0, 14, 15, 16, 17, 18, 19]
    steps = [(step.visit, step.job, step.stop) for step in view.steps]
    assert steps == [(0, "J1", 0), (4, "J1", 1)]


def test_rounds_plan_routes_for_the_next_two_stops_of_long_tours() -> None:
    """As in shifts: the other stops are in the tour, and a later round plans their routes."""
    shift = Shift()
    shift.drive(60)
    names = ["A1", "A2", "A3", "A4"]
    for name, place in zip(names, ["N2", "N12", "N5", "N14"], strict=True):
        shift.ask("add", name=name, at=place, robot="R1")
    ahead = [item for item in shift.dispatcher.ledger.robots[0].route.all_jobs if find_stop(item)]
    assert len(ahead) == 2
    jobs = shift.ask("list")["jobs"]
    assert [(job["name"], job["state"], job["robot"]) for job in jobs] == [
        (name, "planned", "R1") for name in names
    ]
    assert not shift.rounds.watch.list_waiting()
    shift.drive(60)
    assert {name: shift.pool.left.get(name) for name in names} == dict.fromkeys(names, "done")
    assert shift.dispatcher.control.is_done
    assert shift.rounds.is_over


@pytest.mark.parametrize("places_robot", [False, True])
def test_a_job_behind_the_horizon_that_changes_during_a_round_is_planned_anew(
    *, places_robot: bool
) -> None:
    """The plan of the round has a second stop of it, which the job has no more."""
    rounds = SlowRounds()
    rounds.is_ready = True
    shift = Shift(rounds=rounds)
    shift.drive(60)
    for name, place in zip(("A1", "A2", "A3"), ("N2", "N12", "N5"), strict=True):
        shift.ask("add", name=name, at=place, robot="R1")
    shift.ask("add", name="A4", pickup="N14", dropoff="N10", robot="R1")
    assert ("A4", 1) in shift.rounds.watch.later[0]
    rounds.is_ready = False
    shift.ask("add", name="A5", at="N4")
    shift.ask("change", name="A4", at="N14")
    if places_robot:
        shift.ask("remove", name="R2")
        shift.ask("place", name="R2", at="N4")
    rounds.is_ready = True
    shift.drive(200)
    assert shift.list_done().count("A4/0") == 1
    assert not shift.pool.jobs


def test_a_robot_taken_off_the_floor_is_placed_again_and_ends_its_job() -> None:
    shift = Shift()
    shift.drive(18)
    assert shift.list_jobs()["J1"] == "begun"
    shift.ask("remove", name="R1")
    shift.drive(10)
    shift.floor.robots[0].forget()
    shift.floor.robots[0].place = "N5"
    shift.ask("place", name="R1", at="N5")
    shift.drive(150)
    assert shift.pool.left == dict.fromkeys(("J3", "J1", "J2"), "done")


def test_what_is_killed_at_any_entry_goes_on_with_the_same_jobs() -> None:
    """A start on each prefix of the journal knows the pool of that prefix, and ends the jobs."""
    shift = Shift()
    shift.drive(4)
    shift.ask("add", name="A1", pickup="N12", dropoff="N0")
    shift.drive(20)
    entries: list[Entry] = [json.loads(json.dumps(entry)) for entry in shift.journal.written]
    roadmap = shift.plan.scenario.roadmap
    for end in range(1, len(entries), 5):
        journal = MemoryJournal()
        journal.written = entries[:end]
        ledger = FleetControl(journal, roadmap=roadmap).ledger
        known = [entry["job"]["name"] for entry in entries[:end] if entry["kind"] == "job known"]
        assert {*ledger.pool.jobs, *ledger.pool.left} == {*known}


def test_a_battery_that_will_not_last_begins_a_round_once_for_each_plan() -> None:
    """R1 drives at least four lengths of 5.25 % for J1, and keeps 10 % in reserve."""
    shift = Shift()
    wanted = []
    for charge in (1.0, 0.2, 0.19):
        shift.dispatcher.control.charges[0] = charge
        for _ in range(10):  # of which one forecasts
            shift.rounds.look()
        kinds = {reason.kind for reason in shift.rounds.watch.reasons}
        wanted.append("below reserve ahead" in kinds)
        shift.floor.send(shift.rounds.go_on())
    assert wanted == [False, True, False]


def test_a_robot_before_a_closed_place_is_led_around_it() -> None:
    """R1 is at N0 with parts released to N1 on the way N1, N2, N3; N2 is closed then."""
    document = {
        "format": "rightofway-scenario/1",
        "map": {"grid": ["....", ".@@.", "...."]},
        "rules": {"rotations": False, "turn": 0},
        "robots": [{"name": "R1", "home": "N0"}],
        "jobs": [{"name": "J1", "at": "N3", "earliest": 9}],
    }
    plan = rightofway.solve(parse_scenario(document), "prioritized")
    shift = Shift(plan, look_ahead=1)
    (own,) = shift.dispatcher.ledger.robots
    assert own.route.stretch(0, own.released + 3) == ("N0", "N1", "N2", "N3")
    shift.ask("close", name="N2")
    shift.drive(40)
    assert shift.list_done() == ["J1/0"]


def test_rounds_begin_by_the_triggers_of_simulated_shifts() -> None:
    """Robots stand still; then a place closes; then a job arrives."""
    rounds = SlowRounds()
    rounds.is_ready = True
    shift = Shift(rounds=rounds)
    kinds = list[str]()

    def look(seconds: int) -> None:
        for _ in range(seconds):
            shift.now += 1
            shift.rounds.look()
            kinds.extend(fact.kind for fact in shift.rounds.watch.reasons)
            shift.floor.send(shift.rounds.go_on())

    look(9)
    assert not kinds
    assert not rounds.requests
    look(40)
    assert "fallen behind" in kinds
    assert len(rounds.requests) <= 4
    kinds.clear()
    shift.dispatcher.ledger.closed["N7",] = (("N2", "N7"), ("N7", "N2"))
    look(1)
    assert "closures change" in kinds
    kinds.clear()
    event = {"kind": "job known", "at": shift.now, "name": "A1", "job": {"name": "A1", "at": "N2"}}
    shift.dispatcher.control.commit(event)
    look(1)
    assert "jobs became known" in kinds


def test_rounds_for_which_only_time_is_a_reason_become_rare() -> None:
    """Robots stand still, and a job that nobody can carry waits: pauses double from 16 looks on.

    The first forecast after the begin is that of the tenth look.
    """
    rounds = SlowRounds()
    rounds.is_ready = True
    shift = Shift(rounds=rounds)
    shift.ask("add", name="A1", pickup="N2", dropoff="N0", load=5)
    begins = list[int]()
    for _ in range(190):
        before = len(rounds.requests)
        shift.now += 1
        shift.rounds.look()
        shift.floor.send(shift.rounds.go_on())
        begins += [shift.now] * (len(rounds.requests) - before)
    assert begins == [10, 26, 58, 122]


def plan_with_passed_vertices() -> Plan:
    """Return a plan of R1 at a, which drives through p and q to a job at b, and R2 at e."""
    fleet = rightofway.FleetBuilder(turn=0)
    points = {"a": (0, 0), "p": (1, 0), "q": (2, 0), "b": (3, 0), "c": (3, 1), "d": (0, 1)}
    for name, (x, y) in {**points, "e": (4, 0)}.items():
        fleet.add_vertex(name, x=x, y=y, is_passed=name in {"p", "q"})
    for ends in ("ap", "pq", "qb", "bc", "cd", "da", "be"):
        fleet.add_edge(*ends)
    fleet.add_robot("R1", home="a", turn_rate=90)
    fleet.add_robot("R2", home="e", turn_rate=90)
    fleet.add_job("J1", at="b", robot="R1")
    return rightofway.solve(fleet.build_scenario(), "prioritized")


@pytest.mark.parametrize("seed", range(3))
def test_rounds_plan_behind_vertices_that_robots_only_pass(seed: int) -> None:
    """A kept part ends where its robot may stop; of a chain that it is on it keeps all."""
    shift = Shift(plan_with_passed_vertices())
    draw = random.Random(seed)  # noqa: S311
    for number in range(12):
        shift.drive(draw.randint(1, 5))
        shift.ask("add", name=f"A{number}", at=draw.choice("abcde"))
    shift.drive(200)
    assert dict.fromkeys(shift.pool.left.values()) == {"done": None}
    assert len(shift.pool.left) == 13


def test_a_robot_is_placed_while_another_one_is_at_a_vertex_that_it_only_passes() -> None:
    shift = Shift(plan_with_passed_vertices())
    robots = shift.dispatcher.ledger.robots
    shift.ask("remove", name="R2")
    while robots[0].route.get_place(robots[0].arrived) != "q":
        shift.drive(1)
    shift.floor.robots[1].forget()
    shift.floor.robots[1].place = "c"
    shift.ask("place", name="R2", at="c")
    shift.drive(40)
    assert shift.pool.left == {"J1": "done"}
    assert [robot.place for robot in shift.floor.robots] == ["a", "e"]


@pytest.mark.parametrize("place", ["p", "q"])
def test_a_robot_whose_order_ends_at_a_vertex_that_it_only_passes_drives_on(place: str) -> None:
    """R1 keeps its way to b, which is closed meanwhile: no other robot is put there."""
    shift = Shift(plan_with_passed_vertices())
    own = shift.dispatcher.ledger.robots[0]
    while own.route.get_place(own.arrived) != place:
        shift.drive(1)
    shift.ask("close", name="b")
    shift.ask("cancel", name="R1")
    assert own.route.get_place(own.released) == place
    shift.ask("add", name="A1", at="c")
    shift.ask("remove", name="R2")
    shift.floor.robots[1].forget()
    with pytest.raises(GaveUp, match="R1"):
        shift.ask("place", name="R2", at="b")
    shift.ask("place", name="R2", at="e")
    shift.drive(20)
    assert own.route.get_place(own.released) == place
    shift.ask("open", name="b")
    shift.drive(60)
    assert shift.pool.left == {"J1": "done", "A1": "done"}


def test_a_plan_with_jobs_is_not_repeated_in_laps() -> None:
    with pytest.raises(InputError, match="jobs are done once"):
        LapsToDrive(floor_plan())


def test_a_start_begins_the_round_that_a_kill_has_ended() -> None:
    """A job that has changed may not begin before it is planned again."""
    shift = Shift(rounds=SlowRounds())
    shift.drive(2)
    shift.ask("change", name="J2", at="N12")
    assert shift.dispatcher.ledger.outdated == {"J2"}
    control = FleetControl(shift.journal, roadmap=shift.plan.scenario.roadmap)
    dispatcher = Dispatcher(control, shift.plan, rounds=RoundsAtOnce(None))
    dispatcher.keep_time(lambda: 3)
    places = [robot.place for robot in shift.floor.robots]
    Floor(dispatcher, places)
    assert dispatcher.ledger.outdated == set()


def test_a_robot_is_placed_while_a_round_is_under_way_whose_plan_is_dropped() -> None:
    rounds = SlowRounds()
    shift = Shift(rounds=rounds)
    shift.drive(2)
    shift.ask("add", name="A1", at="N12")
    shift.ask("remove", name="R1")
    shift.floor.robots[0].forget()
    shift.floor.robots[0].place = "N0"
    shift.ask("place", name="R1", at="N0")
    assert shift.dispatcher.control.kept_parts is None
    rounds.is_ready = True
    shift.drive(150)
    assert shift.pool.left == dict.fromkeys(("A1", "J1", "J2", "J3"), "done")


def test_a_job_that_has_changed_before_a_robot_is_placed_is_done_as_it_is_now() -> None:
    """R1 waits at N0 for two stops there; then the job has one, at N2."""
    document = floor_document()
    stops = [{"at": "N0", "earliest": 30}, {"at": "N0"}]
    document["jobs"] = [{"name": "J1", "stops": stops, "robot": "R1"}]
    rounds = SlowRounds()
    shift = Shift(rightofway.solve(parse_scenario(document), "prioritized"), rounds=rounds)
    shift.drive(2)
    shift.ask("change", name="J1", stops=[{"at": "N2"}])
    shift.ask("remove", name="R2")
    shift.floor.robots[1].forget()
    shift.ask("place", name="R2", at="N4")
    rounds.is_ready = True
    shift.drive(60)
    assert shift.list_done() == ["J1/0"]
    assert shift.pool.left == {"J1": "done"}


def test_times_of_day_of_jobs_are_the_next_ones() -> None:
    document = {**floor_document(), "start": "2026-11-28T06:00"}
    shift = Shift(rightofway.solve(parse_scenario(document), "prioritized"))
    shift.ask("add", name="J8", at="N12", due="10:30")
    assert shift.pool.jobs["J8"].job.due == 16200
    shift.now = 20_000  # 11:33:20
    shift.ask("add", name="J9", at="N12", due="10:30", latest="2026-11-29T06:00")
    job = shift.pool.jobs["J9"].job
    assert [job.due, job.stops[0].latest] == [86400 + 16200, 86400]
    with pytest.raises(InputError, match=r"due: '2026-11-28T05:00' is before the start"):
        shift.ask("add", name="J10", at="N12", due="2026-11-28T05:00")


def test_a_time_of_day_of_a_job_needs_a_start() -> None:
    with pytest.raises(InputError, match=r"due: '10:30' needs the start of the scenario"):
        Shift().ask("add", name="J9", at="N12", due="10:30")


def test_a_job_in_a_wall_is_refused() -> None:
    with pytest.raises(InputError, match=r"at: N8, .* is blocked by a wall"):
        Shift().ask("add", name="J9", at="N8")
