"""When the visits of a robot began, told by the few that were late."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import overload

import numpy as np
from numpy.typing import DTypeLike, NDArray

from rightofway.cyclic.route import CyclicRoute

__all__ = ["VisitTimes"]


class VisitTimes(Sequence[int]):
    """The ticks at which a robot's visits began, from visit 0 on; like a tuple of them.

    Parameters
    ----------
    endless
        What the robot repeats.
    begun
        How many visits have begun.
    late
        The numbers of visits before which the robot waited, int32[K].
    waited
        How long it had waited by then in all, int64[K] [ticks].
    """

    __slots__ = ("_begun", "_endless", "_first", "_late", "_waited")

    def __init__(
        self, endless: CyclicRoute, begun: int, late: NDArray[np.int32], waited: NDArray[np.int64]
    ) -> None:
        self._endless = endless
        self._begun = begun
        self._late = late
        self._waited = np.concatenate(([0], waited))
        self._first = self.enters(range(0))

    def __len__(self) -> int:
        return self._begun

    @overload
    def __getitem__(self, index: int) -> int: ...
    @overload
    def __getitem__(self, index: slice) -> tuple[int, ...]: ...
    def __getitem__(self, index: int | slice) -> int | tuple[int, ...]:
        visits = range(self._begun)[index]
        if isinstance(visits, range):
            return tuple(self.enters(visits).tolist())
        if visits == self._begun - 1:
            return int(self.enters(range(visits, visits + 1))[0])
        if visits >= len(self._first):  # who asks for one soon asks for another one
            self._first = self.enters(range(min(2 * visits + len(self._endless.lap), self._begun)))
        return int(self._first[visits])

    def __iter__(self) -> Iterator[int]:
        return iter(self.enters(range(self._begun)).tolist())

    def __array__(
        self, dtype: DTypeLike | None = None, copy: bool | None = None
    ) -> NDArray[np.int64]:
        return self.enters(range(self._begun)).astype(dtype or np.int64, copy=bool(copy))

    def enters(self, visits: range) -> NDArray[np.int64]:
        """Return when some visits began [ticks]."""
        if not visits:
            return np.empty(0, np.int64)
        if visits.step != 1:
            numbers = np.arange(visits.start, visits.stop, visits.step)
            waits = np.searchsorted(self._late, numbers, side="right")
            return self._endless.free(numbers) + self._waited[waits]
        first, stop = np.searchsorted(self._late, (visits.start, visits.stop - 1), side="right")
        sizes = np.diff(self._late[first:stop], prepend=visits.start, append=visits.stop)
        waited: NDArray[np.int64] = np.repeat(self._waited[first : stop + 1], sizes)
        return self._endless.free_from(visits) + waited
