#include "search/periodic_search.hpp"

#include <algorithm>
#include <utility>

#include "core/reject.hpp"

namespace rightofway {
namespace {

constexpr std::int64_t expansions_between_looks = 512;

}  // namespace

PeriodicSearch::PeriodicSearch(const Roads& roads, const PeriodicBookings& bookings)
    : roads_(roads),
      bookings_(bookings),
      at_(roads.graph.indptr.empty() ? 0 : roads.graph.indptr.size() - 1, none) {
    require_graph(roads.graph, "heads");
    if (!bookings.has_sizes()) {
        require_length("indptr", roads.graph.indptr.size(),
                       static_cast<std::size_t>(bookings.n_rows()) + 1);
    }
    if (!bookings.has_period()) {
        reject("period", 0, "is needed for a trip that repeats");
    }
}

// The ticks that serving a stage adds to a visit: work plus turn.
Tick PeriodicSearch::dwell_of(std::int32_t stage) const {
    const auto k = index(stage);
    return trip_->stage_work[k] + trip_->stage_turn[k];
}

// The least ticks from a vertex through the remaining stages to home; -1 if no path exists.
Tick PeriodicSearch::rest(VertexId vertex, std::int32_t stage) const {
    const Tick way = trip_->to_stage[index(stage)].from(vertex);
    return way < 0 ? way : way + to_go_[index(stage)];
}

bool PeriodicSearch::run(const Trip& trip, Tick phase, PeriodicRoundTrip& found,
                         const StopCondition& is_over, std::int32_t first_row) {
    require_trip(roads_, trip);
    require_range("phase", phase, -latest_tick, latest_tick);
    const auto n_own = static_cast<std::int32_t>(at_.size() + roads_.graph.indices.size());
    require_id("first_row", first_row, bookings_.has_sizes() ? bookings_.n_rows() - n_own + 1 : 1);
    first_row_ = first_row;
    trip_ = &trip;
    is_over_ = &is_over;
    is_stopped_ = false;
    to_go_.assign(trip.n_stages(), 0);
    for (std::int32_t stage = last_stage(); stage-- > 0;) {
        to_go_[index(stage)] = dwell_of(stage) + rest(trip.stage_vertex[index(stage)], stage + 1);
    }
    const Tick first = bookings_.fold(phase);
    const std::vector<EdgeId> last = last_edges();
    bool is_found = false;
    bookings_.for_each_gap(
        first_row_ + trip.home, first, first + bookings_.period(),
        [&](const PeriodicBookings::Gap& home) {
            PeriodicRoundTrip other;
            for (const EdgeId edge : last) {
                if (!is_stopped_ &&
                    close_from(home, home.start == -never ? first : home.start, edge, other) &&
                    (!is_found || other.enter.front() < found.enter.front())) {
                    found = std::move(other);
                    is_found = true;
                }
            }
            return !is_found && !is_stopped_;
        });
    return is_found;
}

// The edges with which a trip may end, one search for each; one search for all where turning takes
// no time.
std::vector<EdgeId> PeriodicSearch::last_edges() const {
    if (!trip_->turns.take_time()) {
        return {none};
    }
    std::vector<EdgeId> edges;
    const auto& heads = roads_.graph.indices;
    for (std::size_t e = 0; e < heads.size(); ++e) {
        if (heads[e] == trip_->home && trip_->pace[index(roads_.length_class[e])] != barred) {
            edges.push_back(static_cast<EdgeId>(e));
        }
    }
    return edges;
}

// Finds the earliest start in a gap of the home from which the robot returns a period later, along
// the last edge.
bool PeriodicSearch::close_from(const PeriodicBookings::Gap& home, Tick start, EdgeId last,
                                PeriodicRoundTrip& found) {
    last_edge_ = last;
    const Tick leaves =
        home.end == never ? start : home.end - bookings_.headway() - dwell_of(last_stage());
    while (start <= leaves && !is_stopped_) {
        // The latest return is the last possible start plus a period.
        const Tick again = earliest_return(home, start, leaves + bookings_.period());
        if (again >= never) {
            return false;
        }
        if (again <= start + bookings_.period()) {
            trace(found);
            return true;
        }
        start = again - bookings_.period();
    }
    return false;
}

// The earliest return, in the same gap a period later, of a robot that enters its home at `start`;
// `never` if no return is possible.
Tick PeriodicSearch::earliest_return(const PeriodicBookings::Gap& home, Tick start, Tick latest) {
    for (const VertexId vertex : touched_) {
        at_[index(vertex)] = none;
    }
    touched_.clear();
    nodes_.clear();
    open_.clear();
    goal_ = none;
    start_ = start;
    reach({start, home, trip_->home, 0, none, last_edge_, 0, none});
    while (!open_.empty()) {
        const OpenList::Entry top = open_.pop();
        const Node& node = nodes_[index(top.node)];
        if (top.key != key(node)) {  // outdated: the gap has an earlier enter
            continue;
        }
        const bool is_same_gap =
            home.end == never || node.gap.start == home.start + bookings_.period();
        if (node.from != none && node.stage == last_stage() && node.vertex == trip_->home &&
            is_same_gap && (last_edge_ == none || node.edge == last_edge_)) {
            goal_ = top.node;
            return node.enter;
        }
        if (n_expanded_++ % expansions_between_looks == 0 && (*is_over_)()) {
            is_stopped_ = true;
            return never;
        }
        expand(top.node, latest);
    }
    return never;
}

// Drives along every edge, for each number of stages that this visit can serve.
void PeriodicSearch::expand(std::int32_t from, Tick latest) {
    const VertexId here = nodes_[index(from)].vertex;
    std::int32_t stage = nodes_[index(from)].stage;
    Tick dwell = nodes_[index(from)].from == none ? dwell_of(last_stage()) : 0;
    for (;; dwell += dwell_of(stage++)) {
        const auto v = index(here);
        for (EdgeId edge = roads_.graph.indptr[v]; edge < roads_.graph.indptr[v + 1]; ++edge) {
            drive(from, edge, stage, dwell, latest);
        }
        if (stage == last_stage() || trip_->stage_vertex[index(stage)] != here) {
            return;
        }
    }
}

// Drives into every reachable gap of the next vertex.
void PeriodicSearch::drive(std::int32_t from, EdgeId edge, std::int32_t stage, Tick dwell,
                           Tick latest) {
    const Node here = nodes_[index(from)];
    const auto e = index(edge);
    const VertexId next = roads_.graph.indices[e];
    const Tick left = rest(next, stage);
    if (left < 0) {
        return;
    }
    const std::int32_t ticks = trip_->pace[index(roads_.length_class[e])];
    if (ticks == barred) {
        return;
    }
    const Tick soonest = here.enter + dwell + trip_->turns.between(here.edge, edge) + ticks;
    const Tick last =
        std::min(here.gap.end == never ? never : here.gap.end - bookings_.headway(), latest - left);
    if (soonest > last) {
        return;
    }
    const Tick approach = bookings_.books_ahead() ? ticks : 0;
    const std::int32_t row =
        bookings_.has_sizes() ? first_row_ + static_cast<std::int32_t>(at_.size()) + edge : none;
    bookings_.for_each_gap(
        first_row_ + next, soonest, last - approach, [&](const PeriodicBookings::Gap& gap) {
            const Tick enter = bookings_.enters(here.gap, gap, soonest, last, approach, row);
            if (enter < never) {
                reach({enter, gap, next, stage, from, edge, ticks, none});
            }
            return true;
        });
}

void PeriodicSearch::reach(const Node& node) {
    std::int32_t& head = at_[index(node.vertex)];
    for (std::int32_t k = head; k != none; k = nodes_[index(k)].next) {
        Node& known = nodes_[index(k)];
        const bool is_headed_alike = last_edge_ == none || known.edge == node.edge;
        // The start node is no return: a round trip takes time.
        if (known.stage == node.stage && known.gap == node.gap && known.from != none &&
            is_headed_alike) {
            if (node.enter < known.enter) {
                const std::int32_t next = known.next;
                known = node;
                known.next = next;
                open_.push(key(known), k);
            }
            return;
        }
    }
    if (head == none) {
        touched_.push_back(node.vertex);
    }
    nodes_.push_back(node);
    nodes_.back().next = head;
    head = static_cast<std::int32_t>(nodes_.size()) - 1;
    open_.push(key(nodes_.back()), head);
}

std::uint64_t PeriodicSearch::key(const Node& node) const {
    const Tick left = rest(node.vertex, node.stage);
    return OpenList::key(node.enter + left - start_, left);
}

void PeriodicSearch::trace(PeriodicRoundTrip& found) const {
    found = {};
    std::vector<std::int32_t> stages;
    std::vector<EdgeId> edges;
    for (std::int32_t k = goal_; k != none; k = nodes_[index(k)].from) {
        const Node& node = nodes_[index(k)];
        found.vertex.push_back(node.vertex);
        found.drive.push_back(node.drive);
        found.enter.push_back(node.enter);
        stages.push_back(node.stage);
        edges.push_back(node.edge);
    }
    std::reverse(found.vertex.begin(), found.vertex.end());
    std::reverse(found.drive.begin(), found.drive.end());
    std::reverse(found.enter.begin(), found.enter.end());
    std::reverse(stages.begin(), stages.end());
    std::reverse(edges.begin(), edges.end());
    // The return is the first visit, a period later.
    found.drive.front() = found.drive.back();
    found.enter.front() = found.enter.back() - bookings_.period();
    found.vertex.pop_back();
    found.drive.pop_back();
    found.enter.pop_back();
    found.dwell.assign(found.vertex.size(), 0);
    found.dwell.front() = dwell_of(last_stage());
    for (std::size_t k = 0; k < found.dwell.size(); ++k) {
        found.dwell[k] += trip_->turns.between(edges[k], edges[k + 1]);
        for (std::int32_t stage = stages[k]; stage < stages[k + 1]; ++stage) {
            found.dwell[k] += dwell_of(stage);
        }
    }
}

}  // namespace rightofway
