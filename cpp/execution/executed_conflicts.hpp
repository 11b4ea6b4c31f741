// Counts the conflicts of an execution, from the actual times of its visits alone.
//
// A visit books its vertex from its start to its leave, plus the headway. Conflicts are overlapping
// bookings of one vertex by two robots, and swaps: two robots exchange vertices at one instant.
// Where robots have sizes, conflicts are overlapping bookings of incompatible visits.
// (ConflictIndex updates weights for one plan; this class counts all pairs of many runs, by kind.)
#pragma once

#include <cstdint>
#include <vector>

#include "execution/adg.hpp"
#include "execution/execution_timetable.hpp"

namespace rightofway {

struct ConflictCount {
    std::int64_t vertex = 0;   // pairs of overlapping visits
    std::int64_t headway = 0;  // pairs that overlap by the headway only
    std::int64_t swap = 0;     // pairs of moves
    Tick first = never;        // tick of the earliest conflict
};

class ExecutedConflicts {
  public:
    explicit ExecutedConflicts(const ActionDependencyGraph& plan);

    ConflictCount count(const ActualTimes& times);

  private:
    void count_at_vertex(std::size_t group, const ActualTimes& times, ConflictCount& found);
    void count_incompatible(const ActualTimes& times, ConflictCount& found) const;
    void count_on_edge(std::size_t group, const ActualTimes& times, ConflictCount& found);
    Tick leave(VisitId visit, const ActualTimes& times) const {
        return plan_.is_last(visit) ? never : times.enter[index(visit + 1)];
    }

    // Visits to one vertex, or over one edge, by more than one robot. Each group keeps the order of
    // the last run, which nearly sorts the next run.
    struct Groups {
        std::vector<std::size_t> first{0};
        std::vector<VisitId> visit;
    };

    const ActionDependencyGraph& plan_;
    Groups at_vertex_;
    Groups on_edge_;
};

}  // namespace rightofway
