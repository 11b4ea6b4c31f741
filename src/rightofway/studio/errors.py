"""Errors between a browser and the studio, beyond the errors of the library.

::

    RightOfWayError
    └── StudioError     a request is refused, with a status of HTTP
        ├── Refused     it asks for something that is not there, or not allowed
        ├── Busy        too much is asked at once
        └── TaskFailed  a worker found a fault, or died
"""

from __future__ import annotations

from typing import Any

from rightofway.errors import RightOfWayError

STATUS_OF_KIND = {
    "input": 422,
    "no_plan": 409,
    "gave_up": 409,
    "stopped": 409,
    "memory": 413,
    "too_long": 413,
    "died": 500,
    "defect": 500,
}
"""Statuses of HTTP for what tasks end with."""


class StudioError(RightOfWayError):
    """A request is refused.

    Parameters
    ----------
    message
        The fault, with the value, and the remedy in brackets.
    status
        The status of HTTP.
    """

    def __init__(self, message: str, status: int) -> None:
        self.status = status
        self.error: dict[str, Any] = {"message": message}
        super().__init__(message)


class Refused(StudioError):
    """A request asks for something that is not there, or not allowed."""

    def __init__(self, message: str, status: int = 400) -> None:
        super().__init__(message, status)


class Busy(StudioError):
    """Too much is asked at once; a later request may do."""

    def __init__(self, message: str) -> None:
        super().__init__(message, 429)


class TaskFailed(StudioError):
    """A task ended with a fault.

    Parameters
    ----------
    error
        As workers send it: ``kind``, ``message``, and more by kind.
    """

    def __init__(self, error: dict[str, Any]) -> None:
        super().__init__(error["message"], STATUS_OF_KIND[error["kind"]])
        self.error = error
