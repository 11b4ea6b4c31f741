#include "cyclic/simulator.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/tuple.h>

#include <algorithm>
#include <optional>
#include <tuple>
#include <vector>

#include "objects.hpp"

namespace rightofway::bind {
namespace {

constexpr auto simulator_doc =
    R"(Robots that repeat their laps under a rule that considers two of them, until a state recurs.

Parameters
----------
rules : BookingRules
    How visits are booked.
laps : Routes
    One lap of each robot; its first visit is at home, and the drive into it leads from the last.
first_least : int64[R]
    The least ticks of the very first visit, in which no robot turns.
horizon : Horizon
    Where cuts are made.
rule : int
    The robot that goes first: the one that would enter the segment first (0), the one listed first
    (1), or (2) the one that would lose more by waiting.
loss : int64[R]
    The cost of a tick of waiting for each robot, above 0, with rule 2; else unused.
rows : VisitRows or None
    Where robots have sizes: what the visits of a lap book.

Raises
------
ValueError
    If the arrays do not fit together; the message names array, index and value.

Notes
-----
Exact and deterministic. The GIL is released by ``advance``; Ctrl-C is obeyed.)";

constexpr auto horizon_doc =
    R"(Where a simulation cuts time.

Parameters
----------
pacemaker, lag : int
    Cuts are made where this robot is home; conflicts up to the lag (above 0) after a cut are
    resolved before all visits up to it are frozen. [ticks]
most_lag, patience : int
    The longest lag, and how long a pacemaker may stay away. [ticks]
reach : int
    Visits left so long before a cut still matter. [ticks]
memory : int
    How many cuts can be undone, above 0.)";

constexpr auto advance_doc =
    R"(Simulate until a state recurs (returns 1), a deadlock (2), or time is over (0; may be continued).

Parameters
----------
time_limit : float or None
    When to stop; at once for 0 or less. [s])";

constexpr auto waits_doc =
    R"(Return the visits of a robot that had to wait, and how long.

Parameters
----------
robot : int
    The robot.

Returns
-------
tuple of (int32[K], int64[K])
    The numbers of the visits, and how long the robot had waited by then in all. [ticks])";

constexpr auto deadlock_doc =
    R"(Return the conflict that cannot be resolved, after a deadlock.

Returns
-------
tuple of (int, int, int, int, int32[K])
    The two robots, the vertex, the tick (0 for a booking that would begin before the simulation),
    and the robots that would each wait for the next.)";

// The least ticks from each enter to the next one, round the lap.
std::vector<Tick> leasts_of(const BoundRoutes& laps) {
    std::vector<Tick> leasts = laps.leasts();
    const auto first = view(laps.first_visit);
    for (std::size_t r = 0; r + 1 < first.size(); ++r) {
        const auto begin = index(first[r]);
        const auto end = index(first[r + 1]);
        if (first[r] >= 0 && begin < end && end <= leasts.size()) {
            leasts[end - 1] = view(laps.dwell)[end - 1] + view(laps.drive)[begin];
        }
    }
    return leasts;
}

void init_simulator(CyclicSimulator* self, const BookingRules& rules, const BoundRoutes& laps,
                    const Ticks& first_least, const Horizon& horizon, std::int32_t rule,
                    const ArrayIn<std::int64_t>& loss, const BoundVisitRows* rows) {
    const std::vector<Tick> leasts = leasts_of(laps);
    const std::vector<Tick> approaches = laps.approaches(rules);
    const BookedRows booked = BoundVisitRows::rows(rows);
    const LapArrays arrays{
        view(laps.first_visit), view(laps.vertex), leasts,      approaches,  view(first_least),
        rules.headway,          booked.vertex,     booked.edge, booked.lists};
    require_id("rule", rule, n_cyclic_rules);
    std::vector<std::int64_t> losses(loss.data(), loss.data() + loss.size());
    const nb::gil_scoped_release released;
    new (self) CyclicSimulator(arrays, horizon, static_cast<CyclicRule>(rule), std::move(losses));
}

std::int32_t advance(CyclicSimulator& self, std::optional<double> time_limit) {
    const Deadline deadline(time_limit);
    const nb::gil_scoped_release released;
    return static_cast<std::int32_t>(self.advance(deadline));
}

void set_rule(CyclicSimulator& self, std::int32_t rule) {
    require_id("rule", rule, n_cyclic_rules);
    self.set_rule(static_cast<CyclicRule>(rule));
}

ArrayOut<std::int32_t> started(const CyclicSimulator& self) {
    std::vector<std::int32_t> counts;
    for (RobotId r = 0; r < self.n_robots(); ++r) {
        counts.push_back(self.visit_times().n_started(r));
    }
    return to_numpy(std::move(counts));
}

std::tuple<ArrayOut<std::int32_t>, ArrayOut<Tick>> waits(const CyclicSimulator& self,
                                                         RobotId robot) {
    require_id("robot", robot, self.n_robots());
    return {to_numpy(self.visit_times().late(robot)), to_numpy(self.visit_times().waited(robot))};
}

std::tuple<RobotId, RobotId, VertexId, Tick, ArrayOut<RobotId>> deadlock(
    const CyclicSimulator& self) {
    if (self.end() != CyclicSimulator::End::deadlock) {
        throw std::invalid_argument("deadlock: the latest advance() did not end in one");
    }
    const Conflict& conflict = self.deadlock();
    return {conflict.robot_a, conflict.robot_b, self.deadlock_at(),
            std::max(conflict.tick, Tick{0}), to_numpy(self.waiting_cycle())};
}

}  // namespace

void bind_simulator(nb::module_& module) {
    nb::class_<Horizon>(module, "Horizon", horizon_doc)
        .def(nb::init<RobotId, Tick, Tick, Tick, Tick, std::int32_t>(), nb::kw_only(),
             nb::arg("pacemaker"), nb::arg("lag"), nb::arg("most_lag"), nb::arg("patience"),
             nb::arg("reach"), nb::arg("memory"));
    nb::class_<CyclicSimulator>(module, "CyclicSimulator", simulator_doc)
        .def("__init__", &init_simulator, nb::arg("rules"), nb::arg("laps"), array("first_least"),
             nb::arg("horizon"), nb::arg("rule"), array("loss"),
             nb::arg("rows").none() = nb::none(), nb::keep_alive<1, 8>())
        .def("advance", &advance, nb::arg("time_limit") = nb::none(), advance_doc)
        .def("reset_states", &CyclicSimulator::reset_states,
             "Forget the states seen, to advance beyond one that has recurred.")
        .def("set_rule", &set_rule, nb::arg("rule"), R"(Decide by another rule from now on.

Parameters
----------
rule : int
    As for the class.)")
        .def_prop_ro("cut", &CyclicSimulator::cut,
                     "All conflicts before this tick are resolved. [ticks]")
        .def_prop_ro("first_seen", &CyclicSimulator::first_seen,
                     "When the state that has recurred at the cut was seen first. [ticks]")
        .def("started", &started, "Return how many visits of each robot have started, int32[R].")
        .def("waits", &waits, nb::arg("robot"), waits_doc)
        .def("deadlock", &deadlock, deadlock_doc);
}

}  // namespace rightofway::bind
