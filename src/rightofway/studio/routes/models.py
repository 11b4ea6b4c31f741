"""Requests and answers as models of pydantic, at this border only."""

from __future__ import annotations

import gzip
from collections.abc import Mapping
from typing import Annotated, Any, Literal

from fastapi import Depends, Path, Request, Response
from pydantic import BaseModel, ConfigDict, Discriminator, Field, Tag

from rightofway.studio.session import Studio


def get_studio(request: Request) -> Studio:
    """Return the studio that a request is for."""
    studio: Studio = request.app.state.studio
    return studio


InStudio = Annotated[Studio, Depends(get_studio)]
RunNumber = Annotated[int, Path(ge=1, le=2**53, description="number of a run")]
FilePath = Annotated[str, Path(description="path in the folder, with / between names")]
Document = Annotated[dict[str, Any], Field(description="a scenario, as in a YAML or JSON file")]
Folder = Annotated[str, Field("", description="folder of the document, for files that it names")]
Name = Annotated[
    str,
    Field(
        max_length=200,
        pattern=r"^[^\p{C}\p{Zl}\p{Zp}]*$",
        description="a name of at most 200 characters that can be printed",
    ),
]
MAX_SECONDS = 3600
GZIP = b"\x1f\x8b"
"""First bytes of compressed data."""


def answer_zipped(
    request: Request,
    content: bytes,
    media: str = "application/json",
    headers: Mapping[str, str] | None = None,
) -> Response:
    """Return an answer that a worker has compressed; whole to a client that cannot take it so."""
    more = {**(headers or {}), "vary": "accept-encoding"}
    if content.startswith(GZIP):
        if "gzip" in request.headers.get("accept-encoding", ""):
            more["content-encoding"] = "gzip"
        else:
            content = gzip.decompress(content)
    return Response(content, media_type=media, headers=more)


class Model(BaseModel):
    """Refuses unknown keys."""

    model_config = ConfigDict(extra="forbid")


class Placed(Model):
    """A document, and where it stands."""

    document: Document
    folder: Folder


class Save(Placed):
    """A document that is to be saved."""

    revision: str | None = Field(
        "",
        description="revision that the file must have; empty if there must be none; null for any",
    )


class DraftBody(Model):
    """A document that somebody draws."""

    document: Document
    revision: str | None = Field(
        None,
        description="revision that the draft must have; empty if there must be none; null for any",
    )


class Survey(Placed):
    """A document that somebody changes."""

    inspects: bool = Field(True, description="whether findings are requested, which take longest")
    identifies: bool = Field(
        False, description="whether the digest of plans of this scenario is requested"
    )


class ToText(Placed):
    """A document that is to be converted."""

    name: str = Field("scenario.yaml", description="name that ends in .yaml, .json or .xlsx")


class Deal(Placed):
    """A fleet that is to be dealt out over the map of a document."""

    robots: int = Field(ge=1, le=100_000, description="a number of robots up to 100000")
    seed: int = Field(0, ge=0, lt=2**32, description="a whole number from 0 to 4294967295")
    speeds: list[str | int | float] = Field(
        [1], min_length=1, max_length=100, description="speeds, which go round"
    )
    work: tuple[int, int] = Field((0, 0), description="least and most work time")
    between: Literal["anywhere", "stations"] = Field(
        "anywhere", description="anywhere, or stations: from parking places to stations first"
    )


class Rows(Model):
    """Rows of a table, as they are copied from a spreadsheet."""

    text: str = Field(
        max_length=2_000_000, description="headings, then one row each, with tabs between columns"
    )


class Search(Model):
    """How to search for a plan; None for the defaults of the library."""

    planner: str | None = Field(None, description="name of a planner, see /api/v1/planners")
    options: dict[str, str | int] = Field({}, description="options of the planner by name")
    time_limit: float = Field(10, gt=0, le=MAX_SECONDS, description="seconds, up to 3600")
    seed: int = Field(0, ge=0, lt=2**32, description="a whole number from 0 to 4294967295")

    def list_settings(self) -> dict[str, Any]:
        """Return the settings that are given, as `solve` takes them."""
        chosen = {} if self.planner is None else {"planner": self.planner}
        return {
            **chosen,
            "options": dict(self.options),
            "time_limit": self.time_limit,
            "seed": self.seed,
        }


