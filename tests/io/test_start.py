"""The start of a scenario, and times of day: exact times, the same in all files, clear faults."""

from __future__ import annotations

from datetime import datetime, timedelta, timezone
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest

import rightofway
from rightofway import FleetBuilder, InputError
from rightofway.io import dump_scenario, parse_scenario
from rightofway.units import Units


def document() -> dict[str, Any]:
    """Return a scenario that starts at six, with times of day in closures and jobs."""
    return {
        "format": "rightofway-scenario/1",
        "start": "2026-11-28T06:00",
        "map": {"grid": [".....", "....."]},
        "robots": [{"name": "R1", "home": "N0"}],
        "closures": [
            {"at": "N1", "from": "10:00", "until": "10:30"},
            {"at": "N9", "from": "2026-11-29T01:00"},
        ],
        "jobs": [
            {"name": "J1", "at": "N8", "earliest": "06:02", "due": "6:05:30"},
            {"name": "J2", "stops": [
                {"at": "N8", "earliest": "06:00:30.25", "latest": "12:00"}, {"at": "N7"}]},
        ],
    }  # fmt: skip


def test_times_of_day_are_exact_times_since_the_start() -> None:
    scenario = parse_scenario(document())
    first, second = scenario.closures
    assert [first.from_, first.until, second.from_] == [14400, 16200, 19 * 3600]
    assert scenario.jobs is not None
    assert [scenario.jobs[0].earliest, scenario.jobs[0].due] == [120, 330]
    stop = scenario.jobs[1].stops[0]
    assert [stop.earliest, stop.latest] == [Fraction(121, 4), 21600]
    assert scenario.units == Units(time="s", start=datetime(2026, 11, 28, 6))  # noqa: DTZ001
    in_minutes = parse_scenario({**document(), "units": {"time": "min"}})
    assert in_minutes.jobs is not None
    assert [in_minutes.closures[0].from_, in_minutes.jobs[0].due] == [240, Fraction(11, 2)]


@pytest.mark.parametrize("ending", ["yaml", "json", "xlsx"])
def test_files_have_times_of_day_again(tmp_path: Path, ending: str) -> None:
    scenario, file = parse_scenario(document()), tmp_path / f"start.{ending}"
    rightofway.write_scenario(scenario, file)
    assert rightofway.load(file) == scenario
    written = dump_scenario(scenario)
    assert written["start"] == "2026-11-28T06:00"
    assert written["closures"] == [
        {"at": "N1", "from": "10:00", "until": "10:30"},
        {"at": "N9", "from": "2026-11-29T01:00"},
    ]
    assert written["jobs"][0] == {"name": "J1", "at": "N8", "earliest": "06:02", "due": "06:05:30"}


def test_a_table_of_jobs_has_times_of_day(tmp_path: Path) -> None:
    (tmp_path / "jobs.csv").write_text("name,at,earliest,due\nJ1,N8,06:02,2026-11-28T06:05:30\n")
    table = {**document(), "jobs": {"table": "jobs.csv"}}
    assert parse_scenario(table, tmp_path).jobs == parse_scenario(document()).jobs[:1]  # type: ignore[index]


def test_a_sheet_may_have_times_in_its_cells(tmp_path: Path) -> None:
    openpyxl = pytest.importorskip("openpyxl")
    file = tmp_path / "start.xlsx"
    rightofway.write_scenario(parse_scenario(document()), file)
    workbook = openpyxl.load_workbook(file)
    cells = {cell.value: cell for row in workbook["closures"].iter_rows() for cell in row}
    cells["10:00"].value = timedelta(hours=10)
    cells["10:00"].number_format = "h:mm"
    cells["2026-11-29T01:00"].value = datetime(2026, 11, 29, 1)  # noqa: DTZ001
    cells["2026-11-29T01:00"].number_format = "yyyy-mm-dd h:mm"
    workbook.save(file)
    assert rightofway.load(file) == parse_scenario(document())


def test_an_offset_from_utc_is_kept_and_counts() -> None:
    own = {**document(), "start": "2026-11-28T06:00+01:00"}
    own["closures"] = [{"at": "N1", "from": "09:00Z", "until": "2026-11-28T10:30+01:00"}]
    scenario = parse_scenario(own)
    assert [scenario.closures[0].from_, scenario.closures[0].until] == [14400, 16200]
    zone = timezone(timedelta(hours=1))
    assert scenario.units.start == datetime(2026, 11, 28, 6, tzinfo=zone)
    assert dump_scenario(scenario)["start"] == "2026-11-28T06:00+01:00"
    assert dump_scenario(scenario)["closures"][0]["from"] == "10:00"


def test_a_builder_takes_times_of_day() -> None:
    fleet = FleetBuilder(grid=[".....", "....."], start="2026-11-28T06:00")
    fleet.add_robot("R1", home="N0").add_closure(at="N1", from_="10:00", until="10:30")
    fleet.add_closure(at="N9", from_="2026-11-29T01:00")
    fleet.add_job("J1", at="N8", earliest="06:02", due="6:05:30")
    stops = [{"at": "N8", "earliest": "06:00:30.25", "latest": "12:00"}, {"at": "N7"}]
    assert fleet.add_job("J2", stops=stops).build_scenario() == parse_scenario(document())
    with pytest.raises(InputError, match=r"closure 2: until: '05:00' is before the start"):
        fleet.add_closure(at="N2", until="05:00")


@pytest.mark.parametrize(
    ("key", "value", "fault"),
    [
        ("from", "05:00", r"from: '05:00' is before .* \(give the day, like 2026-11-29T05:00\)"),
        ("from", "2026-11-27T07:00", r"from: .* is before the start, .* \(give a later one\)"),
        ("from", "24:00", r"from: '24:00' is no time of day \(give 00:00 to 23:59:59, on later"),
        ("from", "9:5", r"from: '9:5' is no time of day \(give one like 10:30"),
        ("from", "2026-02-30T10:00", r"from: .* has no day of the calendar"),
        ("from", "10:00Z", r"from: '10:00Z' has an offset from UTC, and the start has none"),
        ("until", "06:00", r"until: .* is not positive"),
    ],
)  # fmt: skip
def test_faults_of_times_of_day_are_clear(key: str, value: str, fault: str) -> None:
    wrong = document()
    wrong["closures"][0][key] = value
    with pytest.raises(InputError, match=rf"closures\[0\]\.{fault}"):
        parse_scenario(wrong)


@pytest.mark.parametrize(
    ("start", "fault"),
    [
        ("06:00", r"start: '06:00' has no day \(give an instant like 2026-11-28T06:00"),
        ("28.11.2026 06:00", r"start: '28.11.2026 06:00' is no instant"),
        (6, r"start: 6 is no instant"),
    ],
)
def test_a_start_that_is_no_instant_is_the_only_fault(start: Any, fault: str) -> None:
    with pytest.raises(InputError, match=fault) as caught:
        parse_scenario({**document(), "start": start})
    assert len(caught.value.faults) == 1


def test_a_time_of_day_needs_a_start() -> None:
    wrong = document()
    del wrong["start"]
    with pytest.raises(InputError) as caught:
        parse_scenario(wrong)
    assert "closures[0].from: '10:00' needs the start of the scenario" in str(caught.value)
    assert "jobs[0].due: '6:05:30' needs the start of the scenario" in str(caught.value)
