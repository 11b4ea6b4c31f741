"""Broken layouts by the thousand: each opens, or is refused in words, soon and in little memory.

``python -m tests.builders.broken_layouts --count 100000`` opens as many files as it says, in every
way that users have.
File k of a seed is always the same. A process of its own opens the files of one batch: it may take
200 MB more than it has after its imports.
"""

from __future__ import annotations

import argparse
import copy
import json
import random
import re
import resource
import shutil
import signal
import sys
import tempfile
import time
import traceback
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from rightofway.errors import InputError
from rightofway.io import example_of_layout, load_either, read_layout
from rightofway.io.layouts.formats import refuse_layout
from rightofway.io.text import parse_yaml

DATA = Path(__file__).parents[1] / "data"
SOURCES = sorted(
    path
    for folder in ("layouts", "samples")
    for path in (DATA / folder).rglob("*")
    if path.is_file() and path.suffix not in {".md", ".txt"} and path.stat().st_size < 50_000
)
"""The layouts that are broken, and the pictures beside them."""

PICTURES = {".pgm": "picture.yaml"}

SECONDS = 10
"""The longest time of the processor for one file [s]."""

MEGABYTES = 200
"""The most memory for one file, beyond that of the program."""

BATCH = 500
"""Files of one process."""

NUMBERS = (
    b"NaN", b".nan", b"-.inf", b"1e999", b"-1e-999", b"1e308", b"-0", b"9" * 400,
    b"1" + b"0" * 5000, b"0x1F", b"1/0", b"1/3", b"-1", b"1_000",
    b"0.1e400000000", b"2147483648", b"1e6", b"null",
)  # fmt: skip
WORDS = (b'""', b"[]", b"{}", b"true", b"~", b"'", b'"', b"\0", b"\xff", b"\xed\xa0\x80", b"&a ",
         b"*a", b"!!python/none ", b"<<: *a", b"<!DOCTYPE a>", b"&x;", b"]]>", b"\t",
         b"\r")  # fmt: skip
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
    other = rng.choice(SOURCES).read_bytes()
    begin, start = rng.randrange(len(text) + 1), rng.randrange(len(other) + 1)
    size = rng.choice((1, 8, 100, 5000))
    return text[:begin] + other[start : start + size] + text[begin + size :]


def _retyped(rng: random.Random, text: bytes) -> bytes:
    """Put values of wrong kinds in the places of values."""
    return _replaced(rng, text, VALUE, (*NUMBERS, *WORDS, b"[1, 2]", b'{"x": 1}', b'"a"'))


def _renumbered(rng: random.Random, text: bytes) -> bytes:
    return _replaced(rng, text, NUMBER, NUMBERS)


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
    _rebuilt, _retyped,
)  # fmt: skip


def broken(seed: int, number: int, folder: Path) -> Path:
    """Write file ``number`` of a seed into a folder, and return the file to open."""
    rng = random.Random(f"{seed} {number}")  # noqa: S311 - the same files each time
    source = rng.choice(SOURCES)
    text = source.read_bytes()
    for _ in range(rng.choice((1, 1, 1, 2, 4))):
        text = rng.choice(BREAKS)(rng, text)
    if rng.random() < 0.05:
        text = _bombed(rng, text)
    for file in SOURCES:  # a picture or a table that the file names
        if file.parent == source.parent and file.suffix in {".pgm", ".csv"}:
            shutil.copy(file, folder)
    path = folder / source.name
    if source.suffix == ".pgm":
        path.write_bytes(rng.choice(HEADERS) + text if rng.random() < 0.3 else text)
        path = folder / f"{source.stem}.yaml"
        path.write_text(
            f"image: {source.name}\nresolution: 0.1\norigin: [0, 0, 0]\nnegate: 0\n"
            "occupied_thresh: 0.65\nfree_thresh: 0.2\n",
            encoding="utf-8",
        )
    else:
        path.write_bytes(text)
    return path


def opened(path: Path) -> bool:
    """Open a layout in every way that a user has; return whether it is one without a fault."""
    scenario = path.with_name("scenario.yaml")

    def is_done(use: Callable[[], object]) -> bool:
        try:
            use()
        except InputError as error:
            str(error).encode()
            return False
        return True

    def write_example() -> None:
        scenario.write_text(example_of_layout(path, scenario), encoding="utf-8")

    is_done(lambda: refuse_layout(path, path.read_text(encoding="utf-8", errors="replace")))
    if is_done(write_example):
        is_done(lambda: load_either(scenario))
    return is_done(lambda: read_layout(path))


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


def failures(seed: int, numbers: range) -> list[tuple[int, str, float]]:
    """Return the files that failed: number, reason, and the slowest one with its time [s]."""
    found, slowest = list[tuple[int, str, float]](), (0, "slowest", 0.0)
    for number in numbers:
        with tempfile.TemporaryDirectory() as name:
            path = broken(seed, number, Path(name))
            begin = time.process_time()
            try:
                with limited(SECONDS):
                    opened(path)
            except Exception:  # noqa: BLE001 - any exception is what this looks for
                found.append((number, traceback.format_exc(limit=-4), 0.0))
            took = time.process_time() - begin
            slowest = max(slowest, (number, "slowest", took), key=lambda each: each[2])
    return [*found, slowest]


def _batch(seed: int, numbers: range) -> list[tuple[int, str, float]]:
    """Return the failures among some files; the process has little memory from here on."""
    opened(SOURCES[0])  # imports everything
    used = int(Path("/proc/self/statm").read_text("ascii").split()[0]) * resource.getpagesize()
    limit = used + MEGABYTES * 2**20
    resource.setrlimit(resource.RLIMIT_AS, (limit, limit))
    return failures(seed, numbers)


def main(arguments: list[str]) -> int:
    """Open many broken files, and print those that fail."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=100_000)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--first", type=int, default=0)
    given = parser.parse_args(arguments)
    failed, slowest = 0, (0, "", 0.0)
    end = given.first + given.count
    for first in range(given.first, end, BATCH):
        numbers = range(first, min(first + BATCH, end))
        try:
            with ProcessPoolExecutor(1) as process:
                found = process.submit(_batch, given.seed, numbers).result()
        except BrokenProcessPool:
            found = [(first, f"a process ended early, before file {numbers.stop}", 0.0),
                     (first, "", 0.0)]  # fmt: skip
        slowest = max(slowest, found.pop(), key=lambda each: each[2])
        for number, reason, _ in found:
            sys.stdout.write(f"file {number} of seed {given.seed}:\n{reason}\n")
        failed += len(found)
    sys.stdout.write(
        f"{given.count} files, {failed} failed; the slowest, {slowest[0]}, took"
        f" {slowest[2]:.2f} s\n"
    )
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
