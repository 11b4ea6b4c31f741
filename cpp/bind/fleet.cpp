#include <nanobind/stl/optional.h>
#include <nanobind/stl/tuple.h>

#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "bindings.hpp"
#include "lns/fleet_search.hpp"

namespace rightofway::bind {
namespace {

constexpr auto fleet_doc = R"(The tracks of a whole fleet: finding first ones, and better ones.

The seed decides all that is drawn; what `improve` finds does not depend on ``n_threads``. Robots
without a track are left where they are by `tracks`: an empty one. Ctrl-C leaves a plan as good as
before.

Parameters
----------
problem : Problem
    What the fleet has to do.
seed : int
    For all that is drawn.
n_threads : int
    Threads of `prioritize` and `improve`, 1 to 1024.
alone : int64[R] or None
    What `alone` returned for the same trips. [ticks]
objective : Objective
    What `improve` minimizes.
horizon : int or None
    Tracks may conflict after it; None: they never do. [ticks]

Raises
------
ValueError
    For an objective with a makespan where edges have surcharges, or a horizon outside 0..2^62.)";

constexpr auto alone_doc =
    R"(Return the least completion of each robot without the others, int64[R]. [ticks]

-1 for a robot that cannot get to a stage; None if time ran out.

Parameters
----------
time_limit : float or None
    When to stop; at once for 0 or less. [s])";

constexpr auto start_doc =
    R"(Take over tracks. A robot may have none: an empty track.

Parameters
----------
first_visit : int32[R + 1]
    Robot ``r`` has the visits ``first_visit[r] .. first_visit[r + 1] - 1``.
vertices, enter : int32[N], int64[N]
    Where and when each visit begins. [ticks]

Raises
------
ValueError
    If the others are no tracks of these trips, or overlap.)";

constexpr auto take_over_doc =
    R"(Start from tracks of an earlier plan, and return the robots that have no track now, int32[n].

A robot whose track serves its stages keeps it. The robots of ``order`` get new tracks one after
another, around all other tracks; until a robot has one, its earlier track stays booked.

Parameters
----------
first_visit : int32[R + 1]
    Robot ``r`` has the visits ``first_visit[r] .. first_visit[r + 1] - 1``.
vertices, enter : int32[N], int64[N]
    Where and when each visit begins. [ticks] Tracks may miss stages.
order : int32[n]
    The robots to plan, each once.
time_limit : float or None
    When to stop; at once for 0 or less. [s])";

constexpr auto prioritize_doc =
    R"(Give the robots tracks one after another, in this order; return whether all have one now.

`resume` may change a False.

Parameters
----------
order : int32[R]
    Every robot once.
n_searches : int
    The most searches before it gives up.
time_limit : float or None
    When to stop; at once for 0 or less. [s]
with_fallback : float or None
    When to stop instead once the hasty attempt has a plan. [s])";

constexpr auto restore_doc =
    R"(Give robots these tracks where that costs no more; return how many have theirs.

Every robot has a track. `improve` starts afresh.

Parameters
----------
first_visit : int32[R + 1]
    Robot ``r`` has the visits ``first_visit[r] .. first_visit[r + 1] - 1``.
vertices, enter : int32[N], int64[N]
    Where and when each visit begins. [ticks] None is empty.)";

constexpr auto repair_doc =
    R"(Give tracks to robots that have none, in this order; return whether all have one now.

Robots that have a track keep it, unless they are in the way: they lose it, and queue again.

Parameters
----------
order : int32[n]
    All robots without a track, each once.
n_searches : int
    The most searches before it gives up.
time_limit : float or None
    When to stop; at once for 0 or less. [s])";

constexpr auto move_doc =
    R"(Give all robots tracks on which one of them moves at a time; tell whether this was possible.

Parameters
----------
time_limit : float or None
    When to stop; at once for 0 or less. [s])";

constexpr auto compete_doc =
    R"(Plan robots one after another beside the present tracks; take a better plan over.

Return whether the attempt has ended; another call continues one that has not.

Parameters
----------
order : int32[R]
    Every robot once.
n_searches : int
    The most searches since its beginning.
time_limit : float or None
    When to stop; at once for 0 or less. [s])";

constexpr auto hurry_doc =
    R"(Plan robots greedily, one after another, and take the plan over if it is better.

