"""Input of pages, as types: plain data for JSON, written by Python, read by JavaScript.

``assets/payload.d.ts`` has the same for JavaScript; ``just types-refresh`` writes it. Times are
ticks, places are in units of the drawing, robots and vertices are given by index.
"""

from __future__ import annotations

from typing import Literal, NotRequired

from typing_extensions import TypeAliasType, TypedDict

StageRow = TypeAliasType("StageRow", tuple[int, int, int, int])
"""Vertex, work, turn, visit; the visit is -1 where the stage is not reached."""

TurnRow = TypeAliasType("TurnRow", tuple[int, int])
"""Visit, ticks."""

LossRow = TypeAliasType(
    "LossRow", tuple[int, int, int | None, int, int, int, int | None, int, int, int, int]
)
"""Kind, robot, for robot, vertex, until, towards, freed, tick, end, ticks, text; see `Loss`."""

JobStopRow = TypeAliasType("JobStopRow", tuple[int, int, int, int])
"""Vertex, change of load, begin and end of the work; both are -1 where a plan lacks it."""

JobCostRow = TypeAliasType("JobCostRow", tuple[int, int | None])
"""Robot, ticks that the job adds to the objective; null where it does not fit."""

TourRow = TypeAliasType("TourRow", tuple[int, int, int, int, int, int])
"""Job, stop (both are -1 for a charge), vertex, begin, end, load after it."""

SliceRow = TypeAliasType("SliceRow", tuple[int, int, int, float | None, float | None])
"""End of a part of a shift, jobs done and late, median and 95th percentile of service times."""

UseRow = TypeAliasType("UseRow", tuple[int, int, int, int, int, int])
"""Jobs done by a robot, ticks of driving, waiting, working, charging, and the rest."""

RoundRow = TypeAliasType("RoundRow", tuple[int, int, int, int, int])
"""Begin, takeover, milliseconds, jobs, 1 where the old plan stood."""

ObstacleRow = TypeAliasType("ObstacleRow", tuple[str, float, float, float, float])
"""Name, left, top, width, height."""

PhraseData = TypeAliasType("PhraseData", "str | tuple[str, dict[str, PhraseData]]")
"""Text, or an English template and its values."""

PhraseEntry = TypeAliasType("PhraseEntry", "str | list[int]")
"""Text, or the index of a template and of its values; see `PhraseBook`."""


RouteRow = TypeAliasType("RouteRow", tuple[float, int, Literal["route"], int, list[int]])
"""Tick, robot, kind, the first visit that is another one, the vertices from there on."""

VisitRow = TypeAliasType("VisitRow", tuple[float, int, Literal["arrived", "released", "done"], int])
"""Tick, robot, kind, visit: arrived at, released up to, done with its work."""

HoldRow = TypeAliasType("HoldRow", tuple[float, int, Literal["hold", "off"], bool])
"""Tick, robot, kind, whether a person holds it, or has taken it off the floor."""

SaysRow = TypeAliasType(
    "SaysRow",
    tuple[
        float,
        int,
        Literal["says"],
        Literal["work", "drive", "wait", "end", "news", "alarm"],
        PhraseData,
        list[int],
    ],
)
"""Tick, robot (-1 for none), kind, what it is about, sentence, robots that are waited for."""

TaskRow = TypeAliasType("TaskRow", tuple[float, int, Literal["task"], PhraseData])
"""Tick, robot, kind, what it does for a job or that it charges; empty for neither."""

ChargeRow = TypeAliasType("ChargeRow", tuple[float, int, Literal["charge"], int])
"""Tick, robot, kind, state of charge [%]."""

AlarmRow = TypeAliasType("AlarmRow", tuple[float, int, Literal["alarm"], str, PhraseData | None])
"""Tick, robot (-1 for none), kind, the kind of trouble, the sentence; null where it ends."""

SeenRow = TypeAliasType("SeenRow", tuple[float, int, Literal["seen"], str, str])
"""Tick, robot (-1 for none), kind, the kind of trouble, the person who has seen the alarm."""

DrivenRow = TypeAliasType(
    "DrivenRow", RouteRow | VisitRow | HoldRow | TaskRow | ChargeRow | SaysRow | AlarmRow | SeenRow
)
"""Something that happened to a fleet that is driven."""


