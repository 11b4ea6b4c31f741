"""What pages are told of a fleet that is driven: a fold over its journal."""

from __future__ import annotations

import json
from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path

import pytest

import rightofway
from rightofway.control import FleetControl, JournalReader, JournalRow, SqliteJournal
from rightofway.control import recording as module
from rightofway.control.demo import drive_demo
from rightofway.control.notices import EVERY_KIND, make_notice
from rightofway.control.recording import Recording
from rightofway.errors import InputError
from rightofway.facts import Fact, read_fact
from rightofway.model import Plan
from rightofway.report.facts import FactWriter
from rightofway.report.phrases import to_parts
from tests.builders.floor_jobs import floor_plan
from tests.builders.languages import say
from tests.builders.pages import ROOT
from tests.builders.plans import door
from tests.builders.warehouses import warehouse


def recorded(plan: Plan, folder: Path, **options: object) -> list[JournalRow]:
    """Return the journal of a demo."""
    drive_demo(plan, journal=folder / "demo.journal", **options)  # type: ignore[arg-type]
    reader = JournalReader(folder / "demo.journal")
    rows = reader.read_rows()
    reader.close()
    return rows


class Journalled:
    """Rows of a journal, of which only some have been written."""

    def __init__(self, rows: Sequence[JournalRow]) -> None:
        self._rows, self.until = rows, 0.0
        self.is_written = False

    def read_rows(self, after: int = 0) -> list[JournalRow]:
        """Return the rows behind one, up to the moment."""
        return [row for row in self._rows if row.number > after and (row.moment or 0) <= self.until]


def test_a_recording_says_where_robots_are_what_they_hold_and_whom_they_wait_for(
    tmp_path: Path,
) -> None:
    """The door: R1 waits at N0 until R2, which has set out for N8, is at N4, at 2."""
    source = Journalled(recorded(door(), tmp_path))
    recording = Recording(door(), source)
    recording.read_on()
    frame = recording.take_frame()
    assert frame["begins"]
    assert [row[1:] for row in frame["rows"] if row[2] in {"arrived", "released"}] == [
        (0, "arrived", 0), (0, "released", 0), (1, "arrived", 0), (1, "released", 4),
    ]  # fmt: skip
    (wait,) = [row for row in frame["rows"] if row[2] == "says" and row[3] == "wait"]
    assert say(list(wait[4])) == "R1 waits at N0 until R2 is at N4"
    assert wait[5] == [1]
    source.until = 2.0
    recording.read_on()
    assert [row for row in recording.take_frame(frame["number"])["rows"] if row[2] != "says"] == [
        (1.0, 1, "arrived", 1), (2.0, 0, "released", 1), (2.0, 1, "arrived", 2),
    ]  # fmt: skip


def test_a_recording_says_which_job_a_robot_does_and_how_full_it_is(tmp_path: Path) -> None:
    """R2 begins with a fifth and charges first; R1 picks at N10, and drops at N2 in no time."""
    source = Journalled(recorded(floor_plan(), tmp_path))
    source.until = 60.0
    recording = Recording(floor_plan(), source)
    recording.read_on()
    rows = recording.take_frame()["rows"]
    tasks = [say(row[3]) if row[3] else "" for row in rows if row[1:3] == (0, "task")]
    assert tasks == [
        "drives to stop 1 of J1", "works at stop 1 of J1", "drives to stop 2 of J1", "", "charges",
    ]  # fmt: skip
    assert next(say(row[3]) for row in rows if row[1:3] == (1, "task")) == "charges"
    percents = [int(str(row[3])) for row in rows if row[1:3] == (1, "charge")]
    assert percents[0] == 20
    assert all(abs(a - b) >= 5 or b in {0, 100} for a, b in pairwise(percents))


