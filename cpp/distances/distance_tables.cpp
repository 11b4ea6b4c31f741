#include "distances/distance_tables.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <stdexcept>
#include <string>
#include <utility>

#include "core/graph.hpp"
#include "core/reject.hpp"

namespace rightofway {
namespace {

constexpr std::int32_t unreached = -1;
constexpr Tick largest_distance = std::numeric_limits<std::int32_t>::max();

std::int32_t narrow(Tick distance, VertexId vertex, VertexId target) {
    if (distance > largest_distance) {
        throw std::overflow_error(
            "distance from " + std::to_string(vertex) + " to " + std::to_string(target) + ": " +
            std::to_string(distance) +
            " ticks do not fit int32 (bring speeds and lengths closer together)");
    }
    return static_cast<std::int32_t>(distance);
}

Graph checked(const Graph& graph) {
    require_graph(graph);
    return graph;
}

}  // namespace

DistanceTables::DistanceTables(std::span<const EdgeId> indptr, std::span<const VertexId> indices)
    : reverse_(checked({indptr, indices})) {}

void DistanceTables::check_request(VertexId target,
                                   std::span<const std::int32_t> edge_ticks) const {
    require_id("target", target, n_vertices());
    require_length("edge_ticks", edge_ticks.size(), reverse_.n_edges());
    for (std::size_t e = 0; e < edge_ticks.size(); ++e) {
        if (edge_ticks[e] <= 0 && edge_ticks[e] != barred) {
            reject_entry("edge_ticks", e, edge_ticks[e], "is neither positive nor -1");
        }
    }
}

std::vector<std::int32_t> DistanceTables::to(VertexId target,
                                             std::span<const std::int32_t> edge_ticks) const {
    check_request(target, edge_ticks);
    const bool uniform = std::adjacent_find(edge_ticks.begin(), edge_ticks.end(),
                                            std::not_equal_to<>{}) == edge_ticks.end() &&
                         (edge_ticks.empty() || edge_ticks.front() != barred);
    std::vector<std::uint16_t> counts;
    if (!uniform || !steps_to(target, counts)) {
        return dijkstra(target, edge_ticks);
    }
    const Tick ticks = edge_ticks.empty() ? 1 : edge_ticks.front();
    std::vector<std::int32_t> distance(counts.size(), unreached);
    for (VertexId v = 0; v < n_vertices(); ++v) {
        if (counts[index(v)] != DistanceView::no_way) {
            distance[index(v)] = narrow(ticks * counts[index(v)], v, target);
        }
    }
    return distance;
}

bool DistanceTables::steps_to(VertexId target, std::vector<std::uint16_t>& counts) const {
    require_id("target", target, n_vertices());
    counts.assign(static_cast<std::size_t>(n_vertices()), DistanceView::no_way);
    thread_local std::vector<VertexId> queue;
    queue.resize(counts.size());
    VertexId* end = queue.data();
    *end++ = target;
    counts[index(target)] = 0;
    for (const VertexId* next = queue.data(); next != end; ++next) {
        const std::uint16_t farther = static_cast<std::uint16_t>(counts[index(*next)] + 1);
        if (farther == DistanceView::no_way) {
            return false;
        }
        for (const VertexId from : reverse_.tails(*next)) {
            if (counts[index(from)] == DistanceView::no_way) {
                counts[index(from)] = farther;
                *end++ = from;
            }
        }
    }
    return true;
}

std::vector<std::int32_t> DistanceTables::dijkstra(VertexId target,
                                                   std::span<const std::int32_t> edge_ticks) const {
    using Key = std::pair<Tick, VertexId>;  // total order: ties by vertex
    std::priority_queue<Key, std::vector<Key>, std::greater<>> open;
    std::vector<Tick> best(static_cast<std::size_t>(n_vertices()), never);
    std::vector<std::int32_t> distance(static_cast<std::size_t>(n_vertices()), unreached);
    best[index(target)] = 0;
    open.emplace(0, target);
    while (!open.empty()) {
        const auto [ticks, v] = open.top();
        open.pop();
        if (distance[index(v)] != unreached) {
            continue;
        }
        // Overflow is checked for least distances only; longer paths may exceed int32.
        distance[index(v)] = narrow(ticks, v, target);
        const auto edges = reverse_.edges(v);
        const auto tails = reverse_.tails(v);
        for (std::size_t k = 0; k < edges.size(); ++k) {
            const std::int32_t drive = edge_ticks[index(edges[k])];
            if (drive == barred) {
                continue;
            }
            const Tick through = ticks + drive;
            if (through < best[index(tails[k])]) {
                best[index(tails[k])] = through;
                open.emplace(through, tails[k]);
            }
        }
    }
    return distance;
}

}  // namespace rightofway
