"""Files to begin with: templates and examples."""

from __future__ import annotations

from pathlib import Path

import pytest

from rightofway.io import load_with_notes
from rightofway.report.examples import list_example_names
from tests.cli.conftest import EXAMPLES, Cli


def test_examples_are_listed_each_with_the_first_sentence_of_its_comment(cli: Cli) -> None:
    words = " ".join(cli("examples").out.split())
    assert "door Two robots share a door (the first case of the paper): one of them" in words
    assert all(name in words for name in list_example_names())


def test_an_example_is_printed_as_it_is(cli: Cli, door: Path) -> None:
    text = door.read_text(encoding="utf-8")
    for name in ("door", "door.yaml", "examples/door.yaml"):
        assert cli("examples", name).out == text
    assert cli("examples", "door", "-o", "-").out == text
    assert cli("examples", "cross-2").out == cli("examples", "paper/cross-2").out


def test_an_example_is_written_with_the_maps_that_it_names(cli: Cli) -> None:
    assert cli("examples", "warehouse", "-o", "w.yaml").code == 0
    assert (
        load_with_notes("w.yaml").scenario == load_with_notes(EXAMPLES / "warehouse.yaml").scenario
    )
    assert sorted(path.suffix for path in Path("maps").iterdir()) == [".map", ".scen"]


def test_a_map_of_ones_own_is_not_replaced_by_that_of_an_example(cli: Cli) -> None:
    Path("maps").mkdir()
    own = Path("maps/warehouse-10-20-10-2-1.map")
    own.write_text("mine", encoding="utf-8")
    ended = cli("examples", "warehouse", "-o", "w.yaml")
    assert (ended.code, "another file of this name exists" in ended.err) == (2, True)
    assert own.read_text(encoding="utf-8") == "mine"
    assert not Path("w.yaml").exists()


def test_all_examples_are_copied_to_a_folder_that_is_not_there_yet(cli: Cli) -> None:
    assert cli("examples", "--copy", ".").code == 0
    copied = {path.relative_to("examples") for path in Path("examples").rglob("*")}
    assert copied == {path.relative_to(EXAMPLES) for path in EXAMPLES.rglob("*")}
    again = cli("examples", "--copy", ".")
    assert (again.code, "examples: exists (give another folder" in again.err) == (2, True)


def test_an_example_that_is_not_copied_yet_is_answered_by_how_to_copy_it(cli: Cli) -> None:
    for name in ("plan", "bound", "collisions"):
        ended = cli(name, "examples/door.yaml")
        assert ended.code == 2
        assert (
            "examples/door.yaml: there is no such file (rightofway examples --copy ." in ended.err
        )


@pytest.mark.parametrize(
    ("args", "message"),
    [
        (["examples", "dor"], "'dor' is not an example (did you mean door?)"),
        (["examples", "door", "--copy", "."], "--copy copies all examples"),
        (["examples", "-o", "a.yaml"], "-o writes one example (give its name)"),
        (["new", "a.txt"], "'a.txt' does not end in"),
    ],
)
def test_bad_use_is_refused(cli: Cli, args: list[str], message: str) -> None:
    ended = cli(*args)
    assert (ended.code, message in ended.err) == (2, True)
    assert list(Path.cwd().iterdir()) == []


def test_a_new_scenario_can_be_planned_and_is_never_written_over_another_file(cli: Cli) -> None:
    assert cli("new", "hall.yaml").code == 0
    text = Path("hall.yaml").read_text(encoding="utf-8")
    assert "rightofway plan hall.yaml" in text
    assert cli("plan", "hall.yaml").code == 0
    again = cli("new", "hall.yaml")
    assert (again.code, "hall.yaml: the file exists" in again.err) == (2, True)
    assert Path("hall.yaml").read_text(encoding="utf-8") == text


@pytest.mark.parametrize(
    ("commented", "used"),
    [
        ("# units:", "units:"),
        ("  # cell_size: 1", "  cell_size: 1"),
        ("  # y: up ", "  y: up "),
        ("  # - {name: R3", "  - {name: R3"),
        ("[0, 2]", "{x: 2.5, y: 0.5}"),
        ("# rules: classic", "rules: classic"),
    ],
)
def test_what_a_template_has_in_comments_can_be_used(cli: Cli, commented: str, used: str) -> None:
    cli("new", "hall.yaml")
    text = Path("hall.yaml").read_text(encoding="utf-8")
    assert text.count(commented) == 1
    Path("hall.yaml").write_text(text.replace(commented, used), encoding="utf-8")
    assert cli("bound", "hall.yaml").code == 0


def test_the_rules_of_a_template_are_those_of_a_grid(cli: Cli) -> None:
    cli("new", "hall.yaml")
    text = Path("hall.yaml").read_text(encoding="utf-8")
    head, key, rules = text.partition("# rules:      ")
    used = head + key[2:] + rules.replace("\n#   ", "\n  ")
    Path("rules.yaml").write_text(used, encoding="utf-8")
    problems = [load_with_notes(name).scenario.problem for name in ("rules.yaml", "hall.yaml")]
    assert problems[0].itineraries == problems[1].itineraries
    assert problems[0].booking_rules.headway == problems[1].booking_rules.headway
