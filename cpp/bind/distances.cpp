#include "bindings.hpp"
#include "distances/congestion.hpp"
#include "distances/distance_tables.hpp"
#include "distances/energy_tables.hpp"
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

constexpr auto energies_of_quickest_ways_doc =
    R"(Return the energy of a quickest way from each vertex, the least of those, int64[V].

Parameters
----------
ticks_to : int32[V]
    What `to` returned for the target. [ticks]
edge_ticks : int32[E]
    What it was given. [ticks]
edge_energy : int64[E]
    What each edge takes.
most : int
    Returned where the way takes more, or none exists.)";

constexpr auto least_energies_doc =
    R"(Return the least energy from each vertex to one of the targets, int64[V].

Parameters
----------
targets : int32[n]
    The vertices of which one is to be reached.
edge_energy : int64[E]
    What each edge takes; -1 where it is barred.
most : int
    Returned where the way takes more, or none exists.)";

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
        .def("to", &to, nb::arg("target"), array("edge_ticks"), to_doc)
        .def(
            "energies_of_quickest_ways",
            [](const DistanceTables& self, const ArrayIn<std::int32_t>& ticks_to,
               const ArrayIn<std::int32_t>& edge_ticks, const ArrayIn<std::int64_t>& edge_energy,
               std::int64_t most) {
                return to_numpy(find_energies_of_quickest_ways(
                    self.reverse(), view(ticks_to), view(edge_ticks), view(edge_energy), most));
            },
            array("ticks_to"), array("edge_ticks"), array("edge_energy"), nb::arg("most"),
            energies_of_quickest_ways_doc)
        .def(
            "least_energies",
            [](const DistanceTables& self, const ArrayIn<VertexId>& targets,
               const ArrayIn<std::int64_t>& edge_energy, std::int64_t most) {
                return to_numpy(
                    find_least_energies(self.reverse(), view(targets), view(edge_energy), most));
            },
            array("targets"), array("edge_energy"), nb::arg("most"), least_energies_doc);
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
