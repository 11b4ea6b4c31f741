// The cost of a job on each robot, and the reasons for which no tour serves a job.
#include <algorithm>
#include <utility>

#include "tours/tour_search.hpp"

namespace rightofway {

std::vector<std::optional<std::int64_t>> TourSearch::compare_robots(std::int32_t job) {
    TourPlan without = best_;
    without.remove(std::span(&job, 1));
    const TourPlan kept = std::exchange(trial_, without);
    std::vector<std::optional<std::int64_t>> values(problem_.n_robots() + 1);
    values.back() = without.cost().value;
    Insertion best;
    for (RobotId robot = 0; index(robot) < problem_.n_robots() && trial_.is_open(job); ++robot) {
        best.score = impossible;
        best.robot = nobody;
        try_robot(job, robot, 0, best);
        if (best.exists() && trial_.insert(job, best)) {
            values[index(robot)] = trial_.cost().value;
            trial_.restore(without);
        }
    }
    trial_ = kept;
    return values;
}

UnservedReason TourSearch::explain(std::int32_t job) {
    const auto& after = problem_.job(job).after;
    if (!std::all_of(after.begin(), after.end(),
                     [this](std::int32_t j) { return best_.serves(j); })) {
        return UnservedReason::after;
    }
    Tick release = 0;
    for (const std::int32_t earlier : after) {
        release = std::max(release, find_least_end(earlier));
    }
    UnservedReason reason = UnservedReason::robot;
    for (const RobotId robot : problem_.job(job).robots) {
        const UnservedReason here = explain_on(job, robot, release);
        if (here == UnservedReason::not_found || reason < here) {
            reason = here;
        }
    }
    return reason;
}

// Why a robot cannot do the job as its only one.
UnservedReason TourSearch::explain_on(std::int32_t job, RobotId robot, Tick release) {
    const TourRobot& alone = problem_.robot(robot);
    std::vector<std::int32_t> stops;
    Tick t = alone.ready;
    std::int32_t at = alone.start;
    std::int32_t load = 0;
    auto reason = UnservedReason::not_found;
    for (const TourStop& stop : problem_.stops_of(problem_.job(job))) {
        load += stop.load;
        if (load > alone.capacity) {
            return UnservedReason::robot;
        }
        t = std::max(t + problem_.drive(alone, at, stop.place),
                     stop.is_first ? std::max(stop.earliest, release) : stop.earliest) +
            stop.work;
        at = stop.place;
        reason = t > stop.latest ? UnservedReason::latest : reason;
        stops.push_back(problem_.job(job).first_stop + static_cast<std::int32_t>(stops.size()));
    }
    if (t + problem_.drive(alone, at, alone.end < 0 ? at : alone.end) >= TourProblem::no_way) {
        return UnservedReason::way;
    }
    if (reason != UnservedReason::latest && alone.battery >= 0) {
        std::vector<Tick> releases(problem_.n_jobs(), 0);
        releases[index(job)] = release;
        TourTimes times;
        reason = charges_.plan(robot, stops, releases, times) ? reason : UnservedReason::battery;
    }
    return reason;
}

// The least tick at which the job can end on any robot, alone and without charges.
Tick TourSearch::find_least_end(std::int32_t job) {
    Tick& least = least_ends_[index(job)];
    if (least >= 0) {
        return least;
    }
    Tick release = 0;
    for (const std::int32_t earlier : problem_.job(job).after) {
        release = std::max(release, find_least_end(earlier));
    }
    least = TourProblem::no_way;
    for (const RobotId robot : problem_.job(job).robots) {
        const TourRobot& alone = problem_.robot(robot);
        Tick t = alone.ready;
        std::int32_t at = alone.start;
        for (const TourStop& stop : problem_.stops_of(problem_.job(job))) {
            t = std::max(t + problem_.drive(alone, at, stop.place),
                         stop.is_first ? std::max(stop.earliest, release) : stop.earliest) +
                stop.work;
            at = stop.place;
        }
        least = std::min(least, t);
    }
    return least;
}

}  // namespace rightofway
