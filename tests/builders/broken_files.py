"""Broken files by the million: each is read, or refused in words, soon and in little memory.

``python -m tests.builders.broken_files COUNT`` breaks that many files, of all formats that are
read, on two processors. File k of a seed is always the same; ``--seed`` and ``--first`` repeat one.
Each file has a limit of time and its process a limit of memory. The only ends are a value, or an
error of ours whose message holds no character that a terminal obeys.
"""

from __future__ import annotations

import argparse
import copy
import io
import json
import multiprocessing
import random
import re
import resource
import secrets
import signal
import sys
import tempfile
import time
import traceback
import zipfile
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any

from PIL import Image

from rightofway.bench.suite import read_suite
from rightofway.errors import InputError, RightOfWayError
from rightofway.io import (
    FOREIGN_FORMATS,
    format_foreign,
    format_plan,
    load_map,
    load_plan,
    load_with_notes,
    parse_scenario,
    read_layout,
)
from rightofway.io.layouts.formats import refuse_layout
from rightofway.io.workbook import format_workbook
from rightofway.io.workbook.writer import TEMPLATE
from rightofway.io.yaml_text import parse_yaml
from rightofway.site.layout import Layout
from rightofway.solve import solve
from tests.builders.sentences import tell_notes

DATA = Path(__file__).parents[1] / "data"
LAYOUTS = DATA / "layouts"

SECONDS = 5
"""The longest time of the processor for one file [s]."""

MEGABYTES = 400
"""The most memory for one file, beyond that of the program."""

BATCH = 1000
"""Files of one task of a process."""

NUMBERS = (
    b"NaN", b".nan", b"-.inf", b"1e999", b"-1e-999", b"1e308", b"-1e308", b"-0", b"0", b"9" * 400,
    b"1" + b"0" * 5000, b"0x1F", b"1/0", b"1/3", b"-1", b"1_000", b"1e-9", b"999999999",
    b"0.1e400000000", b"2147483648", b"1e6", b"null", b"'0.5'", b'"1"',
)  # fmt: skip
WORDS = (b'""', b"[]", b"{}", b"true", b"~", b"'", b'"', b"\0", b"\xff", b"\xed\xa0\x80", b"&a ",
         b"*a", b"!!python/none ", b"<<: *a", b"<!DOCTYPE a>", b"&x;", b"]]>", b"\t",
         b"\r", b"\x1b[2J", "\u202e".encode(), "\u2066".encode(), "\u2028".encode(), b"\\ud800",
         b"\\u202e", b"a" * 300, b"a" * 5000, b"/dev/zero", b"/dev/stdin", b"-", b".", b"../..",
         b"/proc/self/mem")  # fmt: skip
LAUGHS = """
a: &a [x, x]
b: &b [*a, *a, *a, *a, *a, *a, *a, *a]
c: &c [*b, *b, *b, *b, *b, *b, *b, *b]
d: &d [*c, *c, *c, *c, *c, *c, *c, *c]
e: &e [*d, *d, *d, *d, *d, *d, *d, *d]
levels: {L: {vertices: [*e, *e, *e, *e, *e, *e, *e]}}
"""
ENTITIES = """<!DOCTYPE m [<!ENTITY a 'aaaaaaaa'><!ENTITY b '&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;'>
<!ENTITY c '&b;&b;&b;&b;&b;&b;&b;&b;&b;&b;&b;'>]><graphml>&c;&c;&c;&c;&c;&c;&c;&c;</graphml>"""
BOMBS = (
    b"[" * 100_000,
    b'{"a":' * 20_000,
    b"- " * 50_000,
    LAUGHS.encode(),
    b"a: &a {a: *a}\n",
    ENTITIES.encode(),
    b'<!DOCTYPE m SYSTEM "file:///etc/passwd"><model version="7.0.0"><point/></model>',
    b"<a>" * 50_000,
    b"<graphml " + b" ".join(b'a%d="1"' % k for k in range(50_000)) + b"/>",
    b"type octile\nheight 1000000000\nwidth 1000000000\nmap\n.\n",
    b"name,x,y\n" + b'"' * 100_000,
    b"x,y,name\n" + b"1,1,a\n" * 20_000,
)
HEADERS = (
    b"P5 1000000 1000000 255\n", b"P5 8000 8000 255\n", b"P2 3 3 0\n", b"P5 2 2 65535\nab",
    b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\xff\xff\0\0\xff\xff\x08\0\0\0\0", b"P4 9999 9999\n", b"BM",
)  # fmt: skip
NUMBER = re.compile(rb"-?\d+(\.\d+)?")
VALUE = re.compile(rb'"[^"\n]*"|-?\d+(\.\d+)?|true|false|null')

