"""Tasks that drive: simulated robots go by a plan, as by `rightofway drive --demo`."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from pathlib import Path

from rightofway.control.demo import drive_demo, make_pause
from rightofway.studio.messages import Blobs, Emit
from rightofway.studio.tasks.documents import Result
from rightofway.studio.tasks.views import read


def drive_plan(
    emit: Emit,
    blobs: Blobs,
    *,
    journal: str,
    delays: Sequence[str] = (),
    seed: int = 0,
    laps: int | None = None,
    time_scale: float = 1,
) -> Result:
    """Have simulated robots drive a plan to its end; send an event as soon as they do."""
    plan = read(blobs[0])
    pause = make_pause(plan, time_scale)
    has_begun = False

    def wait_until(moment: Fraction) -> None:
        nonlocal has_begun
        if not has_begun:
            has_begun = True
            emit({"drives": True})
        pause(moment)

    drive_demo(
        plan,
        delays,
        seed,
        laps=laps,
        wait_until=wait_until,
        journal=Path(journal),
        pace=time_scale,
    )
    return ({},)
