// A first plan, one robot after another: each gets the best track among those that have one.
//
// The home of a robot without a track is kept free for a while, so that it can leave. A track may
// run across others, at a price for each; those robots lose their tracks and queue again. The more
// often a robot has lost its track, the more it costs to take it away and the longer its home is
// kept free, so that in the end somebody else gives way, or lets it out first (ejection chains with
// a memory).
//
// A way may lead through the homes of robots that lose their tracks by it and could not have got
// out in time. Looking for it once more, with these homes kept free, settles neighbours who would
// take away each other's tracks for ever; but two who must change places may need just such a way.
// So a robot that has lost its own track does so every other time, drawn by lot, which also keeps
// several from going round in step.
//
// Silver, "Cooperative pathfinding", AIIDE 2005; Andreychuk & Yakovlev, "Two techniques that
// enhance the performance of multi-robot prioritized path planning", AAMAS 2018 (start holds);
// Nagata & Braysy, "A powerful route minimization heuristic for the vehicle routing problem with
// time windows", Operations Research Letters 2009 (ejection).
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "core/random.hpp"
#include "core/search_end.hpp"
#include "lns/fleet_plan.hpp"
#include "search/sipp.hpp"

namespace rightofway {

// What it costs to take a robot's track away, in first holds of its home: at first, and how much
// more each time. Both rise by a quarter each time so many states have been expanded, so that
// planning comes to an end where the floor is full. The dearer, the sooner a search is content with
// a way around, and the longer that.
struct TrackPrices {
    Tick first;
    Tick dearer;
    std::int64_t states_between_raises;
};
constexpr TrackPrices patient{3, 2, 1'000'000};
constexpr TrackPrices hasty{12, 6, 300'000};

class Prioritized {
  public:
    // Borrows both. The robots that are to get tracks have none yet.
    Prioritized(SharedDistances& distances, FleetPlan& plan, const TrackPrices& prices = patient);

    // Robots are to get tracks in that order.
    void start(std::span<const RobotId> order);

    // Gives them tracks, until so many searches were made since the start. `stopped` means that
    // some are without a track; it can go on from there.
    SearchEnd run(std::int64_t n_searches, const StopCondition& is_over);

    // The most that the flowtime has looked like since the start, where each robot is expected to
    // be complete as late as by its last track, or as alone.
    Tick highest_outlook() const { return highest_outlook_; }
    std::int64_t n_expanded() const { return search_.n_expanded(); }

  private:
    bool place(RobotId robot, const StopCondition& is_over);
    bool find(RobotId robot, const StopCondition& is_over);
    bool evict_those_met();
    bool crosses_their_homes(RobotId robot);
    void evict(RobotId robot);
    void raise_prices();
    void keep_home(RobotId robot);
    Tick first_hold(RobotId robot) const;
    bool has_lost(RobotId robot) const { return n_lost_[static_cast<std::size_t>(robot)] > 0; }

    SharedDistances& distances_;
    const Problem& problem_;
    FleetPlan& plan_;
    TrackPrices track_prices_;
    SafeIntervalSearch search_;
    TripReader reader_;
    std::deque<RobotId> waiting_;
    std::vector<Tick> prices_;
    std::vector<std::int32_t> n_lost_;  // how often a robot has lost its track
    std::vector<Tick> expected_;        // completions
    Random random_{0};
    std::vector<RobotId> met_;
    std::vector<RobotId> evicted_;
    TimedTrack track_;
    std::int64_t n_searches_ = 0;
    Tick outlook_ = 0;
    Tick highest_outlook_ = 0;
    std::int64_t next_raise_;  // at so many states
    double level_ = 1;         // of prices
};

// Planning robots in turn, patiently and in haste, whichever comes out better.
//
// Patience takes tracks away rather than drive a long way around. Where the floor is full that
// gives the better plan, and takes longer; where there is room, haste does. Whoever is there first
// is the net of the other, who goes on only while its plan still looks better. First is who has
// expanded fewer states; so what comes out depends neither on clocks nor on threads unless time
// runs out.
class PrioritizedPortfolio {
  public:
    // Borrows both. The plan is without tracks.
    PrioritizedPortfolio(SharedDistances& distances, FleetPlan& plan,
                         std::span<const RobotId> order);

    // Gives all robots a track each, in at most so many searches since the beginning. False if that
    // does not work out, with the plan in an unknown state; it can go on from there. Once there is
    // a plan made in haste, `is_late` is asked instead of `is_over`; both by the calling thread.
    bool run(std::int64_t n_searches, bool has_second_thread, const StopCondition& is_over,
             const StopCondition& is_late);

  private:
    struct Side {
        void run(std::int64_t n_searches, const StopCondition& is_over);
        bool is_beaten_by(const Side& other) const;

        const FleetPlan& plan;
        Prioritized planner;
        std::atomic<bool> is_there = false;  // told by the thread that plans, when it is
    };
    class Beside;

    bool is_hasty_better() const;

    FleetPlan& plan_;
    FleetPlan plan_in_haste_;
    Side patient_;
    Side hasty_;
};

}  // namespace rightofway
