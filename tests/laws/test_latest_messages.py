"""The queue of a control: bounded, and the latest message of each topic is always taken."""

from __future__ import annotations

import asyncio
from types import SimpleNamespace
from typing import Any

from hypothesis import strategies as st

from rightofway.control.broker import LatestMessages
from tests.builders.laws import law

TOPICS = ("R1/state", "R1/connection", "R2/state")

steps = st.lists(st.one_of(st.sampled_from(TOPICS), st.none()), max_size=100)
"""Messages that come, by their topics; None where the control takes one."""


@law(steps)
def test_a_message_waits_only_until_a_newer_one_of_its_topic_comes(given: list[str | None]) -> None:
    """Each is taken in its order among those of its topic, and none of a topic waits for ever."""

    async def run() -> tuple[list[Any], dict[str, int]]:
        queue, taken, latest = LatestMessages(), list[Any](), dict[str, int]()
        for number, topic in enumerate(given):
            if topic is not None:
                queue.put_nowait(SimpleNamespace(topic=topic, number=number))
                latest[topic] = number
            elif not queue.empty():
                taken.append(await queue.get())
            assert queue.qsize() <= len(TOPICS)
        while not queue.empty():
            taken.append(await queue.get())
        return taken, latest

    taken, latest = asyncio.run(run())
    for topic in TOPICS:
        numbers = [message.number for message in taken if message.topic == topic]
        assert numbers == sorted(numbers)
        assert numbers[-1:] == ([latest[topic]] if topic in latest else [])
