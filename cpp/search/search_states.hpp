// The states that a search has reached: its nodes, and the least of them of each state.
//
// A state is (vertex, gap, stage); for a robot that turns in some time, the edge driven in, which
// gives the heading, stands for the vertex. In one gap an earlier enter is never worse than a later
// one, because the robot can wait: one node for each state, unless the search pays prices. Then a
// later node may be cheaper, and a state has a list of nodes of which none dominates another one.
//
// One object serves many searches: nodes and table keep their memory; a generation stamp replaces
// clearing.
#pragma once

#include <cstdint>
#include <vector>

#include "core/types.hpp"

namespace rightofway {

struct SearchNode {
    Tick ready;  // earliest start of the next drive
    Tick cost;   // prices paid, and surcharges of edges
    VertexId vertex;
    std::int32_t gap;  // number of bookings of the vertex that are over or paid for
    std::int32_t stage;
    std::int32_t parent;
    std::int32_t next;   // next node of this state
    std::int32_t drive;  // ticks of the drive in; 0: a wait or a served stage
    bool is_beaten;
    EdgeId edge = -1;  // latest edge driven, -1 before the first drive
};

class SearchStates {
  public:
    SearchStates();

    // Begins a search. A state has one of `n_places` vertices, or edges if the robot turns.
    void clear(std::size_t n_places, bool robot_turns, bool has_one_label);

    // Adds a node unless a node of its state is as early and as cheap; returns its id, or `none`.
    std::int32_t add(const SearchNode& candidate);

    SearchNode& operator[](std::int32_t node) { return nodes_[index(node)]; }
    const SearchNode& operator[](std::int32_t node) const { return nodes_[index(node)]; }

  private:
    struct Slot {
        std::uint64_t state;
        Tick least;  // least time plus prices of a node of this state
        std::uint32_t generation;
        std::int32_t node;  // head of the list of this state
    };
    static constexpr Slot unused{0, 0, 0, none};

    bool is_dominated(const SearchNode& candidate, std::int32_t first);
    void next_generation();
    Slot& slot_of(const SearchNode& node);
    void enlarge_slots();

    std::vector<SearchNode> nodes_;
    std::vector<Slot> slots_;  // open addressing
    std::size_t mask_;         // slots 0 .. mask_ are in use; each search starts with few
    std::size_t n_places_ = 0;
    bool robot_turns_ = false;
    bool has_one_label_ = true;
    std::uint32_t generation_ = 0;
};

}  // namespace rightofway
