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
    R"(Who has booked which vertex when, on a circle as long as the period.

Parameters
----------
n_vertices : int
    The number of vertices, V.
period : int
    All bookings come again after so long. [ticks]
headway : int
    How long a vertex stays booked after it was left. [ticks]
books_ahead : bool
    Whether a vertex is booked from when a robot starts to drive there.

Raises
------
ValueError
    If a number is out of its range.)";

constexpr auto add_doc = R"(Book the visits of a robot.

Parameters
----------
robot : int
    Whose they are.
vertex : int32[N]
    Where its visits of one period are; after the last one the first comes again.
dwell : int64[N]
    How long each lasts at least, without the drive that follows. [ticks]
drive : int64[N]
    The drive into each. [ticks]
enter : int64[N]
    When each begins, rising, within one period. [ticks]

Raises
------
ValueError
    If the arrays do not fit together, the robot is there already, or a booking overlaps another
    robot's. Then nothing is booked.)";

constexpr auto search_doc = R"(Find when a robot can make its visits among the bookings of others.

Parameters
----------
vertex, dwell, drive : int32[N], int64[N], int64[N]
    As for ``add``.
phase : int
    Where on the circle to begin to look. [ticks]
time_limit : float or None
    After so many seconds the search stops.

Returns
-------
int64[N] or None
    When each visit begins; None if no way was found. [ticks]

Raises
------
ValueError
    If the arrays do not fit together.

Notes
-----
Complete for these visits, but where nobody else visits the first vertex: then only this phase is
tried. Deterministic. The GIL is released; Ctrl-C is obeyed.)";

constexpr auto find_way_doc = R"(Find a way for a round trip, and when to take it, among bookings.

Parameters
----------
indptr, indices : int32[V + 1], int32[E]
    The directed graph in compressed rows.
length_class : int32[E]
    The length class of each edge.
pace : int32[C]
    What an edge of each length class takes. [ticks]
home : int
    Where the trip begins and ends.
stage_vertex : int32[S]
    Where the robot has something to do, in order; the last one is its home.
stage_work, stage_turn : int64[S], int64[S]
    How long it works there, and then turns. [ticks]
stage_tables : list of int32[V]
    For each stage, the least ticks from each vertex to its vertex; -1 where the robot must not go.
phase : int
    Where on the circle to begin to look. [ticks]
time_limit : float or None
    After so many seconds the search stops.

Returns
-------
tuple of (int32[N], int64[N], int64[N], int64[N]) or None
    Vertices, dwells, drives and enters of all visits; None if no way was found. [ticks]

Raises
------
ValueError
    If the arrays do not fit together, or a stage cannot be reached.

Notes
-----
Complete among all ways, but where nobody else visits the home: then only this phase is tried. No
trip from this phase is home again earlier. Deterministic. The GIL is released; Ctrl-C is obeyed.)";

using Way = std::tuple<ArrayOut<VertexId>, ArrayOut<Tick>, ArrayOut<Tick>, ArrayOut<Tick>>;

std::optional<Way> find_way(const PeriodicBookings& self, const ArrayIn<EdgeId>& indptr,
                            const ArrayIn<VertexId>& indices,
                            const ArrayIn<std::int32_t>& length_class,
                            const ArrayIn<std::int32_t>& pace, VertexId home,
                            const ArrayIn<VertexId>& stage_vertex, const ArrayIn<Tick>& stage_work,
                            const ArrayIn<Tick>& stage_turn,
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
    return Way{to_numpy(std::move(found.vertex)), to_numpy(std::move(found.dwell)),
               to_numpy(std::move(found.drive)), to_numpy(std::move(found.enter))};
}

Round round_of(const ArrayIn<VertexId>& vertex, const ArrayIn<Tick>& dwell,
               const ArrayIn<Tick>& drive) {
    return {view(vertex), view(dwell), view(drive)};
}

std::optional<ArrayOut<Tick>> search(PeriodicBookings& self, const ArrayIn<VertexId>& vertex,
                                     const ArrayIn<Tick>& dwell, const ArrayIn<Tick>& drive,
                                     Tick phase, std::optional<double> time_limit) {
    const Round round = round_of(vertex, dwell, drive);
    const Deadline deadline(time_limit);
    std::vector<Tick> enter;
    bool is_found = false;
    {
        const nb::gil_scoped_release released;
        is_found = self.search(round, phase, enter, deadline);
    }
    if (!is_found) {
        return std::nullopt;
    }
    return to_numpy(std::move(enter));
}

}  // namespace

void bind_periodic_bookings(nb::module_& module) {
    nb::class_<PeriodicBookings>(module, "PeriodicBookings", class_doc)
        .def(nb::init<VertexId, Tick, Tick, bool>(), nb::arg("n_vertices"), nb::arg("period"),
             nb::arg("headway"), nb::arg("books_ahead"))
        .def_prop_ro("period", &PeriodicBookings::period, "How long the circle is. [ticks]")
        .def_prop_ro("reached", &PeriodicBookings::reached,
                     "Which visit the last search has reached; at the next one it got stuck.")
        .def(
            "add",
            [](PeriodicBookings& self, RobotId robot, const ArrayIn<VertexId>& vertex,
               const ArrayIn<Tick>& dwell, const ArrayIn<Tick>& drive, const ArrayIn<Tick>& enter) {
                self.add(robot, round_of(vertex, dwell, drive), view(enter));
            },
            nb::arg("robot"), nb::arg("vertex").noconvert(), nb::arg("dwell").noconvert(),
            nb::arg("drive").noconvert(), nb::arg("enter").noconvert(), add_doc)
        .def("remove", &PeriodicBookings::remove, nb::arg("robot"),
             "Take back all bookings of a robot; nothing happens if it has none.")
        .def("search", &search, nb::arg("vertex").noconvert(), nb::arg("dwell").noconvert(),
             nb::arg("drive").noconvert(), nb::arg("phase"), nb::arg("time_limit").none(),
             search_doc)
        .def("find_way", &find_way, nb::arg("indptr").noconvert(), nb::arg("indices").noconvert(),
             nb::arg("length_class").noconvert(), nb::arg("pace").noconvert(), nb::arg("home"),
             nb::arg("stage_vertex").noconvert(), nb::arg("stage_work").noconvert(),
             nb::arg("stage_turn").noconvert(), nb::arg("stage_tables"), nb::arg("phase"),
             nb::arg("time_limit").none(), find_way_doc);
}

}  // namespace rightofway::bind
