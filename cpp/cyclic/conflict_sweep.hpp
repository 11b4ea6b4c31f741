// The next conflict of cyclic routes, by a sweep in order of time.
//
// Visits are swept in the order in which their bookings start, into a list for each vertex, up to
// the tick that is asked for. A swept visit finds its conflicts with those in the list; they wait
// in a heap until all bookings that start earlier are swept. Where times change, the visits of that
// robot from there on are removed and swept again, so a conflict is known as soon as both its
// visits are. A conflict that does not hold any more is dropped when it reaches the top of the
// heap. (ConflictIndex, for routes of fixed length, counts conflicts instead: it has no order.)
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/types.hpp"
#include "cyclic/cyclic_routes.hpp"
#include "cyclic/rolling_timetable.hpp"
#include "precedence/conflict.hpp"

namespace rightofway {

class ConflictSweep {
  public:
    // Both are borrowed and must outlive this.
    ConflictSweep(const CyclicRoutes& routes, const RollingTimetable& timetable);

    // The earliest conflict in the window before a tick, in the order of `Conflict`; visits by
    // number.
    std::optional<Conflict> next(Tick limit);

    // The caller reports visits whose times have changed,
    void times_changed(std::span<const RollingTimetable::Changed> changed);
    // a new end of a robot's window,
    void end_changed(RobotId robot, std::int32_t old_end);
    // and a timetable that was restarted.
    void restart();

  private:
    struct Booked {
        CyclicVisit visit;
        Booking booking;
    };
    struct Place {
        std::vector<Booked> booked;  // in order of start
        Tick longest = 0;            // of all bookings that were ever in the list
    };
    struct Upcoming {
        Tick start;
        CyclicVisit visit;
        auto operator<=>(const Upcoming&) const = default;
    };
    struct Sweep {  // the first visit of a robot that is not swept
        std::int32_t number = 0;
        std::int32_t place = 0;
        Tick start = never;  // of its booking; `never` if it is not in the window
    };

    Booking booking(CyclicVisit visit) const;
    bool holds(const Conflict& conflict) const;
    void find_next(RobotId robot);
    void unsweep(RobotId robot, std::int32_t from);
    void sweep(RobotId robot);
    void replace_first_upcoming(RobotId robot);
    void prefetch_next(RobotId robot) const;
    void drop_past(std::vector<Booked>& booked) const;
    void compare(const Booked& own, const Booked& other);
    void add(CyclicVisit one, CyclicVisit other, Tick tick, ConflictKind kind);

    const CyclicRoutes& routes_;
    const RollingTimetable& timetable_;
    std::vector<Place> at_;            // per vertex
    std::vector<Sweep> sweeps_;        // per robot
    std::vector<Upcoming> upcoming_;   // a heap
    std::vector<Conflict> conflicts_;  // a heap
};

}  // namespace rightofway
