"""Facts have a kind and values; `report` has the words."""

import json
import pickle
from collections.abc import Collection
from fractions import Fraction

import pytest

from rightofway.check import check
from rightofway.facts import Fact, read_fact
from rightofway.model import RerouteReason, Status
from rightofway.report.facts import VALUE, FactWriter, list_texts, read_templates
from rightofway.report.judgement import describe_fault, write_fault
from tests.builders.fleets import grid_fleet
from tests.builders.plans import door_shifted

ROW = grid_fleet(["..."], [("N0", "N2")])


def test_values_are_shown_in_the_forms_that_the_template_names() -> None:
    writer = FactWriter(ROW)
    text = writer.fill(
        "{who:robot} at {where:vertex} for {long:duration}, {part}, {far:length}",
        {
            "who": 0,
            "where": 2,
            "long": 3,
            "part": Fact("until", end=7),
            "far": Fraction(1, 2),
        },
    )
    assert text == "R1 at N2 for 3 time units, until 7, 0.5 length units"
    assert text.template == "{who} at {where} for {long}, {part}, {far}"


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
        "R1 and R1 would both have to stay at N0 for ever",
        "R1, R1 and R1 would all have to stay at N0 for ever",
    ]


def test_a_number_with_a_noun_is_a_fact_of_its_own() -> None:
    writer = FactWriter(None)
    assert writer.fill("{n:n_vertices}", {"n": 1}) == "1 vertex"
    assert writer.fill("{n:n_other_places}", {"n": 2}) == "2 other places"


@pytest.mark.parametrize(("kind", "values"), [*Status.KINDS.items(), *RerouteReason.KINDS.items()])
def test_a_fact_of_plan_files_has_a_template_with_its_values(
    kind: str, values: Collection[str]
) -> None:
    texts = read_templates()["facts"][kind]
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


@pytest.mark.parametrize("text", [text for text in list_texts() if VALUE.search(text)])
def test_values_of_facts_have_known_forms(text: str) -> None:
    """A form is one of the writer, or a fact about a number of things."""
    known = {*FactWriter(ROW)._forms, *read_templates()["facts"]}
    assert {form for _, form in VALUE.findall(text)} <= known


@pytest.mark.parametrize("kind", read_templates()["faults"])
def test_a_fault_has_a_reason_and_a_remedy_whose_forms_are_known(kind: str) -> None:
    texts = read_templates()["faults"][kind]
    known = FactWriter(ROW)._forms
    for part in ("reason", "remedy"):
        assert {form for _, form in VALUE.findall(texts[part])} <= set(known)


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
    text = FactWriter(None).fill(
        "{top:decimal} m/s, {apart:rounded} m", {"top": 1.0, "apart": 2 / 3}
    )
    assert text == "1 m/s, 0.667 m"


@pytest.mark.parametrize("kind", read_templates()["facts"])
def test_the_forms_of_a_template_are_known(kind: str) -> None:
    """A form that is no form of values is a fact about a number of things."""
    known = {*FactWriter(ROW)._forms, *read_templates()["facts"]}
    given = read_templates()["facts"][kind]
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
