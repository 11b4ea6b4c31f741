"""What a user is told about a bad scenario file; each file says so in its own comments."""

from pathlib import Path

import pytest

from rightofway.errors import InputError
from rightofway.io import load

BAD = Path(__file__).parents[1] / "data" / "bad"


@pytest.mark.parametrize("path", sorted(BAD.glob("*.yaml")), ids=lambda path: path.stem)
def test_every_fault_is_told_with_place_value_and_remedy(path: Path) -> None:
    lines = path.read_text(encoding="utf-8").splitlines()
    expected = [
        line.removeprefix("# expect: ").replace("{here}", str(BAD))
        for line in lines
        if line.startswith("# expect: ")
    ]
    with pytest.raises(InputError) as caught:
        load(path)
    assert str(caught.value).splitlines() == [f"{path}: {line}" for line in expected]
