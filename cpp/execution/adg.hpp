// The action dependency graph of a plan: visits with their least durations, and the visit that goes
// before each at its vertex.
//
// W. Hoenig et al., Persistent and robust execution of MAPF schedules in warehouses, IEEE Robotics
// and Automation Letters 4, 2019.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/types.hpp"

namespace rightofway {

struct AdgArrays {
    std::span<const VisitId> first_visit;  // robots + 1: robot r owns first_visit[r] .. [r + 1] - 1
    std::span<const VertexId> vertex;      // n visits
    std::span<const Tick> planned;         // n: when each visit begins by the plan
    std::span<const Tick> dwell;           // n: least ticks of a visit, without the drive after it
    std::span<const Tick> drive;           // n: ticks of the edge driven into it; first visits: 0
    std::span<const VisitId> before;       // n: the visit that goes directly before at its vertex
    Tick headway = 0;
    bool books_ahead = false;
    std::span<const Tick> since = {};  // n: no visit begins before; or empty
};

class ActionDependencyGraph {
  public:
    // Throws std::invalid_argument, naming the array, the index and the value.
    explicit ActionDependencyGraph(const AdgArrays& arrays);

    RobotId n_robots() const { return static_cast<RobotId>(first_visit_.size()) - 1; }
    VisitId n_visits() const { return static_cast<VisitId>(vertex_.size()); }
    VisitId first_of(RobotId robot) const { return first_visit_[robot]; }
    VisitId last_of(RobotId robot) const { return first_visit_[robot + 1] - 1; }
    bool is_first(VisitId visit) const { return visit == first_of(robot_[visit]); }
    bool is_last(VisitId visit) const { return visit == last_of(robot_[visit]); }

    RobotId robot(VisitId visit) const { return robot_[visit]; }
    VertexId vertex(VisitId visit) const { return vertex_[visit]; }
    Tick planned(VisitId visit) const { return planned_[visit]; }
    Tick dwell(VisitId visit) const { return dwell_[visit]; }
    Tick drive(VisitId visit) const { return drive_[visit]; }
    Tick headway() const { return headway_; }
    bool books_ahead() const { return books_ahead_; }

    // The visit whose leave this one waits for, none if it waits for nobody. Where it is a last
    // visit, which never ends, this one cannot take place.
    VisitId before(VisitId visit) const { return before_[visit]; }

    // When the visit's right of way was given, if during execution: it cannot begin before.
    Tick since(VisitId visit) const { return since_.empty() ? 0 : since_[visit]; }

    Tick planned_completion(RobotId robot) const {
        return planned_[last_of(robot)] + dwell_[last_of(robot)];
    }

  private:
    void number_robots();
    void check() const;

    std::vector<VisitId> first_visit_;
    std::vector<VertexId> vertex_;
    std::vector<Tick> planned_;
    std::vector<Tick> dwell_;
    std::vector<Tick> drive_;
    std::vector<VisitId> before_;
    std::vector<Tick> since_;
    std::vector<RobotId> robot_;
    Tick headway_;
    bool books_ahead_;
};

}  // namespace rightofway