Break = Callable[[random.Random, bytes], bytes]


def _cut(rng: random.Random, text: bytes) -> bytes:
    return text[: rng.randrange(len(text) + 1)]


def _removed(rng: random.Random, text: bytes) -> bytes:
    begin = rng.randrange(len(text) + 1)
    return text[:begin] + text[begin + rng.choice((1, 3, 20, 400)) :]


def _doubled(rng: random.Random, text: bytes) -> bytes:
    """Give lines twice: keys, nodes, edges, headings."""
    lines = text.splitlines(keepends=True)
    begin = rng.randrange(len(lines) or 1)
    part = lines[begin : begin + rng.choice((1, 1, 2, 10))]
    return b"".join([*lines[:begin], *part, *part, *lines[begin + len(part) :]])


def _swapped(rng: random.Random, text: bytes) -> bytes:
    """Put a part of another file in the place of a part."""
    other = rng.choice(seeds()).content
    begin, start = rng.randrange(len(text) + 1), rng.randrange(len(other) + 1)
    size = rng.choice((1, 8, 100, 5000))
    return text[:begin] + other[start : start + size] + text[begin + size :]


def _retyped(rng: random.Random, text: bytes) -> bytes:
    """Put values of wrong kinds in the places of values."""
    return _replaced(rng, text, VALUE, (*NUMBERS, *WORDS, b"[1, 2]", b'{"x": 1}', b'"a"'))


def _renumbered(rng: random.Random, text: bytes) -> bytes:
    return _replaced(rng, text, NUMBER, NUMBERS)


def _exchanged(rng: random.Random, text: bytes) -> bytes:
    """Put two values in each other's places."""
    found = list(VALUE.finditer(text))
    if len(found) < 2:
        return _cut(rng, text)
    one, other = sorted(rng.sample(found, 2), key=lambda each: each.start())
    return b"".join([text[: one.start()], other[0], text[one.end() : other.start()], one[0],
                     text[other.end() :]])  # fmt: skip


def _replaced(
    rng: random.Random, text: bytes, what: re.Pattern[bytes], by: tuple[bytes, ...]
) -> bytes:
    found = list(what.finditer(text))
    for match in sorted(rng.sample(found, min(len(found), rng.choice((1, 1, 3, 30)))),
                        key=lambda each: -each.start()):  # fmt: skip
        text = text[: match.start()] + rng.choice(by) + text[match.end() :]
    return text


def _littered(rng: random.Random, text: bytes) -> bytes:
    begin = rng.randrange(len(text) + 1)
    return text[:begin] + rng.choice((*WORDS, rng.randbytes(4))) + text[begin:]


def _bombed(rng: random.Random, text: bytes) -> bytes:
    bomb = rng.choice(BOMBS)
    begin = rng.choice((0, rng.randrange(len(text) + 1)))
    return rng.choice((bomb, text[:begin] + bomb + text[begin:]))


def _recoded(rng: random.Random, text: bytes) -> bytes:
    plain = text.decode("latin-1")
    return plain.encode(rng.choice(("utf-16", "utf-32", "utf-8-sig", "utf-16-be", "cp500")),
                        "replace")  # fmt: skip


