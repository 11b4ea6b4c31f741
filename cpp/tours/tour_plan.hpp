// The tours of a fleet, the jobs that they serve, and their cost.
//
// Where jobs come after others, the ends of jobs in one tour are releases in another: tours are
// timed again until no release changes. Insertions keep the order acyclic, so this ends.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/random.hpp"
#include "core/types.hpp"
#include "tours/insertion.hpp"
#include "tours/tour.hpp"

namespace rightofway {

class TourPlan {
  public:
    // Borrows both. All tours are empty.
    TourPlan(const TourProblem& problem, ChargePlanner& charges);

    const Tour& tour(RobotId robot) const { return tours_[index(robot)]; }
    RobotId robot_of(std::int32_t job) const { return robot_of_[index(job)]; }
    bool serves(std::int32_t job) const { return robot_of(job) != nobody; }
    std::span<const Tick> releases() const { return releases_; }
    // Whether all jobs that the job comes after are served.
    bool is_open(std::int32_t job) const;
    Tick release(std::int32_t job) const;
    // The first gap of each tour after which the job may begin, without a cycle of waiting.
    const std::vector<std::size_t>& first_gaps(std::int32_t job);

    TourCost cost() const;
    Tick makespan() const;
    std::size_t n_served() const { return n_served_; }

    // Inserts the job where `find` has found it. False, and nothing changed, if the plan does not
    // allow it after all.
    bool insert(std::int32_t job, const Insertion& insertion);
    // Removes jobs, and all that come after them. Where a tour is not feasible without them, all
    // its jobs are removed.
    void remove(std::span<const std::int32_t> jobs);
    // Replaces the stops of tours: together they have the jobs that they had. False if that is not
    // feasible; the plan is then to be restored.
    bool replace(std::span<const RobotId> robots, std::span<std::vector<std::int32_t>> stops);

    // Two plans that were equal become equal again: takes over from `other` all tours that have
    // changed in this plan, or gives them to it.
    void restore(const TourPlan& other);
    void commit(TourPlan& other);
    std::span<const RobotId> changed() const { return changed_; }
    // Takes over the tours of these robots; all others are equal already.
    void copy_from(const TourPlan& other, std::span<const RobotId> robots);

  private:
    void take_out(std::int32_t job);
    void take_out_all(std::span<const std::int32_t> jobs);
    void take_in(std::int32_t job, RobotId robot);
    void count(std::int32_t job, std::int64_t served);
    RobotId retime(std::span<const RobotId> robots);
    bool retime_one(RobotId robot);
    void recover(std::span<const RobotId> robots);
    void prepare();
    void prepare_all();
    void limit_ends(RobotId robot, std::vector<RobotId>& queue);
    void mark(RobotId robot);
    std::int32_t position(std::int32_t stop) const;

    const TourProblem* problem_;
    ChargePlanner* charges_;
    std::vector<Tour> tours_;
    std::vector<RobotId> robot_of_;
    std::size_t n_served_ = 0;
    std::int64_t n_missing_ = 0;
    std::int64_t unserved_ = 0;
    std::vector<Tick> releases_;  // of each job, by the jobs before it
    std::vector<Tick> ends_;      // of each job that is served
    std::vector<Tick> limits_;    // of the end of each job, by the jobs after it
    std::vector<RobotId> changed_;
    std::vector<std::uint8_t> is_changed_;
    std::vector<RobotId> stale_;  // changed since `prepare`
    std::vector<std::uint8_t> is_stale_;
    std::vector<std::size_t> first_gaps_;
};

}  // namespace rightofway
