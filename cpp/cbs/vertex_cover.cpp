#include "cbs/vertex_cover.hpp"

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

namespace rightofway {
namespace {

constexpr std::int64_t most_steps = 20'000;

// The least cover of one component, by branch and bound: nodes in order of falling weight, the
// number of each at most the largest weight that is not covered yet.
class Component {
  public:
    Component(std::vector<std::vector<Tick>> weight) : weight_(std::move(weight)) {}

    Tick least() {
        const std::size_t n = weight_.size();
        Tick packed = 0;
        std::vector<bool> is_used(n, false);
        std::vector<WeightedPair> pairs;
        for (std::size_t i = 0; i < n; ++i) {
            best_ += *std::max_element(weight_[i].begin(), weight_[i].end());
            for (std::size_t j = 0; j < i; ++j) {
                pairs.push_back({i, j, weight_[i][j]});
            }
        }
        // Disjoint pairs: each takes its weight. A lower bound where the search is cut off.
        std::stable_sort(pairs.begin(), pairs.end(), [](const auto& left, const auto& right) {
            return left.weight > right.weight;
        });
        for (const WeightedPair& pair : pairs) {
            if (!is_used[pair.first] && !is_used[pair.second]) {
                is_used[pair.first] = is_used[pair.second] = true;
                packed += pair.weight;
            }
        }
        number_.assign(n, 0);
        choose(0, 0, packed);
        return n_steps_ > most_steps ? packed : best_;
    }

  private:
    void choose(std::size_t node, Tick sum, Tick packed) {
        if (sum >= best_ || best_ == packed || ++n_steps_ > most_steps) {
            return;
        }
        if (node == weight_.size()) {
            best_ = sum;
            return;
        }
        Tick least = 0;
        for (std::size_t other = 0; other < node; ++other) {
            least = std::max(least, weight_[node][other] - number_[other]);
        }
        // Beyond what it needs, a number helps only where it saves an edge to a later node. Weights
        // are times and may be huge, so the numbers are counted, not listed.
        Tick most = least;
        for (std::size_t other = node + 1; other < weight_.size(); ++other) {
            most = std::max(most, weight_[node][other]);
        }
        for (Tick number = least; number <= most && sum + number < best_; ++number) {
            if (best_ == packed || n_steps_ > most_steps) {
                return;
            }
            number_[node] = number;
            choose(node + 1, sum + number, packed);
        }
    }

    std::vector<std::vector<Tick>> weight_;
    std::vector<Tick> number_;
    Tick best_ = 1;
    std::int64_t n_steps_ = 0;
};

std::size_t root(std::vector<std::size_t>& parent, std::size_t node) {
    while (parent[node] != node) {
        node = parent[node] = parent[parent[node]];
    }
    return node;
}

constexpr std::size_t most_nodes = 12;

}  // namespace

// Components grow along the heaviest edges first; an edge that would make one too large is left
// out, which only lowers the bound.
Tick cover(std::size_t n_nodes, std::vector<WeightedPair> pairs) {
    std::vector<std::size_t> parent(n_nodes);
    std::vector<std::size_t> size(n_nodes, 1);
    std::iota(parent.begin(), parent.end(), std::size_t{0});
    std::stable_sort(pairs.begin(), pairs.end(), [](const auto& left, const auto& right) {
        return left.weight > right.weight;
    });
    for (const WeightedPair& pair : pairs) {
        const std::size_t a = root(parent, pair.first);
        const std::size_t b = root(parent, pair.second);
        if (a != b && size[a] + size[b] <= most_nodes) {
            parent[b] = a;
            size[a] += size[b];
        }
    }
    std::vector<std::vector<std::size_t>> members(n_nodes);
    std::vector<std::size_t> place(n_nodes);
    std::vector<Tick> total(n_nodes, 0);
    for (const WeightedPair& pair : pairs) {
        total[pair.first] += pair.weight;
        total[pair.second] += pair.weight;
    }
    for (std::size_t node = 0; node < n_nodes; ++node) {
        members[root(parent, node)].push_back(node);
    }
    Tick sum = 0;
    for (auto& nodes : members) {
        if (nodes.size() < 2) {
            continue;
        }
        std::stable_sort(nodes.begin(), nodes.end(), [&](std::size_t left, std::size_t right) {
            return total[left] > total[right];
        });
        for (std::size_t k = 0; k < nodes.size(); ++k) {
            place[nodes[k]] = k;
        }
        std::vector<std::vector<Tick>> weight(nodes.size(), std::vector<Tick>(nodes.size(), 0));
        for (const WeightedPair& pair : pairs) {
            if (root(parent, pair.first) == root(parent, nodes.front()) &&
                root(parent, pair.second) == root(parent, nodes.front())) {
                weight[place[pair.first]][place[pair.second]] = pair.weight;
                weight[place[pair.second]][place[pair.first]] = pair.weight;
            }
        }
        sum += Component(std::move(weight)).least();
    }
    return sum;
}

}  // namespace rightofway
