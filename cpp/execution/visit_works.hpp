// The works of visits, of plans with jobs: each begins no sooner than its time, and after the works
// before it have ended: those of its visit, and some of other robots.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/types.hpp"

namespace rightofway {

using WorkId = std::int32_t;

struct VisitWorkArrays {
    // n + 1: visit x has works first_work[x] .. first_work[x + 1] - 1, in order.
    std::span<const std::int32_t> first_work;
    std::span<const Tick> ticks;     // w works: least duration, a part of the dwell of the visit
    std::span<const Tick> earliest;  // w: begins no sooner
    std::span<const Tick> planned;   // w: planned begin
    // w + 1, and works that end before others begin: work k has before[first_before[k]] ..
    std::span<const std::int32_t> first_before;
    std::span<const WorkId> before;
    std::span<const std::int32_t> ends_with_work;  // robots: 1 if it completes with its last work
};

class VisitWorks {
  public:
    VisitWorks() = default;  // no visit has works
    // `dwell` of each visit. Throws std::invalid_argument, naming the array, the index and the
    // value.
    VisitWorks(const VisitWorkArrays& arrays, std::span<const Tick> dwell, std::size_t n_robots);

    bool is_known() const { return !first_work_.empty(); }
    WorkId n_works() const { return static_cast<WorkId>(ticks_.size()); }

    WorkId first_of(VisitId visit) const { return is_known() ? first_work_[index(visit)] : 0; }
    WorkId end_of(VisitId visit) const { return is_known() ? first_work_[index(visit + 1)] : 0; }
    VisitId visit(WorkId work) const { return visit_[index(work)]; }
    Tick ticks(WorkId work) const { return ticks_[index(work)]; }
    Tick earliest(WorkId work) const { return earliest_[index(work)]; }
    Tick planned(WorkId work) const { return planned_[index(work)]; }
    std::span<const WorkId> before(WorkId work) const {
        return {before_.data() + first_before_[index(work)],
                before_.data() + first_before_[index(work + 1)]};
    }
    bool ends_with_work(RobotId robot) const {
        return is_known() && ends_with_work_[index(robot)] != 0;
    }

    // The ticks of a visit that its works take; `dwell` is how long it lasts without delays.
    Tick sum(VisitId visit) const;
    // The real duration of a work whose visit takes `real` ticks instead of `dwell`: each work has
    // its part, rounded so that the parts of all works add up.
    Tick share(WorkId work, Tick dwell, Tick real) const;

  private:
    std::vector<std::int32_t> first_work_;
    std::vector<VisitId> visit_;
    std::vector<Tick> ticks_;
    std::vector<Tick> until_;  // ticks of the works of its visit, up to and with each work
    std::vector<Tick> earliest_;
    std::vector<Tick> planned_;
    std::vector<std::int32_t> first_before_;
    std::vector<WorkId> before_;
    std::vector<std::int32_t> ends_with_work_;
};

}  // namespace rightofway
