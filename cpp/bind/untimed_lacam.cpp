#include "lacam/untimed_lacam.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/tuple.h>

#include <optional>
#include <tuple>
#include <vector>

#include "bindings.hpp"
#include "deadline.hpp"

namespace rightofway::bind {
namespace {

constexpr auto steps_doc =
    R"(Find steps for the whole fleet that bring every robot through its stages.

Time plays no part: in a step each robot stays or moves to a neighbour, no two are at one vertex and
no two change places. Times follow from the routes and the order of visits at each vertex.

Parameters
----------
indptr, indices : int32[V + 1], int32[E]
    The directed graph in compressed rows.
home : int32[R]
    Where each robot is at first.
first_stage : int32[R + 1]
    Robot ``r`` owns stages ``first_stage[r] .. first_stage[r + 1] - 1``, at least one.
stage_vertex : int32[S]
    The vertices to go to, one after the other; a robot stays at its last one.
may_rotate : bool
    Whether three or more robots may move round a circle in one step.
ends_anywhere : uint8[R], or empty
    Whether a robot may end anywhere once its last stage is the next one; it only prefers that one.
seed : int
    For ties.
time_limit : float or None
    After so many seconds the search stops.
most_steps : int or None
    After about so many steps of the fleet the search stops.

Returns
-------
tuple of (int, int32[T, R])
    How it ended (0: found, 1: proven that there is none, 2: stopped) and where every robot is
    after each step, the start included.

Raises
------
ValueError
    If the arrays do not fit together.

Notes
-----
Complete, deterministic for a seed, not optimal. The GIL is released; Ctrl-C is obeyed.)";

using Steps = std::tuple<int, TableOut<VertexId>>;

SearchEnd search(const Graph& graph, const UntimedProblem& goals, bool may_rotate,
                 std::uint32_t seed, const Deadline& deadline,
                 std::optional<std::int64_t> most_steps, std::vector<VertexId>& steps) {
    check(graph, goals);
    StepTables tables(graph);
    const SearchEnd reach = reach_all(goals, tables, deadline);
    if (reach != SearchEnd::found) {
        return reach;
    }
    UntimedLacam lacam(graph, goals, tables, may_rotate, seed);
    std::int64_t done = 0;
    const SearchEnd end = lacam.run([&] {
        done += UntimedLacam::steps_between_questions;
        return (most_steps && done > *most_steps) || deadline();
    });
    steps = lacam.steps();
    return end;
}

Steps untimed_lacam(const ArrayIn<EdgeId>& indptr, const ArrayIn<VertexId>& indices,
                    const ArrayIn<VertexId>& home, const ArrayIn<std::int32_t>& first_stage,
                    const ArrayIn<VertexId>& stage_vertex,
                    const ArrayIn<std::uint8_t>& ends_anywhere, bool may_rotate, std::uint32_t seed,
                    std::optional<double> time_limit, std::optional<std::int64_t> most_steps) {
    const UntimedProblem goals{view(home), view(first_stage), view(stage_vertex),
                               view(ends_anywhere)};
    const Deadline deadline(time_limit);
    SearchEnd end = SearchEnd::stopped;
    std::vector<VertexId> steps;
    {
        const nb::gil_scoped_release released;
        end = search({view(indptr), view(indices)}, goals, may_rotate, seed, deadline, most_steps,
                     steps);
    }
    const std::size_t n_steps = home.size() == 0 ? 0 : steps.size() / home.size();
    return {static_cast<int>(end),
            hand_over<TableOut<VertexId>>(std::move(steps), {n_steps, home.size()})};
}

}  // namespace

void bind_untimed_lacam(nb::module_& module) {
    module.def("untimed_lacam", &untimed_lacam, nb::arg("indptr").noconvert(),
               nb::arg("indices").noconvert(), nb::arg("home").noconvert(),
               nb::arg("first_stage").noconvert(), nb::arg("stage_vertex").noconvert(),
               nb::arg("ends_anywhere").noconvert(), nb::arg("may_rotate"), nb::arg("seed"),
               nb::arg("time_limit").none(), nb::arg("most_steps").none(), steps_doc);
}

}  // namespace rightofway::bind
