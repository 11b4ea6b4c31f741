#include "search/periodic_bookings.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "objects.hpp"
#include "search/periodic_search.hpp"

namespace rightofway::bind {
namespace {

constexpr auto periodic_bookings_doc =
    R"(Bookings of vertices with a period or none, and when one more robot can make given visits.

Parameters
----------
rules : BookingRules
    How visits are booked.
n_rows : int
    The number of vertices; where robots have sizes, of rows.
period : int or None
    All bookings come again after it; None for a line of time. [ticks]
lists : ExcludedRows or None
    Where robots have sizes: the lists of all rows.)";

constexpr auto add_bookings_doc =
    R"(Book consecutive visits of a robot, with a period all those of one period.

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
    one, overlaps are not checked.)";

constexpr auto users_doc =
    R"(Return the robots that have booked any of some vertices, rising, int32[K].

Parameters
----------
vertices : int32[n]
    The vertices, or rows.
begins, ends : int
    Bookings count that overlap ``[begins, ends)``; with a period, in the period of their start.
    [ticks])";

constexpr auto search_doc =
    R"(Return when a robot can repeat its visits among the bookings of others, int64[N], or None.

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
this phase is tried.)";

constexpr auto connect_doc =
    R"(Return the earliest ticks for visits between two given ones, int64[N], or None.

Parameters
----------
vertex, dwell, drive : int32[N], int64[N], int64[N]
    The visits, as for `add`.
begins : int
    When the first visit begins. [ticks]
until, leave : int
    By when the last visit begins, and when it ends. [ticks]
edge : int32[N] or None
    As for `add`.)";

constexpr auto trip_doc =
    R"(What a robot has to do in one lap, whose route is not chosen yet.

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
    How long the robot turns; it is the only one there. None where turning takes no time.)";

constexpr auto find_route_doc =
    R"(Find a route for a round trip, and when to take it, among the bookings of others.

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
    all routes, with the exception of ``search``. No trip from this phase is home again earlier.)";

using Route = std::tuple<ArrayOut<VertexId>, ArrayOut<Tick>, ArrayOut<Tick>, ArrayOut<Tick>>;

struct BoundTrip {
    Ints pace;
    Ints stage_vertex;
    Ticks stage_work;
    Ticks stage_turn;
    std::vector<Ints> stage_tables;
    std::optional<BoundTurning> turning;
};

std::optional<Route> find_route(const PeriodicBookings& self, const BoundRoads& bound,
                                const BoundTrip& given, Tick phase,
                                std::optional<double> time_limit, std::int32_t first_row) {
    const Roads roads = bound.roads();
    const VertexId home = given.stage_vertex.size() == 0 ? 0 : view(given.stage_vertex).back();
    Trip trip;
    trip.home = home;
    trip.stage_vertex = view(given.stage_vertex);
    trip.stage_work = view(given.stage_work);
    trip.stage_turn = view(given.stage_turn);
    trip.pace = view(given.pace);
    for (std::size_t k = 0; k < given.stage_tables.size(); ++k) {
        require_length("stage_tables[" + std::to_string(k) + "]", given.stage_tables[k].size(),
                       bound.indptr.size() == 0 ? 0 : bound.indptr.size() - 1);
        trip.to_stage.emplace_back(given.stage_tables[k].data(), 1);
    }
    const Deadline deadline(time_limit);
    PeriodicRoundTrip found;
    bool is_found = false;
    {
        const nb::gil_scoped_release released;
        if (given.turning) {
            require_graph(roads.graph, "heads");
            require_turns(roads.graph, given.turning->arrays(), 1);
            trip.turns = Turns::of(given.turning->arrays(), 0);
        }
        is_found = PeriodicSearch(roads, self).run(trip, phase, found, deadline, first_row);
    }
    if (!is_found) {
        return std::nullopt;
    }
    return Route{to_numpy(std::move(found.vertex)), to_numpy(std::move(found.dwell)),
                 to_numpy(std::move(found.drive)), to_numpy(std::move(found.enter))};
}

using Rows = std::optional<ArrayIn<std::int32_t>>;

Visits visits_of(const ArrayIn<VertexId>& vertex, const ArrayIn<Tick>& dwell,
                 const ArrayIn<Tick>& drive, const Rows& edge) {
    return {view(vertex), view(dwell), view(drive), view_or_empty(edge)};
}

