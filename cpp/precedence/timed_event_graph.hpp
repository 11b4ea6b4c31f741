// Work that repeats: events that come again every period, and what each has to wait for.
//
// A node is an event of one period. An arc from u to v of a length and a height says that v, so
// many periods later as the height, comes no earlier than the length after u. Whoever waits for
// nothing but that comes again, in the long run, every *cycle time*: the largest ratio of length to
// height of any circuit. A circuit that reaches it is *critical*: the bottleneck.
//
// The circuit is found by policy iteration: each node follows the arc that matters most to it. A
// circuit of such arcs that is longer than the cycle time known so far raises it; then all is
// valued anew. Ratios are fractions of integers, and values are whole numbers of their denominator,
// so the answer is exact. A node changes its arc for a strictly better one only; that is why no
// circuit of length and height zero (a rotation of robots) is ever walked into.
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
