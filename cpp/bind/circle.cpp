#include "rightofway/circle.hpp"

#include <nanobind/stl/optional.h>

#include <optional>
#include <utility>

#include "bindings.hpp"
#include "deadline.hpp"

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

Round round_of(const ArrayIn<VertexId>& vertex, const ArrayIn<Tick>& dwell,
               const ArrayIn<Tick>& drive) {
    return {view(vertex), view(dwell), view(drive)};
}

std::optional<ArrayOut<Tick>> search(Circle& self, const ArrayIn<VertexId>& vertex,
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

void bind_circle(nb::module_& module) {
    nb::class_<Circle>(module, "Circle", class_doc)
        .def(nb::init<VertexId, Tick, Tick, bool>(), nb::arg("n_vertices"), nb::arg("period"),
             nb::arg("headway"), nb::arg("books_ahead"))
        .def_prop_ro("period", &Circle::period, "How long the circle is. [ticks]")
        .def_prop_ro("reached", &Circle::reached,
                     "Which visit the last search has reached; at the next one it got stuck.")
        .def(
            "add",
            [](Circle& self, RobotId robot, const ArrayIn<VertexId>& vertex,
               const ArrayIn<Tick>& dwell, const ArrayIn<Tick>& drive, const ArrayIn<Tick>& enter) {
                self.add(robot, round_of(vertex, dwell, drive), view(enter));
            },
            nb::arg("robot"), nb::arg("vertex").noconvert(), nb::arg("dwell").noconvert(),
            nb::arg("drive").noconvert(), nb::arg("enter").noconvert(), add_doc)
        .def("remove", &Circle::remove, nb::arg("robot"),
             "Take back all bookings of a robot; nothing happens if it has none.")
        .def("search", &search, nb::arg("vertex").noconvert(), nb::arg("dwell").noconvert(),
             nb::arg("drive").noconvert(), nb::arg("phase"), nb::arg("time_limit").none(),
             search_doc);
}

}  // namespace rightofway::bind
