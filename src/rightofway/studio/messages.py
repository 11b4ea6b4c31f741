"""Messages between the studio and its workers.

A message is a JSON object with its length before it, and blobs after it. To a worker goes ``{"job",
"task", "arguments"}`` with blobs, or ``{"stop"}``. From it come ``{"job", "event"}`` and, last of a
job, ``{"job", "result"}`` or ``{"job", "error"}``, each with blobs.
"""

from __future__ import annotations

import gzip
import json
import struct
from collections.abc import Callable, Sequence
from typing import Any

from rightofway.errors import GaveUp, InputError, InputFault, NoPlanExists, describe_defect

LENGTH = struct.Struct(">Q")
"""How the length of a message is written."""

Blobs = Sequence[bytes]
Emit = Callable[..., None]
"""Sends an event of the current job: ``emit({"flowtime": 3}, b"a plan")``."""


def pack(message: dict[str, Any], blobs: Blobs = ()) -> bytes:
    """Return a message as it is sent."""
    text = json.dumps({**message, "sizes": list(map(len, blobs))}, allow_nan=False).encode()
    return b"".join([LENGTH.pack(len(text)), text, *blobs])


def zip_text(text: str) -> bytes:
    """Return a large answer as browsers take it: the worker compresses it, not the server."""
    return gzip.compress(text.encode(), 1, mtime=0)


def as_error(error: BaseException) -> dict[str, Any]:
    """Return an error as plain data: ``kind``, ``message``, and details by kind."""
    match error:
        case InputError():
            listed = [as_fault_data(fault) for fault in error.faults]
            message = "\n".join(str(fault.name_file("")) for fault in error.faults)
            return {"kind": "input", "message": message, "faults": listed}
        case NoPlanExists():
            return {"kind": "no_plan", "message": f"no plan exists: {error}", **error.as_dict()}
        case GaveUp():
            return {"kind": "gave_up", "message": f"no plan found: {error}"}
        case KeyboardInterrupt():
            return {"kind": "stopped", "message": "stopped before there was a plan"}
        case MemoryError():
            message = "this needs more memory than a worker may take (give a smaller problem)"
            return {"kind": "memory", "message": message}
        case _:
            return {"kind": "defect", "message": describe_defect(error)}


def as_fault_data(fault: InputFault) -> dict[str, Any]:
    """Return a fault as plain data."""
    inner = str(fault.location.inner or "")
    return {
        "place": fault.place,
        "path": list(fault.path),
        "message": f"{inner}: {fault.message}" if inner else fault.message,
        "line": fault.line,
        "named": fault.location.named,
        "about": fault.location.about,
    }
