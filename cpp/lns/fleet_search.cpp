#include "lns/fleet_search.hpp"

#include <algorithm>
#include <chrono>
#include <string>
#include <utility>

#include "core/reject.hpp"
#include "distances/trip.hpp"
#include "lns/one_at_a_time.hpp"
#include "lns/prioritized.hpp"

namespace rightofway {
namespace {

// Upper limit of a sum of times over a fleet.
constexpr Tick longest_sum = Tick{1} << 60;
constexpr std::size_t most_threads = 1024;
constexpr auto between_questions = std::chrono::milliseconds(5);

void require_count(const char* name, std::int64_t count) {
    if (count < 0) {
        reject(name, count, "is negative");
    }
}

}  // namespace

FleetSearch::FleetSearch(const Problem& problem, std::uint64_t seed, std::size_t n_threads,
                         Objective objective, Tick horizon)
    : problem_(problem),
      distances_(problem),
      plan_(problem, objective, horizon),
      seed_(seed),
      n_threads_(n_threads) {
    if (objective != Objective::flowtime && problem.has_surcharges()) {
        throw std::invalid_argument("objective: a makespan has no surcharges (minimize flowtime)");
    }
    if (horizon < 0 || horizon > never) {
        reject("horizon", horizon, "is not in 0..2^62");
    }
    if (n_threads < 1 || n_threads > most_threads) {
        reject("n_threads", static_cast<std::int64_t>(std::min(n_threads, std::size_t{1} << 62)),
               "is not in 1.." + std::to_string(most_threads));
    }
}

// Null if there was no time.
const std::vector<Tick>* FleetSearch::alone(const StopCondition& deadline) {
    if (!is_alone_known_) {
        std::vector<Tick> alone(static_cast<std::size_t>(problem_.n_robots()));
        auto asked = std::chrono::steady_clock::now();
        for (RobotId robot = 0; robot < problem_.n_robots(); ++robot) {
            const auto now = std::chrono::steady_clock::now();
            if (robot == 0 || now - asked > between_questions) {
                asked = now;
                if (deadline()) {
                    return nullptr;
                }
            }
            alone[index(robot)] = distances_.alone(robot);
        }
        alone_ = std::move(alone);
        measure_least();
        is_alone_known_ = true;
    }
    return &alone_;
}

// What robots cost at least; without ways these numbers are never used.
void FleetSearch::measure_least() {
    least_costs_ = alone_;
    const std::vector<Tick> ends =
        problem_.has_times() ? distances_.least_ends() : std::vector<Tick>{};
    bound_ = 0;
    for (RobotId robot = 0; robot < problem_.n_robots(); ++robot) {
        Tick& least = least_costs_[index(robot)];
        if (problem_.has_costs()) {
            const Itinerary itinerary = problem_.itinerary(robot);
            const std::size_t n = itinerary.n_stages() - (itinerary.ends_anywhere() ? 1 : 0);
            const auto first = index(problem_.first_stage(robot));
            least = cost_of_ends(itinerary, std::span(ends).subspan(first, n), least);
        }
        bound_ += problem_.weight(robot) * least;
    }
}

void FleetSearch::take_alone(std::span<const Tick> alone) {
    require_ranges("alone", alone, -1, latest());
    distances_.take_alone(alone);
}

bool FleetSearch::prioritize(std::span<const RobotId> order, std::int64_t n_searches,
                             const StopCondition& deadline, const StopCondition& with_fallback) {
    require_count("n_searches", n_searches);
    require_length("order", order.size(), n_robots());
    require_each_once(order);
    clear();
    portfolio_.emplace(distances_, plan_, order);
    return resume(n_searches, deadline, with_fallback);
}

bool FleetSearch::compete(std::span<const RobotId> order, std::int64_t n_searches,
                          const StopCondition& deadline) {
    require_count("n_searches", n_searches);
    require_length("order", order.size(), n_robots());
    require_each_once(order);
    require_all_tracks("compete");
    if (!rival_) {
        rival_ = std::make_unique<Rival>(distances_, problem_, plan_.objective(), plan_.horizon(),
                                         order);
    }
    if (rival_->portfolio.run(n_searches, n_threads_ > 1, deadline, deadline)) {
        take_if_better(rival_->portfolio.best());
    }
    const bool has_ended = rival_->portfolio.has_ended();
    if (has_ended) {
        rival_.reset();
    }
    return has_ended;
}

void FleetSearch::hurry(std::span<const RobotId> order, std::int64_t n_searches,
                        const StopCondition& deadline) {
    require_count("n_searches", n_searches);
    require_length("order", order.size(), n_robots());
    require_each_once(order);
    require_all_tracks("hurry");
    FleetPlan plan(problem_, plan_.objective(), plan_.horizon());
    TrackPrices prices = greedy;
    prices.states_between_raises *= problem_.n_robots();
    Prioritized planner(distances_, plan, prices);
    planner.start(order);
    if (planner.run(n_searches, deadline) == SearchEnd::found) {
        take_if_better(plan);
    }
}

void FleetSearch::take_if_better(const FleetPlan& plan) {
    if (plan.worth() < plan_.worth()) {
        improvement_.reset();
        plan_ = plan;
    }
}

bool FleetSearch::move_one_at_a_time(const StopCondition& deadline) {
    if (!problem_.has_times()) {
        throw std::invalid_argument("move_one_at_a_time: is for stages with times");
    }
    clear();
    OneAtATime moves(distances_);
    if (moves.run(deadline) != SearchEnd::found) {
        return false;
    }
    std::vector<TimedTrack>& tracks = moves.tracks();
    if (plan_.measure_all(tracks) != nobody) {
        return false;  // a stage ends too late
    }
    for (RobotId robot = 0; robot < problem_.n_robots(); ++robot) {
        if (!plan_.fits(robot, tracks[index(robot)])) {
            clear();
            return false;
        }
        plan_.exchange(robot, tracks[index(robot)]);
    }
    return true;
}

bool FleetSearch::repair(std::span<const RobotId> order, std::int64_t n_searches,
                         const StopCondition& deadline) {
    require_count("n_searches", n_searches);
    require_each_once(order);
    for (std::size_t k = 0; k < order.size(); ++k) {
        if (plan_.has_track(order[k])) {
            reject_entry("order", k, order[k], "is a robot that has a track");
        }
    }
    const auto is_left_out = [&](RobotId robot) {
        return !plan_.has_track(robot) &&
               std::find(order.begin(), order.end(), robot) == order.end();
    };
    for (RobotId robot = 0; robot < problem_.n_robots(); ++robot) {
        if (is_left_out(robot)) {
            reject("order", robot, "is a robot without a track, and left out");
        }
    }
    drop_searches();
    Prioritized planner(distances_, plan_);
    planner.start(order);
    return planner.run(n_searches, deadline) == SearchEnd::found;
}

bool FleetSearch::resume(std::int64_t n_searches, const StopCondition& deadline,
                         const StopCondition& with_fallback) {
    require_count("n_searches", n_searches);
    if (!portfolio_) {
        throw std::invalid_argument("resume: there is no attempt to continue (prioritize first)");
    }
    if (!portfolio_->run(n_searches, n_threads_ > 1, deadline, with_fallback)) {
        return false;
    }
    if (const FleetPlan& best = portfolio_->best(); &best != &plan_) {
        plan_ = best;
    }
    portfolio_.reset();
    return true;
}

void FleetSearch::start(const GivenTracks& given) {
    require_tracks(given);
    clear();
    std::vector<TimedTrack> tracks = tracks_of(given);
    for (RobotId robot = 0; robot < problem_.n_robots(); ++robot) {
        TimedTrack& track = tracks[index(robot)];
        if (track.visits.empty()) {
            continue;
        }
        if (!plan_.fits(robot, track)) {
            clear();
            reject("robot", robot, "has a track that breaks the rules: it overlaps another one");
        }
        plan_.exchange(robot, track);
    }
}

// While robots wait for their turn, their earlier tracks are in the plan, though they miss stages:
// so no two tracks ever overlap, and the plan is valid whenever the time ends.
std::vector<RobotId> FleetSearch::take_over(const GivenTracks& given,
                                            std::span<const RobotId> order,
                                            const StopCondition& deadline) {
    require_tracks(given);
    require_each_once(order);
    clear();
    std::vector<std::uint8_t> misses_stage(n_robots(),
                                           0);  // the track in the plan is an earlier one
    for (RobotId robot = 0; robot < problem_.n_robots(); ++robot) {
        if (given.first_visit[index(robot)] == given.first_visit[index(robot + 1)]) {
            continue;
        }
        TimedTrack track;
        try {
            track = track_of(robot, given);
        } catch (const std::invalid_argument&) {  // the robot is elsewhere, or later
            continue;
        }
        const bool serves_all = measure(robot, track);
        if (plan_.fits(robot, track)) {
            misses_stage[index(robot)] = serves_all ? 0 : 1;
            plan_.exchange(robot, track);
        }
    }
    SafeIntervalSearch search(problem_.roads(), problem_.rules());
    TripReader reader(distances_, true);
    for (const RobotId robot : order) {
        if (deadline()) {
            break;
        }
        if (replace_track(robot, search, reader, deadline)) {
            misses_stage[index(robot)] = 0;
        }
    }
    std::vector<RobotId> left;
    for (RobotId robot = 0; robot < problem_.n_robots(); ++robot) {
        if (misses_stage[index(robot)] != 0) {
            TimedTrack no_track;
            plan_.exchange(robot, no_track);
        }
        if (!plan_.has_track(robot)) {
            left.push_back(robot);
        }
    }
    return left;
}

// Whether a track serves all stages between those of the others; fills in its ends and its cost.
bool FleetSearch::measure(RobotId robot, TimedTrack& track) const {
    if (!problem_.has_arcs()) {
        return plan_.measure(robot, track);
    }
    StageLimits limits;
    plan_.find_limits(robot, false, limits);
    return plan_.measure(robot, track, limits);
}

// Gives a robot a track around all others; where there is none, the one that it had.
bool FleetSearch::replace_track(RobotId robot, SafeIntervalSearch& search, TripReader& reader,
                                const StopCondition& deadline) {
    TimedTrack track;
    plan_.exchange(robot, track);
    StageLimits limits;
    if (problem_.has_arcs()) {
        plan_.find_limits(robot, true, limits);
    }
    const Trip& trip = problem_.has_arcs() ? reader.read(robot, limits.earliest, limits.latest)
                                           : reader.read(robot);
    if (search.run({trip, plan_.bookings()}, deadline) == SearchEnd::found) {
        TimedTrack found;
        search.track(found.visits);
        if (measure(robot, found) && plan_.fits(robot, found)) {
            plan_.exchange(robot, found);
            return true;
        }
    }
    plan_.exchange(robot, track);
    return false;
}

// The given tracks do not conflict with each other. So a robot can have its track again if all
// robots in the way of it have theirs, and those in the way of these, and so on.
std::int64_t FleetSearch::restore(const GivenTracks& given, const StopCondition& interrupt) {
    require_tracks(given);
    require_all_tracks("restore");
    improvement_.reset();
    Poll poll(interrupt);
    std::vector<TimedTrack> old = tracks_of(given);
    FleetPlan together(problem_, plan_.objective(), plan_.horizon());
    for (RobotId robot = 0; robot < problem_.n_robots(); ++robot) {
        if (old[index(robot)].visits.empty()) {
            reject("robot", robot, "has an empty track");
        }
        if (!together.fits(robot, old[index(robot)])) {
            reject("robot", robot, "has a track that breaks the rules: it overlaps another one");
        }
        TimedTrack same = old[index(robot)];
        together.exchange(robot, same);
    }
    std::int64_t n_restored = 0;
    std::vector<std::uint8_t> is_restored(n_robots(), 0);
    for (bool has_changed = true; has_changed;) {
        has_changed = false;
        for (RobotId first = 0; first < problem_.n_robots(); ++first) {
            if (is_restored[index(first)] != 0) {
                continue;
            }
            const std::vector<RobotId> group = find_conflict_closure(first, old, poll);
            Tick gain = 0;
            for (const RobotId robot : group) {
                gain += problem_.weight(robot) * (plan_.track(robot).cost - old[index(robot)].cost);
            }
            if (gain < 0) {
                continue;
            }
            const Worth before = plan_.worth();
            for (const RobotId robot : group) {
                plan_.exchange(robot, old[index(robot)]);
            }
            if (plan_.worth() > before) {  // the flowtime is no greater, but the makespan is
                for (const RobotId robot : group) {
                    plan_.exchange(robot, old[index(robot)]);
                }
                continue;
            }
            for (const RobotId robot : group) {
                is_restored[index(robot)] = 1;
            }
            n_restored += static_cast<std::int64_t>(group.size());
            has_changed = true;
        }
    }
    return n_restored;
}

std::int64_t FleetSearch::improve(std::int64_t n_tasks, std::int64_t patience,
                                  const StopCondition& deadline, const StopCondition& pause) {
    require_count("n_tasks", n_tasks);
    require_count("patience", patience);
    require_all_tracks("improve");
    if (problem_.n_robots() == 0 || alone(deadline) == nullptr) {
        return 0;
    }
    if (!improvement_) {
        improvement_.emplace(distances_, plan_, least_costs_, seed_, n_threads_);
    }
    const std::int64_t before = improvement_->n_tasks();
    improvement_->run(n_tasks, patience, deadline,
                      [&] { return plan_.cost() == bound_ || pause(); });
    return improvement_->n_tasks() - before;
}

void FleetSearch::retime(const StopCondition& interrupt) {
    require_all_tracks("retime");
    improvement_.reset();
    plan_.retime(interrupt);
}

// The latest time of a robot, so that no sum over the fleet overflows.
Tick FleetSearch::latest() const { return longest_sum / std::max(problem_.n_robots(), 1); }

void FleetSearch::require_each_once(std::span<const RobotId> order) const {
    require_ids("order", order, problem_.n_robots());
    std::vector<std::uint8_t> is_listed(n_robots(), 0);
    for (std::size_t k = 0; k < order.size(); ++k) {
        if (is_listed[index(order[k])]++ != 0) {
            reject_entry("order", k, order[k], "is there twice");
        }
    }
}

void FleetSearch::require_tracks(const GivenTracks& given) const {
    require_length("first_visit", given.first_visit.size(), n_robots() + 1);
    require_lists("first_visit", given.first_visit, given.vertices.size(), "visits");
    require_length("enter", given.enter.size(), given.vertices.size());
    require_ids("vertices", given.vertices, problem_.n_vertices());
    require_ranges("enter", given.enter, 0, latest());
}

void FleetSearch::require_all_tracks(const char* what) const {
    for (RobotId robot = 0; robot < problem_.n_robots(); ++robot) {
        if (!plan_.has_track(robot)) {
            reject(what, robot, "is a robot without a track (start, prioritize or repair first)");
        }
    }
}

// A robot, and all that have to give way for it to have its track of `old`.
std::vector<RobotId> FleetSearch::find_conflict_closure(RobotId first,
                                                        std::span<const TimedTrack> old,
                                                        Poll& poll) const {
    std::vector<RobotId> group{first};
    std::vector<RobotId> conflicting;
    for (std::size_t k = 0; k < group.size(); ++k) {
        poll();
        plan_.find_conflicting(group[k], old[index(group[k])], conflicting);
        for (const RobotId other : conflicting) {
            if (std::find(group.begin(), group.end(), other) == group.end()) {
                group.push_back(other);
            }
        }
    }
    return group;
}

// A track of a robot that has visits. Throws unless it leads from its home at tick 0 through
// its stages, no faster than it drives.
TimedTrack FleetSearch::track_of(RobotId robot, const GivenTracks& given) const {
    const Turns turns = problem_.turns(robot);
    EdgeId before = -1;
    TimedTrack track;
    const auto first = index(given.first_visit[index(robot)]);
    const auto end = index(given.first_visit[index(robot + 1)]);
    if (given.vertices[first] != problem_.home(robot)) {
        reject_entry("vertices", first, given.vertices[first],
                     "is not the home of robot " + std::to_string(robot) + ", " +
                         std::to_string(problem_.home(robot)));
    }
    if (given.enter[first] != 0) {
        reject_entry("enter", first, given.enter[first], "must be 0 on a first visit");
    }
    track.visits.push_back({0, given.vertices[first], 0});
    for (std::size_t k = first + 1; k < end; ++k) {
        const VertexId tail = given.vertices[k - 1];
        const EdgeId edge = problem_.graph().edge(tail, given.vertices[k]);
        if (edge < 0) {
            reject_entry("vertices", k, given.vertices[k], "is not next to the one before");
        }
        const std::int32_t drive = problem_.drive(robot, edge);
        if (drive == barred) {
            reject_entry(
                "vertices", k, given.vertices[k],
                "is entered along an edge that is barred to robot " + std::to_string(robot));
        }
        const std::int32_t turn = turns.between(before, edge);
        const Tick from = std::max(given.enter[k - 1], problem_.ready(robot));
        if (given.enter[k] - from < Tick{turn} + drive) {
            reject_entry("enter", k, given.enter[k],
                         "is sooner than robot " + std::to_string(robot) +
                             " can turn and drive there, " + std::to_string(Tick{turn} + drive) +
                             " ticks after the visit before");
        }
        track.visits.push_back({given.enter[k], given.vertices[k], drive, turn});
        before = edge;
    }
    return track;
}

// The tracks of all robots, empty for robots without visits.
std::vector<TimedTrack> FleetSearch::tracks_of(const GivenTracks& given) const {
    std::vector<TimedTrack> tracks(n_robots());
    for (RobotId robot = 0; robot < problem_.n_robots(); ++robot) {
        if (given.first_visit[index(robot)] < given.first_visit[index(robot + 1)]) {
            tracks[index(robot)] = track_of(robot, given);
        }
    }
    const RobotId failing = plan_.measure_all(tracks);
    if (failing != nobody) {
        reject("robot", failing, "has a track that breaks the rules: it misses a stage");
    }
    return tracks;
}

// Searches that continue from the present plan.
void FleetSearch::drop_searches() {
    portfolio_.reset();
    improvement_.reset();
}

void FleetSearch::clear() {
    drop_searches();
    plan_ = FleetPlan(problem_, plan_.objective(), plan_.horizon());
    if (problem_.has_arcs()) {
        plan_.expect_ends(distances_.least_ends());
    }
}

}  // namespace rightofway
