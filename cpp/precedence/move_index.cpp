#include "precedence/move_index.hpp"

#include <algorithm>
#include <utility>

namespace rightofway {
namespace {

using Edge = std::pair<VertexId, VertexId>;

Edge edge_into(const Routes& routes, VisitId visit) {
    return {routes.vertex(visit - 1), routes.vertex(visit)};
}

std::vector<VisitId> moves_by_edge(const Routes& routes) {
    std::vector<VisitId> moves;
    for (VisitId x = 0; x < routes.n_visits(); ++x) {
        if (routes.may_swap(x)) {
            moves.push_back(x);
        }
    }
    std::stable_sort(moves.begin(), moves.end(), [&routes](VisitId left, VisitId right) {
        return edge_into(routes, left) < edge_into(routes, right);
    });
    return moves;
}

}  // namespace

MoveIndex::MoveIndex(const Routes& routes) : slot_(routes.n_visits(), none) {
    const std::vector<VisitId> moves = moves_by_edge(routes);
    const auto before = [&routes](VisitId visit, const Edge& edge) {
        return edge_into(routes, visit) < edge;
    };
    const auto after = [&routes](const Edge& edge, VisitId visit) {
        return edge < edge_into(routes, visit);
    };
    for (const VisitId x : moves) {
        const auto [from, to] = edge_into(routes, x);
        const Edge opposite{to, from};
        const auto start = std::lower_bound(moves.begin(), moves.end(), opposite, before);
        const auto end = std::upper_bound(start, moves.end(), opposite, after);
        slot_[x] = static_cast<std::int32_t>(slots_.size());
        slots_.push_back({never, x, routes.robot(x)});
        opposite_.push_back({static_cast<std::size_t>(start - moves.begin()),
                             static_cast<std::size_t>(end - moves.begin())});
    }
}

}  // namespace rightofway
