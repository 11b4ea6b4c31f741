#include "rightofway/safe_interval_search.hpp"

#include <algorithm>
#include <string>

#include "rightofway/reject.hpp"

namespace rightofway {
namespace {

constexpr std::int32_t none = -1;
constexpr std::int64_t states_between_questions = 4096;

}  // namespace

SafeIntervalSearch::SafeIntervalSearch(const Graph& graph, const BookingTable& bookings,
                                       const BookingRules& rules, const Trip& trip)
    : graph_(graph), bookings_(bookings), rules_(rules), trip_(trip) {
    check(trip);
    const std::size_t places = trip.stage_vertex.size() + 1;
    first_here_.assign(places * static_cast<std::size_t>(bookings.n_vertices()), none);
    to_go_.assign(trip.stage_vertex.size(), 0);
    for (std::int32_t stage = n_stages() - 1; stage >= 0; --stage) {
        to_go_[stage] = trip.stage_dwell[stage];
        if (stage + 1 < n_stages()) {
            to_go_[stage] += rest(trip.stage_vertex[stage], stage + 1);
        }
    }
}

void SafeIntervalSearch::check(const Trip& trip) const {
    const VertexId n_vertices = bookings_.n_vertices();
    require_length("indptr", graph_.indptr.size(), static_cast<std::size_t>(n_vertices) + 1);
    require_length("edge_ticks", trip.edge_ticks.size(), graph_.indices.size());
    require_length("stage_dwell", trip.stage_dwell.size(), trip.stage_vertex.size());
    require_length("stage_tables", trip.stage_tables.size(), trip.stage_vertex.size());
    require_id("home", trip.home, n_vertices);
    VertexId place = trip.home;
    for (std::size_t k = 0; k < trip.stage_vertex.size(); ++k) {
        require_id("stage_vertex[" + std::to_string(k) + "]", trip.stage_vertex[k], n_vertices);
        require_length("stage_tables[" + std::to_string(k) + "]", trip.stage_tables[k].size(),
                       static_cast<std::size_t>(n_vertices));
        if (trip.stage_tables[k][place] < 0) {
            reject_entry("stage_vertex", k, trip.stage_vertex[k], "cannot be reached");
        }
        place = trip.stage_vertex[k];
    }
}

// The least ticks from here to completion, or -1 where no way leads on.
Tick SafeIntervalSearch::rest(VertexId vertex, std::int32_t stage) const {
    if (stage == n_stages()) {
        return 0;
    }
    const Tick way = trip_.stage_tables[stage][vertex];
    return way < 0 ? way : way + to_go_[stage];
}

SearchEnd SafeIntervalSearch::run(const std::function<bool()>& is_over) {
    const std::int32_t gap = bookings_.first_gap_after(trip_.home, 0);
    if (bookings_.gap(trip_.home, gap).start > 0) {
        return SearchEnd::proven_none;  // somebody else holds home at tick 0
    }
    reach({trip_.home, gap, 0, none, none, false, true, 0, 0});
    std::int64_t n_expanded = 0;
    while (!open_.empty()) {
        std::pop_heap(open_.begin(), open_.end(), is_later);
        const Open top = open_.back();
        open_.pop_back();
        if (nodes_[top.node].is_closed || top.ready > nodes_[top.node].ready) {
            continue;  // reached earlier since
        }
        if (nodes_[top.node].stage == n_stages()) {
            goal_ = top.node;
            return SearchEnd::found;
        }
        if (++n_expanded % states_between_questions == 0 && is_over()) {
            return SearchEnd::stopped;
        }
        expand(top.node);
    }
    return SearchEnd::proven_none;
}

void SafeIntervalSearch::expand(std::int32_t node) {
    nodes_[node].is_closed = true;
    serve(node);
    const VertexId vertex = nodes_[node].vertex;
    for (EdgeId edge = graph_.indptr[vertex]; edge < graph_.indptr[vertex + 1]; ++edge) {
        drive(node, edge);
    }
}

// Serves the next stage, if this is its vertex and the gap is long enough; the last stage needs a
// gap that never ends.
void SafeIntervalSearch::serve(std::int32_t node) {
    const Node here = nodes_[node];
    if (here.stage == n_stages() || trip_.stage_vertex[here.stage] != here.vertex) {
        return;
    }
    const Tick end = bookings_.gap(here.vertex, here.gap).end;
    const Tick done = here.ready + trip_.stage_dwell[here.stage];
    const bool is_last = here.stage + 1 == n_stages();
    if (is_last ? end == infinity : done + rules_.headway < end) {
        reach({here.vertex, here.gap, here.stage + 1, node, none, false, false, done, done});
    }
}

// Drives an edge into each gap of its end that can be entered before this gap is over.
void SafeIntervalSearch::drive(std::int32_t node, EdgeId edge) {
    const Node here = nodes_[node];
    const Gap from = bookings_.gap(here.vertex, here.gap);
    const VertexId head = graph_.indices[edge];
    const Tick ticks = trip_.edge_ticks[edge];
    const Tick approach = rules_.books_ahead ? ticks : 0;
    const Tick soonest = here.ready + ticks;
    const Tick latest = from.end == infinity ? infinity : from.end - rules_.headway;
    const std::int32_t n_gaps = bookings_.n_gaps(head);
    if (soonest > latest || rest(head, here.stage) < 0) {
        return;
    }
    for (std::int32_t k = bookings_.first_gap_after(head, soonest - approach); k < n_gaps; ++k) {
        const Gap to = bookings_.gap(head, k);
        const Tick enter = std::max(soonest, to.start + approach);
        if (enter > latest) {
            return;
        }
        // The robot that leaves the head at this instant would enter the vertex that is left.
        const bool is_swap = enter == to.start && enter == from.end && to.before == from.after;
        if (enter + rules_.headway < to.end && !is_swap) {
            reach({head, k, here.stage, node, none, false, true, enter, enter});
        }
    }
}

// Notes that a state can be reached, if it is not known to be reached as early already.
void SafeIntervalSearch::reach(const Node& candidate) {
    std::int32_t node = find(candidate);
    if (node == none) {
        const std::size_t place = static_cast<std::size_t>(candidate.stage) *
                                      static_cast<std::size_t>(bookings_.n_vertices()) +
                                  static_cast<std::size_t>(candidate.vertex);
        node = static_cast<std::int32_t>(nodes_.size());
        nodes_.push_back(candidate);
        nodes_[node].next_here = first_here_[place];
        first_here_[place] = node;
    } else if (!nodes_[node].is_closed && candidate.ready < nodes_[node].ready) {
        const std::int32_t next_here = nodes_[node].next_here;
        nodes_[node] = candidate;
        nodes_[node].next_here = next_here;
    } else {
        return;
    }
    const Tick to_go = rest(candidate.vertex, candidate.stage);
    open_.push_back({candidate.ready + to_go, to_go, n_pushed_++, node, candidate.ready});
    std::push_heap(open_.begin(), open_.end(), is_later);
}

std::int32_t SafeIntervalSearch::find(const Node& candidate) const {
    const std::size_t place = static_cast<std::size_t>(candidate.stage) *
                                  static_cast<std::size_t>(bookings_.n_vertices()) +
                              static_cast<std::size_t>(candidate.vertex);
    std::int32_t node = first_here_[place];
    while (node != none && nodes_[node].gap != candidate.gap) {
        node = nodes_[node].next_here;
    }
    return node;
}

bool SafeIntervalSearch::is_later(const Open& left, const Open& right) {
    if (left.f != right.f) {
        return left.f > right.f;
    }
    return left.rest != right.rest ? left.rest > right.rest : left.order > right.order;
}

FoundTrack SafeIntervalSearch::track() const {
    FoundTrack found;
    for (std::int32_t node = goal_; node != none; node = nodes_[node].parent) {
        if (nodes_[node].by_drive) {
            found.vertices.push_back(nodes_[node].vertex);
            found.enter.push_back(nodes_[node].enter);
        }
    }
    std::reverse(found.vertices.begin(), found.vertices.end());
    std::reverse(found.enter.begin(), found.enter.end());
    return found;
}

}  // namespace rightofway
