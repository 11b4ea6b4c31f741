"""Answers of the API, as the page reads them: its types are written from these.

Answers are plain data that workers and stores make. Nothing here is checked while the studio runs;
tests compare answers of a studio with these types, key for key.
"""

from __future__ import annotations

from typing import Annotated, Any, Literal, NotRequired

from typing_extensions import TypedDict

from rightofway.report.facts import FactData
from rightofway.studio.routes.models import (
    Deal,
    Document,
    DraftBody,
    Flip,
    NewDrive,
    NewRun,
    OtherLaps,
    Placed,
    Rename,
    Rows,
    Save,
    Survey,
)
from rightofway.studio.runs import Kind, State

Payload = Annotated[dict[str, Any], "SitePayload"]
"""Data that the viewer draws."""

Comparison = Annotated[dict[str, Any], "ComparisonPayload"]
"""Data that the viewer compares."""

Phrase = Annotated[list[str | dict[str, Any]], "PhraseData"]
"""A sentence with places for values, and the values."""

Exact = int | float | str
"""A number; a fraction is text."""

Ratio = tuple[int, int]
"""Numerator and denominator."""


class DocumentFault(TypedDict):
    """One thing wrong with a document: where, as text, as keys and indices, and for people."""

    place: str
    path: list[str | int]
    message: str
    line: int | None
    named: str
    about: str


class Reason(TypedDict):
    """A proof that no plan exists: its kind, its sentence, and the vertices in it."""

    kind: str
    reason: str
    phrase: Phrase | str
    robots: list[str]
    vertices: list[str]


class ErrorData(TypedDict):
    """Why a request was refused or a run has failed."""

    kind: str
    message: str
    phrase: NotRequired[Phrase]
    status: NotRequired[int]
    faults: NotRequired[list[DocumentFault]]
    reasons: NotRequired[list[Reason]]
    robots: NotRequired[list[str]]
    vertices: NotRequired[list[str]]


class RefusalData(TypedDict):
    """The answer to a request that is refused."""

    error: ErrorData


class Limits(TypedDict):
    """Limits of the server."""

    body: int
    seconds: int
    runs_at_once: int


class About(TypedDict):
    """A studio: its version, folder and limits."""

    version: str
    folder: str
    file: str | None
    keeps: bool
    limits: Limits


class FileEntry(TypedDict):
    """A file of the folder."""

    path: str
    kind: str
    size: int
    modified: float


class FileList(TypedDict):
    """The files that may be opened."""

    files: list[FileEntry]
    is_whole: bool


class Saved(TypedDict):
    """A file as it was written."""

    path: str
    revision: str


class DraftEntry(TypedDict):
    """A draft in a list."""

    name: str
    saved: float
    size: int


class DraftList(TypedDict):
    """The drafts, the latest first."""

    drafts: list[DraftEntry]
    are_kept: bool


class DraftData(TypedDict):
    """A draft."""

    name: str
    saved: float
    revision: str
    document: Document


class KeptDraft(TypedDict):
    """A draft as it was kept."""

    name: str
    saved: float
    revision: str


class ExampleEntry(TypedDict):
    """An example in a list."""

    name: str
    sentence: str


class ExampleList(TypedDict):
    """The examples."""

    examples: list[ExampleEntry]


class ExampleData(TypedDict):
    """An example."""

    kind: str
    document: Document


class Glance(TypedDict):
    """A document as a card shows it."""

    kind: str
    description: str
    robots: int | None
    extent: list[str]
    unit: str | None
    picture: str


class UnitNames(TypedDict):
    """Units of a scenario, each a name or null, and the instant of time 0."""

    length: str | None
    time: str | None
    start: NotRequired[str]


class FigureTexts(TypedDict):
    """Figures as people read them."""

    flowtime: Phrase | str
    makespan: Phrase | str
    lower_bound: Phrase | str
    alone: Phrase | str
    gap: Phrase | str


class Kept(TypedDict):
    """Number of robots that a plan has kept from the plan that it was made from."""

    routes: int
    tracks: int


class PlanFigures(TypedDict):
    """Costs of a plan [ticks]."""

    flowtime: int
    makespan: int
    lower_bound: int
    alone: int
    text: FigureTexts
    tick: Ratio
    units: UnitNames
    scenario: str
    start: NotRequired[Kept | None]
    robots: NotRequired[int]
    faults: NotRequired[int]


