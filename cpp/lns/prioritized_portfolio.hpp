// Runs prioritized planning twice, patient and hasty, and keeps the better plan.
//
// Patient: evicting is cheap, detours are short; better and slower on full floors. Hasty: evicting
// is costly; better where there is room. The run that finishes first, counted in expanded states,
// is the fallback; the other run continues only while its projected flowtime is lower. So the
// outcome depends on neither clocks nor threads, unless time runs out.
#pragma once

#include <atomic>
#include <cstdint>
#include <span>

#include "distances/shared_distances.hpp"
#include "lns/fleet_plan.hpp"
#include "lns/prioritized.hpp"

namespace rightofway {

class PrioritizedPortfolio {
  public:
    // Borrows both. The plan has no tracks.
    PrioritizedPortfolio(SharedDistances& distances, FleetPlan& plan,
                         std::span<const RobotId> order);

    // Gives each robot a track within `n_searches` searches per run since the start. False if no
    // run is complete. Another call continues. Once the hasty plan is complete, `is_late` replaces
    // `is_over`; only the calling thread evaluates both. An exception on either thread comes back
    // when both have ended.
    bool run(std::int64_t n_searches, bool has_second_thread, const StopCondition& is_over,
             const StopCondition& is_late);

    // The better complete plan: the plan given, or another one.
    const FleetPlan& best() const;
    // Whether no run may find a better plan any more.
    bool has_ended() const;

  private:
    struct Side {
        void run(std::int64_t n_searches, const StopCondition& is_over);
        bool is_beaten_by(const Side& other) const;

        const FleetPlan& plan;
        Prioritized planner;
        std::atomic<bool> is_complete = false;  // the plan is complete; set by its thread
    };
    class SecondThread;

    bool is_hasty_better() const;

    FleetPlan& plan_;
    FleetPlan hasty_plan_;
    Side patient_;
    Side hasty_;
};

}  // namespace rightofway
