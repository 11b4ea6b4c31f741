// Prioritized planning of a first plan: each robot gets the best track among earlier tracks.
//
// The home of a robot without a track stays booked for a while (start hold), so the robot can
// leave. A track may conflict with earlier tracks at a price per robot; those robots are evicted
// (they lose their tracks) and queue again. Each eviction of a robot raises its price and lengthens
// its start hold, so in the end another robot gives way or lets it out first (ejection chains with
// memory).
//
// A track may pass the homes of robots that it evicts, which could not have left in time. A second
// search with these homes booked ends endless mutual evictions of neighbours; but two robots that
// must change places may need the first track. So a robot evicted before searches again with
// probability 1/2, which also breaks cycles of several robots.
//
// A robot that ends anywhere avoids vertices at which others have stages, as far as the price of an
// eviction goes: there it would have to give way later.
//
// Where a stage of one robot waits for one of another, its earliest begin is the end in the track
// of the other, or the end expected of it. A robot whose stage begins before a new track ends what
// it waits for is evicted. Tours and arcs have no cycle, so ends rise to what the stages before
// them need.
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

#include "core/random.hpp"
#include "core/search_end.hpp"
#include "lns/fleet_plan.hpp"
#include "search/sipp.hpp"

namespace rightofway {

// The price of evicting a robot, in units of its first start hold: `first`, plus `dearer` for each
// eviction. Both rise by 25 % per `states_between_raises` expanded states, so planning ends on full
// floors, too. Greater prices and more greed end a search sooner, with longer detours.
struct TrackPrices {
    Tick first;
    Tick dearer;
    std::int64_t states_between_raises;
    Tick greed = 1;  // see `SearchRequest`
};
constexpr TrackPrices patient{3, 2, 1'000'000};
constexpr TrackPrices hasty{12, 6, 300'000};
constexpr TrackPrices greedy{6, 2, 1000, 64};  // states for each robot of the fleet

class Prioritized {
  public:
    // Borrows both. The robots to be planned have no tracks yet; others may have one, and lose it
    // if they are in the way.
    Prioritized(SharedDistances& distances, FleetPlan& plan, const TrackPrices& prices = patient);

    // Queues robots in this order.
    void start(std::span<const RobotId> order);

    // Plans the queued robots, with at most `n_searches` robots taken from the queue since the
    // start. `stopped`: some robots have no track; another call continues.
    SearchEnd run(std::int64_t n_searches, const StopCondition& is_over);

    // The greatest projected flowtime since the start: the sum of each robot's completion time by
    // its last track, or alone if it had none.
    Tick highest_outlook() const { return highest_outlook_; }
    std::int64_t n_expanded() const { return search_.n_expanded(); }

  private:
    void close_starts(bool are_closed);
    SearchEnd place_all(std::int64_t n_searches, const StopCondition& is_over);
    bool place(RobotId robot, const StopCondition& is_over);
    bool place_open(RobotId robot, const StopCondition& is_over);
    bool find(RobotId robot, const StopCondition& is_over);
    bool evict_conflicting();
    bool conflicts_with_start_holds(RobotId robot);
    void evict(RobotId robot);
    void raise_prices();
    void keep_home(RobotId robot);
    Tick first_hold(RobotId robot) const;
    bool was_evicted(RobotId robot) const { return n_evictions_[index(robot)] > 0; }

    SharedDistances& distances_;
    const Problem& problem_;
    FleetPlan& plan_;
    TrackPrices track_prices_;
    SafeIntervalSearch search_;
    TripReader reader_;
    std::deque<RobotId> waiting_;
    std::vector<Tick> prices_;
    std::vector<std::int32_t> n_evictions_;  // evictions of each robot
    std::vector<Tick> expected_;             // projected completion times
    Random random_{0};
    std::vector<RobotId> conflicting_;
    std::vector<RobotId> evicted_;
    TimedTrack track_;
    StageLimits limits_;
    std::int64_t n_searches_ = 0;
    Tick outlook_ = 0;
    Tick highest_outlook_ = 0;
    std::int64_t next_raise_;  // [expanded states]
    double level_ = 1;         // of prices
};

}  // namespace rightofway
