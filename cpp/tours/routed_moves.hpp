// Local search over tours and routes together: a move of few jobs is judged by its planned cost.
//
// A search for tours proposes a change of few tours (`TourSearch::propose`). The tracks of their
// robots are removed, and planned again for the new tours, one after another in random order,
// around the bookings of all others. Where a robot finds no track, it may evict others, which are
// planned again at the end. In other moves the tours stay, and some robots near each other are
// planned again. Simulated annealing by the planned cost accepts a move, or all tracks come back.
// The temperature falls over a cycle of moves; each cycle is longer than the one before and starts
// from the best plan.
//
// The problem has no arcs between stages: which jobs follow others is known from the tours.
//
// Ropke & Pisinger, "An adaptive large neighborhood search heuristic for the pickup and delivery
// problem with time windows", Transportation Science 2006 (moves of jobs). Li, Chen, Harabor,
// Stuckey & Koenig, "Anytime multi-agent path finding via large neighborhood search", IJCAI 2021
// (few robots planned again).
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <span>
#include <vector>

#include "core/random.hpp"
#include "distances/trip.hpp"
#include "lns/fleet_search.hpp"
#include "search/sipp.hpp"
#include "tours/tour_search.hpp"

namespace rightofway {

// How tours become stages. Costs of ends are those of search keys; empty: ends cost nothing.
struct RoutedTours {
    std::span<const VertexId> vertex_of;  // of each place
    std::span<const Tick> turn_of;        // of each robot, after a stop
    std::span<const std::int32_t> stops;  // of each stage: a charge or the last one is -1
    std::span<const Tick> ends;           // of each stage in the tracks given
    std::span<const Tick> completions;    // of each robot
    std::span<const Tick> cost;           // of a tick of the end of each job
    std::span<const Tick> late_cost;
};

class RoutedMoves {
  public:
    // Borrows the searches; all robots of the fleet have tracks, and the best tours are theirs.
    // Throws std::invalid_argument if the arrays do not fit.
    RoutedMoves(const FleetSearch& fleet, TourSearch& tours, const RoutedTours& given,
                std::uint64_t seed);

    // Tries moves until the end of a cycle, or one of the numbers is reached: of moves, of gains.
    // The number of moves that were tried.
    std::int64_t run(std::int64_t n_moves, std::int64_t most_gains, const StopCondition& is_over);

    std::size_t n_robots() const { return routed_.size(); }
    std::int64_t n_gains() const { return n_gains_; }
    // Goes back to the best plan, for the functions below.
    void finish();
    Tracks tracks() const { return plan_.tracks(); }
    // The items of a robot's tour: stops, and charges as -1.
    struct Items {
        std::span<const std::int32_t> stops;
        std::span<const VertexId> vertices;
        std::span<const Tick> ticks;
    };
    Items items(RobotId robot) const;
    bool has_changed(RobotId robot) const { return best_[index(robot)].has_changed; }

  private:
    struct Routed {  // stages of a robot and when its track serves them
        std::vector<std::int32_t> stop;
        std::vector<VertexId> vertex;
        std::vector<Tick> work;
        std::vector<Tick> turn;
        std::vector<Tick> earliest;
        std::vector<Tick> latest;
        std::vector<Tick> cost;
        std::vector<Tick> late_cost;
        std::vector<Tick> due;
        std::vector<Tick> ends;
        Tick completion = 0;
        Tick surcharges = 0;
        std::int64_t service = 0;
        Tick track_cost = 0;       // as the search counts
        bool has_changed = false;  // since the tour that was given
    };
    struct Touched {  // what a robot had before a move
        RobotId robot;
        Routed routed;
        TimedTrack track;
    };
    struct Cost {
        std::int64_t n_missing = 0;
        std::int64_t unserved = 0;
        std::int64_t value = 0;
        std::int64_t flowtime = 0;
        auto operator<=>(const Cost&) const = default;
    };

    void take(const RoutedTours& given);
    void add_stage(Routed& routed, std::int32_t stop, VertexId vertex, Tick work,
                   RobotId robot) const;
    void add_last_stage(Routed& routed, RobotId robot) const;
    Routed read_tour(RobotId robot, const Tour& tour) const;
    void settle_costs(RobotId robot, Routed& routed) const;
    void note_ends(RobotId robot);
    void expect_ends(RobotId robot);
    std::int32_t choose_job();
    bool try_move(const StopCondition& is_over);
    std::vector<RobotId> change_tours();
    std::vector<RobotId> choose_near();
    void add_near(RobotId robot, std::vector<RobotId>& robots);
    bool accepts(const Cost& cost);
    double energy(const Cost& cost) const;
    void keep_best();
    void touch(RobotId robot);
    bool place_all(const StopCondition& is_over);
    bool place(RobotId robot, const StopCondition& is_over);
    bool evict_conflicting();
    bool find(RobotId robot, bool may_evict, const StopCondition& is_over);
    const Trip& read_trip(RobotId robot);
    void limit_stages(RobotId robot);
    bool keeps_order() const;
    bool serves_the_same() const;
    Cost cost_of(const TourPlan& tours) const;
    void hold(RobotId robot, bool is_held);
    void undo();
    Tick first_hold(RobotId robot) const;

    const Problem& problem_;
    TourSearch& tours_;
    const TourProblem& jobs_;
    std::vector<VertexId> vertex_of_;
    std::vector<Tick> turn_of_;
    std::vector<Tick> job_cost_;
    std::vector<Tick> job_late_cost_;
    SharedDistances distances_;
    FleetPlan plan_;
    SafeIntervalSearch search_;
    Random random_;
    std::vector<Routed> routed_;
    std::vector<Tick> begin_;     // of each job, as planned
    std::vector<Tick> end_;       // the same
    std::vector<Tick> expected_;  // end of each job in its tour
    Cost cost_;
    std::int64_t n_gains_ = 0;
    std::int64_t cycle_done_ = 0;
    std::int64_t cycle_length_ = 0;
    // The best plan.
    TourPlan best_tours_;
    std::vector<Routed> best_;
    std::vector<TimedTrack> best_tracks_;
    std::vector<std::uint8_t> is_since_best_;  // robots that may differ from it
    Cost best_cost_;
    // Of the move at hand.
    bool has_proposal_ = false;  // of tours
    std::vector<Touched> touched_;
    std::vector<std::uint8_t> is_touched_;
    std::deque<RobotId> waiting_;
    std::vector<std::uint8_t> is_waiting_;
    std::vector<std::int32_t> n_evictions_;
    std::vector<Tick> prices_;
    std::vector<RobotId> conflicting_;
    TimedTrack found_;
    Trip trip_;
    std::vector<std::shared_ptr<const DistanceTable>> tables_;
    std::vector<Tick> earliest_;
    std::vector<Tick> latest_;
    bool is_limited_ = false;
    Tick slack_ = 0;  // what the tracks still to be found may cost together
};

}  // namespace rightofway
