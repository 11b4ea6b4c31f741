"""Whatever a binding of the native core is given: it has a result, or an exception says why not.

Cases run in a child process, so that a crash fails the law instead of ending the session. A failure
prints the number of its case and how to make it again.
"""

from __future__ import annotations

import inspect
import random
import re
from collections.abc import Iterator
from contextlib import suppress

import pytest
from hypothesis import strategies as st

from tests.builders.binding_calls import CALLS, _core, build, callables, made_of
from tests.builders.broken_calls import Child, run_case
from tests.builders.laws import law

SEED = 20
"""The law draws the numbers of cases; the seed of the session decides which."""

BATCH = 10
"""Cases that the law judges at once."""


@pytest.fixture(scope="module")
def child() -> Iterator[Child]:
    child = Child(SEED)
    child.fault_of(0)  # the imports are no part of the law's time
    yield child
    child.stop()


def test_every_callable_of_the_native_core_is_in_the_table_of_calls() -> None:
    assert set(callables()) == set(CALLS)


@pytest.mark.parametrize("name", [name for name in CALLS if "." not in name])
def test_calls_of_the_table_are_valid(name: str) -> None:
    rng = random.Random(name)  # noqa: S311 - the same each time
    for _ in range(20):
        build(name, CALLS[name](rng))


@pytest.mark.parametrize("name", [name for name in CALLS if "." in name])
def test_calls_of_the_table_give_all_arguments(name: str) -> None:
    """A method may refuse what does not fit the object (ValueError), but not names and types."""
    owner, own = name.split(".")
    method = inspect.getattr_static(getattr(_core, owner), own)
    if isinstance(method, property):
        return
    rng = random.Random(name)  # noqa: S311 - the same each time
    target = build(owner, CALLS[owner](rng))
    with suppress(ValueError):
        getattr(target, own)(**made_of(CALLS[name](rng)))


@law(st.integers(0, 10**8))
def test_broken_calls_are_refused_in_words(child: Child, batch: int) -> None:
    for case in range(batch * BATCH, (batch + 1) * BATCH):
        fault = child.fault_of(case)
        again = f"python -m tests.builders.broken_calls --seed {SEED} --case {case}"
        assert fault is None, f"case {case}: {fault}; again: {again}"


def test_a_crash_and_a_hang_are_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    """Case -1 ends its process, case -2 never ends, and the next case is fine."""
    child = Child(SEED)
    try:
        assert child.fault_of(-1) == "ends the process with status -6"
        with monkeypatch.context() as patch:
            patch.setattr("tests.builders.broken_calls.PATIENCE", 2)
            assert child.fault_of(-2) == "hangs"
        assert child.fault_of(0) is None
    finally:
        child.stop()


def test_a_case_is_made_again_by_its_number(capsys: pytest.CaptureFixture[str]) -> None:
    def shown() -> str:
        run_case(SEED, 7, shows=True)
        calls = [line for line in capsys.readouterr().out.splitlines() if line[0] != " "]
        return re.sub("at 0x[0-9a-f]+", "", "".join(calls))

    assert shown() == shown()
