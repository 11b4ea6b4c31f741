#include "rightofway/traffic.hpp"

#include "bindings.hpp"

namespace rightofway::bind {
namespace {

constexpr auto class_doc = R"(Cheapest paths that keep clear of other robots.

To drive an edge costs ``SHARES`` for each tick that it takes; ``station`` more per tick if it ends
at a station other than the target, and ``oncoming`` more per tick for every robot that was added on
the opposite edge.

Parameters
----------
indptr : int32[V + 1]
    Where each vertex's edges begin.
indices : int32[E]
    The vertex at which each edge ends.
is_station : uint8[V]
    Not 0 where a robot has its home or a stop.
station, oncoming : int
    The surcharges, not negative.

Raises
------
ValueError
    If the arrays do not fit together; names the array, the index and the value.)";

constexpr auto path_doc = R"(Return a cheapest path.

Parameters
----------
start, target : int
    The vertices from and to which it leads.
edge_ticks : int32[E]
    What each edge takes, above 0. [ticks]
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

Raises
------
ValueError
    If that is no path.)";

void init(Traffic* self, const ArrayIn<EdgeId>& indptr, const ArrayIn<VertexId>& indices,
          const ArrayIn<std::uint8_t>& is_station, std::int64_t station, std::int64_t oncoming) {
    new (self)
        Traffic({view(indptr), view(indices)}, view(is_station), Surcharges{station, oncoming});
}

ArrayOut<VertexId> path(Traffic& self, VertexId start, VertexId target,
                        const ArrayIn<std::int32_t>& edge_ticks,
                        const ArrayIn<std::int32_t>& to_go) {
    return to_numpy(self.path(start, target, view(edge_ticks), view(to_go)));
}

}  // namespace

void bind_traffic(nb::module_& module) {
    nb::class_<Traffic> traffic(module, "Traffic", class_doc);
    traffic.attr("SHARES") = Traffic::shares;
    traffic
        .def("__init__", &init, nb::arg("indptr").noconvert(), nb::arg("indices").noconvert(),
             nb::arg("is_station").noconvert(), nb::arg("station"), nb::arg("oncoming"))
        .def("path", &path, nb::arg("start"), nb::arg("target"), nb::arg("edge_ticks").noconvert(),
             nb::arg("to_go").noconvert(), path_doc)
        .def(
            "add", [](Traffic& self, const ArrayIn<VertexId>& path) { self.add(view(path)); },
            nb::arg("path").noconvert(), add_doc);
}

}  // namespace rightofway::bind