PunctualityRow = TypeAliasType("PunctualityRow", tuple[int, int, int, float | None])
"""Jobs done, open and late, mean delay of those done [ticks]; see `Punctuality`."""

EndRow = TypeAliasType(
    "EndRow", tuple[str, int, int | None, int | None, int | None, int | None, int | None, bool]
)
"""Name, robot (-1 for none), planned, due, actual and expected end, delay, whether it is late."""


class UnitsData(TypedDict):
    """The names of the units, null where the scenario names none; the instant of time 0."""

    length: str | None
    time: str | None
    start: NotRequired[str]


class FrameData(TypedDict):
    """The position of (0, 0) of the drawing on the site, and the length of its unit there."""

    x: float
    y: float
    yUp: bool
    unit: float
    yaw: NotRequired[float]


class PlaceData(TypedDict):
    """The position of a picture: upper left corner, size, and rotation about that corner [rad]."""

    x: float
    y: float
    width: float
    height: float
    turn: NotRequired[float]


class BackgroundData(PlaceData):
    """A picture under the map; without ``href`` for a page that has the picture itself."""

    href: NotRequired[str]
    opacity: float


class CloseData(TypedDict, total=False):
    """Places that are too near: pairs of lanes, a vertex and a lane, pairs of vertices."""

    crossings: list[tuple[int, int, int, int]]
    beside: list[tuple[int, int, int]]
    vertices: list[tuple[int, int]]


class MapMarks(TypedDict):
    """The parts of every map."""

    width: float
    height: float
    frame: FrameData
    limits: NotRequired[list[tuple[str, list[int]]]]
    passed: NotRequired[list[int]]
    zones: NotRequired[list[tuple[str, list[int], list[tuple[int, int]]]]]
    stations: NotRequired[list[tuple[str, int]]]
    parking: NotRequired[list[int]]
    charging: NotRequired[list[int]]
    background: NotRequired[BackgroundData]


class GridData(MapMarks):
    """A map of cells."""

    rows: list[str]
    obstacles: NotRequired[list[ObstacleRow]]


class NetworkData(MapMarks):
    """A map of vertices and lanes; tails and heads are first differences.

    A curve has tail, head, and the points between them as x, y, x, y, …; joints are the vertices
    between the pieces of each split lane.
    """

    names: list[str]
    points: list[float]
    tails: list[int]
    heads: list[int]
    lengths: list[float]
    sides: NotRequired[list[float]]
    joints: NotRequired[list[list[int]]]
    curves: NotRequired[list[list[float]]]
    close: NotRequired[CloseData]


MapData = TypeAliasType("MapData", GridData | NetworkData)


class RobotData(TypedDict):
    """A robot and its track; ``vertices`` and ``enter`` are first differences.

    ``begins`` has for each stage when its work begins at the earliest, ``charges`` the stages that
    are charges. A robot that ``idles`` has
    nothing to do where it stays at home.
    """

    name: str
    colour: str
    speed: str
    radius: NotRequired[float]
    completion: int
    alone: int
    lost: tuple[int, int, int]
    vertices: list[int]
    enter: list[int]
    drive: int | list[int]
    stages: list[StageRow]
    begins: NotRequired[list[int]]
    charges: NotRequired[list[int]]
    turns: NotRequired[list[TurnRow]]
    stands: NotRequired[Literal[True]]
    idles: NotRequired[Literal[True]]
    index: NotRequired[int]


ClosureData = TypedDict(
    "ClosureData",
    {
        "vertices": list[int],
        "from": int,
        "until": int | None,
        "radius": float | None,
        "text": PhraseData,
    },
)


class SiteData(TypedDict):
    """A map with robots at their homes."""

    title: NotRequired[str]
    units: UnitsData
    tick: tuple[int, int]
    clearance: NotRequired[float]
    map: MapData
    robots: list[RobotData]
    closures: NotRequired[list[ClosureData]]


class FaultData(TypedDict):
    """A place where the plan breaks a rule, or a reason why there is no plan; texts by index."""

    kind: str
    name: int
    reason: int
    remedy: int
    tick: int
    robots: list[int]
    vertices: list[int]


