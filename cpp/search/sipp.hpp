// Safe interval path planning (SIPP): the best track of one robot among bookings of other robots.
//
// A state is (vertex, gap, stage); for a robot that turns in some time, the edge driven in, which
// gives the heading, stands for the vertex. In one gap an earlier enter is never worse than a later
// one, because the robot can wait. The itinerary is a list of stages (stops, work, turns, way
// home); a move of the search drives, waits or serves the next stage.
//
// With prices, a track may overlap the bookings of another robot and pays the price of that robot.
// The search minimizes completion time plus prices. Example: with prices far above any time, it
// finds the track with the fewest conflicts.
//
// If another robot books the last vertex late, no track is complete before that booking ends or is
// paid for, and A* would expand every state up to that tick. So the search *aims* first: tracks
// that are complete at exactly that tick are equally good, and a greedy search, nearest to the end
// first, looks for one of them within a limited number of states.
//
// Where robots have sizes, a drive also needs its edge to be free of bookings: within one gap of
// the head, the earliest drive that does is the best.
//
// Closures are bookings of nobody: they have no price and swap with no robot. Surcharges of edges
// count as costs, as prices do.
//
// One object serves many searches: nodes, heap and state table keep their memory; a generation
// stamp replaces clearing.
//
// Phillips & Likhachev, "SIPP: Safe interval path planning for dynamic environments", ICRA 2011.
// Li et al., "MAPF-LNS2: Fast repairing for multi-agent path finding via large neighborhood
// search", AAAI 2022 (soft intervals).
// Doran & Michie, "Experiments with the graph traverser program", Proceedings of the Royal Society
// A 294, 1966 (greedy search).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/open_list.hpp"
#include "core/search_end.hpp"
#include "core/types.hpp"
#include "distances/trip.hpp"
#include "search/booking_table.hpp"

namespace rightofway {

// The input of one search.
struct SearchRequest {
    const Trip& trip;
    const BookingTable& bookings;
    std::span<const Tick> prices = {};  // per robot: of one overlap; empty: no overlaps
    Tick limit = never;                 // greatest cost of a track [ticks]
    // Above 0: a faster search for a good, not the best, track. The remaining ticks weigh greed / 8
    // more, and each state keeps only its node of least time plus prices.
    Tick greed = 0;
};

class SafeIntervalSearch {
  public:
    // Borrows the roads.
    SafeIntervalSearch(const Roads& roads, const BookingRules& rules);

    // Calls `is_over` every few hundred states.
    SearchEnd run(const SearchRequest& request, const StopCondition& is_over);

    // The track of the last search; empty if the search found none.
    void track(std::vector<Visit>& visits) const;
    Tick completion() const { return nodes_[index(goal_)].ready; }
    Tick cost() const { return completion() + nodes_[index(goal_)].cost; }

    // The number of states expanded by all searches: effort, independent of the clock.
    std::int64_t n_expanded() const { return n_expanded_; }

  private:
    struct Node {
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
    struct Slot {
        std::uint64_t state;
        Tick least;  // least time plus prices of a node of this state
        std::uint32_t generation;
        std::int32_t node;  // head of the list of this state
    };
    static constexpr Slot unused{0, 0, 0, -1};

    SearchEnd search(std::int64_t most_states, const StopCondition& is_over);
    void begin(const SearchRequest& request);
    void measure_stages(const Trip& trip);
    Tick least_end() const;
    Tick free_end(std::span<const BookedBy> before) const;
    bool is_worth_aiming() const;
    SearchEnd aim(const StopCondition& is_over);
    Tick rest(const Node& node) const;
    Tick rest(VertexId vertex, std::int32_t stage) const;
    void expand(std::int32_t node);
    void finish(std::int32_t node);
    void serve(std::int32_t node);
    void stay_on(std::int32_t node);
    void drive(std::int32_t node, EdgeId edge);
    void drive_between(Node candidate, Tick way, Tick latest, Tick approach,
                       std::span<const BookedBy> along);
    void drive_across(const Node& soonest, Tick way, Tick latest, Tick approach,
                      std::span<const BookedBy> along);
    Tick free_drive(std::span<const BookedBy> along, Tick tick, Tick drive) const;
    Tick price_of_drive(std::span<const BookedBy> along, Tick tick, Tick drive) const;
    Tick price_of_entry(const Node& candidate, Tick approach) const;
    Tick price_of_swaps(const Node& candidate) const;
    Tick price(RobotId robot) const;
    void reach(const Node& candidate, Tick way);
    bool is_known(const Node& candidate, std::int32_t first);
    void next_generation();
    Slot& slot_of(const Node& node);
    void enlarge_slots();
    // The bookings of a vertex, or of edge `n_vertices + edge`, as the robot's size class sees
    // them.
    std::span<const BookedBy> at(std::int32_t resource) const {
        return bookings_->at(trip_->first_row + resource);
    }
    std::int32_t n_stages() const { return static_cast<std::int32_t>(trip_->n_stages()); }

    Roads roads_;
    BookingRules rules_;
    const Trip* trip_ = nullptr;
    const BookingTable* bookings_ = nullptr;
    bool books_edges_ = false;  // drives book edges
    std::span<const Tick> prices_;
    Tick limit_ = never;
    std::vector<Tick> to_go_;      // least ticks from each stage's vertex to completion
    std::int32_t first_last_ = 0;  // first of the final stages at the last vertex
    std::vector<Node> nodes_;
    OpenList open_;
    std::vector<Slot> slots_;    // open addressing
    std::size_t mask_ = 0;       // slots 0 .. mask_ are in use; each search starts with few
    Tick least_drive_ = 1;       // least ticks of any edge
    Tick least_f_ = 0;           // bound from the bookings of the last vertex
    bool is_aiming_ = false;     // looks for a track with f = least_f_
    bool has_one_label_ = true;  // one node per state, no Pareto set of (time, cost)
    Tick first_f_ = 0;
    Tick greed_ = 0;
    std::uint32_t generation_ = 0;
    std::int32_t goal_ = -1;
    std::int64_t n_expanded_ = 0;
};

}  // namespace rightofway
