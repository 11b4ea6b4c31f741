// The earliest conflict of the fleet, kept up to date.
//
// A heap holds the earliest conflict known of each robot. When a robot's times change, its entry is
// void and looked up again; when only the partner of a conflict changes, the entry is looked up
// again once it reaches the top. A new conflict needs no more: one of its robots has changed, and
// finds it.
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

    // The caller reports every robot whose times have changed.
    void forget(RobotId robot);

    std::optional<Conflict> next();

    // Rarely called, so its answers are not kept.
    std::optional<Conflict> between(RobotId robot, RobotId other) const;

  private:
    struct Known {
        Conflict conflict;
        std::int64_t at;  // when it was looked up; differs between all entries
        RobotId robot;
        auto operator<=>(const Known&) const = default;
    };

    void look_up(RobotId robot);
    bool is_current(const Known& known) const;
    template <class Find>
    std::optional<Conflict> search(RobotId robot, Find&& find) const;

    const Routes& routes_;
    const Timetable& timetable_;
    const ConflictIndex& index_;
    std::vector<Known> known_;             // a heap; void entries are still in it
    std::vector<std::int64_t> looked_up_;  // when each robot was last
    std::vector<std::int64_t> changed_;    // when the robot's times last did
    std::vector<RobotId> to_look_up_;
    std::int64_t now_ = 0;
};

}  // namespace rightofway
