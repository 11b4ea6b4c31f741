// The earliest conflict of the whole fleet, without looking at the whole fleet each time.
//
// Each robot's earliest conflict is remembered, the earliest of all on top of a heap. When a
// robot's times change, its memory is void; when only the partner of a remembered conflict changes,
// that memory is looked at again should it come out on top. New conflicts need no more care than
// that: at least one robot of a new conflict has changed, and finds it.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/types.hpp"
#include "precedence/conflict.hpp"
#include "precedence/conflict_index.hpp"
#include "precedence/routes.hpp"
#include "precedence/timetable.hpp"

namespace rightofway {

class EarliestConflicts {
  public:
    // All three are borrowed and must outlive this.
    EarliestConflicts(const Routes& routes, const Timetable& timetable, const ConflictIndex& index);

    // Must be told of every robot whose times have changed.
    void forget(RobotId robot);

    std::optional<Conflict> next();

    // Asked seldom, so nothing of it is remembered.
    std::optional<Conflict> between(RobotId robot, RobotId other) const;

  private:
    struct Known {
        Conflict conflict;
        RobotId robot;
        std::int64_t at;  // when it was looked up
    };

    static bool is_later(const Known& left, const Known& right);
    void look_up(RobotId robot);
    bool is_current(const Known& known) const;
    template <class Find>
    std::optional<Conflict> search(RobotId robot, Find&& find) const;

    const Routes& routes_;
    const Timetable& timetable_;
    const ConflictIndex& index_;
    std::vector<Known> known_;             // a heap; what was known before is still in it
    std::vector<std::int64_t> looked_up_;  // when each robot was last
    std::vector<std::int64_t> changed_;    // when the robot's times last did
    std::vector<RobotId> to_look_up_;
    std::int64_t now_ = 0;
};

}  // namespace rightofway
