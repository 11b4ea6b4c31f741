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
problem : Problem
    What the fleet has to do.
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

Notes
-----
Deterministic for a seed as long as there is time, not optimal. A stage out of reach
is the only proof that there is no plan. The GIL is released; Ctrl-C is obeyed.)";

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
            retime(problem, tracks);  // once the tables of the search are gone
        }
    }
    return {static_cast<int>(end), to_numpy(std::move(tracks.first_visit)),
            to_numpy(std::move(tracks.vertex)), to_numpy(std::move(tracks.enter))};
}

}  // namespace

void bind_lacam(nb::module_& module) {
    module.def("plan_by_lacam", &plan_by_lacam, nb::arg("problem"), nb::arg("spreads"),
               nb::arg("seed"), nb::arg("most_effort"), nb::arg("time_limit").none(), plan_doc);
}

}  // namespace rightofway::bind
