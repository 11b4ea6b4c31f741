#include "lns/fleet_plan.hpp"

#include <algorithm>
#include <utility>

#include "core/poll.hpp"
#include "distances/trip.hpp"
#include "precedence/retiming.hpp"
#include "search/rotations.hpp"

namespace rightofway {

FleetPlan::FleetPlan(const Problem& problem, Objective objective, Tick horizon)
    : problem_(&problem),
      objective_(objective),
      horizon_(horizon),
      bookings_(problem.n_rows()),
      tracks_(static_cast<std::size_t>(problem.n_robots())),
      held_(tracks_.size(), 0),
      windows_(tracks_.size()),
      ends_(problem.has_arcs() ? problem.n_stages() : 0, 0) {
    const Closures& closed = problem.closures();
    for (std::size_t k = 0; k < closed.row.size(); ++k) {
        bookings_.insert(closed.row[k], {closed.start[k], closed.end[k]}, nobody);
    }
}

Worth FleetPlan::worth() const {
    if (objective_ == Objective::flowtime) {
        return {cost_, 0, cost_};
    }
    const Tick last = makespan();
    const auto n_last = std::count_if(tracks_.begin(), tracks_.end(),
                                      [&](const TimedTrack& track) { return track.cost == last; });
    if (objective_ == Objective::makespan) {
        return {last, n_last, cost_};
    }
    return {problem_->total_weight() * last + cost_, n_last, cost_};
}

Tick FleetPlan::makespan() const {
    Tick last = 0;
    for (const TimedTrack& track : tracks_) {
        last = std::max(last, track.cost);
    }
    return last;
}

Tick FleetPlan::surcharges(std::span<const Visit> visits) const {
    Tick sum = 0;
    for (std::size_t k = 1; k < visits.size() && problem_->has_surcharges(); ++k) {
        sum += problem_->surcharge(problem_->graph().edge(visits[k - 1].vertex, visits[k].vertex));
    }
    return sum;
}

bool FleetPlan::measure(RobotId robot, TimedTrack& track) const {
    const Itinerary itinerary = problem_->itinerary(robot);
    const Tick done = completion(itinerary, track.visits, nullptr, &track.ends);
    track.cost = cost_of_ends(itinerary, track.ends, done) +
                 itinerary.times.weight * surcharges(track.visits);
    return done >= 0;
}

bool FleetPlan::measure(RobotId robot, TimedTrack& track, const StageLimits& limits) const {
    Itinerary itinerary = problem_->itinerary(robot);
    itinerary.times.earliest = limits.earliest;
    itinerary.times.latest = limits.latest;
    const Tick done = completion(itinerary, track.visits, nullptr, &track.ends);
    track.cost = cost_of_ends(itinerary, track.ends, done) +
                 itinerary.times.weight * surcharges(track.visits);
    return done >= 0;
}

// Stages begin after the ends known of those before them; repeated until no end changes. Ends only
// rise in these rounds, so the last ones are the least.
RobotId FleetPlan::measure_all(std::span<TimedTrack> tracks) const {
    std::vector<Tick> ends(problem_->has_arcs() ? problem_->n_stages() : 0, 0);
    StageLimits limits;
    bool has_changed = true;
    for (std::size_t round = 0; has_changed && round <= problem_->n_stages() + 1; ++round) {
        has_changed = false;
        for (RobotId robot = 0; robot < n_robots(); ++robot) {
            TimedTrack& track = tracks[index(robot)];
            if (track.visits.empty()) {
                continue;
            }
            if (!problem_->has_arcs()) {
                if (!measure(robot, track)) {
                    return robot;
                }
                continue;
            }
            const StageTimes times = problem_->itinerary(robot).times;
            const std::int32_t first = problem_->first_stage(robot);
            limits.earliest.assign(times.earliest.begin(), times.earliest.end());
            limits.latest.assign(times.latest.begin(), times.latest.end());
            for (std::size_t k = 0; k < limits.earliest.size(); ++k) {
                for (const std::int32_t before :
                     problem_->stages_before(first + static_cast<std::int32_t>(k))) {
                    limits.earliest[k] = std::max(limits.earliest[k], ends[index(before)]);
                }
            }
            if (!measure(robot, track, limits)) {
                return robot;
            }
            for (std::size_t k = 0; k < track.ends.size(); ++k) {
                Tick& end = ends[index(first) + k];
                has_changed |= end != track.ends[k];
                end = track.ends[k];
            }
        }
    }
    return nobody;
}

void FleetPlan::find_limits(RobotId robot, bool keeps_followers, StageLimits& limits) const {
    const StageTimes times = problem_->itinerary(robot).times;
    limits.earliest.assign(times.earliest.begin(), times.earliest.end());
    limits.latest.assign(times.latest.begin(), times.latest.end());
    for (std::size_t k = 0; k < limits.earliest.size(); ++k) {
        const std::int32_t stage = problem_->first_stage(robot) + static_cast<std::int32_t>(k);
        for (const std::int32_t before : problem_->stages_before(stage)) {
            limits.earliest[k] = std::max(limits.earliest[k], end_of(before));
        }
        for (const std::int32_t after : problem_->stages_after(stage)) {
            if (keeps_followers && has_track(problem_->robot_of(after))) {
                limits.latest[k] =
                    std::min(limits.latest[k], end_of(after) - problem_->stage_work(after));
            }
        }
    }
}

Booking FleetPlan::booking(const TimedTrack& track, std::size_t k) const {
    const auto& visits = track.visits;
    const Tick approach = problem_->approach(visits[k].drive);
    const Tick end =
        k + 1 < visits.size() ? visits[k + 1].enter + problem_->rules().headway : never;
    return {visits[k].enter - approach, end};
}

// Calls `use` with each row that visit k books, and when: its vertex, and the edge driven in where
// drives book edges.
template <class Use>
void FleetPlan::for_each_row(RobotId robot, const TimedTrack& track, std::size_t k,
                             const Use& use) const {
    const Visit& visit = track.visits[k];
    use(problem_->vertex_row(robot, visit.vertex), booking(track, k));
    if (problem_->books_edges() && k > 0) {
        const EdgeId edge = problem_->graph().edge(track.visits[k - 1].vertex, visit.vertex);
        use(problem_->edge_row(robot, edge),
            Booking{visit.enter - visit.drive, visit.enter + problem_->rules().headway});
    }
}

// Calls `use` with each row from which a booking of a row excludes other robots.
template <class Use>
void FleetPlan::for_each_mark(std::int32_t row, const Use& use) const {
    for (const std::int32_t other : problem_->excluded(row)) {
        use(other);
    }
}

Tracks FleetPlan::tracks() const {
    Tracks tracks{{0}, {}, {}};
    for (const TimedTrack& track : tracks_) {
        for (const Visit& visit : track.visits) {
            tracks.vertex.push_back(visit.vertex);
            tracks.enter.push_back(visit.enter);
        }
        tracks.first_visit.push_back(static_cast<VisitId>(tracks.vertex.size()));
    }
    return tracks;
}

// Books a time by the horizon. A robot that is somewhere then stays there for one more tick: so no
// other one comes there by the horizon.
void FleetPlan::insert(std::int32_t row, Booking time, RobotId robot) {
    if (time.start > horizon_) {
        return;
    }
    if (horizon_ != never) {
        time.end = std::min(time.end, horizon_ + 1);
    }
    bookings_.insert(row, time, robot);
}

void FleetPlan::book(RobotId robot, const TimedTrack& track, std::size_t first, std::size_t end) {
    for (std::size_t k = first; k < end; ++k) {
        for_each_row(robot, track, k, [&](std::int32_t row, const Booking& time) {
            for_each_mark(row, [&](std::int32_t mark) { insert(mark, time, robot); });
        });
    }
}

void FleetPlan::erase(RobotId robot, const TimedTrack& track, std::size_t first, std::size_t end) {
    for (std::size_t k = first; k < end; ++k) {
        for_each_row(robot, track, k, [&](std::int32_t row, const Booking& time) {
            for_each_mark(row,
                          [&](std::int32_t mark) { bookings_.erase(mark, time.start, robot); });
        });
    }
}

// Where robots are points, the visits at the begin and at the end that both tracks have stay
// booked.
void FleetPlan::exchange(RobotId robot, TimedTrack& track) {
    release_window(robot);
    TimedTrack& own = tracks_[index(robot)];
    const Window window = std::exchange(windows_[index(robot)], Window{});
    const std::size_t n = own.visits.size();
    const std::size_t m = track.visits.size();
    std::size_t n_first = 0;
    std::size_t n_last = 0;
    if (!problem_->books_edges()) {
        const auto are_same = [&](std::size_t k, std::size_t j) {
            return own.visits[k].vertex == track.visits[j].vertex &&
                   booking(own, k) == booking(track, j);
        };
        const std::size_t most_first = window.is_open ? window.first : n;
        const std::size_t most_last = window.is_open ? n - window.last - 1 : n;
        while (n_first < std::min({n, m, most_first}) && are_same(n_first, n_first)) {
            ++n_first;
        }
        while (n_last < std::min({n - n_first, m - n_first, most_last}) &&
               are_same(n - n_last - 1, m - n_last - 1)) {
            ++n_last;
        }
    }
    if (window.is_open) {
        erase(robot, own, n_first, window.first);
        erase(robot, own, window.last + 1, n - n_last);
    } else {
        erase(robot, own, n_first, n - n_last);
    }
    cost_ += problem_->weight(robot) * (track.cost - own.cost);
    std::swap(own, track);
    if (problem_->has_arcs() && !own.visits.empty()) {
        std::copy(own.ends.begin(), own.ends.end(), ends_.begin() + problem_->first_stage(robot));
    }
    book(robot, own, n_first, m - n_last);
}

void FleetPlan::open_window(RobotId robot, std::size_t first, std::size_t last, Tick until) {
    const TimedTrack& own = tracks_[index(robot)];
    erase(robot, own, first, last + 1);
    windows_[index(robot)] = {first, last, true, true};
    Booking stay = booking(own, first);
    stay.end = until + problem_->rules().headway + 1;
    insert(problem_->vertex_row(robot, own.visits[first].vertex), stay, robot);
    book(robot, own, last, last + 1);
}

void FleetPlan::release_window(RobotId robot, Tick until) {
    Window& window = windows_[index(robot)];
    if (!window.is_held) {
        return;
    }
    const TimedTrack& own = tracks_[index(robot)];
    erase(robot, own, window.first, window.first + 1);
    erase(robot, own, window.last, window.last + 1);
    window.is_held = false;
    while (window.last + 1 < own.visits.size() && own.visits[window.last + 1].enter < until) {
        ++window.last;
        erase(robot, own, window.last, window.last + 1);
    }
}

void FleetPlan::close_window(RobotId robot) {
    const Window window = windows_[index(robot)];
    if (window.is_open) {
        release_window(robot);
        book(robot, tracks_[index(robot)], window.first, window.last + 1);
        windows_[index(robot)] = {};
    }
}

void FleetPlan::retime(const StopCondition& interrupt) {
    if (problem_->has_arcs() || horizon_ != never) {
        return;
    }
    Tracks all = tracks();
    rightofway::retime(*problem_, all, interrupt);
    FleetPlan retimed(*problem_, objective_);
    Poll poll(interrupt);
    for (RobotId robot = 0; robot < n_robots(); ++robot) {
        TimedTrack one = track(robot);
        for (std::size_t k = 0; k < one.visits.size(); ++k) {
            poll();
            one.visits[k].enter = all.enter[index(all.first_visit[index(robot)]) + k];
        }
        measure(robot, one);
        retimed.exchange(robot, one);
    }
    *this = std::move(retimed);
}

void FleetPlan::hold_home(RobotId robot, Tick until) {
    const std::int32_t row = problem_->vertex_row(robot, problem_->home(robot));
    Tick& held = held_[index(robot)];
    if (held > 0) {
        for_each_mark(row, [&](std::int32_t mark) { bookings_.erase(mark, 0, robot); });
    }
    held = until;
    if (held > 0) {
        for_each_mark(row, [&](std::int32_t mark) { insert(mark, {0, held}, robot); });
    }
}

void FleetPlan::close_start(RobotId robot, bool is_closed) {
    if (problem_->ready(robot) == 0) {
        return;
    }
    constexpr Tick before_all = -1;  // no closure of the problem starts then
    const std::int32_t row = problem_->vertex_row(robot, problem_->home(robot));
    for_each_mark(row, [&](std::int32_t mark) {
        if (is_closed) {
            bookings_.insert(mark, {before_all, problem_->ready(robot)}, nobody);
        } else {
            bookings_.erase(mark, before_all, nobody);
        }
    });
}

// Calls `found` for each robot with a stage that the track lets begin or end at a wrong time, until
// `found` ends the loop; whether it did.
template <class Found>
bool FleetPlan::meet_stages(RobotId robot, const TimedTrack& track, const Found& found) const {
    for (std::size_t k = 0; k < track.ends.size() && problem_->has_arcs(); ++k) {
        const std::int32_t stage = problem_->first_stage(robot) + static_cast<std::int32_t>(k);
        const Tick begin = track.ends[k] - problem_->stage_work(stage);
        for (const std::int32_t before : problem_->stages_before(stage)) {
            const RobotId other = problem_->robot_of(before);
            if (has_track(other) && begin < end_of(before) && found(other)) {
                return true;
            }
        }
        for (const std::int32_t after : problem_->stages_after(stage)) {
            const RobotId other = problem_->robot_of(after);
            if (has_track(other) && end_of(after) - problem_->stage_work(after) < track.ends[k] &&
                found(other)) {
                return true;
            }
        }
    }
    return false;
}

// Calls `found` for each booking in conflict with the track until `found` ends the loop.
template <class Found>
void FleetPlan::meet(RobotId robot, const TimedTrack& track, const Found& found) const {
    const bool may_swap = problem_->may_follow();
    bool is_over = meet_stages(robot, track, found);
    for (std::size_t k = 0; k < track.visits.size() && !is_over; ++k) {
        for_each_row(robot, track, k, [&](std::int32_t row, const Booking& time) {
            is_over = is_over ||
                      BookingTable::any_overlap(bookings_.at(row), time, [&](const BookedBy& one) {
                          return one.robot != robot && found(one.robot);
                      });
        });
        if (!may_swap || k == 0) {
            continue;
        }
        const Booking own = booking(track, k);
        const auto here = bookings_.at(track.visits[k].vertex);
        const auto before = bookings_.at(track.visits[k - 1].vertex);
        for (std::int32_t i = BookingTable::started(before, own.start);
             i > 0 && before[index(i - 1)].time.start == own.start; --i) {
            for (std::int32_t j = BookingTable::started(here, own.start);
                 j > 0 && here[index(j - 1)].reach >= own.start; --j) {
                if (here[index(j - 1)].time.end == own.start && here[index(j - 1)].robot != robot &&
                    here[index(j - 1)].robot != nobody &&
                    here[index(j - 1)].robot == before[index(i - 1)].robot &&
                    found(here[index(j - 1)].robot)) {
                    return;
                }
            }
            const RobotId follower = before[index(i - 1)].robot;
            if (!problem_->rules().rotations && follower != robot && follower != nobody) {
                const RobotId ahead = find_rotation_ahead(
                    problem_->graph(), bookings_, problem_->first_row(robot),
                    {track.visits[k - 1].vertex, track.visits[k].vertex, own.start, robot});
                if (ahead != nobody && found(ahead)) {
                    return;
                }
            }
        }
    }
}

bool FleetPlan::fits(RobotId robot, const TimedTrack& track) const {
    bool is_free = true;
    meet(robot, track, [&](RobotId) {
        is_free = false;
        return true;
    });
    return is_free;
}

void FleetPlan::find_conflicting(RobotId robot, const TimedTrack& track,
                                 std::vector<RobotId>& robots) const {
    robots.clear();
    meet(robot, track, [&](RobotId other) {
        robots.push_back(other);
        return false;
    });
    std::sort(robots.begin(), robots.end());
    robots.erase(std::unique(robots.begin(), robots.end()), robots.end());
}

}  // namespace rightofway
