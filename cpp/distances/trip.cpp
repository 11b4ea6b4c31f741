#include "distances/trip.hpp"

#include <algorithm>
#include <string>

#include "core/reject.hpp"

namespace rightofway {

namespace {

// As in a Problem: no sum over a trip overflows.
constexpr Tick longest_stay = Tick{1} << 40;

}  // namespace

void require_trip(const Roads& roads, const Trip& trip) {
    const VertexId n_vertices = roads.graph.n_vertices();
    require_length("length_class", roads.length_class.size(), roads.graph.indices.size());
    require_ids("length_class", roads.length_class, static_cast<std::int64_t>(trip.pace.size()));
    for (std::size_t k = 0; k < trip.pace.size(); ++k) {
        if (trip.pace[k] <= 0 && trip.pace[k] != barred) {
            reject_entry("pace", k, trip.pace[k], "is neither positive nor -1");
        }
    }
    require_length("stage_work", trip.stage_work.size(), trip.n_stages());
    require_length("stage_turn", trip.stage_turn.size(), trip.n_stages());
    require_length("stage_tables", trip.to_stage.size(), trip.n_stages());
    require_ranges("stage_work", trip.stage_work, 0, longest_stay);
    require_ranges("stage_turn", trip.stage_turn, 0, longest_stay);
    require_id("home", trip.home, n_vertices);
    if (trip.times.are_known()) {
        require_length("earliest", trip.times.earliest.size(), trip.n_stages());
        require_length("latest", trip.times.latest.size(), trip.n_stages());
    }
    if (trip.n_stages() == 0) {
        throw std::invalid_argument("stage_vertex: its length is 0, but must be at least 1");
    }
    VertexId place = trip.home;
    for (std::size_t k = 0; k < trip.n_stages(); ++k) {
        if (trip.times.are_known() && k + 1 == trip.n_stages() && trip.ends_anywhere()) {
            break;
        }
        require_id("stage_vertex[" + std::to_string(k) + "]", trip.stage_vertex[k], n_vertices);
        if (trip.to_stage[k].from(place) < 0) {
            reject_entry("stage_vertex", k, trip.stage_vertex[k], "cannot be reached");
        }
        place = trip.stage_vertex[k];
    }
}

const Trip& TripReader::read(RobotId robot) {
    if (robot == robot_) {
        if (trip_.times.are_known()) {
            trip_.times = distances_.problem().itinerary(robot).times;
        }
        return trip_;
    }
    robot_ = nobody;  // until the trip is whole: a table may be refused
    const Problem& problem = distances_.problem();
    static_cast<Itinerary&>(trip_) = problem.itinerary(robot);
    trip_.first_row = problem.first_row(robot);
    trip_.with_turns = with_turns_ ? distances_.with_turns(robot) : nullptr;
    tables_.clear();
    trip_.to_stage.clear();
    for (const VertexId stage : trip_.stage_vertex) {
        tables_.push_back(distances_.to(stage, robot));
        trip_.to_stage.push_back(tables_.back()->view(distances_.scale(robot)));
    }
    robot_ = robot;
    return trip_;
}

const Trip& TripReader::read(RobotId robot, std::span<const Tick> earliest,
                             std::span<const Tick> latest) {
    read(robot);
    trip_.times.earliest = earliest;
    trip_.times.latest = latest;
    return trip_;
}

namespace {

Tick completion_in_time(const Itinerary& itinerary, std::span<const Visit> track,
                        std::vector<std::int32_t>* stage_after, std::vector<Tick>& ends) {
    std::size_t stage = 0;
    for (std::size_t visit = 0; visit + 1 < track.size(); ++visit) {
        const Visit& next = track[visit + 1];
        stage = itinerary.stage_after(stage, track[visit].vertex, track[visit].enter,
                                      next.enter - next.drive - next.turn, &ends);
        if (stage_after != nullptr) {
            stage_after->push_back(static_cast<std::int32_t>(stage));
        }
    }
    Tick now = std::max(track.back().enter, itinerary.times.ready);
    const std::size_t n_at_places = itinerary.n_stages() - (itinerary.ends_anywhere() ? 1 : 0);
    for (; stage < n_at_places && itinerary.stage_vertex[stage] == track.back().vertex; ++stage) {
        now = itinerary.end_of(stage, now);
        ends.push_back(now);
    }
    const bool is_whole = stage == n_at_places && now < never;
    if (stage_after != nullptr) {
        stage_after->push_back(static_cast<std::int32_t>(is_whole ? itinerary.n_stages() : stage));
    }
    if (!is_whole) {
        return -1;
    }
    return itinerary.completes_before_end() ? ends.back() : now;
}

}  // namespace

Tick cost_of_ends(const Itinerary& itinerary, std::span<const Tick> ends, Tick completion) {
    if (!itinerary.times.cost_ends()) {
        return completion;
    }
    Tick sum = itinerary.times.weight * completion;
    for (std::size_t k = 0; k < ends.size(); ++k) {
        sum += itinerary.times.cost_of(k, ends[k]);
    }
    return sum;
}

Tick completion(const Itinerary& itinerary, std::span<const Visit> track,
                std::vector<std::int32_t>* stage_after, std::vector<Tick>* ends) {
    if (stage_after != nullptr) {
        stage_after->clear();
    }
    if (itinerary.times.are_known()) {
        std::vector<Tick> own;
        std::vector<Tick>& known = ends != nullptr ? *ends : own;
        known.clear();
        return completion_in_time(itinerary, track, stage_after, known);
    }
    std::size_t stage = 0;
    Tick work = 0;
    for (std::size_t visit = 0; visit < track.size(); ++visit) {
        const VertexId vertex = track[visit].vertex;
        if (visit + 1 < track.size()) {
            const Visit& next = track[visit + 1];
            stage = itinerary.stage_after(stage, vertex, track[visit].enter,
                                          next.enter - next.drive - next.turn);
        } else {
            for (; stage < itinerary.n_stages() && itinerary.stage_vertex[stage] == vertex;
                 ++stage) {
                work += itinerary.stage_work[stage];
            }
        }
        if (stage_after != nullptr) {
            stage_after->push_back(static_cast<std::int32_t>(stage));
        }
    }
    return stage == itinerary.n_stages() ? track.back().enter + work : -1;
}

}  // namespace rightofway
