#include "lacam/lacam.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/tuple.h>

#include <limits>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "bindings.hpp"
#include "core/reject.hpp"
#include "precedence/retiming.hpp"

namespace rightofway::bind {
namespace {

constexpr auto plan_doc = R"(Plan a whole fleet with clocks, instant by instant.

Parameters
----------
problem : Problem
    What the fleet has to do.
ends_anywhere : uint8[R], or empty
    Whether a robot may end anywhere once its last stage is the next one; it only prefers that one.
spreads : bool
    Whether robots prefer paths that were spread before the search.
seed : int
    For ties.
most_effort : int or None
    When the search stops: a choice of a robot is a unit, and so is a decision that it takes again.
time_limit : float or None
    When to stop; at once for 0 or less. [s]

Returns
-------
tuple of (int, int32[R + 1], int32[N], int64[N])
    How it ended (0: found, 1: proven that there is none, since a stage cannot be reached or, for a
    fleet that moves in steps, since all steps were tried, 2: stopped), which visits each robot
    owns, and where and when each visit begins.)";

constexpr std::int64_t any_effort = std::numeric_limits<std::int64_t>::max();

using Plan = std::tuple<int, ArrayOut<VisitId>, ArrayOut<VertexId>, ArrayOut<Tick>>;

Plan plan_by_lacam(const Problem& problem, const ArrayIn<std::uint8_t>& ends_anywhere, bool spreads,
                   std::uint64_t seed, std::optional<std::int64_t> most_effort,
                   std::optional<double> time_limit) {
    if (ends_anywhere.size() > 0) {
        require_length("ends_anywhere", ends_anywhere.size(),
                       static_cast<std::size_t>(problem.n_robots()));
    }
    problem.refuse_times("LaCAM");
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
        Lacam lacam(problem, tables, paths, seed, view(ends_anywhere));
        const SearchEnd end = lacam.run(deadline, most_effort.value_or(any_effort));
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

}  // namespace

void bind_lacam(nb::module_& module) {
    module.def("plan_by_lacam", &plan_by_lacam, nb::arg("problem"), array("ends_anywhere"),
               nb::arg("spreads"), nb::arg("seed"), nb::arg("most_effort").none(),
               nb::arg("time_limit").none(), plan_doc);
}

}  // namespace rightofway::bind
