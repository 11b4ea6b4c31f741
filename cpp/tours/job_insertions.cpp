// Insertions of jobs into the tours of a search: greedy with blinks, and by regret.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "tours/tour_search.hpp"

namespace rightofway {
namespace {

constexpr std::size_t most_waiting = 30;  // unserved jobs that a step tries to insert
constexpr std::size_t many_robots = 24;   // in larger fleets, insertions try tours nearby only
constexpr std::size_t n_drawn_tours = 3;

}  // namespace

std::vector<std::int32_t> TourSearch::list_unserved() const {
    std::vector<std::int32_t> jobs;
    for (std::int32_t job = 0; index(job) < problem_.n_jobs(); ++job) {
        if (!trial_.serves(job)) {
            jobs.push_back(job);
        }
    }
    return jobs;
}

// Unserved jobs in random order: those that the current plan serves or that have begun, and some of
// the others.
std::vector<std::int32_t> TourSearch::gather_unserved() {
    std::vector<std::int32_t> jobs = list_unserved();
    random_.shuffle(jobs);
    std::stable_partition(jobs.begin(), jobs.end(), [this](std::int32_t job) {
        return problem_.job(job).begun_by != nobody || current_.serves(job);
    });
    if (problem_.has_after()) {
        return jobs;
    }
    const auto n_fixed = std::count_if(jobs.begin(), jobs.end(), [this](std::int32_t job) {
        return problem_.job(job).begun_by != nobody || current_.serves(job);
    });
    jobs.resize(std::min(jobs.size(), static_cast<std::size_t>(n_fixed) + most_waiting));
    return jobs;
}

// The robots whose tours may get jobs: all of a small fleet; else those that have lost a job, those
// with jobs nearby, and a few others.
void TourSearch::choose_robots(std::span<const std::int32_t> jobs) {
    if (problem_.n_robots() <= many_robots) {
        robots_.resize(problem_.n_robots());
        std::iota(robots_.begin(), robots_.end(), 0);
        return;
    }
    robots_.clear();
    const auto add = [this](RobotId robot) {
        if (robot != nobody && !std::exchange(is_tried_[index(robot)], std::uint8_t{1})) {
            robots_.push_back(robot);
        }
    };
    if (!problem_.has_after()) {
        for (const RobotId robot : trial_.changed()) {
            add(robot);
        }
    }
    for (const std::int32_t job : jobs) {
        const auto near = removals_.near(job);
        for (const std::int32_t other : near.first(std::min(near.size(), n_near_tours))) {
            add(trial_.robot_of(other));
        }
        const auto& allowed = problem_.job(job).robots;
        for (std::size_t k = 0; k < n_drawn_tours && !allowed.empty(); ++k) {
            add(allowed[random_.below(allowed.size())]);
        }
    }
    for (const RobotId robot : robots_) {
        is_tried_[index(robot)] = 0;
    }
}

void TourSearch::sort_jobs(std::vector<std::int32_t>& jobs) {
    std::vector<std::pair<double, std::int32_t>> keys;
    const std::size_t order = random_.below(12);
    for (const std::int32_t job : jobs) {
        const TourJob& sorted = problem_.job(job);
        const auto stops = problem_.stops_of(sorted);
        const TourRobot& robot = problem_.robot(sorted.robots.empty() ? 0 : sorted.robots.front());
        const auto far = static_cast<double>(problem_.drive(robot, robot.start, stops[0].place));
        double key = 0;
        if (order < 5) {
            key = draw_share();
        } else if (order < 7) {
            key = -far;
        } else if (order < 8) {
            key = far;
        } else if (order < 9) {
            key = static_cast<double>(stops.back().latest);
        } else if (order < 10) {
            key = static_cast<double>(stops.front().earliest);
        } else {
            key = -static_cast<double>(sorted.weight) * (1 + 0.1 * draw_share());
        }
        keys.emplace_back(sorted.begun_by != nobody ? -impossible : key, job);
    }
    std::stable_sort(keys.begin(), keys.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (std::size_t k = 0; k < jobs.size(); ++k) {
        jobs[k] = keys[k].second;
    }
}

void TourSearch::try_robot(std::int32_t job, RobotId robot, double skips, Insertion& best) {
    if (problem_.may_do(robot, job)) {
        const std::size_t first_gap =
            problem_.has_after() ? trial_.first_gaps(job)[index(robot)] : 0;
        const bool needs_makespan = problem_.objective() == TourObjective::makespan ||
                                    problem_.objective() == TourObjective::both;
        finder_.improve(trial_.tour(robot),
                        {job, trial_.release(job), needs_makespan ? trial_.makespan() : 0, skips},
                        first_gap, trial_.releases(), random_, best);
    }
}

void TourSearch::insert_greedily(std::vector<std::int32_t> jobs, double skips) {
    sort_jobs(jobs);
    Insertion best;
    for (bool goes_on = true; goes_on && !jobs.empty();) {
        goes_on = false;
        std::erase_if(jobs, [&](std::int32_t job) {
            if (!trial_.is_open(job)) {
                return false;
            }
            best.score = std::numeric_limits<double>::infinity();
            best.robot = nobody;
            choose_robots(std::span(&job, 1));
            for (const RobotId robot : robots_) {
                try_robot(job, robot, skips, best);
            }
            const bool is_inserted = best.exists() && trial_.insert(job, best);
            goes_on = goes_on || (is_inserted && problem_.has_after());
            return is_inserted;
        });
    }
}

// Ropke & Pisinger, section 3.2.2: always the job that loses most if it does not get its best tour
// now, to the second and to the third best. False if time ran out.
bool TourSearch::insert_by_regret(std::vector<std::int32_t> jobs, std::span<const RobotId> robots,
                                  double noise, Poll* poll) {
    const std::size_t n_robots = robots.size();
    scores_.assign(jobs.size() * n_robots, std::numeric_limits<double>::quiet_NaN());
    Insertion best;
    const auto evaluate = [&](std::size_t j, std::size_t r) {
        best.score = impossible;
        best.robot = nobody;
        try_robot(jobs[j], robots[r], 0, best);
        const double factor = noise == 0 ? 1 : 1 + noise * draw_share();
        scores_[j * n_robots + r] = best.exists() ? best.score * factor : impossible;
    };
    std::vector<std::uint8_t> is_done(jobs.size(), 0);
    for (std::size_t n_left = jobs.size(); n_left > 0; --n_left) {
        if (poll != nullptr && (*poll)(polls_per_step)) {
            return false;
        }
        std::size_t job = jobs.size();
        std::size_t robot = 0;
        double most = -1;
        for (std::size_t j = 0; j < jobs.size(); ++j) {
            if (is_done[j] || !trial_.is_open(jobs[j])) {
                continue;
            }
            std::array<double, 3> least{impossible, impossible, impossible};
            std::size_t at = 0;
            for (std::size_t r = 0; r < n_robots; ++r) {
                double& score = scores_[j * n_robots + r];
                if (std::isnan(score)) {
                    evaluate(j, r);
                }
                if (score < least[0]) {
                    least = {score, least[0], least[1]};
                    at = r;
                } else if (score < least[1]) {
                    least = {least[0], score, least[1]};
                } else if (score < least[2]) {
                    least[2] = score;
                }
            }
            const bool has_begun = problem_.job(jobs[j]).begun_by != nobody;
            const double regret = has_begun ? 3 * impossible : least[1] + least[2] - 2 * least[0];
            if (least[0] < impossible && regret > most) {
                most = regret;
                job = j;
                robot = at;
            }
        }
        if (job == jobs.size()) {
            return true;
        }
        best.score = impossible;
        best.robot = nobody;
        try_robot(jobs[job], robots[robot], 0, best);
        if (!best.exists() || !trial_.insert(jobs[job], best)) {
            scores_[job * n_robots + robot] = impossible;
            ++n_left;
            continue;
        }
        is_done[job] = 1;
        for (std::size_t j = 0; j < jobs.size(); ++j) {
            scores_[j * n_robots + robot] = std::numeric_limits<double>::quiet_NaN();
        }
    }
    return true;
}

}  // namespace rightofway
