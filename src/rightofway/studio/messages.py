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
from rightofway.facts import Fact
from rightofway.report.facts import write_blockage, write_note
from rightofway.report.phrases import to_parts

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
            data = error.as_dict()
            for reason, blockage in zip(data["reasons"], error.blockages, strict=True):
                reason["phrase"] = to_parts(write_blockage(blockage))
            return {"kind": "no_plan", "message": f"no plan exists: {error}", **data}
        case GaveUp():
            return _describe_error(
                "gave_up",
                Fact("no plan found", getattr(error.reason, "about", None), reason=error.reason),
            )
        case KeyboardInterrupt():
            return _describe_error("stopped", Fact("stopped before a plan"))
        case MemoryError():
            return _describe_error("memory", Fact("out of memory"))
        case _:
            return {"kind": "defect", "message": describe_defect(error)}


def _describe_error(kind: str, fact: Fact) -> dict[str, Any]:
    """Return a fact in English as ``message``, and with kind and values as ``phrase``."""
    phrase = write_note(fact)
    return {"kind": kind, "message": phrase, "phrase": to_parts(phrase)}


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
