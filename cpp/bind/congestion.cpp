#include "distances/congestion.hpp"

#include "bindings.hpp"

namespace rightofway::bind {
namespace {

constexpr auto class_doc = R"(Cheapest paths that keep clear of other robots.

To drive an edge costs ``shares`` for each tick that it takes, and more per tick: what it costs to
enter the vertex that it ends at, unless that is the target, and what every robot costs that was
added on the opposite edge.

Parameters
----------
problem : Problem
    The roads, and how fast robots drive.
shares : int
    In how many shares a tick is counted.
station : int64[V]
    What it costs to enter each vertex, not negative. [shares per tick]

Raises
------
ValueError
    If the arrays do not fit together; names the array, the index and the value.)";

constexpr auto path_doc = R"(Return a cheapest path.

Parameters
----------
robot : int
    Which robot.
start, target : int
    The vertices from and to which it leads.
to_go : int32[V]
    Least time from each vertex to the target, -1 where no way leads there. [ticks]

Returns
-------
int32[n]
    The vertices of the path, both ends included. Of several cheapest paths, the one that takes the
    first edge of a vertex that it can.

Raises
------
ValueError
    If there is no path, or something does not fit together.)";

constexpr auto add_doc = R"(Count one more robot on a path.

Parameters
----------
path : int32[n]
    Vertices, each a neighbour of the one before.
oncoming : int
    What it costs to go against it, not negative. [shares per tick]

Raises
------
ValueError
    If that is no path.)";

}  // namespace

void bind_congestion(nb::module_& module) {
    nb::class_<Congestion>(module, "Congestion", class_doc)
        .def(
            "__init__",
            [](Congestion* self, const Problem& problem, std::int64_t shares,
               const ArrayIn<std::int64_t>& station) {
                new (self) Congestion(problem, shares, view(station));
            },
            nb::arg("problem"), nb::arg("shares"), nb::arg("station").noconvert(),
            nb::keep_alive<1, 2>())
        .def(
            "path",
            [](Congestion& self, RobotId robot, VertexId start, VertexId target,
               const ArrayIn<std::int32_t>& to_go) {
                return to_numpy(self.path(robot, start, target, view(to_go)));
            },
            nb::arg("robot"), nb::arg("start"), nb::arg("target"), nb::arg("to_go").noconvert(),
            path_doc)
        .def(
            "add",
            [](Congestion& self, const ArrayIn<VertexId>& path, std::int64_t oncoming) {
                self.add(view(path), oncoming);
            },
            nb::arg("path").noconvert(), nb::arg("oncoming"), add_doc);
}

}  // namespace rightofway::bind
