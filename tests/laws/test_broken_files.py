"""Whatever is in a file: a value, or an error of ours that can be printed, soon."""

from pathlib import Path

import pytest

from rightofway.errors import InputError
from rightofway.io import read_layout
from tests.builders.broken_files import BOMBS, Outcome, limited, main, outcome_of, seeds

FORMATS = {
    "scenario", "plan", "suite", "workbook", "robots CSV", "MovingAI", "ROS map", "Nav2", "LIF",
    "Open-RMF graph", "Open-RMF building", "openTCS", "GraphML", "CSV pair", "foreign plan",
}  # fmt: skip


def test_the_files_that_are_broken_are_read_as_they_are(tmp_path: Path) -> None:
    """Or else nothing behind the first check would ever be reached."""
    for index, source in enumerate(seeds()):
        folder = tmp_path / str(index)
        folder.mkdir()
        for name, content in {**source.beside, source.name: source.content}.items():
            (folder / name).write_bytes(content)
        source.read(folder / source.name)
    assert {source.format for source in seeds()} == FORMATS


def test_broken_files_are_refused_in_words_and_soon() -> None:
    """The first files of a seed; `just fuzz-files COUNT` breaks as many as one likes."""
    found = outcome_of(0, range(150))
    assert found.failed == []
    assert found.slowest[0] < 5


@pytest.mark.slow
def test_more_broken_files_are_refused_in_words_and_soon(law_seed: int) -> None:
    found = Outcome()
    found.add(outcome_of(law_seed, range(1500)))
    assert found.failed == [], f"seed {law_seed}"
    assert found.read.keys() | found.refused.keys() == FORMATS
    assert found.read.total() > 75  # a twentieth: breaking is no mere rubbish


@pytest.mark.slow
def test_the_campaign_says_what_it_did(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["60", "--seed", "7", "--first", "40"]) == 0
    first, *_, last = capsys.readouterr().out.splitlines()
    assert first == "seed 7"
    assert last.startswith("60 files of seed 7: ")
    assert " 0 failed; " in last


@pytest.mark.slow
@pytest.mark.parametrize("number", range(len(BOMBS)))
@pytest.mark.parametrize("name", ["bomb.json", "bomb.yaml", "bomb.xml", "nodes.csv", "bomb.map"])
def test_bombs_are_refused_soon(tmp_path: Path, name: str, number: int) -> None:
    path = tmp_path / name
    path.write_bytes(BOMBS[number])
    with limited(5), pytest.raises(InputError):
        read_layout(path)
