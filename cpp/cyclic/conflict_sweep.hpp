// Finds the next conflict of cyclic routes by a sweep in order of time.
//
// Visits are swept by the start of their bookings, up to a tick, into one list per vertex. A swept
// visit is compared with the visits in the list; their conflicts stay in a heap until all earlier
// bookings are swept. Where robots have sizes, there is a list for each row; a visit stands in
// those of its vertex and of the edge driven out of it, and is compared with visits in all lists
// that these two exclude. If times change, the robot's visits are removed from the first changed
// visit on and swept again: a conflict is found as soon as both its visits are swept. An outdated
// conflict is dropped at the top of the heap. (ConflictIndex, for finite routes, weighs conflicts
// without an order.)
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
    // Both arguments are borrowed and must outlive this object.
    ConflictSweep(const CyclicRoutes& routes, const RollingTimetable& timetable);

    // The earliest conflict in the window before tick `limit`, in the order of `Conflict`; visits
    // by number.
    std::optional<Conflict> next(Tick limit);

    // The caller reports visits with changed times, ...
    void times_changed(std::span<const RollingTimetable::Changed> changed);
    // ... a new end of a robot's window, ...
    void end_changed(RobotId robot, std::int32_t old_end);
    // ... and a restarted timetable.
    void restart();

  private:
    struct Booked {
        CyclicVisit visit;
        Booking booking;
    };
    struct Place {
        std::vector<Booked> booked;  // in order of start
        Tick longest = 0;            // of all bookings that have been in the list
    };
    struct Upcoming {
        Tick start;
        CyclicVisit visit;
        auto operator<=>(const Upcoming&) const = default;
    };
    struct Sweep {  // the first unswept visit of a robot
        std::int32_t number = 0;
        std::int32_t place = 0;
        Tick start = never;  // of its booking; `never` outside the window
    };

    BookingStarts starts(CyclicVisit visit) const;
    Tick end(CyclicVisit visit) const;
    std::optional<Conflict> conflict(CyclicVisit one, CyclicVisit other) const;
    bool leaves(CyclicVisit visit) const;
    bool holds(const Conflict& conflict) const;
    void find_next(RobotId robot);
    void unsweep(RobotId robot, std::int32_t from);
    void sweep(RobotId robot);
    void sweep_with_sizes(RobotId robot);
    void take_out(std::int32_t list, CyclicVisit visit);
    void put_in(std::int32_t list, const Booked& own);
    void advance(RobotId robot, Tick leave);
    void replace_first_upcoming(RobotId robot);
    void prefetch_next(RobotId robot) const;
    void drop_past(std::vector<Booked>& booked) const;
    void compare(const Booked& own, const Booked& other);
    void add(CyclicVisit one, CyclicVisit other, Tick tick, ConflictKind kind);

    const CyclicRoutes& routes_;
    const RollingTimetable& timetable_;
    std::vector<Place> at_;            // per vertex, or per row
    std::vector<Sweep> sweeps_;        // per robot
    std::vector<Upcoming> upcoming_;   // a heap
    std::vector<Conflict> conflicts_;  // a heap
};

}  // namespace rightofway
