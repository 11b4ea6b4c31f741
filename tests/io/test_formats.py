"""The JSON Schemas say what the readers take."""

import copy
import json
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from rightofway.dispatch import ShiftRecord, record_file
from rightofway.dispatch.record_file import dump_shift, parse_shift
from rightofway.errors import InputError
from rightofway.io import dump_plan, load, make_schema, parse_plan
from rightofway.io.documents import parse_document
from rightofway.io.scenario.loaded_map import LoadedMap
from rightofway.io.scenario.work import read_job
from rightofway.io.yaml_text import parse_yaml
from rightofway.model import Job, Plan, PlannerRun, Track
from tests.builders.shifts import draw_shift, make_shift

ROOT = Path(__file__).parents[2]
EXAMPLES = sorted((ROOT / "examples").glob("*.yaml"))
BY_SHAPE = [
    "missing-keys",
    "no-format",
    "speeds",
    "two-of-a-kind",
    "unknown-keys",
    "version",
    "wrong-types",
]


def fits(document: Any, kind: Any) -> bool:
    validator = jsonschema.Draft202012Validator(make_schema(kind))
    return bool(validator.is_valid(document))


@pytest.mark.parametrize("kind", ["scenario", "plan", "shift"])
def test_a_schema_is_a_schema_and_says_what_each_key_is_for(kind: Any) -> None:
    jsonschema.Draft202012Validator.check_schema(make_schema(kind))
    format_name = make_schema(kind)["properties"]["format"]
    names = format_name.get("enum", [format_name.get("const")])
    assert names[0] == f"rightofway-{kind}/1"
    for document in (make_schema(kind), *make_schema(kind)["$defs"].values()):
        for described in document.get("properties", {}).values():
            assert described["description"]


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_every_example_fits(path: Path) -> None:
    assert fits(parse_document(path.read_text("utf-8"), path), "scenario")


def every(jobs: tuple[Job, ...]) -> tuple[tuple[int, str], ...]:
    """Return all jobs as not served."""
    return tuple((index, "not found") for index in range(len(jobs)))


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_every_plan_that_is_written_fits(path: Path) -> None:
    scenario = load(path)
    homes = tuple(Track.of([robot.home], [0]) for robot in scenario.robots)
    run, jobs = PlannerRun(name="nobody moves"), scenario.jobs
    idle: dict[str, Any] = (
        {} if jobs is None else {"tours": ((),) * len(homes), "unserved": every(jobs)}
    )
    plan = Plan(scenario=scenario, tracks=homes, run=run, **idle)
    assert fits(dump_plan(plan), "plan")
    assert parse_plan(dump_plan(plan)) == plan


@pytest.mark.parametrize("shift", [make_shift(), make_shift(8), draw_shift(3)])
def test_every_shift_that_is_written_fits(shift: ShiftRecord) -> None:
    document = json.loads(json.dumps(dump_shift(shift)))
    assert fits(document, "shift")
    assert dump_shift(parse_shift(document)) == document


def test_jobs_of_a_shift_that_are_those_of_its_scenario_are_read_once(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A file of 21 MB has 10 000 jobs, each of them up to three times."""
    document = json.loads(json.dumps(dump_shift(make_shift())))
    read = list[str]()

    def note_and_read(data: Any, on: LoadedMap) -> Job:
        read.append(data["name"])
        return read_job(data, on)

    monkeypatch.setattr(record_file, "read_job", note_and_read)
    parse_shift(document)
    assert not read
    document["jobs"][1]["job"]["due"] = 77
    changed = parse_shift(document).jobs[document["jobs"][1]["job"]["name"]]
    assert read == [changed.job.name]
    assert changed.job.due == 77


def test_a_shift_is_refused_with_every_fault_and_its_place() -> None:
    document = json.loads(json.dumps(dump_shift(make_shift())))
    document["until"] = "late"
    document["robots"][0]["soc"] = [[1]]
    document["jobs"][1]["reason"] = "no"
    del document["rounds"][0]["facts"]
    assert not fits(document, "shift")
    with pytest.raises(InputError) as caught:
        parse_shift(document)
    assert [str(fault).partition(" (give")[0] for fault in caught.value.faults] == [
        "until: 'late' is not a whole number",
        "robots[0].soc[0][1]: is missing",
        "jobs[1].reason: 'no' does not fit",
        "rounds[0].facts: is missing",
    ]


@pytest.mark.parametrize("name", BY_SHAPE)
def test_what_is_bad_by_its_shape_does_not_fit(name: str) -> None:
    assert not fits(
        parse_yaml((ROOT / "tests" / "data" / "bad" / f"{name}.yaml").read_text("utf-8")),
        "scenario",
    )


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("speed", 0),
        ("speed", -1),
        ("speed", "-1/2"),
        ("speed", "fast"),
        ("speed", None),
        ("speed", True),
        ("work", -1),
        ("turn", "cel"),
        ("return", "away"),
        ("laps", 0),
        ("laps", 1.5),
        ("home", 5),
        ("home", [1]),
        ("home", [0.5, 1]),
        ("name", ""),
        ("stops", []),
    ],
)
def test_a_wrong_value_does_not_fit(key: str, value: Any) -> None:
    document = copy.deepcopy(parse_yaml(EXAMPLES[1].read_text("utf-8")))
    assert fits(document, "scenario")
    document["robots"][0][key] = value
    assert not fits(document, "scenario")


def test_there_is_no_schema_of_anything_else() -> None:
    message = r"kind: 'fleet' is unknown \(give plan, scenario, shift or suite\)"
    with pytest.raises(InputError, match=message):
        make_schema("fleet")  # type: ignore[arg-type]
