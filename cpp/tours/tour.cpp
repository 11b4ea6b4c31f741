#include "tours/tour.hpp"

namespace rightofway {

void Tour::find_earliest(std::span<const Tick> releases) {
    earliest_.clear();
    for (const std::int32_t stop : stops_) {
        const TourStop& at = problem_->stop(stop);
        earliest_.push_back(at.is_first ? std::max(at.earliest, releases[index(at.job)])
                                        : at.earliest);
    }
}

// Computes the times without charges. False if a load or `latest` is not kept.
bool Tour::drive_all() {
    const TourRobot& robot = problem_->robot(robot_);
    leave_.assign(1, robot.ready);
    load_.assign(1, robot.load);
    service_before_.assign(1, 0);
    for (std::size_t k = 0; k < stops_.size(); ++k) {
        const TourStop& stop = problem_->stop(stops_[k]);
        const Tick arrival = leave_[k] + problem_->drive(robot, place_before(k), stop.place);
        const Tick end = std::max(arrival, earliest_[k]) + stop.work;
        const std::int32_t load = load_[k] + stop.load;
        if (end > stop.latest || arrival >= TourProblem::no_way || load < 0 ||
            load > robot.capacity) {
            return false;
        }
        leave_.push_back(end);
        load_.push_back(load);
        service_before_.push_back(
            service_before_[k] +
            (stop.is_last ? problem_->service(problem_->job(stop.job), end) : 0));
    }
    const std::size_t n = stops_.size();
    bare_completion_ =
        leave_[n] + problem_->drive(robot, place_before(n), place_after(n, place_before(n)));
    return bare_completion_ < TourProblem::no_way;
}

bool Tour::schedule(std::span<const Tick> releases, ChargePlanner& charges) {
    find_earliest(releases);
    if (!drive_all() && !stops_.empty()) {
        return false;
    }
    if (has_battery() && charges.plan(robot_, stops_, releases, times_)) {
        return true;
    }
    if (has_battery() && !stops_.empty()) {
        return false;
    }
    times_.charges.clear();
    times_.begin.clear();
    times_.end.assign(leave_.begin() + 1, leave_.end());
    for (std::size_t k = 0; k < stops_.size(); ++k) {
        times_.begin.push_back(times_.end[k] - problem_->stop(stops_[k]).work);
    }
    times_.completion = std::min(bare_completion_, problem_->horizon());
    times_.service = service_before_.back();
    return true;
}

// Functions of the arrival after each gap, from the last gap to the first. With a drive of d ticks
// after stop k, an arrival at t begins work at b(t) = max(t, earliest), and
//   latest(k)     = min(latest end, latest(k + 1) - d) - work
//   completion(t) = completion(k + 1)(b(t) + work + d)
//   service(t)    = cost of the end b(t) + work, + service(k + 1)(b(t) + work + d)
void Tour::prepare(std::span<const Tick> releases, std::span<const Tick> limits) {
    find_earliest(releases);
    const TourRobot& robot = problem_->robot(robot_);
    const std::size_t n = stops_.size();
    latest_.resize(n + 1);
    floor_.resize(n + 1);
    rest_.resize(n + 1);
    first_piece_.resize(n + 1);
    last_piece_.resize(n + 1);
    pieces_.assign(1, {0, 0, 0});
    latest_[n] = problem_->horizon();
    floor_[n] = 0;
    rest_[n] = 0;
    first_piece_[n] = 0;
    last_piece_[n] = 1;
    for (std::size_t k = n; k-- > 0;) {
        const TourStop& stop = problem_->stop(stops_[k]);
        const Tick drive = problem_->drive(robot, stop.place, place_after(k + 1, stop.place));
        const Tick latest_end =
            stop.is_last ? std::min(stop.latest, limits[index(stop.job)]) : stop.latest;
        latest_[k] = std::min(latest_end, latest_[k + 1] - drive) - stop.work;
        rest_[k] = stop.work + drive + rest_[k + 1];
        floor_[k] = std::max(floor_[k + 1], earliest_[k] + rest_[k]);
        if (problem_->objective() == TourObjective::service) {
            prepare_service(k, drive);
        }
    }
}

// The pieces of service(k), from those of k + 1. No arrival before that of the tour is of interest.
void Tour::prepare_service(std::size_t gap, Tick drive) {
    const TourStop& stop = problem_->stop(stops_[gap]);
    const TourJob& job = problem_->job(stop.job);
    const Tick arrival =
        leave_[gap] + problem_->drive(problem_->robot(robot_), place_before(gap), stop.place);
    const Tick step = stop.work + drive;
    const auto value = [&](Tick begin) {
        return service_from(gap + 1, begin + step) +
               (stop.is_last ? problem_->service(job, begin + stop.work) : 0);
    };
    const auto slope = [&](Tick begin) {
        return stop.is_last ? problem_->service_slope(job, begin + stop.work) : 0;
    };
    const Tick first = std::max(arrival, earliest_[gap]);
    first_piece_[gap] = pieces_.size();
    if (first > arrival) {
        pieces_.push_back({arrival, value(first), 0});
    }
    const Tick due = stop.is_last && job.due != never ? job.due - stop.work : never;
    const std::size_t end = last_piece_[gap + 1];
    for (std::size_t p = first_piece_[gap + 1]; p < end; ++p) {
        const Piece piece = pieces_[p];
        const Tick next = p + 1 < end ? pieces_[p + 1].from - step : never;
        if (next <= first) {
            continue;
        }
        const Tick from = std::max(piece.from - step, first);
        pieces_.push_back({from, value(from), piece.slope + slope(from)});
        if (due > from && due < next) {
            pieces_.push_back({due, value(due), piece.slope + slope(due)});
        }
    }
    last_piece_[gap] = pieces_.size();
}

std::int64_t Tour::service_from(std::size_t gap, Tick arrival) const {
    const auto all = pieces(gap);
    std::size_t k = all.size() - 1;
    while (k > 0 && all[k].from > arrival) {
        --k;
    }
    return all[k].value + all[k].slope * std::max<Tick>(arrival - all[k].from, 0);
}

}  // namespace rightofway
