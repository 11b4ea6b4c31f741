"""Reports on trouble: each begin and each end in turn, and the last one is true."""

from __future__ import annotations

from collections import Counter

from hypothesis import strategies as st

from rightofway.control.journal import Entry
from rightofway.control.messages import Condition, RobotError
from rightofway.control.notices import BURST, FLOOD, REFILL, Notices
from rightofway.facts import Fact
from tests.builders.laws import law

KINDS = ("lost", "still", "pause", "error WARNING laser")
"""Kinds of trouble; the last two are in conditions."""

changes = st.lists(st.tuples(st.sampled_from(KINDS), st.booleans()), max_size=400)


def change(notices: Notices, present: dict[str, bool], kind: str, is_present: bool) -> None:
    """Let trouble begin or end; it may last already, or not."""
    present[kind] = is_present
    if kind in {"lost", "still"}:
        if is_present:
            notices.begin(0, kind, Fact("paused"), Fact("not paused"))
        else:
            notices.end(0, kind)
        return
    laser = RobotError(kind="laser", level="WARNING")
    notices.take(
        0,
        Condition(
            is_paused=present["pause"],
            errors=(laser,) if present["error WARNING laser"] else (),
        ),
    )


@law(changes, st.sampled_from([0.0, 0.5, REFILL, 60.0]))
def test_begins_and_ends_are_reported_in_turn_and_the_last_one_is_true(
    told: list[tuple[str, bool]], pause: float
) -> None:
    """With pauses between them each is reported; in a flood, those that there is room for."""
    kept, now = list[Entry](), 0.0
    notices = Notices(["R1"], lambda _: None, lambda: now, keep=kept.append)
    present, turns = dict.fromkeys(KINDS, False), Counter[str]()
    for kind, is_present in told:
        now += pause
        turns[kind] += present[kind] != is_present
        change(notices, present, kind, is_present)
    open_kinds = set[str]()
    for entry in kept:
        assert (entry["about"] in open_kinds) == entry["over"], entry
        open_kinds ^= {entry["about"]}
    reported = Counter(entry["about"] for entry in kept)
    if turns.total() <= BURST or pause >= REFILL:
        assert reported == +turns
    assert reported.total() <= BURST + 2 + len(told) * pause / REFILL
    now += BURST * REFILL
    notices.settle()
    lasts = {entry["about"]: entry["over"] for entry in kept if entry["about"] != FLOOD}
    assert {kind for kind, is_over in lasts.items() if not is_over} == {
        kind for kind in KINDS if present[kind]
    }
