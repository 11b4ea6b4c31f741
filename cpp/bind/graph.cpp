#include <nanobind/stl/optional.h>
#include <nanobind/stl/tuple.h>

#include <optional>
#include <tuple>

#include "bindings.hpp"
#include "precedence/precedence_graph.hpp"

namespace rightofway::bind {
namespace {

constexpr auto class_doc =
    R"(Routes, rights of way, the timetable they give, and the conflicts left.

Routes are fixed lists of visits. A right of way says which of two visits to one vertex goes
first. The timetable is the earliest times that keep both: ``enter`` is 0 on first visits, at
least ``enter[x] + least[x]`` on the visit after ``x``, and at least
``leave(a) + headway + approach[b]`` where ``a`` has the right of way over ``b``. ``leave(x)`` is
``enter[x + 1]``; a last visit never leaves.

A visit books its vertex for ``[enter - approach, leave + headway)``. Two bookings of one vertex by
different robots that overlap are a *vertex conflict* (kind 0); its tick is the start of the
overlap, and it counts the overlap's ticks, at most ``CONFLICT_CAP``. Two robots that exchange two
vertices at the same tick, without such an overlap at either, are a *swap conflict* (kind 1) at
that tick, which counts 1.

A conflict is a tuple ``(tick, kind, visit_a, visit_b)`` where the robot of ``visit_a`` is below
that of ``visit_b``; for a swap, these are the visits entered at that tick. Conflicts are ordered
by tick, then robots, then visits.

Parameters
----------
first_visit : int32[R + 1]
    Robot ``r`` owns visits ``first_visit[r] .. first_visit[r + 1] - 1``, at least one.
vertex : int32[N]
    The vertex of each visit; consecutive visits of a robot are at different vertices.
least : int64[N]
    Least time from this enter to the next, above 0; not used on last visits. [ticks]
approach : int64[N]
    How long before its enter a visit books its vertex; 0 on first visits. [ticks]
headway : int
    How long after its leave a visit still books its vertex. [ticks]
swaps_conflict : bool
    Whether swaps are conflicts.
active : uint8[R]
    Robots with 0 here have times, but no conflicts and no rights of way.

Raises
------
ValueError
    If the arrays do not describe routes; names the array, the index and the value. The methods
    raise it for a robot or a visit that does not exist.

Notes
-----
Deterministic. Every answer is kept up to date incrementally. Calls are short and keep the GIL.)";

constexpr auto keep_order_doc =
    R"(Give the rights of way of all visits to a vertex in an order, all at once.

Parameters
----------
when : int64[N]
    A number for each visit: of two visits to one vertex the one with the smaller number goes
    first, of equal ones that with the smaller index. Numbers rise along each route, and no visit
    has to wait for a leave with a greater number. The ticks of a plan, or steps.

Returns
-------
bool
    Whether that is possible. If not, nothing has changed. If so, there is no rollback below this.

Raises
------
ValueError
    If there is not one number for each visit, if numbers do not rise along a route, or if there
    were changes before.)";

constexpr auto precede_doc = R"(Give visit a the right of way over visit b.

Parameters
----------
a, b : int
    Visits of two different active robots to the same vertex.

Returns
-------
bool
    Whether that is possible. If not, nothing has changed: ``a`` is a last visit and never
    leaves, ``b`` is a first visit, or ``cycle()`` has the deadlock or swap that would follow.
    True if ``a`` has the right of way already.

Raises
------
ValueError
    If ``a`` and ``b`` are not two such visits.

Notes
-----
Times never decrease. A cycle of positive length is always refused; of zero length only if
``swaps_conflict`` and it is a swap of two robots, so rotations of three or more are possible.
Takes time in proportion (but for a logarithm) to the number of changed times.)";

constexpr auto take_back_doc = R"(Take back one right of way, whenever it was given.

Parameters
----------
a, b : int
    As for ``precede``.

Returns
-------
bool
    Whether ``a`` had the right of way over ``b``.

Raises
------
ValueError
    As for ``precede``.

Notes
-----
All visits get the earliest times that keep the other rights of way. A rollback gives it again.)";

constexpr auto cycle_doc =
    R"(Return the cycle that the last refused ``precede(a, b)`` would have closed.

Returns
-------
int32[n]
    Visits in order, from ``b`` to the visit after ``a``. The enter of each follows from that of
    the one before: the next visit of the same robot, or of a robot that waits for its leave.
    Empty if there was another reason, or no refusal yet.)";

constexpr auto conflicts_of_doc = R"(Return the weight of one robot's conflicts with others.

Parameters
----------
robot : int
    The robot.
others : uint8[R]
    Conflicts count with the robots that do not have 0 here.

Returns
-------
int
    Sum of what these conflicts count. [ticks]

Raises
------
ValueError
    If the robot does not exist or the mask has the wrong length.)";

using ConflictTuple = std::tuple<Tick, std::int32_t, VisitId, VisitId>;