def test_a_recording_compares_the_ends_of_jobs_with_their_planned_ends(tmp_path: Path) -> None:
    """At 0 all jobs are open and as planned; in the end the page agrees with the report."""
    plan = floor_plan()
    source = Journalled(recorded(plan, tmp_path, delays="exponential:0.5", seed=3))
    recording = Recording(plan, source, clock=lambda: source.until)
    recording.read_on()
    before = recording.measure_ends()
    assert before is not None
    assert (before["hasJobs"], before["all"]) == (True, (0, 3, 0, None))
    assert [row[2] == row[5] for row in before["rows"]] == [True, True, True]  # as planned
    source.until = 0.5
    assert recording.measure_ends() is before
    source.until = 10_000.0
    recording.read_on()
    after, result = recording.measure_ends(), recording.result
    assert after is not None
    late = sum(end.is_late for end in result.ends)
    assert late > 0
    assert after["all"][:3] == (3, 0, late)
    assert [sum(column) for column in zip(*(row[:3] for row in after["robots"]), strict=True)] == [
        3, 0, late,
    ]  # fmt: skip
    rows = {row[0]: row[4] for row in after["rows"]}
    assert rows == {end.name: end.ended for end in result.ends}
    assert after["rows"][0][-1]


def test_a_recording_of_a_plan_without_jobs_compares_the_ways_of_robots(tmp_path: Path) -> None:
    """R2 stops for 6 at its second vertex, which R1 waits to enter.

    At 9, R2 has just driven on, and R1 has not: both should have at 3. So both are 6 late.
    """
    source = Journalled(recorded(door(), tmp_path, delays="stop:R2@2+6"))
    recording = Recording(door(), source, clock=lambda: source.until)
    source.until = 9.0
    recording.read_on()
    ends = recording.measure_ends()
    assert ends == {
        "hasJobs": False,
        "all": (0, 2, 2, None),
        "robots": [],
        "rows": [
            ("R1", 0, 10, None, None, 16, 6, True),
            ("R2", 1, 9, None, None, 15, 6, True),
        ],
    }
    source.until = 100.0
    recording.read_on()
    ends = recording.measure_ends()
    assert ends is not None
    assert ends["all"] == (2, 0, 2, 7.5)
    assert ends["rows"] == [
        ("R1", 0, 10, None, 18, None, 8, True),
        ("R2", 1, 9, None, 16, None, 7, True),
    ]


def test_read_bit_by_bit_or_at_once_a_journal_says_the_same(tmp_path: Path) -> None:
    rows = recorded(warehouse(8), tmp_path, delays="exponential:0.4", seed=2)
    whole, bit = Journalled(rows), Journalled(rows)
    whole.until = float("inf")
    at_once, bit_by_bit = Recording(warehouse(8), whole), Recording(warehouse(8), bit)
    at_once.read_on()
    for row in rows[::7]:
        bit.until = row.moment or 0.0
        bit_by_bit.read_on()
    bit.until = whole.until
    bit_by_bit.read_on()
    assert at_once.take_frame() == bit_by_bit.take_frame()


def test_who_comes_late_or_again_gets_what_is_missing(tmp_path: Path) -> None:
    source = Journalled(recorded(door(), tmp_path))
    source.until = 12.0
    recording = Recording(door(), source)
    recording.read_on()
    whole = recording.take_frame()
    assert not recording.take_frame(whole["number"])["rows"]
    again = recording.take_frame(5)
    assert (again["begins"], again["rows"]) == (False, whole["rows"][5:])
    beyond = recording.take_frame(whole["number"] + 1)  # of another reading: the page forgets it
    assert (beyond["begins"], beyond["rows"]) == (True, whole["rows"])


