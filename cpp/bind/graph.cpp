#include <nanobind/stl/optional.h>
#include <nanobind/stl/tuple.h>

#include <optional>
#include <tuple>
#include <vector>

#include "objects.hpp"
#include "precedence/precedence_graph.hpp"

namespace rightofway::bind {
namespace {

constexpr auto graph_doc =
    R"(Routes, rights of way, the timetable they give, and the conflicts left.

A conflict is a tuple ``(tick, kind, visit_a, visit_b)`` where the robot of ``visit_a`` is below
that of ``visit_b``. Kind 0: two bookings ``[enter - approach, leave + headway)`` of a vertex
overlap, from that tick on; it counts the overlap's ticks, at most ``CONFLICT_CAP``. Kind 1: two
robots exchange two vertices at that tick, without such an overlap; it counts 1.

Parameters
----------
rules : BookingRules
    How visits are booked.
routes : Routes
    The visits; the drives into first visits are 0 where robots book ahead.
swaps_conflict : bool
    Whether swaps are conflicts.
rows : VisitRows or None
    Where robots have sizes: what the visits book. Conflicts and rights of way are then between
    incompatible visits: ``precede(a, b)`` lets the drive into ``b`` start after ``a`` has ended,
    wherever both are.
closures : VisitClosures or None
    When the places of visits are closed: times are the earliest that keep clear of closures.)";

constexpr auto keep_order_doc =
    R"(Give the rights of way of all visits to a vertex in an order, all at once.

Returns whether that is possible; if not, nothing has changed. If so, there is no rollback below
this.

Parameters
----------
when : int64[N]
    Rises along each route: of two visits to one vertex the one with the smaller number goes first,
    of equal ones that with the smaller index.)";

constexpr auto precede_doc =
    R"(Give visit a the right of way over visit b, of two active robots at the same vertex.

Returns whether that is possible. If not, nothing has changed: ``a`` is a last visit, ``b`` is a
first visit, or ``cycle()`` has the deadlock or swap that would follow.

Parameters
----------
a, b : int
    The visits.)";

constexpr auto take_back_doc =
    R"(Take back the right of way of a over b, whenever it was given; return whether there was one.

Parameters
----------
a, b : int
    The visits.)";

constexpr auto cycle_doc =
    R"(Return the cycle that the last refused ``precede(a, b)`` would have closed, int32[n].

Visits in order, from ``b`` to the visit after ``a``; empty if there was another reason.)";

constexpr auto incompatible_doc =
    R"(Return all incompatible visits of two robots, int32[K, 4]; none where no robot has a size.

Visit of i, visit of j, and the visits whose starts count: i waits for j by
``precede(visit of j, start of i)``, j for i by ``precede(visit of i, start of j)``.

Parameters
----------
i, j : int
    The robots.)";

constexpr auto conflicts_of_doc =
    R"(Return the weight of one robot's conflicts with some others. [ticks]

Parameters
----------
robot : int
    The robot.
others : uint8[R]
    Not 0 for the others.)";

constexpr auto enter_of_doc = R"(Return the enter of a visit. [ticks]

Parameters
----------
visit : int
    The visit.)";

constexpr auto completion_doc = R"(Return the enter of a robot's last visit. [ticks]

Parameters
----------
robot : int
    The robot.)";

constexpr auto critical_rights_doc =
    R"(Return the rights of way ``(a, b)`` on a longest path to a robot's last visit, int32[K, 2].

Parameters
----------
robot : int
    The robot; the latest right of way comes first.)";

constexpr auto next_conflict_doc = R"(Return the earliest conflict, None if none is left.

Returns
-------
tuple of (int, int, int, int) or None
    Tick, kind, and the two visits.)";

constexpr auto next_conflict_between_doc =
    R"(Return the earliest conflict of two robots, None if they have none.

Parameters
----------
i, j : int
    Two different robots.

Returns
-------
tuple of (int, int, int, int) or None
    Tick, kind, and the two visits.)";

constexpr auto rollback_doc = R"(Undo all changes since a mark.

Parameters
----------
mark : int
    What `checkpoint` returned; ValueError if a rollback has gone below it.)";

constexpr auto withdraw_doc =
    R"(Make a robot inactive and take back its rights of way; there is no rollback below this.

Parameters
----------
robot : int
    The robot.)";

constexpr auto rights_of_doc =
    R"(Return the rights of way ``(a, b)`` of which one is a visit of a robot, int32[K, 2].

Parameters
----------
robot : int
    The robot.)";

using ConflictTuple = std::tuple<Tick, std::int32_t, VisitId, VisitId>;

