#include "lns/window_search.hpp"

#include <algorithm>

namespace rightofway {

namespace {

// A robot comes out of its window later by at most so many of its slowest edges.
constexpr Tick most_edges_later = 32;

}  // namespace

bool may_have_windows(const Problem& problem) {
    if (!problem.has_times() || problem.books_edges()) {
        return false;
    }
    for (RobotId robot = 0; robot < problem.n_robots(); ++robot) {
        if (problem.turns(robot).take_time()) {
            return false;
        }
    }
    return true;
}

WindowSearch::WindowSearch(SharedDistances& distances, FleetPlan& plan)
    : problem_(distances.problem()),
      plan_(plan),
      search_(distances.problem().roads(), distances.problem().rules()),
      reader_(distances) {}

// Sets the trip of a robot, with the limits that other robots set, and what its track serves when.
void WindowSearch::read(RobotId robot) {
    if (problem_.has_arcs()) {
        plan_.find_limits(robot, true, limits_);
        trip_ = &reader_.read(robot, limits_.earliest, limits_.latest);
    } else {
        trip_ = &reader_.read(robot);
    }
    completion(*trip_, plan_.track(robot).visits, &stage_after_, &ends_);
}

bool WindowSearch::choose(RobotId robot, Tick middle, Tick around, TrackWindow& window) {
    read(robot);
    const auto& visits = plan_.track(robot).visits;
    const std::size_t n_at_places = trip_->n_stages() - (trip_->ends_anywhere() ? 1 : 0);
    const auto after =
        std::upper_bound(visits.begin() + 1, visits.end(), middle - around,
                         [](Tick tick, const Visit& visit) { return tick < visit.enter; });
    window.first = static_cast<std::size_t>(after - visits.begin()) - 1;
    const auto served = [&](std::size_t k) { return k == 0 ? 0 : index(stage_after_[k - 1]); };
    window.first_stage = index(stage_after_[window.first]);
    if (window.first + 1 >= visits.size() || window.first_stage >= n_at_places) {
        return false;
    }
    window.until = std::max(visits[window.first].enter, trip_->times.ready);
    if (window.first_stage > served(window.first)) {
        const std::size_t last = window.first_stage - 1;
        window.until = ends_[last] + trip_->stage_turn[last];
    }
    window.last = window.first + 1;
    while (window.last + 1 < visits.size() &&
           (index(stage_after_[window.last]) == served(window.last) ||
            ends_[index(stage_after_[window.last]) - 1] < middle + around)) {
        ++window.last;
    }
    window.end_stage = index(stage_after_[window.last]);
    window.weight = std::max<Tick>(weigh(robot, window), 1);
    window.value = value_of(std::span(ends_).subspan(window.first_stage), window);
    std::vector<Tick> least;
    VertexId place = visits[window.first].vertex;
    Tick now = window.until;
    for (std::size_t k = window.first_stage; k < std::min(window.end_stage, n_at_places); ++k) {
        now += trip_->to_stage[k].from(place);
        place = trip_->stage_vertex[k];
        now = std::max(now, trip_->times.earliest[k]) + trip_->stage_work[k];
        least.push_back(now);
    }
    window.least = value_of(least, window);
    return true;
}

// What the ends of the stages of a window, the first of these, and its own end cost.
Tick WindowSearch::value_of(std::span<const Tick> ends, const TrackWindow& window) const {
    const std::size_t n = std::min(window.end_stage - window.first_stage, ends.size());
    if (!trip_->times.cost_ends()) {
        return ends[n - 1];
    }
    Tick sum = window.weight * ends[n - 1];
    for (std::size_t k = 0; k < n; ++k) {
        sum += trip_->times.cost_of(window.first_stage + k, ends[k]);
    }
    return sum;
}

// The gap between the bookings of others in which a robot makes a visit. Its own bookings, booked
// or not, are no bounds: no other robot comes between two of them in one gap.
WindowSearch::Gap WindowSearch::gap_at(RobotId robot, const Visit& visit) const {
    const auto here = plan_.bookings().at(problem_.vertex_row(robot, visit.vertex));
    auto k = index(BookingTable::started(here, visit.enter));
    Gap gap;
    for (auto j = k; j > 0; --j) {
        if (here[j - 1].robot != robot) {
            gap.begin = here[j - 1].time.end;
            break;
        }
    }
    while (k < here.size() && here[k].robot == robot) {
        ++k;
    }
    if (k < here.size()) {
        gap.end = here[k].time.start;
    }
    return gap;
}

// When the last work of a window ends at the latest, so that the visits behind it stay in their
// gaps and their stages end in time. The waits on the way take up a delay.
Tick WindowSearch::find_latest(RobotId robot, const TrackWindow& window) const {
    const auto& visits = plan_.track(robot).visits;
    if (window.last + 1 == visits.size()) {
        return never;
    }
    Tick most = never;
    Tick waits = 0;
    const Tick done = ends_[window.end_stage - 1];
    Tick now = done + trip_->stage_turn[window.end_stage - 1];
    for (std::size_t k = window.last + 1; k < visits.size() && waits < most; ++k) {
        const Visit& visit = visits[k];
        const Gap gap = gap_at(robot, visits[k - 1]);
        waits += visit.enter - (now + visit.drive);
        if (gap.end < never) {
            most = std::min(most, waits + gap.end - problem_.rules().headway - visit.enter);
        }
        now = visit.enter;
        for (auto stage = index(stage_after_[k - 1]);
             stage < std::min(index(stage_after_[k]), ends_.size()); ++stage) {
            waits += ends_[stage] - trip_->stage_work[stage] - now;
            now = ends_[stage];
            if (trip_->times.latest[stage] < never) {
                most = std::min(most, waits + trip_->times.latest[stage] - now);
            }
            if (stage + 1 == index(stage_after_[k])) {
                now += trip_->stage_turn[stage];
            }
        }
    }
    return most >= never ? never : done + most;
}

// What a tick at the end of a window costs behind it: all stages until the robot waits for another
// robot or for the earliest begin of a stage.
Tick WindowSearch::weigh(RobotId robot, const TrackWindow& window) const {
    const auto& visits = plan_.track(robot).visits;
    const StageTimes& times = trip_->times;
    if (window.last + 1 == visits.size()) {
        return times.weight;
    }
    Tick sum = 0;
    Tick now = ends_[window.end_stage - 1] + trip_->stage_turn[window.end_stage - 1];
    for (std::size_t k = window.last + 1; k < visits.size(); ++k) {
        const Visit& visit = visits[k];
        const Tick approach = problem_.approach(visit.drive);
        if (visit.enter > now + visit.drive &&
            gap_at(robot, visit).begin + approach >= visit.enter) {
            return sum;
        }
        now = visit.enter;
        for (auto stage = index(stage_after_[k - 1]);
             stage < std::min(index(stage_after_[k]), ends_.size()); ++stage) {
            if (ends_[stage] - trip_->stage_work[stage] > now) {
                return sum;
            }
            now = ends_[stage];
            if (times.cost_ends()) {
                sum += times.cost[stage] + (now > times.due[stage] ? times.late_cost[stage] : 0);
            }
        }
        if (index(stage_after_[k]) > index(stage_after_[k - 1]) && k + 1 < visits.size()) {
            now += trip_->stage_turn[index(stage_after_[k]) - 1];
        }
    }
    return sum + times.weight;
}

// Makes the trip of a window: it begins at its first visit, and ends with its last stage.
void WindowSearch::cut(const TrackWindow& window) {
    part_ = *trip_;
    const std::size_t first = window.first_stage;
    const std::size_t n = window.end_stage - first;
    const auto cut = [&](auto& span) { span = span.empty() ? span : span.subspan(first, n); };
    cut(part_.stage_vertex);
    cut(part_.stage_work);
    cut(part_.stage_turn);
    cut(part_.times.earliest);
    cut(part_.times.latest);
    cut(part_.times.cost);
    cut(part_.times.late_cost);
    cut(part_.times.due);
    part_.to_stage.assign(trip_->to_stage.begin() + static_cast<std::ptrdiff_t>(first),
                          trip_->to_stage.begin() + static_cast<std::ptrdiff_t>(window.end_stage));
    part_.times.ready = window.until;
    part_.times.weight = window.weight;
}

bool WindowSearch::find(RobotId robot, const TrackWindow& window, Tick limit,
                        const StopCondition& is_over, TimedTrack& found) {
    read(robot);
    cut(window);
    const auto& visits = plan_.track(robot).visits;
    const Visit& first = visits[window.first];
    const Visit& last = visits[window.last];
    part_.home = first.vertex;
    SearchRequest request{part_, plan_.bookings()};
    request.limit = limit;
    request.starts_at = first.enter;
    const Tick end = ends_[std::min(window.end_stage, ends_.size()) - 1];
    request.latest =
        std::min(find_latest(robot, window), end + most_edges_later * problem_.slowest_edge(robot));
    // Its own visits would be in its way where it comes later.
    plan_.release_window(robot, request.latest + 1);
    if (window.last + 1 < visits.size()) {
        const auto here = plan_.bookings().at(problem_.vertex_row(robot, last.vertex));
        request.last_gap = BookingTable::started(here, last.enter + problem_.rules().headway);
    }
    if (search_.run(request, is_over) != SearchEnd::found) {
        return false;
    }
    search_.track(visits_);
    found.visits.assign(visits.begin(),
                        visits.begin() + static_cast<std::ptrdiff_t>(window.first + 1));
    found.visits.insert(found.visits.end(), visits_.begin() + 1, visits_.end());
    if (!shift(robot, window, search_.completion(), found)) {
        return false;
    }
    return problem_.has_arcs() ? plan_.measure(robot, found, limits_) : plan_.measure(robot, found);
}

// Appends the visits after a window whose last work ends at `done`, each as early as its gap and
// the robot allow. False if that is too late for a gap or a stage.
bool WindowSearch::shift(RobotId robot, const TrackWindow& window, Tick done,
                         TimedTrack& found) const {
    const auto& visits = plan_.track(robot).visits;
    Tick now = done;
    for (std::size_t k = window.last + 1; k < visits.size(); ++k) {
        const auto served = index(stage_after_[k - 1]);
        const auto before =
            k - 1 == window.last ? window.end_stage - 1 : index(stage_after_[k - 2]);
        if (served > before) {
            now += trip_->stage_turn[served - 1];
        }
        Visit visit = visits[k];
        visit.enter = std::max(now + visit.drive,
                               gap_at(robot, visits[k]).begin + problem_.approach(visit.drive));
        const Gap gap = gap_at(robot, visits[k - 1]);
        if (gap.end < never && visit.enter > gap.end - problem_.rules().headway) {
            return false;
        }
        found.visits.push_back(visit);
        now = visit.enter;
        for (auto stage = served; stage < std::min(index(stage_after_[k]), ends_.size()); ++stage) {
            now = trip_->end_of(stage, now);
            if (now >= never) {
                return false;
            }
        }
        if (visit.enter == visits[k].enter) {  // nothing changes behind it
            found.visits.insert(found.visits.end(),
                                visits.begin() + static_cast<std::ptrdiff_t>(k + 1), visits.end());
            return true;
        }
    }
    return true;
}

}  // namespace rightofway
