"""
The native kernels: arrays and integers in, arrays and integers out.

ValueError names the array, the index and the value that do not fit. ``time_limit`` [s]
stops a search; long calls release the GIL and obey Ctrl-C. All are deterministic.

``CONFLICT_CAP`` is the most that one conflict counts, also if it never ends;
``NEVER`` is the end of a booking that never ends. [ticks]
"""

from collections.abc import Sequence
import enum
from typing import Annotated

import numpy
from numpy.typing import NDArray


CONFLICT_CAP: int = 4294967296

NEVER: int = 4611686018427387904

def compiler() -> str:
    """Return the name and version of what compiled this module."""

class Roads:
    """
    The directed graph of a roadmap. The arrays are not copied: they must not change.

    Parameters
    ----------
    indptr, heads : int32[V + 1], int32[E]
        The edges that leave vertex ``v`` are ``indptr[v] .. indptr[v + 1] - 1``, and edge ``e`` ends
        at ``heads[e]``.
    length_class : int32[E]
        The length class of each edge.
    n_classes : int
        The number of length classes, C.
    """

    def __init__(self, indptr: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], heads: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], length_class: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], n_classes: int) -> None: ...

class Robots:
    """
    The robots of a fleet. The arrays are not copied: they must not change.

    Parameters
    ----------
    paces : int32[P * C]
        Ticks for an edge of each of the C length classes, one row for each pace; -1 where it is barred.
    pace_of : int32[R]
        The pace of each robot.
    home : int32[R]
        Where each robot is at tick 0.
    first_stage : int32[R + 1]
        Robot ``r`` owns stages ``first_stage[r] .. first_stage[r + 1] - 1``, at least one; it stays at
        the last one.
    stage_vertex, stage_work, stage_turn : int32[S], int64[S], int64[S]
        Where each stage is, and how long it takes to work and then to turn. [ticks]
    size_of : int32[R] or None
        The size class of each robot; None where all are points.
    weight : int64[R] or None
        How much a tick of each robot counts; None where all count alike.
    """

    def __init__(self, paces: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], pace_of: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], home: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], first_stage: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], stage_vertex: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], stage_work: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], stage_turn: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], size_of: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)] | None = None, weight: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)] | None = None) -> None: ...

class BookingRules:
    """
    The rules that turn visits into bookings.

    Parameters
    ----------
    headway : int
        How long a vertex stays booked after it was left. [ticks]
    books_ahead : bool
        Whether a vertex is booked from when a robot starts to drive there.
    rotations : bool
        Whether three or more robots may move round a circle at one instant, where bookings allow it.
    """

    def __init__(self, headway: int, books_ahead: bool, rotations: bool = True) -> None: ...

class Drawing:
    """
    Where the vertices of a roadmap lie. The arrays are not copied: they must not change.

    Parameters
    ----------
    x, y : float64[V]
        Coordinates from the least ones. [length unit]
    limbs : uint32[2 * V * L]
        The same, exactly: for each vertex x, then y, as a whole multiple of one length in L limbs of 32
        bits, the least first.
    is_grid : bool
        Whether the vertices are cells of a grid, which lanes join: no lane passes a vertex or crosses
        another one then.
    """

    def __init__(self, x: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], y: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], limbs: Annotated[NDArray[numpy.uint32], dict(shape=(None,), order='C', device='cpu', writable=False)], is_grid: bool) -> None: ...

class ExcludedRows:
    """
    The rows from which a booking of each row excludes other robots.

    The list of a row is found when it is first asked for, and kept. Row ``size * (V + E) + resource``
    is a vertex or an edge as robots of one of K size classes book it; the vertices come first.

    Parameters
    ----------
    roads : Roads
        The graph.
    drawing : Drawing
        Where its vertices lie.
    distance, distance_limbs : float64[K * K], uint32[K * K * L]
        How far apart the middles of robots of two size classes are at least, 0 for two points; and the
        same exactly, as coordinates are. [length unit]
    zone_first, zone_member : int32[Z + 1], int32[n]
        Zone ``z`` has the resources ``zone_member[zone_first[z]:zone_first[z + 1]]``.
    chain_first, chain_vertex : int32[C + 1] or None, int32[n] or None
        Chain ``c`` is driven without a stop along ``chain_vertex[chain_first[c]:chain_first[c + 1]]``.

    Raises
    ------
    ValueError
        If the arrays do not fit together; names the array, the index and the value.
    """

    def __init__(self, roads: Roads, drawing: Drawing, distance: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], distance_limbs: Annotated[NDArray[numpy.uint32], dict(shape=(None,), order='C', device='cpu', writable=False)], zone_first: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], zone_member: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], chain_first: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)] | None = None, chain_vertex: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)] | None = None) -> None: ...

    @property
    def n_rows(self) -> int:
        """The number of rows."""

    @property
    def n_found(self) -> int:
        """How many rows have been asked for so far."""

    def of(self, row: int) -> Annotated[NDArray[numpy.int32], dict(shape=(None,))]:
        """
        Return the rows that a row excludes, in increasing order; int32[n].

        Parameters
        ----------
        row : int
            The row.
        """

class Turning:
    """
    How long robots turn on the spot between two edges.

    Parameters
    ----------
    offset, kind : int64[E], int32[n]
        The angle from edge ``e`` to edge ``f`` is of kind ``kind[offset[e] + f]``.
    class_of, ticks : int32[R], int32[T * K]
        A robot of turning class t turns it in ``ticks[t * K + kind]`` ticks, and in no time where its
        class is -1.
    n_kinds : int
        K.
    """

    def __init__(self, offset: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], kind: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], class_of: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], ticks: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], n_kinds: int) -> None: ...

class Closures:
    """
    Bookings of nobody.

    Parameters
    ----------
    row, start, end : int32[K], int64[K], int64[K]
        Rows of the booking table that are closed, and when. [ticks]
    """

    def __init__(self, row: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], start: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], end: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> None: ...

class Work:
    """
    When stages may be served, and how robots begin and end.

    The last stage of a robot that ends anywhere is at vertex -1.

    Parameters
    ----------
    earliest, latest : int64[S], int64[S]
        The work of each stage begins at `earliest` or later, and ends at `latest` or before. [ticks]
    ready : int64[R]
        Until when each robot stays at its home. [ticks]
    first_turn_of, first_turn : int32[R + 1], int32[n]
        Robot ``r`` turns in ``first_turn[first_turn_of[r] + k]`` ticks before it first drives along the
        k-th edge out of its home; in no time where the list is empty.
    before, after : int32[A], int32[A]
        The work of stage ``before[k]`` ends before that of stage ``after[k]`` of another robot begins.
    n_places : int
        Robots that end anywhere end at a vertex below.
    cost, late_cost, due : int64[S] or None
        What a tick of the end of each stage costs, and what a tick after `due` costs more; None where
        only completions cost.
    """

    def __init__(self, earliest: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], latest: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], ready: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], first_turn_of: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], first_turn: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], before: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], after: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], n_places: int, cost: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)] | None = None, late_cost: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)] | None = None, due: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)] | None = None) -> None: ...

class Problem:
    """
    A scenario in ticks: roads, robots and booking rules.

    Immutable; searches are given one.

    Parameters
    ----------
    roads : Roads
        The graph.
    robots : Robots
        Paces, homes, stages.
    rules : BookingRules
        How visits are booked.
    lists : ExcludedRows or None
        The excluded rows of all rows; None where all robots are points and a vertex excludes itself. Row ``size * (V + E) + resource`` is a vertex
        or an edge as robots of one size class book it; the vertices come first.
    turning : Turning or None
        How long robots turn; None where turning takes no time.
    surcharges : int64[C] or None
        What an edge of each length class adds to costs, not to durations; None where all are 0. [ticks]
    closures : Closures or None
        What is closed for a while.
    work : Work or None
        Times of stages; None for a fleet without jobs.

    Raises
    ------
    ValueError
        If the arrays do not fit together; names the array, the index and the value.
    """

    def __init__(self, roads: Roads, robots: Robots, rules: BookingRules, lists: ExcludedRows | None = None, turning: Turning | None = None, surcharges: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)] | None = None, closures: Closures | None = None, work: Work | None = None) -> None: ...

    @property
    def n_robots(self) -> int:
        """The number of robots, R."""

    @property
    def n_vertices(self) -> int:
        """The number of vertices, V."""

    @property
    def rules(self) -> BookingRules:
        """How visits are booked."""

