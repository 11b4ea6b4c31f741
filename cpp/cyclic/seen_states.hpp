// The states seen so far, to find the tick at which an equal one was seen.
//
// A hash finds candidates, a full comparison decides. Memory is bounded: when it is full, every
// second state is dropped, then every second of the rest, and so on. States recur in sequence, so a
// kept state recurs soon after a dropped one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/types.hpp"

namespace rightofway {

class SeenStates {
  public:
    // Keeps at most `most` numbers, but always one state.
    explicit SeenStates(std::size_t most = std::size_t{1} << 24) : most_(most) {}

    // The tick of an equal state seen before; otherwise this one is added.
    std::optional<Tick> find_or_add(std::span<const std::int32_t> state, Tick tick);

    // Forgets those seen later than a tick, or all.
    void forget_after(Tick tick);
    void clear() { forget_after(-1); }

    std::size_t n_states() const { return states_.size(); }

  private:
    struct State {
        std::uint64_t hash;
        std::size_t begin;
        std::size_t end;
        std::int64_t index;
        Tick tick;
    };

    template <class Keep>
    void thin_out(Keep&& keep);

    std::size_t most_;
    std::vector<std::int32_t> numbers_;
    std::vector<State> states_;
    std::unordered_multimap<std::uint64_t, std::size_t> by_hash_;  // of states_
    std::int64_t n_asked_ = 0;
    std::int64_t stride_ = 1;
};

}  // namespace rightofway
