#include "bindings.hpp"
#include "distances/distance_tables.hpp"

namespace rightofway::bind {
namespace {

constexpr auto class_doc = R"(Least ticks from every vertex to one target.

A directed graph in compressed rows: the edges that leave vertex ``v`` are
``indptr[v] .. indptr[v + 1] - 1``, and edge ``e`` ends at ``indices[e]``. The graph is copied
(reversed) once; tables for any target and any speed are made from it.

Parameters
----------
indptr : int32[V + 1]
    Where each vertex's edges begin.
indices : int32[E]
    The vertex at which each edge ends.

Raises
------
ValueError
    If the arrays do not describe a graph; names the array, the index and the value.)";

constexpr auto to_doc = R"(Return the least time from each vertex to one target.

Parameters
----------
target : int
    The vertex to go to.
edge_ticks : int32[E]
    What each edge takes, above 0. [ticks]

Returns
-------
int32[V]
    Least time from each vertex, following edges forward; -1 where no way leads there. [ticks]

Raises
------
ValueError
    If the target is no vertex, or an edge takes no time; names the index and the value.
OverflowError
    If a least time does not fit int32.

Notes
-----
Exact and deterministic. Breadth-first search if all edges take the same time, Dijkstra's
algorithm otherwise. The GIL is released, and several threads may ask one object at once.)";

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

}  // namespace

void bind_distances(nb::module_& module) {
    nb::class_<DistanceTables>(module, "DistanceTables", class_doc)
        .def("__init__", &init, nb::arg("indptr").noconvert(), nb::arg("indices").noconvert())
        .def("to", &to, nb::arg("target"), nb::arg("edge_ticks").noconvert(), to_doc)
        .def_prop_ro("n_vertices", &DistanceTables::n_vertices, "The number of vertices, V.")
        .def_prop_ro("n_edges", &DistanceTables::n_edges, "The number of edges, E.");
}

}  // namespace rightofway::bind
