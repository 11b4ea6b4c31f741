// All conflicts of a timetable, each seen from either of its two visits.
//
// The index holds what visits book and when they are entered. Visits are added and removed one by
// one, and each addition or removal tells how much the count of conflicts changes. Taking a set of
// visits out and putting it back with new times therefore counts every pair exactly once.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "core/types.hpp"
#include "precedence/booking_index.hpp"
#include "precedence/conflict.hpp"
#include "precedence/move_index.hpp"
#include "precedence/routes.hpp"
#include "precedence/timetable.hpp"

namespace rightofway {

class ConflictIndex {
  public:
    // The routes are borrowed and must outlive this. At first it holds no visits.
    // Throws std::invalid_argument if so many visits share vertices that a count might overflow.
    explicit ConflictIndex(const Routes& routes);

    // Adds the visit at its time in the timetable and returns the weight of its conflicts with
    // those already here. A visit that is here already stays as it is; one of an inactive robot
    // stays out.
    Tick add(VisitId visit, const Timetable& timetable);
    // Removes the visit and returns the weight of its conflicts with those still here.
    Tick remove(VisitId visit);
    // Moves the visit to its time in the timetable, without counting.
    void move(VisitId visit, const Timetable& timetable);

    // The weight of this visit's conflicts, with all robots or with those whose mask is not 0.
    Tick weight(VisitId visit) const;
    Tick weight(VisitId visit, std::span<const std::uint8_t> mask) const;

    // The earliest conflict of this visit, with any robot or with the given one.
    std::optional<Conflict> earliest(VisitId visit) const;
    std::optional<Conflict> earliest(VisitId visit, RobotId other) const;

  private:
    template <class Accept>
    Tick weight_where(VisitId visit, Accept&& accept) const;
    template <class Accept>
    std::optional<Conflict> earliest_where(VisitId visit, Accept&& accept) const;
    Conflict conflict(VisitId visit, VisitId other, Tick tick, ConflictKind kind) const;

    const Routes& routes_;
    BookingIndex bookings_;
    MoveIndex moves_;
};

}  // namespace rightofway
