// Cyclic routes: each robot repeats its lap endlessly.
//
// Visits of each robot are numbered from 0. Visit 0, at home before the first lap, is shorter than
// later visits to the home: it has no turn.
#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/excluded_rows.hpp"
#include "core/types.hpp"
#include "precedence/incompatible_visits.hpp"

namespace rightofway {

struct CyclicVisit {
    RobotId robot;
    std::int32_t number;

    CyclicVisit next() const { return {robot, number + 1}; }
    CyclicVisit before() const { return {robot, number - 1}; }
    auto operator<=>(const CyclicVisit&) const = default;
};

struct CyclicRight {
    CyclicVisit first;   // this visit leaves the vertex ...
    CyclicVisit second;  // ... before this one enters it
};

// Input of CyclicRoutes: n places of r laps. Borrowed, read once.
struct LapArrays {
    std::span<const std::int32_t> first_place;  // r + 1: lap k is first_place[k] .. [k + 1] - 1
    std::span<const VertexId> vertex;           // n
    std::span<const Tick> least;                // n: least ticks from enter to next enter, cyclic
    std::span<const Tick> approach;     // n: ticks from the start of the booking to the enter
    std::span<const Tick> first_least;  // r: of visit 0
    Tick headway = 0;                   // ticks from the leave to the end of the booking
    // The rows of each place's vertex and of the edge driven out of it (n each), and the lists of
    // excluded rows, see Resources in problem.hpp. Empty for points: their rows are vertices.
    std::span<const std::int32_t> vertex_row = {};
    std::span<const std::int32_t> edge_row = {};
    ExcludedRows lists = {};
};

// Two incompatible visits. `i_starts` and `j_starts` are the visits whose starts are the earliest
// incompatible ones: each is the visit itself, or the next one if only the edge driven out of the
// visit takes part.
struct IncompatiblePair {
    CyclicVisit i;
    CyclicVisit j;
    ExcludingBookings bookings;

    CyclicVisit i_starts() const { return bookings.own_is_later() ? i.next() : i; }
    CyclicVisit j_starts() const { return bookings.is_later() ? j.next() : j; }
};

class CyclicRoutes {
  public:
    // Throws std::invalid_argument, naming the array, the index and the value.
    explicit CyclicRoutes(const LapArrays& arrays);

    RobotId n_robots() const { return static_cast<RobotId>(first_least_.size()); }
    // The vertices that robots visit are numbered from 0, in the order of their ids.
    VertexId n_vertices() const { return static_cast<VertexId>(id_.size()); }
    std::int32_t length(RobotId robot) const {
        return first_place_[index(robot + 1)] - first_place_[index(robot)];
    }
    Tick headway() const { return headway_; }

    // Whether drives book edges: where lists of excluded rows are given.
    bool books_edges() const { return !lists_.is_identity(); }
    // One list of bookings for each row.
    std::int32_t n_rows() const { return books_edges() ? lists_.n_rows() : n_vertices(); }
    std::int32_t vertex_row(CyclicVisit visit) const {
        return books_edges() ? vertex_row_[index(place(visit))] : vertex(visit);
    }
    // `none` for points.
    std::int32_t edge_row(CyclicVisit visit) const {
        return books_edges() ? edge_row_[index(place(visit))] : none;
    }
    std::span<const std::int32_t> excluded(const std::int32_t& row) const { return lists_.of(row); }
    std::span<const std::int32_t> excluded(std::int32_t&&) const = delete;
    // No value if the visits are compatible. `i_leaves`, `j_leaves`: whether the edge driven out of
    // the visit counts.
    std::optional<IncompatiblePair> incompatible(CyclicVisit i, bool i_leaves, CyclicVisit j,
                                                 bool j_leaves) const;

    VertexId vertex(CyclicVisit visit) const { return vertex_[index(place(visit))]; }
    VertexId id_of(VertexId vertex) const { return id_[index(vertex)]; }
    Tick approach(CyclicVisit visit) const { return approach_[index(place(visit))]; }
    Tick gap_before(CyclicVisit visit) const { return headway_ + approach(visit); }
    Tick least(CyclicVisit visit) const {
        return visit.number == 0 ? first_least_[index(visit.robot)] : least_[index(place(visit))];
    }

    // The enter of a visit of a robot that never waits.
    Tick unimpeded_enter(CyclicVisit visit) const;
    // The least number of visits, from `visit` (not visit 0) on, that last `ticks` ticks. Throws
    // std::overflow_error if a window cannot hold as many.
    std::int32_t n_visits_in(CyclicVisit visit, Tick ticks) const;

    // For loops along one route, by place in the lap.
    std::span<const Tick> leasts(RobotId robot) const {
        return std::span(least_).subspan(index(first_place_[index(robot)]),
                                         static_cast<std::size_t>(length(robot)));
    }
    VertexId vertex_at(RobotId robot, std::int32_t place) const {
        return vertex_[index(first_place_[index(robot)] + place)];
    }
    Tick approach_at(RobotId robot, std::int32_t place) const {
        return approach_[index(first_place_[index(robot)] + place)];
    }
    std::int32_t place_in_lap(CyclicVisit visit) const {
        return visit.number % length(visit.robot);
    }

  private:
    std::int32_t place(CyclicVisit visit) const {
        return first_place_[index(visit.robot)] + place_in_lap(visit);
    }
    void check(RobotId robot) const;
    void check_rows() const;
    void number_vertices();
    bool excludes(std::int32_t row, std::int32_t other) const;

    std::vector<std::int32_t> first_place_;
    std::vector<VertexId> vertex_;
    std::vector<Tick> least_;
    std::vector<Tick> approach_;
    std::vector<Tick> first_least_;
    Tick headway_;
    std::vector<VertexId> id_;  // of each vertex
    std::vector<Tick> within_;  // length + 1 per lap: ticks from its start to each place
    std::vector<std::int32_t> vertex_row_;
    std::vector<std::int32_t> edge_row_;
    ExcludedRows lists_;
};

}  // namespace rightofway
