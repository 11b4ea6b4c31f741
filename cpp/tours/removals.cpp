#include "tours/removals.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace rightofway {
namespace {

constexpr std::size_t most_near = 100;
constexpr std::size_t longest_string = 10;
constexpr double greed_of_related = 6;  // exponents of the draws from sorted lists
constexpr double greed_of_worst = 3;

double draw_share(Random& random) { return static_cast<double>(random.next() >> 11) * 0x1.0p-53; }

// An index in a sorted list: the first ones are more likely.
std::size_t draw_first(std::size_t n, double greed, Random& random) {
    const auto k =
        static_cast<std::size_t>(std::pow(draw_share(random), greed) * static_cast<double>(n));
    return std::min(k, n - 1);
}

}  // namespace

Removals::Removals(const TourProblem& problem)
    : problem_(problem),
      jobs_of_(problem.n_robots()),
      rank_(problem.n_jobs(), 0),
      begin_(problem.n_jobs(), 0),
      is_chosen_(problem.n_jobs(), 0) {
    find_near();
}

// How far apart two jobs are: between their first and between their last stops, in the better
// direction, for the first robot's kind of travel.
double Removals::distance(std::int32_t a, std::int32_t b) const {
    const TourRobot& robot = problem_.robot(0);
    const auto between = [&](std::int32_t p, std::int32_t q) {
        return static_cast<double>(
            std::min(problem_.drive(robot, p, q), problem_.drive(robot, q, p)));
    };
    const auto from = problem_.stops_of(problem_.job(a));
    const auto to = problem_.stops_of(problem_.job(b));
    return between(from.front().place, to.front().place) +
           between(from.back().place, to.back().place);
}

void Removals::find_near() {
    const std::size_t n = problem_.n_jobs();
    n_near_ = n == 0 ? 0 : std::min(n - 1, most_near);
    double sum = 0;
    double n_reached = 1e-9;
    for (std::int32_t job = 0; index(job) < n; ++job) {
        ranked_.clear();
        for (std::int32_t other = 0; index(other) < n; ++other) {
            if (other != job) {
                ranked_.emplace_back(distance(job, other), other);
            }
        }
        std::partial_sort(ranked_.begin(), ranked_.begin() + static_cast<std::ptrdiff_t>(n_near_),
                          ranked_.end());
        for (std::size_t k = 0; k < n_near_; ++k) {
            near_.push_back(ranked_[k].second);
        }
        for (const auto& [far, _] : ranked_) {
            if (far < static_cast<double>(TourProblem::no_way)) {
                sum += far;
                ++n_reached;
            }
        }
    }
    mean_distance_ = std::max(sum / n_reached, 1.0);
}

void Removals::add(std::int32_t job) {
    if (!std::exchange(is_chosen_[index(job)], std::uint8_t{1})) {
        chosen_.push_back(job);
    }
}

// Notes which jobs each tour serves and when they begin.
void Removals::note_places(const TourPlan& plan) {
    served_.clear();
    double first = std::numeric_limits<double>::max();
    double last = 0;
    for (std::size_t r = 0; r < jobs_of_.size(); ++r) {
        const Tour& tour = plan.tour(static_cast<RobotId>(r));
        auto& jobs = jobs_of_[r];
        jobs.clear();
        for (std::size_t k = 0; k < tour.size(); ++k) {
            const TourStop& stop = problem_.stop(tour.stops()[k]);
            if (stop.is_first) {
                const auto begin = static_cast<double>(tour.times().begin[k]);
                rank_[index(stop.job)] = static_cast<std::int32_t>(jobs.size());
                begin_[index(stop.job)] = begin;
                first = std::min(first, begin);
                last = std::max(last, begin);
                jobs.push_back(stop.job);
                served_.push_back(stop.job);
            }
        }
    }
    span_ = std::max(last - first, 1.0);
}

const std::vector<std::int32_t>& Removals::choose(const TourPlan& plan, RemovalKind kind,
                                                  std::size_t n, Random& random) {
    for (const std::int32_t job : chosen_) {
        is_chosen_[index(job)] = 0;
    }
    chosen_.clear();
    note_places(plan);
    n = std::min(n, served_.size());
    if (n == 0) {
        return chosen_;
    }
    switch (kind) {
        case RemovalKind::strings:
            choose_strings(plan, n, random);
            break;
        case RemovalKind::related:
            choose_related(plan, n, random);
            break;
        case RemovalKind::worst:
            choose_worst(plan, n, random);
            break;
        case RemovalKind::random:
            choose_random(n, random);
            break;
        case RemovalKind::tours:
            choose_tours(plan, n, random);
            break;
    }
    return chosen_;
}

// Christiaens & Vanden Berghe, equations (5) to (9): from the tours around a job, one string of
// successive jobs each. Strings are no longer than the mean tour.
void Removals::choose_strings(const TourPlan& plan, std::size_t n, Random& random) {
    const auto n_tours = std::count_if(jobs_of_.begin(), jobs_of_.end(),
                                       [](const auto& jobs) { return !jobs.empty(); });
    const double mean = static_cast<double>(served_.size()) / static_cast<double>(n_tours);
    const double longest = std::min(static_cast<double>(longest_string), mean);
    const double most = 4 * static_cast<double>(n) / (1 + longest) - 1;
    const auto n_strings =
        static_cast<std::size_t>(std::max(draw_share(random) * (most - 1) + 1.5, 1.0));
    const std::int32_t seed = served_[random.below(served_.size())];
    std::vector<RobotId> ruined;
    const auto ruin = [&](std::int32_t job) {
        const RobotId robot = plan.robot_of(job);
        if (robot == nobody || std::find(ruined.begin(), ruined.end(), robot) != ruined.end()) {
            return;
        }
        const double limit = std::min(static_cast<double>(jobs_of_[index(robot)].size()), longest);
        take_string(plan, job, static_cast<std::size_t>(draw_share(random) * limit + 1), random);
        ruined.push_back(robot);
    };
    ruin(seed);
    for (const std::int32_t job : near(seed)) {
        if (ruined.size() >= n_strings) {
            break;
        }
        ruin(job);
    }
}

