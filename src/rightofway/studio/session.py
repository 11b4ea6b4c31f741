"""The parts of one studio: a folder, a store, two crews and the runs."""

from __future__ import annotations

import asyncio
import json
import tempfile
from pathlib import Path
from typing import Any

from rightofway.errors import InputError
from rightofway.io.plain_data import check_depth
from rightofway.studio.crew import Crew, WorkerCall
from rightofway.studio.driving import Drives
from rightofway.studio.runs import Runs
from rightofway.studio.shared import SharedAnswers
from rightofway.studio.store import Store
from rightofway.studio.workspace import Workspace

DESK = 2
"""Workers that answer requests."""

DESK_QUEUE = 200
"""Requests that may wait for them."""

DESK_LIMIT = 60.0
"""The time after which a request ends, and its worker with it [s]."""

PLAYED = 40_000_000
"""Payloads of plans that are kept in memory, because many browsers watch the same ones [bytes]."""

GLANCED = 20_000_000
"""Glances at files that are kept in memory [bytes]."""


class Studio:
    """A studio for one folder.

    Parameters
    ----------
    folder
        The folder.
    file
        The file in it that pages open first, if any.
    planners
        How many runs go on at once.
    keeps
        Whether drafts and runs are kept in the folder, where it can be written.
    """

    def __init__(
        self, folder: Path, *, file: str | None = None, planners: int = 1, keeps: bool = True
    ) -> None:
        self.workspace = Workspace(folder)
        self.file = file
        self.store = Store(self.workspace.folder if keeps else None)
        self._scratch = tempfile.TemporaryDirectory(prefix="rightofway-studio-")
        place = self.workspace.folder, self._scratch.name
        self.desk = Crew(*place, size=DESK, queue=DESK_QUEUE)
        self.planners = Crew(*place, size=planners, queue=planners)
        self.played = SharedAnswers(PLAYED)
        self.glanced = SharedAnswers(GLANCED)
        self.glancing = asyncio.Semaphore(1)  # so that a list of files delays no other request
        self.runs = Runs(self.store, self.planners, self.desk)
        self.drives = Drives(*place)

    async def start(self) -> None:
        """Start workers, and resume open runs."""
        await asyncio.to_thread(self.workspace.remove_abandoned)
        await self.desk.start()
        await self.planners.start()
        await self.runs.start()

    async def close(self) -> None:
        """End everything."""
        await self.drives.close()
        await self.runs.close()
        await self.planners.close()
        await self.desk.close()
        self.store.close()
        self._scratch.cleanup()

    def place(self, folder: str) -> str:
        """Return a folder of a document as workers know it; `Refused` if it climbs out."""
        if not folder:
            return "."
        self.workspace.find_path(folder)
        return folder

    async def ask(self, task: str, *blobs: bytes, **arguments: Any) -> tuple[Any, list[bytes]]:
        """Have the desk do a task, and return its result and blobs.

        Raises
        ------
        InputError
            If the arguments cannot be sent.
        TaskFailed, Busy
            As `Crew.do`.
        """
        check_json(arguments)
        return await self.desk.do(WorkerCall(task, arguments, blobs, limit=DESK_LIMIT))


def check_json(data: Any) -> bytes:
    """Return data as JSON; InputError for values that JSON cannot hold."""
    check_depth(data)
    try:
        text = json.dumps(data, allow_nan=False)
        json.dumps(data, ensure_ascii=False).encode()
    except UnicodeEncodeError:
        raise InputError.at("", "a text has half of a character (write it in UTF-8)") from None
    except ValueError:
        raise InputError.at("", "a number is not finite (give a plain one)") from None
    return text.encode()
