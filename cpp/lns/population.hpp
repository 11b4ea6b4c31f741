// Improvement of several plans of one fleet, crossed with each other, where one alone is stuck.
//
// A plan that no small neighbourhood makes better is still far from the best: other seeds end in
// plans about as good, in which robots settle their conflicts another way. A child is a plan in
// which some robots take over their tracks from a second plan. Those are robots that are in each
// other's way between the two plans: each of them could hardly change sides alone. Whoever else is
// then in the way is planned anew, and the child is improved before it has to stand beside its
// parents.
//
// The first members come from one plan by planning more than half of the robots anew. Each child
// draws from a stream of its own and they are taken up in their order, so what comes out depends on
// the seed and the number of tasks, not on threads or their speed.
//
// Moscato & Norman, "A memetic approach for the traveling salesman problem", 1992. Prins, "A simple
// and effective evolutionary algorithm for the vehicle routing problem", Computers & Operations
// Research 2004.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/random.hpp"
#include "core/task_crew.hpp"
#include "distances/shared_distances.hpp"
#include "lns/fleet_plan.hpp"
#include "lns/lns.hpp"

namespace rightofway {

class Population {
  public:
    // Borrows all; every robot of the plan has a track. `alone` is the least completion of each,
    // `n_idle` after how many tasks without a gain this begins.
    Population(SharedDistances& distances, FleetPlan& plan, std::span<const Tick> alone,
               std::uint64_t seed, std::size_t n_threads, std::int64_t n_idle);

    // Brings up children with that many tasks of an `Lns` in all; with less after `patience`
    // of them in a row without a better plan, if `is_over` says so, or when `is_due` does between
    // generations. Both are asked by the calling thread only. What `is_over` throws is passed on.
    void run(std::int64_t n_tasks, std::int64_t patience, const StopCondition& is_over,
             const StopCondition& is_due);

    std::int64_t n_tasks() const { return n_tasks_; }
    std::int64_t n_idle() const { return n_idle_; }  // since the last gain
    std::int64_t n_expanded() const { return n_expanded_; }

  private:
    struct Child {
        FleetPlan plan;
        std::int64_t most_tasks = 0;
        std::int64_t n_tasks = 0;  // that were done
        std::int64_t n_expanded = 0;
        bool is_whole = false;  // every robot has a track
    };

    bool has_all_members() const;
    std::size_t begin_generation(std::int64_t n_tasks);
    void bring_up(std::size_t k, const StopCondition& is_over);
    bool vary(Child& child, std::size_t parent, Random& random, const StopCondition& is_over);
    std::vector<RobotId> take_over(FleetPlan& plan, const FleetPlan& mate,
                                   std::span<const RobotId> differing, Random& random) const;
    void take_up(std::size_t n_children);

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

// Improvement of a plan: of that one alone until it is stuck, then of a population.
class AnytimeLns {
  public:
    // Borrows all; every robot of the plan has a track. `alone` is the least completion of each.
    AnytimeLns(SharedDistances& distances, FleetPlan& plan, std::span<const Tick> alone,
               std::uint64_t seed, std::size_t n_threads);

    // As `Lns::run`.
    void run(std::int64_t n_tasks, std::int64_t patience, const StopCondition& is_over,
             const StopCondition& is_due);

    std::int64_t n_tasks() const;
    std::int64_t n_idle() const;  // since the last gain
    std::int64_t n_expanded() const;

  private:
    SharedDistances& distances_;
    FleetPlan& plan_;
    std::span<const Tick> alone_;
    std::uint64_t seed_;
    std::size_t n_threads_;
    std::int64_t idle_until_stuck_;
    Lns one_;
    std::optional<Population> many_;
};

}  // namespace rightofway