def find_overlaps(vertex: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], robot: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], start: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], end: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], most: int, time_limit: float | None = None) -> tuple[Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))], bool]:
    """
    Return which bookings of different robots overlap at a vertex, and whether these are all.

    Bookings come by vertex, then by start.

    Parameters
    ----------
    vertex, robot : int32[N]
        Where each booking is, and of which robot.
    start, end : int64[N]
        From when to when it lasts, the end excluded. [ticks]
    most : int
        How many pairs to find at most.
    time_limit : float or None
        After how long to stop. [s]

    Returns
    -------
    tuple of (int32[K], int32[K], bool)
        The earlier and the later booking of each pair; false if there may be more of them.
    """

class Routes:
    """
    Fixed visits of robots, robot by robot.

    Parameters
    ----------
    first_visit : int32[R + 1]
        Robot ``r`` owns visits ``first_visit[r] .. first_visit[r + 1] - 1``, at least one.
    vertex : int32[N]
        The vertex of each visit; consecutive visits of a robot are at different vertices.
    dwell, drive : int64[N]
        The least duration of each visit without the drive after it, and the drive into it. [ticks]

    Raises
    ------
    ValueError
        If the durations do not fit; names the array, the index and the value.
    """

    def __init__(self, first_visit: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], vertex: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], dwell: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], drive: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> None: ...

class VisitRows:
    """
    What visits book, where robots have sizes.

    Parameters
    ----------
    lists : ExcludedRows
        The rows that each row excludes.
    vertex, edge : int32[N]
        The row that each visit books at its vertex, and along the edge driven out of it; -1 for the
        edge of last visits.
    """

    def __init__(self, lists: ExcludedRows, vertex: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], edge: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> None: ...

class VisitClosures:
    """
    When the places of visits are closed.

    Parameters
    ----------
    first : int32[2 N + 1]
        The vertex of visit ``x`` has the entries ``first[2 x] .. first[2 x + 1] - 1``, the edge driven
        into it those from ``first[2 x + 1]`` on.
    start, end : int64[K]
        When each entry is closed. [ticks]
    """

    def __init__(self, first: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], start: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], end: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> None: ...

class RoundTrip:
    """
    What a robot has to do in one lap, whose route is not chosen yet.

    Parameters
    ----------
    pace : int32[C]
        What an edge of each length class takes. [ticks]
    stage_vertex : int32[S]
        The vertex of each stage, in order; the trip begins and ends at the last one.
    stage_work, stage_turn : int64[S], int64[S]
        How long the robot works there, and then turns. [ticks]
    stage_tables : list of int32[V]
        For each stage, the least ticks from each vertex to its vertex; -1 where the robot must not
        go.
    turning : Turning or None
        How long the robot turns; it is the only one there. None where turning takes no time.
    """

    def __init__(self, pace: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], stage_vertex: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], stage_work: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], stage_turn: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], stage_tables: Sequence[Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)]], turning: Turning | None = None) -> None: ...

class PeriodicBookings:
    """
    Bookings of vertices with a period or none, and when one more robot can make given visits.

    Parameters
    ----------
    rules : BookingRules
        How visits are booked.
    n_rows : int
        The number of vertices; where robots have sizes, of rows.
    period : int or None
        All bookings come again after it; None for a line of time. [ticks]
    lists : ExcludedRows or None
        Where robots have sizes: the lists of all rows.
    """

    def __init__(self, rules: BookingRules, n_rows: int, period: int | None, lists: ExcludedRows | None = None) -> None: ...

    @property
    def reached(self) -> int:
        """
        The last visit that the latest search could enter; it got stuck at the next.
        """

    def add(self, robot: int, vertex: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], dwell: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], drive: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], enter: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], leave: int | None = None, edge: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)] | None = None) -> bool:
        """
        Book consecutive visits of a robot, with a period all those of one period.

        Parameters
        ----------
        robot : int
            The robot.
        vertex, dwell, drive : int32[N], int64[N], int64[N]
            Of each visit the vertex, the least duration without the drive that follows, and the drive into
            it. [ticks]
        enter : int64[N]
            When each begins, rising; with a period, all within one. [ticks]
        leave : int or None
            When the last one ends; None with a period: when the first one comes again. [ticks]
        edge : int32[N] or None
            Where robots have sizes: the row of the edge driven into each visit; ``vertex`` holds rows, too.

        Returns
        -------
        bool
            With a period, whether no booking overlaps another robot's; otherwise nothing is booked. Without
            one, overlaps are not checked.
        """

    def remove(self, robot: int) -> None:
        """
        Remove all bookings of a robot; nothing happens if it has none.

        Parameters
        ----------
        robot : int
            The robot.
        """

    def users(self, vertices: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], begins: int = -4611686018427387904, ends: int = 4611686018427387904) -> Annotated[NDArray[numpy.int32], dict(shape=(None,))]:
        """
        Return the robots that have booked any of some vertices, rising, int32[K].

        Parameters
        ----------
        vertices : int32[n]
            The vertices, or rows.
        begins, ends : int
            Bookings count that overlap ``[begins, ends)``; with a period, in the period of their start.
            [ticks]
        """

    def search(self, vertex: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], dwell: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], drive: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], phase: int, time_limit: float | None, edge: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)] | None = None) -> Annotated[NDArray[numpy.int64], dict(shape=(None,))] | None:
        """
        Return when a robot can repeat its visits among the bookings of others, int64[N], or None.

        Parameters
        ----------
        vertex, dwell, drive : int32[N], int64[N], int64[N]
            The visits, as for `add`.
        phase : int
            The tick from which on starts are tried. [ticks]
        time_limit : float or None
            When to stop; at once for 0 or less. [s]
        edge : int32[N] or None
            As for `add`.

        Notes
        -----
        Needs a period. Complete for these visits, unless no other robot visits the first vertex: then only
        this phase is tried.
        """

    def connect(self, vertex: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], dwell: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], drive: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], begins: int, until: int, leave: int, edge: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)] | None = None) -> Annotated[NDArray[numpy.int64], dict(shape=(None,))] | None:
        """
        Return the earliest ticks for visits between two given ones, int64[N], or None.

        Parameters
        ----------
        vertex, dwell, drive : int32[N], int64[N], int64[N]
            The visits, as for `add`.
        begins : int
            When the first visit begins. [ticks]
        until, leave : int
            By when the last visit begins, and when it ends. [ticks]
        edge : int32[N] or None
            As for `add`.
        """

    def find_route(self, roads: Roads, trip: RoundTrip, phase: int, time_limit: float | None, first_row: int = 0) -> tuple[Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int64], dict(shape=(None,))], Annotated[NDArray[numpy.int64], dict(shape=(None,))], Annotated[NDArray[numpy.int64], dict(shape=(None,))]] | None:
        """
        Find a route for a round trip, and when to take it, among the bookings of others.

        Parameters
        ----------
        roads : Roads
            The graph to drive on.
        trip : RoundTrip
            What the robot has to do.
        phase : int
            The tick from which on starts are tried. [ticks]
        time_limit : float or None
            When to stop; at once for 0 or less. [s]
        first_row : int
            Where robots have sizes: the first row of the robot's size class; else 0.

        Returns
        -------
        tuple of (int32[N], int64[N], int64[N], int64[N]) or None
            Vertices, dwells, drives and enters of all visits; None if no route was found. Complete among
            all routes, with the exception of ``search``. No trip from this phase is home again earlier.
        """

