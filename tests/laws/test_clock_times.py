"""Times of day are exact: what is written is read as the same time, with any start and unit."""

from __future__ import annotations

import json
from datetime import datetime, timedelta, timezone
from fractions import Fraction
from typing import Any, cast

from hypothesis import strategies as st

from rightofway.model import StopAction
from rightofway.units import SECONDS, TimeUnit, Units
from tests.builders.laws import law

offsets = st.none() | st.integers(-14 * 60, 14 * 60).map(
    lambda minutes: timezone(timedelta(minutes=minutes))
)
starts = st.builds(
    lambda moment, zone: moment.replace(tzinfo=zone),
    st.datetimes(datetime(1971, 1, 1), datetime(2200, 1, 1)),  # noqa: DTZ001 (the zone is drawn)
    offsets,
)
times = st.fractions(0, 10**6, max_denominator=1000) | st.integers(0, 10**7).map(Fraction)

numbers = st.integers(-(10**12), 10**12) | st.decimals(-1000, 1000, places=3).map(float)
values = st.recursive(
    st.booleans() | st.text(max_size=5) | numbers,
    lambda inner: (
        st.lists(inner, max_size=3)
        | st.dictionaries(st.sampled_from(["a", "b c", "é"]), inner, max_size=3)
    ),
    max_leaves=8,
)


@law(starts, st.sampled_from(sorted(SECONDS)), times)
def test_a_time_that_is_written_is_read_as_the_same_time(
    start: datetime, unit: str, time: Fraction
) -> None:
    units = Units(time=cast("TimeUnit", unit), start=start)
    assert Units(time=units.time, start=cast("Any", units.to_document()["start"])) == units
    text = units.write_clock_time(time)
    micro = time * SECONDS[unit] * 10**6
    assert (text is None) == (micro.denominator != 1)
    if text is None:
        return
    assert units.read_clock_time(text) == time
    seconds = timedelta(microseconds=int(micro))
    at_utc = timezone(timedelta(0))
    if start.tzinfo is not None:  # the same instant with another offset
        moment = (start + seconds).astimezone(at_utc).isoformat()
        assert units.read_clock_time(moment.replace("+00:00", "Z")) == time


@law(starts, times, times)
def test_a_time_of_day_of_a_command_is_the_first_one_that_is_not_past(
    start: datetime, now: Fraction, time: Fraction
) -> None:
    units = Units(time="s", start=start)
    clock = (start + timedelta(seconds=int(time))).strftime("%H:%M:%S")
    if time.denominator != 1 or start.microsecond:
        return
    begin = start.strftime("%H:%M:%S")
    if clock < begin and now < 1:
        return  # it is before the start
    read = units.read_clock_time(clock, not_before=now)
    assert now <= read < now + 86400 or read < 86400
    assert (read - time) % 86400 == 0


@law(st.dictionaries(st.sampled_from(["side", "height", "x"]), values, max_size=3))
def test_parameters_of_an_action_are_the_same_in_files(parameters: dict[str, Any]) -> None:
    action = StopAction(action="pick", parameters=cast("Any", parameters))
    document = json.loads(json.dumps(action.to_document()))
    assert StopAction(**document) == action
    assert document.get("parameters", {}) == parameters
    assert hash(action) == hash(StopAction(**document))
