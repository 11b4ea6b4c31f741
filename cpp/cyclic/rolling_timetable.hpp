// The earliest times that keep cyclic routes and rights of way, in a rolling window of visits.
//
// The window holds visits `start` .. `end` - 1 of each robot, and the enter of visit `end`. Visits
// below `frozen` have started by the cut and keep their times. The window moves with the cut; times
// inside the window are kept.
//
// A right of way raises visits as in `Timetable` (raise_search.hpp), up to the enter of its source.
// Later visits cannot lead back to the source: they are raised without a trial, in runs of
// consecutive visits with the same delta.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/types.hpp"
#include "cyclic/cyclic_routes.hpp"
#include "precedence/raise_search.hpp"

namespace rightofway {

// Loads memory into the cache; affects running time only.
inline void prefetch([[maybe_unused]] const void* address) {
#if defined(__GNUC__) || defined(__clang__)
    __builtin_prefetch(address);
#endif
}

// The decision for which a right of way was given; later decisions have larger numbers.
using DecisionId = std::int64_t;

class RollingTimetable : private RaiseSearch<RollingTimetable, CyclicVisit> {
  public:
    struct Mark {
        std::size_t n_runs = 0;
        std::size_t n_given = 0;
    };
    struct Changed {
        RobotId robot;
        std::int32_t from;  // visits from this number on may have new times
    };

    // Every robot enters visit 0, frozen, at tick 0. The routes must outlive this object.
    explicit RollingTimetable(const CyclicRoutes& routes);

    std::int32_t start(RobotId robot) const { return lines_[index(robot)].start; }
    std::int32_t frozen(RobotId robot) const { return lines_[index(robot)].frozen; }
    std::int32_t end(RobotId robot) const { return lines_[index(robot)].end; }
    bool is_in_window(CyclicVisit visit) const {
        return start(visit.robot) <= visit.number && visit.number < end(visit.robot);
    }
    Tick begins() const { return begins_; }
    Tick enter(CyclicVisit visit) const { return node(visit).enter; }
    // Loads the enter of a visit, or of the last visit in the window, into the cache.
    void prefetch_enter(CyclicVisit visit) const {
        prefetch(&node({visit.robot, std::min(visit.number, end(visit.robot))}));
    }
    bool is_frozen(CyclicVisit visit) const {
        return visit.number < lines_[index(visit.robot)].frozen;
    }

    // Sets the end of a robot's window, after all visits that are frozen or have a right of way.
    void set_end(RobotId robot, std::int32_t end);
    // Freezes a robot's visits that have started by a tick; the window contains all of them.
    void freeze(RobotId robot, Tick tick);
    // Drops visits left by a tick. Precondition: visits started by the cut are frozen.
    void start_window(Tick tick, Tick cut);
    // Replaces a robot's window by visits from `start` on with these enters, all frozen, and
    // removes its rights of way.
    void restart(RobotId robot, std::int32_t start, std::span<const Tick> enters);

    // Gives visit a the right of way over visit b of another robot at the same vertex. Returns
    // false and changes nothing if b is frozen or a deadlock or swap would follow (see cycle()).
    bool precede(CyclicVisit a, CyclicVisit b, DecisionId decision);

    // The cycle that the last refused right of way would close, b first (empty if b is frozen);
    // and the decisions that gave the rights of way on this cycle.
    std::span<const CyclicVisit> cycle() const { return cycle_; }
    std::span<const DecisionId> cycle_decisions() const { return cycle_decisions_; }

    // Undoes all changes since a mark. Precondition: the window has not changed since.
    Mark mark() const { return {runs_.size(), given_.size()}; }
    void rollback(const Mark& mark);

    // For older changes: remove() removes one right of way; then recompute() computes all times
    // from the frozen visits and the remaining rights of way.
    void remove(const CyclicRight& right, DecisionId decision);
    void recompute(std::span<const CyclicRight> rights);

    // Visits with changed times; the caller clears the list.
    std::vector<Changed>& changed() { return changed_; }

  private:
    friend RaiseSearch<RollingTimetable, CyclicVisit>;

    struct Node {
        Tick enter;
        std::int32_t rights;  // the visit's latest right of way over others
    };
    struct Trial {  // a raise that may still be refused
        Tick raise;
        CyclicVisit cause;
    };
    struct Line {
        std::int32_t base = 0;  // the visit of nodes[0]
        std::int32_t start = 0;
        std::int32_t frozen = 1;
        std::int32_t end = 0;
        std::vector<Node> nodes;
        std::vector<Trial> trials;
    };
    struct Arc {
        CyclicVisit second;
        std::int32_t next;
        DecisionId decision;
    };
    struct Push {
        Tick delta;
        CyclicVisit visit;
        Tick enter;  // at least
        // Max-heap by delta; ties by visit.
        bool operator<(const Push& other) const {
            return delta != other.delta ? delta < other.delta : visit > other.visit;
        }
    };
    struct Run {
        RobotId robot;
        std::int32_t from;
        std::int32_t to;  // exclusive
        Tick delta;
    };

    Node& node(CyclicVisit visit) {
        return lines_[index(visit.robot)]
            .nodes[index(visit.number - lines_[index(visit.robot)].base)];
    }
    const Node& node(CyclicVisit visit) const {
        return lines_[index(visit.robot)]
            .nodes[index(visit.number - lines_[index(visit.robot)].base)];
    }
    Trial& trial(CyclicVisit visit) {
        return lines_[index(visit.robot)]
            .trials[index(visit.number - lines_[index(visit.robot)].base)];
    }
    std::int32_t find(CyclicVisit a, CyclicVisit b) const;
    void link(CyclicVisit a, CyclicVisit b, DecisionId decision);
    void forget_rights(Line& line, std::int32_t below);
    void run_freely(RobotId robot, std::int32_t from);
    Tick& raise(CyclicVisit visit) { return trial(visit).raise; }
    CyclicVisit& cause(CyclicVisit visit) { return trial(visit).cause; }
    template <class Use>
    void for_each_arc(CyclicVisit visit, Use&& use) const {
        if (visit.number < end(visit.robot)) {
            use(visit.next(), routes_.least(visit));
        }
        for (std::int32_t k = node(visit.before()).rights; k != none; k = arcs_[index(k)].next) {
            use(arcs_[index(k)].second, routes_.gap_before(arcs_[index(k)].second));
        }
    }
    void accept();
    void push(Tick delta, CyclicVisit visit);
    void run_on();
    void run_from(CyclicVisit visit, Tick delta);

    const CyclicRoutes& routes_;
    Tick begins_ = 0;
    Tick cut_ = 0;
    std::vector<Line> lines_;
    std::vector<Arc> arcs_;
    std::vector<std::int32_t> free_arcs_;
    std::vector<Run> runs_;
    std::vector<CyclicVisit> given_;  // first visits of rights of way, in order of giving
    std::vector<Changed> changed_;
    std::vector<DecisionId> cycle_decisions_;

    // Buffers of a change, reused to avoid allocation.
    std::vector<Push> pushes_;               // a heap
    std::vector<std::vector<Tick>> before_;  // per robot
};

}  // namespace rightofway
