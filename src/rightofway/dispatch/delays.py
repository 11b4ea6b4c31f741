"""Delays of single stays and drives, drawn one by one while a shift goes on.

The n-th visit of a robot meets the same delay whatever its route, so that two dispatchers can be
compared under the same delays.
"""

from __future__ import annotations

import math
from random import Random

from rightofway.model import NEVER
from rightofway.precedence import DelayModel

__all__ = ["DelayDraws"]

LEAST, MOST = 0.01, 1e6
"""Limits of a duration, compared with the planned one."""


class DelayDraws:
    """The delays of a shift.

    Parameters
    ----------
    model
        The delays to draw from; ``breaks`` is a chance for the time until `until`.
    seed
        For all that is drawn.
    until
        The end of the shift [ticks].
    """

    def __init__(self, model: DelayModel, seed: int, until: int) -> None:
        self._model, self._seed = model, seed
        self.is_exact = not model.random and all(pace == 1 for pace in model.pace)
        self._stoppages = [list(own) for own in model.stoppages]
        for kind, chance, _ in model.random:
            for robot, own in enumerate(self._stoppages if kind == "breaks" else ()):
                random = self._make_random(robot, -1)
                if random.random() < chance:
                    own.append((int(random.random() * until), NEVER))  # type: ignore[arg-type]

    def stay(self, robot: int, visit: int, begin: int, ticks: int) -> int:
        """Return the end of a stay or of work in a visit that begins at a tick [ticks]."""
        return self._pause(robot, begin, self._lengthen(robot, 2 * visit, ticks))

    def drive(self, robot: int, visit: int, begin: int, ticks: int) -> int:
        """Return the end of the drive into a visit that begins at a tick [ticks]."""
        return self._pause(robot, begin, max(1, self._lengthen(robot, 2 * visit + 1, ticks)))

    def find_breakdown(self, robot: int) -> int:
        """Return when a robot breaks down, NEVER if it does not [ticks]."""
        own = self._stoppages[robot]
        return min((tick for tick, ticks in own if ticks >= NEVER), default=NEVER)

    def _make_random(self, robot: int, number: int) -> Random:
        return Random(((self._seed << 24 | robot) << 40) + number)  # noqa: S311

    def _lengthen(self, robot: int, number: int, ticks: int) -> int:
        """Return how long an action takes that is planned to take some ticks."""
        if self.is_exact:
            return ticks
        random, factor, more = self._make_random(robot, number), self._model.pace[robot], 0
        for kind, first, second in self._model.random:
            match kind:
                case "exponential":
                    factor += random.expovariate(1 / first) if first else 0
                case "uniform":
                    factor += random.uniform(first, second)
                case "normal":
                    factor += random.gauss(first, second)
                case "chance" if number % 2 == 0 and random.random() < first:
                    more += int(second)
        lasts = ticks * min(max(factor, LEAST), MOST)
        # The fraction of a tick is drawn, so that durations are exact on average.
        return math.floor(lasts + random.random()) + more

    def _pause(self, robot: int, begin: int, ticks: int) -> int:
        """Return the end of an action with the stoppages that fall into it [ticks]."""
        end = begin + ticks
        for tick, lasts in self._stoppages[robot]:
            if tick < end and begin < tick + lasts:
                if lasts >= NEVER:
                    return NEVER
                end += tick + lasts - max(begin, tick)
        return end
