#include "problem/problem.hpp"

#include <nanobind/stl/optional.h>

#include <optional>

#include "bindings.hpp"
#include "core/reject.hpp"

namespace rightofway::bind {
namespace {

constexpr auto class_doc = R"(A scenario in ticks: roads, robots and booking rules.

Immutable; searches are given one. The arrays are not copied: they must not change.

Parameters
----------
indptr, heads : int32[V + 1], int32[E]
    The directed graph in compressed rows: the edges that leave vertex ``v`` are
    ``indptr[v] .. indptr[v + 1] - 1``, and edge ``e`` ends at ``heads[e]``.
length_class : int32[E]
    The length class of each edge.
paces : int32[P * C]
    Ticks for an edge of each of the C length classes, one row for each pace; -1 where it is barred.
pace_of : int32[R]
    The pace of each robot.
home : int32[R]
    Where each robot is at tick 0.
first_stage : int32[R + 1]
    Robot ``r`` owns stages ``first_stage[r] .. first_stage[r + 1] - 1``, at least one; it stays at
    the last one.
stage_vertex, stage_work, stage_turn : int32[S], int64[S], int64[S]
    Where each stage is, and how long it takes to work and then to turn. [ticks]
n_classes : int
    C.
headway : int
    How long a vertex stays booked after it was left. [ticks]
books_ahead : bool
    Whether a vertex is booked from when a robot starts to drive there.
rotations : bool
    Whether three or more robots may move round a circle at one instant, where bookings allow it.
size_of, first, excluded : int32[R], int32[rows + 1], int32[n]
    Size class of each robot, and for each row the rows from which a booking of it excludes other
    robots; None where no robot has a size. Row ``size * (V + E) + resource`` is a vertex or an
    edge as robots of one size class book it; the vertices come first.
turn_offset, turn_kind, turn_class, turn_ticks : int64[E], int32[n], int32[R], int32[T * K]
    How long robots turn on the spot; None where turning takes no time. The angle from edge ``e`` to
    edge ``f`` is of kind ``turn_kind[turn_offset[e] + f]``; a robot of turning class t turns it in
    ``turn_ticks[t * K + kind]`` ticks, and in no time where its class is -1.
n_turn_kinds : int
    K.
surcharges : int64[C]
    What an edge of each length class adds to costs, not to durations; None where all are 0. [ticks]
closed_row, closed_from, closed_until : int32[K], int64[K], int64[K]
    Rows of the booking table that are closed, and when; None without closures. Where no robot has
    a size, row ``V + e`` is edge ``e``. [ticks]

Raises
------
ValueError
    If the arrays do not fit together; names the array, the index and the value.)";

using Ints = ArrayIn<std::int32_t>;
using Ticks = ArrayIn<Tick>;

void init(Problem* self, const Ints& indptr, const Ints& heads, const Ints& length_class,
          const Ints& paces, const Ints& pace_of, const Ints& home, const Ints& first_stage,
          const Ints& stage_vertex, const Ticks& stage_work, const Ticks& stage_turn,
          std::int32_t n_classes, Tick headway, bool books_ahead, bool rotations,
          const std::optional<Ints>& size_of, const std::optional<Ints>& first,
          const std::optional<Ints>& excluded, const std::optional<Ticks>& turn_offset,
          const std::optional<Ints>& turn_kind, const std::optional<Ints>& turn_class,
          const std::optional<Ints>& turn_ticks, std::int32_t n_turn_kinds,
          const std::optional<Ticks>& surcharges, const std::optional<Ints>& closed_row,
          const std::optional<Ticks>& closed_from, const std::optional<Ticks>& closed_until) {
    const ProblemArrays arrays{view(indptr),      view(heads),        view(length_class),
                               view(paces),       view(pace_of),      view(home),
                               view(first_stage), view(stage_vertex), view(stage_work),
                               view(stage_turn),  n_classes,          view_or_empty(surcharges)};
    Resources resources;
    if (are_given("size_of, first, excluded", size_of, first, excluded)) {
        require_not_empty("first", first);
        resources = {view(*size_of), view(*first), view(*excluded)};
    }
    are_given("closed_row, closed_from, closed_until", closed_row, closed_from, closed_until);
    if (surcharges) {
        require_length("surcharges", surcharges->size(), static_cast<std::size_t>(n_classes));
    }
    const Closures closures{view_or_empty(closed_row), view_or_empty(closed_from),
                            view_or_empty(closed_until)};
    TurnArrays turns;
    if (are_given("turn_offset, turn_kind, turn_class, turn_ticks", turn_offset, turn_kind,
                  turn_class, turn_ticks)) {
        require_length("turn_class", turn_class->size(), home.size());
        turns = {view(*turn_offset), view(*turn_kind), view(*turn_class), view(*turn_ticks),
                 n_turn_kinds};
    }
    new (self) Problem(arrays, {headway, books_ahead, rotations}, resources, turns, closures);
}

}  // namespace

void bind_problem(nb::module_& module) {
    nb::class_<Problem>(module, "Problem", class_doc)
        .def("__init__", &init, array("indptr"), array("heads"), array("length_class"),
             array("paces"), array("pace_of"), array("home"), array("first_stage"),
             array("stage_vertex"), array("stage_work"), array("stage_turn"), nb::arg("n_classes"),
             nb::arg("headway"), nb::arg("books_ahead"), nb::arg("rotations"),
             array("size_of").none() = nb::none(), array("first").none() = nb::none(),
             array("excluded").none() = nb::none(), array("turn_offset").none() = nb::none(),
             array("turn_kind").none() = nb::none(), array("turn_class").none() = nb::none(),
             array("turn_ticks").none() = nb::none(), nb::arg("n_turn_kinds") = 0,
             array("surcharges").none() = nb::none(), array("closed_row").none() = nb::none(),
             array("closed_from").none() = nb::none(), array("closed_until").none() = nb::none(),
             nb::keep_alive<1, 2>(), nb::keep_alive<1, 3>(), nb::keep_alive<1, 4>(),
             nb::keep_alive<1, 5>(), nb::keep_alive<1, 6>(), nb::keep_alive<1, 7>(),
             nb::keep_alive<1, 8>(), nb::keep_alive<1, 9>(), nb::keep_alive<1, 10>(),
             nb::keep_alive<1, 11>(), nb::keep_alive<1, 16>(), nb::keep_alive<1, 17>(),
             nb::keep_alive<1, 18>(), nb::keep_alive<1, 19>(), nb::keep_alive<1, 20>(),
             nb::keep_alive<1, 21>(), nb::keep_alive<1, 22>(), nb::keep_alive<1, 24>(),
             nb::keep_alive<1, 25>(), nb::keep_alive<1, 26>(), nb::keep_alive<1, 27>())
        .def_prop_ro("n_robots", &Problem::n_robots, "The number of robots, R.")
        .def_prop_ro("n_vertices", &Problem::n_vertices, "The number of vertices, V.");
}

}  // namespace rightofway::bind