void init_periodic_bookings(PeriodicBookings* self, const BookingRules& rules, std::int32_t n_rows,
                            std::optional<Tick> period, const BoundExcludedRows* lists) {
    new (self) PeriodicBookings(n_rows, period, rules.headway, rules.books_ahead,
                                lists == nullptr ? ExcludedRows{} : lists->rows());
}

std::optional<ArrayOut<Tick>> search(PeriodicBookings& self, const ArrayIn<VertexId>& vertex,
                                     const ArrayIn<Tick>& dwell, const ArrayIn<Tick>& drive,
                                     Tick phase, std::optional<double> time_limit,
                                     const Rows& edge) {
    const Visits visits = visits_of(vertex, dwell, drive, edge);
    const Deadline deadline(time_limit);
    std::vector<Tick> enter;
    bool is_found = false;
    {
        const nb::gil_scoped_release released;
        is_found = self.search(visits, phase, enter, deadline);
    }
    return is_found ? std::optional(to_numpy(std::move(enter))) : std::nullopt;
}

std::optional<ArrayOut<Tick>> connect(PeriodicBookings& self, const ArrayIn<VertexId>& vertex,
                                      const ArrayIn<Tick>& dwell, const ArrayIn<Tick>& drive,
                                      Tick begins, Tick until, Tick leave, const Rows& edge) {
    const Visits visits = visits_of(vertex, dwell, drive, edge);
    const Deadline interrupt(std::nullopt);
    std::vector<Tick> enter;
    bool is_found = false;
    {
        const nb::gil_scoped_release released;
        is_found = self.connect(visits, begins, until, leave, enter, interrupt);
    }
    return is_found ? std::optional(to_numpy(std::move(enter))) : std::nullopt;
}

}  // namespace

void bind_periodic_bookings(nb::module_& module) {
    nb::class_<BoundTrip>(module, "RoundTrip", trip_doc)
        .def(nb::init<Ints, Ints, Ticks, Ticks, std::vector<Ints>, std::optional<BoundTurning>>(),
             array("pace"), array("stage_vertex"), array("stage_work"), array("stage_turn"),
             nb::arg("stage_tables"), nb::arg("turning").none() = nb::none());
    nb::class_<PeriodicBookings>(module, "PeriodicBookings", periodic_bookings_doc)
        .def("__init__", &init_periodic_bookings, nb::arg("rules"), nb::arg("n_rows"),
             nb::arg("period").none(), nb::arg("lists").none() = nb::none(), nb::keep_alive<1, 5>())
        .def_prop_ro("reached", &PeriodicBookings::reached,
                     "The last visit that the latest search could enter; it got stuck at the next.")
        .def(
            "add",
            [](PeriodicBookings& self, RobotId robot, const ArrayIn<VertexId>& vertex,
               const ArrayIn<Tick>& dwell, const ArrayIn<Tick>& drive, const ArrayIn<Tick>& enter,
               std::optional<Tick> leave, const Rows& edge) {
                return self.add(robot, visits_of(vertex, dwell, drive, edge), view(enter), leave);
            },
            nb::arg("robot"), array("vertex"), array("dwell"), array("drive"), array("enter"),
            nb::arg("leave") = nb::none(), array("edge").none() = nb::none(), add_bookings_doc)
        .def("remove", &PeriodicBookings::remove, nb::arg("robot"),
             R"(Remove all bookings of a robot; nothing happens if it has none.

Parameters
----------
robot : int
    The robot.)")
        .def(
            "users",
            [](const PeriodicBookings& self, const ArrayIn<VertexId>& vertices, Tick begins,
               Tick ends) { return to_numpy(self.users(view(vertices), begins, ends)); },
            array("vertices"), nb::arg("begins") = -never, nb::arg("ends") = never, users_doc)
        .def("search", &search, array("vertex"), array("dwell"), array("drive"), nb::arg("phase"),
             nb::arg("time_limit").none(), array("edge").none() = nb::none(), search_doc)
        .def("connect", &connect, array("vertex"), array("dwell"), array("drive"),
             nb::arg("begins"), nb::arg("until"), nb::arg("leave"),
             array("edge").none() = nb::none(), connect_doc)
        .def("find_route", &find_route, nb::arg("roads"), nb::arg("trip"), nb::arg("phase"),
             nb::arg("time_limit").none(), nb::arg("first_row") = 0, find_route_doc);
}

}  // namespace rightofway::bind
