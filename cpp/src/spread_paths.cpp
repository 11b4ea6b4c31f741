#include "rightofway/spread_paths.hpp"

#include <algorithm>

namespace rightofway {
namespace {

constexpr EdgeId none = -1;
constexpr VertexId nowhere = -1;

// What an edge costs, and what it costs more for each path against it and each at its end, up to
// a bound: a crowd is worth a detour, but not any detour.
constexpr std::int64_t edge_cost = 16;
constexpr std::int64_t cost_against = 8;
constexpr std::int64_t most_against = 64;
constexpr std::int64_t cost_shared = 1;
constexpr std::int64_t most_shared = 16;
// What it costs to drive over a robot at the end of its trip: it has to make room, and come back.
constexpr std::int64_t cost_ended = 320;
// Above edge_cost, the estimate is greedy: fewer vertices are opened, for paths hardly worse.
constexpr std::int64_t estimate_per_step = 24;

// The effort is bounded. Where it comes to less than this for a leg, it would be spent in vain.
constexpr std::int64_t most_opened = 3'000'000;
constexpr std::int64_t least_for_a_leg = 500;
constexpr std::int64_t legs_between_questions = 32;

}  // namespace

SpreadPaths::SpreadPaths(const Trips& trips, StepTables& tables)
    : trips_(trips),
      tables_(tables),
      tail_(trips.graph.indices.size()),
      back_(trips.graph.indices.size(), none),
      ended_from_(static_cast<std::size_t>(trips.graph.n_vertices()), infinity),
      edge_use_(trips.graph.indices.size(), 0),
      vertex_use_(ended_from_.size(), 0),
      first_hop_(trips.stage_vertex.size(), 0),
      end_hop_(trips.stage_vertex.size(), 0),
      best_(ended_from_.size(), {0, 0, none, 0}) {}

void SpreadPaths::pair_edges() {
    const Graph& graph = trips_.graph;
    for (VertexId v = 0; v < graph.n_vertices(); ++v) {
        std::fill(tail_.begin() + graph.indptr[v], tail_.begin() + graph.indptr[v + 1], v);
    }
    for (EdgeId e = 0; e < static_cast<EdgeId>(tail_.size()); ++e) {
        back_[e] = graph.edge(graph.indices[e], tail_[e]);
    }
}

// The last stages, and when their robots are there if nobody makes them wait.
void SpreadPaths::find_ends() {
    for (RobotId r = 0; r < trips_.n_robots(); ++r) {
        VertexId place = trips_.home[r];
        Tick when = 0;
        for (std::int32_t s = trips_.first_stage[r]; s < trips_.first_stage[r + 1]; ++s) {
            const VertexId target = trips_.stage_vertex[s];
            when += trips_.pace(r) * tables_.steps(tables_.table_of(target), place);
            if (trips_.is_last(r, s)) {
                ended_from_[target] = when;
            }
            when += trips_.stage_dwell[s];
            place = target;
        }
    }
}

bool SpreadPaths::choose(const std::function<bool()>& is_over) {
    const auto n_legs = static_cast<std::int64_t>(trips_.stage_vertex.size());
    if (n_legs * least_for_a_leg > most_opened) {
        return true;
    }
    pair_edges();
    find_ends();
    std::int64_t n_chosen = 0;
    for (RobotId r = 0; r < trips_.n_robots(); ++r) {
        VertexId place = trips_.home[r];
        Tick when = 0;
        for (std::int32_t s = trips_.first_stage[r]; s < trips_.first_stage[r + 1]; ++s) {
            if (++n_chosen % legs_between_questions == 0 && is_over()) {
                return false;
            }
            credit_ += most_opened / n_legs;  // what one leg leaves over is for the next ones
            when = choose_leg({r, place, s}, when) + trips_.stage_dwell[s];
            place = trips_.stage_vertex[s];
        }
    }
    return true;
}

VertexId SpreadPaths::next(std::int32_t stage, VertexId at) const {
    const auto first = hops_.begin() + static_cast<std::ptrdiff_t>(first_hop_[stage]);
    const auto end = hops_.begin() + static_cast<std::ptrdiff_t>(end_hop_[stage]);
    const auto hop = std::lower_bound(
        first, end, at, [](const Hop& left, VertexId from) { return left.from < from; });
    return hop != end && hop->from == at ? hop->to : nowhere;
}

// Returns when the robot would be there.
Tick SpreadPaths::choose_leg(const Leg& leg, Tick when) {
    const VertexId target = trips_.stage_vertex[leg.stage];
    if (leg.start == target) {
        return when;
    }
    if (search(leg, when)) {
        keep(leg);
        return best_[target].when;
    }
    return when + trips_.pace(leg.robot) * tables_.steps(tables_.table_of(target), leg.start);
}

bool SpreadPaths::is_worse(const Open& left, const Open& right) {
    return left.estimate != right.estimate ? left.estimate > right.estimate
           : left.cost != right.cost       ? left.cost < right.cost
                                           : left.vertex > right.vertex;
}

bool SpreadPaths::search(const Leg& leg, Tick when) {
    const Graph& graph = trips_.graph;
    const VertexId target = trips_.stage_vertex[leg.stage];
    const StepTables::TableId table = tables_.table_of(target);
    ++round_;
    open_.clear();
    open({0, 0, when, leg.start}, none, table);
    for (; !open_.empty() && credit_ > 0; --credit_) {
        std::pop_heap(open_.begin(), open_.end(), is_worse);
        const Open top = open_.back();
        open_.pop_back();
        if (top.vertex == target) {
            return true;
        }
        if (top.cost > best_[top.vertex].cost) {
            continue;  // reached at less cost since
        }
        for (EdgeId e = graph.indptr[top.vertex]; e < graph.indptr[top.vertex + 1]; ++e) {
            const VertexId head = graph.indices[e];
            const Tick then = top.when + trips_.drive(leg.robot, e);
            const bool has_ended = head != target && ended_from_[head] <= then;
            open({0, top.cost + cost_of(e) + (has_ended ? cost_ended : 0), then, head}, e, table);
        }
    }
    return false;
}

void SpreadPaths::open(Open reached, EdgeId by, StepTables::TableId table) {
    Best& best = best_[reached.vertex];
    if (best.round == round_ && best.cost <= reached.cost) {
        return;
    }
    const std::int32_t steps = tables_.steps(table, reached.vertex);
    if (steps == StepTables::unreachable) {
        return;
    }
    best = {reached.cost, reached.when, by, round_};
    reached.estimate = reached.cost + estimate_per_step * steps;
    open_.push_back(reached);
    std::push_heap(open_.begin(), open_.end(), is_worse);
}

std::int64_t SpreadPaths::cost_of(EdgeId edge) const {
    const std::int64_t against = back_[edge] == none ? 0 : edge_use_[back_[edge]];
    const std::int64_t shared = vertex_use_[trips_.graph.indices[edge]];
    return edge_cost + std::min(cost_against * against, most_against) +
           std::min(cost_shared * shared, most_shared);
}

// Goes back along the edges by which the search came.
void SpreadPaths::keep(const Leg& leg) {
    const auto first = static_cast<std::ptrdiff_t>(hops_.size());
    for (VertexId at = trips_.stage_vertex[leg.stage]; at != leg.start;) {
        const EdgeId edge = best_[at].by;
        ++edge_use_[edge];
        ++vertex_use_[at];
        hops_.push_back({tail_[edge], at});
        at = tail_[edge];
    }
    std::sort(hops_.begin() + first, hops_.end(),
              [](const Hop& left, const Hop& right) { return left.from < right.from; });
    first_hop_[leg.stage] = static_cast<std::size_t>(first);
    end_hop_[leg.stage] = hops_.size();
}

}  // namespace rightofway
