"""Broken calls of the native core by the thousand: each has a result, or is refused in words, soon.

``python -m tests.builders.broken_calls`` makes calls until it is stopped; ``--count 100000`` as
many as it says. Case k of a seed is always the same: ``--seed 7 --case 123`` makes it again, in
this process, and prints it. Cases run in a child, so that a crash is seen, and known by its number.
"""

from __future__ import annotations

import argparse
import os
import random
import re
import resource
import select
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import count, islice
from types import FrameType
from typing import Any

import numpy as np

from tests.builders.binding_calls import CALLS, Arguments, Part, _core, made_of

SECONDS = 0.15
"""After this time a call is interrupted, as by Ctrl-C [s]."""

PATIENCE = 20
"""A call that has not ended after this time hangs [s]."""

GIGABYTES = 6
"""The address space of a child, beside that of sanitizers."""

REFUSALS = (ValueError, TypeError, IndexError, OverflowError)

PLACE = re.compile(r"\w+(\[\d+\])?(, \w+)*: ")
"""What a ValueError begins with: an argument, and an index."""

INTEGERS = (-(2**63), 2**63 - 1, -(2**62), 2**62, 2**62 - 1, 2**60 + 1, 2**50, 2**40, 2**33,
            -(2**31), 2**31 - 1, 2**31, 10**6, 100, 13, 12, 5, 4, 3, 2, 1, 0, -1, -2)  # fmt: skip
REALS = (float("nan"), float("inf"), -float("inf"), 1e300, -1e300, 1e10, 1e7, 5e-324, -1.0, 0.0,
         2.0)  # fmt: skip
ODD: tuple[Any, ...] = (
    None,
    "1",
    b"",
    1.5,
    [],
    {},
    2**70,
    -(2**70),
    True,
    np.int64(3),
    np.zeros((2, 2), np.int32),
)


class Interrupted(Exception):
    """The call took long, and has heard of it."""


class Broken(AssertionError):
    """A call that neither returned nor was refused in words."""


# --- one case -----------------------------------------------------------------------------------


def run_case(seed: int, case: int, *, shows: bool = False) -> None:
    """Make the calls of a case: an object, and what it is asked then.

    Case -1 crashes and case -2 hangs, to test what sees that.
    """
    if case < 0:
        os.abort() if case == -1 else threading.Event().wait()
    rng = random.Random(f"{seed}:{case}")  # noqa: S311 - the same calls each time
    names = [name for name in CALLS if "." not in name and name != "compiler"]
    name = rng.choice(names)
    target = call(getattr(_core, name), rng, name, rng.random() < 0.6, shows=shows)
    methods = [other for other in CALLS if other.startswith(f"{name}.")]
    for _ in range(rng.randrange(1, 7)) if target is not None and methods else ():
        method = rng.choice(methods)
        own = method.partition(".")[2]
        if isinstance(getattr(type(target), own), property):
            call(lambda own=own: getattr(target, own), rng, method, False, shows=shows)
        else:
            call(getattr(target, own), rng, method, rng.random() < 0.5, shows=shows)
    if isinstance(target, _core.Problem):
        _try_problem(target, rng, shows=shows)


def _try_problem(problem: _core.Problem, rng: random.Random, *, shows: bool) -> None:
    """Plan for a problem that was let in."""
    for name in ("FleetSearch", "plan_by_lacam", "Congestion", "earliest_track"):
        made = call(getattr(_core, name), rng, name, False, shows=shows, problem=problem)
        if isinstance(made, _core.FleetSearch):
            for own in ("alone", "prioritize", "resume", "improve", "retime", "tracks"):
                method = f"FleetSearch.{own}"
                call(getattr(made, own), rng, method, False, shows=shows)


