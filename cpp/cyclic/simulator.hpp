// A group of robots that repeat their laps under a rule, until a state comes again.
//
// What a rule sees is a view that begins at a *cut*: all that has begun by then is frozen. It goes
// on until the *pacemaker* is home again, and what meets less than a *lag* after that is settled
// too before everything up to there is frozen, so that whoever still has to wait before a segment
// has not entered it yet. Where that was too little, some cuts are taken back and tried with a
// longer lag. The state at each cut is looked up among the earlier ones.
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
    RobotId pacemaker;    // cuts are made where this one is home, and at first
    Tick lag;             // how long after that meetings are settled
    Tick most_lag;        // no longer is tried
    Tick patience;        // a pacemaker that stays away longer is no pacemaker any more
    Tick reach;           // how long before a cut visits may have been left that still matter
    std::int32_t memory;  // how many cuts can be taken back
};

class CyclicSimulator {
  public:
    enum class End : std::int32_t { open = 0, repeats = 1, deadlock = 2 };
    // `loss` is what a tick of waiting costs each robot, above 0; only least_loss asks for it.
    // Throws std::invalid_argument if that does not fit.
    CyclicSimulator(const LapArrays& laps, const Horizon& pace, CyclicRule rule,
                    std::vector<std::int64_t> loss = {});
    CyclicSimulator(const CyclicSimulator&) = delete;  // its parts refer to each other
    CyclicSimulator& operator=(const CyclicSimulator&) = delete;

    // Goes on until a state comes again, or the rule runs into a deadlock, or it is over; it can go
    // on after that.
    End go_on(const StopCondition& is_over);

    // Forgets the states that were seen, so that it goes on where one came again.
    void forget() { seen_.clear(); }

    // Decides by another rule from now on, and forgets the states: they led elsewhere.
    void follow(CyclicRule rule);

    RobotId n_robots() const { return routes_.n_robots(); }
    Tick cut() const { return cut_; }
    Tick came_before() const { return came_before_; }  // the tick of the state that came again
    const VisitTimes& waits() const { return waits_; }

    // Of a deadlock: where and when two robots cannot be kept apart, and who would wait for whom.
    const Conflict& deadlock() const { return met_; }
    VertexId deadlock_at() const { return routes_.vertex(giving_.met()[0]); }
    std::span<const RobotId> circle() const { return giving_.circle(); }

  private:
    enum class Step { go_on, over, deadlock };

    // All that is needed to go back to a cut.
    struct Moment {
        Tick tick;
        std::vector<std::int32_t> n_begun;
        std::vector<BackjumpingOrder> orders;
    };

    bool begin();
    void show();
    void show_longer(Tick until);
    Step settle(const StopCondition& is_over);
    bool is_far_enough(Tick tick);
    void freeze();
    bool go_back();
    void return_to(const Moment& moment);
    void change_pacemaker();
    bool is_in_trouble() const { return cut_ < trouble_; }
    std::int32_t next_home(RobotId robot) const;
    Tick next_cut() const;
    Tick earliest_end() const;
    void write_state();
    void write_visit(CyclicVisit visit);
    void write_tick(Tick ticks);

    CyclicRoutes routes_;
    Horizon pace_;
    RollingTimetable timetable_;
    ConflictSweep meetings_;
    std::vector<std::int64_t> loss_;
    Backjumping giving_;
    VisitTimes waits_;
    SeenStates seen_;
    std::deque<Moment> past_;

    Tick cut_ = 0;
    Tick lag_;
    Tick trouble_ = 0;  // no cut before this is looked up
    std::size_t back_ = 1;
    bool has_begun_ = false;     // the view is at the cut
    bool has_returned_ = false;  // its rights of way have to be given again
    Tick end_ = 0;  // the earliest end of the view, as it was when it was last asked for
    std::vector<Tick> ahead_;
    std::vector<std::int32_t> shown_;
    std::vector<std::int32_t> state_;
    Tick came_before_ = 0;
    Conflict met_{};  // settled last
};

}  // namespace rightofway