class DistanceTables:
    """
    Least ticks from every vertex to one target, on a graph in compressed rows.

    The graph is copied (reversed) once; several threads may ask one object at once.

    Parameters
    ----------
    indptr, indices : int32[V + 1], int32[E]
        The edges that leave vertex ``v`` are ``indptr[v] .. indptr[v + 1] - 1``, and edge ``e`` ends at
        ``indices[e]``.
    """

    def __init__(self, indptr: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], indices: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> None: ...

    def to(self, target: int, edge_ticks: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> Annotated[NDArray[numpy.int32], dict(shape=(None,))]:
        """
        Return the least time from each vertex to a target, -1 where no way leads there, int32[V].

        Parameters
        ----------
        target : int
            The vertex to reach.
        edge_ticks : int32[E]
            What each edge takes, above 0; -1 where it is barred. [ticks]

        Raises
        ------
        OverflowError
            If a least time does not fit int32.
        """

    def energies_of_quickest_ways(self, ticks_to: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], edge_ticks: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], edge_energy: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], most: int) -> Annotated[NDArray[numpy.int64], dict(shape=(None,))]:
        """
        Return the energy of a quickest way from each vertex, the least of those, int64[V].

        Parameters
        ----------
        ticks_to : int32[V]
            What `to` returned for the target. [ticks]
        edge_ticks : int32[E]
            What it was given. [ticks]
        edge_energy : int64[E]
            What each edge takes.
        most : int
            Returned where the way takes more, or none exists.
        """

    def least_energies(self, targets: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], edge_energy: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], most: int) -> Annotated[NDArray[numpy.int64], dict(shape=(None,))]:
        """
        Return the least energy from each vertex to one of the targets, int64[V].

        Parameters
        ----------
        targets : int32[n]
            The vertices of which one is to be reached.
        edge_energy : int64[E]
            What each edge takes; -1 where it is barred.
        most : int
            Returned where the way takes more, or none exists.
        """

class ShortestPaths:
    """
    Canonical shortest paths between single pairs of vertices, without a table for each target.

    The graph is copied once; one thread at a time may use one object.

    Parameters
    ----------
    indptr, indices : int32[V + 1], int32[E]
        The graph, as for `DistanceTables`.
    edge_ticks : int32[E]
        What each edge takes, above 0; -1 where it is barred. [ticks]
    """

    def __init__(self, indptr: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], indices: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], edge_ticks: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> None: ...

    def find(self, start: int, target: int) -> Annotated[NDArray[numpy.int32], dict(shape=(None,))]:
        """
        Return the vertices of a shortest path, both ends included, int32[n]; empty if there is none.

        Of several shortest paths, the one that takes the first edge of a vertex that it can.

        Parameters
        ----------
        start, target : int
            The vertices at which the path begins and ends.

        Raises
        ------
        OverflowError
            If a least time does not fit int32.
        """

class Congestion:
    """
    Cheapest paths that keep clear of other robots.

    To drive an edge costs ``shares`` for each tick that it takes, and more per tick: what it costs to
    enter the vertex that it ends at, unless that is the target, and what every robot costs that was
    added on the opposite edge.

    Parameters
    ----------
    problem : Problem
        The roads, and how fast robots drive.
    shares : int
        In how many shares a tick is counted, above 0.
    station : int64[V]
        What it costs more to enter each vertex. [shares per tick]
    """

    def __init__(self, problem: Problem, shares: int, station: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> None: ...

    def path(self, robot: int, start: int, target: int, to_go: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> Annotated[NDArray[numpy.int32], dict(shape=(None,))]:
        """
        Return the vertices of a cheapest path, both ends included, int32[n].

        Of several cheapest paths, the one that takes the first edge of a vertex that it can.

        Parameters
        ----------
        robot : int
            The robot that drives.
        start, target : int
            The vertices at which the path begins and ends.
        to_go : int32[V]
            The least ticks from each vertex to the target, -1 where no way leads there.
        """

    def add(self, path: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], oncoming: int) -> None:
        """
        Count one more robot on a path.

        Parameters
        ----------
        path : int32[n]
            The vertices of the path.
        oncoming : int
            What it costs to go against the robot. [shares per tick]
        """

class Horizon:
    """
    Where a simulation cuts time.

    Parameters
    ----------
    pacemaker, lag : int
        Cuts are made where this robot is home; conflicts up to the lag (above 0) after a cut are
        resolved before all visits up to it are frozen. [ticks]
    most_lag, patience : int
        The longest lag, and how long a pacemaker may stay away. [ticks]
    reach : int
        Visits left so long before a cut still matter. [ticks]
    memory : int
        How many cuts can be undone, above 0.
    """

    def __init__(self, *, pacemaker: int, lag: int, most_lag: int, patience: int, reach: int, memory: int) -> None: ...

class CyclicSimulator:
    """
    Robots that repeat their laps under a rule that considers two of them, until a state recurs.

    Parameters
    ----------
    rules : BookingRules
        How visits are booked.
    laps : Routes
        One lap of each robot; its first visit is at home, and the drive into it leads from the last.
    first_least : int64[R]
        The least ticks of the very first visit, in which no robot turns.
    horizon : Horizon
        Where cuts are made.
    rule : int
        The robot that goes first: the one that would enter the segment first (0), the one listed first
        (1), or (2) the one that would lose more by waiting.
    loss : int64[R]
        The cost of a tick of waiting for each robot, above 0, with rule 2; else unused.
    rows : VisitRows or None
        Where robots have sizes: what the visits of a lap book.

    Raises
    ------
    ValueError
        If the arrays do not fit together; the message names array, index and value.

    Notes
    -----
    Exact and deterministic. The GIL is released by ``advance``; Ctrl-C is obeyed.
    """

    def __init__(self, rules: BookingRules, laps: Routes, first_least: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], horizon: Horizon, rule: int, loss: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], rows: VisitRows | None = None) -> None: ...

    def advance(self, time_limit: float | None = None) -> int:
        """
        Simulate until a state recurs (returns 1), a deadlock (2), or time is over (0; may be continued).

        Parameters
        ----------
        time_limit : float or None
            When to stop; at once for 0 or less. [s]
        """

    def reset_states(self) -> None:
        """Forget the states seen, to advance beyond one that has recurred."""

    def set_rule(self, rule: int) -> None:
        """
        Decide by another rule from now on.

        Parameters
        ----------
        rule : int
            As for the class.
        """

    @property
    def cut(self) -> int:
        """All conflicts before this tick are resolved. [ticks]"""

    @property
    def first_seen(self) -> int:
        """When the state that has recurred at the cut was seen first. [ticks]"""

    def started(self) -> Annotated[NDArray[numpy.int32], dict(shape=(None,))]:
        """Return how many visits of each robot have started, int32[R]."""

    def waits(self, robot: int) -> tuple[Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int64], dict(shape=(None,))]]:
        """
        Return the visits of a robot that had to wait, and how long.

        Parameters
        ----------
        robot : int
            The robot.

        Returns
        -------
        tuple of (int32[K], int64[K])
            The numbers of the visits, and how long the robot had waited by then in all. [ticks]
        """

    def deadlock(self) -> tuple[int, int, int, int, Annotated[NDArray[numpy.int32], dict(shape=(None,))]]:
        """
        Return the conflict that cannot be resolved, after a deadlock.

        Returns
        -------
        tuple of (int, int, int, int, int32[K])
            The two robots, the vertex, the tick (0 for a booking that would begin before the simulation),
            and the robots that would each wait for the next.
        """

