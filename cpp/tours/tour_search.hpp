// Search for tours: a first assignment by regret insertion, then large neighbourhood search (LNS).
//
// A step removes some jobs from a copy of the current plan and inserts them again, greedily with
// blinks or by regret, or exchanges the tails of two tours. Simulated annealing decides whether the
// plan becomes the current one. Its temperature falls over a cycle of steps; each cycle is longer
// than the one before and starts from the best plan, so that no limit needs to be known. The best
// plan depends on the seed and the number of steps alone.
//
// Ropke & Pisinger, "An adaptive large neighborhood search heuristic for the pickup and delivery
// problem with time windows", Transportation Science 2006. Pisinger & Ropke, "A general heuristic
// for vehicle routing problems", Computers & Operations Research 2007. Christiaens & Vanden Berghe,
// "Slack induction by string removals for vehicle routing problems", Transportation Science 2020.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/poll.hpp"
#include "core/random.hpp"
#include "lns/adaptive_choice.hpp"
#include "tours/insertion.hpp"
#include "tours/removals.hpp"
#include "tours/tour_plan.hpp"

namespace rightofway {

// Why no tour serves a job.
enum class UnservedReason : std::int32_t { robot, way, latest, battery, after, not_found };

class TourSearch {
  public:
    // Borrows the problem.
    TourSearch(const TourProblem& problem, std::uint64_t seed);

    // Inserts jobs with the order that their stops have in these tours, while they are feasible; no
    // others stay inserted.
    // Robot r has the stops first[r] .. first[r + 1] - 1.
    void start(std::span<const std::int32_t> first, std::span<const std::int32_t> stops);
    // Inserts jobs that no tour serves, by regret. False if time ran out.
    bool construct(const StopCondition& is_over);
    // Does steps of LNS; the number of those done.
    std::int64_t improve(std::int64_t n_steps, const StopCondition& is_over);

    // Changes the best plan a little: few jobs, `focus` among them unless it is `none`, move within
    // and between tours. The robots whose stops have changed, none if no change was found. A plan
    // of more cost is proposed with a probability that grows with `warmth`, in mean costs of a job.
    std::vector<RobotId> propose(std::int32_t focus, double warmth);
    const TourPlan& proposed() const { return trial_; }
    // Takes over the plan proposed, or another one, as the best one, whatever it costs.
    void take_proposed();
    void take(const TourPlan& plan);

    const TourProblem& problem() const { return problem_; }
    const TourPlan& best() const { return best_; }
    // Of each job: the reason for which it is in no tour.
    UnservedReason explain(std::int32_t job);
    // Of each robot: the objective of the best tours with the job at its best place in the robot's
    // tour, without the job in any other; nothing where it does not fit. The last entry is that
    // without the job. Jobs that come after it are in no tour.
    std::vector<std::optional<std::int64_t>> compare_robots(std::int32_t job);

  private:
    struct Method;

    static constexpr double impossible = 1e15;  // score of an insertion that does not exist
    static constexpr std::size_t n_near_tours = 12;
    static constexpr std::uint32_t polls_per_step = 64;

    void step();
    void exchange_tails();
    void go_back_to_best();
    void change_a_little(std::int32_t focus);
    std::vector<std::int32_t> choose_few(std::int32_t focus);
    std::vector<RobotId> list_moved() const;
    void insert_greedily(std::vector<std::int32_t> jobs, double skips);
    bool insert_by_regret(std::vector<std::int32_t> jobs, std::span<const RobotId> robots,
                          double noise, Poll* poll);
    void sort_jobs(std::vector<std::int32_t>& jobs);
    std::vector<std::int32_t> list_unserved() const;
    std::vector<std::int32_t> gather_unserved();
    void choose_robots(std::span<const std::int32_t> jobs);
    void adopt(const TourCost& cost);
    std::vector<std::vector<std::int32_t>> divide(std::vector<std::int32_t> jobs);
    void try_robot(std::int32_t job, RobotId robot, double skips, Insertion& best);
    bool accepts(const TourCost& cost);
    void begin_cycle();
    void cool();
    double draw_share() { return static_cast<double>(random_.next() >> 11) * 0x1.0p-53; }
    double energy(const TourCost& cost) const;
    UnservedReason explain_on(std::int32_t job, RobotId robot, Tick release);
    Tick find_least_end(std::int32_t job);

    const TourProblem& problem_;
    ChargePlanner charges_;
    InsertionFinder finder_;
    Removals removals_;
    Random random_;
    TourPlan trial_;
    TourPlan current_;
    TourPlan best_;
    TourCost current_cost_;
    TourCost best_cost_;
    AdaptiveChoice choice_;
    std::vector<RobotId> robots_;  // that insertions try
    std::vector<std::uint8_t> is_tried_;
    std::vector<RobotId> since_best_;  // robots whose tours may differ from the best ones
    std::vector<std::uint8_t> is_since_best_;
    std::vector<double> scores_;
    std::vector<Tick> least_ends_;  // of each job alone, -1: not computed yet
    std::int64_t n_steps_ = 0;
    std::int64_t cycle_begin_ = 0;
    std::int64_t cycle_length_ = 0;
    double hottest_ = 1;
    double heat_ = 1;  // from 1 to 0 over a cycle
};

}  // namespace rightofway
