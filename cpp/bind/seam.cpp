#include "search/seam.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <optional>
#include <utility>
#include <vector>

#include "bindings.hpp"

namespace rightofway::bind {
namespace {

constexpr auto class_doc =
    R"(Who has booked which vertex when, around the seam of a circle, on a line of time.

Parameters
----------
n_vertices : int
    The number of vertices, V.
headway : int
    How long a vertex stays booked after it was left. [ticks]
books_ahead : bool
    Whether a vertex is booked from when a robot starts to drive there.

Raises
------
ValueError
    If a number is out of its range.)";

constexpr auto add_doc = R"(Book visits of a robot that follow each other.

Parameters
----------
robot : int
    Whose they are.
vertex : int32[N]
    Where they are.
dwell : int64[N]
    How long each lasts at least, without the drive that follows. [ticks]
drive : int64[N]
    The drive into each. [ticks]
enter : int64[N]
    When each begins, rising. [ticks]
leave : int
    When the last one ends. [ticks]

Raises
------
ValueError
    If the arrays do not fit together.

Notes
-----
Bookings of different robots must not overlap; that is not looked at.)";

constexpr auto connect_doc =
    R"(Find when a robot can make visits among the bookings, as early as it can.

Parameters
----------
vertex, dwell, drive : int32[N], int64[N], int64[N]
    As for ``add``.
begins : int
    When the first one begins. [ticks]
until : int
    By when the last one begins. [ticks]
leave : int
    When that ends. [ticks]

Returns
-------
int64[N] or None
    When each begins; None if there is no way. [ticks]

Raises
------
ValueError
    If the arrays do not fit together.

Notes
-----
Complete for these visits; deterministic.)";

constexpr auto users_doc = R"(Return who has booked a vertex between two ticks, each once.

Raises
------
ValueError
    If there is no such vertex.)";

Seam::Stretch stretch_of(const ArrayIn<VertexId>& vertex, const ArrayIn<Tick>& dwell,
                         const ArrayIn<Tick>& drive) {
    return {view(vertex), view(dwell), view(drive)};
}

std::optional<ArrayOut<Tick>> connect(Seam& self, const ArrayIn<VertexId>& vertex,
                                      const ArrayIn<Tick>& dwell, const ArrayIn<Tick>& drive,
                                      Tick begins, Tick until, Tick leave) {
    std::vector<Tick> enter;
    if (!self.connect(stretch_of(vertex, dwell, drive), begins, until, leave, enter)) {
        return std::nullopt;
    }
    return to_numpy(std::move(enter));
}

}  // namespace

void bind_seam(nb::module_& module) {
    nb::class_<Seam>(module, "Seam", class_doc)
        .def(nb::init<VertexId, Tick, bool>(), nb::arg("n_vertices"), nb::arg("headway"),
             nb::arg("books_ahead"))
        .def_prop_ro("reached", &Seam::reached,
                     "Which visit the last search has reached; at the next one it got stuck.")
        .def(
            "add",
            [](Seam& self, RobotId robot, const ArrayIn<VertexId>& vertex,
               const ArrayIn<Tick>& dwell, const ArrayIn<Tick>& drive, const ArrayIn<Tick>& enter,
               Tick leave) {
                self.add(robot, stretch_of(vertex, dwell, drive), view(enter), leave);
            },
            nb::arg("robot"), nb::arg("vertex").noconvert(), nb::arg("dwell").noconvert(),
            nb::arg("drive").noconvert(), nb::arg("enter").noconvert(), nb::arg("leave"), add_doc)
        .def(
            "remove",
            [](Seam& self, RobotId robot, const ArrayIn<VertexId>& vertices) {
                self.remove(robot, view(vertices));
            },
            nb::arg("robot"), nb::arg("vertices").noconvert(),
            "Take back what a robot has booked at these vertices.")
        .def("connect", &connect, nb::arg("vertex").noconvert(), nb::arg("dwell").noconvert(),
             nb::arg("drive").noconvert(), nb::arg("begins"), nb::arg("until"), nb::arg("leave"),
             connect_doc)
        .def(
            "users",
            [](Seam& self, VertexId vertex, Tick begins, Tick ends) {
                return to_numpy(self.users(vertex, begins, ends));
            },
            nb::arg("vertex"), nb::arg("begins"), nb::arg("ends"), users_doc);
}

}  // namespace rightofway::bind
