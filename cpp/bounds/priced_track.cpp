#include "bounds/priced_track.hpp"

#include <algorithm>

#include "core/poll.hpp"

namespace rightofway {

std::size_t PricesOfPlace::from(Tick tick) const {
    const auto found =
        std::lower_bound(entries_.begin(), entries_.end(), tick,
                         [](const Entry& entry, Tick value) { return entry.tick < value; });
    return static_cast<std::size_t>(found - entries_.begin());
}

Tick PricesOfPlace::before(Tick tick) const {
    const std::size_t k = from(tick);
    return k == entries_.size() ? sum_ : entries_[k].before;
}

void PricesOfPlace::add_up() {
    sum_ = 0;
    for (Entry& entry : entries_) {
        entry.before = sum_;
        sum_ += entry.price;
    }
}

Prices::Prices(const Problem& problem) : vertices_(static_cast<std::size_t>(problem.n_vertices())) {
    if (!problem.may_follow()) {
        return;
    }
    const Graph& graph = problem.graph();
    lane_.assign(graph.indices.size(), none);
    for (VertexId tail = 0; tail < graph.n_vertices(); ++tail) {
        for (EdgeId e = graph.indptr[index(tail)]; e < graph.indptr[index(tail + 1)]; ++e) {
            const EdgeId back = graph.edge(graph.indices[index(e)], tail);
            if (back >= 0 && lane_[index(back)] != none) {
                lane_[index(e)] = lane_[index(back)];
                continue;
            }
            lane_[index(e)] = static_cast<std::int32_t>(lanes_.size());
            lanes_.emplace_back();
        }
    }
}

PricedSearch::PricedSearch(const Problem& problem) : problem_(problem) {}

Booking PricedSearch::booking(RobotId robot, const PricedTrack& track, std::size_t visit) const {
    const PricedVisit& here = track.visits[visit];
    const Tick drive = here.edge < 0 ? 0 : problem_.drive(robot, here.edge);
    // Without headway: then no two bookings of a vertex by one robot overlap.
    const Tick end = visit + 1 < track.visits.size() ? track.visits[visit + 1].enter : never;
    return {here.enter - problem_.approach(drive), end};
}

Tick PricedSearch::priced(const Prices& prices, const PricedTrack& track) const {
    Tick sum = parts_per_tick * track.cost;
    for (std::size_t k = 0; k < track.visits.size(); ++k) {
        const PricedVisit& visit = track.visits[k];
        const Booking time = booking(robot_, track, k);
        sum += prices.at(visit.vertex).of(time.start, time.end);
        if (prices.has_lanes() && visit.edge >= 0) {
            sum += prices.along(visit.edge).of(visit.enter, visit.enter + 1);
        }
    }
    return sum;
}

Tick PricedSearch::least_to_go(const Trip& trip, std::int32_t stage, VertexId vertex) const {
    const Tick way = trip.to_stage[index(stage)].from(vertex);
    return way < 0 ? never : way + later_[index(stage)];
}

bool PricedSearch::improve(RobotId robot, const Trip& trip, const Prices& prices,
                           PricedTrack& track, const StopCondition& is_over) {
    robot_ = robot;
    weight_ = problem_.weight(robot) * parts_per_tick;
    const auto n_stages = static_cast<std::int32_t>(trip.n_stages());
    const auto first_at_end = static_cast<std::int32_t>(trip.first_stage_at_end());
    later_.assign(trip.n_stages(), 0);
    for (std::int32_t k = n_stages; k-- > 0;) {
        const auto at = index(k);
        later_[at] = trip.stage_work[at] + (k < first_at_end ? trip.stage_turn[at] : 0);
        if (k + 1 < n_stages) {
            later_[at] += trip.to_stage[at + 1].from(trip.stage_vertex[at]) + later_[at + 1];
        }
    }
    const Tick least = weight_ * least_to_go(trip, 0, trip.home);
    upper_ = track.visits.empty() ? never : priced(prices, track);
    if (upper_ <= least) {
        return true;
    }
    origin_ = least;
    nodes_.clear();
    open_.clear();
    first_.resize(trip.n_stages() * index(problem_.n_vertices()), none);
    Poll poll(is_over);
    push({0, 0, trip.home, -1, 0, none}, least_to_go(trip, 0, trip.home), prices.at(trip.home));
    std::int32_t best = none;
    Tick best_completion = 0;
    bool is_stopped = false;
    while (!open_.empty()) {
        const auto top = open_.pop();
        if (poll()) {
            is_stopped = true;
            break;
        }
        const Node node = nodes_[index(top.node)];
        if (node.is_worse) {
            continue;
        }
        const Tick to_go = least_to_go(trip, node.stage, node.vertex);
        if (node.g + weight_ * to_go >= upper_) {
            break;
        }
        const PricesOfPlace& here = prices.at(node.vertex);
        if (trip.stage_vertex[index(node.stage)] == node.vertex) {
            if (node.stage >= first_at_end) {
                const Tick cost =
                    node.g + weight_ * later_[index(node.stage)] + here.of(node.enter, never);
                if (cost < upper_) {
                    upper_ = cost;
                    best = top.node;
                    best_completion = node.enter + later_[index(node.stage)];
                }
            }
            if (node.stage + 1 < n_stages) {
                const auto at = index(node.stage);
                const Tick dwell = trip.stage_work[at] + trip.stage_turn[at];
                const Tick g = node.g + weight_ * dwell + here.of(node.enter, node.enter + dwell);
                push({node.enter + dwell, g, node.vertex, -1, node.stage + 1, top.node},
                     least_to_go(trip, node.stage + 1, node.vertex), here);
            }
        }
        const Graph& graph = problem_.graph();
        for (EdgeId e = graph.indptr[index(node.vertex)]; e < graph.indptr[index(node.vertex + 1)];
             ++e) {
            drive(trip, prices, top.node, e);
        }
    }
    for (const std::size_t place : touched_) {
        first_[place] = none;
    }
    touched_.clear();
    if (is_stopped) {
        return false;
    }
    if (best == none) {
        return true;
    }
    track.visits.clear();
    track.cost = problem_.weight(robot) * best_completion;
    for (std::int32_t k = best; k != none; k = nodes_[index(k)].parent) {
        const Node& node = nodes_[index(k)];
        if (node.edge >= 0 || node.parent == none) {  // else it has served a stage there
            track.visits.push_back({node.enter, node.vertex, node.edge});
            track.cost +=
                node.edge < 0 ? 0 : problem_.weight(robot) * problem_.surcharge(node.edge);
        }
    }
    std::reverse(track.visits.begin(), track.visits.end());
    return true;
}

void PricedSearch::push(const Node& node, Tick h, const PricesOfPlace& prices) {
    if (h >= never || node.g + weight_ * h >= upper_) {
        return;
    }
    const std::size_t place = index(node.stage) * index(problem_.n_vertices()) + index(node.vertex);
    // A robot that is there earlier may wait: it is as good if it has paid no more beside that.
    const Tick apart = node.g - weight_ * node.enter - prices.before(node.enter);
    std::int32_t* link = &first_[place];
    while (*link != none) {
        Node& other = nodes_[index(*link)];
        if (other.enter <= node.enter && other.apart <= apart) {
            return;
        }
        if (other.enter >= node.enter && other.apart >= apart) {
            other.is_worse = true;
            *link = other.next;
            continue;
        }
        link = &other.next;
    }
    const auto id = static_cast<std::int32_t>(nodes_.size());
    const bool is_first = first_[place] == none;
    nodes_.push_back(node);
    nodes_.back().apart = apart;
    if (is_first) {
        touched_.push_back(place);
    }
    nodes_.back().next = first_[place];
    first_[place] = id;
    open_.push(OpenList::key(node.g + weight_ * h - origin_, weight_ * h / parts_per_tick), id);
}

// Pushes the arrivals at the end of an edge.
void PricedSearch::drive(const Trip& trip, const Prices& prices, std::int32_t from, EdgeId edge) {
    const Node node = nodes_[index(from)];
    const Tick drive = problem_.drive(robot_, edge);
    if (drive < 0) {
        return;
    }
    const VertexId head = problem_.graph().indices[index(edge)];
    const Tick h = least_to_go(trip, node.stage, head);
    if (h >= never) {
        return;
    }
    const PricesOfPlace& here = prices.at(node.vertex);
    const PricesOfPlace& there = prices.at(head);
    const Tick surcharge = problem_.surcharge(edge) * weight_;
    const Tick approach = problem_.approach(drive);
    const auto arrive = [&](Tick leave) {
        const Tick enter = leave + drive;
        Tick g = node.g + weight_ * (enter - node.enter) + surcharge + here.of(node.enter, enter) +
                 there.of(enter - approach, enter);
        if (prices.has_lanes()) {
            g += prices.along(edge).of(enter, enter + 1);
        }
        push({enter, g, head, edge, node.stage, from}, h, there);
    };
    const auto is_too_late = [&](Tick leave) {
        return node.g + weight_ * (leave + drive - node.enter + h) + surcharge >= upper_;
    };
    arrive(node.enter);
    const Tick lead = drive - approach;  // from leaving here to booking there
    for (std::size_t k = there.from(node.enter + lead); k < there.entries().size(); ++k) {
        const Tick leave = there.entries()[k].tick + 1 - lead;
        if (is_too_late(leave)) {
            break;
        }
        if (there.entries()[k].price > 0) {
            arrive(leave);
        }
    }
    if (!prices.has_lanes()) {
        return;
    }
    const PricesOfPlace& lane = prices.along(edge);
    for (std::size_t k = lane.from(node.enter + drive); k < lane.entries().size(); ++k) {
        const Tick leave = lane.entries()[k].tick + 1 - drive;
        if (is_too_late(leave)) {
            break;
        }
        if (lane.entries()[k].price > 0) {
            arrive(leave);
        }
    }
}

}  // namespace rightofway
