"""The shape of a suite document: which keys there are, and what each may hold."""

from __future__ import annotations

from collections.abc import Hashable
from typing import Annotated, Any, Literal, Self, TypeVar

from pydantic import (
    AfterValidator,
    ConfigDict,
    Field,
    PlainValidator,
    WithJsonSchema,
    model_validator,
)

from rightofway.io.faults import shown
from rightofway.io.fields import LEFT_OUT, Count, Document, Name, Positive, described
from rightofway.io.numbers import exact
from rightofway.io.scenario.shape import RulesDocument

__all__ = ["MAX_SEED", "MapCasesDocument", "PlannerDocument", "SuiteDocument", "SuiteFleetDocument"]

MAX_SEED = 2**32 - 1
MAX_SIDE = 10_000
MAX_WORK = 1_000_000

T = TypeVar("T", bound=Hashable)


def _each_once(values: list[T]) -> list[T]:
    twice = next((value for index, value in enumerate(values) if value in values[:index]), None)
    if twice is not None:
        raise ValueError(f"{shown(twice)} stands there twice (give each once)")
    return values


def _pair_of(least: int, most: int, what: str) -> PlainValidator:
    """Accept two whole numbers within bounds."""

    def read(value: object) -> tuple[int, int]:
        items = value if isinstance(value, list | tuple) else ()
        fits = [type(item) is int and least <= item <= most for item in items]
        if len(fits) != 2 or not all(fits):  # noqa: PLR2004 (a pair)
            raise ValueError(f"{shown(value)} does not fit (give {what}, from {least} to {most})")
        return (items[0], items[1])

    return PlainValidator(read)


def _pair_schema(least: int, most: int) -> WithJsonSchema:
    number = {"type": "integer", "minimum": least, "maximum": most}
    return WithJsonSchema({"type": "array", "items": number, "minItems": 2, "maxItems": 2})


def _in_order(pair: tuple[int, int]) -> tuple[int, int]:
    if pair[0] > pair[1]:
        raise ValueError(f"{shown(pair)} is empty (give the least first, then the most)")
    return pair


def _share(value: object) -> float:
    share = exact(value)
    if not 0 <= share < 1:
        raise ValueError(f"{shown(value)} is no share (give 0 or more, below 1)")
    return float(share)


Seed = Annotated[int, Field(ge=0, le=MAX_SEED)]
GridSize = Annotated[
    tuple[int, int], _pair_of(1, MAX_SIDE, "[width, height]"), _pair_schema(1, MAX_SIDE)
]
WorkRange = Annotated[
    tuple[int, int],
    _pair_of(0, MAX_WORK, "[least, most]"),
    AfterValidator(_in_order),
    _pair_schema(0, MAX_WORK),
]
Counts = Annotated[
    list[Count], Field(min_length=1, json_schema_extra={"uniqueItems": True}),
    AfterValidator(_each_once),
]  # fmt: skip
Seeds = Annotated[
    list[Seed], Field(min_length=1, json_schema_extra={"uniqueItems": True}),
    AfterValidator(_each_once),
]  # fmt: skip
Limits = Annotated[
    list[Positive], Field(min_length=1, json_schema_extra={"uniqueItems": True}),
    AfterValidator(_each_once),
]  # fmt: skip
Share = Annotated[
    float,
    PlainValidator(_share),
    WithJsonSchema({"type": "number", "minimum": 0, "exclusiveMaximum": 1}),
]


class RandomGridDocument(Document):
    """A random grid; every robot stands in its largest connected part."""

    size: GridSize = Field(description="[width, height] [cells]")
    walls: Share = Field(default=0.0, description="the share of blocked cells, 0 or more, below 1")
    seed: Seed = Field(default=0, description=f"what draws the walls, 0 to {MAX_SEED}")


MAPS = ("file", "random", "scenario")


class MapCasesDocument(Document):
    """Where fleets drive: exactly one of file (with scens), random, scenario."""

    model_config = ConfigDict(
        json_schema_extra=described(
            oneOf=[{"required": [kind]} for kind in MAPS],
            dependentRequired={"file": ["scens"], "scens": ["file"]},
            dependentSchemas={"counts": {"not": {"required": ["scenario"]}}},
        )
    )

    name: Name = Field(
        default=LEFT_OUT, description="a name of its own in results; the file's by default"
    )
    file: Name = Field(default=LEFT_OUT, description="a .map file, relative to the suite's own")
    scens: list[Name] = Field(
        default=LEFT_OUT,
        min_length=1,
        description="a list of .scen files; the first k rows of one are its fleet of k robots",
    )
    random: RandomGridDocument = Field(default=LEFT_OUT, description="{size, walls, seed}")
    scenario: Name = Field(
        default=LEFT_OUT,
        description="a scenario file, whose fleet is taken as it is",
    )
    counts: Counts = Field(
        default=LEFT_OUT,
        description="a list of how many robots, 1 or more; that of the suite by default",
    )

    @model_validator(mode="after")
    def _check_one_map(self) -> Self:
        found = [kind for kind in MAPS if kind in self.model_fields_set]
        if len(found) != 1:
            what = f"{' and '.join(found)} are" if found else "no map is"
            raise ValueError(f"{what} given (give exactly one of {', '.join(MAPS)})")
        if found == ["file"] and self.scens is None:
            raise ValueError("file is given without scens (give a list of .scen files too)")
        if found != ["file"] and self.scens is not None:
            raise ValueError(f"scens is given with {found[0]} (take it out, or give a file)")
        if found == ["scenario"] and self.counts is not None:
            raise ValueError("counts is given with a scenario, which has its robots (take it out)")
        return self


class SuiteFleetDocument(RulesDocument):
    """What the robots of a fleet are like, and their rules."""

    name: Name = Field(description="a name of its own in results")
    speeds: list[Positive] = Field(
        default=LEFT_OUT, min_length=1, description="speeds of the robots; 1 by default"
    )
    deal: Literal["in turn", "by seed"] = Field(
        default="in turn",
        description="in turn: the first speed for R1, and so on round; by seed: drawn at random",
    )
    work: WorkRange = Field(
        default=(0, 0),
        description="[least, most]: the seed draws a whole number of time units for each robot",
    )


class PlannerDocument(Document):
    """A planner and what it is told."""

    name: Name = Field(description="the name of a planner")
    options: dict[str, Any] = Field(default={}, description="{option = value}")


class SuiteDocument(Document):
    """A suite: maps, fleets, counts, seeds, limits and planners; every combination is a case."""

    format: Literal["rightofway-suite/1"] = Field(description="rightofway-suite/1")
    maps: list[MapCasesDocument] = Field(min_length=1, description="one or more maps")
    planners: list[PlannerDocument] = Field(min_length=1, description="one or more planners")
    fleets: list[SuiteFleetDocument] = Field(
        default=LEFT_OUT,
        min_length=1,
        description="one or more fleets; one of speed 1 by default",
    )
    counts: Counts = Field(default=LEFT_OUT, description="a list of how many robots, 1 or more")
    seeds: Seeds = Field(
        default=[0],
        description="a list; each draws its own homes and targets on random grids, speeds, work,"
        " and is the planner's",
    )
    limits: Limits = Field(
        default=LEFT_OUT, description="a list of time limits [s], above 0; 10 by default"
    )
