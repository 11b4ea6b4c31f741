#include "precedence/timed_event_graph.hpp"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>

#include "core/reject.hpp"

namespace rightofway {
namespace {

constexpr Tick most_product = Tick{1} << 58;
constexpr std::int32_t most_nodes = 1 << 26;  // that many take 2 GB

// Outgoing arcs, node by node: a sweep reads memory in order.
class Rows {
  public:
    struct Arc {
        std::int32_t number;
        std::int32_t end;
        std::int32_t height;
        Tick length;
    };

    Rows(const TimedEventGraph& arcs, std::span<const std::int32_t> from,
         std::span<const std::int32_t> to)
        : first_(static_cast<std::size_t>(arcs.n_nodes) + 1, 0), arcs_(from.size()) {
        for (const std::int32_t node : from) {
            ++first_[index(node) + 1];
        }
        std::partial_sum(first_.begin(), first_.end(), first_.begin());
        std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
        for (std::size_t k = 0; k < from.size(); ++k) {
            arcs_[next[index(from[k])]++] = {static_cast<std::int32_t>(k), to[k], arcs.height[k],
                                             arcs.length[k]};
        }
    }

    std::span<const Arc> of(std::int32_t node) const {
        const auto k = index(node);
        return {arcs_.data() + first_[k], first_[k + 1] - first_[k]};
    }

  private:
    std::vector<std::size_t> first_;
    std::vector<Arc> arcs_;
};

class PolicyIteration {
  public:
    explicit PolicyIteration(const TimedEventGraph& arcs)
        : arcs_(arcs),
          leaving_(arcs, arcs.tail, arcs.head),
          entering_(arcs, arcs.head, arcs.tail),
          value_(static_cast<std::size_t>(arcs.n_nodes), 0),
          follows_(value_.size(), none),
          seen_(value_.size(), 0) {}

    std::optional<CriticalCircuit> run(const StopCondition& is_over) {
        while (improve()) {
            if (is_over()) {
                return std::nullopt;
            }
            if (find_longer_circuit()) {
                if (best_.height <= 0) {
                    return best_;
                }
                direct_to_circuit();
            } else {
                value_policy();
            }
        }
        return best_;
    }

  private:
    // The value of an arc if the period is the ratio of the best circuit.
    Tick worth(Tick length, std::int32_t height) const {
        return length * best_.height - best_.length * height;
    }
    Tick worth_of(std::int32_t arc) const {
        return worth(arcs_.length[index(arc)], arcs_.height[index(arc)]);
    }

    // Switches every node to a better arc, if any. From the last node to the first: a robot's
    // visits are numbered along its route, so one sweep propagates a change far.
    bool improve() {
        bool is_changed = false;
        for (std::int32_t node = arcs_.n_nodes; node-- > 0;) {
            Tick& own = value_[index(node)];
            for (const Rows::Arc& arc : leaving_.of(node)) {
                const Tick value = value_[index(arc.end)] + worth(arc.length, arc.height);
                if (value > own) {
                    own = value;
                    follows_[index(node)] = arc.number;
                    is_changed = true;
                }
            }
        }
        return is_changed;
    }

    std::int32_t after(std::int32_t node) const {
        const std::int32_t arc = follows_[index(node)];
        return arc == none ? none : arcs_.head[index(arc)];
    }

    // Walks along the policy from every node; a node reached twice in one walk is on a circuit.
    bool find_longer_circuit() {
        std::fill(seen_.begin(), seen_.end(), 0);
        bool is_found = false;
        std::int32_t walk = 0;
        for (std::int32_t start = 0; start < arcs_.n_nodes; ++start) {
            ++walk;
            std::int32_t node = start;
            while (node != none && seen_[index(node)] == 0) {
                seen_[index(node)] = walk;
                node = after(node);
            }
            if (node != none && seen_[index(node)] == walk) {
                is_found |= take_if_longer(node);
                if (best_.height <= 0) {
                    return true;
                }
            }
        }
        return is_found;
    }

    bool take_if_longer(std::int32_t start) {
        CriticalCircuit circuit{0, 0, {}};
        std::int32_t node = start;
        do {
            const std::int32_t arc = follows_[index(node)];
            circuit.arcs.push_back(arc);
            circuit.length += arcs_.length[index(arc)];
            circuit.height += arcs_.height[index(arc)];
            node = after(node);
        } while (node != start);
        if (circuit.height <= 0) {
            best_ = {circuit.length, 0, std::move(circuit.arcs)};
            return true;
        }
        const Tick divisor = std::gcd(circuit.length, circuit.height);
        const Tick length = circuit.length / std::max<Tick>(divisor, 1);
        const std::int64_t height = circuit.height / std::max<Tick>(divisor, 1);
        if (length * best_.height <= best_.length * height) {
            return false;
        }
        best_ = {length, height, std::move(circuit.arcs)};
        return true;
    }

    // Directs every node with a path to the best circuit there: by the node's policy if the policy
    // leads to the circuit, else by the fewest arcs. The other nodes follow no arc.
    void direct_to_circuit() {
        std::fill(seen_.begin(), seen_.end(), 0);
        order_.assign(1, arcs_.head[index(best_.arcs.back())]);
        seen_[index(order_.front())] = 1;
        value_[index(order_.front())] = 0;
        extend_tree(true);
        extend_tree(false);
        for (std::size_t node = 0; node < seen_.size(); ++node) {
            if (seen_[node] == 0) {
                follows_[node] = none;
                value_[node] = 0;
            }
        }
    }