class RunRequest(TypedDict):
    """The settings of the task of a run; which there are depends on its kind."""

    planner: NotRequired[str]
    options: NotRequired[dict[str, str | int]]
    time_limit: NotRequired[float]
    seed: NotRequired[int]
    start: NotRequired[int]
    rule: NotRequired[str]
    routes: NotRequired[str | None]
    delays: NotRequired[list[str]]
    runs: NotRequired[int]
    run: NotRequired[int | str]
    switch: NotRequired[bool]
    replan: NotRequired[bool]
    revision: NotRequired[str]
    waits: NotRequired[str]
    goes_first: NotRequired[str]
    tick: NotRequired[int]


class RunData(TypedDict):
    """A run."""

    number: int
    name: str
    kind: Kind
    state: State
    request: RunRequest
    source: str
    based_on: int | None
    created: float
    started: float | None
    ended: float | None
    status: Phrase | None
    figures: PlanFigures | None
    error: ErrorData | None
    points: list[tuple[float, float]]
    revision: int
    has_report: bool
    has_payload: bool
    has_plan: bool


class RunNumber(TypedDict):
    """A run that was deleted."""

    number: int


class RunList(TypedDict):
    """The runs, the latest first."""

    runs: list[RunData]
    are_kept: bool


class RunProgress(TypedDict):
    """An event of a run that is going on."""

    number: int
    seconds: NotRequired[float]
    flowtime: NotRequired[int]
    lower_bound: NotRequired[int]
    progress: NotRequired[Phrase]


class PlanFound(TypedDict):
    """An event: a run has a better plan."""

    number: int
    revision: int
    figures: PlanFigures


class Opened(TypedDict):
    """A file that was opened."""

    path: str
    folder: str
    kind: Literal["scenario", "layout", "plan"]
    notes: NotRequired[list[Phrase | str]]
    document: NotRequired[Document]
    save_as: NotRequired[str]
    revision: NotRequired[str]
    figures: NotRequired[PlanFigures]
    run: NotRequired[RunData]


class PlacedDocument(TypedDict):
    """A document, and the folder that its paths are in."""

    document: Document
    folder: str


class Inlined(TypedDict):
    """A document with its map and robots in it."""

    document: Document


class FactAndRemedy(TypedDict):
    """A finding and its remedy."""

    fact: Phrase
    remedy: Phrase


class SiteFinding(TypedDict):
    """Weaknesses of a map."""

    kind: str
    severity: Literal["error", "warning", "note"]
    fact: FactData
    remedy: FactData
    vertices: list[str]
    robots: list[str]
    sentence: str
    phrases: FactAndRemedy


class SurveyData(TypedDict):
    """The view of an editor after each change."""

    ok: bool
    faults: list[DocumentFault]
    notes: list[Phrase | str]
    site: Payload | None
    findings: list[SiteFinding]
    sentences: list[str]
    phrases: list[Phrase]
    scenario: NotRequired[str | None]


class Validation(TypedDict):
    """The faults of a document."""

    ok: bool
    faults: list[DocumentFault]
    notes: list[Phrase | str]


class DealtRobot(TypedDict):
    """A robot that was dealt out."""

    name: str
    home: str
    target: str
    speed: Exact
    work: Exact


class Dealt(TypedDict):
    """Robots that were dealt out."""

    robots: list[DealtRobot]


class PastedJobs(TypedDict):
    """Jobs of rows of a table, as a document has them."""

    jobs: list[dict[str, Any]]


class PlannerOption(TypedDict):
    """An option of a planner."""

    name: str
    default: Exact
    summary: Phrase | str
    choices: list[str]
    least: Exact
    most: Exact | None
    whole: bool


class PlannerEntry(TypedDict):
    """A planner."""

    name: str
    summary: Phrase | str
    features: list[str]
    options: list[PlannerOption]


class PlannerList(TypedDict):
    """The planners; which is the default, and which improves plans."""

    default: str
    improver: str
    planners: list[PlannerEntry]


class DelayChoices(TypedDict):
    """Notations of delays, and the meaning of each."""

    default: str
    examples: dict[str, str]


class Choices(TypedDict):
    """Rules of laps, notations of delays, formats of exports, each with a sentence."""

    rules: dict[str, Phrase]
    delays: DelayChoices
    formats: dict[str, Phrase]


class Because(TypedDict):
    """A decision that a wait follows from."""

    index: int
    decision: str
    reason: str
    phrase: Phrase


