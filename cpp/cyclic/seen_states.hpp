// A table of the states seen so far, to find the tick of an earlier equal state.
//
// Memory is bounded: a full table drops every second state and keeps every 2nd, then 4th, 8th, ...
// new state. States recur in sequence, so a kept state recurs soon after a dropped state.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "core/types.hpp"

namespace rightofway {

class SeenStates {
  public:
    using State = std::vector<std::int32_t>;

    // Stores at most `most` numbers, but at least one state.
    explicit SeenStates(std::size_t most = std::size_t{1} << 24) : most_(most) {}

    // The tick of an earlier equal state; without one, adds the state unless thinned out.
    std::optional<Tick> find_or_add(const State& state, Tick tick);

    // Forgets the states seen later than a tick, or all states.
    void forget_after(Tick tick);
    void clear() { forget_after(-1); }

    std::size_t n_states() const { return seen_.size(); }

  private:
    struct Hash {
        std::size_t operator()(const State& state) const;
    };
    struct Seen {
        std::int64_t number;
        Tick tick;
    };

    template <class Drop>
    void drop_if(Drop&& drop);

    std::size_t most_;
    std::size_t n_numbers_ = 0;
    std::unordered_map<State, Seen, Hash> seen_;
    std::int64_t n_asked_ = 0;
    std::int64_t stride_ = 1;
};

}  // namespace rightofway
