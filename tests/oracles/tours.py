"""Tours judged and found the slow way: times step by step, and all tours of all assignments.

`judge_tours` recomputes times, loads and states of charge of an assignment. `find_least_cost` tries
every robot for every job and every order of stops and charges. Nothing is shared with the search.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import product

from rightofway.assign import Travel
from rightofway.assign.travel import BatteryKind
from rightofway.model.work import Assignment, BoundRobot, BoundStop, Tour, Work

Cost = tuple[int, int, int]
"""The weight of unserved jobs, the objective, the flowtime of robots."""


@dataclass(frozen=True, slots=True)
class Times:
    """When the items of a tour begin and end, and when the robot completes [ticks]."""

    spans: tuple[tuple[int, int], ...]
    completion: int


def judge_tours(work: Work, travel: Travel, weights: Sequence[int], assignment: Assignment) -> Cost:
    """Return what an assignment costs; AssertionError if it breaks a rule."""
    unserved = {job for job, _ in assignment.unserved}
    served = _check_jobs(work, assignment)
    assert served | unserved == set(range(len(work.jobs))), "each job is served or unserved"
    assert not served & unserved
    for job in served:
        assert not unserved.intersection(work.jobs[job].after), "after an unserved job"
    ends: dict[int, int] = {}
    times: list[Times] = []
    for _ in range(len(work.jobs) + 2):  # until the ends of jobs before others are known
        times = [
            _time_tour(work, travel, robot, tour, ends)
            for robot, tour in enumerate(assignment.tours)
        ]
        ends = _find_ends(assignment, times)
    assert ends == _find_ends(assignment, times), "tours and `after` have a cycle"
    for robot, tour in enumerate(assignment.tours):
        _check_stops(work, robot, tour, times[robot], ends)
        if work.robots[robot].battery is not None:
            _check_battery(work, travel, robot, tour, times[robot])
    return _compute_cost(work, weights, ends, [one.completion for one in times])


def _check_jobs(work: Work, assignment: Assignment) -> set[int]:
    seen: dict[int, list[tuple[int, int]]] = {}
    for robot, tour in enumerate(assignment.tours):
        for item in tour:
            if item.job is not None:
                assert item.stop is not None
                seen.setdefault(item.job, []).append((robot, item.stop))
                stop = work.jobs[item.job].stops[item.stop - work.jobs[item.job].first]
                assert (item.vertex, item.duration) == (stop.vertex, stop.work)
    for number, items in seen.items():
        job = work.jobs[number]
        robots = {robot for robot, _ in items}
        assert len(robots) == 1, "one robot"
        assert robots <= set(job.robots), "that may do it"
        assert [stop for _, stop in items] == list(range(job.first, job.first + len(job.stops)))
    return set(seen)


def _find_ends(assignment: Assignment, times: Sequence[Times]) -> dict[int, int]:
    ends: dict[int, int] = {}
    for tour, timed in zip(assignment.tours, times, strict=True):
        for item, (_, end) in zip(tour, timed.spans, strict=True):
            if item.job is not None:
                ends[item.job] = max(end, ends.get(item.job, 0))
    return ends


def _time_tour(work: Work, travel: Travel, robot: int, tour: Tour, ends: dict[int, int]) -> Times:
    state, ticks = work.robots[robot], travel.ticks[travel.kind_of[robot]]
    at, time, spans = travel.get_start(robot), int(state.ready), list[tuple[int, int]]()
    last_end = time
    for item in tour:
        place = travel.place_of[item.vertex]
        assert ticks[at, place] >= 0, "a way"
        at, time = place, time + int(ticks[at, place])
        if item.job is not None and item.stop is not None:
            job = work.jobs[item.job]
            stop = job.stops[item.stop - job.first]
            time = max(time, stop.earliest)
            if item.stop == job.first:
                time = max([time, *(ends.get(other, 0) for other in job.after)])
        spans.append((time, time + item.duration))
        time += item.duration
        if item.job is not None or item.duration:
            last_end = time
    if state.home is None:
        return Times(tuple(spans), last_end)
    assert ticks[at, travel.place_of[state.home]] >= 0
    return Times(tuple(spans), time + int(ticks[at, travel.place_of[state.home]]))


def _check_stops(work: Work, robot: int, tour: Tour, times: Times, ends: dict[int, int]) -> None:
    state = work.robots[robot]
    load = state.load
    for item, (begin, end) in zip(tour, times.spans, strict=True):
        if item.job is not None and item.stop is not None:
            job = work.jobs[item.job]
            stop = job.stops[item.stop - job.first]
            load += stop.load
            assert 0 <= load <= state.capacity, "the load fits"
            assert begin >= stop.earliest
            assert stop.latest is None or end <= stop.latest, "in time"
            if item.stop == job.first:
                assert all(begin >= ends[other] for other in job.after)


def _check_battery(work: Work, travel: Travel, robot: int, tour: Tour, times: Times) -> None:
    kind = travel.batteries[travel.battery_of[robot]]
    state, battery = work.robots[robot], kind.battery
    assert state.battery is not None
    soc = state.battery.soc * (battery.full // state.battery.full)
    least = 0 if soc < battery.reserve else battery.reserve
    assert least or not tour or tour[0].job is None or battery.reserve == 0, "low: charge first"
    at, time = travel.get_start(robot), int(state.ready)
    for item, (begin, end) in zip(tour, times.spans, strict=True):
        place = travel.place_of[item.vertex]
        soc -= int(kind.drives[at, place]) + battery.on * (begin - time)
        assert soc >= least, "the battery lasts"
        if item.job is None:
            assert place in kind.charging
            soc, least = min(battery.full, soc + battery.charge * (end - begin)), battery.reserve
        else:
            soc -= (battery.on + battery.work) * (end - begin)
        assert soc >= least, "the battery lasts"
        at, time = place, end
    if state.home is not None:
        place = travel.place_of[state.home]
        soc -= int(kind.drives[at, place]) + battery.on * (times.completion - time)
        at = place
    assert soc >= least
    assert not tour or soc - int(kind.to_charging[at]) >= battery.reserve, "it can charge later"


def _compute_cost(
    work: Work, weights: Sequence[int], ends: dict[int, int], completions: Sequence[int]
) -> Cost:
    unserved = sum(
        job.weight
        for number, job in enumerate(work.jobs)
        if number not in ends and job.begun_by is None
    )
    service = sum(_serve(work, job, end) for job, end in ends.items())
    flowtime = sum(w * c for w, c in zip(weights, completions, strict=True))
    makespan = max(completions)
    value = {
        "service": service,
        "flowtime": flowtime,
        "makespan": makespan,
        "both": sum(weights) * makespan + flowtime,
    }[work.objective]
    return unserved, value, flowtime


def _serve(work: Work, number: int, end: int) -> int:
    job = work.jobs[number]
    late = 0 if job.due is None else max(0, end - job.due)
    cost = job.weight * (end - job.earliest + work.late * late) * work.late.denominator
    assert cost == int(cost)
    return int(cost)


@dataclass(frozen=True, slots=True)
class _Label:
    """A part of a tour: the robot has done some stops and leaves a place."""

    time: int
    soc: int
    service: int
    done: tuple[int, ...]  # stops of each job of the robot
    place: int
    load: int
    is_low: bool = False
    last_end: int = 0


def find_least_cost(work: Work, travel: Travel, weights: Sequence[int]) -> Cost | None:
    """Return the least cost of all assignments; None if a begun job cannot be done."""
    assert not any(job.after for job in work.jobs), "tours must not depend on each other"
    ends_of: dict[tuple[int, tuple[int, ...]], list[tuple[int, int]]] = {}
    best: Cost | None = None
    choices = [[*job.robots, *([None] if job.begun_by is None else [])] for job in work.jobs]
    for chosen in product(*choices):
        unserved = sum(
            job.weight for job, robot in zip(work.jobs, chosen, strict=True) if robot is None
        )
        if best is not None and unserved > best[0]:
            continue
        options = []
        for robot in range(len(work.robots)):
            own = tuple(job for job, other in enumerate(chosen) if other == robot)
            if (robot, own) not in ends_of:
                ends_of[robot, own] = _Orders(work, travel, robot, own).list_ends()
            options.append(ends_of[robot, own])
        for ends in product(*options):
            completions = [completion for _, completion in ends]
            flowtime = sum(w * c for w, c in zip(weights, completions, strict=True))
            value = {
                "service": sum(service for service, _ in ends),
                "flowtime": flowtime,
                "makespan": max(completions),
                "both": sum(weights) * max(completions) + flowtime,
            }[work.objective]
            cost = unserved, value, flowtime
            best = cost if best is None else min(best, cost)
    return best


def _dominates(a: _Label, b: _Label) -> bool:
    return (
        a.time <= b.time and a.soc >= b.soc and a.service <= b.service and a.last_end <= b.last_end
    )


@dataclass(frozen=True, slots=True)
class _Orders:
    """All tours of one robot that do some jobs."""

    work: Work
    travel: Travel
    robot: int
    jobs: tuple[int, ...]

    @property
    def state(self) -> BoundRobot:
        return self.work.robots[self.robot]

    @property
    def kind(self) -> BatteryKind | None:
        number = self.travel.battery_of[self.robot]
        return None if number < 0 else self.travel.batteries[number]

    def list_ends(self) -> list[tuple[int, int]]:
        """Return the undominated pairs of service and completion."""
        kept: dict[tuple[object, ...], list[_Label]] = {}
        open_labels, ends = [self._begin()], list[tuple[int, int]]()
        while open_labels:
            label = open_labels.pop()
            known = kept.setdefault((label.done, label.place, label.is_low), [])
            if any(_dominates(other, label) for other in known):
                continue
            known.append(label)
            completion = self._end(label)
            if completion is not None:
                ends.append((label.service, completion))
            open_labels += self._serve_stops(label)
            open_labels += self._charge(label)
        return [
            end
            for end in set(ends)
            if not any(o != end and o[0] <= end[0] and o[1] <= end[1] for o in ends)
        ]

    def _begin(self) -> _Label:
        soc, is_low = 0, False
        if self.kind is not None and self.state.battery is not None:
            full = self.kind.battery.full
            soc = self.state.battery.soc * (full // self.state.battery.full)
            is_low = soc < self.kind.battery.reserve
        ready, done = int(self.state.ready), (0,) * len(self.jobs)
        at = self.travel.get_start(self.robot)
        return _Label(ready, soc, 0, done, at, self.state.load, is_low, ready)

    def _drive(self, label: _Label, place: int) -> _Label | None:
        ticks = int(self.travel.ticks[self.travel.kind_of[self.robot]][label.place, place])
        if ticks < 0:
            return None
        soc = label.soc
        if self.kind is not None:
            soc -= int(self.kind.drives[label.place, place]) + self.kind.battery.on * ticks
            if soc < (0 if label.is_low else self.kind.battery.reserve):
                return None
        return replace(label, time=label.time + ticks, soc=soc, place=place)

    def _serve_stops(self, label: _Label) -> Iterator[_Label]:
        for index, number in enumerate(self.jobs):
            job, done = self.work.jobs[number], label.done[index]
            if done < len(job.stops) and not label.is_low:
                after = self._serve(label, job.stops[done])
                if after is not None:
                    cost = (
                        _serve(self.work, number, after.time) if done + 1 == len(job.stops) else 0
                    )
                    yield replace(
                        after,
                        done=(*label.done[:index], done + 1, *label.done[index + 1 :]),
                        service=label.service + cost,
                    )

    def _serve(self, label: _Label, stop: BoundStop) -> _Label | None:
        there = self._drive(label, self.travel.place_of[stop.vertex])
        if there is None:
            return None
        end = max(there.time, stop.earliest) + stop.work
        load, soc = there.load + stop.load, there.soc
        if self.kind is not None:
            battery = self.kind.battery
            soc -= battery.on * (end - there.time) + battery.work * stop.work
            if soc < battery.reserve:
                return None
        if stop.latest is not None and end > stop.latest:
            return None
        if not 0 <= load <= self.state.capacity:
            return None
        return replace(there, time=end, soc=soc, load=load, last_end=end)

    def _charge(self, label: _Label) -> Iterator[_Label]:
        if self.kind is None or self.kind.battery.charge == 0:
            return
        battery = self.kind.battery
        opens = [stop.earliest for job in self.jobs for stop in self.work.jobs[job].stops]
        for place in self.kind.charging:
            there = self._drive(label, place)
            if there is not None:
                to_full = -(-(battery.full - there.soc) // battery.charge)
                longest = max(to_full, *(earliest - there.time for earliest in opens), 0)
                for ticks in range(1, longest + 1):
                    soc = min(battery.full, there.soc + ticks * battery.charge)
                    if soc >= battery.reserve:
                        end = there.time + ticks
                        yield replace(there, time=end, soc=soc, is_low=False, last_end=end)

    def _end(self, label: _Label) -> int | None:
        """Return when the robot completes if its tour ends here, or None if it must not."""
        if any(
            done < len(self.work.jobs[job].stops)
            for done, job in zip(label.done, self.jobs, strict=True)
        ):
            return None
        if self.state.home is not None:
            home = self._drive(label, self.travel.place_of[self.state.home])
            return home.time if home is not None and self._may_rest(home) else None
        if self._may_rest(label):
            return label.last_end
        if self.kind is None or label.is_low:
            return None
        reached = [self._drive(label, place) for place in self.kind.charging]
        return label.last_end if any(reached) else None

    def _may_rest(self, label: _Label) -> bool:
        if self.kind is None or not self.jobs:
            return True
        least = self.kind.battery.reserve + int(self.kind.to_charging[label.place])
        return label.soc >= least and not label.is_low
