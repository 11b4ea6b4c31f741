#include "search/search_states.hpp"

#include <algorithm>

namespace rightofway {
namespace {

constexpr std::size_t first_slots = 256;

std::uint64_t scatter(std::uint64_t key) {
    key *= 0x9E3779B97F4A7C15U;
    return key ^ (key >> 32);
}

}  // namespace

SearchStates::SearchStates() : slots_(first_slots, unused), mask_(first_slots - 1) {}

void SearchStates::clear(std::size_t n_places, bool robot_turns, bool has_one_label) {
    nodes_.clear();
    mask_ = first_slots - 1;
    n_places_ = n_places;
    robot_turns_ = robot_turns;
    has_one_label_ = has_one_label;
    next_generation();
}

std::int32_t SearchStates::add(const SearchNode& candidate) {
    Slot& slot = slot_of(candidate);
    const Tick sum = candidate.ready + candidate.cost;
    if (!has_one_label_) {
        if (is_dominated(candidate, slot.node)) {
            return none;
        }
    } else if (slot.node != none) {
        if (slot.least <= sum) {
            return none;
        }
        nodes_[index(slot.node)].is_beaten = true;
    }
    slot.least = sum;
    const auto node = static_cast<std::int32_t>(nodes_.size());
    nodes_.push_back(candidate);
    nodes_.back().next = slot.node;
    slot.node = node;
    return node;
}

// Whether a node of the same state dominates the candidate (ready and cost no greater); marks the
// nodes that the candidate dominates.
bool SearchStates::is_dominated(const SearchNode& candidate, std::int32_t first) {
    for (std::int32_t k = first; k != none; k = nodes_[index(k)].next) {
        SearchNode& known = nodes_[index(k)];
        if (known.ready <= candidate.ready && known.cost <= candidate.cost) {
            return true;
        }
        known.is_beaten |= candidate.ready <= known.ready && candidate.cost <= known.cost;
    }
    return false;
}

SearchStates::Slot& SearchStates::slot_of(const SearchNode& node) {
    if (2 * nodes_.size() > mask_) {
        enlarge_slots();
    }
    const auto place = static_cast<std::uint64_t>(node.stage) * n_places_ +
                       static_cast<std::uint64_t>(robot_turns_ ? node.edge + 1 : node.vertex);
    const auto gap = static_cast<std::uint64_t>(node.gap);
    const std::uint64_t state = (place << 24) ^ gap;
    // Neighbouring slots for the gaps of one vertex.
    std::size_t k = (scatter(place) * 4 + gap) & mask_;
    while (slots_[k].generation == generation_ && slots_[k].state != state) {
        k = (k + 1) & mask_;
    }
    if (slots_[k].generation != generation_) {
        slots_[k] = {state, 0, generation_, none};
    }
    return slots_[k];
}

void SearchStates::enlarge_slots() {
    mask_ = 4 * mask_ + 3;
    if (slots_.size() <= mask_) {
        slots_.resize(mask_ + 1, unused);
    }
    next_generation();
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
        Slot& slot = slot_of(nodes_[k]);
        nodes_[k].next = slot.node;
        slot.node = static_cast<std::int32_t>(k);
        slot.least = nodes_[k].ready + nodes_[k].cost;
    }
}

void SearchStates::next_generation() {
    if (++generation_ == 0) {
        std::fill(slots_.begin(), slots_.end(), unused);
        generation_ = 1;
    }
}

}  // namespace rightofway
