#include "tours/tour_plan.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace rightofway {

TourPlan::TourPlan(const TourProblem& problem, ChargePlanner& charges)
    : problem_(&problem),
      charges_(&charges),
      robot_of_(problem.n_jobs(), nobody),
      releases_(problem.n_jobs(), 0),
      ends_(problem.n_jobs(), 0),
      limits_(problem.n_jobs(), never),
      is_changed_(problem.n_robots(), 0),
      is_stale_(problem.n_robots(), 0),
      first_gaps_(problem.n_robots(), 0) {
    for (RobotId robot = 0; index(robot) < problem.n_robots(); ++robot) {
        tours_.emplace_back(problem, robot);
        tours_.back().schedule(releases_, charges);
        mark(robot);
    }
    for (std::int32_t job = 0; index(job) < problem.n_jobs(); ++job) {
        count(job, -1);
    }
    n_served_ = 0;
    prepare();
}

void TourPlan::count(std::int32_t job, std::int64_t served) {
    const TourJob& counted = problem_->job(job);
    if (counted.begun_by != nobody) {
        n_missing_ -= served;
    } else {
        unserved_ -= served * counted.weight;
    }
    n_served_ += static_cast<std::size_t>(served);
}

bool TourPlan::is_open(std::int32_t job) const {
    const auto& after = problem_->job(job).after;
    return std::all_of(after.begin(), after.end(), [this](std::int32_t j) { return serves(j); });
}

Tick TourPlan::release(std::int32_t job) const {
    Tick release = 0;
    for (const std::int32_t earlier : problem_->job(job).after) {
        release = std::max(release, ends_[index(earlier)]);
    }
    return release;
}

// Walks back from the jobs that come before this one: along tours, and from jobs to those before
// them. No stop that is met may come after a stop of this job.
const std::vector<std::size_t>& TourPlan::first_gaps(std::int32_t job) {
    std::fill(first_gaps_.begin(), first_gaps_.end(), 0);
    std::vector<std::int32_t> jobs = problem_->job(job).after;
    while (!jobs.empty()) {
        const TourJob& earlier = problem_->job(jobs.back());
        const RobotId robot = robot_of(jobs.back());
        jobs.pop_back();
        const std::int32_t last = position(earlier.first_stop + earlier.n_stops - 1);
        std::size_t& gap = first_gaps_[index(robot)];
        for (; gap < index(last) + 1; ++gap) {
            const TourStop& stop = problem_->stop(tour(robot).stops()[gap]);
            const auto& before = problem_->job(stop.job).after;
            if (stop.is_first) {
                jobs.insert(jobs.end(), before.begin(), before.end());
            }
        }
    }
    return first_gaps_;
}

std::int32_t TourPlan::position(std::int32_t stop) const {
    const auto stops = tour(robot_of(problem_->stop(stop).job)).stops();
    return static_cast<std::int32_t>(std::find(stops.begin(), stops.end(), stop) - stops.begin());
}

TourCost TourPlan::cost() const {
    TourCost cost{n_missing_, unserved_, 0, 0};
    std::int64_t service = 0;
    for (const Tour& tour : tours_) {
        service += tour.service();
        cost.flowtime += problem_->robot(tour.robot()).weight * tour.completion();
    }
    switch (problem_->objective()) {
        case TourObjective::service:
            cost.value = service;
            break;
        case TourObjective::flowtime:
            cost.value = cost.flowtime;
            break;
        case TourObjective::makespan:
            cost.value = makespan();
            break;
        case TourObjective::both:
            cost.value = problem_->robot_weights() * makespan() + cost.flowtime;
            break;
    }
    return cost;
}

Tick TourPlan::makespan() const {
    Tick last = 0;
    for (const Tour& tour : tours_) {
        last = std::max(last, tour.completion());
    }
    return last;
}

void TourPlan::mark(RobotId robot) {
    if (!std::exchange(is_changed_[index(robot)], std::uint8_t{1})) {
        changed_.push_back(robot);
    }
    if (!std::exchange(is_stale_[index(robot)], std::uint8_t{1})) {
        stale_.push_back(robot);
    }
}

void TourPlan::take_in(std::int32_t job, RobotId robot) {
    robot_of_[index(job)] = robot;
    releases_[index(job)] = release(job);
    count(job, 1);
    mark(robot);
}

void TourPlan::take_out(std::int32_t job) {
    const RobotId robot = std::exchange(robot_of_[index(job)], nobody);
    std::erase_if(tours_[index(robot)].edit(),
                  [this, job](std::int32_t stop) { return problem_->stop(stop).job == job; });
    count(job, -1);
    mark(robot);
}

// Takes out jobs and all that come after them.
void TourPlan::take_out_all(std::span<const std::int32_t> jobs) {
    std::vector<std::int32_t> queue(jobs.begin(), jobs.end());
    while (!queue.empty()) {
        const std::int32_t job = queue.back();
        queue.pop_back();
        if (serves(job)) {
            take_out(job);
            const auto& later = problem_->job(job).before;
            queue.insert(queue.end(), later.begin(), later.end());
        }
    }
}

// Computes the times of a tour, and the ends of jobs that others wait for.
bool TourPlan::retime_one(RobotId robot) {
    Tour& tour = tours_[index(robot)];
    mark(robot);
    if (!tour.schedule(releases_, *charges_)) {
        return false;
    }
    for (std::size_t k = 0; k < tour.size(); ++k) {
        const TourStop& stop = problem_->stop(tour.stops()[k]);
        if (stop.is_last) {
            ends_[index(stop.job)] = tour.times().end[k];
        }
    }
    return true;
}

