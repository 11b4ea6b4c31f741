#include "lacam/lacam.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/tuple.h>

#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "bindings.hpp"
#include "core/reject.hpp"
#include "lacam/untimed_lacam.hpp"
#include "precedence/timetable.hpp"

namespace rightofway::bind {
namespace {

constexpr auto plan_doc = R"(Plan a whole fleet with clocks, instant by instant.

Parameters
----------
problem : Problem
    What the fleet has to do.
spreads : bool
    Whether robots prefer paths that were spread before the search.
seed : int
    For ties.
most_effort : int
    When the search stops: a choice of a robot is a unit, and so is a decision that it takes again.
time_limit : float or None
    When to stop; at once for 0 or less. [s]

Returns
-------
tuple of (int, int32[R + 1], int32[N], int64[N])
    How it ended (0: found, 1: a stage cannot be reached, 2: stopped), which visits each robot owns,
    and where and when each visit begins.)";

using Plan = std::tuple<int, ArrayOut<VisitId>, ArrayOut<VertexId>, ArrayOut<Tick>>;

Plan plan_by_lacam(const Problem& problem, bool spreads, std::uint64_t seed,
                   std::int64_t most_effort, std::optional<double> time_limit) {
    const Deadline deadline(time_limit);
    Tracks tracks;
    const auto search = [&] {
        StepTables tables(problem.graph());
        const SearchEnd reach = reach_all(problem, tables, deadline);
        if (reach != SearchEnd::found) {
            return reach;
        }
        SpaceUtilization paths(problem, tables);
        if (spreads && !paths.choose(deadline)) {
            return SearchEnd::stopped;
        }
        Lacam lacam(problem, tables, paths, seed);
        const SearchEnd end = lacam.run(deadline, most_effort);
        tracks = lacam.tracks();
        return end;
    };
    SearchEnd end = SearchEnd::stopped;
    {
        const nb::gil_scoped_release released;
        end = search();
        if (end == SearchEnd::found) {
            retime(problem, tracks, deadline);  // once the tables of the search are gone
        }
    }
    return {static_cast<int>(end), to_numpy(std::move(tracks.first_visit)),
            to_numpy(std::move(tracks.vertex)), to_numpy(std::move(tracks.enter))};
}

constexpr auto steps_doc =
    R"(Find steps for the whole fleet that bring every robot through its stages.

Time plays no part: in a step each robot stays or moves to a neighbour, no two are at one vertex and
no two change places.

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
    When to stop; at once for 0 or less. [s]

Returns
-------
tuple of (int, int32[T, R])
    How it ended (0: found, 1: proven that there is none, 2: stopped) and where every robot is
    after each step, the start included.)";

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
            end = most_steps ? lacam.run(deadline, *most_steps) : lacam.run(deadline);
            steps = lacam.steps();
        }
    }
    const std::size_t n_steps = n_robots == 0 ? 0 : steps.size() / n_robots;
    return {static_cast<int>(end),
            hand_over<TableOut<VertexId>>(std::move(steps), {n_steps, n_robots})};
}

}  // namespace

void bind_lacam(nb::module_& module) {
    module.def("plan_by_lacam", &plan_by_lacam, nb::arg("problem"), nb::arg("spreads"),
               nb::arg("seed"), nb::arg("most_effort"), nb::arg("time_limit").none(), plan_doc);
    module.def("untimed_lacam", &untimed_lacam, nb::arg("problem"), array("ends_anywhere"),
               nb::arg("seed"), nb::arg("most_steps").none(), nb::arg("time_limit").none(),
               steps_doc);
}

}  // namespace rightofway::bind
