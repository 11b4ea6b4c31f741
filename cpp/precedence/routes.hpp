// The routes of a fleet: one fixed list of visits per robot, robot by robot in flat arrays.
//
// Routes never change; rights of way and times are stored elsewhere and refer to visits by index.
// The constructor checks all input.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/types.hpp"
#include "precedence/incompatible_visits.hpp"
#include "precedence/visit_closures.hpp"

namespace rightofway {

// Input of Routes: n visits of r robots. Borrowed, read once.
struct RouteArrays {
    std::span<const VisitId> first_visit;  // r + 1: robot k owns first_visit[k] .. [k + 1] - 1
    std::span<const VertexId> vertex;      // n: differs between consecutive visits of a robot
    std::span<const Tick> least;     // n: least ticks from enter to next enter; last visits: unused
    std::span<const Tick> approach;  // n: ticks from the start of the booking to the enter
    Tick headway = 0;                // ticks from the leave to the end of the booking
    bool swaps_conflict = true;
    std::span<const std::uint8_t> active;  // r: an inactive robot (0) has no conflicts
    BookedRows rows = {};                  // where robots have sizes; approaches are then above 0
    VisitClosureArrays closures = {};
};

class Routes {
  public:
    // Throws std::invalid_argument, naming the array, the index and the value.
    explicit Routes(const RouteArrays& arrays);

    RobotId n_robots() const { return static_cast<RobotId>(active_.size()); }
    VisitId n_visits() const { return static_cast<VisitId>(vertex_.size()); }

    VisitId first_of(RobotId robot) const { return first_visit_[index(robot)]; }
    VisitId last_of(RobotId robot) const { return first_visit_[index(robot + 1)] - 1; }
    bool is_active(RobotId robot) const { return active_[index(robot)] != 0; }
    void deactivate(RobotId robot) { active_[index(robot)] = 0; }
    Tick longest_approach(RobotId robot) const { return longest_approach_[index(robot)]; }

    RobotId robot(VisitId visit) const { return robot_[index(visit)]; }
    VertexId vertex(VisitId visit) const { return vertex_[index(visit)]; }
    Tick least(VisitId visit) const { return least_[index(visit)]; }
    Tick approach(VisitId visit) const { return approach_[index(visit)]; }
    Tick headway() const { return headway_; }
    bool swaps_conflict() const { return swaps_conflict_; }

    bool has_sizes() const { return incompatible_.is_known(); }
    // Only where robots have sizes.
    std::span<const IncompatibleVisit> incompatible(VisitId visit) const {
        return incompatible_.of(visit);
    }

    const VisitClosures& closures() const { return closures_; }

    bool is_first(VisitId visit) const { return visit == first_of(robot(visit)); }
    bool is_last(VisitId visit) const { return visit == last_of(robot(visit)); }

    // The least ticks from one robot's leave to the enter of a later visit to the same vertex.
    Tick gap_before(VisitId visit) const { return headway_ + approach_[index(visit)]; }

    // True if the move into this visit can be half of a swap. With a headway or an approach, an
    // exchange at one instant is a vertex conflict instead.
    bool may_swap(VisitId visit) const {
        return swaps_conflict_ && !is_first(visit) && gap_before(visit) == 0;
    }

  private:
    void number_robots();
    void check_robot(RobotId robot) const;
    void check_horizon() const;

    std::vector<VisitId> first_visit_;
    std::vector<VertexId> vertex_;
    std::vector<Tick> least_;
    std::vector<Tick> approach_;
    Tick headway_;
    bool swaps_conflict_;
    std::vector<std::uint8_t> active_;
    std::vector<RobotId> robot_;          // of each visit
    std::vector<Tick> longest_approach_;  // of each robot
    IncompatibleVisits incompatible_;
    VisitClosures closures_;
};

}  // namespace rightofway
