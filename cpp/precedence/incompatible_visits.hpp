// Which visits of different robots are incompatible, where robots have sizes.
//
// Visit x books its vertex from the start of the drive into x, and the edge driven out of x from
// the start of that drive, which is the start of x + 1. Both bookings end when x ends. A pair of
// visits is incompatible if one of these resources of each is. The one that waits starts before all
// its bookings that the other one excludes: with x itself, or with x + 1 if only the edge does.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/excluded_rows.hpp"
#include "core/types.hpp"

namespace rightofway {

// What each visit books, as rows of Resources (problem.hpp). Borrowed, read once; empty where no
// robot has a size.
struct BookedRows {
    std::span<const std::int32_t> vertex;  // n visits; `none` for one that books nothing
    std::span<const std::int32_t> edge;    // n: the edge driven out; `none` for last visits
    ExcludedRows lists = {};
};

// When the two bookings of a visit start: that of its vertex, that of the edge driven out.
using BookingStarts = std::array<Tick, 2>;

// Which bookings of two visits exclude each other, as a set of pairs.
class ExcludingBookings {
  public:
    static ExcludingBookings vertices() {
        ExcludingBookings both;
        both.add(false, false);
        return both;
    }
    void add(bool own_is_edge, bool is_edge) {
        pairs_ |= static_cast<std::uint8_t>(1 << (2 * own_is_edge + is_edge));
    }
    void add(const ExcludingBookings& others) { pairs_ |= others.pairs_; }
    bool empty() const { return pairs_ == 0; }

    // Whether only the edge of a visit takes part: the own one, and the other one.
    bool own_is_later() const { return (pairs_ & 0b0011) == 0; }
    bool is_later() const { return (pairs_ & 0b0101) == 0; }

    // The first tick at which both bookings of a pair have started. The vertex of each may exclude
    // the edge of the other one, and not its vertex: so each pair has its own tick.
    Tick begin(const BookingStarts& own, const BookingStarts& other) const {
        Tick begin = never;
        for (unsigned pair = 0, left = pairs_; left != 0; ++pair, left >>= 1) {
            if ((left & 1) != 0) {
                begin = std::min(begin, std::max(own[pair / 2], other[pair % 2]));
            }
        }
        return begin;
    }

  private:
    std::uint8_t pairs_ = 0;
};

// A visit that is incompatible with a given one. `starts` and `own_starts` are the visits whose
// start is the earliest incompatible one, of the other visit and of the given one.
struct IncompatibleVisit {
    VisitId visit;
    ExcludingBookings bookings;

    VisitId starts() const { return visit + bookings.is_later(); }
    VisitId own_starts(VisitId own) const { return own + bookings.own_is_later(); }
};

class IncompatibleVisits {
  public:
    IncompatibleVisits() = default;
    // Throws std::invalid_argument if arrays do not fit, std::overflow_error on too many pairs.
    IncompatibleVisits(std::span<const RobotId> robot, const BookedRows& rows);

    bool is_known() const { return !first_.empty(); }  // false where no robot has a size

    // Visits of other robots, in increasing order; none where no robot has a size.
    std::span<const IncompatibleVisit> of(VisitId visit) const {
        if (!is_known()) {
            return {};
        }
        return {others_.data() + first_[index(visit)], others_.data() + first_[index(visit + 1)]};
    }

  private:
    std::vector<std::size_t> first_;
    std::vector<IncompatibleVisit> others_;
};

}  // namespace rightofway