Parameters
----------
order : int32[R]
    Every robot once.
n_searches : int
    The most searches before it gives up.
time_limit : float or None
    When to stop; at once for 0 or less. [s])";

constexpr auto resume_doc = R"(Continue a `prioritize` that returned False.

Parameters
----------
n_searches : int
    The most searches since its beginning.
time_limit : float or None
    When to stop; at once for 0 or less. [s])";

constexpr auto improve_doc =
    R"(Replace tracks by better ones, a few robots at a time; return how many times that was done.

Every robot has a track. A plan that is stuck becomes one of several, which are crossed with each
other. Ends when nothing can be better, too.

Parameters
----------
n_tasks : int
    The number of neighbourhoods to replan.
patience : int
    The most of them in a row without a gain.
time_limit : float or None
    When to stop at once. [s]
pause : float or None
    When to stop at the next point that does not depend on clocks. [s])";

constexpr auto retime_doc =
    R"(Have all robots as early as the order of visits at every vertex allows; `improve` starts afresh.)";

using TrackArrays = std::tuple<ArrayOut<std::int32_t>, ArrayOut<VertexId>, ArrayOut<Tick>>;

TrackArrays tracks(const FleetSearch& self) {
    Tracks all = self.tracks();
    return {to_numpy(std::move(all.first_visit)), to_numpy(std::move(all.vertex)),
            to_numpy(std::move(all.enter))};
}

void init_fleet(FleetSearch* self, const Problem& problem, std::uint64_t seed,
                std::size_t n_threads, const std::optional<ArrayIn<Tick>>& alone,
                Objective objective, std::optional<Tick> horizon) {
    new (self) FleetSearch(problem, seed, n_threads, objective, horizon.value_or(never));
    if (alone) {
        try {
            self->take_alone(view(*alone));
        } catch (...) {
            self->~FleetSearch();
            throw;
        }
    }
}

}  // namespace

