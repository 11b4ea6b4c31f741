#include "distances/alt_distance.hpp"

#include <algorithm>
#include <limits>

#include "distances/distance_tables.hpp"

namespace rightofway {
namespace {

constexpr std::uint16_t unreachable = DistanceView::no_way;
constexpr std::int32_t endless = std::numeric_limits<std::int32_t>::max();

}  // namespace

AltDistance::AltDistance(const Graph& graph, const DistanceTables& tables)
    : graph_(graph),
      rows_(static_cast<std::size_t>(graph.n_vertices()), Row{}),
      reached_(rows_.size(), {0, 0}) {
    if (graph.n_vertices() > 0) {
        choose_landmarks(tables);
    }
}

// Each landmark is farthest from the landmarks before it; the first landmark from vertex 0.
void AltDistance::choose_landmarks(const DistanceTables& tables) {
    std::vector<std::uint16_t> counts;
    if (!tables.steps_to(0, counts)) {
        return;  // without landmarks: breadth-first search
    }
    std::vector<std::uint16_t> nearest(counts);
    const auto nearness = [](std::uint16_t steps) { return steps == unreachable ? 0 : steps; };
    for (std::size_t k = 0; k < n_landmarks; ++k) {
        const auto far =
            std::max_element(nearest.begin(), nearest.end(),
                             [&](auto one, auto other) { return nearness(one) < nearness(other); });
        if (!tables.steps_to(static_cast<VertexId>(far - nearest.begin()), counts)) {
            return;
        }
        for (std::size_t v = 0; v < rows_.size(); ++v) {
            rows_[v][k] = counts[v];
            nearest[v] = k == 0 ? counts[v] : std::min(nearest[v], counts[v]);
        }
    }
}

// A lower bound of the distance from a vertex to the target.
std::int32_t AltDistance::bound(VertexId vertex) const {
    const Row& row = rows_[index(vertex)];
    std::int32_t most = 0;
    for (std::size_t k = 0; k < n_landmarks; ++k) {
        if (target_row_[k] == unreachable) {
            continue;
        }
        if (row[k] == unreachable) {
            return endless;  // a path to the target would continue to the landmark
        }
        most = std::max(most, std::int32_t{row[k]} - std::int32_t{target_row_[k]});
    }
    return most;
}

void AltDistance::reach(VertexId vertex, std::int32_t steps) {
    Reached& reached = reached_[index(vertex)];
    if (reached.search == search_ && reached.steps <= steps) {
        return;
    }
    const std::int32_t ahead = bound(vertex);
    if (ahead == endless) {
        return;
    }
    reached = {steps, search_};
    const auto bucket = index(steps + ahead - first_bound_);
    if (bucket >= open_.size()) {
        open_.resize(bucket + 1);
    }
    open_[bucket].push_back(vertex);
}

std::int32_t AltDistance::between(VertexId from, VertexId target) {
    ++search_;
    target_row_ = rows_[index(target)];
    first_bound_ = bound(from);
    for (std::vector<VertexId>& bucket : open_) {
        bucket.clear();
    }
    if (first_bound_ == endless) {
        return no_way;
    }
    reach(from, 0);
    for (std::size_t k = 0; k < open_.size(); ++k) {
        while (!open_[k].empty()) {
            const VertexId vertex = open_[k].back();
            open_[k].pop_back();
            const std::int32_t steps = reached_[index(vertex)].steps;
            if (vertex == target) {
                return steps;
            }
            if (steps + bound(vertex) - first_bound_ < static_cast<std::int32_t>(k)) {
                continue;  // outdated: the vertex has a shorter path
            }
            for (const VertexId head : graph_.heads(vertex)) {
                reach(head, steps + 1);
            }
        }
    }
    return no_way;
}

}  // namespace rightofway
