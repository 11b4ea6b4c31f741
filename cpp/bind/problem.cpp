#include "problem/problem.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/tuple.h>

#include <memory>
#include <optional>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "objects.hpp"
#include "problem/overlaps.hpp"

namespace rightofway::bind {
namespace {

constexpr auto roads_doc =
    R"(The directed graph of a roadmap. The arrays are not copied: they must not change.

Parameters
----------
indptr, heads : int32[V + 1], int32[E]
    The edges that leave vertex ``v`` are ``indptr[v] .. indptr[v + 1] - 1``, and edge ``e`` ends
    at ``heads[e]``.
length_class : int32[E]
    The length class of each edge.
n_classes : int
    The number of length classes, C.)";

constexpr auto robots_doc =
    R"(The robots of a fleet. The arrays are not copied: they must not change.

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
    How much a tick of each robot counts; None where all count alike.)";

constexpr auto rules_doc = R"(The rules that turn visits into bookings.

Parameters
----------
headway : int
    How long a vertex stays booked after it was left. [ticks]
books_ahead : bool
    Whether a vertex is booked from when a robot starts to drive there.
rotations : bool
    Whether three or more robots may move round a circle at one instant, where bookings allow it.)";

constexpr auto drawing_doc =
    R"(Where the vertices of a roadmap lie. The arrays are not copied: they must not change.

Parameters
----------
x, y : float64[V]
    Coordinates from the least ones. [length unit]
limbs : uint32[2 * V * L]
    The same, exactly: for each vertex x, then y, as a whole multiple of one length in L limbs of 32
    bits, the least first.
is_grid : bool
    Whether the vertices are cells of a grid, which lanes join: no lane passes a vertex or crosses
    another one then.)";

constexpr auto excluded_doc = R"(The rows from which a booking of each row excludes other robots.

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
    If the arrays do not fit together; names the array, the index and the value.)";

constexpr auto turning_doc = R"(How long robots turn on the spot between two edges.

Parameters
----------
offset, kind : int64[E], int32[n]
    The angle from edge ``e`` to edge ``f`` is of kind ``kind[offset[e] + f]``.
class_of, ticks : int32[R], int32[T * K]
    A robot of turning class t turns it in ``ticks[t * K + kind]`` ticks, and in no time where its
    class is -1.
n_kinds : int
    K.)";

constexpr auto work_doc = R"(When stages may be served, and how robots begin and end.

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
    only completions cost.)";

constexpr auto closures_doc = R"(Bookings of nobody.

Parameters
----------
row, start, end : int32[K], int64[K], int64[K]
    Rows of the booking table that are closed, and when. [ticks])";

constexpr auto problem_doc = R"(A scenario in ticks: roads, robots and booking rules.

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
    If the arrays do not fit together; names the array, the index and the value.)";

void init_lists(BoundExcludedRows* self, const BoundRoads& roads, const BoundDrawing& drawing,
                const ArrayIn<double>& distance, const ArrayIn<std::uint32_t>& distance_limbs,
                const Ints& zone_first, const Ints& zone_member,
                const std::optional<Ints>& chain_first, const std::optional<Ints>& chain_vertex) {
    const std::size_t n_coordinates = 2 * drawing.x.size();
    std::int32_t n_sizes = 1;
    while (index(n_sizes) * index(n_sizes) < distance.size()) {
        ++n_sizes;
    }
    const DrawingArrays arrays{
        roads.roads().graph,
        view(drawing.x),
        view(drawing.y),
        view(drawing.limbs),
        static_cast<std::int32_t>(n_coordinates == 0 ? 1 : drawing.limbs.size() / n_coordinates),
        view(distance),
        view(distance_limbs),
        n_sizes,
        view(zone_first),
        view(zone_member),
        view_or_empty(chain_first),
        view_or_empty(chain_vertex),
        drawing.is_grid};
    std::shared_ptr<const RowFinder> finder;
    {
        const nb::gil_scoped_release released;
        finder = std::make_shared<const RowFinder>(arrays);
    }
    new (self) BoundExcludedRows{std::move(finder)};
}

void init_problem(Problem* self, const BoundRoads& roads, const BoundRobots& robots,
                  const BookingRules& rules, const BoundExcludedRows* lists,
                  const BoundTurning* turning, const std::optional<Ticks>& surcharges,
                  const BoundClosures* closures, const BoundWork* work) {
    const ProblemArrays arrays{
        view(roads.indptr),          view(roads.heads),         view(roads.length_class),
        view(robots.paces),          view(robots.pace_of),      view(robots.home),
        view(robots.first_stage),    view(robots.stage_vertex), view(robots.stage_work),
        view(robots.stage_turn),     roads.n_classes,           view_or_empty(surcharges),
        view_or_empty(robots.weight)};
    if (lists != nullptr && !robots.size_of) {
        throw std::invalid_argument("size_of: is needed with lists");
    }
    Resources resources;
    if (lists != nullptr) {
        resources = {view(*robots.size_of), lists->rows()};
    }
    if (surcharges) {
        require_length("surcharges", surcharges->size(), static_cast<std::size_t>(roads.n_classes));
    }
    TurnArrays turns;
    if (turning != nullptr) {
        require_length("class_of", turning->class_of.size(), robots.home.size());
        turns = turning->arrays();
    }
    Closures closed;
    if (closures != nullptr) {
        closed = {view(closures->row), view(closures->start), view(closures->end)};
    }
    new (self) Problem(arrays, rules, resources, turns, closed,
                       work == nullptr ? WorkArrays{} : work->arrays());
}

