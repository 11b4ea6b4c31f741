#include "rightofway/spread_paths.hpp"

#include <algorithm>
#include <cstdlib>

namespace rightofway {
namespace {

constexpr EdgeId none = -1;
constexpr VertexId nowhere = -1;
constexpr std::int32_t legs_between_questions = 32;

int env(const char* n, int d) { const char* s = std::getenv(n); return s ? std::atoi(s) : d; }
const int per_edge = env("SP_EDGE", 16), per_use = env("SP_USE", 1), per_opp = env("SP_OPP", 8),
          most_use = env("SP_MUSE", 16), most_opp = env("SP_MOPP", 64), per_rest=env("SP_REST",320);

}  // namespace

SpreadPaths::SpreadPaths(const Trips& trips, StepTables& tables)
    : trips_(trips),
      tables_(tables),
      reverse_(trips.graph.indices.size(), none),
      tail_(trips.graph.indices.size()),
      edge_use_(trips.graph.indices.size(), 0),
      vertex_use_(static_cast<std::size_t>(trips.graph.n_vertices()), 0),
      first_hop_(trips.stage_vertex.size(), 0),
      end_hop_(trips.stage_vertex.size(), 0),
      seen_in_(vertex_use_.size(), 0),
      so_far_(vertex_use_.size(), 0),
      rests_from_(vertex_use_.size(), infinity),
      when_(vertex_use_.size(), 0),
      by_(vertex_use_.size(), none) {
    const Graph& graph = trips.graph;
    for (VertexId v = 0; v < graph.n_vertices(); ++v) {
        for (EdgeId e = graph.indptr[v]; e < graph.indptr[v + 1]; ++e) {
            tail_[e] = v;
            const VertexId head = graph.indices[e];
            for (EdgeId b = graph.indptr[head]; b < graph.indptr[head + 1]; ++b) {
                if (graph.indices[b] == v) {
                    reverse_[e] = b;
                }
            }
        }
    }
}

bool SpreadPaths::choose(const std::function<bool()>& is_over) {
    find_rests();
    std::int32_t n_legs = 0;
    for (RobotId r = 0; r < trips_.n_robots(); ++r) {
        VertexId place = trips_.home[r];
        Tick when = 0;
        for (std::int32_t s = trips_.first_stage[r]; s < trips_.first_stage[r + 1]; ++s) {
            if (++n_legs % legs_between_questions == 0 && is_over()) {
                return false;
            }
            when = choose_leg(r, place, s, when) + trips_.stage_dwell[s];
            place = trips_.stage_vertex[s];
        }
    }
    return true;
}

void SpreadPaths::find_rests() {
    for (RobotId r = 0; r < trips_.n_robots(); ++r) {
        VertexId place = trips_.home[r];
        Tick when = 0;
        for (std::int32_t s = trips_.first_stage[r]; s < trips_.first_stage[r + 1]; ++s) {
            const VertexId target = trips_.stage_vertex[s];
            when += tables_.steps(tables_.table_of(target), place) * trips_.class_ticks[static_cast<std::size_t>(r) * trips_.n_classes()];
            place = target;
            if (trips_.is_last(r, s)) {
                rests_from_[target] = when;
            }
            when += trips_.stage_dwell[s];
        }
    }
}

VertexId SpreadPaths::next(std::int32_t stage, VertexId at) const {
    const auto first = hops_.begin() + static_cast<std::ptrdiff_t>(first_hop_[stage]);
    const auto end = hops_.begin() + static_cast<std::ptrdiff_t>(end_hop_[stage]);
    const auto hop = std::lower_bound(
        first, end, at, [](const Hop& left, VertexId from) { return left.from < from; });
    return hop != end && hop->from == at ? hop->to : nowhere;
}

Tick SpreadPaths::choose_leg(RobotId robot, VertexId start, std::int32_t stage, Tick when) {
    const VertexId target = trips_.stage_vertex[stage];
    first_hop_[stage] = end_hop_[stage] = hops_.size();
    if (start != target && search(robot, start, target, tables_.table_of(target), when)) {
        keep(start, target, stage);
        return when_[target];
    }
    return when;
}

bool SpreadPaths::is_worse(const Open& left, const Open& right) {
    return left.cost != right.cost       ? left.cost > right.cost
           : left.so_far != right.so_far ? left.so_far < right.so_far
                                         : left.vertex > right.vertex;
}

bool SpreadPaths::search(RobotId robot, VertexId start, VertexId target, StepTables::TableId table, Tick when) {
    const Graph& graph = trips_.graph;
    ++round_;
    open_.clear();
    reach({0, 0, when, start}, none, table);
    while (!open_.empty()) {
        std::pop_heap(open_.begin(), open_.end(), is_worse);
        const Open top = open_.back();
        open_.pop_back();
        if (top.vertex == target) {
            return true;
        }
        if (top.so_far > so_far_[top.vertex]) {
            continue;  // reached at less cost since
        }
        for (EdgeId e = graph.indptr[top.vertex]; e < graph.indptr[top.vertex + 1]; ++e) {
            const VertexId head = graph.indices[e];
            const Tick then = top.when + trips_.drive(robot, e);
            const bool is_rest = head != target && rests_from_[head] <= then;
            reach({0, top.so_far + cost_of(e) + (is_rest ? per_rest : 0), then, head}, e, table);
        }
    }
    return false;
}

void SpreadPaths::reach(const Open& r, EdgeId by, StepTables::TableId table) {
    if (seen_in_[r.vertex] == round_ && so_far_[r.vertex] <= r.so_far) {
        return;
    }
    const std::int32_t steps = tables_.steps(table, r.vertex);
    if (steps == StepTables::unreachable) {
        return;
    }
    seen_in_[r.vertex] = round_;
    so_far_[r.vertex] = r.so_far;
    when_[r.vertex] = r.when;
    by_[r.vertex] = by;
    open_.push_back({r.so_far + std::int64_t{per_edge} * steps, r.so_far, r.when, r.vertex});
    std::push_heap(open_.begin(), open_.end(), is_worse);
}

std::int64_t SpreadPaths::cost_of(EdgeId edge) const {
    const std::int32_t against = reverse_[edge] == none ? 0 : edge_use_[reverse_[edge]];
    return per_edge + std::min(per_opp * against, most_opp) +
           std::min(per_use * vertex_use_[trips_.graph.indices[edge]], most_use);
}

void SpreadPaths::keep(VertexId start, VertexId target, std::int32_t stage) {
    for (VertexId at = target; at != start;) {
        const EdgeId e = by_[at];
        ++edge_use_[e];
        ++vertex_use_[at];
        hops_.push_back({tail_[e], at});
        at = tail_[e];
    }
    std::sort(hops_.begin() + static_cast<std::ptrdiff_t>(first_hop_[stage]), hops_.end(),
              [](const Hop& left, const Hop& right) { return left.from < right.from; });
    end_hop_[stage] = hops_.size();
}

}  // namespace rightofway
