"""Facts have a kind and values; `report` has the words."""

import json
import pickle
from collections.abc import Collection
from fractions import Fraction

import pytest

from rightofway.check import check
from rightofway.facts import Fact, read_fact
from rightofway.languages import VALUE, read_texts
from rightofway.model import RerouteReason, Status
from rightofway.report.facts import FactWriter
from rightofway.report.judgement import describe_fault, write_fault
from rightofway.report.phrases import to_parts
from tests.builders.fleets import grid_fleet
from tests.builders.plans import door_shifted

KINDS = read_texts()["facts"]
ROW = grid_fleet(["..."], [("N0", "N2")])


def test_values_are_shown_in_the_forms_that_the_template_names() -> None:
    fact = Fact("too fast: reason", ROW, robot=0, tail=0, head=2, time=3, least=4)
    text = FactWriter(ROW).write(fact)
    assert text == "R1 drives from N0 to N2 in 3 time units, it needs 4 time units"
    assert to_parts(text) == [
        "too fast: reason",
        {
            "head": "N2",
            "least": ["n_time_units", {"number": "4"}],
            "robot": "R1",
            "tail": "N0",
            "time": ["n_time_units", {"number": "3"}],
        },
    ]


def test_a_fact_is_an_english_sentence_as_text() -> None:
    assert str(Fact("at vertex", vertex=1, about=ROW)) == "at N1"
    assert str(Fact("near a wall")) == "is nearer to a wall than the robot's radius"


def test_facts_are_equal_by_kind_and_values() -> None:
    one = Fact("until", end=7)
    assert one == Fact("until", about=ROW, end=7)
    assert hash(one) == hash(Fact("until", end=7))
    assert one != Fact("until", end=8)
    assert pickle.loads(pickle.dumps(one)) == one  # noqa: S301 (our own bytes)


def test_a_fact_has_a_template_for_each_number_of_things() -> None:
    remedies = [str(Fact("end elsewhere", number=number)) for number in (2, 3)]
    assert remedies == ["let one of them end elsewhere", "let others end elsewhere"]
    ends = [Fact("shared end", ROW, robots=robots, place=0) for robots in ((0, 0), (0, 0, 0))]
    assert list(map(str, ends)) == [
        "R1 and R1 would both have to stay at N0 permanently",
        "R1, R1 and R1 would all have to stay at N0 permanently",
    ]


def test_a_number_with_a_noun_is_a_fact_of_its_own() -> None:
    assert str(Fact("n_vertices", number=1)) == "1 vertex"
    assert str(Fact("busy around", fact="A is busy", vertices=2, least=0.5)) == (
        "A is busy; 2 vertices around it on 50 % or more"
    )


@pytest.mark.parametrize(("kind", "values"), [*Status.KINDS.items(), *RerouteReason.KINDS.items()])
def test_a_fact_of_plan_files_has_a_template_with_its_values(
    kind: str, values: Collection[str]
) -> None:
    texts = KINDS[kind]
    for text in [texts] if isinstance(texts, str) else texts.values():
        assert {name for name, _ in VALUE.findall(text)} <= {*values}


def test_a_reason_of_a_reroute_is_a_sentence() -> None:
    robots = {"one": "R1", "other": "R2", "place": "N4"}
    circle = RerouteReason("deadlock in circle", **robots, robots=["R1", "R2", "R3"])
    pair = "waiting cannot keep R1 and R2 apart at N4"
    assert str(RerouteReason("deadlock of two", **robots)) == pair
    assert str(circle) == f"{pair}: in a circle, R1, R2, R3 would each wait for the next"


def test_a_status_in_a_status_is_a_sentence_in_a_sentence() -> None:
    status = Status("then", first=Status("re-routed", robots=["R3", "R7"]), second="by hand")
    assert str(status) == "re-routed R3, R7; by hand"
    assert str(Status("within factor", factor=Fraction(3, 2))) == "within 1.5 of the optimum"
    assert [str(Status("best of orders", number=n, status=status)) for n in (1, 2)] == [
        f"{status}; best of 1 order",
        f"{status}; best of 2 orders",
    ]


def test_the_judge_returns_numbers_and_no_sentences() -> None:
    """R1 is a tick too early, so it meets R2."""
    fault = check(door_shifted(-1)).faults[0]
    assert all(isinstance(value, int | None) for value in fault.numbers.values())
    reason, remedy = describe_fault(fault)
    assert str(fault) == write_fault(fault)
    assert fault.message == f"{reason} ({remedy})"


def test_a_fact_is_the_same_after_json() -> None:
    fact = Fact("waits", robot="R1", place="A", arrivals=(Fact("place open", place="B"),))
    data = json.loads(json.dumps(fact.as_dict()))
    arrivals = [{"kind": "place open", "values": {"place": "B"}}]
    values = {"robot": "R1", "place": "A", "arrivals": arrivals}
    assert data == {"kind": "waits", "values": values}
    assert read_fact(data) == fact
    assert str(read_fact(data)) == "R1 waits at A until B is open"


def test_measured_numbers_have_few_digits() -> None:
    forms = FactWriter(None)._forms
    assert (forms["decimal"](1.0), forms["rounded"](2 / 3)) == ("1", "0.667")


@pytest.mark.parametrize("kind", KINDS)
def test_the_forms_of_a_template_are_known(kind: str) -> None:
    """A form that is no form of values is a fact about a number of things."""
    known = {*FactWriter(ROW)._forms, *(key for key in KINDS if key.startswith("n_"))}
    given = KINDS[kind]
    for template in [given] if isinstance(given, str) else given.values():
        assert {form for _, form in VALUE.findall(template)} <= known


PAIR = Fact("deadlock", one=0, other=0, place=Fact("place at time", name=1, what=3))
PAIR_TEXT = "waiting cannot keep R1 and R1 apart at N1 (time 3)"
HOMES = tuple(Fact("dealt home", robot=f"R{number}", place="P") for number in (1, 2))


@pytest.mark.parametrize(
    ("fact", "sentence"),
    [
        (Fact("runs done", done=3, runs=10), "3 of 10 runs"),
        (
            Fact("groups done", number=1, groups=4, robots=7),
            "1 of 4 groups done, the next one has 7 robots",
        ),
        (
            Fact("deadlock in a circle", ROW, deadlock=PAIR, robots=(0, 0, 0)),
            f"{PAIR_TEXT}: in a circle, R1, R1, R1 would each wait for the next",
        ),
        (
            Fact("no timetable", robots=3),
            "no timetable was found for 3 robots that have to do with each other (give more time)",
        ),
        (
            Fact("lap not followed", ROW, robot=0),
            "R1 was not followed for a whole lap (allow more time)",
        ),
        (
            Fact("many homes dealt out", number=7, places=9),
            "homes dealt out: 7 of 9 parking and charging places",
        ),
        (Fact("homes dealt out", homes=HOMES), "homes dealt out: R1 at P and R2 at P"),
    ],
)
def test_facts_of_work_and_homes_are_sentences(fact: Fact, sentence: str) -> None:
    assert str(fact) == sentence
