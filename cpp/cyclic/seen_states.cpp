#include "cyclic/seen_states.hpp"

#include <algorithm>

namespace rightofway {
namespace {

// FNV-1a by whole numbers, and a last mixing: all that matters is that few hashes are equal.
std::uint64_t hash_of(std::span<const std::int32_t> state) {
    std::uint64_t hash = 0xcbf29ce484222325U;
    for (const std::int32_t number : state) {
        hash = (hash ^ static_cast<std::uint32_t>(number)) * 0x100000001b3U;
        hash ^= hash >> 29;
    }
    return hash;
}

}  // namespace

std::optional<Tick> SeenStates::find_or_add(std::span<const std::int32_t> state, Tick tick) {
    const std::uint64_t hash = hash_of(state);
    const std::int64_t index = n_asked_++;
    const auto [first, last] = by_hash_.equal_range(hash);
    for (auto found = first; found != last; ++found) {
        const State& one = states_[found->second];
        if (std::equal(state.begin(), state.end(), numbers_.begin() + one.begin,
                       numbers_.begin() + one.end)) {
            return one.tick;
        }
    }
    if (index % stride_ != 0) {
        return std::nullopt;
    }
    while (numbers_.size() + state.size() > most_ && states_.size() > 1) {
        stride_ *= 2;  // also where the first state is the only one of its kind
        thin_out([this](const State& one) { return one.index % stride_ == 0; });
    }
    by_hash_.emplace(hash, states_.size());
    states_.push_back({hash, numbers_.size(), numbers_.size() + state.size(), index, tick});
    numbers_.insert(numbers_.end(), state.begin(), state.end());
    return std::nullopt;
}

void SeenStates::forget_after(Tick tick) {
    thin_out([tick](const State& one) { return one.tick <= tick; });
}

template <class Keep>
void SeenStates::thin_out(Keep&& keep) {
    std::size_t n_kept = 0;
    std::size_t end = 0;
    by_hash_.clear();
    for (State one : states_) {
        if (!keep(one)) {
            continue;
        }
        const std::size_t size = one.end - one.begin;
        std::copy(numbers_.begin() + one.begin, numbers_.begin() + one.end, numbers_.begin() + end);
        one.begin = end;
        one.end = end += size;
        by_hash_.emplace(one.hash, n_kept);
        states_[n_kept++] = one;
    }
    states_.resize(n_kept);
    numbers_.resize(end);
}

}  // namespace rightofway
