#include "problem/trip.hpp"

#include <string>

#include "core/reject.hpp"

namespace rightofway {

void require_trip(const Roads& roads, const Trip& trip) {
    const VertexId n_vertices = roads.graph.n_vertices();
    require_length("length_class", roads.length_class.size(), roads.graph.indices.size());
    for (std::size_t e = 0; e < roads.length_class.size(); ++e) {
        require_id("length_class[" + std::to_string(e) + "]", roads.length_class[e],
                   static_cast<std::int64_t>(trip.pace.size()));
    }
    require_length("stage_work", trip.stage_work.size(), trip.n_stages());
    require_length("stage_turn", trip.stage_turn.size(), trip.n_stages());
    require_length("stage_tables", trip.to_stage.size(), trip.n_stages());
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

}  // namespace rightofway
