// Timed event graphs: events that repeat, and their cycle time, the largest mean of a circuit.
//
// F. Baccelli, G. Cohen, G. J. Olsder and J.-P. Quadrat, Synchronization and Linearity, 1992.
//
// A node is an event of one period. An arc from u to v with a length and a height (its tokens)
// says: v takes place, `height` periods later, at least `length` ticks after u. If events wait for
// nothing else, each event repeats on average once per *cycle time*: the largest ratio of length to
// height over all circuits. A circuit with this ratio is *critical*: the bottleneck.
//
// Policy iteration finds the circuit: each node follows its best arc. A circuit of followed arcs
// with a larger ratio replaces the best known circuit, and the values of all nodes are recomputed.
// Ratios are fractions of integers, and values are whole multiples of 1 / denominator, so the
// answer is exact. A node changes its arc only for a strictly better arc, so no circuit of length
// and height zero (a rotation of robots) is ever followed.
//
// Cochet-Terrasson, Cohen, Gaubert, Mc Gettrick & Quadrat, "Numerical computation of spectral
// elements in max-plus algebra", IFAC Conference on System Structure and Control, 1998.
// Dasdan, "Experimental analysis of the fastest optimum cycle ratio and mean algorithms", ACM
// TODAES 9, 2004.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/search_end.hpp"
#include "core/types.hpp"

namespace rightofway {

// Borrowed; m arcs.
struct TimedEventGraph {
    std::int32_t n_nodes = 0;
    std::span<const std::int32_t> tail;
    std::span<const std::int32_t> head;
    std::span<const Tick> length;          // not negative
    std::span<const std::int32_t> height;  // may be < 0; sum over a circuit: >= 0
};

// Throws std::invalid_argument, naming the array, the index and the value; also if ratios of these
// arcs may exceed exact arithmetic.
void require_event_arcs(const TimedEventGraph& arcs);

struct CriticalCircuit {
    Tick length = 0;
    std::int64_t height = 1;         // 0: deadlock of its events
    std::vector<std::int32_t> arcs;  // in order; empty if every circuit has length 0
};

// No value if `is_over` stopped the search. If a circuit of positive length has height <= 0, its
// events can never take place: the result is this circuit, with height 0.
std::optional<CriticalCircuit> critical_circuit(const TimedEventGraph& arcs,
                                                const StopCondition& is_over);

// The least times >= 0 that keep all arcs when events repeat every `period` / `parts` ticks; in
// units of 1 / `parts` tick. No value if the period is below the cycle time, or if `is_over`
// stopped the search.
std::optional<std::vector<Tick>> earliest_times(const TimedEventGraph& arcs, Tick period,
                                                std::int64_t parts, const StopCondition& is_over);

}  // namespace rightofway