LossData = TypedDict(
    "LossData",
    {
        "kind": str,
        "robot": str,
        "for": str | None,
        "vertex": str,
        "towards": str,
        "freed": str | None,
        "tick": int,
        "end": int,
        "ticks": int,
        "sentence": str,
        "phrase": Phrase,
        "because": list[Because],
    },
)
"""A wait, or another cause of lost time [ticks]."""


class LossList(TypedDict):
    """Why robots lose time."""

    losses: list[LossData]


class GroupRow(TypedDict):
    """The place of a robot at each time of a table, and its marks there."""

    robot: str
    kind: Literal["planned", "list 1", "list 2"]
    places: list[str]
    marks: list[Literal["collision", "swap", "near", "wait"] | None]


class MovementGroups(TypedDict):
    """Both movement groups of a decision: the paper's List 1 and List 2, and their sums."""

    heading: str
    times: list[str]
    rows: list[GroupRow]
    sums: list[Phrase]


class CommandLine(TypedDict):
    """The command line that gives the same; empty where none does."""

    command: str


class ScenarioChange(TypedDict):
    """Something in which a scenario differs from another one."""

    subject: Phrase | str
    robots: list[str]
    jobs: list[str]
    key: str
    before: Phrase | str
    after: Phrase | str
    text: str


class Changes(TypedDict):
    """Differences of the scenario of a run from that of a run before it."""

    before: int | None
    changes: list[ScenarioChange]


class ComparedFigures(PlanFigures):
    """Costs of a plan, compared with another one."""

    time: dict[str, float]


class RobotCompletions(TypedDict):
    """When a robot completes in each plan [time unit]; null where it is not in it."""

    name: str
    completion: list[float | None]


class Compared(TypedDict):
    """A comparison of plans."""

    runs: list[int]
    plans: list[ComparedFigures]
    robots: list[RobotCompletions]
    titles: list[str]
    comparison: Comparison


CirclePiece = TypedDict(
    "CirclePiece",
    {
        "kind": str,
        "robot": str,
        "after": str | None,
        "vertices": list[str],
        "for": Exact,
        "text": Phrase,
    },
)
"""A step of the circle that sets the pace of laps."""

LapConflict = TypedDict("LapConflict", {"robots": list[str], "waits": str, "for": Exact})
"""A wait that comes again in each period."""

CurvePiece = TypedDict(
    "CurvePiece", {"from": Exact, "to": Exact, "fixed": Exact, "slope": Exact, "circuit": int}
)
"""The period as a function of a value, from one value to another."""


class CurveData(TypedDict):
    """The period as a function of a speed, a work time or the headway."""

    kind: Literal["speed", "work", "headway"]
    robot: str | None
    stop: int | None
    value: Exact
    pieces: list[CurvePiece]


class CircuitData(TypedDict):
    """A circle that sets the pace for some values."""

    periods: int
    pieces: list[CirclePiece] | None
    visits: list[Ratio]


class Curves(TypedDict):
    """The period as functions of parameters."""

    exact: bool
    why: FactData | None
    reason: Phrase | None
    curves: list[CurveData]
    circuits: list[CircuitData]


class LapGroup(TypedDict):
    """Robots that share places, and how they repeat themselves; null where they do not."""

    robots: list[str]
    why: FactData | None
    reason: Phrase | str
    period: Exact | None
    laps_per_period: dict[str, int]
    mean_lap: dict[str, Exact | None]
    waiting_share: dict[str, Exact | None]
    conflicts: list[LapConflict] | None
    bottleneck: list[CirclePiece] | None
    curves: Curves | None


class LapsAnswer(TypedDict):
    """Results of laps in a new order."""

    groups: list[LapGroup]


class LapsReport(TypedDict):
    """Results of a fleet that repeats its trips."""

    units: UnitNames
    groups: list[LapGroup]


class LatenessFigures(TypedDict):
    """Lateness over all runs [ticks]."""

    median: float
    p90: float
    max: float


class RobotLatenessData(TypedDict):
    """How late a robot is over all runs, by itself and for others [ticks]."""

    name: str
    mean: float
    p95: float
    own: float
    waiting: dict[str, float]


class LatenessData(TypedDict):
    """Lateness of the fleet and of each robot."""

    flowtime: LatenessFigures
    robots: list[RobotLatenessData]


class ByClock(TypedDict):
    """Collisions of robots that drive by the clock alone."""

    share_of_runs: float


