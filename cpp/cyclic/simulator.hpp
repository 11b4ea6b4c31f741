// Simulates a group of robots that repeat their laps under a rule, until a state recurs.
//
// The rule works on a window of visits that begins at a *cut*: all visits that have started by the
// cut are frozen. Conflicts are resolved up to a *lag* after the *pacemaker* is home again, so that
// a robot which still has to wait before a segment has not entered it yet; then everything up to
// that homecoming is frozen, and it is the next cut. Where the lag was too short, some cuts are
// undone and tried again with a longer one. The state at each cut is looked up among the earlier
// ones.
#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "core/search_end.hpp"
#include "core/types.hpp"
#include "cyclic/backjumping.hpp"
#include "cyclic/conflict_sweep.hpp"
#include "cyclic/cyclic_routes.hpp"
#include "cyclic/rolling_timetable.hpp"
#include "cyclic/seen_states.hpp"

namespace rightofway {

struct Horizon {
    RobotId pacemaker;    // at first, cuts are made where this robot is home
    Tick lag;             // conflicts are resolved so long after the next cut
    Tick most_lag;        // no longer lag is tried
    Tick patience;        // a pacemaker that stays away longer is replaced
    Tick reach;           // visits left so long before a cut still matter
    std::int32_t memory;  // how many cuts can be undone
};

class CyclicSimulator {
  public:
    enum class End : std::int32_t { open = 0, repeats = 1, deadlock = 2 };

    // `loss` is the cost of a tick of waiting for each robot, above 0; only least_loss needs it.
    // Throws std::invalid_argument if that does not fit.
    CyclicSimulator(const LapArrays& laps, const Horizon& horizon, CyclicRule rule,
                    std::vector<std::int64_t> loss = {});
    CyclicSimulator(const CyclicSimulator&) = delete;  // its parts refer to each other
    CyclicSimulator& operator=(const CyclicSimulator&) = delete;

    // Simulates until a state recurs, the rule runs into a deadlock, or it is over. It can be
    // called again after each of these.
    End advance(const StopCondition& is_over);

    // Forgets the states seen, so that it advances beyond one that has recurred.
    void reset_states() { seen_.clear(); }

    // Decides by another rule from now on, and resets the states: they led elsewhere.
    void set_rule(CyclicRule rule);

    RobotId n_robots() const { return routes_.n_robots(); }
    // Of a state that has recurred: when it was seen first, and the present cut.
    Tick first_seen() const { return first_seen_; }
    Tick cut() const { return cut_; }
    const VisitTimes& visit_times() const { return past_; }

    // Of a deadlock: the conflict that cannot be resolved, its vertex, and the robots that would
    // each wait for the next.
    const Conflict& deadlock() const { return conflict_; }
    VertexId deadlock_at() const { return routes_.vertex(decisions_.conflict_visit()); }
    std::span<const RobotId> waiting_cycle() const { return decisions_.waiting_cycle(); }

  private:
    enum class Step { done, over, deadlock };

    // All that is needed to return to a cut.
    struct Snapshot {
        Tick cut;
        std::vector<std::int32_t> n_started;
        std::vector<SegmentOrder> orders;
    };

    bool start_window();
    void extend_window();
    Step resolve_conflicts(const StopCondition& is_over);
    bool is_in_window(Tick tick);
    void freeze_to_next_cut();
    bool undo_cuts();
    void restore(const Snapshot& snapshot);
    void replace_pacemaker();
    bool is_retrying() const { return cut_ < retried_until_; }
    std::int32_t next_home(RobotId robot) const;
    Tick next_cut() const;
    Tick window_end() const;
    void write_state();

    CyclicRoutes routes_;
    Horizon horizon_;
    RollingTimetable timetable_;
    ConflictSweep conflicts_;
    std::vector<std::int64_t> loss_;
    Backjumping decisions_;
    VisitTimes past_;
    SeenStates seen_;
    std::deque<Snapshot> snapshots_;

    Tick cut_ = 0;
    Tick lag_;
    Tick retried_until_ = 0;  // no cut before this is looked up
    std::size_t n_to_undo_ = 1;
    bool has_window_ = false;   // the window is at the cut
    bool is_restored_ = false;  // its rights of way have to be given again
    Tick window_end_ = 0;       // as it was when last asked for; it only moves later
    std::vector<Tick> lookahead_;
    std::vector<std::int32_t> ends_;
    std::vector<std::int32_t> state_;
    Tick first_seen_ = 0;
    Conflict conflict_{};  // resolved last
};

}  // namespace rightofway