std::optional<ConflictTuple> to_tuple(const std::optional<Conflict>& found) {
    if (!found) {
        return std::nullopt;
    }
    return ConflictTuple{found->tick, static_cast<std::int32_t>(found->kind), found->visit_a,
                         found->visit_b};
}

void init(PrecedenceGraph* self, const ArrayIn<VisitId>& first_visit,
          const ArrayIn<VertexId>& vertex, const ArrayIn<Tick>& least,
          const ArrayIn<Tick>& approach, Tick headway, bool swaps_conflict,
          const ArrayIn<std::uint8_t>& active) {
    const RouteArrays arrays{view(first_visit), view(vertex),   view(least), view(approach),
                             headway,           swaps_conflict, view(active)};
    const nb::gil_scoped_release released;
    new (self) PrecedenceGraph(arrays);
}

PairsOut<VisitId> pairs(const std::vector<RightOfWay>& rights) {
    std::vector<VisitId> flat;
    for (const RightOfWay& right : rights) {
        flat.insert(flat.end(), {right.first, right.second});
    }
    const std::size_t rows = flat.size() / 2;
    return hand_over<PairsOut<VisitId>>(std::move(flat), {rows, 2});
}

void bind_queries(nb::class_<PrecedenceGraph>& graph) {
    using Graph = PrecedenceGraph;
    graph
        .def("enter_of", &Graph::enter_of, nb::arg("visit"), "Return the enter of a visit. [ticks]")
        .def(
            "enter", [](const Graph& self) { return to_numpy(self.enters()); },
            "Return a copy of the enters of all visits, int64[N]. [ticks]")
        .def("completion", &Graph::completion, nb::arg("robot"),
             "Return the enter of a robot's last visit. [ticks]")
        .def("completion_sum", &Graph::completion_sum,
             "Return the sum of the enters of the last visits of active robots. [ticks]")
        .def(
            "critical_rights",
            [](const Graph& self, RobotId robot) { return pairs(self.critical_rights(robot)); },
            nb::arg("robot"),
            "Return the rights of way ``(a, b)`` on a longest path to the robot's last visit, the "
            "latest first, int32[K, 2].")
        .def("conflicts", &Graph::conflicts,
             "Return the weight of all conflicts left, 0 if there are none. [ticks]")
        .def(
            "conflicts_of",
            [](const Graph& self, RobotId robot, const ArrayIn<std::uint8_t>& others) {
                return self.conflicts_of(robot, view(others));
            },
            nb::arg("robot"), nb::arg("others").noconvert(), conflicts_of_doc)
        .def(
            "next_conflict", [](Graph& self) { return to_tuple(self.next_conflict()); },
            "Return the earliest conflict ``(tick, kind, visit_a, visit_b)``, None if none is "
            "left.")
        .def(
            "next_conflict_between",
            [](const Graph& self, RobotId i, RobotId j) {
                return to_tuple(self.next_conflict_between(i, j));
            },
            nb::arg("i"), nb::arg("j"),
            "Return the earliest conflict of two different robots, None if they have none.");
}

void bind_changes(nb::class_<PrecedenceGraph>& graph) {
    using Graph = PrecedenceGraph;
    graph.def("precede", &Graph::precede, nb::arg("a"), nb::arg("b"), precede_doc)
        .def(
            "cycle", [](const Graph& self) { return to_numpy(self.cycle()); }, cycle_doc)
        .def(
            "keep_order",
            [](Graph& self, const ArrayIn<Tick>& when) { return self.keep_order(view(when)); },
            nb::arg("when").noconvert(), keep_order_doc)
        .def("take_back", &Graph::take_back, nb::arg("a"), nb::arg("b"), take_back_doc)
        .def("checkpoint", &Graph::checkpoint,
             "Return a mark for ``rollback``: the number of rights of way given or taken back, and "
             "not undone since.")
        .def("rollback", &Graph::rollback, nb::arg("mark"),
             "Undo all changes since a mark (ValueError if a rollback has gone below it).")
        .def("withdraw", &Graph::withdraw, nb::arg("robot"),
             "Make a robot inactive and take back its rights of way; there is no rollback below "
             "this.")
        .def(
            "rights_of",
            [](const Graph& self, RobotId robot) { return pairs(self.rights_of(robot)); },
            nb::arg("robot"),
            "Return the rights of way ``(a, b)`` of which one is a visit of the robot, int32[K, "
            "2].")
        .def(
            "rights_of_way", [](const Graph& self) { return pairs(self.rights_of_way()); },
            "Return the rights of way ``(a, b)`` in the order they were given, int32[K, 2].");
}

}  // namespace

void bind_graph(nb::module_& module) {
    nb::class_<PrecedenceGraph> graph(module, "PrecedenceGraph", class_doc);
    graph.def("__init__", &init, nb::arg("first_visit").noconvert(), nb::arg("vertex").noconvert(),
              nb::arg("least").noconvert(), nb::arg("approach").noconvert(), nb::arg("headway"),
              nb::arg("swaps_conflict"), nb::arg("active").noconvert());
    bind_queries(graph);
    bind_changes(graph);
}

}  // namespace rightofway::bind