def call(
    function: Any, rng: random.Random, name: str, breaks: bool, *, shows: bool, **given: Any
) -> Any:
    """Call a function with valid or broken arguments; return its result, None if it refuses."""
    arguments = CALLS[name](rng) | given
    if breaks:
        for _ in range(rng.choice((1, 1, 1, 2, 3))):
            arguments = broken(rng, arguments)
    if shows:
        _say(f"{name}({', '.join(f'{key}={_short(value)}' for key, value in arguments.items())})")
    begin = time.monotonic()
    try:
        with interrupted():
            result = function(**made_of(arguments))
    except REFUSALS as error:
        if type(error) is ValueError and not PLACE.match(str(error)):
            raise Broken(f"{name}: no place in the message: {error}") from error
        result = error
    except Interrupted as error:
        result = error
    except Exception as error:
        raise Broken(f"{name}: {type(error).__name__}: {error}") from error
    if shows:
        _say(f"    {time.monotonic() - begin:.2f} s: {_short(result)}")
    return None if isinstance(result, Exception) else result


def _short(value: Any) -> str:
    if isinstance(value, np.ndarray):
        return f"{value.dtype}{value.tolist()}"[:400]
    return repr(value)[:400]


@contextmanager
def interrupted() -> Iterator[None]:
    """Interrupt what takes long."""

    def interrupt(number: int, frame: FrameType | None) -> None:  # noqa: ARG001
        raise Interrupted

    before = signal.signal(signal.SIGALRM, interrupt)
    try:
        signal.setitimer(signal.ITIMER_REAL, SECONDS)
        yield
        signal.setitimer(signal.ITIMER_REAL, 0)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


# --- what is broken -----------------------------------------------------------------------------


def broken(rng: random.Random, arguments: Arguments) -> Arguments:
    """Return arguments of which one is another, or left out."""
    if not arguments:
        return arguments
    name = rng.choice(list(arguments))
    if rng.random() < 1 / 50:
        return {other: value for other, value in arguments.items() if other != name}
    return arguments | {name: _other(rng, arguments[name])}


def _other(rng: random.Random, value: Any) -> Any:  # noqa: PLR0911 - one for each type
    if rng.random() < 1 / 30:
        return rng.choice(ODD)
    if isinstance(value, np.ndarray) and value.ndim == 1:
        return _other_array(rng, value)
    if isinstance(value, bool):
        return not value
    if isinstance(value, int):
        return rng.choice((rng.choice(INTEGERS), value + rng.choice((-1, 1)), -value))
    if value is None or isinstance(value, float):
        return rng.choice((*REALS, None))
    if isinstance(value, list):
        return _other_list(rng, value)
    if isinstance(value, _core.BookingTable):
        return _core.BookingTable(rng.choice((0, 3, 12, 46, 92)))
    if isinstance(value, Part):
        return Part(value.name, broken(rng, value.arguments))
    return rng.choice(ODD)


def _other_list(rng: random.Random, values: list[Any]) -> list[Any]:
    some = list(values)
    at = rng.randrange(len(some) + 1)
    match rng.randrange(4):
        case 0:
            del some[at : at + 1]
        case 1:
            some.insert(at, rng.choice((*values, None)))
        case 2:
            rng.shuffle(some)
        case _ if some:
            at %= len(some)
            some[at] = _other(rng, some[at])
    return some


def _other_array(rng: random.Random, array: np.ndarray[Any, Any]) -> np.ndarray[Any, Any]:
    """Return an array of another length, order, type, or with other entries."""
    changed, size = array.copy(), len(array)
    at, to = rng.randrange(size + 1), rng.randrange(size + 1)
    match rng.randrange(10):
        case 0:
            return np.delete(changed, slice(at, at + rng.choice((1, 1, 2, 100))))
        case 1:
            return np.insert(changed, at, changed[to : to + rng.choice((1, 1, 3))])
        case 2:
            return changed[::-1].copy() if rng.random() < 1 / 2 else np.sort(changed)
        case 3:
            return rng.choice((changed[:0], changed[::2], changed.astype(np.uint16), changed[None]))
        case 4 if size:
            changed[[at % size, to % size]] = changed[[to % size, at % size]]
        case 5 if size:
            changed[:] = _entry(rng, changed)
        case _ if size:
            for _ in range(rng.choice((1, 1, 1, 2, 5))):
                changed[rng.randrange(size)] = _entry(rng, changed)
    return changed


