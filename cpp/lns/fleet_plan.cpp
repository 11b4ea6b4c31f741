#include "lns/fleet_plan.hpp"

#include <algorithm>
#include <utility>

#include "distances/trip.hpp"
#include "precedence/timetable.hpp"

namespace rightofway {

FleetPlan::FleetPlan(const Problem& problem)
    : problem_(&problem),
      bookings_(problem.n_vertices()),
      tracks_(static_cast<std::size_t>(problem.n_robots())),
      held_(tracks_.size(), 0) {}

Booking FleetPlan::booking(const TimedTrack& track, std::size_t k) const {
    const auto& visits = track.visits;
    const Tick approach = problem_->rules().books_ahead ? visits[k].drive : 0;
    const Tick end =
        k + 1 < visits.size() ? visits[k + 1].enter + problem_->rules().headway : never;
    return {visits[k].enter - approach, end};
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

void FleetPlan::exchange(RobotId robot, TimedTrack& track) {
    TimedTrack& own = tracks_[static_cast<std::size_t>(robot)];
    for (std::size_t k = 0; k < own.visits.size(); ++k) {
        bookings_.erase(own.visits[k].vertex, booking(own, k).start, robot);
    }
    flowtime_ += track.completion - own.completion;
    std::swap(own, track);
    for (std::size_t k = 0; k < own.visits.size(); ++k) {
        bookings_.insert(own.visits[k].vertex, booking(own, k), robot);
    }
}

void FleetPlan::retime() {
    Tracks all = tracks();
    rightofway::retime(*problem_, all);
    FleetPlan retimed(*problem_);
    for (RobotId robot = 0; robot < n_robots(); ++robot) {
        TimedTrack one = track(robot);
        for (std::size_t k = 0; k < one.visits.size(); ++k) {
            one.visits[k].enter = all.enter[static_cast<std::size_t>(all.first_visit[robot]) + k];
        }
        one.completion = completion(problem_->itinerary(robot), one.visits);
        retimed.exchange(robot, one);
    }
    *this = std::move(retimed);
}

void FleetPlan::hold_home(RobotId robot, Tick until) {
    Tick& held = held_[static_cast<std::size_t>(robot)];
    if (held > 0) {
        bookings_.erase(problem_->home(robot), 0, robot);
    }
    held = until;
    if (held > 0) {
        bookings_.insert(problem_->home(robot), {0, held}, robot);
    }
}

// Calls `found` for each booking in conflict with the track until `found` ends the loop.
template <class Found>
void FleetPlan::meet(RobotId robot, const TimedTrack& track, const Found& found) const {
    const bool may_swap = problem_->may_follow();
    for (std::size_t k = 0; k < track.visits.size(); ++k) {
        const Booking own = booking(track, k);
        const auto here = bookings_.at(track.visits[k].vertex);
        for (std::int32_t j = BookingTable::started(here, own.end - 1);
             j > 0 && here[j - 1].reach > own.start; --j) {
            if (here[j - 1].robot != robot && here[j - 1].time.end > own.start &&
                found(here[j - 1].robot)) {
                return;
            }
        }
        if (!may_swap || k == 0) {
            continue;
        }
        const auto before = bookings_.at(track.visits[k - 1].vertex);
        for (std::int32_t i = BookingTable::started(before, own.start);
             i > 0 && before[i - 1].time.start == own.start; --i) {
            for (std::int32_t j = BookingTable::started(here, own.start);
                 j > 0 && here[j - 1].reach >= own.start; --j) {
                if (here[j - 1].time.end == own.start && here[j - 1].robot != robot &&
                    here[j - 1].robot == before[i - 1].robot && found(here[j - 1].robot)) {
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

void FleetPlan::in_the_way(RobotId robot, const TimedTrack& track,
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
