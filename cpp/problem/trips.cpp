#include "problem/trips.hpp"

#include <stdexcept>
#include <string>

#include "core/reject.hpp"

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

void check_dwells(const Trips& trips) {
    require_length("stage_dwell", trips.stage_dwell.size(), trips.stage_vertex.size());
    for (std::size_t s = 0; s < trips.stage_dwell.size(); ++s) {
        if (trips.stage_dwell[s] < 0 || trips.stage_dwell[s] > longest_dwell) {
            reject_entry("stage_dwell", s, trips.stage_dwell[s], "is not in 0..2^40");
        }
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
    check(trips.graph, trips.goals());
    check_edges(trips);
    check_dwells(trips);
}

}  // namespace rightofway
