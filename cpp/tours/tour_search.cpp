#include "tours/tour_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/reject.hpp"

namespace rightofway {
namespace {

constexpr double blinks = 0.01;  // Christiaens & Vanden Berghe, the rate of skipped gaps
constexpr double hot = 1.0;      // temperatures, as shares of the mean cost of a job
constexpr double cold = 0.004;
constexpr double warm = 0.1;        // in place of `hot` in the first cycle, which has to gain soon
constexpr double hot_weight = 0.3;  // the same for weights of unserved jobs
constexpr double regret_noise = 0.1;
constexpr std::int64_t first_cycle = 5000;  // steps
constexpr std::int64_t steps_per_job = 20;  // of the first cycle, at least
constexpr std::int64_t cycle_growth = 2;
constexpr std::size_t mean_removed = 10;
constexpr std::size_t most_compared = 100;  // jobs of a portion of the first assignment
constexpr std::int64_t settle_every = 100;
constexpr std::size_t most_moved = 3;      // jobs of a proposal that are chosen
constexpr std::size_t most_proposals = 8;  // without a change or too dear, until none is made
constexpr std::array skips_of_proposals{blinks, 0.15, 0.5};  // gaps skipped, for other places

}  // namespace

struct TourSearch::Method {
    RemovalKind removal;
    bool by_regret;
    bool exchanges;

