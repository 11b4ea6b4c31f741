"""Plans for programs on the site: events as CSV, paths for Nav2, trajectories for Open-RMF.

All are in metres, seconds and radians, in the frame of the site. A robot stays at a vertex until it
drives to the next one straight and at one speed, so a visit gives two poses: when the robot arrives
and when it drives on; one where both are at the same instant.

References
----------
ROS 2, *nav_msgs/Path* and *nav2_msgs/action/FollowWaypoints*. Open-RMF, *rmf_traffic_msgs/Route*:
waypoints of a trajectory have a time, a position (x, y, yaw) and a velocity.
"""

from __future__ import annotations

import csv
import io
import math
from collections import defaultdict
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from rightofway.io.json_text import format_json_line
from rightofway.io.orders.writing import write_orders
from rightofway.kinds.table import make_words
from rightofway.metrics.events import Event, list_events
from rightofway.model import Plan, PlannedItem, Stays, Track
from rightofway.site import VertexId

FRAME = "map"
"""The frame of a site in ROS."""

LEVEL = "L1"
"""The level of a site in Open-RMF, as navigation graphs of one level are written."""

DECIMALS = 6
"""Coordinates are written to a micrometre, times to a microsecond, angles to a microradian."""

SMOOTH = math.radians(10)
"""A robot drives on through a smaller turn, as along the pieces of a curve [rad]."""

BILLION = 10**9

COLUMNS = ("time", "robot", "event", "place", "x", "y", "heading", "purpose", "waits_for")

COLUMNS_OF_JOBS = ("job", "stop")


@dataclass(frozen=True, slots=True, kw_only=True)
class SitePlanFormat:
    """A format of plans for programs on the site.

    Attributes
    ----------
    summary
        Its kind, in a few words.
    write
        Returns the text of a plan.
    """

    summary: str
    write: Callable[[Plan], str]


def format_site_plan(plan: Plan, name: str) -> tuple[str, tuple[str, ...]]:
    """Return a plan as the text of a file for a program on the site.

    Parameters
    ----------
    plan
        A plan; its units are converted.
    name
        A key of `SITE_PLAN_FORMATS`.

    Returns
    -------
    tuple
        The text, and the assumptions, a sentence each.
    """
    name = make_words(*sorted(SITE_PLAN_FORMATS)).read_at("name", name)
    return SITE_PLAN_FORMATS[name].write(plan), tuple(_list_assumed(plan, name))


def _list_assumed(plan: Plan, name: str) -> Iterator[str]:
    units = plan.scenario.units
    missing = [
        f"{quantity} {unit}"
        for quantity, unit, given in (
            ("lengths", "count as metres", units.length),
            ("times", "count as seconds", units.time),
        )
        if given is None
    ]
    if missing:
        yield f"{' and '.join(missing)}, because the scenario names no units"
    if name != "events" and not plan.scenario.roadmap.frame.y_up:
        yield "y is negated: it grows downwards in the scenario, and upwards in ROS"


@dataclass(frozen=True, slots=True, kw_only=True)
class Pose:
    """The place of a robot at an instant.

    Attributes
    ----------
    visit
        The number of the visit.
    seconds
        The instant [s].
    x, y
        Where it is [m].
    heading
        Which way it points, from x to y [rad]: the way that it drives next, or came; where it
        drives on through a small turn, the way between both.
    speed
        How fast it drives on [m/s]; 0 where it stays or turns.
    """

    visit: int
    seconds: Fraction
    x: Fraction
    y: Fraction
    heading: float
    speed: float