void bind_fleet(nb::module_& module) {
    nb::enum_<Objective>(module, "Objective", "What large neighbourhood search minimizes.")
        .value("flowtime", Objective::flowtime, "The flowtime by weights, and surcharges.")
        .value("makespan", Objective::makespan, "The makespan; on ties the flowtime by weights.")
        .value("both", Objective::both, "Makespan plus completion, summed over robots by weights.");
    nb::class_<FleetSearch>(module, "FleetSearch", fleet_doc)
        .def("__init__", &init_fleet, nb::arg("problem"), nb::arg("seed"), nb::arg("n_threads"),
             nb::arg("alone").none() = nb::none(), nb::arg("objective") = Objective::flowtime,
             nb::arg("horizon").none() = nb::none(), nb::keep_alive<1, 2>())
        .def(
            "alone",
            [](FleetSearch& self,
               std::optional<double> time_limit) -> std::optional<ArrayOut<Tick>> {
                const Deadline deadline(time_limit);
                const std::vector<Tick>* alone = nullptr;
                {
                    const nb::gil_scoped_release released;
                    alone = self.alone(deadline);
                }
                if (alone == nullptr) {
                    return std::nullopt;
                }
                return to_numpy(std::span<const Tick>(*alone));
            },
            nb::arg("time_limit").none() = nb::none(), alone_doc)
        .def(
            "start",
            [](FleetSearch& self, const ArrayIn<std::int32_t>& first_visit,
               const ArrayIn<VertexId>& vertices, const ArrayIn<Tick>& enter) {
                const nb::gil_scoped_release released;
                self.start({view(first_visit), view(vertices), view(enter)});
            },
            array("first_visit"), array("vertices"), array("enter"), start_doc)
        .def(
            "take_over",
            [](FleetSearch& self, const ArrayIn<std::int32_t>& first_visit,
               const ArrayIn<VertexId>& vertices, const ArrayIn<Tick>& enter,
               const ArrayIn<RobotId>& order, std::optional<double> time_limit) {
                const Deadline deadline(time_limit);
                std::vector<RobotId> left;
                {
                    const nb::gil_scoped_release released;
                    left = self.take_over({view(first_visit), view(vertices), view(enter)},
                                          view(order), deadline);
                }
                return to_numpy(std::move(left));
            },
            array("first_visit"), array("vertices"), array("enter"), array("order"),
            nb::arg("time_limit").none(), take_over_doc)
        .def(
            "restore",
            [](FleetSearch& self, const ArrayIn<std::int32_t>& first_visit,
               const ArrayIn<VertexId>& vertices, const ArrayIn<Tick>& enter) {
                const Deadline interrupt(std::nullopt);
                const nb::gil_scoped_release released;
                return self.restore({view(first_visit), view(vertices), view(enter)}, interrupt);
            },
            array("first_visit"), array("vertices"), array("enter"), restore_doc)
        .def(
            "prioritize",
            [](FleetSearch& self, const ArrayIn<RobotId>& order, std::int64_t n_searches,
               std::optional<double> time_limit, std::optional<double> with_fallback) {
                const Deadline deadline(time_limit);
                const Deadline deadline_with_fallback(with_fallback, "with_fallback");
                const nb::gil_scoped_release released;
                return self.prioritize(view(order), n_searches, deadline, deadline_with_fallback);
            },
            array("order"), nb::arg("n_searches"), nb::arg("time_limit").none(),
            nb::arg("with_fallback").none(), prioritize_doc)
        .def(
            "compete",
            [](FleetSearch& self, const ArrayIn<RobotId>& order, std::int64_t n_searches,
               std::optional<double> time_limit) {
                const Deadline deadline(time_limit);
                const nb::gil_scoped_release released;
                return self.compete(view(order), n_searches, deadline);
            },
            array("order"), nb::arg("n_searches"), nb::arg("time_limit").none(), compete_doc)
        .def(
            "hurry",
            [](FleetSearch& self, const ArrayIn<RobotId>& order, std::int64_t n_searches,
               std::optional<double> time_limit) {
                const Deadline deadline(time_limit);
                const nb::gil_scoped_release released;
                self.hurry(view(order), n_searches, deadline);
            },
            array("order"), nb::arg("n_searches"), nb::arg("time_limit").none(), hurry_doc)
        .def(
            "repair",
            [](FleetSearch& self, const ArrayIn<RobotId>& order, std::int64_t n_searches,
               std::optional<double> time_limit) {
                const Deadline deadline(time_limit);
                const nb::gil_scoped_release released;
                return self.repair(view(order), n_searches, deadline);
            },
            array("order"), nb::arg("n_searches"), nb::arg("time_limit").none(), repair_doc)
        .def(
            "move_one_at_a_time",
            [](FleetSearch& self, std::optional<double> time_limit) {
                const Deadline deadline(time_limit);
                const nb::gil_scoped_release released;
                return self.move_one_at_a_time(deadline);
            },
            nb::arg("time_limit").none(), move_doc)
        .def(
            "resume",
            [](FleetSearch& self, std::int64_t n_searches, std::optional<double> time_limit) {
                const Deadline deadline(time_limit);
                const nb::gil_scoped_release released;
                return self.resume(n_searches, deadline, deadline);
            },
            nb::arg("n_searches"), nb::arg("time_limit").none(), resume_doc)
        .def(
            "improve",
            [](FleetSearch& self, std::int64_t n_tasks, std::int64_t patience,
               std::optional<double> time_limit, std::optional<double> pause) {
                const Deadline deadline(time_limit);
                const Deadline due(pause, "pause");
                const nb::gil_scoped_release released;
                return self.improve(n_tasks, patience, deadline, due);
            },
            nb::arg("n_tasks"), nb::arg("patience"), nb::arg("time_limit").none(),
            nb::arg("pause").none(), improve_doc)
        .def(
            "retime",
            [](FleetSearch& self) {
                const Deadline interrupt(std::nullopt);
                const nb::gil_scoped_release released;
                self.retime(interrupt);
            },
            retime_doc)
        .def("tracks", &tracks,
             R"(Return the tracks of all robots.

Returns
-------
tuple of (int32[R + 1], int32[N], int64[N])
    Which visits each robot has, and where and when they begin. [ticks])")
        .def_prop_ro("cost", &FleetSearch::cost, "The sum of completions and surcharges. [ticks]")
        .def_prop_ro("value", &FleetSearch::value, "What `improve` minimizes. [ticks]")
        .def_prop_ro("n_idle", &FleetSearch::n_idle, "How many times in a row brought no gain.")
        .def_prop_ro("n_expanded", &FleetSearch::n_expanded, "States expanded by `improve`.");
}

}  // namespace rightofway::bind
