#include "cyclic/simulator.hpp"

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

constexpr auto class_doc =
    R"(Robots that repeat their laps under a rule that sees two of them, until a state comes again.

Parameters
----------
first_place : int32[R + 1]
    Robot ``r`` has the places ``first_place[r]`` up to ``first_place[r + 1]`` of a lap.
vertex : int32[N]
    Where each place is; the first of a lap is home.
least : int64[N]
    The least ticks from the enter of a place to that of the next, round the lap.
approach : int64[N]
    How long before its enter a visit books its vertex. [ticks]
first_least : int64[R]
    The least ticks of the very first visit, which nobody turns for.
headway : int
    How long after its leave a visit books its vertex. [ticks]
pacemaker, lag : int
    Cuts are made where this robot is home; what meets less than the lag after that is settled
    before. [ticks]
most_lag, patience : int
    How long the lag may get, and how long a pacemaker may stay away. [ticks]
reach : int
    How long before a cut visits may have been left that still matter. [ticks]
memory : int
    How many cuts can be taken back.
rule : int
    Who goes first: who would enter the segment first (0), who is listed first (1), or (2) who would
    lose more by waiting for the other one.
loss : int64[R]
    What a tick of waiting costs each robot, above 0, with rule 2; else it is not looked at.

Raises
------
ValueError
    If the arrays do not fit together; the message names array, index and value.

Notes
-----
Exact and deterministic: the decisions of ``laps.rolling``. The GIL is released while it goes on;
Ctrl-C is obeyed.)";

constexpr auto go_on_doc = R"(Go on until a state comes again, a deadlock, or time is over.

Parameters
----------
time_limit : float or None
    After so many seconds it stops, and can go on later.

Returns
-------
int
    0 if time ran out, 1 if a state came again, 2 in a deadlock.)";

constexpr auto waits_doc = R"(Return which visits of a robot were late.

Returns
-------
tuple of (int32[K], int64[K])
    Their numbers, and how long the robot had waited by then in all. [ticks]

Raises
------
ValueError
    If there is no such robot.)";

constexpr auto deadlock_doc = R"(Return the deadlock that it ran into.

Returns
-------
tuple of (int, int, int, int, int32[K])
    The two robots that cannot be kept apart, the vertex, the tick, and the robots that would each
    wait for the next.)";

void init(CyclicSimulator* self, const ArrayIn<std::int32_t>& first_place,
          const ArrayIn<VertexId>& vertex, const ArrayIn<Tick>& least,
          const ArrayIn<Tick>& approach, const ArrayIn<Tick>& first_least, Tick headway,
          RobotId pacemaker, Tick lag, Tick most_lag, Tick patience, Tick reach,
          std::int32_t memory, std::int32_t rule, const ArrayIn<std::int64_t>& loss) {
    const LapArrays laps{view(first_place), view(vertex),      view(least),
                         view(approach),    view(first_least), headway};
    const Horizon pace{pacemaker, lag, most_lag, patience, reach, memory};
    require_id("rule", rule, n_cyclic_rules);
    std::vector<std::int64_t> losses(loss.data(), loss.data() + loss.size());
    const nb::gil_scoped_release released;
    new (self) CyclicSimulator(laps, pace, static_cast<CyclicRule>(rule), std::move(losses));
}

std::int32_t go_on(CyclicSimulator& self, std::optional<double> time_limit) {
    const Deadline deadline(time_limit);
    const nb::gil_scoped_release released;
    return static_cast<std::int32_t>(self.go_on(deadline));
}

ArrayOut<std::int32_t> begun(const CyclicSimulator& self) {
    std::vector<std::int32_t> counts;
    for (RobotId r = 0; r < self.n_robots(); ++r) {
        counts.push_back(self.waits().n_begun(r));
    }
    return to_numpy(std::move(counts));
}

std::tuple<ArrayOut<std::int32_t>, ArrayOut<Tick>> waits(const CyclicSimulator& self,
                                                         RobotId robot) {
    require_id("robot", robot, self.n_robots());
    return {to_numpy(self.waits().late(robot)), to_numpy(self.waits().waited(robot))};
}

std::tuple<RobotId, RobotId, VertexId, Tick, ArrayOut<RobotId>> deadlock(
    const CyclicSimulator& self) {
    const Conflict& conflict = self.deadlock();
    return {conflict.robot_a, conflict.robot_b, self.deadlock_at(), conflict.tick,
            to_numpy(self.circle())};
}

}  // namespace

void bind_simulator(nb::module_& module) {
    nb::class_<CyclicSimulator>(module, "CyclicSimulator", class_doc)
        .def("__init__", &init, nb::arg("first_place").noconvert(), nb::arg("vertex").noconvert(),
             nb::arg("least").noconvert(), nb::arg("approach").noconvert(),
             nb::arg("first_least").noconvert(), nb::kw_only(), nb::arg("headway"),
             nb::arg("pacemaker"), nb::arg("lag"), nb::arg("most_lag"), nb::arg("patience"),
             nb::arg("reach"), nb::arg("memory"), nb::arg("rule"), nb::arg("loss").noconvert())
        .def("go_on", &go_on, nb::arg("time_limit") = nb::none(), go_on_doc)
        .def("forget", &CyclicSimulator::forget,
             "Forget the states seen, so that it goes on where one came again.")
        .def(
            "follow",
            [](CyclicSimulator& self, std::int32_t rule) {
                require_id("rule", rule, n_cyclic_rules);
                self.follow(static_cast<CyclicRule>(rule));
            },
            nb::arg("rule"), "Decide by another rule from now on.")
        .def_prop_ro("cut", &CyclicSimulator::cut, "Up to when all is settled. [ticks]")
        .def_prop_ro("came_before", &CyclicSimulator::came_before,
                     "When the state that came again at the cut was there before. [ticks]")
        .def("begun", &begun, "Return how many visits of each robot have begun, int32[R].")
        .def("waits", &waits, nb::arg("robot"), waits_doc)
        .def("deadlock", &deadlock, deadlock_doc);
}

}  // namespace rightofway::bind