def _rebuilt(rng: random.Random, text: bytes) -> bytes:
    """Move, remove and retype parts of a document of JSON or YAML."""
    try:
        document = parse_yaml(text.decode(), number_keys=True)
    except (InputError, UnicodeDecodeError):
        document = None
    if not document or not isinstance(document, dict | list):
        return _retyped(rng, text)
    for _ in range(rng.choice((1, 1, 2, 5))):
        parts = list(_parts(document))
        holder, key = rng.choice(parts)
        match rng.randrange(4):
            case 0:
                del holder[key]
            case 1:
                donor, place = rng.choice(parts)
                holder[key] = copy.deepcopy(donor[place]) if _holds(donor, place) else None
            case 2:
                nested: Any = holder[key]
                for _ in range(rng.choice((1, 3, 100))):
                    nested = [nested]
                holder[key] = nested
            case _:
                holder[key] = rng.choice((None, True, -1, 10**400, 1.5, "", "x", [], {}, [[]]))
        if not document:
            break
    try:
        return json.dumps(document, default=float).encode()
    except (RecursionError, ValueError, OverflowError):
        return _cut(rng, text)


def _holds(holder: Any, key: Any) -> bool:
    return key in holder if isinstance(holder, dict) else key < len(holder)


def _parts(value: Any) -> Iterator[tuple[Any, Any]]:
    """Yield each holder of values with each of its keys."""
    waiting = [value]
    while waiting:
        holder = waiting.pop()
        pairs = holder.items() if isinstance(holder, dict) else enumerate(holder)
        for key, child in list(pairs):
            yield holder, key
            if isinstance(child, dict | list):
                waiting.append(child)


BREAKS: tuple[Break, ...] = (
    _cut, _removed, _doubled, _swapped, _retyped, _renumbered, _littered, _recoded, _rebuilt,
    _rebuilt, _retyped, _exchanged,
)  # fmt: skip


Part = Mapping[str, bytes]

SHEETS = re.compile(r"xl/(worksheets/sheet\d+|sharedStrings|styles|workbook)\.xml")
CELLS = (
    rb"(?<=<v>)[^<]*(?=</v>)", rb"(?<=<t>)[^<]*(?=</t>)", rb'(?<= r=")[^"]*(?=")',
    rb'(?<= t=")[^"]*(?=")', rb'(?<==")[^"]*(?=")',
)  # fmt: skip
"""Parts of a sheet that are replaced: values, texts, places, kinds, attributes."""

CELL_VALUES = (
    b"", b"0", b"1", b"-1", b"1e999", b"NaN", b"1/2", b"=1/2", b"=map!A1", b"map!B2", b"N4", b"[0,",
    b"[0, 1]", b"{x: 1}", b"99999999999999999999", b"0.333333333333333", b"true", b"1-2-3",
    b"#REF!", b"home", b"both", "\u0085".encode(), "\u202e".encode(), b"a" * 9999, b"A1", b"B3",
    b"XFD1048576", b"A0", b"1A", b"A99999999999", b"ZZZZ1", b"s", b"b", b"e", b"d", b"n", b"str",
    b"inlineStr", b"zz", b"/dev/zero",
)  # fmt: skip
PIECES = (
    b'<mergeCells count="1"><mergeCell ref="A1:XFD1048576"/></mergeCells>', b"<c><f>A1</f></c>",
    b'<row r="1048577"><c r="A1048577"><v>1</v></c></row>', b"]]>", b"&x;", b"\x01",
)  # fmt: skip


def _broken_workbook(rng: random.Random, content: bytes) -> bytes:
    """Change values, places and kinds of cells, drop or exchange parts, change bytes."""
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        parts = {name: archive.read(name) for name in archive.namelist()}
    chosen = rng.random()
    if chosen < 0.1:
        del parts[rng.choice(list(parts))]
    elif chosen < 0.2:
        one, other = rng.choice(list(parts)), rng.choice(list(parts))
        parts[one], parts[other] = parts[other], parts[one]
    else:
        name = rng.choice([name for name in parts if SHEETS.fullmatch(name)])
        for _ in range(rng.choice((1, 1, 2, 4))):
            parts[name] = _broken_sheet(rng, parts[name])
    target = io.BytesIO()
    with zipfile.ZipFile(target, "w", zipfile.ZIP_STORED) as archive:
        for name, data in parts.items():
            archive.writestr(zipfile.ZipInfo(name), data)
    file = bytearray(target.getvalue())
    if rng.random() < 0.1:
        for _ in range(rng.randrange(1, 20)):
            file[rng.randrange(len(file))] = rng.randrange(256)
    return bytes(file)


