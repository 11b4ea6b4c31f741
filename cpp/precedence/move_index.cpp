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
        const auto begin = std::lower_bound(moves.begin(), moves.end(), opposite, before);
        const auto end = std::upper_bound(begin, moves.end(), opposite, after);
        const RobotId robot = routes.robot(x);
        const auto own = std::lower_bound(begin, end, robot, [&](VisitId visit, RobotId own_robot) {
            return routes.robot(visit) < own_robot;
        });
        const auto own_end = std::upper_bound(
            own, end, robot,
            [&](RobotId own_robot, VisitId visit) { return own_robot < routes.robot(visit); });
        const auto place = [&](auto move) {
            return static_cast<std::int32_t>(move - moves.begin());
        };
        slot_[x] = static_cast<std::int32_t>(slots_.size());
        slots_.push_back({never, x, robot});
        opposite_.push_back({place(begin), place(own), place(own_end), place(end)});
    }
}

}  // namespace rightofway
