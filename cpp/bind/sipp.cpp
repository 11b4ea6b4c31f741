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
#include "search/booking_table.hpp"

namespace rightofway::bind {
namespace {

constexpr auto table_doc = R"(Who has booked which vertex when.

Parameters
----------
n_vertices : int
    The number of vertices; where robots have sizes or edges are closed, of rows.)";

constexpr auto book_doc =
    R"(Book a vertex for ``[start, end)``; ValueError if that is empty or overlaps another robot's.

Parameters
----------
vertex : int
    The vertex.
start, end : int
    The half-open interval; the end is after the start. [ticks]
robot : int
    The robot.)";

constexpr auto mark_doc =
    R"(Mark a row as excluded for ``[start, end)``; marks may overlap.

Parameters
----------
row : int
    The row, or vertex.
start, end : int
    The half-open interval; the end is after the start. [ticks]
robot : int
    The robot; -1 for nobody, where the row is closed.)";

constexpr auto erase_doc =
    R"(Take back a booking of a robot; nothing happens if there is none.

Parameters
----------
vertex : int
    The vertex, or row.
start : int
    When the booking starts. [ticks]
robot : int
    The robot.)";

constexpr auto at_doc =
    R"(Return the bookings ``(start, end, robot)`` of a vertex in order of time. [ticks]

Parameters
----------
vertex : int
    The vertex, or row.)";

constexpr auto search_track_doc =
    R"(Find the earliest track of one robot among the bookings of others.

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
    and when each is entered. [ticks])";

using Found = std::tuple<int, ArrayOut<VertexId>, ArrayOut<Tick>>;

void require_vertex(const BookingTable& self, VertexId vertex) {
    require_id("vertex", vertex, self.n_rows());
}

std::vector<std::tuple<Tick, Tick, RobotId>> at(const BookingTable& self, VertexId vertex) {
    require_vertex(self, vertex);
    std::vector<std::tuple<Tick, Tick, RobotId>> bookings;
    for (const BookedBy& booking : self.at(vertex)) {
        bookings.emplace_back(booking.time.start, booking.time.end, booking.robot);
    }
    return bookings;
}

Found earliest_track(const Problem& problem, RobotId robot, const BookingTable& bookings,
                     const std::vector<ArrayIn<std::int32_t>>& stage_tables,
                     std::optional<double> time_limit) {
    require_id("robot", robot, problem.n_robots());
    require_length("bookings", static_cast<std::size_t>(bookings.n_rows()),
                   static_cast<std::size_t>(problem.n_rows()));
    Trip trip{problem.itinerary(robot), {}, problem.first_row(robot)};
    for (std::size_t k = 0; k < stage_tables.size(); ++k) {
        require_length("stage_tables[" + std::to_string(k) + "]", stage_tables[k].size(),
                       static_cast<std::size_t>(problem.n_vertices()));
        trip.to_stage.emplace_back(stage_tables[k].data(), 1);
    }
    require_trip(problem.roads(), trip);
    const Deadline deadline(time_limit);
    SearchEnd end = SearchEnd::stopped;
    std::vector<Visit> track;
    {
        const nb::gil_scoped_release released;
        SafeIntervalSearch search(problem.roads(), problem.rules());
        end = search.run({trip, bookings}, deadline);
        search.track(track);
    }
    std::vector<VertexId> vertices;
    std::vector<Tick> enter;
    for (const Visit& visit : track) {
        vertices.push_back(visit.vertex);
        enter.push_back(visit.enter);
    }
    return {static_cast<int>(end), to_numpy(std::move(vertices)), to_numpy(std::move(enter))};
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
            "mark",
            [](BookingTable& self, std::int32_t row, Tick start, Tick end, RobotId robot) {
                self.mark(row, {start, end}, robot);
            },
            nb::arg("row"), nb::arg("start"), nb::arg("end"), nb::arg("robot"), mark_doc)
        .def(
            "erase",
            [](BookingTable& self, VertexId vertex, Tick start, RobotId robot) {
                require_vertex(self, vertex);
                self.erase(vertex, start, robot);
            },
            nb::arg("vertex"), nb::arg("start"), nb::arg("robot"), erase_doc)
        .def("at", &at, nb::arg("vertex"), at_doc);
    module.def("earliest_track", &earliest_track, nb::arg("problem"), nb::arg("robot"),
               nb::arg("bookings"), nb::arg("stage_tables"), nb::arg("time_limit").none(),
               search_track_doc);
}

}  // namespace rightofway::bind
