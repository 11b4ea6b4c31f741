// A memetic algorithm: crossover of several plans of one fleet and LNS, for a plan that is stuck.
//
// A local optimum of LNS is far from the best plan: other seeds end in plans of similar flowtime
// with other rights of way. Crossover: in a copy of the parent, a group of robots takes the tracks
// of a second plan (the mate). The robots of the group conflict with each other across the two
// plans, so a single robot could hardly change its track. Other robots in conflict with the group
// are replanned. LNS then improves the child before the child competes with its parent.
//
// The first members are variants of one plan with more than half of the robots replanned. Each
// child has its own random stream, and children are inserted in order, so the outcome depends on
// the seed and the number of tasks, not on the threads.
//
// Moscato & Norman, "A memetic approach for the traveling salesman problem", 1992. Prins, "A simple
// and effective evolutionary algorithm for the vehicle routing problem", Computers & Operations
// Research 2004.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/random.hpp"
#include "core/task_crew.hpp"
#include "distances/shared_distances.hpp"
#include "lns/fleet_plan.hpp"

namespace rightofway {

class Population {
  public:
    // Borrows all; every robot needs a track. `alone`: completion time of each robot driving alone.
    // `n_idle`: number of tasks without a gain before the start.
    Population(SharedDistances& distances, FleetPlan& plan, std::span<const Tick> alone,
               std::uint64_t seed, std::size_t n_threads, std::int64_t n_idle);

    // Improves children with `n_tasks` tasks of `Lns` in all. Stops early after `patience` tasks in
    // a row without a better plan, once `is_over` is true, or between generations if `is_due` is
    // true. Only the calling thread evaluates both. Rethrows an exception of `is_over` or a task.
    void run(std::int64_t n_tasks, std::int64_t patience, const StopCondition& is_over,
             const StopCondition& is_due);

    std::int64_t n_tasks() const { return n_tasks_; }
    std::int64_t n_idle() const { return n_idle_; }  // since the last gain
    std::int64_t n_expanded() const { return n_expanded_; }

  private:
    struct Child {
        FleetPlan plan;
        std::int64_t most_tasks = 0;
        std::int64_t n_tasks = 0;  // tasks done
        std::int64_t n_expanded = 0;
        bool is_whole = false;  // every robot has a track
    };

    bool has_all_members() const;
    std::size_t begin_generation(std::int64_t n_tasks);
    void make_child(std::size_t k, const StopCondition& is_over);
    bool vary(Child& child, std::size_t parent, Random& random, const StopCondition& is_over);
    std::vector<RobotId> cross_over(FleetPlan& plan, const FleetPlan& mate,
                                    std::span<const RobotId> differing, Random& random) const;
    void insert_children(std::size_t n_children);

    SharedDistances& distances_;
    FleetPlan& plan_;  // the best
    std::span<const Tick> alone_;
    std::uint64_t seed_;
    std::vector<FleetPlan> members_;
    std::vector<Child> children_;
    TaskCrew crew_;
    std::uint64_t n_generations_ = 0;
    std::int64_t n_tasks_ = 0;
    std::int64_t n_idle_;
    std::int64_t n_expanded_ = 0;
};

}  // namespace rightofway
