// Counts the conflicts of executed visits, from their times alone.
//
// A visit books its vertex from its start until it is left, and the headway after that. Bookings of
// one vertex by different robots that overlap are a conflict, and so are two robots that exchange
// their vertices at one instant. (ConflictIndex keeps weights up to date for one plan; here all
// pairs of many runs are counted, by kind.)
#pragma once

#include <cstdint>
#include <vector>

#include "execution/adg.hpp"
#include "execution/execution_timetable.hpp"

namespace rightofway {

struct ConflictCount {
    std::int64_t vertex = 0;   // pairs of visits that overlap
    std::int64_t headway = 0;  // pairs that overlap only by the headway
    std::int64_t swap = 0;     // pairs of moves
    Tick first = never;        // the tick of the earliest
};

class ExecutedConflicts {
  public:
    explicit ExecutedConflicts(const ActionDependencyGraph& plan);

    ConflictCount count(const ActualTimes& times);

  private:
    void count_at_vertex(std::size_t group, const ActualTimes& times, ConflictCount& found);
    void count_on_edge(std::size_t group, const ActualTimes& times, ConflictCount& found);
    Tick leave(VisitId visit, const ActualTimes& times) const {
        return plan_.is_last(visit) ? never : times.enter[visit + 1];
    }

    // Visits to one vertex, or over one edge, by more than one robot. Each group stays in the order
    // of the last run, which is nearly that of the next.
    struct Groups {
        std::vector<std::size_t> first{0};
        std::vector<VisitId> visit;
    };

    const ActionDependencyGraph& plan_;
    Groups at_vertex_;
    Groups on_edge_;
};

}  // namespace rightofway
