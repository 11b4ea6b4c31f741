#include "distances/energy_tables.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
#include <queue>
#include <utility>

#include "core/reject.hpp"

namespace rightofway {
namespace {

constexpr std::int64_t largest_most = std::int64_t{1} << 60;

void require_energies(const ReverseGraph& graph, std::span<const std::int64_t> edge_energy,
                      std::int64_t least, std::int64_t most) {
    require_range("most", most, 0, largest_most);
    require_length("edge_energy", edge_energy.size(), graph.n_edges());
    require_ranges("edge_energy", edge_energy, least, largest_most);
}

}  // namespace

std::vector<std::int64_t> find_energies_of_quickest_ways(const ReverseGraph& graph,
                                                         std::span<const std::int32_t> ticks_to,
                                                         std::span<const std::int32_t> edge_ticks,
                                                         std::span<const std::int64_t> edge_energy,
                                                         std::int64_t most) {
    require_length("ticks_to", ticks_to.size(), index(graph.n_vertices()));
    require_length("edge_ticks", edge_ticks.size(), graph.n_edges());
    require_energies(graph, edge_energy, 0, most);
    std::vector<VertexId> order(ticks_to.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](VertexId a, VertexId b) {
        return std::pair(ticks_to[index(a)], a) < std::pair(ticks_to[index(b)], b);
    });
    std::vector<std::int64_t> energy(ticks_to.size(), most);
    for (const VertexId head : order) {
        if (ticks_to[index(head)] == 0) {
            energy[index(head)] = 0;
        }
        const auto edges = graph.edges(head);
        const auto tails = graph.tails(head);
        for (std::size_t k = 0; k < edges.size() && ticks_to[index(head)] >= 0; ++k) {
            const Tick drive = edge_ticks[index(edges[k])];
            if (drive > 0 && ticks_to[index(tails[k])] == drive + ticks_to[index(head)]) {
                std::int64_t& least = energy[index(tails[k])];
                least = std::min(least, energy[index(head)] + edge_energy[index(edges[k])]);
            }
        }
    }
    return energy;
}

std::vector<std::int64_t> find_least_energies(const ReverseGraph& graph,
                                              std::span<const VertexId> targets,
                                              std::span<const std::int64_t> edge_energy,
                                              std::int64_t most) {
    require_ids("targets", targets, graph.n_vertices());
    require_energies(graph, edge_energy, barred, most);
    using Key = std::pair<std::int64_t, VertexId>;  // total order: ties by vertex
    std::priority_queue<Key, std::vector<Key>, std::greater<>> open;
    std::vector<std::int64_t> energy(index(graph.n_vertices()), most);
    for (const VertexId target : targets) {
        energy[index(target)] = 0;
        open.emplace(0, target);
    }
    while (!open.empty()) {
        const auto [least, head] = open.top();
        open.pop();
        if (least > energy[index(head)]) {
            continue;
        }
        const auto edges = graph.edges(head);
        const auto tails = graph.tails(head);
        for (std::size_t k = 0; k < edges.size(); ++k) {
            const std::int64_t drive = edge_energy[index(edges[k])];
            if (drive != barred && least + drive < energy[index(tails[k])]) {
                energy[index(tails[k])] = least + drive;
                open.emplace(least + drive, tails[k]);
            }
        }
    }
    return energy;
}

}  // namespace rightofway