class NewPlan(Search):
    """A document that is to be planned."""

    kind: Literal["plan"] = "plan"
    document: Document
    folder: Folder
    source: str = Field("", max_length=500, description="file that the document is from, if any")
    name: Name = ""
    based_on: int | None = Field(None, description="run that it is a change of, if any")
    start: int | None = Field(
        None, description="number of the run with the plan to start from, if any"
    )


class NewImprovement(Search):
    """A run whose plan is to be improved."""

    kind: Literal["improve"]
    based_on: int = Field(description="number of a run that has a plan")
    name: Name = ""


class NewLaps(Model):
    """A document whose robots are to repeat their trips."""

    kind: Literal["laps"]
    document: Document
    folder: Folder
    source: str = Field("", max_length=500, description="file that the document is from, if any")
    name: Name = ""
    rule: str = Field("first-come", description="as in rightofway laps --rule")
    routes: str | None = Field(None, description="clear, direct or shortest")
    time_limit: float = Field(10, gt=0, le=MAX_SECONDS, description="seconds, up to 3600")
    seed: int = Field(0, ge=0, lt=2**32, description="a whole number from 0 to 4294967295")


class NewSimulation(Model):
    """A run whose plan is to be executed with delays."""

    kind: Literal["simulate"]
    based_on: int = Field(description="number of a run that has a plan")
    name: Name = ""
    delays: list[str] = Field([], max_length=50, description="as in rightofway simulate --delays")
    runs: int = Field(1000, ge=1, le=100_000, description="a number of runs up to 100000")
    run: Annotated[int, Field(ge=0)] | Literal["typical", "worst"] = Field(
        "typical", description="the run to play, from 0, or typical or worst"
    )
    seed: int = Field(0, ge=0, lt=2**32, description="a whole number from 0 to 4294967295")
    switch: bool = False
    replan: bool = False
    time_limit: float = Field(60, gt=0, le=MAX_SECONDS, description="seconds, up to 3600")


def get_kind(body: Any) -> Any:
    """Return the kind of run that a body asks for: a plan where it names none."""
    return body.get("kind", "plan") if isinstance(body, dict) else getattr(body, "kind", "plan")


NewRun = Annotated[
    Annotated[NewPlan, Tag("plan")]
    | Annotated[NewImprovement, Tag("improve")]
    | Annotated[NewLaps, Tag("laps")]
    | Annotated[NewSimulation, Tag("simulate")],
    Discriminator(get_kind),
]


class OtherLaps(Model):
    """Another value of a speed, a work time or the headway of laps."""

    kind: Literal["speed", "work", "headway"]
    robot: str | None = Field(None, description="name of the robot; null for the headway")
    stop: int | None = Field(None, ge=0, description="stop of a work time, from 0")
    value: str | int | float = Field(description="a number, perhaps a fraction such as 7/2")
    time_limit: float = Field(2, gt=0, le=30, description="seconds, up to 30")


class NewDrive(Model):
    """Settings of a drive of simulated robots."""

    delays: list[str] = Field([], max_length=50, description="as in rightofway drive --delays")
    seed: int = Field(0, ge=0, lt=2**32, description="a whole number from 0 to 4294967295")
    laps: int | None = Field(None, ge=0, description="laps of each robot; 0 for laps without end")
    time_scale: float = Field(
        1, gt=0, le=1000, description="seconds of the plan in each second, up to 1000"
    )


class Rename(Model):
    """A name for a run."""

    name: Name


class Flip(Model):
    """A right of way to reverse."""

    waits: str = Field(description="name of the robot that waits")
    goes_first: str = Field(description="name of the robot that it waits for")
    tick: int = Field(ge=0, description="end of the wait, in ticks")
    time_limit: float = Field(2, gt=0, le=30, description="seconds, up to 30")
    name: Name = ""
