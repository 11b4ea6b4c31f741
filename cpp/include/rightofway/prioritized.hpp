// A first plan, one robot after another: each gets the best track among those that have one.
//
// The home of a robot without a track is kept free for a while, so that it can leave. A track may
// run across others, at a price for each; those robots lose their tracks and queue again. The more
// often a robot has lost its track, the more it costs to take it away and the longer its home is
// kept free, so that in the end somebody else gives way, or lets it out first (ejection chains with
// a memory).
//
// Silver, "Cooperative pathfinding", AIIDE 2005; Andreychuk & Yakovlev, "Two techniques that
// enhance the performance of multi-robot prioritized path planning", AAMAS 2018 (start holds);
// Nagata & Braysy, "A powerful route minimization heuristic for the vehicle routing problem with
// time windows", Operations Research Letters 2009 (ejection).
#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "rightofway/fleet_plan.hpp"
#include "rightofway/safe_interval_search.hpp"
#include "rightofway/search_end.hpp"

namespace rightofway {

// What it costs to take a robot's track away, in first holds of its home: at first, and how much
// more each time. All prices rise by a quarter each time so many states have been expanded, so that
// planning comes to an end where the floor is full. The dearer, the sooner a search is content with
// a way around, and the longer that.
struct TrackPrices {
    Tick first;
    Tick dearer;
    std::int64_t states_between_raises;
};
constexpr TrackPrices patient{3, 2, 1'000'000};
constexpr TrackPrices hasty{100, 50, 100'000};

class Prioritized {
  public:
    // Borrows both. The robots that are to get tracks have none yet.
    Prioritized(const Fleet& fleet, FleetPlan& plan, const TrackPrices& prices = patient);

    // Robots are to get tracks in that order.
    void start(std::span<const RobotId> order);

    // Gives them tracks, until so many searches were made since the start. `stopped` means that
    // some are without a track; it can go on from there.
    SearchEnd run(std::int64_t n_searches, const SafeIntervalSearch::IsOver& is_over);

    std::int64_t n_evictions() const { return n_evictions_; }
    std::int64_t n_expanded() const { return search_.n_expanded(); }

  private:
    bool place(RobotId robot, const SafeIntervalSearch::IsOver& is_over);
    void evict(RobotId robot);
    void raise_prices();
    Tick first_hold(RobotId robot) const;

    const Fleet& fleet_;
    FleetPlan& plan_;
    TrackPrices track_prices_;
    SafeIntervalSearch search_;
    TripReader reader_;
    std::deque<RobotId> waiting_;
    std::vector<Tick> prices_;
    std::vector<Tick> holds_;
    std::vector<RobotId> met_;
    TimedTrack track_;
    std::int64_t n_searches_ = 0;
    std::int64_t n_evictions_ = 0;
    std::int64_t next_raise_;  // at so many states
};

}  // namespace rightofway