def critical_circuit(n_nodes: int, tail: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], head: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], length: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], height: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], time_limit: float | None) -> tuple[int, int, Annotated[NDArray[numpy.int32], dict(shape=(None,))]] | None:
    """
    Find the circuit with the largest mean: the cycle time of events that repeat.

    Parameters
    ----------
    n_nodes : int
        The number of events in a period, N.
    tail, head : int32[M], int32[M]
        The arcs.
    length : int64[M]
        How long after its tail the head of each comes at least, not negative. [ticks]
    height : int32[M]
        How many periods later; may be negative.
    time_limit : float or None
        When to stop; at once for 0 or less. [s]

    Returns
    -------
    tuple of (int, int, int32[n]) or None
        Length and height of the largest ratio in lowest terms, and the arcs of a circuit that has it,
        in order; 0, 1 and no arcs if every circuit has length 0. Height 0 if the events of the
        circuit wait for each other for ever. None if time ran out. ValueError if all lengths times all
        heights is beyond 2^58.
    """

def earliest_times(n_nodes: int, tail: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], head: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], length: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], height: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], period: int, parts: int, time_limit: float | None) -> Annotated[NDArray[numpy.int64], dict(shape=(None,))] | None:
    """
    Return the least times that keep all arcs every ``period / parts`` ticks, int64[N].

    At least 0. [1 / parts ticks] None if the period is less than the cycle time, or time ran out.

    Parameters
    ----------
    n_nodes, tail, head, length, height : int, int32[M], int32[M], int64[M], int32[M]
        The events and arcs, as for `critical_circuit`.
    period, parts : int, int
        The events come again every ``period / parts`` ticks; ``parts`` is above 0.
    time_limit : float or None
        When to stop; at once for 0 or less. [s]
    """

def plan_by_lacam(problem: Problem, ends_anywhere: Annotated[NDArray[numpy.uint8], dict(shape=(None,), order='C', device='cpu', writable=False)], spreads: bool, seed: int, most_effort: int | None, time_limit: float | None) -> tuple[int, Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int64], dict(shape=(None,))]]:
    """
    Plan a whole fleet with clocks, instant by instant.

    Parameters
    ----------
    problem : Problem
        What the fleet has to do.
    ends_anywhere : uint8[R], or empty
        Whether a robot may end anywhere once its last stage is the next one; it only prefers that one.
    spreads : bool
        Whether robots prefer paths that were spread before the search.
    seed : int
        For ties.
    most_effort : int or None
        When the search stops: a choice of a robot is a unit, and so is a decision that it takes again.
    time_limit : float or None
        When to stop; at once for 0 or less. [s]

    Returns
    -------
    tuple of (int, int32[R + 1], int32[N], int64[N])
        How it ended (0: found, 1: proven that there is none, since a stage cannot be reached or, for a
        fleet that moves in steps, since all steps were tried, 2: stopped), which visits each robot
        owns, and where and when each visit begins.
    """

class Objective(enum.Enum):
    """What large neighbourhood search minimizes."""

    flowtime = 0
    """The flowtime by weights, and surcharges."""

    makespan = 1
    """The makespan; on ties the flowtime by weights."""

    both = 2
    """Makespan plus completion, summed over robots by weights."""

class FleetSearch:
    """
    The tracks of a whole fleet: finding first ones, and better ones.

    The seed decides all that is drawn; what `improve` finds does not depend on ``n_threads``. Robots
    without a track are left where they are by `tracks`: an empty one. Ctrl-C leaves a plan as good as
    before.

    Parameters
    ----------
    problem : Problem
        What the fleet has to do.
    seed : int
        For all that is drawn.
    n_threads : int
        Threads of `prioritize` and `improve`, 1 to 1024.
    alone : int64[R] or None
        What `alone` returned for the same trips. [ticks]
    objective : Objective
        What `improve` minimizes.
    horizon : int or None
        Tracks may conflict after it; None: they never do. [ticks]

    Raises
    ------
    ValueError
        For an objective with a makespan where edges have surcharges, or a horizon outside 0..2^62.
    """

    def __init__(self, problem: Problem, seed: int, n_threads: int, alone: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)] | None = None, objective: Objective = Objective.flowtime, horizon: int | None = None) -> None: ...

    def alone(self, time_limit: float | None = None) -> Annotated[NDArray[numpy.int64], dict(shape=(None,))] | None:
        """
        Return the least completion of each robot without the others, int64[R]. [ticks]

        -1 for a robot that cannot get to a stage; None if time ran out.

        Parameters
        ----------
        time_limit : float or None
            When to stop; at once for 0 or less. [s]
        """

    def start(self, first_visit: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], vertices: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], enter: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> None:
        """
        Take over tracks. A robot may have none: an empty track.

        Parameters
        ----------
        first_visit : int32[R + 1]
            Robot ``r`` has the visits ``first_visit[r] .. first_visit[r + 1] - 1``.
        vertices, enter : int32[N], int64[N]
            Where and when each visit begins. [ticks]

        Raises
        ------
        ValueError
            If the others are no tracks of these trips, or overlap.
        """

    def take_over(self, first_visit: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], vertices: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], enter: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], order: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], time_limit: float | None) -> Annotated[NDArray[numpy.int32], dict(shape=(None,))]:
        """
        Start from tracks of an earlier plan, and return the robots that have no track now, int32[n].

        A robot whose track serves its stages keeps it. The robots of ``order`` get new tracks one after
        another, around all other tracks; until a robot has one, its earlier track stays booked.

        Parameters
        ----------
        first_visit : int32[R + 1]
            Robot ``r`` has the visits ``first_visit[r] .. first_visit[r + 1] - 1``.
        vertices, enter : int32[N], int64[N]
            Where and when each visit begins. [ticks] Tracks may miss stages.
        order : int32[n]
            The robots to plan, each once.
        time_limit : float or None
            When to stop; at once for 0 or less. [s]
        """

    def restore(self, first_visit: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], vertices: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], enter: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> int:
        """
        Give robots these tracks where that costs no more; return how many have theirs.

        Every robot has a track. `improve` starts afresh.

        Parameters
        ----------
        first_visit : int32[R + 1]
            Robot ``r`` has the visits ``first_visit[r] .. first_visit[r + 1] - 1``.
        vertices, enter : int32[N], int64[N]
            Where and when each visit begins. [ticks] None is empty.
        """

    def prioritize(self, order: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], n_searches: int, time_limit: float | None, with_fallback: float | None) -> bool:
        """
        Give the robots tracks one after another, in this order; return whether all have one now.

        `resume` may change a False.

        Parameters
        ----------
        order : int32[R]
            Every robot once.
        n_searches : int
            The most searches before it gives up.
        time_limit : float or None
            When to stop; at once for 0 or less. [s]
        with_fallback : float or None
            When to stop instead once the hasty attempt has a plan. [s]
        """

    def compete(self, order: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], n_searches: int, time_limit: float | None) -> bool:
        """
        Plan robots one after another beside the present tracks; take a better plan over.

        Return whether the attempt has ended; another call continues one that has not.

        Parameters
        ----------
        order : int32[R]
            Every robot once.
        n_searches : int
            The most searches since its beginning.
        time_limit : float or None
            When to stop; at once for 0 or less. [s]
        """

    def hurry(self, order: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], n_searches: int, time_limit: float | None) -> None:
        """
        Plan robots greedily, one after another, and take the plan over if it is better.

        Parameters
        ----------
        order : int32[R]
            Every robot once.
        n_searches : int
            The most searches before it gives up.
        time_limit : float or None
            When to stop; at once for 0 or less. [s]
        """

    def repair(self, order: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], n_searches: int, time_limit: float | None) -> bool:
        """
        Give tracks to robots that have none, in this order; return whether all have one now.

        Robots that have a track keep it, unless they are in the way: they lose it, and queue again.

        Parameters
        ----------
        order : int32[n]
            All robots without a track, each once.
        n_searches : int
            The most searches before it gives up.
        time_limit : float or None
            When to stop; at once for 0 or less. [s]
        """

    def move_one_at_a_time(self, time_limit: float | None) -> bool:
        """
        Give all robots tracks on which one of them moves at a time; tell whether this was possible.

        Parameters
        ----------
        time_limit : float or None
            When to stop; at once for 0 or less. [s]
        """

    def resume(self, n_searches: int, time_limit: float | None) -> bool:
        """
        Continue a `prioritize` that returned False.

        Parameters
        ----------
        n_searches : int
            The most searches since its beginning.
        time_limit : float or None
            When to stop; at once for 0 or less. [s]
        """

    def improve(self, n_tasks: int, patience: int, time_limit: float | None, pause: float | None) -> int:
        """
        Replace tracks by better ones, a few robots at a time; return how many times that was done.

        Every robot has a track. A plan that is stuck becomes one of several, which are crossed with each
        other. Ends when nothing can be better, too.

        Parameters
        ----------
        n_tasks : int
            The number of neighbourhoods to replan.
        patience : int
            The most of them in a row without a gain.
        time_limit : float or None
            When to stop at once. [s]
        pause : float or None
            When to stop at the next point that does not depend on clocks. [s]
        """

    def retime(self) -> None:
        """
        Have all robots as early as the order of visits at every vertex allows; `improve` starts afresh.
        """

    def tracks(self) -> tuple[Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int64], dict(shape=(None,))]]:
        """
        Return the tracks of all robots.

        Returns
        -------
        tuple of (int32[R + 1], int32[N], int64[N])
            Which visits each robot has, and where and when they begin. [ticks]
        """

    @property
    def cost(self) -> int:
        """The sum of completions and surcharges. [ticks]"""

    @property
    def value(self) -> int:
        """What `improve` minimizes. [ticks]"""

    @property
    def n_idle(self) -> int:
        """How many times in a row brought no gain."""

    @property
    def n_expanded(self) -> int:
        """States expanded by `improve`."""