SpreadData = TypedDict(
    "SpreadData",
    {"counts": list[int], "planned": int, "from": float, "to": float},
)
"""Numbers of runs by flowtime [ticks]."""


class Ranks(TypedDict):
    """Runs from the best to the worst."""

    rank: list[int]
    run: list[int]
    flowtime: list[int | None]


class DelaysReport(TypedDict):
    """Results of a plan with delays."""

    units: UnitNames
    tick: Exact
    runs: int
    collisions: int
    played: int
    lateness: LatenessData
    by_clock: ByClock
    spread: SpreadData | None
    ranks: Ranks


class PlanSummary(TypedDict):
    """The report of `plan --json`; the page shows the plan itself."""


Report = LapsReport | DelaysReport | PlanSummary


class FlippedPlan(TypedDict):
    """A timetable in which another robot goes first."""

    before: PlanFigures
    run: RunData


class DriveData(TypedDict):
    """A plan that simulated robots drive, or have driven; ``page`` is where to watch them."""

    number: int
    run: int
    state: Literal["driving", "done", "stopped", "failed"]
    error: ErrorData | None
    page: str


class DriveList(TypedDict):
    """The drives of a studio, the latest first."""

    drives: list[DriveData]


ANSWERS: dict[tuple[str, str], Any] = {
    ("GET", "/"): About,
    ("GET", "/files"): FileList,
    ("PUT", "/files/{path}"): Saved,
    ("GET", "/documents/{path}"): Opened,
    ("PUT", "/documents/{path}"): Saved,
    ("POST", "/validate"): Validation,
    ("POST", "/survey"): SurveyData,
    ("POST", "/inline"): Inlined,
    ("POST", "/deal"): Dealt,
    ("POST", "/rows"): PastedJobs,
    ("GET", "/drafts"): DraftList,
    ("GET", "/drafts/{name}"): DraftData,
    ("PUT", "/drafts/{name}"): KeptDraft,
    ("GET", "/examples"): ExampleList,
    ("GET", "/examples/{name}"): ExampleData,
    ("GET", "/glances/{source}/{name}"): Glance,
    ("GET", "/planners"): PlannerList,
    ("GET", "/choices"): Choices,
    ("GET", "/runs"): RunList,
    ("POST", "/runs"): RunData,
    ("GET", "/runs/{number}"): RunData,
    ("PATCH", "/runs/{number}"): RunData,
    ("DELETE", "/runs/{number}"): RunNumber,
    ("POST", "/runs/{number}/stop"): RunData,
    ("POST", "/runs/{number}/cancel"): RunData,
    ("GET", "/runs/{number}/payload"): Payload,
    ("GET", "/runs/{number}/document"): PlacedDocument,
    ("GET", "/runs/{number}/command"): CommandLine,
    ("GET", "/runs/{number}/losses"): LossList,
    ("GET", "/runs/{number}/decisions/{decision}"): MovementGroups,
    ("GET", "/runs/{number}/report"): Report,
    ("GET", "/runs/{number}/changes"): Changes,
    ("POST", "/runs/{number}/laps"): LapsAnswer,
    ("POST", "/runs/{number}/flip"): FlippedPlan,
    ("GET", "/compare"): Compared,
    ("GET", "/drives"): DriveList,
    ("POST", "/runs/{number}/drives"): DriveData,
    ("GET", "/drives/{number}"): DriveData,
    ("POST", "/drives/{number}/stop"): DriveData,
}
"""Answers of the routes of the page; `RefusalData` for refusals."""

BODIES: dict[tuple[str, str], Any] = {
    ("PUT", "/documents/{path}"): Save,
    ("POST", "/validate"): Placed,
    ("POST", "/survey"): Survey,
    ("POST", "/inline"): Placed,
    ("POST", "/deal"): Deal,
    ("POST", "/rows"): Rows,
    ("PUT", "/drafts/{name}"): DraftBody,
    ("POST", "/runs"): NewRun,
    ("PATCH", "/runs/{number}"): Rename,
    ("POST", "/runs/{number}/laps"): OtherLaps,
    ("POST", "/runs/{number}/flip"): Flip,
    ("POST", "/runs/{number}/drives"): NewDrive,
}
"""Bodies of these routes."""

EVENTS: dict[str, type] = {
    "runs": RunList,
    "run": RunData,
    "progress": RunProgress,
    "plan": PlanFound,
    "deleted": RunNumber,
}
"""Data of the events of `/events`."""