class _Site:
    """A plan in metres, seconds and radians."""

    def __init__(self, plan: Plan, *, y_up: bool) -> None:
        scenario = plan.scenario
        self.plan, self.roadmap = plan, scenario.roadmap
        self.metre = scenario.units.metres or Fraction(1)
        self.second = (scenario.units.seconds or Fraction(1)) * scenario.problem.clock.tick
        self.down = -1 if y_up and not self.roadmap.frame.y_up else 1
        self.stays = plan.stays
        joints = {int(joint) for lane in self.roadmap.lanes for joint in lane.joints}
        self._joints = joints.difference(
            *(track.vertices[[0, -1]].tolist() for track in plan.tracks)
        )
        self._joints.difference_update(
            stage.vertex for robot in scenario.problem.itineraries for stage in robot.stages
        )

    def name_node(self, vertex: int) -> str | None:
        """Return the name of a vertex; None between pieces of a lane, where the site has no node.

        A vertex where a robot begins, works or ends has its name.
        """
        if vertex in self._joints:
            return None
        return self.roadmap.name(self.roadmap.get_original(VertexId(vertex)))

    def locate_vertex(self, vertex: int) -> tuple[Fraction, Fraction]:
        """Return where a vertex is [m]."""
        x, y = self.roadmap.get_point(vertex)
        return x * self.metre, y * self.metre * self.down

    def list_events_to_write(self) -> Iterator[Event]:
        """Yield the events at nodes, and where a robot waits between pieces of a lane."""
        for event in list_events(self.plan):
            if event.waits or self.name_node(event.vertex) is not None:
                yield event

    def list_poses(self, robot: int) -> Iterator[Pose]:
        """Yield the poses of a robot in order of time, each at an instant of its own."""
        track, stays = self.plan.tracks[robot], self.stays[robot]
        points = [self.locate_vertex(vertex) for vertex in track.vertices.tolist()]
        headings, speeds = self._measure_drives(points, stays)
        came, last = headings[0], len(points) - 1
        for visit, ((x, y), (arrives, departs)) in enumerate(
            zip(points, _list_instants(track, stays), strict=True)
        ):
            goes = came if visit == last else headings[visit]
            passes = 0 < visit < last and arrives == departs
            turn = math.remainder(goes - came, math.tau)
            goes_on = passes and abs(turn) <= SMOOTH
            heading = math.remainder(came + turn / 2, math.tau) if goes_on else goes
            speed = min(speeds[visit - 1], speeds[visit]) if goes_on else 0.0
            if not passes and arrives < departs:
                yield Pose(visit=visit, seconds=arrives * self.second, x=x, y=y,
                           heading=came, speed=0.0)  # fmt: skip
            yield Pose(visit=visit, seconds=departs * self.second, x=x, y=y,
                       heading=heading, speed=speed)  # fmt: skip
            came = goes

    def _measure_drives(
        self, points: list[tuple[Fraction, Fraction]], stays: Stays
    ) -> tuple[list[float], list[float]]:
        """Return heading [rad] and speed [m/s] of the drive that ends each visit."""
        headings, speeds, heading = list[float](), list[float](), 0.0
        for (x, y), (to_x, to_y), ticks in zip(points, points[1:], stays.drive.tolist(),
                                               strict=False):  # fmt: skip
            run, rise = float(to_x - x), float(to_y - y)
            heading = math.atan2(rise, run) if run or rise else heading
            headings.append(heading)
            speeds.append(math.hypot(run, rise) / float(ticks * self.second) if ticks else 0.0)
        return headings or [0.0], speeds


def _list_instants(track: Track, stays: Stays) -> Iterator[tuple[int, int]]:
    """Yield when each visit begins, and when the drive that ends it begins [ticks]."""
    enter = track.enter.tolist()
    for begin, leave, drive in zip(enter, enter[1:], stays.drive.tolist(), strict=False):
        yield begin, max(leave - drive, begin)
    yield enter[-1], max(int(stays.completion), enter[-1])


def _round_number(number: Fraction | float) -> float:
    return round(float(number), DECIMALS) + 0.0  # without a negative zero


