// Who meets next on endless routes: a sweep in order of time that goes no further than it is asked.
//
// Visits are swept in the order in which their bookings start, into a list for each vertex. A visit
// that is swept finds its conflicts with those in the list; they wait in a heap until everything
// that starts before them is swept too. Where times change, the robot's visits from there on are
// taken out and swept anew, so a conflict is known as soon as both its visits are. What is in the
// heap and does not hold any more is dropped when it comes out on top.
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

    // The earliest conflict in view before a tick, in the order of `Conflict`; visits by number.
    std::optional<Conflict> next(Tick limit);

    // Must be told where times have changed,
    void change(std::span<const RollingTimetable::Changed> changed);
    // how far a robot's visits were shown before the view has moved,
    void show(RobotId robot, std::int32_t old_end);
    // and when everything is another.
    void restart();

    // How many visits were swept so far.
    std::int64_t n_swept() const { return n_swept_; }

  private:
    struct Booked {
        CyclicVisit visit;
        Booking booking;
    };
    struct Place {
        std::vector<Booked> booked;  // in order of start
        Tick longest = 0;            // of all bookings that were ever here
    };
    struct Ahead {
        Tick start;
        CyclicVisit visit;
        auto operator<=>(const Ahead&) const = default;
    };
    struct Sweep {  // of a robot: the first visit that is not swept
        std::int32_t number = 0;
        std::int32_t place = 0;
        Tick start = never;  // of its booking; never, if it is not shown
    };

    Booking booking(CyclicVisit visit) const;
    bool is_shown(CyclicVisit visit) const;
    bool holds(const Conflict& conflict) const;
    void look_ahead(RobotId robot);
    void take_out(RobotId robot, std::int32_t from);
    void sweep(RobotId robot);
    void push_ahead(RobotId robot);
    void replace_first_ahead(RobotId robot);
    void prepare(RobotId robot) const;
    void forget_past(std::vector<Booked>& booked) const;
    void compare(const Booked& own, const Booked& other);
    void add(CyclicVisit one, CyclicVisit other, Tick tick, ConflictKind kind);

    const CyclicRoutes& routes_;
    const RollingTimetable& timetable_;
    std::vector<Place> at_;            // per vertex
    std::vector<Sweep> sweeps_;        // per robot
    std::vector<Ahead> ahead_;         // a heap
    std::vector<Conflict> conflicts_;  // a heap
    std::int64_t n_swept_ = 0;
};

}  // namespace rightofway
