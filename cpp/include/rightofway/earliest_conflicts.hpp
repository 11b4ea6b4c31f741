// The earliest conflict of the whole fleet, without looking at the whole fleet each time.
//
// Each robot's earliest conflict is remembered. When a robot's times change, its memory is void;
// when only the partner of a remembered conflict changes, that memory is looked at again should it
// come out earliest. New conflicts need no more care than that: at least one robot of a new
// conflict has changed, and finds it.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "rightofway/conflict.hpp"
#include "rightofway/conflict_index.hpp"
#include "rightofway/routes.hpp"
#include "rightofway/timetable.hpp"
#include "rightofway/types.hpp"

namespace rightofway {

class EarliestConflicts {
  public:
    // All three are borrowed and must outlive this.
    EarliestConflicts(const Routes& routes, const Timetable& timetable, const ConflictIndex& index);

    // Must be told of every robot whose times have changed.
    void forget(RobotId robot) { changed_at_[robot] = ++now_; }

    std::optional<Conflict> next();

    // Asked seldom, so nothing of it is remembered.
    std::optional<Conflict> between(RobotId robot, RobotId other) const;

  private:
    void look_up(RobotId robot);
    bool is_current(RobotId robot) const;
    template <class Find>
    std::optional<Conflict> search(RobotId robot, Find&& find) const;

    const Routes& routes_;
    const Timetable& timetable_;
    const ConflictIndex& index_;
    std::vector<std::optional<Conflict>> known_;  // per robot
    std::vector<std::int64_t> known_at_;          // when it was looked up
    std::vector<std::int64_t> changed_at_;        // when the robot's times last changed
    std::int64_t now_ = 0;
};

}  // namespace rightofway
