#include "distances/space_utilization.hpp"

#include <algorithm>
#include <limits>
#include <span>

#include "core/reverse_graph.hpp"

namespace rightofway {
namespace {

constexpr VertexId nowhere = -1;

// The cost of an edge; the surcharge per opposing path and per path at its head, each up to a bound
// (so detours are bounded, too).
constexpr std::int32_t cost_of_edge = 16;
constexpr std::int32_t cost_against = 8;
constexpr std::int32_t most_against = 64;
constexpr std::int32_t cost_shared = 1;
constexpr std::int32_t most_shared = 16;
// The cost of passing a robot at the end of its trip: that robot has to make room and return.
constexpr std::int32_t cost_ended = 320;
// Greater than cost_of_edge, so the estimate is greedy: fewer vertices opened, paths hardly worse.
constexpr std::int32_t estimate_per_step = 20;
// The cost of a vertex whose edges have been followed: none is less, so it is not opened again.
constexpr std::int32_t closed = -1;
// The width of a list: its estimates differ by less.
constexpr std::int32_t list_width = 4;

// The most vertices opened in all; below the least number per leg, no leg gets a path. So no cost
// of a path exceeds int32.
constexpr std::int64_t most_opened = 3'000'000;
static_assert(most_opened * (cost_of_edge + most_against + most_shared + cost_ended) +
                  (std::int64_t{estimate_per_step} << 16) <
              std::numeric_limits<std::int32_t>::max());
constexpr std::int64_t least_for_a_leg = 500;
constexpr std::int64_t legs_between_questions = 32;
static_assert(most_opened / least_for_a_leg < std::numeric_limits<std::uint16_t>::max());

void raise(std::uint8_t& cost, std::int32_t by, std::int32_t most) {
    cost = static_cast<std::uint8_t>(std::min(cost + by, most));
}

}  // namespace

SpaceUtilization::SpaceUtilization(const Problem& problem, StepTables& tables)
    : problem_(problem),
      tables_(tables),
      first_hop_(problem.n_stages(), 0),
      end_hop_(problem.n_stages(), 0),
      best_(static_cast<std::size_t>(problem.graph().n_vertices()), {0, 0, 0}),
      way_(best_.size(), {0, never, none}) {}

// The vertex of each last stage and the enter of its robot without waits.
void SpaceUtilization::find_ends() {
    for (RobotId r = 0; r < problem_.n_robots(); ++r) {
        VertexId place = problem_.home(r);
        Tick when = 0;
        for (std::int32_t s = problem_.first_stage(r); s < problem_.first_stage(r + 1); ++s) {
            const VertexId target = problem_.stage_vertex(s);
            when += problem_.quickest_edge(r) * tables_.steps(tables_.table_of(target), place);
            if (problem_.is_last(r, s)) {
                way_[index(target)].ended_from = when;
            }
            when += problem_.stage_dwell(s);
            place = target;
        }
    }
}

bool SpaceUtilization::choose(const StopCondition& is_over) {
    const auto n_legs = static_cast<std::int64_t>(problem_.n_stages());
    if (n_legs * least_for_a_leg > most_opened) {
        return true;
    }
    tail_ = list_tails(problem_.graph());
    opposite_ = find_opposite_edges(problem_.graph());
    cost_of_.assign(problem_.graph().indices.size(), cost_of_edge);
    find_ends();
    Poll poll(is_over);
    std::int64_t n_chosen = 0;
    for (RobotId r = 0; r < problem_.n_robots(); ++r) {
        VertexId place = problem_.home(r);
        Tick when = 0;
        for (std::int32_t s = problem_.first_stage(r); s < problem_.first_stage(r + 1); ++s) {
            if (++n_chosen % legs_between_questions == 0 && is_over()) {
                return false;
            }
            credit_ += most_opened / n_legs;  // unused credit is for later legs
            when = choose_leg({r, place, s}, when, poll) + problem_.stage_dwell(s);
            place = problem_.stage_vertex(s);
            if (is_stopped_) {
                return false;
            }
        }
    }
    return true;
}

VertexId SpaceUtilization::next(std::int32_t stage, VertexId at) const {
    const auto first = hops_.begin() + static_cast<std::ptrdiff_t>(first_hop_[index(stage)]);
    const auto end = hops_.begin() + static_cast<std::ptrdiff_t>(end_hop_[index(stage)]);
    const auto hop = std::lower_bound(
        first, end, at, [](const Hop& left, VertexId from) { return left.from < from; });
    return hop != end && hop->from == at ? hop->to : nowhere;
}

// Returns the enter of the robot at the leg's end, without waits.
Tick SpaceUtilization::choose_leg(const Leg& leg, Tick when, Poll& poll) {
    const VertexId target = problem_.stage_vertex(leg.stage);
    if (leg.start == target) {
        return when;
    }
    if (search(leg, when, poll)) {
        keep(leg);
        return way_[index(target)].when;
    }
    return when +
           problem_.quickest_edge(leg.robot) * tables_.steps(tables_.table_of(target), leg.start);
}

bool SpaceUtilization::search(const Leg& leg, Tick when, Poll& poll) {
    const auto [indptr, heads] = problem_.graph();
    const VertexId target = problem_.stage_vertex(leg.stage);
    const StepTables::TableId table = tables_.table_of(target);
    ++round_;
    open_.clear();
    std::fill(first_open_.begin(), first_open_.end(), none);
    least_ = cost_of_edge * tables_.steps(table, leg.start);
    list_ = first_open_.size();
    open(leg.start, 0, none, table);
    way_[index(leg.start)].when = when;
    for (Open top{}; credit_ > 0 && take_next(top); --credit_) {
        if (poll()) {
            is_stopped_ = true;
            return false;
        }
        if (top.vertex == target) {
            return true;
        }
        if (best_[index(top.vertex)].cost < top.cost) {
            continue;  // outdated: the vertex has a cheaper path, or is closed
        }
        best_[index(top.vertex)].cost = closed;
        const Tick now = way_[index(top.vertex)].when;
        for (EdgeId e = indptr[index(top.vertex)]; e < indptr[index(top.vertex + 1)]; ++e) {
            const VertexId head = heads[index(e)];
            const Best& known = best_[index(head)];
            const std::int32_t cost = top.cost + cost_of_[index(e)] + known.shared;
            if (known.round == round_ && known.cost <= cost) {
                continue;  // most heads: the way back, or a way round
            }
            const Tick then = now + problem_.drive(leg.robot, e);
            const bool has_ended = head != target && way_[index(head)].ended_from <= then;
            if (open(head, cost + (has_ended ? cost_ended : 0), e, table)) {
                way_[index(head)].when = then;
            }
        }
    }
    return false;
}

// Opens a vertex reached at a cost over an edge; false if that is no better than before.
bool SpaceUtilization::open(VertexId vertex, std::int32_t cost, EdgeId by,
                            StepTables::TableId table) {
    Best& best = best_[index(vertex)];
    if (best.round == round_ && best.cost <= cost) {
        return false;
    }
    const std::int32_t steps = tables_.steps(table, vertex);
    if (steps == StepTables::unreachable) {
        return false;
    }
    best.cost = cost;
    best.round = round_;
    way_[index(vertex)].by = by;
    const auto list = index((cost + estimate_per_step * steps - least_) / list_width);
    if (list >= first_open_.size()) {
        first_open_.resize(list + 1, none);
    }
    open_.push_back({cost, vertex, first_open_[list]});
    first_open_[list] = static_cast<std::int32_t>(open_.size()) - 1;
    list_ = std::min(list_, list);  // a greedy estimate may decrease
    return true;
}

// The vertex opened last in the first list that is not empty.
bool SpaceUtilization::take_next(Open& next) {
    while (list_ < first_open_.size() && first_open_[list_] == none) {
        ++list_;
    }
    if (list_ == first_open_.size()) {
        return false;
    }
    next = open_[index(first_open_[list_])];
    first_open_[list_] = next.next;
    return true;
}

// Traces the path back from the target and stores its hops.
void SpaceUtilization::keep(const Leg& leg) {
    const auto first = static_cast<std::ptrdiff_t>(hops_.size());
    for (VertexId at = problem_.stage_vertex(leg.stage); at != leg.start;) {
        const EdgeId edge = way_[index(at)].by;
        raise(best_[index(at)].shared, cost_shared, most_shared);
        if (const EdgeId opposite = opposite_[index(edge)]; opposite != none) {
            raise(cost_of_[index(opposite)], cost_against, cost_of_edge + most_against);
        }
        hops_.push_back({tail_[index(edge)], at});
        at = tail_[index(edge)];
    }
    std::sort(hops_.begin() + first, hops_.end(),
              [](const Hop& left, const Hop& right) { return left.from < right.from; });
    first_hop_[index(leg.stage)] = index(first);
    end_hop_[index(leg.stage)] = hops_.size();
}

}  // namespace rightofway
