#include "bindings.hpp"
#include "distances/congestion.hpp"
#include "distances/distance_tables.hpp"

namespace rightofway::bind {
namespace {

constexpr auto class_doc =
    R"(Least ticks from every vertex to one target, on a graph in compressed rows.

The edges that leave vertex ``v`` are ``indptr[v] .. indptr[v + 1] - 1``, and edge ``e`` ends at
``indices[e]``. The graph is copied (reversed) once; several threads may ask one object at once.)";

constexpr auto to_doc =
    R"(Return the least time from each vertex to a target, -1 where no way leads there, int32[V].

``edge_ticks`` (int32[E], above 0) has what each edge takes. OverflowError if a least time does not
fit int32.)";

void init(DistanceTables* self, const ArrayIn<EdgeId>& indptr, const ArrayIn<VertexId>& indices) {
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

constexpr auto congestion_doc = R"(Cheapest paths that keep clear of other robots.

To drive an edge costs ``shares`` for each tick that it takes, and more per tick: what it costs to
enter the vertex that it ends at (``station``, int64[V]), unless that is the target, and what every
robot costs that was added on the opposite edge.)";

constexpr auto path_doc = R"(Return the vertices of a cheapest path, both ends included, int32[n].

``to_go`` has the least ticks from each vertex to the target, -1 where no way leads there. Of
several cheapest paths, the one that takes the first edge of a vertex that it can.)";

constexpr auto add_doc =
    R"(Count one more robot on a path; to go against it costs ``oncoming`` [shares per tick].)";

}  // namespace

void bind_distances(nb::module_& module) {
    nb::class_<DistanceTables>(module, "DistanceTables", class_doc)
        .def("__init__", &init, array("indptr"), array("indices"))
        .def("to", &to, nb::arg("target"), array("edge_ticks"), to_doc);
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
                return to_numpy(self.path(robot, start, target, view(to_go)));
            },
            nb::arg("robot"), nb::arg("start"), nb::arg("target"), array("to_go"), path_doc)
        .def(
            "add",
            [](Congestion& self, const ArrayIn<VertexId>& path, std::int64_t oncoming) {
                self.add(view(path), oncoming);
            },
            array("path"), nb::arg("oncoming"), add_doc);
}

}  // namespace rightofway::bind