def _write_events(plan: Plan) -> str:
    """Return one event a line, by time and robot.

    Between pieces of a lane there are events only where a robot waits, without a place.

    ``start``, ``arrive``, ``work`` (work and turning begin), ``wait``, ``depart``, ``done``. With
    jobs, ``work`` is for each stop, with the job, and there is ``charge``.
    """
    site = _Site(plan, y_up=False)
    robots = plan.scenario.robots
    has_jobs, items = plan.tours is not None, defaultdict[tuple[int, int], list[PlannedItem]](list)
    for index, tour in enumerate(plan.tours or ()):
        for item in tour:
            items[index, item.visit].append(item)
    rows = list[tuple[int, int, tuple[Any, ...]]]()
    headings = [
        {pose.visit: pose.heading for pose in site.list_poses(robot)}
        for robot in range(len(robots))
    ]
    for event in site.list_events_to_write():
        stays, robot, now = site.stays[event.robot], event.robot, int(event.enter)
        dwell, drive = int(stays.dwell[event.visit]), int(stays.drive[event.visit])
        goes = headings[robot][event.visit]
        is_last = event.leave is None
        came = headings[robot].get(event.visit - 1, goes)
        steps = [(now, "arrive" if event.visit else "start", came, "")]
        if dwell and plan.tours is None:
            steps.append((now, "work", came, ""))
        if event.waits:
            for_robot = "" if event.waits_for is None else robots[event.waits_for].name
            steps.append((now + dwell, "wait", came, for_robot))
        if event.leave is not None:
            steps.append((max(event.leave - drive, now), "depart", goes, ""))
        if is_last:
            steps.append((int(stays.completion), "done", came, ""))
        x, y = map(_round_number, site.locate_vertex(event.vertex))
        done: list[tuple[int, str, float, str, Any, Any]] = [
            (tick, doing, heading, for_robot, "", "") for tick, doing, heading, for_robot in steps
        ]
        for item in items.get((robot, event.visit), ()):
            doing = "charge" if item.job is None else "work"
            done.append((item.begin, doing, came, "", *_name_stop(plan, item)))
        for tick, doing, heading, for_robot, *stop in sorted(done, key=lambda step: step[0]):
            row = (
                _round_number(tick * site.second), robots[robot].name, doing,
                site.name_node(event.vertex) or "",
                x, y, _round_number(heading), event.purpose, for_robot, *stop[: 2 * has_jobs],
            )  # fmt: skip
            rows.append((tick, robot, row))
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow((*COLUMNS, *(COLUMNS_OF_JOBS if has_jobs else ())))
    writer.writerows(row for _, _, row in sorted(rows, key=lambda row: row[:2]))
    return text.getvalue()


def _name_stop(plan: Plan, item: PlannedItem) -> tuple[str, int | str]:
    """Return the name of a job and the number of its stop, from 1; empty for a charge."""
    if item.job is None or item.stop is None:
        return "", ""
    assert plan.scenario.jobs is not None, "tours are of jobs"
    return plan.scenario.jobs[item.job].name, item.stop + 1


def _list_work(site: _Site, robot: int, unit: int = 1) -> list[dict[str, Any]]:
    """Return the work of a robot at stops of jobs, and its charges.

    Times are seconds, or whole parts of seconds of which `unit` are one.
    """
    plan = site.plan
    assert plan.tours is not None, "the plan has jobs"
    work, track = list[dict[str, Any]](), plan.tracks[robot]
    for item in plan.tours[robot]:
        begin, end = (tick * site.second for tick in (item.begin, item.end))
        name, stop = _name_stop(plan, item)
        work.append(
            {
                **({"job": name, "stop": stop} if name else {"charge": True}),
                "place": site.roadmap.name(int(track.vertices[item.visit])),
                "begin": int(begin * unit) if unit > 1 else _round_number(begin),
                "end": int(end * unit) if unit > 1 else _round_number(end),
            }
        )
    return work


