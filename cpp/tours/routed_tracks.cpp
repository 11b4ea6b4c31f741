// The tracks of robots whose tours a move changes: searched one after another, as in prioritized
// planning; a robot in the way loses its track and is planned again.
#include <algorithm>
#include <utility>

#include "tours/routed_moves.hpp"

namespace rightofway {
namespace {

constexpr std::size_t searches_per_robot = 6;
constexpr Tick holds_per_price = 4;
constexpr std::size_t evicts_every = 4;  // moves in which the cost is limited

}  // namespace

// Removes the track of a robot, which comes back by `undo`.
void RoutedMoves::touch(RobotId robot) {
    if (std::exchange(is_touched_[index(robot)], std::uint8_t{1}) != 0) {
        TimedTrack none_left;
        plan_.exchange(robot, none_left);
        return;
    }
    touched_.push_back({robot, routed_[index(robot)], {}});
    plan_.exchange(robot, touched_.back().track);
    slack_ += touched_.back().routed.track_cost;
}

void RoutedMoves::undo() {
    for (const RobotId robot : std::exchange(waiting_, {})) {
        hold(robot, false);
        is_waiting_[index(robot)] = 0;
    }
    for (Touched& one : touched_) {
        TimedTrack none_left;
        if (plan_.has_track(one.robot)) {
            plan_.exchange(one.robot, none_left);
        }
    }
    for (Touched& one : touched_) {
        n_evictions_[index(one.robot)] = 0;
        plan_.exchange(one.robot, one.track);
        routed_[index(one.robot)] = std::move(one.routed);
        is_touched_[index(one.robot)] = 0;
        note_ends(one.robot);
    }
    touched_.clear();
}

// Whether the tours of the robots touched have the jobs that they had.
bool RoutedMoves::serves_the_same() const {
    if (job_cost_.empty()) {
        return false;
    }
    std::vector<std::int32_t> before;
    std::vector<std::int32_t> after;
    for (const Touched& one : touched_) {
        before.insert(before.end(), one.routed.stop.begin(), one.routed.stop.end());
        const Routed& now = routed_[index(one.robot)];
        after.insert(after.end(), now.stop.begin(), now.stop.end());
    }
    std::erase(before, none);
    std::erase(after, none);
    std::sort(before.begin(), before.end());
    std::sort(after.begin(), after.end());
    return before == after;
}

bool RoutedMoves::place_all(const StopCondition& is_over) {
    std::size_t n_left = searches_per_robot * waiting_.size();
    while (!waiting_.empty()) {
        if (n_left-- == 0 || !place(waiting_.front(), is_over)) {
            return false;
        }
        waiting_.pop_front();
    }
    return true;
}

// Gives a robot a track; others may lose theirs, and wait at the end.
bool RoutedMoves::place(RobotId robot, const StopCondition& is_over) {
    hold(robot, false);
    is_waiting_[index(robot)] = 0;
    const bool may_evict = !is_limited_ || random_.below(evicts_every) == 0;
    if (!find(robot, false, is_over) && (!may_evict || !find(robot, true, is_over))) {
        return false;
    }
    if (evict_conflicting() && random_.below(2) == 0) {  // later, if others get away first
        TimedTrack at_once = found_;
        Routed same = routed_[index(robot)];
        if (!find(robot, false, is_over)) {
            found_ = std::move(at_once);
            routed_[index(robot)] = std::move(same);
        }
    }
    plan_.exchange(robot, found_);
    slack_ -= routed_[index(robot)].track_cost;
    note_ends(robot);
    return !is_limited_ || slack_ >= 0;
}

// Removes the tracks of the robots in conflicting_, which wait. Whether there are any.
bool RoutedMoves::evict_conflicting() {
    for (const RobotId other : conflicting_) {
        if (plan_.has_track(other)) {
            slack_ += is_touched_[index(other)] ? routed_[index(other)].track_cost : 0;
            touch(other);
            waiting_.push_back(other);
            is_waiting_[index(other)] = 1;
            ++n_evictions_[index(other)];
            hold(other, true);
        }
    }
    return !conflicting_.empty();
}

// The best track of a robot, with the ends of its stages.
bool RoutedMoves::find(RobotId robot, bool may_evict, const StopCondition& is_over) {
    const Trip& trip = read_trip(robot);
    SearchRequest request{trip, plan_.bookings()};
    if (may_evict) {
        request.prices = prices_;
        request.rest_price = prices_[index(robot)];
    } else if (is_limited_) {
        request.limit = slack_;
    }
    if (search_.run(request, is_over) != SearchEnd::found) {
        return false;
    }
    found_ = {};
    search_.track(found_.visits);
    Routed& routed = routed_[index(robot)];
    const Tick done = completion(trip, found_.visits, nullptr, &found_.ends);
    if (done < 0) {
        return false;
    }
    routed.ends = found_.ends;
    routed.completion = done;
    routed.surcharges = plan_.surcharges(found_.visits);
    settle_costs(robot, routed);
    found_.cost = routed.track_cost + trip.times.weight * routed.surcharges;
    routed.track_cost = found_.cost;
    conflicting_.clear();
    if (may_evict) {
        plan_.find_conflicting(robot, found_, conflicting_);
    }
    return true;
}

const Trip& RoutedMoves::read_trip(RobotId robot) {
    const Routed& routed = routed_[index(robot)];
    static_cast<Itinerary&>(trip_) = problem_.itinerary(robot);
    limit_stages(robot);
    trip_.stage_vertex = routed.vertex;
    trip_.stage_work = routed.work;
    trip_.stage_turn = routed.turn;
    trip_.times.earliest = earliest_;
    trip_.times.latest = latest_;
    trip_.times.cost = routed.cost;
    trip_.times.late_cost = routed.late_cost;
    trip_.times.due = routed.due;
    if (!routed.cost.empty()) {
        trip_.times.weight = jobs_.robot(robot).weight;
    }
    trip_.first_row = problem_.first_row(robot);
    trip_.to_stage.clear();
    tables_.clear();
    for (const VertexId vertex : routed.vertex) {
        tables_.push_back(distances_.to(vertex, robot));
        trip_.to_stage.push_back(tables_.back()->view(distances_.scale(robot)));
    }
    return trip_;
}

// Jobs begin after the known ends of those before them, and end before those after them begin,
// where these are not planned again.
void RoutedMoves::limit_stages(RobotId robot) {
    const Routed& routed = routed_[index(robot)];
    earliest_ = routed.earliest;
    latest_ = routed.latest;
    for (std::size_t k = 0; k < routed.stop.size() && jobs_.has_after(); ++k) {
        if (routed.stop[k] == none) {
            continue;
        }
        const TourStop& stop = jobs_.stop(routed.stop[k]);
        const TourPlan& tours = has_proposal_ ? tours_.proposed() : tours_.best();
        for (const std::int32_t earlier : jobs_.job(stop.job).after) {
            if (stop.is_first && tours.robot_of(earlier) != robot) {
                earliest_[k] = std::max(earliest_[k], end_[index(earlier)]);
            }
        }
        for (const std::int32_t later : jobs_.job(stop.job).before) {
            const RobotId other = tours.robot_of(later);
            if (stop.is_last && other != nobody && other != robot && plan_.has_track(other)) {
                latest_[k] = std::min(latest_[k], begin_[index(later)]);
            }
        }
    }
}

bool RoutedMoves::keeps_order() const {
    const TourPlan& tours = has_proposal_ ? tours_.proposed() : tours_.best();
    for (std::int32_t job = 0; jobs_.has_after() && index(job) < jobs_.n_jobs(); ++job) {
        for (const std::int32_t earlier : jobs_.job(job).after) {
            if (tours.serves(job) && end_[index(earlier)] > begin_[index(job)]) {
                return false;
            }
        }
    }
    return true;
}

// Robots that wait for a track stay where they begin until they are ready; longer, each time that
// they have lost their track, so that others leave them room to get away.
void RoutedMoves::hold(RobotId robot, bool is_held) {
    const Tick longer = n_evictions_[index(robot)] * first_hold(robot) / holds_per_price;
    plan_.hold_home(robot, is_held ? problem_.ready(robot) + 1 + longer : 0);
}

}  // namespace rightofway
