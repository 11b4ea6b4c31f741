#include "search/sipp.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "bindings.hpp"
#include "core/reject.hpp"
#include "deadline.hpp"
#include "search/booking_table.hpp"

namespace rightofway::bind {
namespace {

constexpr auto table_doc =
    R"(Who has booked which vertex when.

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

constexpr auto insert_doc = R"(Book a vertex, whoever else has booked it.

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
    If there is no such vertex or robot, or the booking is empty.)";

constexpr auto erase_doc = R"(Take back a booking.

Parameters
----------
vertex : int
    The vertex.
start : int
    When the booking starts; nothing happens if there is none. [ticks]
robot : int
    Whose it is.

Raises
------
ValueError
    If there is no such vertex.)";

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
    R"(Find the best track of one robot among the bookings of others.

Parameters
----------
indptr, indices : int32[V + 1], int32[E]
    The directed graph in compressed rows.
length_class : int32[E]
    The length class of each edge.
pace : int32[C]
    What an edge of each length class takes. [ticks]
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
stage_work, stage_turn : int64[S], int64[S]
    How long it works there, and then turns if it drives on. [ticks]
stage_tables : list of int32[V]
    For each stage, the least ticks from each vertex to its vertex.
prices : int64[R]
    For each other robot, what it costs to overlap one of its bookings; empty: never. [ticks]
time_limit : float or None
    After so many seconds the search stops.

Returns
-------
tuple of (int, int32[n], int64[n], int)
    How it ended (0: found, 1: proven that there is no such track, 2: out of time), the vertices,
    when each is entered, and the completion with all prices. [ticks]

Raises
------
ValueError
    If the arrays do not fit together, or a stage cannot be reached.

Notes
-----
Complete and optimal among fixed bookings, deterministic. The GIL is released; Ctrl-C is obeyed.)";

using Found = std::tuple<int, ArrayOut<VertexId>, ArrayOut<Tick>, Tick>;

void require_vertex(const BookingTable& self, VertexId vertex) {
    require_id("vertex", vertex, self.n_vertices());
}

std::vector<std::tuple<Tick, Tick, RobotId>> at(const BookingTable& self, VertexId vertex) {
    require_vertex(self, vertex);
    std::vector<std::tuple<Tick, Tick, RobotId>> bookings;
    for (const BookedBy& booking : self.at(vertex)) {
        bookings.emplace_back(booking.time.start, booking.time.end, booking.robot);
    }
    return bookings;
}

// Robots without a price are told before the search meets them.
void require_prices(const BookingTable& bookings, std::span<const Tick> prices) {
    for (VertexId vertex = 0; vertex < bookings.n_vertices() && !prices.empty(); ++vertex) {
        for (const BookedBy& booking : bookings.at(vertex)) {
            require_id("robot", booking.robot, static_cast<std::int64_t>(prices.size()));
        }
    }
    for (std::size_t robot = 0; robot < prices.size(); ++robot) {
        if (prices[robot] < 0 || prices[robot] >= conflict_cap) {
            reject_entry("prices", robot, prices[robot], "is negative or too high");
        }
    }
}

Found earliest_track(const ArrayIn<EdgeId>& indptr, const ArrayIn<VertexId>& indices,
                     const ArrayIn<std::int32_t>& length_class, const ArrayIn<std::int32_t>& pace,
                     const BookingTable& bookings, Tick headway, bool books_ahead, VertexId home,
                     const ArrayIn<VertexId>& stage_vertex, const ArrayIn<Tick>& stage_work,
                     const ArrayIn<Tick>& stage_turn,
                     const std::vector<ArrayIn<std::int32_t>>& stage_tables,
                     const ArrayIn<Tick>& prices, std::optional<double> time_limit) {
    const Roads roads{{view(indptr), view(indices)}, view(length_class)};
    Trip trip{home, view(stage_vertex), view(stage_work), view(stage_turn), view(pace), {}};
    require_length("indptr", indptr.size(), static_cast<std::size_t>(bookings.n_vertices()) + 1);
    for (std::size_t k = 0; k < stage_tables.size(); ++k) {
        require_length("stage_tables[" + std::to_string(k) + "]", stage_tables[k].size(),
                       static_cast<std::size_t>(bookings.n_vertices()));
        trip.to_stage.emplace_back(stage_tables[k].data(), 1);
    }
    require_trip(roads, trip);
    require_prices(bookings, view(prices));
    const Deadline deadline(time_limit);
    SearchEnd end = SearchEnd::stopped;
    std::vector<Visit> track;
    Tick cost = 0;
    {
        const nb::gil_scoped_release released;
        SafeIntervalSearch search(roads, {headway, books_ahead});
        end = search.run({trip, bookings, view(prices)}, deadline);
        search.track(track);
        cost = end == SearchEnd::found ? search.cost() : 0;
    }
    std::vector<VertexId> vertices;
    std::vector<Tick> enter;
    for (const Visit& visit : track) {
        vertices.push_back(visit.vertex);
        enter.push_back(visit.enter);
    }
    return {static_cast<int>(end), to_numpy(std::move(vertices)), to_numpy(std::move(enter)), cost};
}

}  // namespace

void bind_sipp(nb::module_& module) {
    nb::class_<BookingTable>(module, "BookingTable", table_doc)
        .def(nb::init<VertexId>(), nb::arg("n_vertices"))
        .def(
            "book",
            [](BookingTable& self, VertexId vertex, Tick start, Tick end, RobotId robot) {
                self.book(vertex, {start, end}, robot);
            },
            nb::arg("vertex"), nb::arg("start"), nb::arg("end"), nb::arg("robot"), book_doc)
        .def(
            "insert",
            [](BookingTable& self, VertexId vertex, Tick start, Tick end, RobotId robot) {
                require_vertex(self, vertex);
                if (robot < 0 || end <= start) {
                    reject("end", end, "is not after start, or the robot is none");
                }
                self.insert(vertex, {start, end}, robot);
            },
            nb::arg("vertex"), nb::arg("start"), nb::arg("end"), nb::arg("robot"), insert_doc)
        .def(
            "erase",
            [](BookingTable& self, VertexId vertex, Tick start, RobotId robot) {
                require_vertex(self, vertex);
                self.erase(vertex, start, robot);
            },
            nb::arg("vertex"), nb::arg("start"), nb::arg("robot"), erase_doc)
        .def("at", &at, nb::arg("vertex"), at_doc);
    module.def("earliest_track", &earliest_track, nb::arg("indptr").noconvert(),
               nb::arg("indices").noconvert(), nb::arg("length_class").noconvert(),
               nb::arg("pace").noconvert(), nb::arg("bookings"), nb::arg("headway"),
               nb::arg("books_ahead"), nb::arg("home"), nb::arg("stage_vertex").noconvert(),
               nb::arg("stage_work").noconvert(), nb::arg("stage_turn").noconvert(),
               nb::arg("stage_tables"), nb::arg("prices").noconvert(), nb::arg("time_limit").none(),
               search_doc);
}

}  // namespace rightofway::bind
