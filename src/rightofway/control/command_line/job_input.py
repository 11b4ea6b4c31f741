"""Jobs from standard input: the rows of a CSV table, or a JSON object a line."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from rightofway.errors import InputError, name_file
from rightofway.io.content import read_text
from rightofway.io.faults import list_keys
from rightofway.io.tables import read_csv, read_jobs_of_rows

__all__ = ["read_jobs"]

INPUT = Path("-")


def read_jobs() -> list[dict[str, Any]]:
    """Return the jobs on standard input, with the keys of jobs in scenario files and `urgent`.

    Raises
    ------
    InputError
        If there are none, or a line cannot be read.
    """
    from rightofway.io.scenario.work_shape import JobDocument

    text = read_text(INPUT)
    if not text.lstrip().startswith("{"):
        rows, cell = read_csv(INPUT, ("jobs",))
        table = read_jobs_of_rows(rows, cell, [*list_keys(JobDocument), "urgent"])
        with table.locate():
            return list(table.part)
    jobs = list[dict[str, Any]]()
    for number, line in enumerate(text.splitlines(), 1):
        if not line.strip():
            continue
        try:
            job = json.loads(line)
        except (ValueError, RecursionError):
            job = None
        if not isinstance(job, dict):
            with name_file("standard input"):
                raise InputError.at(("line", number), "is no JSON object (give one a line)")
        jobs.append(job)
    return jobs
