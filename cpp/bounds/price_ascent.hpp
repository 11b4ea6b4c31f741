// A lower bound of all plans by prices: the Lagrangian relaxation of the rule that robots do not
// book one vertex at one tick, nor swap on a lane.
//
// At any prices, each robot pays at least what its track of least priced cost does (priced_track),
// and all robots together pay a price at most once. So the sum of these least priced costs, less
// the sum of all prices, is a bound. Subgradient steps raise it: a place at a tick gets dearer
// where several robots want it, and cheaper where nobody does.
//
// Held, Wolfe & Crowder, "Validation of subgradient optimization", Mathematical Programming 6,
// 1974. Lam, Le Bodic, Harabor & Stuckey, "Branch-and-cut-and-price for multi-agent path finding",
// Computers & Operations Research 144, 2022 (the same relaxation by column generation).
#pragma once

#include <cstdint>
#include <vector>

#include "bounds/priced_track.hpp"
#include "core/search_end.hpp"
#include "distances/shared_distances.hpp"
#include "problem/problem.hpp"

namespace rightofway {

class PriceAscent {
  public:
    // Borrows the problem.
    explicit PriceAscent(const Problem& problem);

    // Takes up to `steps` steps. False: stopped; the bound holds all the same.
    bool run(std::int64_t steps, const StopCondition& is_over);

    // No plan costs less, by the weights of the robots and with surcharges; 0 before the first
    // step.
    Tick bound() const { return (std::max<Tick>(best_, 0) + parts_per_tick - 1) / parts_per_tick; }
    std::int64_t n_steps() const { return n_steps_; }
    // No step is left that would change a price: the tracks have no conflict, or steps got too
    // small.
    bool is_over() const { return is_done_; }

  private:
    struct Stay {
        Booking time;
        RobotId robot;
    };

    bool price(const StopCondition& is_over);
    void count();
    void find_conflicts();
    void step();

    const Problem& problem_;
    SharedDistances distances_;
    std::vector<TripReader> trips_;
    PricedSearch search_;
    Prices prices_;
    Prices best_prices_;
    std::vector<PricedTrack> tracks_;
    std::vector<std::vector<Stay>> stays_;   // by vertex
    std::vector<std::vector<Stay>> drives_;  // by lane, [arrival, arrival + 1)
    Tick value_ = 0;
    Tick best_ = -1;
    double hoped_ = 0;  // how far above the best bound the target of a step is
    int patience_;
    int n_idle_ = 0;
    std::int64_t n_steps_ = 0;
    bool is_done_ = false;
};

}  // namespace rightofway
