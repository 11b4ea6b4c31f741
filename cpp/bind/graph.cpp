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

A conflict is a tuple ``(tick, kind, visit_a, visit_b)`` where the robot of ``visit_a`` is below
that of ``visit_b``. Kind 0: two bookings ``[enter - approach, leave + headway)`` of a vertex
overlap, from that tick on; it counts the overlap's ticks, at most ``CONFLICT_CAP``. Kind 1: two
robots exchange two vertices at that tick, without such an overlap; it counts 1.

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
vertex_row, edge_row : int32[N] or None
    Where robots have sizes: the rows of ``Problem`` that each visit books, at its vertex and along
    the edge driven out of it; -1 for the edge of last visits.
first, excluded : int32[S + 1], int32[M] or None
    A booking of row ``r`` excludes others from the rows ``excluded[first[r]] ..``. Conflicts and
    rights of way are then between incompatible visits: ``precede(a, b)`` lets the drive into ``b``
    start after ``a`` has ended, wherever both are.
first_closed, closed_from, closed_until : int32[2 N + 1], int64[K], int64[K] or None
    When the vertex of visit ``x`` is closed: entries ``first_closed[2 x] ..``; and the edge driven
    into it: ``first_closed[2 x + 1] ..``. Times are the earliest that keep clear of closures.
    [ticks]
drive : int64[N] or None
    Ticks of the drive into each visit, with closures. [ticks])";

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

void init(PrecedenceGraph* self, const ArrayIn<VisitId>& first_visit,
          const ArrayIn<VertexId>& vertex, const ArrayIn<Tick>& least,
          const ArrayIn<Tick>& approach, Tick headway, bool swaps_conflict,
          const ArrayIn<std::uint8_t>& active,
          const std::optional<ArrayIn<std::int32_t>>& vertex_row,
          const std::optional<ArrayIn<std::int32_t>>& edge_row,
          const std::optional<ArrayIn<std::int32_t>>& first,
          const std::optional<ArrayIn<std::int32_t>>& excluded,
          const std::optional<ArrayIn<std::int32_t>>& first_closed,
          const std::optional<ArrayIn<Tick>>& closed_from,
          const std::optional<ArrayIn<Tick>>& closed_until,
          const std::optional<ArrayIn<Tick>>& drive) {
    are_given("vertex_row, edge_row, first, excluded", vertex_row, edge_row, first, excluded);
    are_given("first_closed, closed_from, closed_until, drive", first_closed, closed_from,
              closed_until, drive);
    require_not_empty("first", first);
    require_not_empty("first_closed", first_closed);
    const RouteArrays arrays{view(first_visit),
                             view(vertex),
                             view(least),
                             view(approach),
                             headway,
                             swaps_conflict,
                             view(active),
                             {view_or_empty(vertex_row), view_or_empty(edge_row),
                              view_or_empty(first), view_or_empty(excluded)},
                             {view_or_empty(first_closed), view_or_empty(closed_from),
                              view_or_empty(closed_until), view_or_empty(drive)}};
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
    nb::class_<PrecedenceGraph> graph(module, "PrecedenceGraph", class_doc);
    graph.def("__init__", &init, array("first_visit"), array("vertex"), array("least"),
              array("approach"), nb::arg("headway"), nb::arg("swaps_conflict"), array("active"),
              array("vertex_row").none() = nb::none(), array("edge_row").none() = nb::none(),
              array("first").none() = nb::none(), array("excluded").none() = nb::none(),
              array("first_closed").none() = nb::none(), array("closed_from").none() = nb::none(),
              array("closed_until").none() = nb::none(), array("drive").none() = nb::none());
    bind_queries(graph);
    bind_changes(graph);
}

}  // namespace rightofway::bind