def _broken_sheet(rng: random.Random, text: bytes) -> bytes:
    if rng.random() < 0.7:
        found = list(re.finditer(rng.choice(CELLS), text))
        if not found:
            return text
        at = rng.choice(found)
        return text[: at.start()] + rng.choice(CELL_VALUES) + text[at.end() :]
    begin = rng.randrange(len(text) + 1)
    end = min(begin + rng.randrange(1, 200), len(text))
    inserted = text[:begin] + rng.choice(PIECES) + text[begin:]
    return rng.choice((text[:begin] + text[end:], text[:end] + text[begin:], inserted))


@dataclass(frozen=True, slots=True, kw_only=True)
class Seed:
    """A file that is read, and what breaks it and reads it.

    Attributes
    ----------
    format
        The format, for the summary.
    name
        The name of the file; its ending matters.
    content
        What it holds.
    read
        Reads it; returns sentences for the user.
    beside
        Files beside it, by name.
    """

    format: str
    name: str
    content: bytes
    read: Callable[[Path], Iterable[str]]
    beside: Part = field(default_factory=dict)


def _scenario(path: Path) -> Iterable[str]:
    return tell_notes(load_with_notes(path))


def _table(path: Path) -> Iterable[str]:
    return tell_notes(load_with_notes(path.with_name("fleet.yaml")))


def _scen(path: Path) -> Iterable[str]:
    return tell_notes(load_with_notes(path.with_suffix(".scen")))


def _map(path: Path) -> Iterable[str]:
    load_map(path)
    return _scen(path)


def _plan(path: Path) -> Iterable[str]:
    load_plan(path)
    return ()


def _foreign(path: Path) -> Iterable[str]:
    load_plan(path, path.with_name("hall.map"), path.with_name("hall.scen"))
    return ()


def _suite(path: Path) -> Iterable[str]:
    read_suite(path)
    return ()


def _layout(path: Path) -> Iterable[str]:
    """Read a layout, and as a map a scenario whose robots have a size."""
    try:
        found = read_layout(path)
    except InputError:
        refuse_layout(path, path.read_text(encoding="utf-8", errors="replace"))
        raise
    if not isinstance(found, Layout):
        _on(path, {"x": 0, "y": 0}, {"cell_size": 1})
        return tell_notes(found) if hasattr(found, "notes") else ()
    level = max(found.levels, key=lambda each: len(each.edges))
    keys: dict[str, Any] = {"level": level.name} if len(found.levels) > 1 else {}
    if level.vehicle_types:
        keys["vehicle_type"] = level.vehicle_types[0]
    names = [
        text
        for each in found.levels
        for named in (each.zones, each.stations, each.vertices)
        for text in (each.name, *each.vehicle_types, *(it.name for it in named))
    ]
    _on(path, level.vertices[0].name, {**keys, "spacing": 1})
    return (*tell_notes(found), *filter(None, names))


def _image(path: Path) -> Iterable[str]:
    return _layout(path.with_name("map.yaml"))


def _on(path: Path, place: Any, keys: dict[str, Any]) -> None:
    """Read a scenario on a layout; a fault of it is none of the file."""
    robot = {"name": "R1", "home": place, "target": place, "radius": "1/4"}
    shape = {"layout": path.name, **keys}
    try:
        parse_scenario({"format": "rightofway-scenario/1", "map": shape, "robots": [robot]},
                    path.parent)  # fmt: skip
    except RightOfWayError as error:
        _say(str(error).split("\n"))


