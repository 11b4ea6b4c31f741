// Timed event graphs: events that repeat, and the cycle time of a fleet.
//
// F. Baccelli, G. Cohen, G. J. Olsder and J.-P. Quadrat, Synchronization and Linearity, 1992.
//
// A node is an event of one period. An arc from u to v with a length and a height (its tokens) says
// that v takes place, `height` periods later, no earlier than `length` ticks after u. If events
// wait for nothing else, each repeats on average after the *cycle time*: the largest ratio of
// length to height over all circuits. A circuit with that ratio is *critical*: the bottleneck.
//
// The circuit is found by policy iteration: each node follows its best arc. A circuit of such arcs
// with a larger ratio than the best known one replaces it, and the values of all nodes are computed
// again. Ratios are fractions of integers, and values are whole multiples of 1 / denominator, so
// the answer is exact. A node changes its arc only for a strictly better one, so no circuit of
// length and height zero (a rotation of robots) is ever followed.
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
    std::span<const std::int32_t> height;  // may be negative; no circuit's is below 0
};

// Throws std::invalid_argument, naming the array, the index and the value; or if ratios of these
// arcs may not fit exact arithmetic.
void require_event_arcs(const TimedEventGraph& arcs);

struct CriticalCircuit {
    Tick length = 0;
    std::int64_t height = 1;         // 0 if its events wait for each other for ever
    std::vector<std::int32_t> arcs;  // in order; empty if every circuit has length 0
};

// Nothing if `is_over` said so. If a circuit of positive length has height 0 or less, the events
// can never take place: the answer is that circuit, with height 0.
std::optional<CriticalCircuit> critical_circuit(const TimedEventGraph& arcs,
                                                const StopCondition& is_over);

// The least times, none below 0, that keep all arcs when everything comes again every
// `period` / `parts` ticks; in parts of a tick. Nothing if that is less than the cycle time, or
// if `is_over` said so.
std::optional<std::vector<Tick>> earliest_times(const TimedEventGraph& arcs, Tick period,
                                                std::int64_t parts, const StopCondition& is_over);

}  // namespace rightofway
