#include "lacam/lacam.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/tuple.h>

#include <optional>
#include <tuple>
#include <utility>

#include "bindings.hpp"
#include "deadline.hpp"
#include "precedence/retiming.hpp"

namespace rightofway::bind {
namespace {

constexpr auto plan_doc =
    R"(Plan a whole fleet with clocks, instant by instant.

Parameters
----------
indptr, indices, edge_class : int32[V + 1], int32[E], int32[E]
    The directed graph in compressed rows, and which length each edge has.
home : int32[R]
    Where each robot is at first.
first_stage : int32[R + 1]
    Robot ``r`` owns stages ``first_stage[r] .. first_stage[r + 1] - 1``, at least one.
stage_vertex, stage_dwell : int32[S], int64[S]
    The vertices to go to, one after the other, and the ticks of work and turning there; a robot
    stays at its last one.
class_ticks : int32[R * L]
    For each robot, the ticks of an edge of each length.
headway : int
    A vertex stays booked so many ticks after it was left.
books_ahead : bool
    Whether a robot books a vertex from when it starts to drive there.
may_rotate : bool
    Whether three or more robots may move round a circle at one instant; not with a headway or
    booking ahead.
spreads : bool
    Whether robots prefer paths that were spread before the search.
seed : int
    For ties.
most_effort : int
    When the search stops: a choice of a robot is a unit, and so is a decision that it takes again.
time_limit : float or None
    After so many seconds the search stops.

Returns
-------
tuple of (int, int32[R + 1], int32[N], int64[N])
    How it ended (0: found, 1: a stage cannot be reached, 2: stopped), which visits each robot owns,
    and where and when each visit begins.

Raises
------
ValueError
    If the arrays do not fit together.

Notes
-----
Deterministic for a seed as long as there is time, not optimal. A stage out of reach
is the only proof that there is no plan. The GIL is released; Ctrl-C is obeyed.)";

using Plan = std::tuple<int, ArrayOut<VisitId>, ArrayOut<VertexId>, ArrayOut<Tick>>;

struct Manner {
    bool spreads;
    std::uint64_t seed;
    std::int64_t most_effort;
};

SearchEnd search(const Trips& trips, const Manner& manner, const Deadline& deadline,
                 Tracks& tracks) {
    StepTables tables(trips.graph);
    const SearchEnd reach = reach_all(trips.goals(), tables, deadline);
    if (reach != SearchEnd::found) {
        return reach;
    }
    SpaceUtilization paths(trips, tables);
    if (manner.spreads && !paths.choose(deadline)) {
        return SearchEnd::stopped;
    }
    Lacam lacam(trips, tables, paths, manner.seed);
    const SearchEnd end = lacam.run(deadline, manner.most_effort);
    tracks = lacam.tracks();
    return end;
}

Plan plan_by_lacam(const ArrayIn<EdgeId>& indptr, const ArrayIn<VertexId>& indices,
                   const ArrayIn<std::int32_t>& edge_class, const ArrayIn<VertexId>& home,
                   const ArrayIn<std::int32_t>& first_stage, const ArrayIn<VertexId>& stage_vertex,
                   const ArrayIn<Tick>& stage_dwell, const ArrayIn<std::int32_t>& class_ticks,
                   Tick headway, bool books_ahead, bool may_rotate, bool spreads,
                   std::uint64_t seed, std::int64_t most_effort, std::optional<double> time_limit) {
    const Trips trips{{view(indptr), view(indices)},
                      view(edge_class),
                      view(home),
                      view(first_stage),
                      view(stage_vertex),
                      view(stage_dwell),
                      view(class_ticks),
                      headway,
                      books_ahead,
                      may_rotate};
    const Deadline deadline(time_limit);
    SearchEnd end = SearchEnd::stopped;
    Tracks tracks;
    {
        const nb::gil_scoped_release released;
        check(trips);
        end = search(trips, {spreads, seed, most_effort}, deadline, tracks);
        retime(trips, tracks);  // once the tables of the search are gone
    }
    return {static_cast<int>(end), to_numpy(std::move(tracks.first_visit)),
            to_numpy(std::move(tracks.vertex)), to_numpy(std::move(tracks.enter))};
}

}  // namespace

void bind_lacam(nb::module_& module) {
    module.def("plan_by_lacam", &plan_by_lacam, nb::arg("indptr").noconvert(),
               nb::arg("indices").noconvert(), nb::arg("edge_class").noconvert(),
               nb::arg("home").noconvert(), nb::arg("first_stage").noconvert(),
               nb::arg("stage_vertex").noconvert(), nb::arg("stage_dwell").noconvert(),
               nb::arg("class_ticks").noconvert(), nb::arg("headway"), nb::arg("books_ahead"),
               nb::arg("may_rotate"), nb::arg("spreads"), nb::arg("seed"), nb::arg("most_effort"),
               nb::arg("time_limit").none(), plan_doc);
}

}  // namespace rightofway::bind
