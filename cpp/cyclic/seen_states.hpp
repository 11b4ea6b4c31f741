// States by what they hold: was there the same one before, and when?
//
// A hash finds, a full comparison decides. Memory is bounded: when it is full, every second state
// is dropped, then every second of those, and so on. A state that comes again is followed by the
// same ones as before, so one that was kept comes again soon after.
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
    // Keeps at most so many numbers (but always one state).
    explicit SeenStates(std::size_t most = std::size_t{1} << 24) : most_(most) {}

    // The tick of the same state, if it was seen before; otherwise this one is seen from now on.
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