def test_a_recording_that_begins_again_says_what_is_known_now(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    source = Journalled(recorded(door(), tmp_path))
    source.until = 7.0
    recording = Recording(door(), source)
    recording.read_on()
    before = recording.count
    monkeypatch.setattr(module, "MAX_ROWS", 10)
    recording.read_on()
    rows = recording.take_frame()["rows"]
    assert recording.count == before + len(rows)
    assert [row[1:] for row in rows if row[2] in {"arrived", "released"}] == [
        (0, "arrived", 4), (0, "released", 4), (1, "arrived", 5), (1, "released", 8),
    ]  # fmt: skip
    assert [row[1:4] for row in rows if row[2] == "says"] == [(0, "says", "wait")]


def test_alarms_begin_and_end(tmp_path: Path) -> None:
    path = tmp_path / "run.journal"
    drive_demo(door(), journal=path)
    moments = iter((20.0, 21.0))
    journal = SqliteJournal(path, lambda: next(moments))
    lost = Fact("not connected")
    journal.commit([make_notice(lost, 0, "lost")])
    journal.commit([make_notice(None, 0, "lost", is_over=True)])
    journal.close()
    reader = JournalReader(path)
    recording = Recording(door(), reader)
    recording.read_on()
    alarms = [row for row in recording.take_frame()["rows"] if row[2] == "alarm"]
    sentence = to_parts(FactWriter(None).write(lost))
    assert alarms == [(20.0, 0, "alarm", "lost", sentence), (21.0, 0, "alarm", "lost", None)]
    reader.close()


def test_a_person_has_seen_the_alarms_that_last(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A recording that begins again still knows who; an alarm that comes back is unseen."""
    drive_demo(door(), journal=tmp_path / "demo.journal")
    begin = make_notice(Fact("about robot", robot="R1", predicate=Fact("paused")), 0, "pause")
    seen = make_notice(Fact("alarms seen", person="Anna"))
    over = make_notice(None, 0, "pause", is_over=True)
    journal = SqliteJournal(tmp_path / "demo.journal", lambda: 20.0)
    journal.commit([begin, seen, seen])
    recording = Recording(door(), JournalReader(tmp_path / "demo.journal"))
    recording.read_on()
    rows = [row[1:] for row in recording.take_frame()["rows"] if row[2] == "seen"]
    assert rows == [(0, "seen", "pause", "Anna")]
    monkeypatch.setattr(module, "MAX_ROWS", 10)
    recording.read_on()
    again = [row[1:4] for row in recording.take_frame()["rows"] if row[2] in {"alarm", "seen"}]
    assert again == [(0, "alarm", "pause"), (0, "seen", "pause")]
    number = recording.count
    journal.commit([over, begin])
    monkeypatch.setattr(module, "MAX_ROWS", 10_000)
    recording.read_on()
    later = [row[2:4] for row in recording.take_frame(number)["rows"] if row[2] != "says"]
    assert later == [("alarm", "pause"), ("alarm", "pause")]
    journal.close()


def test_a_pause_that_a_person_has_asked_for_is_no_alarm(tmp_path: Path) -> None:
    """R1 is stopped by a person, R2 pauses by itself: both are in the log."""
    drive_demo(door(), journal=tmp_path / "demo.journal")
    journal = SqliteJournal(tmp_path / "demo.journal", lambda: 20.0)
    journal.commit([{"kind": "pause wanted", "robot": 0, "on": True, "action": "a"}])
    fact = Fact("about robot", robot="R1", predicate=Fact("paused"))
    journal.commit([make_notice(fact, robot, "pause") for robot in (0, 1)])
    recording = Recording(door(), JournalReader(tmp_path / "demo.journal"))
    recording.read_on()
    rows = [row[1:4] for row in recording.take_frame()["rows"] if row[0] == 20.0]
    assert rows == [(0, "says", "news"), (1, "says", "alarm"), (1, "alarm", "pause")]
    journal.close()


def test_a_start_ends_the_alarms_that_notices_have_begun_and_no_others(tmp_path: Path) -> None:
    """A control that was killed cannot report their ends; a fault is known by the journal."""
    path = tmp_path / "run.journal"
    drive_demo(door(), journal=path)
    journal = SqliteJournal(path, lambda: 20.0)
    fault = Fact("off way", place="N3").as_dict()
    lost, entry = Fact("not connected"), {"fault": fault, "place": None}
    journal.commit([make_notice(lost, 0, "lost"), make_notice(lost, -1, "broker")])
    journal.commit([{"kind": "fault", "robot": 1, **entry}])
    journal.commit([make_notice(None, kind=EVERY_KIND, is_over=True)])
    journal.close()
    reader = JournalReader(path)
    recording = Recording(door(), reader)
    recording.read_on()
    alarms = [row[1:] for row in recording.take_frame()["rows"] if row[2] == "alarm"]
    ended = [row for row in alarms if row[3] is None]
    assert sorted(ended) == [(-1, "alarm", "broker", None), (0, "alarm", "lost", None)]
    assert len(alarms) == 5
    reader.close()


def test_a_robot_of_a_demo_that_stands_has_an_alarm_until_it_moves(tmp_path: Path) -> None:
    """R2 stands for 100 from its begin on: alarmed after 2 + 11 time units, or one step later."""
    rows = recorded(door(), tmp_path, delays="stop:R2@0+100")
    told = [row for row in rows if row.entry.get("about") == "still" and row.entry["robot"] == 1]
    assert [row.entry["over"] for row in told] == [False, True]
    assert told[0].moment is not None
    assert 13 <= told[0].moment <= 15


def test_times_count_from_the_begin_of_the_run_after_its_first_entries_have_gone(
    tmp_path: Path,
) -> None:
    """The demo began at 0 s; the two snapshots that are left were made at 21 s and at 22 s."""
    path = tmp_path / "run.journal"
    drive_demo(door(), journal=path)
    moments = iter((20.0, 21.0, 22.0))
    journal = SqliteJournal(path, lambda: next(moments))
    snapshot = FleetControl(journal).ledger.make_snapshot()
    for _ in range(3):
        journal.begin_again(snapshot)
    journal.close()
    reader = JournalReader(path)
    assert reader.read_rows()[0].moment == 21.0
    recording = Recording(door(), reader)
    recording.read_on()
    assert recording.now == 22.0
    reader.close()


def test_the_journal_of_other_robots_is_refused(tmp_path: Path) -> None:
    source = Journalled(recorded(door(), tmp_path))
    other = rightofway.solve(rightofway.load(ROOT / "examples" / "bay.yaml"), "prioritized")
    with pytest.raises(InputError, match="is of other robots, R1, R2"):
        Recording(other, source).read_on()


@pytest.mark.slow
def test_a_hundred_robots_take_less_than_100_kilobytes_a_second(tmp_path: Path) -> None:
    """A second of the plan in a second, in the busiest second of a warehouse with 100 robots."""
    plan = warehouse(100)
    source = Journalled(recorded(plan, tmp_path))
    recording = Recording(plan, source)
    recording.read_on()
    most, known = 0, recording.count
    for second in range(1, 60):
        source.until = float(second)
        recording.read_on()
        frame = recording.take_frame(known)
        known = frame["number"]
        most = max(most, len(json.dumps(frame, separators=(",", ":"))))
    empty = 4 * len(json.dumps(recording.take_frame(known)))  # four frames a second
    assert 2_000 < most + empty < 100_000


def test_a_demo_begins_anew_and_takes_no_journal_of_another_run(tmp_path: Path) -> None:
    rows = recorded(door(), tmp_path)
    assert rows[0].entry == {"kind": "pace", "seconds": None}
    with pytest.raises(InputError, match="has a run already"):
        drive_demo(door(), journal=tmp_path / "demo.journal")


@pytest.mark.parametrize(
    "change",
    [
        {"fact": {"kind": "of a newer version", "values": {}}},
        {"fact": {"kind": "moving"}},
        {"fact": {"kind": "paused", "values": []}},
        {"fact": "x"},
    ],
)
def test_a_wrong_notice_is_refused_with_its_number(
    tmp_path: Path, change: dict[str, object]
) -> None:
    path = tmp_path / "run.journal"
    journal = SqliteJournal(path)
    journal.commit([{**make_notice(None), **change}])
    journal.close()
    reader = JournalReader(path)
    with pytest.raises(InputError, match=r"entry\[1\]: .* cannot be read"):
        Recording(door(), reader).read_on()
    reader.close()


def test_a_journal_of_a_run_has_kinds_and_values_and_no_sentences(tmp_path: Path) -> None:
    """Each notice and each answer in it is a fact that is told as it was reported."""
    told = list[str]()

    def note(_: int, fact: Fact) -> None:
        told.append(str(fact))

    rows = recorded(door(), tmp_path, delays="stop:R2@0+100", report=note)
    facts = [row.entry["fact"] for row in rows if row.entry.get("fact")]
    assert [fact["kind"] for fact in facts] == ["about robot", "about robot"]
    begin, end = (fact["values"]["predicate"] for fact in facts)
    assert begin == {"kind": "not moving", "values": {"place": "N2", "target": "N8"}}
    assert end == {"kind": "moving", "values": {}}
    assert {str(read_fact(fact)) for fact in facts} < set(told)