def _write_nav2(plan: Plan) -> str:
    """Return for each robot a path of ROS, and the node of each of its poses.

    A pose between pieces of a lane has no node.
    """
    site = _Site(plan, y_up=True)
    robots = {}
    for robot, track in enumerate(plan.tracks):
        poses = list(site.list_poses(robot))
        nodes = [site.name_node(int(track.vertices[pose.visit])) for pose in poses]
        path = {
            "header": _make_header(Fraction(0)),
            "poses": [
                {"header": _make_header(pose.seconds), "pose": _make_ros_pose(pose)}
                for pose in poses
            ],
        }
        are_ids = all(node is None or (node.isascii() and node.isdecimal()) for node in nodes)
        robots[plan.scenario.robots[robot].name] = {
            "path": path,
            "nodes": [node and int(node) for node in nodes] if are_ids else nodes,
            **({} if plan.tours is None else {"work": _list_work(site, robot)}),
        }
    return _write_spread({"frame_id": FRAME, "robots": robots}) + "\n"


def _make_header(seconds: Fraction) -> dict[str, Any]:
    whole, rest = divmod(int(seconds * BILLION), BILLION)
    return {"stamp": {"sec": whole, "nanosec": rest}, "frame_id": FRAME}


def _make_ros_pose(pose: Pose) -> dict[str, Any]:
    half = pose.heading / 2
    turn = {"z": round(math.sin(half), 9) + 0.0, "w": round(math.cos(half), 9) + 0.0}
    return {
        "position": {"x": _round_number(pose.x), "y": _round_number(pose.y), "z": 0.0},
        "orientation": {"x": 0.0, "y": 0.0, **turn},
    }


def _open_rmf(plan: Plan) -> str:
    """Return for each robot an itinerary of one route; times are nanoseconds from the start."""
    site, itineraries = _Site(plan, y_up=True), dict[str, Any]()
    works = dict[str, Any]()
    for robot in range(len(plan.tracks)):
        waypoints, yaw = list[dict[str, Any]](), 0.0
        for pose in site.list_poses(robot):
            yaw += math.remainder(pose.heading - yaw, math.tau)  # the shorter way round
            velocity = pose.speed * math.cos(yaw), pose.speed * math.sin(yaw)
            waypoints.append(
                {
                    "time": int(pose.seconds * BILLION),
                    "position": [_round_number(pose.x), _round_number(pose.y), _round_number(yaw)],
                    "velocity": [*map(_round_number, velocity), 0.0],
                }
            )
        route = {"map": LEVEL, "trajectory": {"waypoints": waypoints}}
        itineraries[plan.scenario.robots[robot].name] = [route]
        if plan.tours is not None:
            works[plan.scenario.robots[robot].name] = _list_work(site, robot, BILLION)
    work = {"work": works} if works else {}
    return _write_spread({"itineraries": itineraries, **work}) + "\n"


def _write_spread(value: Any, margin: str = "\n") -> str:
    """Return JSON with one pose or waypoint on a line."""
    inner = margin + "  "
    if isinstance(value, dict) and not {"place", "pose", "position", "stamp"} & set(value):
        pairs = (
            f"{format_json_line(key)}: {_write_spread(child, inner)}"
            for key, child in value.items()
        )
        return f"{{{inner}{f',{inner}'.join(pairs)}{margin}}}"
    if isinstance(value, list) and value and isinstance(value[0], dict):
        return f"[{inner}{f',{inner}'.join(_write_spread(item, inner) for item in value)}{margin}]"
    return format_json_line(value)


SITE_PLAN_FORMATS: dict[str, SitePlanFormat] = {
    "events": SitePlanFormat(
        summary="events as CSV: who starts, arrives, works, waits and departs, where and when",
        write=_write_events,
    ),
    "nav2": SitePlanFormat(
        summary="Nav2: a path (nav_msgs/Path) and the nodes of each robot, JSON", write=_write_nav2
    ),
    "open-rmf": SitePlanFormat(
        summary="Open-RMF: an itinerary (rmf_traffic_msgs/Route) of each robot, JSON",
        write=_open_rmf,
    ),
    "opentcs": SitePlanFormat(
        summary="openTCS: a transport order of each job for its vehicle, JSON", write=write_orders
    ),
}
"""The formats of plans for programs on the site, by name."""
