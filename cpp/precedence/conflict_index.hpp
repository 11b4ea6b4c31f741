// An index of all conflicts of a timetable, found from either of their two visits.
//
// The index holds the booking of each visit, grouped by vertex, and the enter of each visit that
// can be half of a swap, grouped by edge. Routes are fixed: the groups are made once, each in one
// piece of memory; only bookings and enters change. Visits are added and removed one by one, and
// each call returns the change of the weight of all conflicts. Removing a set of visits and adding
// the set with new times therefore counts every pair exactly once. Where robots have sizes, the
// groups are empty, and each visit is compared with the visits that are incompatible with it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/types.hpp"
#include "precedence/conflict.hpp"
#include "precedence/routes.hpp"
#include "precedence/timetable.hpp"

namespace rightofway {

class ConflictIndex {
  public:
    // The routes are borrowed and must outlive the index. The index starts empty.
    // Throws std::overflow_error if the sum of all weights might overflow.
    explicit ConflictIndex(const Routes& routes);

    // Adds the visit with its time in the timetable; returns the weight of its conflicts with the
    // visits in the index. Ignores a visit already in the index or of an inactive robot.
    Tick add(VisitId visit, const Timetable& timetable);
    // Removes the visit; returns the weight of its conflicts with the visits in the index.
    Tick remove(VisitId visit);
    // Moves the visit to its time in the timetable, without counting conflicts.
    void move(VisitId visit, const Timetable& timetable);

    // The weight of a visit's conflicts with all robots, or with robots whose mask is nonzero.
    Tick weight(VisitId visit) const;
    Tick weight(VisitId visit, std::span<const std::uint8_t> mask) const;

    // The earliest conflict of a visit with any robot, or with the other robot.
    std::optional<Conflict> earliest(VisitId visit) const;
    std::optional<Conflict> earliest(VisitId visit, RobotId other) const;

  private:
    // What a visit books: its vertex, and later the edge driven out.
    struct Stay {
        BookingStarts starts{never, never};
        Tick end = never;

        Booking booking() const { return {starts[0], end}; }
    };

    // Visits with a value each, grouped by a key. Each visit can have conflicts with the slots of
    // one key, except the slots of its own robot.
    template <class Value>
    struct Groups {
        struct Slot {
            Value value;
            VisitId visit;
            RobotId robot;
        };
        struct Range {
            std::int32_t begin;
            std::int32_t own_begin;
            std::int32_t own_end;
            std::int32_t end;
        };

        std::vector<Slot> slots;            // by key, then by visit, and so by robot
        std::vector<Range> others;          // of each slot
        std::vector<std::int32_t> slot_of;  // of each visit, or `none`

        template <class Key, class OtherKey>
        Groups(const Routes& routes, std::vector<VisitId> visits, Key key, OtherKey other_key);

        Value* find(VisitId visit) {
            return slot_of[index(visit)] == none ? nullptr
                                                 : &slots[index(slot_of[index(visit)])].value;
        }
        // Calls use(slot) for each slot in the range of a visit.
        template <class Use>
        void for_each_other(VisitId visit, Use&& use) const {
            if (slot_of[index(visit)] == none) {
                return;
            }
            const Range& range = others[index(slot_of[index(visit)])];
            for (std::int32_t k = range.begin; k < range.own_begin; ++k) {
                use(slots[index(k)]);
            }
            for (std::int32_t k = range.own_end; k < range.end; ++k) {
                use(slots[index(k)]);
            }
        }
    };

    struct Other {
        VisitId visit;
        RobotId robot;
    };

    const Stay& stay(VisitId visit) const {
        return stays_.slots[index(stays_.slot_of[index(visit)])].value;
    }
    // Calls use(other, tick, weight, kind) for each conflict of a visit.
    template <class Use>
    void for_each_conflict(VisitId visit, Use&& use) const;
    template <class Accept>
    Tick weight_where(VisitId visit, Accept&& accept) const;
    template <class Accept>
    std::optional<Conflict> earliest_where(VisitId visit, Accept&& accept) const;

    const Routes& routes_;
    Groups<Stay> stays_;   // by vertex
    Groups<Tick> enters_;  // by edge
};

}  // namespace rightofway