class PriceAscent:
    """
    A lower bound of all plans, raised step by step by prices of places.

    Parameters
    ----------
    problem : Problem
        What the fleet has to do; every robot can reach its places.
    """

    def __init__(self, problem: Problem) -> None: ...

    def run(self, steps: int, time_limit: float | None) -> None:
        """
        Take more steps; more can follow.

        Parameters
        ----------
        steps : int
            The number of steps at most.
        time_limit : float or None
            When to stop; at once for 0 or less. [s]
        """

    @property
    def bound(self) -> int:
        """No plan costs less. [ticks]"""

    @property
    def n_steps(self) -> int:
        """The number of steps taken."""

    @property
    def is_over(self) -> bool:
        """Whether more steps change nothing."""

def fewest_actions(problem: Problem, first_visit: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], vertices: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], enter: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], waits: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], latest: int, most_states: int, time_limit: float | None) -> tuple[bool, Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int64], dict(shape=(None,))]]:
    """
    Take tracks of no higher cost with which robots wait and drive less often.

    Parameters
    ----------
    problem : Problem
        What the fleet has to do.
    first_visit, vertices, enter : int32[R + 1], int32[N], int64[N]
        Which visits each robot has, and where and when they begin; they keep the rules. [ticks]
    waits : int64[R]
        How many visits of each robot last longer than it needs.
    latest : int
        No robot completes later, NEVER for no limit. [ticks]
    most_states : int
        End each search after this number of states.
    time_limit : float or None
        When to stop; at once for 0 or less. [s]

    Returns
    -------
    tuple of (bool, int32[R + 1], int32[N], int64[N])
        Whether it is proven that no plan of no higher cost has fewer drives and waits; the tracks.
    """

class ConflictBasedSearch:
    """
    Conflict-based search for a plan of least cost, with its proof.

    Parameters
    ----------
    problem : Problem
        What the fleet has to do.
    cardinal : bool
        Whether conflicts that cost both robots something are resolved first.
    bypass : bool
        Whether tracks of equal cost with fewer conflicts replace others without a split.
    clear : bool
        Whether tracks with the fewest conflicts are looked for.
    targets : bool
        Whether conflicts with robots that have reached their ends are resolved as such.
    disjoint : bool
        Whether one child of a conflict holds a robot to where it is, and the other keeps it away.
    pairs : bool
        Whether nodes are split by the completion times of pairs that lose to each other.
    pair_nodes : int
        Nodes at most to solve each pair of robots, whose losses raise the bounds of nodes; 0: none.
    joint_states : int
        Joint states at most, and again for each fifty nodes, for all pairs that need more nodes; and for
        each fifty nodes for a whole fleet of few robots. 0: no such search.
    factor : int
        A plan that costs at most this factor times the bound is enough, 1 or more. [millionths]
    latest : int
        No robot completes later, NEVER for no limit; only without surcharges. [ticks]
    """

    def __init__(self, problem: Problem, cardinal: bool, bypass: bool, clear: bool, targets: bool, disjoint: bool, pairs: bool, pair_nodes: int, joint_states: int, factor: int, latest: int) -> None: ...

    def run(self, upper: int, enough: int, most_nodes: int, most_bytes: int, time_limit: float | None) -> tuple[int, int]:
        """
        Search on; the search can be continued.

        Parameters
        ----------
        upper : int
            The cost of a plan that is known, NEVER for none: nothing of this cost or more is looked for.
            The same in each call. [ticks]
        enough : int
            Stop as soon as the bound is this or more. [ticks]
        most_nodes : int
            Stop after this number of nodes.
        most_bytes : int
            Stop where nodes and tracks take more memory, about. [bytes]
        time_limit : float or None
            When to stop; at once for 0 or less. [s]

        Returns
        -------
        tuple of (int, int)
            How it ended (0: a plan within the factor, 1: proven that none costs less than `upper`, 2: stopped),
            and the proven bound, NEVER where no plan exists. [ticks]
        """

    def search_together(self, robots: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], most_states: int, time_limit: float | None) -> tuple[int, int, Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int64], dict(shape=(None,))]]:
        """
        Search the joint states of some robots, alone on the roads.

        Parameters
        ----------
        robots : int32[K]
            Different robots.
        most_states : int
            Stop after this number of states.
        time_limit : float or None
            When to stop; at once for 0 or less. [s]

        Returns
        -------
        tuple of (int, int, int32[K + 1], int32[N], int64[N])
            How it ended, as for `run`; the proven bound of the sum of their costs, NEVER where no plan
            exists in which none of them completes later than `latest` [ticks]; and the tracks of a plan of
            that cost, as of `tracks`, of no robot where the search did not find one.
        """

    def tracks(self) -> tuple[Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int64], dict(shape=(None,))]]:
        """
        Return the tracks of the plan found, of no robot before.

        Returns
        -------
        tuple of (int32[R + 1], int32[N], int64[N])
            Which visits each robot has, and where and when they begin. [ticks]
        """

    @property
    def n_nodes(self) -> int:
        """The number of nodes expanded."""

    @property
    def n_searches(self) -> int:
        """The number of searches for the track of one robot."""

class Order:
    """
    The order of the visits of a plan.

    Parameters
    ----------
    planned : int64[N]
        When each visit begins by the plan. [ticks]
    first_right, rights : int32[N + 1], int32[M]
        Visit ``x`` starts when the visits ``rights[first_right[x]:first_right[x + 1]]`` have ended.
    since : int64[N]
        When the rights of way of each visit were given; it begins no sooner. [ticks]
    """

    def __init__(self, planned: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], first_right: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], rights: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], since: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> None: ...