constexpr auto overlaps_doc =
    R"(Return which bookings of different robots overlap at a vertex, and whether these are all.

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
    The earlier and the later booking of each pair; false if there may be more of them.)";

std::tuple<ArrayOut<std::int32_t>, ArrayOut<std::int32_t>, bool> list_overlaps(
    const ArrayIn<VertexId>& vertex, const ArrayIn<RobotId>& robot, const ArrayIn<Tick>& start,
    const ArrayIn<Tick>& end, std::size_t most, std::optional<double> time_limit) {
    const Deadline deadline(time_limit);
    Overlaps found;
    {
        const nb::gil_scoped_release released;
        found = find_overlaps({view(vertex), view(start), view(end), view(robot)}, most, deadline);
    }
    return {to_numpy(std::move(found.earlier)), to_numpy(std::move(found.later)),
            found.end == SearchEnd::found};
}

}  // namespace

void bind_problem(nb::module_& module) {
    nb::class_<BoundRoads>(module, "Roads", roads_doc)
        .def(nb::init<Ints, Ints, Ints, std::int32_t>(), array("indptr"), array("heads"),
             array("length_class"), nb::arg("n_classes"));
    nb::class_<BoundRobots>(module, "Robots", robots_doc)
        .def(nb::init<Ints, Ints, Ints, Ints, Ints, Ticks, Ticks, std::optional<Ints>,
                      std::optional<Ticks>>(),
             array("paces"), array("pace_of"), array("home"), array("first_stage"),
             array("stage_vertex"), array("stage_work"), array("stage_turn"),
             array("size_of").none() = nb::none(), array("weight").none() = nb::none());
    nb::class_<BookingRules>(module, "BookingRules", rules_doc)
        .def(nb::init<Tick, bool, bool>(), nb::arg("headway"), nb::arg("books_ahead"),
             nb::arg("rotations") = true);
    nb::class_<BoundDrawing>(module, "Drawing", drawing_doc)
        .def(nb::init<ArrayIn<double>, ArrayIn<double>, ArrayIn<std::uint32_t>, bool>(), array("x"),
             array("y"), array("limbs"), nb::arg("is_grid"));
    nb::class_<BoundExcludedRows>(module, "ExcludedRows", excluded_doc)
        .def("__init__", &init_lists, nb::arg("roads"), nb::arg("drawing"), array("distance"),
             array("distance_limbs"), array("zone_first"), array("zone_member"),
             array("chain_first").none() = nb::none(), array("chain_vertex").none() = nb::none())
        .def_prop_ro(
            "n_rows", [](const BoundExcludedRows& self) { return self.finder->n_rows(); },
            "The number of rows.")
        .def_prop_ro(
            "n_found", [](const BoundExcludedRows& self) { return self.finder->n_found(); },
            "How many rows have been asked for so far.")
        .def(
            "of",
            [](const BoundExcludedRows& self, std::int32_t row) {
                require_id("row", row, self.finder->n_rows());
                return to_numpy(self.finder->of(row));
            },
            nb::arg("row"), R"(Return the rows that a row excludes, in increasing order; int32[n].

Parameters
----------
row : int
    The row.)");
    nb::class_<BoundTurning>(module, "Turning", turning_doc)
        .def(nb::init<Ticks, Ints, Ints, Ints, std::int32_t>(), array("offset"), array("kind"),
             array("class_of"), array("ticks"), nb::arg("n_kinds"));
    nb::class_<BoundClosures>(module, "Closures", closures_doc)
        .def(nb::init<Ints, Ticks, Ticks>(), array("row"), array("start"), array("end"));
    nb::class_<BoundWork>(module, "Work", work_doc)
        .def(nb::init<Ticks, Ticks, Ticks, Ints, Ints, Ints, Ints, std::int32_t,
                      std::optional<Ticks>, std::optional<Ticks>, std::optional<Ticks>>(),
             array("earliest"), array("latest"), array("ready"), array("first_turn_of"),
             array("first_turn"), array("before"), array("after"), nb::arg("n_places"),
             array("cost").none() = nb::none(), array("late_cost").none() = nb::none(),
             array("due").none() = nb::none());
    nb::class_<Problem>(module, "Problem", problem_doc)
        .def("__init__", &init_problem, nb::arg("roads"), nb::arg("robots"), nb::arg("rules"),
             nb::arg("lists").none() = nb::none(), nb::arg("turning").none() = nb::none(),
             array("surcharges").none() = nb::none(), nb::arg("closures").none() = nb::none(),
             nb::arg("work").none() = nb::none(), nb::keep_alive<1, 2>(), nb::keep_alive<1, 3>(),
             nb::keep_alive<1, 5>(), nb::keep_alive<1, 6>(), nb::keep_alive<1, 7>(),
             nb::keep_alive<1, 8>(), nb::keep_alive<1, 9>())
        .def_prop_ro("n_robots", &Problem::n_robots, "The number of robots, R.")
        .def_prop_ro("n_vertices", &Problem::n_vertices, "The number of vertices, V.")
        .def_prop_ro("rules", &Problem::rules, "How visits are booked.");
    module.def("find_overlaps", &list_overlaps, array("vertex"), array("robot"), array("start"),
               array("end"), nb::arg("most"), nb::arg("time_limit").none() = nb::none(),
               overlaps_doc);
}

}  // namespace rightofway::bind
