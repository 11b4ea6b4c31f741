// Which visits of different robots are incompatible, where robots have sizes.
//
// Visit x books its vertex from the start of the drive into x, and the edge driven out of x from
// the start of that drive, which is the start of x + 1. Both bookings end when x ends. A pair of
// visits is incompatible if one of these resources of each is, and the earliest such start counts:
// the start of x itself, or of x + 1 if only the edge takes part.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/types.hpp"

namespace rightofway {

// What each visit books, as rows of Resources (problem.hpp). Borrowed, read once; empty where no
// robot has a size.
struct BookedRows {
    std::span<const std::int32_t> vertex;  // n visits
    std::span<const std::int32_t> edge;    // n: the edge driven out; `none` for last visits
    std::span<const std::int32_t> first;   // the lists of excluded rows, see Resources
    std::span<const std::int32_t> excluded;
};

// A visit that is incompatible with a given one. `starts` and `own_starts` are the visits whose
// start is the earliest incompatible one, of the other visit and of the given one.
struct IncompatibleVisit {
    VisitId visit;
    std::uint8_t is_later;
    std::uint8_t own_is_later;

    VisitId starts() const { return visit + is_later; }
    VisitId own_starts(VisitId own) const { return own + own_is_later; }
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
