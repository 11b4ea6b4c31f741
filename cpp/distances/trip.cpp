#include "distances/trip.hpp"

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
    if (trip.n_stages() == 0) {
        throw std::invalid_argument("stage_vertex: its length is 0, but must be at least 1");
    }
    VertexId place = trip.home;
    for (std::size_t k = 0; k < trip.n_stages(); ++k) {
        require_id("stage_vertex[" + std::to_string(k) + "]", trip.stage_vertex[k], n_vertices);
        if (trip.to_stage[k].from(place) < 0) {
            reject_entry("stage_vertex", k, trip.stage_vertex[k], "cannot be reached");
        }
        place = trip.stage_vertex[k];
    }
}

const Trip& TripReader::read(RobotId robot) {
    if (robot == robot_) {
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

Tick completion(const Itinerary& itinerary, std::span<const Visit> track,
                std::vector<std::int32_t>* stage_after) {
    if (stage_after != nullptr) {
        stage_after->clear();
    }
    std::size_t stage = 0;
    Tick work = 0;
    for (std::size_t visit = 0; visit < track.size(); ++visit) {
        const VertexId vertex = track[visit].vertex;
        if (visit + 1 < track.size()) {
            const Visit& next = track[visit + 1];
            const Tick spare = next.enter - track[visit].enter - next.drive - next.turn;
            stage = itinerary.stage_after(stage, vertex, spare);
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