    // Breadth-first from the circuit: along the policy only, or along all arcs.
    void extend_tree(bool by_policy) {
        for (std::size_t k = 0; k < order_.size(); ++k) {
            const std::int32_t node = order_[k];
            for (const Rows::Arc& arc : entering_.of(node)) {
                const auto tail = index(arc.end);
                if (seen_[tail] == 0 && (!by_policy || follows_[tail] == arc.number)) {
                    seen_[tail] = 1;
                    follows_[tail] = arc.number;
                    value_[tail] = value_[index(node)] + worth(arc.length, arc.height);
                    order_.push_back(arc.end);
                }
            }
        }
    }

    // Computes the values of the policy, from followed nodes to following nodes.
    void value_policy() {
        std::fill(seen_.begin(), seen_.end(), 0);
        for (const std::int32_t arc : best_.arcs) {
            settle(arcs_.tail[index(arc)]);
        }
        for (std::int32_t node = 0; node < arcs_.n_nodes; ++node) {
            order_.clear();
            std::int32_t next = node;
            while (next != none && seen_[index(next)] == 0) {
                order_.push_back(next);
                settle(next);
                next = after(next);
            }
            for (std::size_t k = order_.size(); k-- > 0;) {
                const auto one = index(order_[k]);
                if (follows_[one] != none) {
                    value_[one] = value_[index(after(order_[k]))] + worth_of(follows_[one]);
                }
            }
        }
    }

    void settle(std::int32_t node) { seen_[index(node)] = 1; }

    const TimedEventGraph& arcs_;
    Rows leaving_;
    Rows entering_;
    CriticalCircuit best_;
    std::vector<Tick> value_;            // of each node, in parts of a tick: 1 / best_.height
    std::vector<std::int32_t> follows_;  // of each node: the arc of its policy
    std::vector<std::int32_t> seen_;
    std::vector<std::int32_t> order_;
};

// The sums of the absolute lengths and heights, each at least 1.
struct Sums {
    Tick lengths = 1;
    std::int64_t heights = 1;
};

Sums sums_of(const TimedEventGraph& arcs) {
    Sums sums;
    for (std::size_t k = 0; k < arcs.length.size(); ++k) {
        if (arcs.length[k] > most_product - sums.lengths) {
            reject_entry("length", k, arcs.length[k], "makes the sum too large");
        }
        sums.lengths += arcs.length[k];
        sums.heights += std::abs(std::int64_t{arcs.height[k]});
    }
    return sums;
}

// The value of any path has to stay far below the limit of its type.
void require_small(const std::string& name, Tick factor, Tick sum) {
    if (factor < 0) {
        reject(name, factor, "is negative");
    }
    if (factor > most_product / sum) {
        reject(name, factor, "times " + std::to_string(sum) + " is too large");
    }
}

}  // namespace

void require_event_arcs(const TimedEventGraph& arcs) {
    require_range("n_nodes", arcs.n_nodes, 0, most_nodes);
    if (arcs.tail.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
        throw std::invalid_argument("tail: more arcs than int32 can number");
    }
    require_length("head", arcs.head.size(), arcs.tail.size());
    require_length("length", arcs.length.size(), arcs.tail.size());
    require_length("height", arcs.height.size(), arcs.tail.size());
    require_ids("tail", arcs.tail, arcs.n_nodes);
    require_ids("head", arcs.head, arcs.n_nodes);
    for (std::size_t k = 0; k < arcs.length.size(); ++k) {
        if (arcs.length[k] < 0) {
            reject_entry("length", k, arcs.length[k], "is negative");
        }
    }
    const Sums sums = sums_of(arcs);
    require_small("length", sums.lengths, sums.heights);
}

std::optional<CriticalCircuit> critical_circuit(const TimedEventGraph& arcs,
                                                const StopCondition& is_over) {
    return PolicyIteration(arcs).run(is_over);
}

std::optional<std::vector<Tick>> earliest_times(const TimedEventGraph& arcs, Tick period,
                                                std::int64_t parts, const StopCondition& is_over) {
    const Sums sums = sums_of(arcs);
    require_small("period", period, sums.heights);
    if (parts < 1) {
        reject("parts", parts, "is not above 0");
    }
    require_small("parts", parts, sums.lengths);
    // No path without a circuit is longer: 2^59 at most.
    const Tick longest = sums.lengths * parts + period * sums.heights;
    const Rows leaving(arcs, arcs.tail, arcs.head);
    std::vector<Tick> time(static_cast<std::size_t>(arcs.n_nodes), 0);
    std::vector<std::uint8_t> is_later(time.size(), 1);
    // Bellman-Ford: without a circuit above the period, n_nodes sweeps settle all values.
    for (std::int32_t sweep = 0; sweep <= arcs.n_nodes; ++sweep) {
        bool is_changed = false;
        for (std::size_t node = 0; node < time.size(); ++node) {
            if (is_later[node] == 0) {
                continue;
            }
            is_later[node] = 0;
            for (const Rows::Arc& arc : leaving.of(static_cast<std::int32_t>(node))) {
                const auto end = index(arc.end);
                const Tick earliest = time[node] + arc.length * parts - period * arc.height;
                if (earliest > longest) {
                    return std::nullopt;  // a circuit above the period
                }
                if (time[end] < earliest) {
                    time[end] = earliest;
                    is_later[end] = 1;
                    is_changed = true;
                }
            }
        }
        if (!is_changed) {
            return time;
        }
        if (is_over()) {
            return std::nullopt;
        }
    }
    return std::nullopt;
}

}  // namespace rightofway
