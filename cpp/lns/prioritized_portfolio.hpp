// Planning robots in turn, patiently and in haste, whichever comes out better.
//
// Patience takes tracks away rather than drive a long way around. Where the floor is full that
// gives the better plan, and takes longer; where there is room, haste does. Whoever is there first
// is the net of the other, who goes on only while its plan still looks better. First is who has
// expanded fewer states; so what comes out depends neither on clocks nor on threads unless time
// runs out.
#pragma once

#include <atomic>
#include <cstdint>
#include <span>

#include "lns/fleet_plan.hpp"
#include "lns/prioritized.hpp"

namespace rightofway {

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
