"""Plans that simulated robots drive for the studio: each in a worker, with a journal and a page."""

from __future__ import annotations

import asyncio
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from rightofway.control.journal import SqliteJournal
from rightofway.io import parse_plan
from rightofway.io.json_text import parse_json
from rightofway.studio.crew import Crew, WorkerCall
from rightofway.studio.errors import Busy, Refused, TaskFailed
from rightofway.studio.watching import Watched

MAX_DRIVES = 4
"""Plans that are driven at once."""

MAX_LISTED = 50
"""Drives that are kept; the earliest that has ended gives way to a new one."""


@dataclass(slots=True, kw_only=True)
class Drive:
    """A plan that is driven, or was.

    Attributes
    ----------
    number, run
        Its number, and that of the run whose plan it is.
    job, page
        The job that drives it, and the page that shows it.
    state
        ``driving``, until robots have come to their ends (``done``), somebody ends it (``stopped``)
        or it fails.
    error
        Why it failed.
    """

    number: int
    run: int
    job: WorkerCall
    page: Watched
    state: Literal["driving", "done", "stopped", "failed"] = "driving"
    error: dict[str, Any] | None = None

    def describe(self) -> dict[str, Any]:
        """Return its entry in the API."""
        return {
            "number": self.number,
            "run": self.run,
            "state": self.state,
            "error": self.error,
            "page": f"/drives/{self.number}/",
        }


class Drives:
    """The drives of a studio; they end with it.

    Parameters
    ----------
    folder, scratch
        The folder of the studio, and one for journals.
    """

    def __init__(self, folder: Path, scratch: str) -> None:
        self.pages: dict[int, Watched] = {}
        self._crew = Crew(folder, scratch, size=MAX_DRIVES, queue=1)
        self._scratch = Path(scratch)
        self._drives: dict[int, Drive] = {}
        self._tasks: dict[int, asyncio.Task[None]] = {}
        self._latest = 0

    def list_all(self) -> list[Drive]:
        """Return all drives, the latest first."""
        return [*reversed(self._drives.values())]

    def get(self, number: int) -> Drive:
        """Return a drive; `Refused` if there is none of that number."""
        if number not in self._drives:
            raise Refused(f"there is no drive {number} (see the list of drives)", 404)
        return self._drives[number]

    async def start(self, run: int, plan: bytes, title: str, settings: dict[str, Any]) -> Drive:
        """Have simulated robots drive a plan; return as soon as they do.

        Raises
        ------
        Busy
            If too many plans are driven already.
        TaskFailed
            If the plan cannot be driven, or not with these delays.
        """
        if sum(drive.state == "driving" for drive in self._drives.values()) >= MAX_DRIVES:
            raise Busy(f"{MAX_DRIVES} plans are driven already (stop one)")
        self._latest += 1
        number, journal = self._latest, self._scratch / f"drive-{self._latest}.journal"
        opened = await asyncio.to_thread(lambda: parse_plan(parse_json(plan.decode())))
        SqliteJournal(journal).close()  # a page reads what is there
        begun = asyncio.Event()
        drive = Drive(
            number=number,
            run=run,
            job=WorkerCall(
                "drive",
                {**settings, "journal": str(journal)},
                [plan],
                limit=float("inf"),
                on_event=lambda _event, _blobs: begun.set(),
            ),
            page=Watched(
                opened, journal, title=title, address=f"/drives/{number}/", takes_orders=True
            ),
        )
        work = self._tasks[number] = asyncio.create_task(self._follow(drive))
        beginning = asyncio.create_task(begun.wait())
        await asyncio.wait({work, beginning}, return_when=asyncio.FIRST_COMPLETED)
        beginning.cancel()
        if drive.error:
            self._drop_drive(drive)
            raise TaskFailed(drive.error)
        return drive

    async def _follow(self, drive: Drive) -> None:
        """Wait until a drive ends, and note how."""
        self._drives[drive.number] = drive
        self.pages[drive.number] = drive.page
        ended = [other for other in self._drives.values() if other.state != "driving"]
        for other in ended[: max(len(self._drives) - MAX_LISTED, 0)]:
            self._drop_drive(other)
        try:
            await self._crew.do(drive.job)
            drive.state = "done"
        except TaskFailed as failed:
            if drive.state != "stopped":
                drive.state, drive.error = "failed", failed.error

    def _drop_drive(self, drive: Drive) -> None:
        drive.page.hang_up()
        self.pages.pop(drive.number, None)
        self._drives.pop(drive.number, None)
        self._tasks.pop(drive.number, None)

    async def stop(self, number: int) -> Drive:
        """End a drive; its page stays, and plays the past."""
        drive = self.get(number)
        if drive.state == "driving":
            drive.state = "stopped"
            drive.job.kill()  # a journal stands whenever its process ends
            await asyncio.gather(self._tasks[number], return_exceptions=True)
        return drive

    async def close(self) -> None:
        """End all drives, and the streams of their pages."""
        for drive in self.list_all():
            await self.stop(drive.number)
            self._drop_drive(drive)
        await self._crew.close()

    def hang_up(self) -> None:
        """End the streams of all pages."""
        for page in self.pages.values():
            page.hang_up()