def _entry(rng: random.Random, array: np.ndarray[Any, Any]) -> Any:
    """Return an extreme of an array's type, or a value near that of another entry."""
    if array.dtype.kind == "f":
        return rng.choice(REALS)
    if rng.random() < 1 / 2:
        near = int(rng.choice(array.tolist())) + rng.choice((-1, 0, 1))
    else:
        near = rng.choice(INTEGERS)
    bounds = np.iinfo(array.dtype)  # all arrays of the table are of floats or integers
    return min(max(near, bounds.min), bounds.max)


# --- many cases, in a child ---------------------------------------------------------------------


class Child:
    """A process that runs cases by number, and another one after each crash."""

    def __init__(self, seed: int) -> None:
        self.seed = seed
        self._process: subprocess.Popen[bytes] | None = None

    def fault_of(self, case: int) -> str | None:
        """Run a case; return what is wrong with it, None if nothing is."""
        process = self._running()
        assert process.stdin is not None
        assert process.stdout is not None
        process.stdin.write(b"%d\n" % case)
        process.stdin.flush()
        ready, _, _ = select.select([process.stdout], [], [], PATIENCE)
        answer = process.stdout.readline().decode() if ready else ""
        if answer.endswith("\n"):
            return answer.strip() or None
        if not ready:
            process.kill()
        status = process.wait()
        self.stop()
        return "hangs" if not ready else f"ends the process with status {status}"

    def _running(self) -> subprocess.Popen[bytes]:
        if self._process is None:
            command = [sys.executable, "-m", __name__ if __name__ != "__main__" else MODULE]
            self._process = subprocess.Popen(
                [*command, "--child", "--seed", str(self.seed)],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
            )
            assert self._process.stdout is not None
            self._process.stdout.readline()  # patience is for cases, not for imports
        return self._process

    def stop(self) -> None:
        """End the process."""
        if self._process is not None:
            self._process.kill()
            self._process.wait()
            for pipe in (self._process.stdin, self._process.stdout):
                assert pipe is not None
                pipe.close()
        self._process = None


MODULE = "tests.builders.broken_calls"


def _serve(seed: int) -> None:
    """Run the cases whose numbers come in, and answer each with what is wrong."""
    if "ASAN_OPTIONS" not in os.environ:
        resource.setrlimit(resource.RLIMIT_AS, (GIGABYTES << 30, GIGABYTES << 30))
    _say("ready")
    for line in sys.stdin:
        fault = ""
        try:
            run_case(seed, int(line))
        except Broken as error:
            fault = " ".join(str(error).split())
        _say(fault)


def _say(line: str) -> None:
    sys.stdout.write(line + "\n")
    sys.stdout.flush()


def main() -> None:
    """Run the command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seed", type=int, default=random.SystemRandom().randrange(10**9))
    parser.add_argument("--count", type=int, help="cases; without, until it is stopped")
    parser.add_argument("--first", type=int, default=0, help="number of the first case")
    parser.add_argument("--case", type=int, help="make this case again, here")
    parser.add_argument("--child", action="store_true", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.child:
        _serve(options.seed)
        return
    if options.case is not None:
        run_case(options.seed, options.case, shows=True)
        return
    _say(f"--seed {options.seed}")
    child, begin, n_cases, n_faults = Child(options.seed), time.monotonic(), 0, 0
    try:
        for case in islice(count(options.first), options.count):
            fault = child.fault_of(case)
            n_cases += 1
            if fault is not None:
                n_faults += 1
                _say(f"--seed {options.seed} --case {case}: {fault}")
    except KeyboardInterrupt:
        pass
    finally:
        child.stop()
        _say(f"{n_cases} cases in {time.monotonic() - begin:.0f} s, {n_faults} faults")
    sys.exit(n_faults > 0)


if __name__ == "__main__":
    main()
