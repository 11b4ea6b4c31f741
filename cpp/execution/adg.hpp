// The action dependency graph (ADG) of a plan: visits with least durations, and for each visit the
// visits that have to end before the drive into it starts. For points this is the visit before it
// at its vertex; where robots have sizes, there can be several, at any vertices.
//
// W. Hoenig et al., Persistent and robust execution of MAPF schedules in warehouses, IEEE Robotics
// and Automation Letters 4, 2019.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/types.hpp"
#include "execution/visit_works.hpp"
#include "precedence/incompatible_visits.hpp"
#include "precedence/visit_closures.hpp"

namespace rightofway {

struct AdgArrays {
    std::span<const VisitId> first_visit;  // robots + 1: robot r owns first_visit[r] .. [r + 1] - 1
    std::span<const VertexId> vertex;      // n visits
    std::span<const Tick> planned;         // n: planned enter of each visit
    std::span<const Tick> dwell;           // n: least ticks of a visit, without the next drive
    std::span<const Tick> drive;           // n: ticks on the edge into the visit; first visits: 0
    // n + 1, and all visits before others: visit x has rights[first_right[x]] .. before it.
    std::span<const std::int32_t> first_right;
    std::span<const VisitId> rights;
    Tick headway = 0;
    bool books_ahead = false;
    std::span<const Tick> since = {};  // n: earliest start of each visit; or empty
    BookedRows rows = {};
    VisitClosureArrays closures = {};
    VisitWorkArrays works = {};
};

class ActionDependencyGraph {
  public:
    // Throws std::invalid_argument, naming the array, the index and the value.
    explicit ActionDependencyGraph(const AdgArrays& arrays);

    RobotId n_robots() const { return static_cast<RobotId>(first_visit_.size()) - 1; }
    VisitId n_visits() const { return static_cast<VisitId>(vertex_.size()); }
    VisitId first_of(RobotId robot) const { return first_visit_[index(robot)]; }
    VisitId last_of(RobotId robot) const { return first_visit_[index(robot + 1)] - 1; }
    bool is_first(VisitId visit) const { return visit == first_of(robot_[index(visit)]); }
    bool is_last(VisitId visit) const { return visit == last_of(robot_[index(visit)]); }

    RobotId robot(VisitId visit) const { return robot_[index(visit)]; }
    VertexId vertex(VisitId visit) const { return vertex_[index(visit)]; }
    Tick planned(VisitId visit) const { return planned_[index(visit)]; }
    Tick dwell(VisitId visit) const { return dwell_[index(visit)]; }
    Tick drive(VisitId visit) const { return drive_[index(visit)]; }
    Tick headway() const { return headway_; }
    bool books_ahead() const { return books_ahead_; }

    // The visits that have to leave before `visit` starts. If one of them is a last visit, which
    // never ends, `visit` cannot take place.
    std::span<const VisitId> before(VisitId visit) const {
        return {rights_.data() + first_right_[index(visit)],
                rights_.data() + first_right_[index(visit + 1)]};
    }

    bool has_sizes() const { return incompatible_.is_known(); }
    // Only where robots have sizes.
    std::span<const IncompatibleVisit> incompatible(VisitId visit) const {
        return incompatible_.of(visit);
    }

    const VisitClosures& closures() const { return closures_; }

    const VisitWorks& works() const { return works_; }
    // The ticks of a visit after its works: the robot turns.
    Tick turn(VisitId visit) const { return dwell(visit) - works_.sum(visit); }

    // Earliest start [tick]: when the right of way was given during execution, else 0.
    Tick since(VisitId visit) const { return since_.empty() ? 0 : since_[index(visit)]; }

    Tick planned_completion(RobotId robot) const;
    // The work with which a robot completes, `none` for its last visit.
    WorkId completing_work(RobotId robot) const;

  private:
    void number_robots();
    void check() const;
    void check_rights() const;

    std::vector<VisitId> first_visit_;
    std::vector<VertexId> vertex_;
    std::vector<Tick> planned_;
    std::vector<Tick> dwell_;
    std::vector<Tick> drive_;
    std::vector<Tick> since_;
    std::vector<std::int32_t> first_right_;
    std::vector<VisitId> rights_;
    std::vector<RobotId> robot_;
    IncompatibleVisits incompatible_;
    VisitClosures closures_;
    VisitWorks works_;
    Tick headway_;
    bool books_ahead_;
};

}  // namespace rightofway
