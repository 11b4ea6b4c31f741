#include "distances/turning_table.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <stdexcept>
#include <string>
#include <utility>

namespace rightofway {
namespace {

constexpr Tick largest = std::numeric_limits<std::int32_t>::max();

// The edges into vertex v are edge[k] for k in first[v] .. first[v + 1] - 1.
struct EdgesInto {
    explicit EdgesInto(const Graph& graph)
        : first(graph.indptr.size(), 0), edge(graph.indices.size()), tail(graph.indices.size()) {
        for (const VertexId head : graph.indices) {
            ++first[head + 1];
        }
        for (std::size_t v = 0; v + 1 < first.size(); ++v) {
            first[v + 1] += first[v];
        }
        std::vector<EdgeId> next(first.begin(), first.end() - 1);
        for (VertexId v = 0; v < graph.n_vertices(); ++v) {
            for (EdgeId e = graph.indptr[v]; e < graph.indptr[v + 1]; ++e) {
                tail[e] = v;
                edge[next[graph.indices[e]]++] = e;
            }
        }
    }

    std::vector<EdgeId> first;
    std::vector<EdgeId> edge;
    std::vector<VertexId> tail;
};

}  // namespace

TurningTable::TurningTable(const Problem& problem, RobotId robot)
    : n_places_(problem.graph().indices.size() + 1) {
    using Key = std::pair<Tick, EdgeId>;  // total order: ties by edge
    const Graph& graph = problem.graph();
    const Itinerary itinerary = problem.itinerary(robot);
    const EdgesInto into(graph);
    const std::size_t n_stages = itinerary.n_stages();
    const std::size_t first_last = itinerary.first_stage_at_end();
    least_.assign(n_stages * n_places_, -1);
    Tick work_at_end = 0;  // of this stage and the stages after it
    for (std::size_t stage = n_stages; stage-- > 0;) {
        std::int32_t* least = least_.data() + stage * n_places_ + 1;  // by edge; [-1]: home
        const VertexId target = itinerary.stage_vertex[stage];
        const bool is_at_end = stage >= first_last;
        work_at_end += is_at_end ? itinerary.stage_work[stage] : 0;
        const Tick dwell = itinerary.stage_work[stage] + itinerary.stage_turn[stage];
        const auto served = [&](EdgeId edge) {  // the rest of the trip if the stage is served now
            if (is_at_end) {
                return work_at_end;
            }
            const Tick rest = from(edge, static_cast<std::int32_t>(stage) + 1);
            return rest < 0 ? never : dwell + rest;
        };
        std::vector<Tick> best(graph.indices.size(), never);
        std::priority_queue<Key, std::vector<Key>, std::greater<>> open;
        for (EdgeId k = into.first[target]; k < into.first[target + 1]; ++k) {
            const EdgeId edge = into.edge[k];
            best[edge] = served(edge);
            if (best[edge] < never) {
                open.emplace(best[edge], edge);
            }
        }
        while (!open.empty()) {
            const auto [ticks, edge] = open.top();
            open.pop();
            if (ticks > best[edge]) {
                continue;
            }
            if (ticks > largest) {
                throw std::overflow_error("trip of robot " + std::to_string(robot) + ": " +
                                          std::to_string(ticks) +
                                          " ticks do not fit int32 (use a larger tick)");
            }
            least[edge] = static_cast<std::int32_t>(ticks);
            if (problem.drive(robot, edge) < 0) {
                continue;  // barred
            }
            const VertexId tail = into.tail[edge];
            const Tick before = ticks + problem.drive(robot, edge);
            for (EdgeId k = into.first[tail]; k < into.first[tail + 1]; ++k) {
                const Tick through = before + itinerary.turns.between(into.edge[k], edge);
                if (through < best[into.edge[k]]) {
                    best[into.edge[k]] = through;
                    open.emplace(through, into.edge[k]);
                }
            }
        }
        Tick at_home = itinerary.home == target ? served(-1) : never;
        for (EdgeId e = graph.indptr[itinerary.home];
             e < graph.indptr[itinerary.home + 1] && itinerary.home != target; ++e) {
            if (least[e] >= 0 && problem.drive(robot, e) > 0) {
                at_home = std::min(at_home, problem.drive(robot, e) + Tick{least[e]});
            }
        }
        least[-1] = at_home > largest ? -1 : static_cast<std::int32_t>(at_home);
    }
}

}  // namespace rightofway
