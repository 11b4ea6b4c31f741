#include "rightofway/safe_interval_search.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <optional>
#include <tuple>

#include "bindings.hpp"
#include "deadline.hpp"
#include "rightofway/booking_table.hpp"

namespace rightofway::bind {
namespace {

constexpr auto table_doc =
    R"(Who has booked which vertex when; no two robots' bookings of a vertex overlap.

Parameters
----------
n_vertices : int
    The number of vertices, V.

Raises
------
ValueError
    If the number is negative.)";

constexpr auto book_doc = R"(Book a vertex.

Parameters
----------
vertex : int
    The vertex.
start, end : int
    It is booked for ``[start, end)``. [ticks]
robot : int
    By whom.

Raises
------
ValueError
    If there is no such vertex, the booking is empty, or it overlaps another robot's.)";

constexpr auto release_doc = R"(Take back all that a robot has booked.

Parameters
----------
robot : int
    The robot; one without bookings will do.)";

constexpr auto at_doc = R"(Return the bookings of a vertex in order of time.

Parameters
----------
vertex : int
    The vertex.

Returns
-------
list of tuple[int, int, int]
    ``(start, end, robot)``. [ticks]

Raises
------
ValueError
    If there is no such vertex.)";

constexpr auto search_doc =
    R"(Find the track of one robot that completes first and overlaps no booking.

Parameters
----------
indptr, indices : int32[V + 1], int32[E]
    The directed graph in compressed rows.
edge_ticks : int32[E]
    What each edge takes. [ticks]
bookings : BookingTable
    What the other robots have booked.
headway : int
    How long a vertex stays booked after it was left. [ticks]
books_ahead : bool
    Whether a vertex is booked from when the robot starts to drive there.
home : int
    Where the robot is at tick 0.
stage_vertex : int32[S]
    Where it has something to do, in order; it stays at the last one for ever.
stage_dwell : int64[S]
    How long that takes there, turning included where an edge follows. [ticks]
stage_tables : list of int32[V]
    For each stage, the least ticks from each vertex to its vertex.
time_limit : float or None
    After so many seconds the search stops.

Returns
-------
tuple of (int, int32[n], int64[n])
    How it ended (0: found, 1: proven that there is no such track, 2: out of time), the vertices and
    when each is entered. [ticks]

Raises
------
ValueError
    If the arrays do not fit together, or a stage cannot be reached.

Notes
-----
Complete and optimal among fixed bookings, deterministic. The GIL is released; Ctrl-C is obeyed.)";

using Found = std::tuple<int, ArrayOut<VertexId>, ArrayOut<Tick>>;

std::vector<std::tuple<Tick, Tick, RobotId>> at(const BookingTable& self, VertexId vertex) {
    if (vertex < 0 || vertex >= self.n_vertices()) {
        throw nb::value_error("vertex: there is no such vertex");
    }
    std::vector<std::tuple<Tick, Tick, RobotId>> bookings;
    for (const BookedBy& booking : self.at(vertex)) {
        bookings.emplace_back(booking.time.start, booking.time.end, booking.robot);
    }
    return bookings;
}

Found earliest_track(const ArrayIn<EdgeId>& indptr, const ArrayIn<VertexId>& indices,
                     const ArrayIn<std::int32_t>& edge_ticks, const BookingTable& bookings,
                     Tick headway, bool books_ahead, VertexId home,
                     const ArrayIn<VertexId>& stage_vertex, const ArrayIn<Tick>& stage_dwell,
                     const std::vector<ArrayIn<std::int32_t>>& stage_tables,
                     std::optional<double> time_limit) {
    Trip trip{home, view(stage_vertex), view(stage_dwell), view(edge_ticks), {}};
    for (const auto& table : stage_tables) {
        trip.stage_tables.push_back(view(table));
    }
    const Deadline deadline(time_limit);
    SearchEnd end = SearchEnd::stopped;
    FoundTrack track;
    {
        const nb::gil_scoped_release released;
        const Graph graph{view(indptr), view(indices)};
        SafeIntervalSearch search(graph, bookings, {headway, books_ahead}, trip);
        end = search.run(deadline);
        track = search.track();
    }
    return {static_cast<int>(end), to_numpy(std::move(track.vertices)),
            to_numpy(std::move(track.enter))};
}

}  // namespace

void bind_safe_interval_search(nb::module_& module) {
    nb::class_<BookingTable>(module, "BookingTable", table_doc)
        .def(nb::init<VertexId>(), nb::arg("n_vertices"))
        .def(
            "book",
            [](BookingTable& self, VertexId vertex, Tick start, Tick end, RobotId robot) {
                self.book(vertex, {start, end}, robot);
            },
            nb::arg("vertex"), nb::arg("start"), nb::arg("end"), nb::arg("robot"), book_doc)
        .def("release", &BookingTable::release, nb::arg("robot"), release_doc)
        .def("at", &at, nb::arg("vertex"), at_doc);
    module.def("earliest_track", &earliest_track, nb::arg("indptr").noconvert(),
               nb::arg("indices").noconvert(), nb::arg("edge_ticks").noconvert(),
               nb::arg("bookings"), nb::arg("headway"), nb::arg("books_ahead"), nb::arg("home"),
               nb::arg("stage_vertex").noconvert(), nb::arg("stage_dwell").noconvert(),
               nb::arg("stage_tables"), nb::arg("time_limit").none(), search_doc);
}

}  // namespace rightofway::bind