// A string that contains the job; in half of the cases some jobs within a longer one stay.
void Removals::take_string(const TourPlan& plan, std::int32_t job, std::size_t length,
                           Random& random) {
    const auto& jobs = jobs_of_[index(plan.robot_of(job))];
    length = std::min(length, jobs.size());
    std::size_t n_kept = 0;
    if (length > 1 && random.below(2) == 0) {
        while (length + n_kept < jobs.size() && draw_share(random) >= 0.5) {
            ++n_kept;
        }
    }
    const std::size_t total = length + n_kept;
    const std::size_t at = index(rank_[index(job)]);
    const std::size_t least = at + 1 >= total ? at + 1 - total : 0;
    const std::size_t most = std::min(at, jobs.size() - total);
    const std::size_t first = least + random.below(most - least + 1);
    const std::size_t kept = n_kept == 0 ? 0 : random.below(length + 1);
    for (std::size_t k = 0; k < total; ++k) {
        if (k < kept || k >= kept + n_kept) {
            add(jobs[first + k]);
        }
    }
}

// Shaw's relatedness: near, at about one time, with similar loads.
double Removals::relatedness(const TourPlan& plan, std::int32_t a, std::int32_t b) const {
    const auto load = [this](std::int32_t job) {
        return problem_.stops_of(problem_.job(job)).front().load;
    };
    return 9 * distance(a, b) / mean_distance_ +
           6 * std::abs(begin_[index(a)] - begin_[index(b)]) / span_ +
           2 * std::min(std::abs(load(a) - load(b)), 5) +
           (plan.robot_of(a) == plan.robot_of(b) ? 1 : 0);
}

void Removals::choose_related(const TourPlan& plan, std::size_t n, Random& random) {
    add(served_[random.below(served_.size())]);
    while (chosen_.size() < n) {
        const std::int32_t job = chosen_[random.below(chosen_.size())];
        ranked_.clear();
        for (const std::int32_t other : served_) {
            if (!is_chosen_[index(other)]) {
                ranked_.emplace_back(relatedness(plan, job, other), other);
            }
        }
        const auto k =
            static_cast<std::ptrdiff_t>(draw_first(ranked_.size(), greed_of_related, random));
        std::nth_element(ranked_.begin(), ranked_.begin() + k, ranked_.end());
        add(ranked_[index(k)].second);
    }
}

// Jobs that cost much where they are: the detour of their stops and the waiting before them.
void Removals::choose_worst(const TourPlan& plan, std::size_t n, Random& random) {
    std::vector<double> detour(problem_.n_jobs(), 0);
    for (const auto& jobs : jobs_of_) {
        if (jobs.empty()) {
            continue;
        }
        const Tour& tour = plan.tour(plan.robot_of(jobs.front()));
        const TourRobot& robot = problem_.robot(tour.robot());
        for (std::size_t k = 0; k < tour.size(); ++k) {
            const TourStop& stop = problem_.stop(tour.stops()[k]);
            const std::int32_t before = tour.place_before(k);
            const std::int32_t after = tour.place_after(k + 1, stop.place);
            detour[index(stop.job)] += static_cast<double>(
                problem_.drive(robot, before, stop.place) +
                problem_.drive(robot, stop.place, after) - problem_.drive(robot, before, after));
            detour[index(stop.job)] += static_cast<double>(
                tour.times().begin[k] - (k == 0 ? robot.ready : tour.times().end[k - 1]) -
                problem_.drive(robot, before, stop.place));
        }
    }
    ranked_.clear();
    for (const std::int32_t job : served_) {
        ranked_.emplace_back(-detour[index(job)], job);
    }
    std::sort(ranked_.begin(), ranked_.end());
    while (chosen_.size() < n) {
        const std::size_t k = draw_first(ranked_.size(), greed_of_worst, random);
        add(ranked_[k].second);
        ranked_.erase(ranked_.begin() + static_cast<std::ptrdiff_t>(k));
    }
}

void Removals::choose_random(std::size_t n, Random& random) {
    while (chosen_.size() < n) {
        add(served_[random.below(served_.size())]);
    }
}

// All jobs of a few tours: of one, and of those near it.
void Removals::choose_tours(const TourPlan& plan, std::size_t n, Random& random) {
    std::int32_t job = served_[random.below(served_.size())];
    for (std::size_t k = 0; k < 2 || (chosen_.size() < n && k < 4); ++k) {
        for (const std::int32_t other : jobs_of_[index(plan.robot_of(job))]) {
            add(other);
        }
        const auto others = near(job);
        const auto next = std::find_if(others.begin(), others.end(), [&](std::int32_t other) {
            return plan.serves(other) && !is_chosen_[index(other)];
        });
        if (next == others.end()) {
            return;
        }
        job = *next;
    }
}

}  // namespace rightofway
