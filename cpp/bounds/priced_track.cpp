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

void PricesOfPlace::add_up() {
    ticks_.clear();
    sums_.assign(1, 0);
    for (const Entry& entry : entries_) {
        if (entry.price > 0) {
            ticks_.push_back(entry.tick);
            sums_.push_back(sums_.back() + entry.price);
        }
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

// Sums of the prices before ticks that get later, each found from the one before.
class Cursor {
  public:
    explicit Cursor(const PricesOfPlace& place) : ticks_(place.ticks()), sums_(place.sums()) {}

    Tick before(Tick tick) {
        if (k_ == 0) {
            k_ = index(std::lower_bound(ticks_.begin(), ticks_.end(), tick) - ticks_.begin());
        }
        while (k_ < ticks_.size() && ticks_[k_] < tick) {
            ++k_;
        }
        return sums_[k_];
    }

  private:
    const std::vector<Tick>& ticks_;
    const std::vector<Tick>& sums_;
    std::size_t k_ = 0;
};

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
    if (labels_.size() < trip.n_stages() * index(problem_.n_vertices())) {
        labels_.resize(trip.n_stages() * index(problem_.n_vertices()));
    }
    Poll poll(is_over);
    push({.enter = 0,
          .g = 0,
          .vertex = trip.home,
          .edge = -1,
          .stage = 0,
          .parent = none,
          .apart = -prices.at(trip.home).before(0)},
         least_to_go(trip, 0, trip.home));
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
                const Tick enter = node.enter + dwell;
                push({.enter = enter,
                      .g = node.apart + weight_ * enter + here.before(enter),
                      .vertex = node.vertex,
                      .edge = -1,
                      .stage = node.stage + 1,
                      .parent = top.node,
                      .apart = node.apart},
                     least_to_go(trip, node.stage + 1, node.vertex));
            }
        }
        const Graph& graph = problem_.graph();
        for (EdgeId e = graph.indptr[index(node.vertex)]; e < graph.indptr[index(node.vertex + 1)];
             ++e) {
            drive(trip, prices, top.node, e);
        }
    }
    for (const std::size_t place : touched_) {
        labels_[place].clear();
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

void PricedSearch::push(const Node& node, Tick h) {
    if (h >= never || node.g + weight_ * h >= upper_) {
        return;
    }
    const std::size_t place = index(node.stage) * index(problem_.n_vertices()) + index(node.vertex);
    // A robot that is there earlier may wait: it is as good if it has paid no more beside that.
    std::vector<Label>& labels = labels_[place];
    auto first =
        std::upper_bound(labels.begin(), labels.end(), node.enter,
                         [](Tick enter, const Label& label) { return enter < label.enter; });
    if (first != labels.begin()) {
        if (std::prev(first)->apart <= node.apart) {
            return;
        }
        first -= std::prev(first)->enter == node.enter ? 1 : 0;
    }
    if (labels.empty()) {
        touched_.push_back(place);
    }
    auto last = first;
    for (; last != labels.end() && last->apart >= node.apart; ++last) {
        nodes_[index(last->node)].is_worse = true;
    }
    const auto id = static_cast<std::int32_t>(nodes_.size());
    const Label label{node.enter, node.apart, id};
    if (first == last) {
        labels.insert(first, label);
    } else {
        *first = label;
        labels.erase(first + 1, last);
    }
    nodes_.push_back(node);
    open_.push(OpenList::key(node.g + weight_ * h - origin_, weight_ * h / parts_per_tick), id);
}

// Pushes the arrivals at the end of an edge. With `apart` of the node, what a later arrival has
// paid is a sum of three: the prices before it here, less those before its booking there, plus that
// of the lane. Cursors follow these sums as arrivals get later.
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
    const Tick fixed = node.apart + problem_.surcharge(edge) * weight_;
    const Tick approach = problem_.approach(drive);
    // Arrivals right after priced ticks of a place, each tick plus `delay`, from the first one on.
    const auto arrive = [&](const PricesOfPlace& avoided, Tick delay) {
        Cursor here(prices.at(node.vertex));
        Cursor there(prices.at(head));
        Cursor booked(prices.at(head));
        Tick least = never;
        Tick enter = node.enter + drive;
        for (std::size_t k = avoided.priced_from(enter - delay + 1);; ++k) {
            const Tick paid = fixed + here.before(enter);
            if (paid + weight_ * (enter + h) >= upper_) {
                return;  // later arrivals cost no less
            }
            Tick apart = paid - booked.before(enter - approach);
            if (prices.has_lanes()) {
                apart += prices.along(edge).of(enter, enter + 1);
            }
            if (apart < least) {
                least = apart;
                push({.enter = enter,
                      .g = apart + weight_ * enter + there.before(enter),
                      .vertex = head,
                      .edge = edge,
                      .stage = node.stage,
                      .parent = from,
                      .apart = apart},
                     h);
            }
            if (k >= avoided.ticks().size()) {
                return;
            }
            enter = avoided.ticks()[k] + delay;
        }
    };
    arrive(prices.at(head), 1 + approach);
    if (prices.has_lanes() && !prices.along(edge).ticks().empty()) {
        arrive(prices.along(edge), 1);
    }
}

}  // namespace rightofway
