#include "lacam/pibt.hpp"

#include <nanobind/stl/optional.h>

#include <optional>
#include <string>
#include <vector>

#include "bindings.hpp"
#include "core/reject.hpp"

namespace rightofway::bind {
namespace {

constexpr auto class_doc =
    R"(A fleet with clocks whose free robots choose where to go, one instant after another.

`plan_by_events` does this by itself; here a test can look at each instant.

Parameters
----------
indptr, indices, edge_class, home, first_stage, stage_vertex, stage_dwell, class_ticks, headway, \
books_ahead, may_rotate, seed
    As for `plan_by_events`.)";

constexpr auto choose_doc = R"(Let robots choose in an order.

Parameters
----------
order : int32[N]
    Robots that are neither busy nor at the end of their trips.
fixed : int32[F, 2]
    Robots that are told where to go, each with the vertex.

Returns
-------
int64[M, 3] or None
    The moves: robot, vertex, arrival [ticks]; None where that does not work out.

Raises
------
ValueError
    If a robot is busy, or told to go where no edge leads.)";

class Instants {
  public:
    using MovesOut = nb::ndarray<nb::numpy, Tick, nb::shape<-1, 3>>;
    using PairsIn =
        nb::ndarray<const std::int32_t, nb::shape<-1, 2>, nb::c_contig, nb::device::cpu>;

    Instants(const ArrayIn<EdgeId>& indptr, const ArrayIn<VertexId>& indices,
             const ArrayIn<std::int32_t>& edge_class, const ArrayIn<VertexId>& home,
             const ArrayIn<std::int32_t>& first_stage, const ArrayIn<VertexId>& stage_vertex,
             const ArrayIn<Tick>& stage_dwell, const ArrayIn<std::int32_t>& class_ticks,
             Tick headway, bool books_ahead, bool may_rotate, std::uint64_t seed)
        : trips_{{view(indptr), view(indices)},
                 view(edge_class),
                 view(home),
                 view(first_stage),
                 view(stage_vertex),
                 view(stage_dwell),
                 view(class_ticks),
                 headway,
                 books_ahead,
                 may_rotate},
          tables_((check(trips_), trips_.graph)),
          paths_(trips_, tables_),
          pibt_(trips_, tables_, paths_, seed),
          state_(trips_) {}

    Instants(const Instants&) = delete;
    Instants& operator=(const Instants&) = delete;

    Tick now() const { return state_.now(); }

    ArrayOut<RobotId> undecided() const { return to_numpy(state_.undecided()); }

    std::optional<MovesOut> choose(const ArrayIn<RobotId>& order, const PairsIn& fixed) {
        for (std::size_t k = 0; k < order.size(); ++k) {
            require_free("order", k, order.data()[k]);
        }
        for (std::size_t k = 0; k < fixed.shape(0); ++k) {
            require_fixed(k, fixed.data()[2 * k], fixed.data()[2 * k + 1]);
        }
        for (std::size_t k = 0; k < fixed.shape(0); ++k) {
            pibt_.fix(fixed.data()[2 * k], fixed.data()[2 * k + 1]);
        }
        if (!pibt_.choose(state_, view(order))) {
            return std::nullopt;
        }
        std::vector<Tick> moves;
        for (const Decision& move : pibt_.decisions()) {
            moves.insert(moves.end(), {move.robot, move.vertex, move.arrival});
        }
        const std::size_t n_moves = moves.size() / 3;
        return hand_over<MovesOut>(std::move(moves), {n_moves, 3});
    }

    bool go_on() {
        for (const Decision& move : pibt_.decisions()) {
            state_.decide(move);
        }
        return state_.advance();
    }

  private:
    void require_free(const std::string& array, std::size_t k, RobotId robot) const {
        require_id(array + "[" + std::to_string(k) + "]", robot, trips_.n_robots());
        if (state_.is_busy(robot)) {
            reject_entry(array, k, robot, "is busy");
        }
    }

    void require_fixed(std::size_t k, RobotId robot, VertexId vertex) const {
        require_free("fixed", k, robot);
        const VertexId here = state_.at(robot);
        if (vertex != here && trips_.graph.edge(here, vertex) < 0) {
            reject_entry("fixed", k, vertex, "is not next to the robot");
        }
    }

    const Trips trips_;
    StepTables tables_;
    SpaceUtilization paths_;
    Pibt pibt_;
    FleetState state_;
};

}  // namespace

void bind_pibt(nb::module_& module) {
    using In = ArrayIn<std::int32_t>;
    nb::class_<Instants>(module, "Instants", class_doc)
        .def(nb::init<const In&, const In&, const In&, const In&, const In&, const In&,
                      const ArrayIn<Tick>&, const In&, Tick, bool, bool, std::uint64_t>(),
             nb::arg("indptr").noconvert(), nb::arg("indices").noconvert(),
             nb::arg("edge_class").noconvert(), nb::arg("home").noconvert(),
             nb::arg("first_stage").noconvert(), nb::arg("stage_vertex").noconvert(),
             nb::arg("stage_dwell").noconvert(), nb::arg("class_ticks").noconvert(),
             nb::arg("headway"), nb::arg("books_ahead"), nb::arg("may_rotate"), nb::arg("seed"),
             nb::keep_alive<1, 2>(), nb::keep_alive<1, 3>(), nb::keep_alive<1, 4>(),
             nb::keep_alive<1, 5>(), nb::keep_alive<1, 6>(), nb::keep_alive<1, 7>(),
             nb::keep_alive<1, 8>(), nb::keep_alive<1, 9>())
        .def_prop_ro("now", &Instants::now, "The time on the clock. [ticks]")
        .def("undecided", &Instants::undecided, "Return the robots that may choose.")
        .def("choose", &Instants::choose, nb::arg("order").noconvert(),
             nb::arg("fixed").noconvert(), choose_doc)
        .def("go_on", &Instants::go_on,
             "Take the moves chosen last, and go on to the next instant at which a robot finishes\n"
             "something; False if nobody is busy.");
}

}  // namespace rightofway::bind