GRID = """format: rightofway-scenario/1
map: {grid: ["...", "@.@", "..."], cell_size: 1/2, y: up, origin: [-3, 1/3]}
units: {length: m, time: s}
robots:
  - {name: R1, home: N0, target: N6, speed: 1, work: 0}
  - {name: R2, home: [0, 2], stops: [{at: N8, work: 3}, {at: N7}], speed: 1/2, laps: 2}
rules: {occupancy: both, headway: 1/2, turn: 1, return: home}
closures: [{at: N4, from: 2, until: 6}]
"""
ROADMAP = {
    "format": "rightofway-scenario/1",
    "map": {
        "roadmap": {
            "vertices": {"dock": [0, 0], "shelf": [3, 4], "gate": [6, 8]},
            "edges": [["dock", "shelf"], {"from": "shelf", "to": "gate", "curve": [[4, 7]]}],
            "zones": [{"name": "aisle", "vertices": ["shelf"]}],
            "stations": {"press": "gate"},
        },
        "spacing": 2,
    },
    "robots": [
        {"name": "R1", "home": "dock", "target": "gate", "radius": 0.3, "turn_rate": 90},
        {"name": "R2", "home": "shelf", "stops": [{"at": "press", "work": "1/3"}]},
    ],
    "rules": {"return": "none", "clearance": 0.1},
}
SHEET: dict[str, Any] = {
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
FLOOR = """format: rightofway-scenario/1
map:
  floor: {size: [12, 8], obstacles: [{name: table, rect: [3, 2, 1.5, 0.8]}]}
  cell_size: adaptive
robots: [{name: R1, home: {x: 1, y: 1}, target: {x: 9, y: 6}, speed: 2}]
"""
FILES = """format: rightofway-scenario/1
map: {file: hall.map, picture: {file: pixels.png, scale: 0.1}}
robots: {scen: hall.scen, count: 1, speeds: [1], work: [0, 1/2]}
"""
TABLE = b"name,home,stop 1,work 1,speed [m/s],type\nR1,N0,N2,1,1/2,a\nR2,N3,N5,0.5,1,\n"
OF_TABLE = b"format: rightofway-scenario/1\nmap: {grid: ['...', '...']}\nrobots: {table: t.csv}\n"
MAP = b"type octile\nheight 2\nwidth 3\nmap\n..T\n...\n"
SCEN = b"version 1\n0\thall.map\t3\t2\t0\t0\t1\t1\t2\n0\thall.map\t3\t2\t1\t0\t0\t1\t2\n"
ROS = b"""image: %s
resolution: 0.5
origin: [-1, 2, 0.1]
negate: 0
occupied_thresh: 0.65
free_thresh: 0.2
mode: trinary
"""
SUITE = b"""format = "rightofway-suite/1"
limits = [1]
[[maps]]
file = "hall.map"
scens = ["hall.scen"]
counts = [1, 2]
[[planners]]
name = "prioritized"
"""
LIF_2 = {
    "metaInformation": {"lifVersion": "2.0.0"},
    "origins": [{"layouts": [{
        "layoutId": "hall", "layoutLevelId": "0",
        "nodes": [{"nodeId": "A", "nodePosition": {"x": 0, "y": 1.5}},
                  {"nodeId": "B", "nodePosition": {"x": 4, "y": 1.5}}],
        "edges": [{"edgeId": "AB", "startNodeId": "A", "endNodeId": "B",
                   "mobileRobotTypeEdgeProperties": [{
                       "mobileRobotTypes": [{"seriesName": "T"}], "maximumSpeed": 1.5,
                       "trajectory": {"degree": 2, "knotVector": [0, 0, 0, 1, 1, 1],
                                      "controlPoints": [{"x": 0, "y": 1.5}, {"x": 2, "y": 3},
                                                        {"x": 4, "y": 1.5, "weight": 1}]}}]}],
        "stations": [{"stationId": "S", "interactionNodeIds": ["B"]}]}]}],
}  # fmt: skip


def _picture(kind: str) -> bytes:
    target = io.BytesIO()
    Image.frombytes("L", (4, 3), bytes([254] * 8 + [0, 205, 254, 254])).save(target, kind)
    return target.getvalue()


@cache
def seeds() -> tuple[Seed, ...]:
    """Return a small file, or a few, of each format that is read."""
    hall = {"hall.map": MAP, "hall.scen": SCEN, "pixels.png": _picture("PNG")}
    roadmap = json.dumps(ROADMAP).encode()
    plans = [solve(parse_scenario(parse_yaml(GRID)), "prioritized")]
    classic = parse_scenario({"format": "rightofway-scenario/1", "map": {"grid": ["..T", "..."]},
                           "rules": "classic", "robots": [
                               {"name": "R1", "home": "N0", "target": "N4"},
                               {"name": "R2", "home": "N1", "target": "N3"}]})  # fmt: skip
    paths = solve(classic, "prioritized")
    found = [
        Seed(format="scenario", name="s.yaml", content=GRID.encode(), read=_scenario),
        Seed(format="scenario", name="s.json", content=roadmap, read=_scenario),
        Seed(format="scenario", name="f.yaml", content=FLOOR.encode(), read=_scenario),
        Seed(format="scenario", name="m.yaml", content=FILES.encode(), read=_scenario, beside=hall),
        *(Seed(format="plan", name="p.json", content=format_plan(each).encode(), read=_plan)
          for each in plans),
        Seed(format="suite", name="s.toml", content=SUITE, read=_suite, beside=hall),
        *(Seed(format="workbook", name="w.xlsx", content=format_workbook(each), read=_scenario)
          for each in (TEMPLATE, SHEET)),
        Seed(format="robots CSV", name="t.csv", content=TABLE, read=_table,
             beside={"fleet.yaml": OF_TABLE}),
        Seed(format="MovingAI", name="hall.map", content=MAP, read=_map, beside=hall),
        Seed(format="MovingAI", name="hall.scen", content=SCEN, read=_scenario, beside=hall),
        *(Seed(format="foreign plan", name=f"{name}.txt", read=_foreign, beside=hall,
               content=format_foreign(paths, name).encode()) for name in FOREIGN_FORMATS),
        Seed(format="LIF", name="two.lif.json", content=json.dumps(LIF_2).encode(), read=_layout),
    ]  # fmt: skip
    for kind, name in (("PPM", "pixels.pgm"), ("PNG", "pixels.png")):
        picture, text = _picture(kind), ROS % name.encode()
        found += [
            Seed(format="ROS map", name="map.yaml", content=text, read=_layout,
                 beside={name: picture}),
            Seed(format="ROS map", name=name, content=picture, read=_image,
                 beside={"map.yaml": text}),
        ]  # fmt: skip
    names = {
        "hall.lif.json": "LIF", "route.geojson": "Nav2", "hall.nav.yaml": "Open-RMF graph",
        "hall.building.yaml": "Open-RMF building", "plant.xml": "openTCS",
        "plant-5.xml": "openTCS", "hall.graphml": "GraphML",
    }  # fmt: skip
    found += [
        Seed(format=what, name=name, content=(LAYOUTS / name).read_bytes(), read=_layout)
        for name, what in names.items()
    ]
    pair = {name: (LAYOUTS / name).read_bytes() for name in ("nodes.csv", "edges.csv")}
    found += [
        Seed(format="CSV pair", name=name, content=content, read=_layout, beside=pair)
        for name, content in pair.items()
    ]
    return tuple(found)


def broken(seed: int, number: int) -> tuple[Seed, bytes]:
    """Return what file ``number`` of a seed was, and what it holds."""
    rng = random.Random(f"{seed} {number}")  # noqa: S311 - the same files each time
    source = rng.choice(seeds())
    if source.format == "workbook":
        return source, _broken_workbook(rng, source.content)
    text = source.content
    for _ in range(rng.choice((1, 1, 1, 2, 4))):
        text = rng.choice(BREAKS)(rng, text)
    if rng.random() < 0.005:
        text = _bombed(rng, text)
    if source.read is _image and rng.random() < 0.3:
        text = rng.choice(HEADERS) + text
    return source, text


def _say(sentences: Iterable[str]) -> None:
    """Refuse what a terminal obeys, and what is no character."""
    for sentence in sentences:
        assert sentence, "an empty sentence"
        assert sentence.isprintable(), f"{sentence!r} is not printable"


def opened(source: Seed, path: Path) -> bool:
    """Read a file; return whether it has no fault."""
    try:
        _say(source.read(path))
    except RightOfWayError as error:
        _say(str(error).split("\n"))
        return False
    return True


class TooSlowError(Exception):
    """A file took longer than it may."""


@contextmanager
def limited(seconds: float) -> Iterator[None]:
    """Stop what runs inside after some time of the processor [s]."""

    def stop(*_: object) -> None:
        raise TooSlowError

    before = signal.signal(signal.SIGPROF, stop)
    signal.setitimer(signal.ITIMER_PROF, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, before)


@dataclass(slots=True)
class Outcome:
    """What became of some files.

    Attributes
    ----------
    read, refused
        How many files of each format were read, and refused.
    failed
        Numbers of files that failed, with the reason.
    slowest
        The longest time [s], and the number of that file.
    """

    read: Counter[str] = field(default_factory=Counter)
    refused: Counter[str] = field(default_factory=Counter)
    failed: list[tuple[int, str]] = field(default_factory=list)
    slowest: tuple[float, int] = (0.0, 0)

    def add(self, other: Outcome) -> None:
        """Add what became of other files."""
        self.read += other.read
        self.refused += other.refused
        self.failed += other.failed
        self.slowest = max(self.slowest, other.slowest)


def outcome_of(seed: int, numbers: Iterable[int]) -> Outcome:
    """Break and read some files of a seed."""
    found = Outcome()
    with tempfile.TemporaryDirectory() as name:
        folders: dict[int, Path] = {}
        for number in numbers:
            source, content = broken(seed, number)
            folder = folders.get(id(source))
            if folder is None:
                folder = folders[id(source)] = Path(name, str(len(folders)))
                folder.mkdir()
                for other, data in source.beside.items():
                    (folder / other).write_bytes(data)
            (folder / source.name).write_bytes(content)
            begin = time.process_time()
            try:
                with limited(SECONDS):
                    is_read = opened(source, folder / source.name)
                (found.read if is_read else found.refused)[source.format] += 1
            except Exception:  # noqa: BLE001 - any exception is what this looks for
                found.failed.append((number, f"{source.name}: {traceback.format_exc(limit=-5)}"))
            found.slowest = max(found.slowest, (time.process_time() - begin, number))
    return found


def _limit_memory() -> None:
    """Leave a process little memory beyond what it has after its imports."""
    outcome_of(0, range(200))
    used = int(Path("/proc/self/statm").read_text("ascii").split()[0]) * resource.getpagesize()
    limit = used + MEGABYTES * 2**20
    resource.setrlimit(resource.RLIMIT_AS, (limit, limit))


def _processes(count: int) -> ProcessPoolExecutor:
    context = multiprocessing.get_context("spawn")
    return ProcessPoolExecutor(count, mp_context=context, initializer=_limit_memory)


def outcomes(seed: int, batches: Sequence[range]) -> Iterator[Outcome]:
    """Yield what became of each batch; one at which a process ends early fails, and others do not.

    All that wait end with a process that ends, so that the first of them is tried by itself.
    """
    at = 0
    while at < len(batches):
        with _processes(2) as both, suppress(BrokenProcessPool):
            for task in [both.submit(outcome_of, seed, batch) for batch in batches[at:]]:
                yield task.result()
                at += 1
        if at < len(batches):
            with _processes(1) as alone:
                try:
                    yield alone.submit(outcome_of, seed, batches[at]).result()
                except BrokenProcessPool:
                    reason = f"a process ended early, at a file before {batches[at].stop}"
                    yield Outcome(failed=[(batches[at].start, reason)])
            at += 1


def main(arguments: list[str]) -> int:
    """Break many files, print those that fail, and a summary."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("count", type=int, nargs="?", default=20_000)
    parser.add_argument("--seed", type=int, default=None)
    parser.add_argument("--first", type=int, default=0)
    given = parser.parse_args(arguments)
    seed = secrets.randbelow(10**9) if given.seed is None else given.seed
    sys.stdout.write(f"seed {seed}\n")
    total, begin, end = Outcome(), time.monotonic(), given.first + given.count
    batches = [range(k, min(k + BATCH, end)) for k in range(given.first, end, BATCH)]
    for found in outcomes(seed, batches):
        for number, reason in found.failed:
            sys.stdout.write(f"file {number} of seed {seed}: {reason}\n")
        total.add(found)
    for name in sorted(total.read | total.refused):
        read, refused = total.read[name], total.refused[name]
        sys.stdout.write(
            f"{name:18} {read + refused:8} files, {read:8} read, {refused:8} refused\n"
        )
    seconds, (longest, slowest) = time.monotonic() - begin, total.slowest
    sys.stdout.write(
        f"{given.count} files of seed {seed}: {total.read.total()} read, {total.refused.total()}"
        f" refused, {len(total.failed)} failed; {given.count / seconds:.0f} files/s; the slowest,"
        f" file {slowest}, took {longest:.2f} s\n"
    )
    return 1 if total.failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
