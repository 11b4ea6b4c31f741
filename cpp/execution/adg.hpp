// The action dependency graph (ADG) of a plan: visits with least durations, and for each visit the
// previous visit to its vertex.
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
    std::span<const Tick> planned;         // n: planned enter of each visit
    std::span<const Tick> dwell;           // n: least ticks of a visit, without the next drive
    std::span<const Tick> drive;           // n: ticks on the edge into the visit; first visits: 0
    std::span<const VisitId> before;       // n: the previous visit to the same vertex
    Tick headway = 0;
    bool books_ahead = false;
    std::span<const Tick> since = {};  // n: earliest start of each visit; or empty
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

    // The visit before `visit` at its vertex, which has to leave first; or `none`. If it is a last
    // visit, which never ends, `visit` cannot take place.
    VisitId before(VisitId visit) const { return before_[visit]; }

    // Earliest start [tick]: when the right of way was given during execution, else 0.
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
