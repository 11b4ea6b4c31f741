#include "rightofway/trips.hpp"

#include <stdexcept>
#include <string>
#include <vector>

#include "rightofway/reject.hpp"

namespace rightofway {
namespace {

// A sum of durations this long over a whole plan stays far below infinity.
constexpr Tick longest_dwell = Tick{1} << 40;

void check_edges(const Trips& trips) {
    require_length("edge_class", trips.edge_class.size(), trips.graph.indices.size());
    for (std::size_t e = 0; e < trips.edge_class.size() && !trips.home.empty(); ++e) {
        require_id("edge_class[" + std::to_string(e) + "]", trips.edge_class[e], trips.n_classes());
    }
}

void check_stages(const Trips& trips) {
    const auto n_robots = trips.home.size();
    require_length("first_stage", trips.first_stage.size(), n_robots + 1);
    if (trips.first_stage.front() != 0) {
        reject_entry("first_stage", 0, trips.first_stage.front(), "must be 0");
    }
    for (std::size_t r = 0; r < n_robots; ++r) {
        if (trips.first_stage[r + 1] <= trips.first_stage[r]) {
            reject_entry("first_stage", r + 1, trips.first_stage[r + 1], "leaves a robot no stage");
        }
    }
    const auto n_stages = static_cast<std::size_t>(trips.first_stage.back());
    require_length("stage_vertex", trips.stage_vertex.size(), n_stages);
    require_length("stage_dwell", trips.stage_dwell.size(), n_stages);
    for (std::size_t s = 0; s < n_stages; ++s) {
        require_id("stage_vertex[" + std::to_string(s) + "]", trips.stage_vertex[s],
                   trips.graph.n_vertices());
        if (trips.stage_dwell[s] < 0 || trips.stage_dwell[s] > longest_dwell) {
            reject_entry("stage_dwell", s, trips.stage_dwell[s], "is not in 0..2^40");
        }
    }
}

void check_homes(const Trips& trips) {
    std::vector<bool> is_taken(static_cast<std::size_t>(trips.graph.n_vertices()), false);
    for (std::size_t r = 0; r < trips.home.size(); ++r) {
        require_id("home[" + std::to_string(r) + "]", trips.home[r], trips.graph.n_vertices());
        if (is_taken[trips.home[r]]) {
            reject_entry("home", r, trips.home[r], "is the home of another robot");
        }
        is_taken[trips.home[r]] = true;
    }
}

}  // namespace

void check(const Trips& trips) {
    if (!trips.home.empty() && trips.class_ticks.size() % trips.home.size() != 0) {
        throw std::invalid_argument("class_ticks: its length is " +
                                    std::to_string(trips.class_ticks.size()) +
                                    ", which is not a multiple of the number of robots");
    }
    for (std::size_t k = 0; k < trips.class_ticks.size(); ++k) {
        if (trips.class_ticks[k] <= 0) {
            reject_entry("class_ticks", k, trips.class_ticks[k], "is not positive");
        }
    }
    if (trips.headway < 0 || trips.headway > longest_dwell) {
        reject("headway", trips.headway, "is not in 0..2^40");
    }
    if (trips.may_rotate && (trips.headway > 0 || trips.books_ahead)) {
        throw std::invalid_argument(
            "may_rotate: robots that keep a headway or book ahead cannot rotate");
    }
    require_graph(trips.graph);
    check_edges(trips);
    check_stages(trips);
    check_homes(trips);
}

}  // namespace rightofway
