"""Whatever is in a workbook: a scenario, or an InputError that can be printed, within seconds."""

from __future__ import annotations

import io
import os
import random
import re
import signal
import zipfile
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import rightofway
from rightofway.errors import InputError
from rightofway.io.workbook import workbook_of
from rightofway.io.workbook.writer import TEMPLATE

COUNT = int(os.environ.get("FUZZED_WORKBOOKS", "400"))
"""How many workbooks are tried; the first ones are the same each time."""

LONGEST = 10
"""How long one may take [s]."""

ROADMAP: dict[str, Any] = {
    "map": {
        "roadmap": {
            "vertices": {"dock": [0, 0], "bay": [3, 4]},
            "edges": [{"from": "dock", "to": "bay", "both_ways": True}],
        }
    },
    "robots": [{"name": "R1", "home": "dock", "stops": [{"at": "bay", "work": 1}]}],
    "units": {"length": "m", "time": "s"},
    "rules": {"occupancy": "both", "headway": "1/2"},
}

Parts = dict[str, bytes]
Draw = random.Random

VALUES = [
    "", "0", "1", "-1", "1e999", "NaN", "1/2", "=1/2", "=map!A1", "map!B2", "N4", "[0, 1]", "[0,",
    "{x: 1}", "99999999999999999999", "0.333333333333333", "true", "1-2-3", "#REF!", "home", "both",
    "\u0085", "a" * 9999,
]  # fmt: skip
REFERENCES = ["A1", "B3", "C2", "XFD1048576", "A0", "1A", "A99999999999", "ZZZZ1", "", "a1", "AA7"]
KINDS = ["s", "b", "e", "d", "n", "str", "inlineStr", "zz"]
SHEETS = re.compile(r"xl/(worksheets/sheet\d+|sharedStrings|styles|workbook)\.xml")


def parts_of(document: dict[str, Any]) -> Parts:
    with zipfile.ZipFile(io.BytesIO(workbook_of(document))) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


REPLACED = [
    (r"(?<=<v>)[^<]*(?=</v>)", VALUES),
    (r"(?<=<t>)[^<]*(?=</t>)", VALUES),
    (r'(?<= r=")[^"]*(?=")', REFERENCES),
    (r'(?<= t=")[^"]*(?=")', KINDS),
    (r'(?<==")[^"]*(?=")', [*VALUES, *REFERENCES]),
]
"""Parts of a sheet, and what may stand there instead."""

INSERTED = [
    '<mergeCells count="1"><mergeCell ref="A1:XFD1048576"/></mergeCells>', "<c><f>A1</f></c>",
    '<row r="1048577"><c r="A1048577"><v>1</v></c></row>', "]]>", "&x;", "\x01",
]  # fmt: skip


def changed_text(draw: Draw, text: str) -> str:
    """Put another value, place, kind, style or piece into the text of a part."""
    if draw.random() < 0.7:
        pattern, values = draw.choice(REPLACED)
        return _replaced(draw, text, pattern, draw.choice(values))
    at = draw.randrange(len(text) + 1)
    end = min(at + draw.randrange(1, 200), len(text))
    without, doubled = text[:at] + text[end:], text[:end] + text[at:]
    return draw.choice([without, doubled, text[:at] + draw.choice(INSERTED) + text[at:]])


def _replaced(draw: Draw, text: str, pattern: str, by: str) -> str:
    found = list(re.finditer(pattern, text))
    if not found:
        return text
    where = draw.choice(found)
    return text[: where.start()] + by + text[where.end() :]


def change_part(draw: Draw, parts: Parts) -> None:
    names = [name for name in parts if SHEETS.fullmatch(name)] or list(parts)
    name = draw.choice(names)
    text = parts[name].decode("utf-8", "replace")
    for _ in range(draw.randrange(1, 5)):
        text = changed_text(draw, text)
    parts[name] = text.encode()


def drop_part(draw: Draw, parts: Parts) -> None:
    del parts[draw.choice(list(parts))]


def swap_parts(draw: Draw, parts: Parts) -> None:
    one, other = draw.choice(list(parts)), draw.choice(list(parts))
    parts[one], parts[other] = parts[other], parts[one]


CHANGES: Sequence[Callable[[Draw, Parts], None]] = [*[change_part] * 8, drop_part, swap_parts]


def mutated(draw: Draw, bases: list[Parts]) -> bytes:
    """Return a workbook with a few changes, as a file."""
    parts = dict(draw.choice(bases))
    draw.choice(CHANGES)(draw, parts)
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_STORED) as archive:
        for name, data in parts.items():
            archive.writestr(name, data)
    file = bytearray(content.getvalue())
    if draw.random() < 0.1:
        for _ in range(draw.randrange(1, 20)):
            file[draw.randrange(len(file))] = draw.randrange(256)
    return bytes(file)


def test_any_workbook_is_a_scenario_or_a_fault_that_can_be_printed(tmp_path: Path) -> None:
    bases, path = [parts_of(TEMPLATE), parts_of(ROADMAP)], tmp_path / "fuzzed.xlsx"
    ends, unsaid = {"scenario": 0, "fault": 0}, 0
    for seed in range(COUNT):
        path.write_bytes(mutated(random.Random(seed), bases))  # noqa: S311 (no secret)
        signal.alarm(LONGEST)  # the default action ends the process, with the file kept
        try:
            rightofway.load(path)
            ends["scenario"] += 1
        except InputError as error:
            unsaid += not str(error).startswith(str(path))
            ends["fault"] += 1
        finally:
            signal.alarm(0)
    assert unsaid == 0
    assert min(ends.values()) > COUNT // 20