class DelayModel:
    """
    The delays that a fleet may meet.

    Parameters
    ----------
    pace : float64[R]
        The factor of all durations of each robot, 1 as planned.
    kind : int32[D]
        0 exponential, 1 uniform, 2 normal, 3 stops, 4 breaks.
    a, b : float64[D]
        Mean and nothing; bounds; mean and deviation, all as parts of a visit's time; chance and
        ticks; chance and nothing.
    first_stoppage : int32[R + 1]
        Robot ``r`` has the stoppages ``first_stoppage[r] .. first_stoppage[r + 1] - 1``.
    stoppage_tick, stoppage_ticks : int64[S]
        When each stoppage of every run begins, rising, and how long it lasts; ``NEVER`` for ever.
    """

    def __init__(self, pace: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], kind: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], a: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], b: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], first_stoppage: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], stoppage_tick: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], stoppage_ticks: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> None: ...

class VisitWorks:
    """
    The works of visits, of a plan with jobs.

    Parameters
    ----------
    first_work : int32[N + 1]
        Visit ``x`` has the works ``first_work[x] .. first_work[x + 1] - 1``, in order.
    ticks : int64[W]
        The least duration of each, a part of the dwell of its visit. [ticks]
    earliest, planned : int64[W]
        When each begins at the earliest, and by the plan. [ticks]
    first_before, before : int32[W + 1], int32[M]
        Work ``k`` begins when the works ``before[first_before[k]:first_before[k + 1]]`` have ended.
    ends_with_work : int32[R]
        1 for robots that complete with their last work, 0 for those that complete in their last visit.

    Raises
    ------
    ValueError
        From the graph that they are given to, if they do not fit it.
    """

    def __init__(self, first_work: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], ticks: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], earliest: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], planned: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], first_before: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], before: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], ends_with_work: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> None: ...

class ActionDependencyGraph:
    """
    A plan that is executed with delays.

    Parameters
    ----------
    rules : BookingRules
        How visits are booked.
    routes : Routes
        The visits.
    order : Order
        When visits begin by the plan, and what each waits for.
    delays : DelayModel
        What the robots may meet.
    rows : VisitRows or None
        Where robots have sizes: what the visits book.
    closures : VisitClosures or None
        When the places of visits are closed.
    works : VisitWorks or None
        The works of visits, of a plan with jobs.
    """

    def __init__(self, rules: BookingRules, routes: Routes, order: Order, delays: DelayModel, rows: VisitRows | None = None, closures: VisitClosures | None = None, works: VisitWorks | None = None) -> None: ...

    def runs(self, seed: int, first: int, count: int, time_limit: float | None) -> tuple[Annotated[NDArray[numpy.int64], dict(shape=(None, None))], Annotated[NDArray[numpy.uint8], dict(shape=(None, None))], Annotated[NDArray[numpy.int64], dict(shape=(None, None))], Annotated[NDArray[numpy.int64], dict(shape=(None, None))], Annotated[NDArray[numpy.int64], dict(shape=(None,))], Annotated[NDArray[numpy.int64], dict(shape=(None,))], Annotated[NDArray[numpy.int64], dict(shape=(None, None))], Annotated[NDArray[numpy.uint8], dict(shape=(None, None))]]:
        """
        Run the plan many times by right of way, and by the clock.

        Parameters
        ----------
        seed : int
            For the delays.
        first, count : int
            Runs ``first`` to ``first + count - 1``; each depends on its number and the seed alone.
        time_limit : float or None
            When to stop; at once for 0 or less. [s]

        Returns
        -------
        completion, is_broken : int64[K, R], uint8[K, R]
            When each robot completes by right of way, ``NEVER`` if it does not; whether it stands still
            for ever. [ticks]
        by_right_of_way, by_clock : int64[K, 4]
            Pairs of visits that overlap, pairs that overlap only by the headway, swaps, and the tick of the
            earliest of these, ``NEVER`` without any.
        own, of_others : int64[N]
            Ticks of lateness that began at each visit: of its own robot, of others.
        between : int64[P, 3]
            Robot, another, and the ticks that the first is late because of the other.
        is_caught : uint8[K, R]
            Whether each robot books something while it is closed.
        """

    def delay_sample(self, seed: int, run: int) -> tuple[Annotated[NDArray[numpy.int64], dict(shape=(None,))], Annotated[NDArray[numpy.int64], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int64], dict(shape=(None,))], Annotated[NDArray[numpy.int64], dict(shape=(None,))]]:
        """
        Return the delays of one run.

        Parameters
        ----------
        seed, run : int
            As for `runs`.

        Returns
        -------
        dwell, drive : int64[N], int64[N]
            The real duration of each visit without the drive after it, and of the drive into it. [ticks]
        first_stoppage, stoppage_tick, stoppage_ticks : int32[R + 1], int64[S], int64[S]
            Stoppages as the class takes them.
        """

    def execute(self, dwell: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], drive: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], first_stoppage: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], stoppage_tick: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], stoppage_ticks: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], clock: bool) -> tuple[Annotated[NDArray[numpy.int64], dict(shape=(None,))], Annotated[NDArray[numpy.int64], dict(shape=(None,))], Annotated[NDArray[numpy.int64], dict(shape=(None,))], Annotated[NDArray[numpy.uint8], dict(shape=(None,))], Annotated[NDArray[numpy.int64], dict(shape=(None,))], Annotated[NDArray[numpy.uint8], dict(shape=(None,))], Annotated[NDArray[numpy.int64], dict(shape=(None,))], Annotated[NDArray[numpy.int64], dict(shape=(None,))]]:
        """
        Run the plan once by the clock or by right of way, with given delays.

        Parameters
        ----------
        dwell, drive, first_stoppage, stoppage_tick, stoppage_ticks : ndarray
            The delays, as `delay_sample` returns them.
        clock : bool
            Whether robots go by the clock, instead of by right of way.

        Returns
        -------
        enter, start : int64[N], int64[N]
            When each visit begins, and when its booking begins. [ticks]
        completion, is_broken : int64[R], uint8[R]
            When each robot completes; whether it stands still for ever. [ticks]
        collisions : int64[4]
            As `runs` counts them.
        is_caught : uint8[R]
            Whether each robot books something while it is closed.
        begin, end : int64[W]
            When each work begins and ends. [ticks]
        """

    def planned_completions(self) -> Annotated[NDArray[numpy.int64], dict(shape=(None,))]:
        """Return when each robot completes by the plan, int64[R]. [ticks]"""

    def deadlocked(self) -> Annotated[NDArray[numpy.int32], dict(shape=(None,))]:
        """
        Return the robots that can never complete because they wait for each other, int32[K].
        """

