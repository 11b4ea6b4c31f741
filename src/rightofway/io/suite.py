"""The shape of suite documents: their keys, and the values of each."""

from __future__ import annotations

from collections.abc import Hashable
from typing import Annotated, Any, ClassVar, Literal, TypeVar

from pydantic import AfterValidator, Field

from rightofway.errors import quote
from rightofway.io.fields import (
    Amount,
    Count,
    Document,
    Name,
    Positive,
    Seed,
    choose_exactly_one,
    make_field,
    make_optional,
)
from rightofway.io.scenario.shape import RuleAttributes
from rightofway.kinds.numbers import read_exact
from rightofway.kinds.table import SEED, Kind, make_kind

MAX_SIDE = 10_000
MAX_WORK = 1_000_000

T = TypeVar("T", bound=Hashable)


def _list_once(values: list[T]) -> list[T]:
    twice = next((value for index, value in enumerate(values) if value in values[:index]), None)
    if twice is not None:
        raise ValueError(f"{quote(twice)} stands there twice (give each once)")
    return values


def _make_pair(
    least: int, most: int, numbers: str, *, in_order: bool = False
) -> Kind[tuple[int, int]]:
    """Return the kind of two whole numbers within bounds."""

    def read(value: object) -> tuple[int, int]:
        items = value if isinstance(value, list | tuple) else ()
        fits = [type(item) is int and least <= item <= most for item in items]
        if len(fits) != 2 or not all(fits):  # noqa: PLR2004 (a pair)
            raise ValueError(
                f"{quote(value)} does not fit (give {numbers}, from {least} to {most})"
            )
        if in_order and items[0] > items[1]:
            raise ValueError(f"{quote(value)} is empty (give the least first, then the most)")
        return (items[0], items[1])

    number = {"type": "integer", "minimum": least, "maximum": most}
    return Kind(numbers, {"type": "array", "items": number, "minItems": 2, "maxItems": 2}, read)


GridSize = Annotated[tuple[int, int], _make_pair(1, MAX_SIDE, "[width, height]")]
WorkRange = Annotated[tuple[int, int], _make_pair(0, MAX_WORK, "[least, most]", in_order=True)]
Share = Annotated[
    float,
    make_kind(
        "a share of 0 or more, below 1",
        lambda share: 0 <= share < 1,
        "is no share",
        base=read_exact,
        convert=float,
        schema={"type": "number", "minimum": 0, "exclusiveMaximum": 1},
    ),
]
Distinct = Annotated[
    list[T],
    Field(min_length=1, json_schema_extra={"uniqueItems": True}),
    AfterValidator(_list_once),
]


class RandomGridDocument(Document):
    """A random grid; every robot stands in its largest connected part."""

    size: GridSize = make_field("[width, height] [cells]")
    walls: Share = make_field("the share of blocked cells, 0 or more, below 1", default=0.0)
    seed: Seed = make_field(default=0, description=f"seed of the walls, {SEED.name}")


MAPS = ("file", "random", "scenario")


class MapCasesDocument(Document):
    """The map of fleets: exactly one of file (with scens), random, scenario."""

    schema_extra: ClassVar = {
        "oneOf": [{"required": [kind]} for kind in MAPS],
        "dependentRequired": {"file": ["scens"], "scens": ["file"]},
    }

    name: Name = make_optional("a name of its own in results; the file's by default")
    file: Name = make_optional("a .map file, relative to the suite's own")
    scens: list[Name] = make_optional(
        "a list of .scen files; the first k rows of one are its fleet of k robots", min_length=1
    )
    random: RandomGridDocument = make_optional("{size, walls, seed}")
    scenario: Name = make_optional("a scenario file; without counts its fleet is taken as it is")
    counts: Distinct[Count] = make_optional(
        "a list of how many robots, 1 or more; that of the suite by default, but not for a scenario"
    )

    def check(self) -> None:
        """Refuse no map or several, and files of fleets without their map."""
        kind = choose_exactly_one(self, MAPS)
        if kind == "file" and self.scens is None:
            raise ValueError("file is given without scens (give a list of .scen files too)")
        if kind != "file" and self.scens is not None:
            raise ValueError(f"scens is given with {kind} (take it out, or give a file)")


class SuiteFleetDocument(RuleAttributes):
    """Properties of the robots of a fleet, and their rules."""

    name: Name = make_field("a name of its own in results")
    speeds: list[Positive] = make_optional("speeds of the robots; 1 by default", min_length=1)
    deal: Literal["in turn", "by seed"] = make_field(
        "in turn: the first speed for R1, and so on round; by seed: drawn at random",
        default="in turn",
    )
    work: WorkRange = make_field(
        default=(0, 0),
        description="[least, most]: the seed draws a whole number of time units for each robot;"
        " robots of a scenario keep theirs",
    )
    chargers: Amount = make_optional(
        "the number of charging places of a scenario, the first ones; all by default"
    )


class SuitePlannerDocument(Document):
    """A planner and its options."""

    name: Name = make_field("the name of a planner")
    options: dict[str, Any] = make_field("{option = value}", default={})


class SuiteDocument(Document):
    """A suite: maps, fleets, counts, seeds, limits and planners; every combination is a case."""

    format: Literal["rightofway-suite/1"] = make_field("rightofway-suite/1")
    maps: list[MapCasesDocument] = make_field("one or more maps", min_length=1)
    planners: list[SuitePlannerDocument] = make_field("one or more planners", min_length=1)
    fleets: list[SuiteFleetDocument] = make_optional(
        "one or more fleets; one of speed 1 by default", min_length=1
    )
    counts: Distinct[Count] = make_optional("a list of how many robots, 1 or more")
    seeds: Distinct[Seed] = make_field(
        "a list; each draws its own homes and targets on random grids, speeds, work,"
        " and is the planner's",
        default=[0],
    )
    limits: Distinct[Positive] = make_optional("a list of time limits [s], above 0; 10 by default")