class FaultsData(TypedDict):
    """Numbers of faults of each kind, by the index of its name, and the first faults."""

    count: int
    kinds: list[tuple[int, int]]
    listed: list[FaultData]


class ForcedLossData(TypedDict):
    """Robots that lose time in every plan, and where they would meet; texts are by index.

    ``tick`` is when the last of them is there in this plan; 0 where none comes there.
    """

    head: int
    text: int
    robots: list[int]
    vertices: list[int]
    tick: int


class PlannerData(TypedDict):
    """How the plan came about: the planner, its actions or gains, its proof."""

    name: str
    method: PhraseData
    proven: NotRequired[PhraseData]


class DecisionData(TypedDict):
    """Which of two robots got the right of way, and why; see `Decision`. Texts are by index.

    ``figures`` has the measure, then its values if the first and if the other robot waits.
    """

    head: int
    detail: int
    story: int
    reason: int
    tick: int
    kind: Literal["vertex", "head-on", "following", "crossing"]
    vertices: list[int]
    robots: tuple[int, int]
    waits: int
    waitsAt: int
    ticks: int
    level: Literal["node", "robot", "settled", "priority", "only"]
    figures: list[tuple[int, int, int]]


class RerouteData(TypedDict):
    """A robot that was rerouted."""

    robot: int
    because: PhraseData


class MetricsData(TypedDict):
    """The costs of the plan."""

    flowtime: int
    makespan: int
    lowerBound: int


class SteadyData(TypedDict):
    """Robots that repeat themselves together; critical visits are pairs of robot and visit.

    The bottleneck has two texts: in short, and its steps.
    """

    robots: list[int]
    start: int
    period: int
    until: int
    critical: list[tuple[int, int]]
    bottleneck: NotRequired[tuple[int, int]]


class DrivenData(TypedDict):
    """The executed track of a robot; ``vertices`` is there where they are not as planned."""

    stages: list[StageRow]
    turns: NotRequired[list[TurnRow]]
    vertices: NotRequired[list[int]]
    enter: list[int]
    drive: list[int]
    still: list[tuple[int, int | None]]
    completion: int | None


class FloorData(TypedDict):
    """An execution of the plan."""

    end: int
    robots: list[DrivenData]
    losses: list[LossRow]


class EndsData(TypedDict):
    """Planned ends next to actual or expected ones, the latest first: of jobs, or of all robots.

    ``robots`` has a row for each robot, and none in a plan without jobs.
    """

    hasJobs: bool
    all: PunctualityRow
    robots: list[PunctualityRow]
    rows: list[EndRow]


class DrivenFrame(TypedDict):
    """Events since the frame before; ``begins`` where there are none before.

    ``ends`` is there where it differs from that of the frame before.
    """

    number: int
    now: float
    runs: bool
    begins: bool
    rows: list[DrivenRow]
    ends: NotRequired[EndsData | None]


class FeedData(TypedDict):
    """A fleet that is driven: its events, and the address of further ones, if there are any.

    ``stream`` is the address of frames; ``orders`` that to which orders of people are sent.
    """

    frame: DrivenFrame
    stream: NotRequired[str]
    orders: NotRequired[str]


class ChangeData(TypedDict):
    """Something in which a scenario differs from another one; see `Change`."""

    subject: PhraseData
    robots: list[str]
    jobs: list[str]
    key: str
    before: PhraseData
    after: PhraseData
    text: str


class FiguresText(TypedDict):
    """Figures as people read them."""

    flowtime: PhraseData
    makespan: PhraseData
    lower_bound: PhraseData
    alone: PhraseData
    gap: PhraseData
    seconds: PhraseData


class ComparedPlan(TypedDict):
    """Costs of a plan in the ticks of a comparison, and its scenario's changes."""

    planner: str
    seed: int
    seconds: float | None
    flowtime: int
    makespan: int
    lower_bound: int
    alone: int
    gap: float | None
    robots: int
    faults: int
    text: FiguresText
    changes: list[ChangeData]


class BestData(TypedDict):
    """For each figure, the places of the plans with the smallest one."""

    flowtime: list[int]
    makespan: list[int]
    gap: list[int]
    seconds: list[int]


