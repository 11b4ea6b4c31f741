// The earliest conflict of the fleet, kept up to date.
//
// A heap holds the earliest known conflict of each robot. When a robot's times change, its entry
// is void and looked up again; when only the other robot of the conflict changes, the entry is
// looked up again at the top of the heap. This finds new conflicts too: the times of one of their
// robots have changed.
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
    // All arguments are borrowed and must outlive this object.
    EarliestConflicts(const Routes& routes, const Timetable& timetable, const ConflictIndex& index);

    // Voids a robot's entry; the caller reports every robot with changed times.
    void forget(RobotId robot);

    std::optional<Conflict> next();

    // The earliest conflict of two robots; rarely called, hence not cached.
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
    std::vector<std::int64_t> looked_up_;  // per robot: number of the last lookup
    std::vector<std::int64_t> changed_;    // per robot: number at the last change of times
    std::vector<RobotId> to_look_up_;
    std::int64_t now_ = 0;
};

}  // namespace rightofway
