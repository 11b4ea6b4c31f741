#include "cyclic/seen_states.hpp"

namespace rightofway {

// FNV-1a on whole numbers instead of bytes, mixed after each number.
std::size_t SeenStates::Hash::operator()(const State& state) const {
    std::uint64_t hash = 0xcbf29ce484222325U;
    for (const std::int32_t number : state) {
        hash = (hash ^ static_cast<std::uint32_t>(number)) * 0x100000001b3U;
        hash ^= hash >> 29;
    }
    return hash;
}

std::optional<Tick> SeenStates::find_or_add(const State& state, Tick tick) {
    const std::int64_t number = n_asked_++;
    if (const auto found = seen_.find(state); found != seen_.end()) {
        return found->second.tick;
    }
    if (number % stride_ != 0) {
        return std::nullopt;
    }
    while (n_numbers_ + state.size() > most_ && seen_.size() > 1) {
        stride_ *= 2;
        drop_if([this](const Seen& seen) { return seen.number % stride_ != 0; });
    }
    seen_.emplace(state, Seen{number, tick});
    n_numbers_ += state.size();
    return std::nullopt;
}

void SeenStates::forget_after(Tick tick) {
    drop_if([tick](const Seen& seen) { return seen.tick > tick; });
}

template <class Drop>
void SeenStates::drop_if(Drop&& drop) {
    std::erase_if(seen_, [&](const auto& entry) {
        const bool drops = drop(entry.second);
        n_numbers_ -= drops ? entry.first.size() : 0;
        return drops;
    });
}

}  // namespace rightofway
