#include "tours/routed_moves.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/poll.hpp"
#include "core/reject.hpp"

namespace rightofway {
namespace {

constexpr std::array warmths{0.0, 0.1, 0.5, 8.0};  // of proposals, in mean costs of a job
constexpr std::size_t n_compared = 4;              // jobs, of which the latest one moves
constexpr Tick hold_edges = 16;  // as in prioritized planning: the price of an eviction
constexpr Tick price_holds = 2;
constexpr std::uint32_t polls_per_move = 64;
constexpr double warm_moves = 0.3;  // temperature of a cycle at first, in mean costs of a job
constexpr std::int64_t first_moves = 500;
constexpr std::int64_t moves_per_job = 20;  // of the first cycle, at least
constexpr std::int64_t moves_growth = 2;
constexpr std::size_t most_neighbours = 4;
constexpr Tick largest_slope = Tick{1} << 18;  // of the stages of a robot, as search keys allow

}  // namespace

RoutedMoves::RoutedMoves(const FleetSearch& fleet, TourSearch& tours, const RoutedTours& given,
                         std::uint64_t seed)
    : problem_(fleet.plan().problem()),
      tours_(tours),
      jobs_(tours.problem()),
      vertex_of_(given.vertex_of.begin(), given.vertex_of.end()),
      turn_of_(given.turn_of.begin(), given.turn_of.end()),
      job_cost_(given.cost.begin(), given.cost.end()),
      job_late_cost_(given.late_cost.begin(), given.late_cost.end()),
      distances_(problem_),
      plan_(fleet.plan()),
      search_(problem_.roads(), problem_.rules()),
      random_(seed, 1, 0),
      best_tours_(tours.best()) {
    const std::size_t n_robots = jobs_.n_robots();
    require_length("robots", static_cast<std::size_t>(problem_.n_robots()), n_robots);
    if (!problem_.has_times() || problem_.has_arcs()) {
        throw std::invalid_argument("problem: has no times of stages, or arcs between them");
    }
    require_length("vertex_of", vertex_of_.size(), static_cast<std::size_t>(jobs_.n_places()));
    require_ids("vertex_of", given.vertex_of, problem_.n_vertices());
    require_length("turn_of", turn_of_.size(), n_robots);
    require_length("completions", given.completions.size(), n_robots);
    require_length("stops", given.stops.size(), problem_.n_stages());
    require_length("ends", given.ends.size(), problem_.n_stages());
    if (!job_cost_.empty()) {
        require_length("cost", job_cost_.size(), jobs_.n_jobs());
        require_length("late_cost", job_late_cost_.size(), jobs_.n_jobs());
    }
    routed_.resize(n_robots);
    is_since_best_.assign(n_robots, 1);
    best_.resize(n_robots);
    best_tracks_.resize(n_robots);
    is_touched_.assign(n_robots, 0);
    is_waiting_.assign(n_robots, 0);
    n_evictions_.assign(n_robots, 0);
    begin_.assign(jobs_.n_jobs(), 0);
    end_.assign(jobs_.n_jobs(), 0);
    expected_.assign(jobs_.n_jobs(), 0);
    prices_.resize(n_robots);
    for (std::size_t r = 0; r < n_robots; ++r) {
        prices_[r] = price_holds * first_hold(static_cast<RobotId>(r));
    }
    take(given);
    best_cost_ = cost_ = cost_of(tours_.best());
    keep_best();
    cycle_length_ =
        std::max(first_moves, moves_per_job * static_cast<std::int64_t>(jobs_.n_jobs()));
}

// Takes over the stages of the problem.
void RoutedMoves::take(const RoutedTours& given) {
    std::int32_t n_stops = 0;
    for (std::int32_t job = 0; index(job) < jobs_.n_jobs(); ++job) {
        n_stops += jobs_.job(job).n_stops;
    }
    for (std::size_t r = 0; r < routed_.size(); ++r) {
        const auto robot = static_cast<RobotId>(r);
        const auto first = index(problem_.first_stage(robot));
        const auto end = index(problem_.first_stage(robot + 1));
        Routed& routed = routed_[r];
        for (std::size_t k = first; k + 1 < end; ++k) {
            const std::int32_t stop = given.stops[k];
            if (stop != none) {
                require_id("stops", stop, n_stops);
            }
            const auto stage = static_cast<std::int32_t>(k);
            add_stage(routed, stop, problem_.stage_vertex(stage), problem_.stage_work(stage),
                      robot);
            routed.ends.push_back(given.ends[k]);
        }
        add_last_stage(routed, robot);
        routed.completion = given.completions[r];
        routed.surcharges = plan_.surcharges(plan_.track(robot).visits);
        settle_costs(robot, routed);
        note_ends(robot);
        expect_ends(robot);
    }
}

Tick RoutedMoves::first_hold(RobotId robot) const {
    return problem_.pace(robot).empty() ? 1 : hold_edges * problem_.slowest_edge(robot);
}

void RoutedMoves::add_stage(Routed& routed, std::int32_t stop, VertexId vertex, Tick work,
                            RobotId robot) const {
    routed.stop.push_back(stop);
    routed.vertex.push_back(vertex);
    routed.work.push_back(work);
    routed.turn.push_back(turn_of_[index(robot)]);
    const bool is_work = stop != none;
    routed.earliest.push_back(is_work ? jobs_.stop(stop).earliest : 0);
    routed.latest.push_back(is_work ? jobs_.stop(stop).latest : never);
    if (!job_cost_.empty()) {
        const bool counts = is_work && jobs_.stop(stop).is_last;
        const std::int32_t job = is_work ? jobs_.stop(stop).job : 0;
        routed.cost.push_back(counts ? job_cost_[index(job)] : 0);
        routed.late_cost.push_back(counts ? job_late_cost_[index(job)] : 0);
        routed.due.push_back(counts ? jobs_.job(job).due : never);
    }
}

void RoutedMoves::add_last_stage(Routed& routed, RobotId robot) const {
    const TourRobot& one = jobs_.robot(robot);
    add_stage(routed, none, one.end < 0 ? none : vertex_of_[index(one.end)], 0, robot);
    routed.turn.back() = 0;
}

RoutedMoves::Routed RoutedMoves::read_tour(RobotId robot, const Tour& tour) const {
    Routed routed;
    const TourTimes& times = tour.times();
    auto charge = times.charges.begin();
    for (std::size_t k = 0; k <= tour.size(); ++k) {
        for (; charge != times.charges.end() && index(charge->gap) == k; ++charge) {
            add_stage(routed, none, vertex_of_[index(charge->place)], charge->ticks, robot);
        }
        if (k < tour.size()) {
            const TourStop& stop = jobs_.stop(tour.stops()[k]);
            add_stage(routed, tour.stops()[k], vertex_of_[index(stop.place)], stop.work, robot);
        }
    }
    add_last_stage(routed, robot);
    return routed;
}

// What the ends of a robot's stages cost.
void RoutedMoves::settle_costs(RobotId robot, Routed& routed) const {
    routed.service = 0;
    routed.track_cost = (job_cost_.empty() ? 1 : jobs_.robot(robot).weight) * routed.completion;
    for (std::size_t k = 0; k < routed.ends.size(); ++k) {
        if (const std::int32_t stop = routed.stop[k]; stop != none && jobs_.stop(stop).is_last) {
            routed.service += jobs_.service(jobs_.job(jobs_.stop(stop).job), routed.ends[k]);
        }
        if (!routed.cost.empty()) {
            routed.track_cost +=
                routed.cost[k] * routed.ends[k] +
                routed.late_cost[k] * std::max<Tick>(0, routed.ends[k] - routed.due[k]);
        }
    }
}

void RoutedMoves::note_ends(RobotId robot) {
    const Routed& routed = routed_[index(robot)];
    for (std::size_t k = 0; k < routed.ends.size(); ++k) {
        if (routed.stop[k] == none) {
            continue;
        }
        const TourStop& stop = jobs_.stop(routed.stop[k]);
        if (stop.is_first) {
            begin_[index(stop.job)] = routed.ends[k] - routed.work[k];
        }
        if (stop.is_last) {
            end_[index(stop.job)] = routed.ends[k];
        }
    }
}

void RoutedMoves::expect_ends(RobotId robot) {
    const Tour& tour = tours_.best().tour(robot);
    for (std::size_t k = 0; k < tour.size(); ++k) {
        if (const TourStop& stop = jobs_.stop(tour.stops()[k]); stop.is_last) {
            expected_[index(stop.job)] = tour.times().end[k];
        }
    }
}

RoutedMoves::Items RoutedMoves::items(RobotId robot) const {
    const Routed& routed = best_[index(robot)];
    const std::size_t n = routed.stop.size() - 1;
    return {std::span(routed.stop).first(n), std::span(routed.vertex).first(n),
            std::span(routed.work).first(n)};
}

RoutedMoves::Cost RoutedMoves::cost_of(const TourPlan& tours) const {
    const TourCost by_tours = tours.cost();
    Cost cost{by_tours.n_missing, by_tours.unserved, 0, 0};
    std::int64_t service = 0;
    std::int64_t sum = 0;
    std::int64_t weighted = 0;
    Tick last = 0;
    for (std::size_t r = 0; r < routed_.size(); ++r) {
        const Routed& routed = routed_[r];
        const std::int64_t weight = jobs_.robot(static_cast<RobotId>(r)).weight;
        service += routed.service;
        sum += routed.completion;
        weighted += weight * routed.completion;
        cost.flowtime += weight * (routed.completion + routed.surcharges);
        last = std::max(last, routed.completion);
    }
    switch (jobs_.objective()) {
        case TourObjective::service:
            cost.value = service;
            break;
        case TourObjective::flowtime:
            cost.value = sum;
            break;
        case TourObjective::makespan:
            cost.value = last;
            break;
        case TourObjective::both:
            cost.value = jobs_.robot_weights() * last + weighted;
            break;
    }
    return cost;
}

std::int64_t RoutedMoves::run(std::int64_t n_moves, std::int64_t most_gains,
                              const StopCondition& is_over) {
    Poll poll(is_over);
    std::int64_t done = 0;
    const std::int64_t enough = n_gains_ + most_gains;
    for (; done < n_moves && cycle_done_ < cycle_length_ && n_gains_ < enough &&
           !poll(polls_per_move);
         ++done) {
        ++cycle_done_;
        if (try_move(is_over) && cost_ < best_cost_) {
            ++n_gains_;
            keep_best();
        }
    }
    if (cycle_done_ == cycle_length_) {
        cycle_done_ = 0;
        cycle_length_ *= moves_growth;
    }
    return done;
}

void RoutedMoves::keep_best() {
    best_cost_ = cost_;
    best_tours_ = tours_.best();
    for (std::size_t r = 0; r < routed_.size(); ++r) {
        if (std::exchange(is_since_best_[r], std::uint8_t{0}) != 0) {
            best_[r] = routed_[r];
            best_tracks_[r] = plan_.track(static_cast<RobotId>(r));
        }
    }
}

void RoutedMoves::finish() {
    for (const bool is_removal : {true, false}) {
        for (std::size_t r = 0; r < routed_.size(); ++r) {
            if (is_since_best_[r] != 0) {
                TimedTrack track = is_removal ? TimedTrack{} : best_tracks_[r];
                plan_.exchange(static_cast<RobotId>(r), track);
            }
        }
    }
    tours_.take(best_tours_);
    for (std::size_t r = 0; r < routed_.size(); ++r) {
        if (std::exchange(is_since_best_[r], std::uint8_t{0}) != 0) {
            routed_[r] = best_[r];
            note_ends(static_cast<RobotId>(r));
            expect_ends(static_cast<RobotId>(r));
        }
    }
    cost_ = best_cost_;
}

double RoutedMoves::energy(const Cost& cost) const {
    const auto flowtime = static_cast<double>(cost.flowtime);
    const auto value = static_cast<double>(cost.value);
    switch (jobs_.objective()) {
        case TourObjective::service:
            return value + 1e-6 * flowtime;
        case TourObjective::makespan:
            return jobs_.makespan_weight() * value + flowtime;
        default:
            return value;
    }
}

bool RoutedMoves::accepts(const Cost& cost) {
    if (cost <= cost_) {
        return true;
    }
    if (cost.n_missing != cost_.n_missing || cost.unserved != cost_.unserved) {
        return false;
    }
    const double mean = energy(best_cost_) / static_cast<double>(best_tours_.n_served() + 1);
    const double cold = static_cast<double>(cycle_done_) / static_cast<double>(cycle_length_);
    const double temperature = warm_moves * (1 - cold) * (1 - cold) * mean;
    const double share = static_cast<double>((random_.next() >> 11) + 1) * 0x1.0p-53;
    return energy(cost) - energy(cost_) < -std::log(share) * temperature;
}

// A job that ends later than its tour expects, or any job: `none`. Unserved jobs come first.
std::int32_t RoutedMoves::choose_job() {
    if (jobs_.n_jobs() == 0 || random_.below(2) == 0) {
        return none;
    }
    std::int32_t chosen = none;
    Tick most = 0;
    for (std::size_t k = 0; k < n_compared; ++k) {
        const auto job = static_cast<std::int32_t>(random_.below(jobs_.n_jobs()));
        const Tick late = tours_.best().serves(job)
                              ? jobs_.job(job).weight * (end_[index(job)] - expected_[index(job)])
                              : never;
        if (late > most) {
            most = late;
            chosen = job;
        }
    }
    return chosen;
}

// Proposes other tours; the robots that have them.
std::vector<RobotId> RoutedMoves::change_tours() {
    return tours_.propose(choose_job(), warmths[random_.below(warmths.size())]);
}

// Adds some robots that are at about the same time at a place of a robot's track.
void RoutedMoves::add_near(RobotId robot, std::vector<RobotId>& robots) {
    const auto& visits = plan_.track(robot).visits;
    for (std::size_t k = 0; k < most_neighbours; ++k) {
        const Visit& visit = visits[random_.below(visits.size())];
        const auto booked = plan_.bookings().at(problem_.vertex_row(robot, visit.vertex));
        const auto at = static_cast<std::size_t>(
            BookingTable::started(booked, visit.enter));  // those before it, with its own
        for (std::size_t other = at < 2 ? 0 : at - 2; other < std::min(at + 1, booked.size());
             ++other) {
            const RobotId one = booked[other].robot;
            if (one != nobody && std::find(robots.begin(), robots.end(), one) == robots.end()) {
                robots.push_back(one);
            }
        }
    }
}

std::vector<RobotId> RoutedMoves::choose_near() {
    std::vector<RobotId> robots{static_cast<RobotId>(random_.below(jobs_.n_robots()))};
    add_near(robots.front(), robots);
    robots.resize(std::min(robots.size(), 1 + random_.below(most_neighbours)));
    return robots;
}

// Whether a move was accepted.
bool RoutedMoves::try_move(const StopCondition& is_over) {
    has_proposal_ = random_.below(2) == 0;
    std::vector<RobotId> changed = has_proposal_ ? change_tours() : std::vector<RobotId>{};
    if (has_proposal_ && changed.empty()) {
        return false;
    }
    std::vector<RobotId> moved = has_proposal_ ? changed : choose_near();
    if (has_proposal_ && random_.below(2) == 0) {
        add_near(changed[random_.below(changed.size())], moved);
        moved.resize(std::min(moved.size(), changed.size() + random_.below(most_neighbours)));
    }
    waiting_.assign(moved.begin(), moved.end());
    for (std::size_t k = waiting_.size(); k > 1; --k) {
        std::swap(waiting_[k - 1], waiting_[random_.below(k)]);
    }
    slack_ = 0;
    for (const RobotId robot : moved) {
        touch(robot);
        is_waiting_[index(robot)] = 1;
        hold(robot, true);
    }
    for (const RobotId robot : changed) {
        routed_[index(robot)] = read_tour(robot, tours_.proposed().tour(robot));
        routed_[index(robot)].has_changed = true;
    }
    is_limited_ = serves_the_same();
    if (is_limited_) {  // as annealing could accept, as a rule
        slack_ += slack_ / 16;
    }
    bool is_accepted = std::all_of(moved.begin(), moved.end(), [this](RobotId robot) {
        const Routed& routed = routed_[index(robot)];
        const Tick slope = std::accumulate(routed.cost.begin(), routed.cost.end(), Tick{0});
        return std::accumulate(routed.late_cost.begin(), routed.late_cost.end(), slope) <=
               largest_slope;
    });
    try {
        is_accepted = is_accepted && place_all(is_over) && keeps_order();
    } catch (...) {
        undo();
        throw;
    }
    const Cost cost =
        is_accepted ? cost_of(has_proposal_ ? tours_.proposed() : tours_.best()) : Cost{};
    if (!is_accepted || !accepts(cost)) {
        undo();
        return false;
    }
    if (has_proposal_) {
        tours_.take_proposed();
    }
    cost_ = cost;
    for (const RobotId robot : changed) {
        expect_ends(robot);
    }
    for (const Touched& one : touched_) {
        n_evictions_[index(one.robot)] = 0;
        is_touched_[index(one.robot)] = 0;
        is_since_best_[index(one.robot)] = 1;
    }
    touched_.clear();
    return true;
}

}  // namespace rightofway
