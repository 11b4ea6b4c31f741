#include "lacam/untimed_lacam.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/tuple.h>

#include <optional>
#include <tuple>
#include <vector>

#include "bindings.hpp"
#include "core/reject.hpp"
#include "deadline.hpp"

namespace rightofway::bind {
namespace {

constexpr auto steps_doc =
    R"(Find steps for the whole fleet that bring every robot through its stages.

Time plays no part: in a step each robot stays or moves to a neighbour, no two are at one vertex and
no two change places. Times follow from the routes and the order of visits at each vertex.

Parameters
----------
problem : Problem
    What the fleet has to do.
ends_anywhere : uint8[R], or empty
    Whether a robot may end anywhere once its last stage is the next one; it only prefers that one.
seed : int
    For ties.
most_steps : int or None
    After about so many steps of the fleet the search stops.
time_limit : float or None
    After so many seconds the search stops.

Returns
-------
tuple of (int, int32[T, R])
    How it ended (0: found, 1: proven that there is none, 2: stopped) and where every robot is
    after each step, the start included.

Notes
-----
Complete, deterministic for a seed, not optimal. The GIL is released; Ctrl-C is obeyed.)";

using Steps = std::tuple<int, TableOut<VertexId>>;

Steps untimed_lacam(const Problem& problem, const ArrayIn<std::uint8_t>& ends_anywhere,
                    std::uint32_t seed, std::optional<std::int64_t> most_steps,
                    std::optional<double> time_limit) {
    const auto n_robots = static_cast<std::size_t>(problem.n_robots());
    if (ends_anywhere.size() > 0) {
        require_length("ends_anywhere", ends_anywhere.size(), n_robots);
    }
    const Deadline deadline(time_limit);
    SearchEnd end = SearchEnd::stopped;
    std::vector<VertexId> steps;
    {
        const nb::gil_scoped_release released;
        StepTables tables(problem.graph());
        end = reach_all(problem, tables, deadline);
        if (end == SearchEnd::found) {
            UntimedLacam lacam(problem, tables, seed, view(ends_anywhere));
            std::int64_t done = 0;
            end = lacam.run([&] {
                done += UntimedLacam::steps_between_questions;
                return (most_steps && done > *most_steps) || deadline();
            });
            steps = lacam.steps();
        }
    }
    const std::size_t n_steps = n_robots == 0 ? 0 : steps.size() / n_robots;
    return {static_cast<int>(end),
            hand_over<TableOut<VertexId>>(std::move(steps), {n_steps, n_robots})};
}

}  // namespace

void bind_untimed_lacam(nb::module_& module) {
    module.def("untimed_lacam", &untimed_lacam, nb::arg("problem"),
               nb::arg("ends_anywhere").noconvert(), nb::arg("seed"), nb::arg("most_steps").none(),
               nb::arg("time_limit").none(), steps_doc);
}

}  // namespace rightofway::bind