    static constexpr std::size_t count = 8;
    static const std::array<Method, count> all;
};

const std::array<TourSearch::Method, TourSearch::Method::count> TourSearch::Method::all{{
    {RemovalKind::strings, false, false},
    {RemovalKind::related, false, false},
    {RemovalKind::worst, false, false},
    {RemovalKind::random, false, false},
    {RemovalKind::tours, false, false},
    {RemovalKind::strings, true, false},
    {RemovalKind::related, true, false},
    {RemovalKind::strings, false, true},
}};

TourSearch::TourSearch(const TourProblem& problem, std::uint64_t seed)
    : problem_(problem),
      charges_(problem),
      finder_(problem, charges_),
      removals_(problem),
      random_(seed, 0, 0),
      trial_(problem, charges_),
      current_(trial_),
      best_(trial_),
      current_cost_(trial_.cost()),
      best_cost_(current_cost_),
      choice_(Method::count),
      is_tried_(problem.n_robots(), 0),
      is_since_best_(problem.n_robots(), 0),
      least_ends_(problem.n_jobs(), -1) {}

void TourSearch::start(std::span<const std::int32_t> first, std::span<const std::int32_t> stops) {
    require_length("first", first.size(), problem_.n_robots() + 1);
    require_lists("first", first, stops.size(), "stops");
    std::int32_t n_stops = 0;
    for (std::int32_t job = 0; index(job) < problem_.n_jobs(); ++job) {
        n_stops += problem_.job(job).n_stops;
    }
    require_ids("stops", stops, n_stops);
    std::vector<std::int32_t> given(index(n_stops), none);  // the index of each stop
    std::vector<RobotId> robot_of(problem_.n_jobs(), nobody);
    std::vector<std::int32_t> jobs;
    for (std::size_t r = 0; r < problem_.n_robots(); ++r) {
        for (std::int32_t k = first[r]; k < first[r + 1]; ++k) {
            const TourStop& stop = problem_.stop(stops[index(k)]);
            given[index(stops[index(k)])] = k;
            if (stop.is_first && problem_.may_do(static_cast<RobotId>(r), stop.job)) {
                robot_of[index(stop.job)] = static_cast<RobotId>(r);
                jobs.push_back(stop.job);
            }
        }
    }
    trial_ = current_ = best_ = TourPlan(problem_, charges_);
    // The tour is a part of the given one, so each stop has the gap after those given before it.
    const auto insert = [&](std::int32_t job) {
        Insertion as_given;
        as_given.robot = robot_of[index(job)];
        const Tour& tour = trial_.tour(as_given.robot);
        std::int32_t before = first[index(as_given.robot)] - 1;
        const std::int32_t first_stop = problem_.job(job).first_stop;
        for (std::int32_t s = first_stop; s < first_stop + problem_.job(job).n_stops; ++s) {
            if (given[index(s)] <= before || given[index(s)] >= first[index(as_given.robot) + 1]) {
                return false;
            }
            before = given[index(s)];
            as_given.gaps.push_back(static_cast<std::int32_t>(
                std::count_if(tour.stops().begin(), tour.stops().end(),
                              [&](std::int32_t other) { return given[index(other)] < before; })));
        }
        return index(as_given.gaps.front()) >= trial_.first_gaps(job)[index(as_given.robot)] &&
               trial_.insert(job, as_given);
    };
    for (bool goes_on = true; goes_on;) {
        goes_on = false;
        for (const std::int32_t job : jobs) {
            goes_on = (!trial_.serves(job) && trial_.is_open(job) && insert(job)) || goes_on;
        }
    }
    trial_.commit(current_);
    best_ = current_;
    best_cost_ = current_cost_ = current_.cost();
}

// Portions of jobs for a first assignment: regret compares the jobs of one portion. Jobs that have
// begun come first, then those that can end first, so that jobs rarely come before those they
// follow.
std::vector<std::vector<std::int32_t>> TourSearch::divide(std::vector<std::int32_t> jobs) {
    const auto key = [this](std::int32_t job) {
        const bool has_begun = problem_.job(job).begun_by != nobody;
        return std::pair(has_begun ? -1 : find_least_end(job), job);
    };
    std::sort(jobs.begin(), jobs.end(),
              [&](std::int32_t a, std::int32_t b) { return key(a) < key(b); });
    std::vector<std::vector<std::int32_t>> portions;
    for (const std::int32_t job : jobs) {
        if (portions.empty() || portions.back().size() == most_compared) {
            portions.emplace_back();
        }
        portions.back().push_back(job);
    }
    return portions;
}

bool TourSearch::construct(const StopCondition& is_over) {
    Poll poll(is_over);
    robots_.resize(problem_.n_robots());
    std::iota(robots_.begin(), robots_.end(), 0);
    bool is_done = true;
    for (std::vector<std::int32_t>& portion : divide(list_unserved())) {
        is_done = is_done && insert_by_regret(std::move(portion), robots_, 0, &poll);
    }
    if (is_done && problem_.has_after()) {  // jobs that came before those they follow
        is_done = insert_by_regret(list_unserved(), robots_, 0, &poll);
    }
    trial_.commit(current_);
    best_ = current_;
    best_cost_ = current_cost_ = current_.cost();
    return is_done;
}

std::int64_t TourSearch::improve(std::int64_t n_steps, const StopCondition& is_over) {
    Poll poll(is_over);
    std::int64_t done = 0;
    if (problem_.n_jobs() == 0) {
        return n_steps;
    }
    while (done < n_steps && !poll(polls_per_step)) {
        step();
        ++done;
    }
    return done;
}

// Starts again from the best plan, hotter than before.
void TourSearch::begin_cycle() {
    cycle_begin_ = n_steps_;
    const bool is_first = cycle_length_ == 0;
    const auto n_jobs = static_cast<std::int64_t>(problem_.n_jobs());
    cycle_length_ =
        is_first ? std::max(first_cycle, steps_per_job * n_jobs) : cycle_growth * cycle_length_;
    hottest_ =
        (is_first ? warm : hot) * energy(best_cost_) / static_cast<double>(best_.n_served() + 1);
    go_back_to_best();
}

void TourSearch::go_back_to_best() {
    trial_.restore(current_);
    current_.copy_from(best_, since_best_);
    trial_.copy_from(best_, since_best_);
    current_cost_ = best_cost_;
    for (const RobotId robot : std::exchange(since_best_, {})) {
        is_since_best_[index(robot)] = 0;
    }
}

void TourSearch::cool() {
    if (n_steps_ == cycle_begin_ + cycle_length_) {
        begin_cycle();
    }
    heat_ = 1 - static_cast<double>(n_steps_ - cycle_begin_) / static_cast<double>(cycle_length_);
}

// What simulated annealing compares, where the same jobs are unserved.
double TourSearch::energy(const TourCost& cost) const {
    const auto flowtime = static_cast<double>(cost.flowtime);
    const auto value = static_cast<double>(cost.value);
    switch (problem_.objective()) {
        case TourObjective::service:
            return value + 1e-6 * flowtime;
        case TourObjective::makespan:
            return problem_.makespan_weight() * value + flowtime;
        default:
            return value;
    }
}

bool TourSearch::accepts(const TourCost& cost) {
    if (cost <= current_cost_) {
        return true;
    }
    if (cost.n_missing != current_cost_.n_missing) {
        return cost.n_missing < current_cost_.n_missing;
    }
    const double dice = -std::log(std::max(draw_share(), 1e-300));
    const auto unserved = static_cast<double>(cost.unserved - current_cost_.unserved);
    if (unserved != 0) {
        const std::size_t n_unserved = problem_.n_jobs() - trial_.n_served();
        const double mean =
            static_cast<double>(cost.unserved) / static_cast<double>(n_unserved + 1);
        return unserved < dice * hot_weight * heat_ * mean;
    }
    const double temperature = hottest_ * std::pow(cold / hot, 1 - heat_);
    return energy(cost) - energy(current_cost_) < dice * temperature;
}

void TourSearch::step() {
    cool();
    const std::size_t option = choice_.draw(random_);
    const Method& method = Method::all[option];
    if (method.exchanges && !problem_.has_after()) {
        exchange_tails();
    }
    const std::size_t n_removed = 1 + random_.below(2 * mean_removed - 1);
    const auto& removed = removals_.choose(trial_, method.removal, n_removed, random_);
    const auto effort = static_cast<double>(removed.size() * (method.by_regret ? 3 : 1) + 2);
    trial_.remove(removed);
    std::vector<std::int32_t> jobs = gather_unserved();
    if (method.by_regret) {
        choose_robots(jobs);
        insert_by_regret(std::move(jobs), robots_, regret_noise, nullptr);
    } else {
        insert_greedily(std::move(jobs), blinks);
    }
    const TourCost cost = trial_.cost();
    const double gain = cost < current_cost_ ? 1 : 0;
    choice_.learn(option, cost < best_cost_ ? 10 : gain, effort);
    if (accepts(cost)) {
        adopt(cost);
    } else {
        trial_.restore(current_);
    }
    if (++n_steps_ % settle_every == 0) {
        choice_.settle();
    }
}

// Takes over the trial as the current plan, and as the best one if it is.
void TourSearch::adopt(const TourCost& cost) {
    for (const RobotId robot : trial_.changed()) {
        if (!std::exchange(is_since_best_[index(robot)], std::uint8_t{1})) {
            since_best_.push_back(robot);
        }
    }
    trial_.commit(current_);
    current_cost_ = cost;
    if (cost < best_cost_) {
        best_.copy_from(current_, since_best_);
        best_cost_ = cost;
        for (const RobotId robot : std::exchange(since_best_, {})) {
            is_since_best_[index(robot)] = 0;
        }
    }
}

std::vector<RobotId> TourSearch::propose(std::int32_t focus, double warmth) {
    if (focus != none) {
        require_id("focus", focus, static_cast<std::int64_t>(problem_.n_jobs()));
    }
    go_back_to_best();
    const double mean = energy(best_cost_) / static_cast<double>(best_.n_served() + 1);
    for (std::size_t tries = 0; tries < most_proposals && problem_.n_jobs() > 0; ++tries) {
        change_a_little(focus);
        const TourCost cost = trial_.cost();
        const double dice = -std::log(std::max(draw_share(), 1e-300));
        const bool is_cheap = std::pair(cost.n_missing, cost.unserved) <
                                  std::pair(best_cost_.n_missing, best_cost_.unserved) ||
                              (std::pair(cost.n_missing, cost.unserved) ==
                                   std::pair(best_cost_.n_missing, best_cost_.unserved) &&
                               energy(cost) - energy(best_cost_) <= dice * warmth * mean);
        std::vector<RobotId> moved = is_cheap ? list_moved() : std::vector<RobotId>{};
        if (!moved.empty()) {
            return moved;
        }
        trial_.restore(current_);
    }
    return {};
}

void TourSearch::take_proposed() {
    trial_.commit(current_);
    best_ = current_;
    best_cost_ = current_cost_ = current_.cost();
}

void TourSearch::take(const TourPlan& plan) {
    trial_ = current_ = best_ = plan;
    best_cost_ = current_cost_ = current_.cost();
}

void TourSearch::change_a_little(std::int32_t focus) {
    constexpr std::size_t tails_every = 6;
    if (!problem_.has_after() && random_.below(tails_every) == 0) {
        exchange_tails();
        return;
    }
    std::vector<std::int32_t> jobs = choose_few(focus);
    trial_.remove(jobs);
    if (random_.below(2) == 0 || problem_.has_after()) {
        jobs = gather_unserved();
    } else {  // without those that were unserved before
        jobs = list_unserved();
        std::erase_if(jobs, [this, focus](std::int32_t job) {
            return job != focus && !current_.serves(job);
        });
    }
    insert_greedily(std::move(jobs), skips_of_proposals[random_.below(skips_of_proposals.size())]);
}

// Some jobs near each other, or of the kinds that steps remove.
std::vector<std::int32_t> TourSearch::choose_few(std::int32_t focus) {
    constexpr std::array kinds{RemovalKind::related, RemovalKind::random, RemovalKind::worst,
                               RemovalKind::strings};
    const std::size_t n = 1 + random_.below(most_moved);
    std::vector<std::int32_t> jobs;
    if (focus == none) {
        jobs = removals_.choose(trial_, kinds[random_.below(kinds.size())], n, random_);
        return jobs;
    }
    const auto near = removals_.near(focus);
    jobs.push_back(focus);
    while (jobs.size() < n && !near.empty()) {
        jobs.push_back(near[random_.below(std::min(near.size(), n_near_tours))]);
    }
    std::sort(jobs.begin(), jobs.end());
    jobs.erase(std::unique(jobs.begin(), jobs.end()), jobs.end());
    std::erase_if(jobs, [this](std::int32_t job) { return !trial_.serves(job); });
    return jobs;
}

std::vector<RobotId> TourSearch::list_moved() const {
    std::vector<RobotId> moved;
    for (const RobotId robot : trial_.changed()) {
        const auto before = current_.tour(robot).stops();
        const auto after = trial_.tour(robot).stops();
        if (!std::equal(before.begin(), before.end(), after.begin(), after.end())) {
            moved.push_back(robot);
        }
    }
    std::sort(moved.begin(), moved.end());
    return moved;
}

// Two tours exchange all stops after a job of one and before a job near it in the other, where no
// load of a job is on board (2-opt*, Potvin & Rousseau 1995).
void TourSearch::exchange_tails() {
    const auto job = static_cast<std::int32_t>(random_.below(problem_.n_jobs()));
    const auto near = removals_.near(job);
    if (near.empty() || !trial_.serves(job)) {
        return;
    }
    const std::int32_t other = near[random_.below(std::min(near.size(), n_near_tours))];
    if (!trial_.serves(other) || trial_.robot_of(other) == trial_.robot_of(job)) {
        return;
    }
    const std::array robots{trial_.robot_of(job), trial_.robot_of(other)};
    std::array<std::vector<std::int32_t>, 2> tails;
    std::array<std::vector<std::int32_t>, 2> heads;
    for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
        const auto stops = trial_.tour(robots[side]).stops();
        const std::int32_t at = side == 0 ? job : other;
        std::size_t cut = 0;
        while (problem_.stop(stops[cut]).job != at) {
            ++cut;
        }
        std::int32_t n_open = 0;  // jobs of which a stop is behind the cut and one ahead
        for (std::size_t k = 0; k < cut; ++k) {
            const TourStop& stop = problem_.stop(stops[k]);
            n_open += (stop.is_first ? 1 : 0) - (stop.is_last ? 1 : 0);
        }
        for (bool is_ahead = side == 0; (is_ahead || n_open > 0) && cut < stops.size(); ++cut) {
            const TourStop& stop = problem_.stop(stops[cut]);
            n_open += (stop.is_first ? 1 : 0) - (stop.is_last ? 1 : 0);
            is_ahead = is_ahead && !(stop.job == at && stop.is_last);
        }
        heads[side].assign(stops.begin(), stops.begin() + static_cast<std::ptrdiff_t>(cut));
        tails[side].assign(stops.begin() + static_cast<std::ptrdiff_t>(cut), stops.end());
    }
    for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
        for (const std::int32_t stop : tails[1 - side]) {
            if (!problem_.may_do(robots[side], problem_.stop(stop).job)) {
                return;
            }
        }
        heads[side].insert(heads[side].end(), tails[1 - side].begin(), tails[1 - side].end());
    }
    if (!trial_.replace(robots, heads)) {
        trial_.restore(current_);
    }
}

}  // namespace rightofway