class ComparedRobot(TypedDict):
    """When a robot completes in each plan; null where it is not there."""

    name: str
    completion: list[int | None]


class ComparisonData(TypedDict):
    """A comparison of plans."""

    tick: tuple[int, int]
    units: UnitsData
    scales: list[int]
    plans: list[ComparedPlan]
    best: BestData
    robots: list[ComparedRobot]


class JobData(TypedDict):
    """A job: its stops, who does it, or why nobody does.

    ``times`` has begin, end, service time, and how late it is; the reason is by the index of its
    text. ``costs`` has the robots that may do it, those of least cost first.
    """

    name: str
    stops: list[JobStopRow]
    robot: NotRequired[int]
    times: NotRequired[tuple[int, int, int, int]]
    reason: NotRequired[int]
    due: NotRequired[int]
    costs: NotRequired[list[JobCostRow]]


class TourData(TypedDict):
    """An item of a robot's tour; ``load`` is that at its begin.

    ``charges`` has ticks and states of charge, which change evenly between them.
    """

    items: list[TourRow]
    load: int
    capacity: int
    reserve: NotRequired[float]
    charges: NotRequired[list[tuple[int, float]]]


class WorkData(TypedDict):
    """The jobs of a plan, and a tour for each robot."""

    jobs: list[JobData]
    tours: list[TourData]


class ShiftData(TypedDict):
    """A shift, whose plan is all that robots have done.

    ``known`` has for each job when it became known, ``waits`` for each robot the others that it
    waited for and ticks, the longest first; ``bottlenecks`` the same of vertices. ``service`` has
    median, 95th percentile and maximum. Texts of the reasons of jobs, of rounds, and of what
    happened are by index.
    """

    until: int
    done: int
    late: int
    underWay: int
    unserved: list[tuple[int, int]]
    service: NotRequired[tuple[float, float, int]]
    slices: list[SliceRow]
    known: list[int]
    robots: list[UseRow]
    waits: list[list[tuple[int, int]]]
    bottlenecks: list[tuple[int, int]]
    rounds: list[RoundRow]
    told: list[tuple[int, int]]
    happened: list[tuple[int, int]]


class PlanData(TypedDict):
    """A plan without its map; ``line`` has vertices with their distances along a line.

    ``places`` has the cells that are called after robots, with the text of each, by index.
    """

    title: str
    phrases: list[PhraseEntry]
    units: UnitsData
    tick: tuple[int, int]
    end: int
    headway: int
    booksAhead: bool
    line: list[tuple[int, float]]
    robots: list[RobotData]
    losses: list[LossRow]
    faults: FaultsData
    planner: PlannerData
    decisions: list[DecisionData]
    reroutes: list[RerouteData]
    forcedLosses: NotRequired[list[ForcedLossData]]
    metrics: MetricsData
    steady: NotRequired[list[SteadyData]]
    laps: NotRequired[list[int]]
    closures: NotRequired[list[ClosureData]]
    clearance: NotRequired[float]
    floor: NotRequired[FloorData]
    noPlan: NotRequired[Literal[True]]
    places: NotRequired[list[tuple[int, int]]]
    work: NotRequired[WorkData]
    shift: NotRequired[ShiftData]


class OtherPlan(PlanData):
    """A plan that another one is compared with; its map is that of the other one, or its own."""

    map: NotRequired[MapData]


class Payload(PlanData):
    """Input of the page of a plan."""

    map: MapData
    driven: NotRequired[FeedData]
    others: NotRequired[list[OtherPlan]]
    comparison: NotRequired[ComparisonData]


class FindingData(TypedDict):
    """A problem of a site."""

    severity: Literal["error", "warning", "note"]
    kind: str
    fact: PhraseData
    remedy: PhraseData
    vertices: list[int]
    robots: list[int]


class LevelData(SiteData):
    """A site that was inspected; its name is empty where there is only one."""

    name: str
    sentences: list[PhraseData]
    findings: list[FindingData]


class InspectionPayload(TypedDict):
    """Input of the page of an inspection."""

    title: str
    description: PhraseData
    notes: list[PhraseData]
    names: dict[Literal["error", "warning", "note"], PhraseData]
    headings: dict[Literal["error", "warning", "note"], PhraseData]
    levels: list[LevelData]
