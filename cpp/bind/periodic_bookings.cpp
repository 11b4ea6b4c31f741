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

#include "bindings.hpp"
#include "core/reject.hpp"
#include "deadline.hpp"
#include "search/periodic_search.hpp"

namespace rightofway::bind {
namespace {

constexpr auto class_doc =
    R"(Bookings of vertices with a period or none, and when one more robot can make given visits.

Parameters
----------
n_vertices : int
    The number of vertices, V.
period : int or None
    All bookings come again after this many ticks; None for a line of time. [ticks]
headway : int
    How long a vertex stays booked after it was left. [ticks]
books_ahead : bool
    Whether a robot books a vertex from when it starts to drive there.

Raises
------
ValueError
    If a number is out of its range.

References
----------
Phillips & Likhachev, *SIPP: Safe interval path planning for dynamic environments*, ICRA 2011.)";

constexpr auto add_doc = R"(Book consecutive visits of a robot.

Parameters
----------
robot : int
    The robot.
vertex : int32[N]
    The vertex of each visit; with a period, all visits of one period.
dwell : int64[N]
    The least duration of each, without the drive that follows. [ticks]
drive : int64[N]
    The drive into each. [ticks]
enter : int64[N]
    When each begins, rising; with a period, all within one. [ticks]
leave : int or None
    When the last one ends; None with a period: when the first one comes again. [ticks]

Returns
-------
bool
    With a period, whether no booking overlaps another robot's; otherwise nothing is booked.

Raises
------
ValueError
    If the arrays do not fit together; with a period also if the robot has bookings already. Then
    nothing is booked.

Notes
-----
Without a period a robot may book more than once, and overlaps are not checked.)";

constexpr auto users_doc =
    R"(Return the robots whose bookings of any of these vertices overlap an interval.

Parameters
----------
vertices : int32[N]
    The vertices.
begins, ends : int
    The half-open interval. With a period, bookings count in the period that they start in. [ticks]

Returns
-------
int32[K]
    Each robot once, rising.

Raises
------
ValueError
    If there is no such vertex.)";

constexpr auto search_doc = R"(Find when a robot can repeat its visits among the bookings of others.

Parameters
----------
vertex, dwell, drive : int32[N], int64[N], int64[N]
    As for ``add``; needs a period.
phase : int
    The tick from which on starts are tried. [ticks]
time_limit : float or None
    The search stops after this many seconds.

Returns
-------
int64[N] or None
    When each visit begins; None if no way was found. [ticks]

Raises
------
ValueError
    If the arrays do not fit together, or there is no period.

Notes
-----
Complete for these visits, unless no other robot visits the first vertex: then only this phase is
tried. Deterministic. The GIL is released; Ctrl-C is obeyed.)";

constexpr auto connect_doc = R"(Find the earliest ticks for visits between two given ones.

Parameters
----------
vertex, dwell, drive : int32[N], int64[N], int64[N]
    As for ``add``.
begins : int
    When the first visit begins. [ticks]
until : int
    By when the last visit begins. [ticks]
leave : int
    When the last visit ends. [ticks]

Returns
-------
int64[N] or None
    When each visit begins; None if that is impossible. [ticks]

Raises
------
ValueError
    If the arrays do not fit together.

Notes
-----
Complete for these visits; deterministic.)";

constexpr auto find_route_doc =
    R"(Find a route for a round trip, and when to take it, among the bookings of others.

Parameters
----------
indptr, indices : int32[V + 1], int32[E]
    The directed graph in compressed rows.
length_class : int32[E]
    The length class of each edge.
pace : int32[C]
    What an edge of each length class takes. [ticks]
home : int
    The vertex at which the trip begins and ends.
stage_vertex : int32[S]
    The vertex of each stage, in order; the last one is the home.
stage_work, stage_turn : int64[S], int64[S]
    How long the robot works there, and then turns. [ticks]
stage_tables : list of int32[V]
    For each stage, the least ticks from each vertex to its vertex; -1 where the robot must not go.
phase : int
    The tick from which on starts are tried. [ticks]
time_limit : float or None
    The search stops after this many seconds.

Returns
-------
tuple of (int32[N], int64[N], int64[N], int64[N]) or None
    Vertices, dwells, drives and enters of all visits; None if no route was found. [ticks]

Raises
------
ValueError
    If the arrays do not fit together, a stage cannot be reached, or there is no period.

Notes
-----
Complete among all routes, unless no other robot visits the home: then only this phase is tried. No
trip from this phase is home again earlier. Deterministic. The GIL is released; Ctrl-C is obeyed.)";

using Route = std::tuple<ArrayOut<VertexId>, ArrayOut<Tick>, ArrayOut<Tick>, ArrayOut<Tick>>;

