#include "cyclic/simulator.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/tuple.h>

#include <algorithm>
#include <optional>
#include <tuple>
#include <vector>

#include "bindings.hpp"
#include "core/reject.hpp"

namespace rightofway::bind {
namespace {

constexpr auto class_doc =
    R"(Robots that repeat their laps under a rule that considers two of them, until a state recurs.

Parameters
----------
first_place : int32[R + 1]
    Robot ``r`` has the places ``first_place[r]`` up to ``first_place[r + 1]`` of a lap.
vertex : int32[N]
    The vertex of each place; the first place of a lap is home.
least : int64[N]
    The least ticks from the enter of a place to that of the next, round the lap.
approach : int64[N]
    How long before its enter a visit books its vertex. [ticks]
first_least : int64[R]
    The least ticks of the very first visit, in which no robot turns.
headway : int
    How long after its leave a visit books its vertex. [ticks]
pacemaker, lag : int
    Cuts are made where this robot is home; conflicts up to the lag (above 0) after a cut are
    resolved before all visits up to it are frozen. [ticks]
most_lag, patience : int
    The longest lag, and how long a pacemaker may stay away. [ticks]
reach : int
    Visits left so long before a cut still matter. [ticks]
memory : int
    How many cuts can be undone, above 0.
rule : int
    The robot that goes first: the one that would enter the segment first (0), the one listed first
    (1), or (2) the one that would lose more by waiting.
loss : int64[R]
    The cost of a tick of waiting for each robot, above 0, with rule 2; else unused.
vertex_row, edge_row : int32[N] or None
    Where robots have sizes: the rows of each place's vertex and of the edge driven out of it.
first, excluded : int32[M + 1], int32[K], or None
    A booking of row ``r`` excludes other robots from ``excluded[first[r]:first[r + 1]]``.

Raises
------
ValueError
    If the arrays do not fit together; the message names array, index and value.

Notes
-----
Exact and deterministic. The GIL is released by ``advance``; Ctrl-C is obeyed.)";

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

using Rows = std::optional<ArrayIn<std::int32_t>>;

void init(CyclicSimulator* self, const ArrayIn<std::int32_t>& first_place,
          const ArrayIn<VertexId>& vertex, const ArrayIn<Tick>& least,
          const ArrayIn<Tick>& approach, const ArrayIn<Tick>& first_least, Tick headway,
          RobotId pacemaker, Tick lag, Tick most_lag, Tick patience, Tick reach,
          std::int32_t memory, std::int32_t rule, const ArrayIn<std::int64_t>& loss,
          const Rows& vertex_row, const Rows& edge_row, const Rows& first, const Rows& excluded) {
    are_given("vertex_row, edge_row, first, excluded", vertex_row, edge_row, first, excluded);
    require_not_empty("first", first);
    const LapArrays laps{view(first_place),
                         view(vertex),
                         view(least),
                         view(approach),
                         view(first_least),
                         headway,
                         view_or_empty(vertex_row),
                         view_or_empty(edge_row),
                         view_or_empty(first),
                         view_or_empty(excluded)};
    const Horizon horizon{pacemaker, lag, most_lag, patience, reach, memory};
    require_id("rule", rule, n_cyclic_rules);
    std::vector<std::int64_t> losses(loss.data(), loss.data() + loss.size());
    const nb::gil_scoped_release released;
    new (self) CyclicSimulator(laps, horizon, static_cast<CyclicRule>(rule), std::move(losses));
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
    nb::class_<CyclicSimulator>(module, "CyclicSimulator", class_doc)
        .def("__init__", &init, array("first_place"), array("vertex"), array("least"),
             array("approach"), array("first_least"), nb::kw_only(), nb::arg("headway"),
             nb::arg("pacemaker"), nb::arg("lag"), nb::arg("most_lag"), nb::arg("patience"),
             nb::arg("reach"), nb::arg("memory"), nb::arg("rule"), array("loss"),
             array("vertex_row").none() = nb::none(), array("edge_row").none() = nb::none(),
             array("first").none() = nb::none(), array("excluded").none() = nb::none())
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
