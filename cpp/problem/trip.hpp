// What one robot has to do, and where and how it may drive.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/graph.hpp"
#include "core/types.hpp"
#include "distances/distance_view.hpp"

namespace rightofway {

// A graph whose edges fall into classes of one length each.
struct Roads {
    Graph graph;
    std::span<const std::int32_t> length_class;  // of each edge
};

// The stages of one robot's trip. A visit at a stage's vertex serves it by lasting for its work and
// turning; the last visit of all needs no turning.
struct Trip {
    VertexId home = 0;
    std::span<const VertexId> stage_vertex;
    std::span<const Tick> stage_work;
    std::span<const Tick> stage_turn;
    std::span<const std::int32_t> pace;  // ticks for an edge of each length class
    std::vector<DistanceView> to_stage;  // to the vertex of each stage

    std::size_t n_stages() const { return stage_vertex.size(); }
};

// Throws std::invalid_argument where the arrays of a trip do not fit together or to the roads, or a
// stage cannot be reached.
void require_trip(const Roads& roads, const Trip& trip);

// How bookings are made of times; see conflict.hpp.
struct BookingRules {
    Tick headway;
    bool books_ahead;  // a vertex is booked from when the robot starts to drive there
};

// One visit of a track. The next visit's `enter` is when it ends.
struct Visit {
    Tick enter;
    VertexId vertex;
    std::int32_t drive;  // ticks of the edge driven in; 0 for the first visit
};

}  // namespace rightofway