std::optional<Route> find_route(const PeriodicBookings& self, const ArrayIn<EdgeId>& indptr,
                                const ArrayIn<VertexId>& indices,
                                const ArrayIn<std::int32_t>& length_class,
                                const ArrayIn<std::int32_t>& pace, VertexId home,
                                const ArrayIn<VertexId>& stage_vertex,
                                const ArrayIn<Tick>& stage_work, const ArrayIn<Tick>& stage_turn,
                                const std::vector<ArrayIn<std::int32_t>>& stage_tables, Tick phase,
                                std::optional<double> time_limit) {
    const Roads roads{{view(indptr), view(indices)}, view(length_class)};
    Trip trip{home, view(stage_vertex), view(stage_work), view(stage_turn), view(pace), {}};
    for (std::size_t k = 0; k < stage_tables.size(); ++k) {
        require_length("stage_tables[" + std::to_string(k) + "]", stage_tables[k].size(),
                       static_cast<std::size_t>(self.n_vertices()));
        trip.to_stage.emplace_back(stage_tables[k].data(), 1);
    }
    const Deadline deadline(time_limit);
    PeriodicRoundTrip found;
    bool is_found = false;
    {
        const nb::gil_scoped_release released;
        is_found = PeriodicSearch(roads, self).run(trip, phase, found, deadline);
    }
    if (!is_found) {
        return std::nullopt;
    }
    return Route{to_numpy(std::move(found.vertex)), to_numpy(std::move(found.dwell)),
                 to_numpy(std::move(found.drive)), to_numpy(std::move(found.enter))};
}

Visits visits_of(const ArrayIn<VertexId>& vertex, const ArrayIn<Tick>& dwell,
                 const ArrayIn<Tick>& drive) {
    return {view(vertex), view(dwell), view(drive)};
}

std::optional<ArrayOut<Tick>> search(PeriodicBookings& self, const ArrayIn<VertexId>& vertex,
                                     const ArrayIn<Tick>& dwell, const ArrayIn<Tick>& drive,
                                     Tick phase, std::optional<double> time_limit) {
    const Visits visits = visits_of(vertex, dwell, drive);
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
                                      Tick begins, Tick until, Tick leave) {
    std::vector<Tick> enter;
    const bool is_found =
        self.connect(visits_of(vertex, dwell, drive), begins, until, leave, enter);
    return is_found ? std::optional(to_numpy(std::move(enter))) : std::nullopt;
}

}  // namespace

void bind_periodic_bookings(nb::module_& module) {
    nb::class_<PeriodicBookings>(module, "PeriodicBookings", class_doc)
        .def(nb::init<VertexId, std::optional<Tick>, Tick, bool>(), nb::arg("n_vertices"),
             nb::arg("period").none(), nb::arg("headway"), nb::arg("books_ahead"))
        .def_prop_ro("reached", &PeriodicBookings::reached,
                     "The last visit that the latest search could enter; it got stuck at the next.")
        .def(
            "add",
            [](PeriodicBookings& self, RobotId robot, const ArrayIn<VertexId>& vertex,
               const ArrayIn<Tick>& dwell, const ArrayIn<Tick>& drive, const ArrayIn<Tick>& enter,
               std::optional<Tick> leave) {
                return self.add(robot, visits_of(vertex, dwell, drive), view(enter), leave);
            },
            nb::arg("robot"), nb::arg("vertex").noconvert(), nb::arg("dwell").noconvert(),
            nb::arg("drive").noconvert(), nb::arg("enter").noconvert(),
            nb::arg("leave") = nb::none(), add_doc)
        .def("remove", &PeriodicBookings::remove, nb::arg("robot"),
             "Remove all bookings of a robot; nothing happens if it has none.")
        .def(
            "users",
            [](const PeriodicBookings& self, const ArrayIn<VertexId>& vertices, Tick begins,
               Tick ends) { return to_numpy(self.users(view(vertices), begins, ends)); },
            nb::arg("vertices").noconvert(), nb::arg("begins") = -never, nb::arg("ends") = never,
            users_doc)
        .def("search", &search, nb::arg("vertex").noconvert(), nb::arg("dwell").noconvert(),
             nb::arg("drive").noconvert(), nb::arg("phase"), nb::arg("time_limit").none(),
             search_doc)
        .def("connect", &connect, nb::arg("vertex").noconvert(), nb::arg("dwell").noconvert(),
             nb::arg("drive").noconvert(), nb::arg("begins"), nb::arg("until"), nb::arg("leave"),
             connect_doc)
        .def("find_route", &find_route, nb::arg("indptr").noconvert(),
             nb::arg("indices").noconvert(), nb::arg("length_class").noconvert(),
             nb::arg("pace").noconvert(), nb::arg("home"), nb::arg("stage_vertex").noconvert(),
             nb::arg("stage_work").noconvert(), nb::arg("stage_turn").noconvert(),
             nb::arg("stage_tables"), nb::arg("phase"), nb::arg("time_limit").none(),
             find_route_doc);
}

}  // namespace rightofway::bind