class PrecedenceGraph:
    """
    Routes, rights of way, the timetable they give, and the conflicts left.

    A conflict is a tuple ``(tick, kind, visit_a, visit_b)`` where the robot of ``visit_a`` is below
    that of ``visit_b``. Kind 0: two bookings ``[enter - approach, leave + headway)`` of a vertex
    overlap, from that tick on; it counts the overlap's ticks, at most ``CONFLICT_CAP``. Kind 1: two
    robots exchange two vertices at that tick, without such an overlap; it counts 1.

    Parameters
    ----------
    rules : BookingRules
        How visits are booked.
    routes : Routes
        The visits; the drives into first visits are 0 where robots book ahead.
    swaps_conflict : bool
        Whether swaps are conflicts.
    rows : VisitRows or None
        Where robots have sizes: what the visits book. Conflicts and rights of way are then between
        incompatible visits: ``precede(a, b)`` lets the drive into ``b`` start after ``a`` has ended,
        wherever both are.
    closures : VisitClosures or None
        When the places of visits are closed: times are the earliest that keep clear of closures.
    """

    def __init__(self, rules: BookingRules, routes: Routes, swaps_conflict: bool, rows: VisitRows | None = None, closures: VisitClosures | None = None) -> None: ...

    def enter_of(self, visit: int) -> int:
        """
        Return the enter of a visit. [ticks]

        Parameters
        ----------
        visit : int
            The visit.
        """

    def enter(self) -> Annotated[NDArray[numpy.int64], dict(shape=(None,))]:
        """Return a copy of the enters of all visits, int64[N]. [ticks]"""

    def completion(self, robot: int) -> int:
        """
        Return the enter of a robot's last visit. [ticks]

        Parameters
        ----------
        robot : int
            The robot.
        """

    def completion_sum(self) -> int:
        """
        Return the sum of the enters of the last visits of active robots. [ticks]
        """

    def critical_rights(self, robot: int) -> Annotated[NDArray[numpy.int32], dict(shape=(None, 2))]:
        """
        Return the rights of way ``(a, b)`` on a longest path to a robot's last visit, int32[K, 2].

        Parameters
        ----------
        robot : int
            The robot; the latest right of way comes first.
        """

    def incompatible(self, i: int, j: int) -> Annotated[NDArray[numpy.int32], dict(shape=(None, None))]:
        """
        Return all incompatible visits of two robots, int32[K, 4]; none where no robot has a size.

        Visit of i, visit of j, and the visits whose starts count: i waits for j by
        ``precede(visit of j, start of i)``, j for i by ``precede(visit of i, start of j)``.

        Parameters
        ----------
        i, j : int
            The robots.
        """

    def conflicts(self) -> int:
        """Return the weight of all conflicts left, 0 if there are none. [ticks]"""

    def conflicts_of(self, robot: int, others: Annotated[NDArray[numpy.uint8], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> int:
        """
        Return the weight of one robot's conflicts with some others. [ticks]

        Parameters
        ----------
        robot : int
            The robot.
        others : uint8[R]
            Not 0 for the others.
        """

    def next_conflict(self) -> tuple[int, int, int, int] | None:
        """
        Return the earliest conflict, None if none is left.

        Returns
        -------
        tuple of (int, int, int, int) or None
            Tick, kind, and the two visits.
        """

    def next_conflict_between(self, i: int, j: int) -> tuple[int, int, int, int] | None:
        """
        Return the earliest conflict of two robots, None if they have none.

        Parameters
        ----------
        i, j : int
            Two different robots.

        Returns
        -------
        tuple of (int, int, int, int) or None
            Tick, kind, and the two visits.
        """

    def precede(self, a: int, b: int) -> bool:
        """
        Give visit a the right of way over visit b, of two active robots at the same vertex.

        Returns whether that is possible. If not, nothing has changed: ``a`` is a last visit, ``b`` is a
        first visit, or ``cycle()`` has the deadlock or swap that would follow.

        Parameters
        ----------
        a, b : int
            The visits.
        """

    def cycle(self) -> Annotated[NDArray[numpy.int32], dict(shape=(None,))]:
        """
        Return the cycle that the last refused ``precede(a, b)`` would have closed, int32[n].

        Visits in order, from ``b`` to the visit after ``a``; empty if there was another reason.
        """

    def keep_order(self, when: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> bool:
        """
        Give the rights of way of all visits to a vertex in an order, all at once.

        Returns whether that is possible; if not, nothing has changed. If so, there is no rollback below
        this.

        Parameters
        ----------
        when : int64[N]
            Rises along each route: of two visits to one vertex the one with the smaller number goes first,
            of equal ones that with the smaller index.
        """

    def take_back(self, a: int, b: int) -> bool:
        """
        Take back the right of way of a over b, whenever it was given; return whether there was one.

        Parameters
        ----------
        a, b : int
            The visits.
        """

    def checkpoint(self) -> int:
        """
        Return a mark for ``rollback``: the number of rights of way given or taken back, and not undone since.
        """

    def rollback(self, mark: int) -> None:
        """
        Undo all changes since a mark.

        Parameters
        ----------
        mark : int
            What `checkpoint` returned; ValueError if a rollback has gone below it.
        """

    def withdraw(self, robot: int) -> None:
        """
        Make a robot inactive and take back its rights of way; there is no rollback below this.

        Parameters
        ----------
        robot : int
            The robot.
        """

    def rights_of(self, robot: int) -> Annotated[NDArray[numpy.int32], dict(shape=(None, 2))]:
        """
        Return the rights of way ``(a, b)`` of which one is a visit of a robot, int32[K, 2].

        Parameters
        ----------
        robot : int
            The robot.
        """

    def rights_of_way(self) -> Annotated[NDArray[numpy.int32], dict(shape=(None, 2))]:
        """
        Return the rights of way ``(a, b)`` in the order they were given, int32[K, 2].
        """

class BookingTable:
    """
    Who has booked which vertex when.

    Parameters
    ----------
    n_vertices : int
        The number of vertices; where robots have sizes or edges are closed, of rows.
    """

    def __init__(self, n_vertices: int) -> None: ...

    def book(self, vertex: int, start: int, end: int, robot: int) -> None:
        """
        Book a vertex for ``[start, end)``; ValueError if that is empty or overlaps another robot's.

        Parameters
        ----------
        vertex : int
            The vertex.
        start, end : int
            The half-open interval; the end is after the start. [ticks]
        robot : int
            The robot.
        """

    def mark(self, row: int, start: int, end: int, robot: int) -> None:
        """
        Mark a row as excluded for ``[start, end)``; marks may overlap.

        Parameters
        ----------
        row : int
            The row, or vertex.
        start, end : int
            The half-open interval; the end is after the start. [ticks]
        robot : int
            The robot; -1 for nobody, where the row is closed.
        """

    def erase(self, vertex: int, start: int, robot: int) -> None:
        """
        Take back a booking of a robot; nothing happens if there is none.

        Parameters
        ----------
        vertex : int
            The vertex, or row.
        start : int
            When the booking starts. [ticks]
        robot : int
            The robot.
        """

    def at(self, vertex: int) -> list[tuple[int, int, int]]:
        """
        Return the bookings ``(start, end, robot)`` of a vertex in order of time. [ticks]

        Parameters
        ----------
        vertex : int
            The vertex, or row.
        """

def earliest_track(problem: Problem, robot: int, bookings: BookingTable, stage_tables: Sequence[Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)]], time_limit: float | None) -> tuple[int, Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int64], dict(shape=(None,))]]:
    """
    Find the earliest track of one robot among the bookings of others.

    Parameters
    ----------
    problem : Problem
        The roads and the robots.
    robot : int
        Which robot.
    bookings : BookingTable
        What the other robots have booked, with as many rows as the problem has.
    stage_tables : list of int32[V]
        For each stage the least ticks from each vertex to its vertex, -1 where no way leads there.
    time_limit : float or None
        When to stop; at once for 0 or less. [s]

    Returns
    -------
    tuple of (int, int32[n], int64[n])
        How it ended (0: found, 1: proven that there is no such track, 2: out of time), the vertices,
        and when each is entered. [ticks]
    """

class TourObjective(enum.Enum):
    """What tours minimize."""

    service = 0
    """Service times and lateness by weights of jobs."""

    flowtime = 1
    """The flowtime by weights of robots."""

    makespan = 2
    """The makespan; on ties the flowtime."""

    both = 3
    """Makespan plus completion, summed by weights."""

class UnservedReason(enum.IntEnum):
    """Why no tour serves a job."""

    robot = 0
    """No robot may or can carry it."""

    way = 1
    """No robot has a way to its stops."""

    latest = 2
    """No robot can be in time, even alone."""

    battery = 3
    """No battery lasts."""

    after = 4
    """A job before it is unserved."""

    not_found = 5
    """The search has found no place for it."""

