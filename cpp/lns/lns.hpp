// Anytime improvement of one plan by large neighbourhood search, on several threads.
//
// Again and again a few robots give up their tracks and get new ones, one after another in random
// order, half of the time with the one first for whose sake they were chosen; the better plan
// stays. Work goes in rounds of a fixed number of tasks. Each task draws from a stream of its own,
// made of seed, round and place in the round, and starts from the plan at the beginning of the
// round; each thread has a replica of the plan. After a round the results are taken in their order,
// as far as they still fit together. So the outcome depends on the seed and the number of tasks,
// not on threads or their speed.
//
// Li et al., "Anytime multi-agent path finding via large neighborhood search", IJCAI 2021.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "core/task_crew.hpp"
#include "lns/fleet_plan.hpp"
#include "lns/neighbourhoods.hpp"
#include "search/sipp.hpp"

namespace rightofway {

class Lns {
  public:
    // Borrows all; every robot of the plan has a track. `alone` is the least completion of each.
    Lns(SharedDistances& distances, FleetPlan& plan, std::span<const Tick> alone,
        std::uint64_t seed, std::size_t n_threads);
    ~Lns();

    // Does that many tasks; less after `patience` of them in a row without a gain, if `is_over`
    // says so, or after the first round that ends when `is_due` does. Both are asked by the calling
    // thread only. What `is_over` throws is passed on when the plan is whole again.
    void run(std::int64_t n_tasks, std::int64_t patience, const StopCondition& is_over,
             const StopCondition& is_due);

    std::int64_t n_tasks() const { return n_tasks_; }
    std::int64_t n_idle() const { return n_idle_; }  // since the last gain
    std::int64_t n_expanded() const;

  private:
    static constexpr std::array<std::size_t, 3> sizes{4, 8, 16};

    struct Task {
        std::vector<RobotId> robots;
        std::vector<TimedTrack> tracks;
        std::size_t neighbourhood = 0;  // its kind and size
        Tick gain = -1;                 // below 0: nothing found
        std::int64_t effort = 0;
    };
    struct Worker;

    void round(std::size_t n, const StopCondition& is_over);
    void attempt(Worker& worker, Task& task, Random& random, const StopCondition& is_over);
    void replan(Worker& worker, Task& task, const StopCondition& is_over);
    void settle(std::size_t n);
    bool adopt(Task& task, bool may_clash);

    FleetPlan& plan_;
    std::span<const Tick> alone_;
    std::uint64_t seed_;
    std::vector<FleetPlan> replicas_;
    std::vector<std::unique_ptr<Worker>> workers_;
    std::vector<Task> tasks_;
    std::vector<std::uint8_t> is_touched_;
    AdaptiveChoice neighbourhood_;
    TaskCrew crew_;
    std::uint64_t n_rounds_ = 0;
    std::int64_t n_tasks_ = 0;
    std::int64_t n_idle_ = 0;
};

}  // namespace rightofway