std::optional<ConflictTuple> to_tuple(const std::optional<Conflict>& found) {
    if (!found) {
        return std::nullopt;
    }
    return ConflictTuple{found->tick, static_cast<std::int32_t>(found->kind), found->visit_a,
                         found->visit_b};
}

void init_graph(PrecedenceGraph* self, const BookingRules& rules, const BoundRoutes& routes,
                bool swaps_conflict, const BoundVisitRows* rows,
                const BoundVisitClosures* closures) {
    const std::vector<Tick> leasts = routes.leasts();
    const std::vector<Tick> approaches = routes.approaches(rules);
    const std::vector<std::uint8_t> active(std::max<std::size_t>(routes.first_visit.size(), 1) - 1,
                                           1);
    const RouteArrays arrays{view(routes.first_visit),
                             view(routes.vertex),
                             leasts,
                             approaches,
                             rules.headway,
                             swaps_conflict,
                             active,
                             BoundVisitRows::rows(rows),
                             BoundVisitClosures::closures(closures, routes)};
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
    graph.def("enter_of", &Graph::enter_of, nb::arg("visit"), enter_of_doc)
        .def(
            "enter", [](const Graph& self) { return to_numpy(self.enters()); },
            "Return a copy of the enters of all visits, int64[N]. [ticks]")
        .def("completion", &Graph::completion, nb::arg("robot"), completion_doc)
        .def("completion_sum", &Graph::completion_sum,
             "Return the sum of the enters of the last visits of active robots. [ticks]")
        .def(
            "critical_rights",
            [](const Graph& self, RobotId robot) { return pairs(self.critical_rights(robot)); },
            nb::arg("robot"), critical_rights_doc)
        .def(
            "incompatible",
            [](const Graph& self, RobotId i, RobotId j) {
                std::vector<VisitId> flat = self.incompatible(i, j);
                const std::size_t rows = flat.size() / 4;
                return hand_over<TableOut<VisitId>>(std::move(flat), {rows, 4});
            },
            nb::arg("i"), nb::arg("j"), incompatible_doc)
        .def("conflicts", &Graph::conflicts,
             "Return the weight of all conflicts left, 0 if there are none. [ticks]")
        .def(
            "conflicts_of",
            [](const Graph& self, RobotId robot, const ArrayIn<std::uint8_t>& others) {
                return self.conflicts_of(robot, view(others));
            },
            nb::arg("robot"), array("others"), conflicts_of_doc)
        .def(
            "next_conflict", [](Graph& self) { return to_tuple(self.next_conflict()); },
            next_conflict_doc)
        .def(
            "next_conflict_between",
            [](const Graph& self, RobotId i, RobotId j) {
                return to_tuple(self.next_conflict_between(i, j));
            },
            nb::arg("i"), nb::arg("j"), next_conflict_between_doc);
}

void bind_changes(nb::class_<PrecedenceGraph>& graph) {
    using Graph = PrecedenceGraph;
    graph.def("precede", &Graph::precede, nb::arg("a"), nb::arg("b"), precede_doc)
        .def(
            "cycle", [](const Graph& self) { return to_numpy(self.cycle()); }, cycle_doc)
        .def(
            "keep_order",
            [](Graph& self, const ArrayIn<Tick>& when) {
                const Deadline interrupt(std::nullopt);
                const nb::gil_scoped_release released;
                return self.keep_order(view(when), interrupt);
            },
            array("when"), keep_order_doc)
        .def("take_back", &Graph::take_back, nb::arg("a"), nb::arg("b"), take_back_doc)
        .def("checkpoint", &Graph::checkpoint,
             "Return a mark for ``rollback``: the number of rights of way given or taken back, and "
             "not undone since.")
        .def("rollback", &Graph::rollback, nb::arg("mark"), rollback_doc)
        .def("withdraw", &Graph::withdraw, nb::arg("robot"), withdraw_doc)
        .def(
            "rights_of",
            [](const Graph& self, RobotId robot) { return pairs(self.rights_of(robot)); },
            nb::arg("robot"), rights_of_doc)
        .def(
            "rights_of_way", [](const Graph& self) { return pairs(self.rights_of_way()); },
            "Return the rights of way ``(a, b)`` in the order they were given, int32[K, 2].");
}

}  // namespace

void bind_graph(nb::module_& module) {
    nb::class_<PrecedenceGraph> graph(module, "PrecedenceGraph", graph_doc);
    graph.def("__init__", &init_graph, nb::arg("rules"), nb::arg("routes"),
              nb::arg("swaps_conflict"), nb::arg("rows").none() = nb::none(),
              nb::arg("closures").none() = nb::none());
    bind_queries(graph);
    bind_changes(graph);
}

}  // namespace rightofway::bind
