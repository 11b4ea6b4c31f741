"""What planners can be told."""

import pytest

from rightofway.errors import InputError
from rightofway.planners import Choice, Count

WORD = Choice("order", ("file", "random"), "In which order.")
NUMBER = Count("rounds", 5, 1, "How often.")


def test_a_choice_is_one_of_its_words_and_the_first_by_default() -> None:
    assert (WORD.default, WORD.read("random"), WORD.accepts) == ("file", "random", "file|random")
    with pytest.raises(InputError, match=r"option order: 'x' is not a choice \(give one of: file,"):
        WORD.read("x")


@pytest.mark.parametrize("given", [7, "7"])
def test_a_count_is_a_whole_number_however_it_is_written(given: object) -> None:
    assert NUMBER.read(given) == 7


@pytest.mark.parametrize("given", ["0", "-1", "1.5", "", "many", "\u00b2", True])
def test_a_count_refuses_what_is_none_or_too_small(given: object) -> None:
    with pytest.raises(InputError, match=r"option rounds: '.*' is not a whole number of 1 or more"):
        NUMBER.read(given)