class TourRobots:
    """
    The robots of a tour problem, one entry each.

    Parameters
    ----------
    travel, battery : int32[R]
        Kind of travel; kind of battery, -1: none.
    start, end : int32[R]
        Where it is at `ready`, and where it has to rest; end -1: at its last stop.
    ready : int64[R]
        When its tour begins. [ticks]
    capacity, load : int32[R]
        The largest load, and what is on board at `ready`.
    soc : int64[R]
        The energy of the battery at `ready`.
    weight : int64[R]
        Of its completion in the flowtime.
    """

    def __init__(self, travel: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], battery: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], end: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], ready: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], capacity: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], load: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], soc: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], weight: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> None: ...

class TourJobs:
    """
    The jobs of a tour problem: what to do, one entry for each stop.

    Parameters
    ----------
    first_stop : int32[J + 1]
        Job ``j`` has the stops ``first_stop[j] .. first_stop[j + 1] - 1``, in this order.
    place : int32[S]
        Where.
    work : int64[S]
        How long. [ticks]
    load : int32[S]
        The change of the load.
    earliest, latest : int64[S]
        Begin not before; end not after, `NEVER`: at any time. [ticks]
    """

    def __init__(self, first_stop: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], place: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], work: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], load: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], earliest: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], latest: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> None: ...

class TourRules:
    """
    The jobs of a tour problem: who may do them, and what they cost.

    Parameters
    ----------
    weight, release, due : int64[J]
        The service of a job costs its weight for each tick from `release` to its end, and more for ticks
        past `due` (`NEVER`: none). [ticks]
    begun_by : int32[J]
        The robot that has begun it, -1: none. These jobs are served before all others.
    first_robot, robots : int32[J + 1], int32[n]
        The robots that may and can do a job.
    first_after, after : int32[J + 1], int32[n]
        The jobs that end before a job begins.
    """

    def __init__(self, weight: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], release: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], due: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], begun_by: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], first_robot: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], robots: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], first_after: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], after: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> None: ...

class TourBatteries:
    """
    Kinds of batteries, in whole numbers over one denominator.

    Parameters
    ----------
    full, on, work, charge, reserve : int64[B]
        Capacity; use per tick until the robot rests, and per tick of work; gain per tick of a charge;
        what has to be left.
    table : int32[B]
        The table of a kind.
    drive : int64[T * P * P]
        Use of a drive between two places, apart from `on`, for each table.
    to_charging : int64[B * P]
        Least use from a place to a charging place; more than `full` without a way.
    first_charging, charging : int32[B + 1], int32[n]
        The charging places of a kind.
    """

    def __init__(self, full: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], on: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], work: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], charge: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], reserve: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], table: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], drive: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], to_charging: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], first_charging: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], charging: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> None: ...

class TourProblem:
    """
    Jobs and robots for which tours are wanted.

    Parameters
    ----------
    n_places : int
        P.
    ticks : int32[K * P * P]
        Ticks of drives from place to place, for each kind of travel; -1: no way.
    robots, jobs, rules, batteries
        The rest.
    objective : TourObjective
        What is minimized after the weight of unserved jobs.
    unit, late : int
        Cost of a tick of service, and what a tick past `due` costs more.

    Raises
    ------
    ValueError
        For arrays that do not fit.
    KernelLimit
        If costs might not fit 64 bits.
    """

    def __init__(self, n_places: int, ticks: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], robots: TourRobots, jobs: TourJobs, rules: TourRules, batteries: TourBatteries, objective: TourObjective, unit: int, late: int) -> None: ...

    @property
    def n_jobs(self) -> int:
        """The number of jobs."""

class TourSearch:
    """
    Search for tours; the best ones can be read between calls.

    They depend on the seed and the steps alone. Ctrl-C leaves the best tours as they were.

    Parameters
    ----------
    problem : TourProblem
        Jobs and robots.
    seed : int
        For all that is drawn.
    """

    def __init__(self, problem: TourProblem, seed: int) -> None: ...

    def start(self, first: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], stops: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> None:
        """
        Insert jobs as they are in these tours, where that is feasible.

        Parameters
        ----------
        first : int32[R + 1]
            Robot ``r`` has the stops ``first[r] .. first[r + 1] - 1``.
        stops : int32[n]
            Indices of stops of all jobs.
        """

    def construct(self, time_limit: float | None = None) -> bool:
        """
        Insert unserved jobs by regret; return whether that was done in time.

        Parameters
        ----------
        time_limit : float or None
            When to stop. [s]
        """

    def improve(self, n_steps: int, time_limit: float | None = None) -> int:
        """
        Do steps of large neighbourhood search; return how many were done.

        Parameters
        ----------
        n_steps : int
            The most steps.
        time_limit : float or None
            When to stop. [s]
        """

    def tours(self) -> tuple[Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int64], dict(shape=(None,))], Annotated[NDArray[numpy.int64], dict(shape=(None,))]]:
        """
        Return the best tours: stops and charges.

        Returns
        -------
        tuple of (int32[R + 1], int32[N], int32[N], int64[N], int64[N])
            The items of each robot; the stop of each (-1: a charge); its place, its begin and its ticks.
        """

    def unserved(self) -> tuple[Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))]]:
        """
        Return the jobs without a tour and the reasons, as `UnservedReason`.

        Returns
        -------
        tuple of (int32[n], int32[n])
            In the order of jobs.
        """

    def compare_robots(self, job: int) -> Annotated[NDArray[numpy.int64], dict(shape=(None,))]:
        """
        Return the objective with a job at its best place in the best tour of each robot.

        The job is in no other tour, and the jobs that come after it are in none.

        Parameters
        ----------
        job : int
            The job.

        Returns
        -------
        int64[R + 1]
            `NEVER` where the job does not fit; the last is the objective without the job.
        """

    @property
    def cost(self) -> tuple[int, int, int, int]:
        """
        Return what the best tours cost; compared from left to right.

        Returns
        -------
        tuple of (int, int, int, int)
            Begun jobs without a tour, the weight of other unserved jobs, the objective, the flowtime.
        """

class RoutedMoves:
    """
    Local search over tours and routes together: moves of few jobs, judged by planned cost.

    The best tours of the search become those of the moves that are accepted.

    Parameters
    ----------
    fleet : FleetSearch
        All robots have tracks; its problem has times, but no arcs.
    tours : TourSearch
        Its best tours are those of the tracks.
    vertex_of : int32[P]
        Of each place.
    turn_of : int64[R]
        After a stop. [ticks]
    stops : int32[S]
        The stop of each stage of the problem; a charge or the last stage is -1.
    ends, completions : int64[S], int64[R]
        When the work of each stage ends, and when each robot completes. [ticks]
    cost, late_cost : int64[J]
        What a tick of the end of each job costs in searches, also after `due`; empty for objectives
        without service.
    seed : int
        For all that is drawn.

    Raises
    ------
    ValueError
        If the arrays do not fit.
    """

    def __init__(self, fleet: FleetSearch, tours: TourSearch, vertex_of: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], turn_of: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], stops: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], ends: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], completions: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], cost: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], late_cost: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], seed: int) -> None: ...

    def run(self, n_moves: int, most_gains: int, time_limit: float | None = None) -> int:
        """
        Try moves until the end of a cycle of annealing, and return how many.

        Parameters
        ----------
        n_moves, most_gains : int
            The most moves, and gains.
        time_limit : float or None
            When to stop; at once for 0 or less. [s]
        """

    @property
    def n_gains(self) -> int:
        """How many moves have made the plan better."""

    def tracks(self) -> tuple[Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int64], dict(shape=(None,))]]:
        """
        Return the tracks of the best plan.

        Returns
        -------
        tuple of (int32[R + 1], int32[N], int64[N])
            Where the visits of each robot begin; their vertices; when they begin. [ticks]
        """

    def items(self) -> tuple[Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int64], dict(shape=(None,))]]:
        """
        Return the items of the tours that have changed.

        Returns
        -------
        tuple of (int32[n], int32[n + 1], int32[N], int32[N], int64[N])
            The robots; where the items of each begin; the stop of each (-1: a charge), its vertex and its
            ticks.
        """
