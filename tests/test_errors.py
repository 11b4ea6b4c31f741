"""A fault says where it is: parts that are known one by one, and text that is made of them."""

import pickle
from collections.abc import Mapping

from rightofway.errors import (
    Blockage,
    InputError,
    InputFault,
    Location,
    NoPlanExists,
    Steps,
    Where,
    format_path,
    locate_faults,
    name_file,
)
from rightofway.facts import Fact

Starts = Mapping[Steps, Where]


def test_a_path_is_written_as_people_read_it() -> None:
    assert format_path(("robots", 3, "stops", 0, "work")) == "robots[3].stops[0].work"
    assert format_path(("map", "roadmap", "vertices", "bay 2")) == "map.roadmap.vertices['bay 2']"
    assert format_path(("--step",)) == "--step"
    assert format_path(("vertex 'a'", "barred", 0)) == "vertex 'a': barred[0]"


def test_a_location_begins_with_the_file_and_the_line() -> None:
    names = ("", "R4", "")
    whole = Location(path=("robots", 3, "speed"), file="hall.yaml", line=7, names=names)
    assert str(whole) == "hall.yaml:7: robots[3] (R4): speed"
    assert whole.place == "robots[3].speed"
    assert whole.about == "R4: speed"
    assert str(Location(file="hall.xlsx", cell="robots!C4")) == "hall.xlsx: robots!C4"
    assert str(Location(line=7)) == "line 7"


def test_a_fault_in_a_file_that_a_document_names_has_both_places() -> None:
    try:
        with name_file("hall.yaml"), locate_faults(("robots", "scen")), name_file("hall.scen"):
            raise InputError.at(Location(line=3, path=("goal",)), "is a wall")
    except InputError as error:
        (fault,) = error.faults
    assert str(fault) == "hall.yaml: robots.scen: hall.scen:3: goal: is a wall"
    assert (fault.path, fault.file, fault.message) == (("robots", "scen"), "hall.yaml", "is a wall")
    assert fault.location.inner == Location(path=("goal",), file="hall.scen", line=3)


def test_the_other_place_of_a_fault_moves_with_it() -> None:
    """In a document it is a robot nearby, in a workbook a cell, in a CSV table a line."""
    fault = InputFault((1, "name"), "R1 is the name of {other} already", other=0).nest("robots")
    assert str(fault) == "robots[1].name: R1 is the name of robots[0] already"
    rows: Starts = {("robots", k): Location(file="r.csv", line=k + 2) for k in (0, 1)}
    assert str(fault.relocate(rows)) == "r.csv:3: name: R1 is the name of line 2 already"
    cells: Starts = {("robots", k): Location(cell=f"robots!A{k + 2}") for k in (0, 1)}
    assert fault.relocate(cells).message == "R1 is the name of robots!A2 already"


def test_the_longest_known_start_of_a_path_is_relocated() -> None:
    starts: Starts = {("robots",): "fleet", ("robots", 0, "laps"): ("rules", "laps")}
    faults = [InputFault(("robots", 0, key), "?").relocate(starts) for key in ("laps", "speed")]
    assert [fault.path for fault in faults] == [("rules", "laps"), ("fleet", 0, "speed")]
    assert InputFault("map", "?").relocate(starts).path == ("map",)


def test_a_fault_comes_from_another_process_as_it_was() -> None:
    error = InputError([InputFault(("robots", 1), "of {other}", other=("robots", 0))], "hall.yaml")
    copy = pickle.loads(pickle.dumps(error))  # noqa: S301 (our own bytes)
    assert copy.faults == error.faults
    assert str(copy) == str(error) == "hall.yaml: robots[1]: of robots[0]"


def test_many_blockages_are_one_fact_of_the_first_ones() -> None:
    error = NoPlanExists([Blockage(f"{name} is cut off", remedy="move it") for name in "ABCDEF"])
    text = "; ".join(f"{name} is cut off (move it)" for name in "ABCD")
    assert str(error.explain()) == f"{text}; and 2 more"


def test_messages_on_inputs_are_text_in_a_fact() -> None:
    assert InputError.at("job", "is unknown").explain() == Fact("other", text="job: is unknown")
