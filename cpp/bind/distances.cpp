#include "bindings.hpp"
#include "distances/congestion.hpp"
#include "distances/distance_tables.hpp"
#include "distances/shortest_paths.hpp"

namespace rightofway::bind {
namespace {

constexpr auto distances_doc =
    R"(Least ticks from every vertex to one target, on a graph in compressed rows.

The graph is copied (reversed) once; several threads may ask one object at once.

Parameters
----------
indptr, indices : int32[V + 1], int32[E]
    The edges that leave vertex ``v`` are ``indptr[v] .. indptr[v + 1] - 1``, and edge ``e`` ends at
    ``indices[e]``.)";

constexpr auto to_doc =
    R"(Return the least time from each vertex to a target, -1 where no way leads there, int32[V].

Parameters
----------
target : int
    The vertex to reach.
edge_ticks : int32[E]
    What each edge takes, above 0; -1 where it is barred. [ticks]

Raises
------
OverflowError
    If a least time does not fit int32.)";

void init_distances(DistanceTables* self, const ArrayIn<EdgeId>& indptr,
                    const ArrayIn<VertexId>& indices) {
    const nb::gil_scoped_release released;
    new (self) DistanceTables(view(indptr), view(indices));
}

ArrayOut<std::int32_t> to(const DistanceTables& self, VertexId target,
                          const ArrayIn<std::int32_t>& edge_ticks) {
    std::vector<std::int32_t> distance;
    {
        const nb::gil_scoped_release released;
        distance = self.to(target, view(edge_ticks));
    }
    return to_numpy(std::move(distance));
}

constexpr auto paths_doc =
    R"(Canonical shortest paths between single pairs of vertices, without a table for each target.

The graph is copied once; one thread at a time may use one object.

Parameters
----------
indptr, indices : int32[V + 1], int32[E]
    The graph, as for `DistanceTables`.
edge_ticks : int32[E]
    What each edge takes, above 0; -1 where it is barred. [ticks])";

constexpr auto find_doc =
    R"(Return the vertices of a shortest path, both ends included, int32[n]; empty if there is none.

Of several shortest paths, the one that takes the first edge of a vertex that it can.

Parameters
----------
start, target : int
    The vertices at which the path begins and ends.

Raises
------
OverflowError
    If a least time does not fit int32.)";

constexpr auto congestion_doc = R"(Cheapest paths that keep clear of other robots.

To drive an edge costs ``shares`` for each tick that it takes, and more per tick: what it costs to
enter the vertex that it ends at, unless that is the target, and what every robot costs that was
added on the opposite edge.

Parameters
----------
problem : Problem
    The roads, and how fast robots drive.
shares : int
    In how many shares a tick is counted, above 0.
station : int64[V]
    What it costs more to enter each vertex. [shares per tick])";

constexpr auto path_doc = R"(Return the vertices of a cheapest path, both ends included, int32[n].

Of several cheapest paths, the one that takes the first edge of a vertex that it can.

Parameters
----------
robot : int
    The robot that drives.
start, target : int
    The vertices at which the path begins and ends.
to_go : int32[V]
    The least ticks from each vertex to the target, -1 where no way leads there.)";

constexpr auto add_congestion_doc =
    R"(Count one more robot on a path.

Parameters
----------
path : int32[n]
    The vertices of the path.
oncoming : int
    What it costs to go against the robot. [shares per tick])";

}  // namespace

void bind_distances(nb::module_& module) {
    nb::class_<DistanceTables>(module, "DistanceTables", distances_doc)
        .def("__init__", &init_distances, array("indptr"), array("indices"))
        .def("to", &to, nb::arg("target"), array("edge_ticks"), to_doc);
    nb::class_<ShortestPaths>(module, "ShortestPaths", paths_doc)
        .def(
            "__init__",
            [](ShortestPaths* self, const ArrayIn<EdgeId>& indptr, const ArrayIn<VertexId>& indices,
               const ArrayIn<std::int32_t>& edge_ticks) {
                new (self) ShortestPaths(view(indptr), view(indices), view(edge_ticks));
            },
            array("indptr"), array("indices"), array("edge_ticks"))
        .def(
            "find",
            [](ShortestPaths& self, VertexId start, VertexId target) {
                return to_numpy(self.find(start, target));
            },
            nb::arg("start"), nb::arg("target"), find_doc);
    nb::class_<Congestion>(module, "Congestion", congestion_doc)
        .def(
            "__init__",
            [](Congestion* self, const Problem& problem, std::int64_t shares,
               const ArrayIn<std::int64_t>& station) {
                new (self) Congestion(problem, shares, view(station));
            },
            nb::arg("problem"), nb::arg("shares"), array("station"), nb::keep_alive<1, 2>())
        .def(
            "path",
            [](Congestion& self, RobotId robot, VertexId start, VertexId target,
               const ArrayIn<std::int32_t>& to_go) {
                std::vector<VertexId> path;
                {
                    const Deadline interrupt(std::nullopt);
                    const nb::gil_scoped_release released;
                    path = self.path(robot, start, target, view(to_go), interrupt);
                }
                return to_numpy(std::move(path));
            },
            nb::arg("robot"), nb::arg("start"), nb::arg("target"), array("to_go"), path_doc)
        .def(
            "add",
            [](Congestion& self, const ArrayIn<VertexId>& path, std::int64_t oncoming) {
                self.add(view(path), oncoming);
            },
            array("path"), nb::arg("oncoming"), add_congestion_doc);
}

}  // namespace rightofway::bind
