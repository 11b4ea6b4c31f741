// When the places that visits book are closed: the vertex of each visit, and the edge driven into
// it. Closures are bookings without a robot; see problem.hpp.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/types.hpp"

namespace rightofway {

// Input of VisitClosures, borrowed; empty without closures. Bookings of one list are in order of
// time and do not overlap.
struct VisitClosureArrays {
    // 2 n + 1 for n visits: list 2 x is of the vertex of visit x, list 2 x + 1 of the edge into it.
    std::span<const std::int32_t> first;
    std::span<const Tick> from;
    std::span<const Tick> until;
    std::span<const Tick> drive;  // n: ticks of the drive into each visit; 0 for first visits
};

class VisitClosures {
  public:
    VisitClosures() = default;
    // Throws std::invalid_argument if the arrays do not fit together.
    VisitClosures(const VisitClosureArrays& arrays, std::size_t n_visits);

    bool is_known() const { return !first_.empty(); }
    Tick drive(VisitId visit) const { return drive_[index(visit)]; }

    // The earliest start, from `start` on, with which a booking of the vertex until `end` overlaps
    // no closure; `never` if there is none.
    Tick free_at(VisitId visit, Tick start, Tick end) const { return free(2 * visit, start, end); }
    // The same for a booking of the vertex for some ticks; of the edge.
    Tick free_stay(VisitId visit, Tick start, Tick ticks) const;
    Tick free_along(VisitId visit, Tick start, Tick ticks) const;

  private:
    Tick free(std::int32_t list, Tick start, Tick end) const;

    std::vector<std::int32_t> first_;
    std::vector<Booking> closed_;
    std::vector<Tick> drive_;
};

}  // namespace rightofway