// Computes the times of tours that have changed and of those that wait for them. A tour that is not
// feasible, or nobody.
RobotId TourPlan::retime(std::span<const RobotId> robots) {
    std::vector<RobotId> queue(robots.rbegin(), robots.rend());
    std::size_t n_left = problem_->has_after() ? 50 * tours_.size() : tours_.size();
    while (!queue.empty()) {
        const RobotId robot = queue.back();
        queue.pop_back();
        if (n_left-- == 0 || !retime_one(robot)) {
            return robot;
        }
        if (!problem_->has_after()) {
            continue;
        }
        for (const std::int32_t stop : tours_[index(robot)].stops()) {
            for (const std::int32_t later : problem_->job(problem_->stop(stop).job).before) {
                const Tick before = std::exchange(releases_[index(later)], release(later));
                if (serves(later) && before != releases_[index(later)] &&
                    std::find(queue.begin(), queue.end(), robot_of(later)) == queue.end()) {
                    queue.insert(queue.begin(), robot_of(later));
                }
            }
        }
    }
    return nobody;
}

// Computes the times of changed tours; empties those that are not feasible.
void TourPlan::recover(std::span<const RobotId> robots) {
    std::vector<RobotId> all(robots.begin(), robots.end());
    for (RobotId bad = retime(all); bad != nobody; bad = retime(all)) {
        std::vector<std::int32_t> jobs;
        for (const std::int32_t stop : tours_[index(bad)].stops()) {
            jobs.push_back(problem_->stop(stop).job);
        }
        take_out_all(jobs);
        all.resize(tours_.size());
        std::iota(all.begin(), all.end(), 0);
    }
    prepare();
}

// Computes what changes of the changed tours would cost. Where jobs come after others, the limits
// of their ends follow from the tours of the later ones, in all tours.
void TourPlan::prepare() {
    for (const RobotId robot : std::exchange(stale_, {})) {
        is_stale_[index(robot)] = 0;
        if (!problem_->has_after()) {
            tours_[index(robot)].prepare(releases_, limits_);
        }
    }
    if (problem_->has_after()) {
        prepare_all();
    }
}

void TourPlan::prepare_all() {
    std::fill(limits_.begin(), limits_.end(), never);
    std::vector<RobotId> queue(tours_.size());
    std::iota(queue.begin(), queue.end(), 0);
    while (!queue.empty()) {
        const RobotId robot = queue.back();
        queue.pop_back();
        if (!std::exchange(is_changed_[index(robot)], std::uint8_t{1})) {
            changed_.push_back(robot);
        }
        tours_[index(robot)].prepare(releases_, limits_);
        limit_ends(robot, queue);
    }
}

// The jobs before those of this tour end before these begin at the latest.
void TourPlan::limit_ends(RobotId robot, std::vector<RobotId>& queue) {
    const Tour& changed = tour(robot);
    for (std::size_t k = 0; k < changed.size(); ++k) {
        const TourStop& stop = problem_->stop(changed.stops()[k]);
        if (!stop.is_first) {
            continue;
        }
        for (const std::int32_t earlier : problem_->job(stop.job).after) {
            Tick& limit = limits_[index(earlier)];
            if (changed.latest(k) < limit) {
                limit = changed.latest(k);
                if (std::find(queue.begin(), queue.end(), robot_of(earlier)) == queue.end()) {
                    queue.push_back(robot_of(earlier));
                }
            }
        }
    }
}

bool TourPlan::insert(std::int32_t job, const Insertion& insertion) {
    const RobotId robot = insertion.robot;
    std::vector<std::int32_t> with;
    insert_stops(*problem_, tour(robot).stops(), job, insertion.gaps, with);
    std::swap(tours_[index(robot)].edit(), with);
    take_in(job, robot);
    if (retime(std::span(&robot, 1)) == nobody) {
        prepare();
        return true;
    }
    remove(std::span(&job, 1));
    return false;
}

void TourPlan::remove(std::span<const std::int32_t> jobs) {
    take_out_all(jobs);
    if (problem_->has_after()) {
        std::vector<RobotId> all(tours_.size());
        std::iota(all.begin(), all.end(), 0);
        recover(all);
    } else {
        recover(std::vector<RobotId>(stale_));
    }
}

bool TourPlan::replace(std::span<const RobotId> robots,
                       std::span<std::vector<std::int32_t>> stops) {
    for (std::size_t k = 0; k < robots.size(); ++k) {
        for (const std::int32_t stop : stops[k]) {
            robot_of_[index(problem_->stop(stop).job)] = robots[k];
        }
        std::swap(tours_[index(robots[k])].edit(), stops[k]);
        mark(robots[k]);
    }
    if (retime(robots) != nobody) {
        return false;
    }
    prepare();
    return true;
}

void TourPlan::copy_from(const TourPlan& other, std::span<const RobotId> robots) {
    for (const RobotId robot : robots) {
        tours_[index(robot)] = other.tours_[index(robot)];
    }
    robot_of_ = other.robot_of_;
    n_served_ = other.n_served_;
    n_missing_ = other.n_missing_;
    unserved_ = other.unserved_;
    if (problem_->has_after()) {
        releases_ = other.releases_;
        ends_ = other.ends_;
        limits_ = other.limits_;
    }
}

void TourPlan::restore(const TourPlan& other) {
    copy_from(other, changed_);
    for (const RobotId robot : changed_) {
        is_changed_[index(robot)] = 0;
    }
    changed_.clear();
}

void TourPlan::commit(TourPlan& other) {
    other.copy_from(*this, changed_);
    for (const RobotId robot : changed_) {
        is_changed_[index(robot)] = 0;
    }
    changed_.clear();
}

}  // namespace rightofway
