"""What a user is told about a bad scenario file; each file says so in its own comments."""

import re
from pathlib import Path

import pytest

from rightofway.errors import InputError
from rightofway.io import load, load_plan

EXPECTED = re.compile(r"^# expect ?(\d*): (.*)$", re.MULTILINE)
BAD = Path(__file__).parents[1] / "data" / "bad"


@pytest.mark.parametrize("path", sorted(BAD.glob("*.yaml")), ids=lambda path: path.stem)
def test_every_fault_is_told_with_line_place_value_and_remedy(path: Path) -> None:
    """A file says ``# expect 7: …`` for a fault in line 7, and ``# expect: …`` for one in none.

    ``…`` in a message is any text.
    """
    expected = [
        f"{path}{':' if line else ''}{line}: {fault}".replace("{here}", str(BAD))
        for line, fault in EXPECTED.findall(path.read_text(encoding="utf-8"))
    ]
    with pytest.raises(InputError) as caught:
        load(path)
    messages = str(caught.value).splitlines()
    assert len(messages) == len(expected)
    for message, fault in zip(messages, expected, strict=True):
        assert re.fullmatch(re.escape(fault).replace("…", ".*"), message)


PROSE = "# Notes\n\n**Robots**: two\n"
"""No YAML: an asterisk begins an alias there."""


@pytest.mark.parametrize(
    ("name", "content", "fault"),
    [
        ("notes.md", PROSE, f"{PROSE!r} is no KIND (begin with format: rightofway-KIND/1)"),
        ("notes.txt", "two", "'two' is no KIND (begin with format: rightofway-KIND/1)"),
        ("page.html", "<!doctype html>\n0:(1,2)\n", "this is a page (give the scenario or the"),
        ("fleet.csv", "name;home\nR1;N0\n", "a table of robots has no map (write a scenario"),
    ],
)
def test_a_file_of_another_kind_is_told_what_is_wanted(
    tmp_path: Path, name: str, content: str, fault: str
) -> None:
    path = tmp_path / name
    path.write_text(content, encoding="utf-8")
    for read, kind in ((load, "scenario"), (load_plan, "plan")):
        with pytest.raises(InputError) as caught:
            read(path)
        assert str(caught.value).startswith(f"{path}: {fault.replace('KIND', kind)}")


def test_a_scenario_under_another_name_is_read_as_one(tmp_path: Path) -> None:
    path = tmp_path / "hall.txt"
    path.write_text("# a hall\nformat: rightofway-scenario/1\nmap: {grid: [...\n", encoding="utf-8")
    with pytest.raises(InputError, match=r"hall\.txt:4: .* \(check the YAML there\)"):
        load(path)
