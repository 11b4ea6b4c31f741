#include "distances/shortest_paths.hpp"

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

#include "core/reject.hpp"
#include "core/reverse_graph.hpp"

namespace rightofway {
namespace {

// Landmarks take as many tables as they are, so they are for those who want more paths than that.
constexpr std::int32_t paths_before_landmarks = 8;

// A search may visit one vertex in this many, or a few, before a table is quicker.
constexpr std::int64_t share_of_vertices = 3;
constexpr std::int64_t few_vertices = 64;

}  // namespace

ShortestPaths::ShortestPaths(std::span<const EdgeId> indptr, std::span<const VertexId> indices,
                             std::span<const std::int32_t> edge_ticks)
    : indptr_(indptr.begin(), indptr.end()),
      heads_(indices.begin(), indices.end()),
      ticks_(edge_ticks.begin(), edge_ticks.end()),
      graph_{indptr_, heads_},
      tables_(indptr_, heads_),
      visited_(static_cast<std::size_t>(graph_.n_vertices()), {0, 0}) {
    require_length("edge_ticks", ticks_.size(), heads_.size());
    const std::vector<EdgeId> opposite = find_opposite_edges(graph_);
    for (std::size_t e = 0; e < opposite.size() && is_symmetric_; ++e) {
        is_symmetric_ = opposite[e] >= 0 && ticks_[index(opposite[e])] == ticks_[e];
    }
}

// Each landmark is farthest from the landmarks before it; the first landmark from vertex 0.
void ShortestPaths::choose_landmarks() {
    std::vector<Row> rows(visited_.size());
    try {
        std::vector<std::int32_t> nearest = tables_.to(0, ticks_);
        for (std::size_t k = 0; k < n_landmarks; ++k) {
            const auto far = std::max_element(nearest.begin(), nearest.end());
            const auto counts = tables_.to(static_cast<VertexId>(far - nearest.begin()), ticks_);
            for (std::size_t v = 0; v < rows.size(); ++v) {
                rows[v][k] = counts[v];
                nearest[v] = k == 0 ? counts[v] : std::min(nearest[v], counts[v]);
            }
        }
    } catch (const std::overflow_error&) {
        return;  // a landmark may be too far away where no target is
    }
    rows_ = std::move(rows);
}

// A lower bound of the ticks from a vertex to the target; `never` if there is no path.
Tick ShortestPaths::bound(VertexId vertex) const {
    const Row& row = rows_[index(vertex)];
    std::int32_t most = 0;
    for (std::size_t k = 0; k < n_landmarks; ++k) {
        if (target_row_[k] == no_way) {
            continue;
        }
        if (row[k] == no_way) {
            return never;  // a path to the target would continue to the landmark
        }
        const std::int32_t nearer = row[k] - target_row_[k];
        most = std::max(most, is_symmetric_ ? std::abs(nearer) : nearer);
    }
    return most;
}

// Leaves in `path_` the first path of at most `budget` ticks, in the order of edges. A vertex is
// visited again only after fewer ticks than before: all that can follow was tried then.
bool ShortestPaths::search(VertexId start, VertexId target, Tick budget) {
    ++n_searches_;
    next_budget_ = never;
    path_.assign(1, {start, indptr_[index(start)], 0});
    visited_[index(start)] = {0, n_searches_};
    while (!path_.empty()) {
        Step& step = path_.back();
        if (step.vertex == target) {
            return true;
        }
        if (step.next == indptr_[index(step.vertex) + 1]) {
            path_.pop_back();
            continue;
        }
        const EdgeId edge = step.next++;
        if (ticks_[index(edge)] == barred) {
            continue;
        }
        const VertexId head = heads_[index(edge)];
        const Tick ticks = step.ticks + ticks_[index(edge)];
        Visited& visited = visited_[index(head)];
        if (visited.search == n_searches_ && visited.ticks <= ticks) {
            continue;
        }
        const Tick rest = bound(head);
        if (rest == never) {
            continue;
        }
        if (ticks + rest > budget) {
            next_budget_ = std::min(next_budget_, ticks + rest);
            continue;
        }
        if (--steps_left_ < 0) {
            return false;
        }
        visited = {ticks, n_searches_};
        path_.push_back({head, indptr_[index(head)], ticks});
    }
    return false;
}

// The path down the distance table of the target.
std::vector<VertexId> ShortestPaths::walk(VertexId start, VertexId target) const {
    const std::vector<std::int32_t> table = tables_.to(target, ticks_);
    if (table[index(start)] == no_way) {
        return {};
    }
    std::vector<VertexId> path{start};
    while (path.back() != target) {
        const VertexId v = path.back();
        EdgeId edge = indptr_[index(v)];
        while (ticks_[index(edge)] == barred || table[index(heads_[index(edge)])] == no_way ||
               table[index(heads_[index(edge)])] != table[index(v)] - ticks_[index(edge)]) {
            ++edge;
        }
        path.push_back(heads_[index(edge)]);
    }
    return path;
}

std::vector<VertexId> ShortestPaths::find(VertexId start, VertexId target) {
    require_id("start", start, n_vertices());
    require_id("target", target, n_vertices());
    if (n_paths_ == paths_before_landmarks) {
        choose_landmarks();
    }
    n_paths_ = std::min(n_paths_ + 1, paths_before_landmarks + 1);
    if (rows_.empty()) {
        return walk(start, target);
    }
    target_row_ = rows_[index(target)];
    steps_left_ = few_vertices + n_vertices() / share_of_vertices;
    Tick budget = bound(start);
    while (budget != never) {
        if (search(start, target, budget)) {
            std::vector<VertexId> path(path_.size());
            std::transform(path_.begin(), path_.end(), path.begin(),
                           [](const Step& step) { return step.vertex; });
            return path;
        }
        if (steps_left_ < 0) {
            return walk(start, target);
        }
        budget = next_budget_;
    }
    return {};
}

}  // namespace rightofway
