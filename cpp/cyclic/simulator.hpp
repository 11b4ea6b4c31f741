// Simulates a group of robots that repeat their laps under a lap rule, until a state recurs.
//
// Rolling horizon: the rule works on a window of visits from a *cut* on; visits started by the cut
// are frozen. The next cut is the tick at which the *pacemaker* returns home. Conflicts are
// resolved up to a *lag* after the next cut, so that a robot that has to wait before a segment has
// not entered the segment yet; then visits started by the next cut are frozen. After a deadlock,
// some cuts are undone and repeated with a longer lag. The state at each cut is compared with the
// states at earlier cuts.
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
#include "cyclic/visit_times.hpp"

namespace rightofway {

struct Horizon {
    RobotId pacemaker;    // initial pacemaker: each of its returns home is a cut
    Tick lag;             // conflicts are resolved up to this many ticks after the next cut; >= 1
    Tick most_lag;        // upper limit of the lag, in ticks
    Tick patience;        // a pacemaker away from home for more ticks is replaced; >= 0
    Tick reach;           // ticks that the window begins before the cut; >= 0
    std::int32_t memory;  // number of cuts that can be undone; >= 1
};

class CyclicSimulator {
  public:
    enum class End : std::int32_t { open = 0, repeats = 1, deadlock = 2 };

    // `loss`: cost per tick of waiting, one entry > 0 per robot; required by least_loss only.
    // Throws std::invalid_argument on an invalid argument.
    CyclicSimulator(const LapArrays& laps, const Horizon& horizon, CyclicRule rule,
                    std::vector<std::int64_t> loss = {});
    CyclicSimulator(const CyclicSimulator&) = delete;  // members refer to each other
    CyclicSimulator& operator=(const CyclicSimulator&) = delete;

    // Simulates until a state recurs, a deadlock remains at the longest lag, or `is_over`. Callable
    // again after each of these ends.
    End advance(const StopCondition& is_over);

    // Forgets the states seen, so that advance() continues after a recurrence.
    void reset_states() { seen_.clear(); }

    // Changes the rule from the current cut on, and resets the states, which depend on the rule.
    void set_rule(CyclicRule rule);

    RobotId n_robots() const { return routes_.n_robots(); }
    // Of a recurred state: the tick of its first occurrence, and the current cut.
    Tick first_seen() const { return first_seen_; }
    Tick cut() const { return cut_; }
    const VisitTimes& visit_times() const { return past_; }

    // How the latest advance() ended.
    End end() const { return end_; }

    // Of a deadlock: the conflict that cannot be resolved, its vertex, and the robots, each of
    // which would wait for the next.
    const Conflict& deadlock() const { return conflict_; }
    VertexId deadlock_at() const {
        return routes_.id_of(routes_.vertex(decisions_.conflict_visit()));
    }
    std::span<const RobotId> waiting_cycle() const { return decisions_.waiting_cycle(); }

  private:
    enum class Step { done, over, deadlock };

    // The data to return to a cut.
    struct Snapshot {
        Tick cut;
        std::vector<std::int32_t> n_started;
        std::vector<SegmentOrder> orders;
    };

    End run(const StopCondition& is_over);
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

    End end_ = End::open;
    Tick cut_ = 0;
    Tick lag_;
    Tick retried_until_ = 0;  // cuts before this tick are not compared with earlier states
    std::size_t n_to_undo_ = 1;
    bool has_window_ = false;   // the window begins at the cut
    bool is_restored_ = false;  // rights of way have to be given again
    Tick window_end_ = 0;       // cached; the window's end only moves later
    std::vector<Tick> lookahead_;
    std::vector<std::int32_t> ends_;
    std::vector<std::int32_t> state_;
    Tick first_seen_ = 0;
    Conflict conflict_{};  // the last resolved
};

}  // namespace rightofway
