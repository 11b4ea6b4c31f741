"""What a user is told about a bad scenario file; each file says so in its own comments."""

import re
from pathlib import Path

import pytest

from rightofway.errors import InputError
from rightofway.io import load

EXPECTED = re.compile(r"^# expect ?(\d*): (.*)$", re.MULTILINE)
BAD = Path(__file__).parents[1] / "data" / "bad"


@pytest.mark.parametrize("path", sorted(BAD.glob("*.yaml")), ids=lambda path: path.stem)
def test_every_fault_is_told_with_line_place_value_and_remedy(path: Path) -> None:
    """A file says ``# expect 7: …`` for a fault in line 7, and ``# expect: …`` for one in none."""
    expected = [
        f"{path}{':' if line else ''}{line}: {fault}".replace("{here}", str(BAD))
        for line, fault in EXPECTED.findall(path.read_text(encoding="utf-8"))
    ]
    with pytest.raises(InputError) as caught:
        load(path)
    assert str(caught.value).splitlines() == expected
