#include "distances/congestion.hpp"

#include <algorithm>
#include <functional>
#include <string>

#include "core/reject.hpp"
#include "core/reverse_graph.hpp"

namespace rightofway {
namespace {

// Upper limit of a surcharge, so that sums of them stay small.
constexpr std::int64_t most_shares = std::int64_t{1} << 40;

// At most `never`. Most factors are small, and need no division.
std::int64_t product(std::int64_t left, std::int64_t right) {
    constexpr std::int64_t small = std::int64_t{1} << 31;
    if ((left < small && right < small) || right == 0 || left <= never / right) {
        return left * right;
    }
    return never;
}

}  // namespace

Congestion::Congestion(const Problem& problem, std::int64_t shares,
                       std::span<const std::int64_t> station)
    : problem_(problem), shares_(shares), station_(station.begin(), station.end()) {
    const Graph& graph = problem.graph();
    require_length("station", station.size(), static_cast<std::size_t>(graph.n_vertices()));
    if (shares < 1) {
        reject("shares", shares, "is not above 0");
    }
    require_range("shares", shares, 1, most_shares);
    for (std::size_t v = 0; v < station.size(); ++v) {
        if (station[v] < 0) {
            reject_entry("station", v, station[v], "is negative");
        }
    }
    require_ranges("station", station, 0, most_shares);
    oncoming_.assign(graph.indices.size(), 0);
    cost_.assign(station_.size(), never);
    cheapest_way_.assign(station_.size(), none);
    is_marked_.assign(station_.size(), 0);
    opposite_ = find_opposite_edges(graph);
}

std::int64_t Congestion::cost_of(EdgeId edge, VertexId target, Tick ticks) const {
    const VertexId head = problem_.graph().indices[index(edge)];
    std::int64_t per_tick = shares_;
    if (head != target) {
        per_tick += station_[index(head)];
    }
    if (opposite_[index(edge)] != none) {
        per_tick += oncoming_[index(opposite_[index(edge)])];
    }
    return product(per_tick, ticks);
}

std::vector<VertexId> Congestion::path(RobotId robot, VertexId start, VertexId target,
                                       std::span<const std::int32_t> to_go,
                                       const StopCondition& interrupt) {
    require_id("robot", robot, problem_.n_robots());
    require_id("start", start, n_vertices());
    require_id("target", target, n_vertices());
    require_length("to_go", to_go.size(), station_.size());
    if (to_go[index(start)] < 0) {
        reject("target", target, "cannot be reached from " + std::to_string(start));
    }
    Poll poll(interrupt);
    try {
        search(robot, start, target, to_go, poll);
    } catch (...) {
        clear();
        throw;
    }
    if (cost_[index(target)] >= never) {
        clear();
        reject("target", target,
               "cannot be reached from " + std::to_string(start) +
                   " by vertices with an entry in to_go, or the way costs too much");
    }
    mark_cheapest(target);
    std::vector<VertexId> path = first_marked(start, target);
    clear();
    return path;
}

// A* that continues until all paths of least cost are known.
void Congestion::search(RobotId robot, VertexId start, VertexId target,
                        std::span<const std::int32_t> to_go, Poll& poll) {
    const Graph& graph = problem_.graph();
    cost_[index(start)] = 0;
    reached_.push_back(start);
    const std::int64_t at_least = product(shares_, to_go[index(start)]);
    open_.push_back({at_least, at_least, 0, start});
    while (!open_.empty() && open_.front().cost <= cost_[index(target)]) {
        poll();
        std::pop_heap(open_.begin(), open_.end(), std::greater<>());
        const Open top = open_.back();
        open_.pop_back();
        if (top.cost - top.to_go > cost_[index(top.vertex)] || top.vertex == target) {
            continue;  // outdated: the vertex has a cheaper path
        }
        for (EdgeId e = graph.indptr[index(top.vertex)]; e < graph.indptr[index(top.vertex + 1)];
             ++e) {
            const VertexId head = graph.indices[index(e)];
            const Tick drive = problem_.drive(robot, e);
            if (to_go[index(head)] >= 0 && drive != barred) {
                const std::int64_t cost =
                    cost_[index(top.vertex)] + cost_of(e, target, drive + problem_.surcharge(e));
                reach(head, top.vertex, cost, product(shares_, to_go[index(head)]));
            }
        }
    }
}

void Congestion::reach(VertexId vertex, VertexId from, std::int64_t cost, std::int64_t to_go) {
    if (cost > cost_[index(vertex)] || cost >= never) {
        return;
    }
    if (cost < cost_[index(vertex)]) {
        if (cost_[index(vertex)] == never) {
            reached_.push_back(vertex);
        }
        cost_[index(vertex)] = cost;
        cheapest_way_[index(vertex)] = none;
        open_.push_back({cost + to_go, to_go, static_cast<std::int64_t>(ways_.size()), vertex});
        std::push_heap(open_.begin(), open_.end(), std::greater<>());
    }
    ways_.push_back({from, cheapest_way_[index(vertex)]});
    cheapest_way_[index(vertex)] = static_cast<std::int32_t>(ways_.size()) - 1;
}

// Marks the vertices of all cheapest paths.
void Congestion::mark_cheapest(VertexId target) {
    std::vector<VertexId> to_mark{target};
    is_marked_[index(target)] = 1;
    while (!to_mark.empty()) {
        const VertexId vertex = to_mark.back();
        to_mark.pop_back();
        for (std::int32_t way = cheapest_way_[index(vertex)]; way != none;
             way = ways_[index(way)].next) {
            if (is_marked_[index(ways_[index(way)].from)] == 0) {
                is_marked_[index(ways_[index(way)].from)] = 1;
                to_mark.push_back(ways_[index(way)].from);
            }
        }
    }
}

std::vector<VertexId> Congestion::first_marked(VertexId start, VertexId target) const {
    const auto leads_from = [this](VertexId head, VertexId tail) {
        for (std::int32_t way = cheapest_way_[index(head)]; way != none;
             way = ways_[index(way)].next) {
            if (ways_[index(way)].from == tail) {
                return true;
            }
        }
        return false;
    };
    std::vector<VertexId> path{start};
    while (path.back() != target) {
        const auto heads = problem_.graph().heads(path.back());
        path.push_back(*std::find_if(heads.begin(), heads.end(), [&](VertexId head) {
            return is_marked_[index(head)] != 0 && leads_from(head, path.back());
        }));
    }
    return path;
}

void Congestion::clear() {
    for (const VertexId vertex : reached_) {
        cost_[index(vertex)] = never;
        cheapest_way_[index(vertex)] = none;
        is_marked_[index(vertex)] = 0;
    }
    reached_.clear();
    ways_.clear();
    open_.clear();
}

void Congestion::add(std::span<const VertexId> path, std::int64_t oncoming) {
    if (oncoming < 0) {
        reject("oncoming", oncoming, "is negative");
    }
    require_range("oncoming", oncoming, 0, most_shares);
    std::vector<EdgeId> edges;
    for (std::size_t k = 0; k < path.size(); ++k) {
        require_id("path[" + std::to_string(k) + "]", path[k], n_vertices());
        if (k > 0) {
            edges.push_back(problem_.graph().edge(path[k - 1], path[k]));
        }
        if (k > 0 && edges.back() == none) {
            reject_entry("path", k, path[k], "is no neighbour of " + std::to_string(path[k - 1]));
        }
    }
    for (const EdgeId e : edges) {
        oncoming_[index(e)] = std::min(oncoming_[index(e)] + oncoming, never);
    }
}

}  // namespace rightofway
