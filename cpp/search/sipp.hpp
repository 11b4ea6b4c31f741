// The best track of one robot among the bookings of the others (safe interval path planning).
//
// A state is (vertex, gap, stage): in one gap between the bookings of one vertex, being there
// earlier is never worse than later, for whoever is early can wait. What the robot has to do
// (stops, work, turning, the way home) is a list of stages; serving the next one is a move like any
// other and costs nothing extra.
//
// Bookings may have a price instead of being walls: then the robot may overlap the bookings of
// another at that price, and finds the track whose completion and prices together are least. With
// prices far above any time this is the track with the fewest conflicts.
//
// Others may come to the last vertex late. No track can be complete before the last of them has
// left or is paid for, and a search by time alone looks at all that can be done until then. So it
// *aims* first: among tracks that are complete at just that tick any is as good as another, and one
// is looked for greedily, nearest to the end first, for a limited number of states.
//
// One object serves many searches: nodes, heap and the table of states keep their memory, and a
// generation stamp takes the place of clearing.
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

// What a search is asked.
struct SearchRequest {
    const Trip& trip;
    const BookingTable& bookings;
    std::span<const Tick> prices = {};  // for overlapping a booking of each robot; empty: never
    Tick limit = never;                 // tracks that cost more are of no use
    // Above 0: a good track in a hurry. The way ahead counts so many eighths more, and of the ways
    // to reach a state only that of the least time and prices together is kept.
    Tick greed = 0;
};

class SafeIntervalSearch {
  public:
    // Borrows the roads.
    SafeIntervalSearch(const Roads& roads, const BookingRules& rules);

    // `is_over` is asked every few hundred states whether to stop.
    SearchEnd run(const SearchRequest& errand, const StopCondition& is_over);

    // What the last search found; empty if nothing.
    void track(std::vector<Visit>& visits) const;
    Tick completion() const { return nodes_[static_cast<std::size_t>(goal_)].ready; }
    Tick cost() const { return completion() + nodes_[static_cast<std::size_t>(goal_)].cost; }

    // How many states all searches have expanded: a measure of effort that no clock disturbs.
    std::int64_t n_expanded() const { return n_expanded_; }

  private:
    struct Node {
        Tick ready;  // from when the robot may drive on
        Tick cost;   // prices paid
        VertexId vertex;
        std::int32_t gap;  // how many bookings of the vertex are behind it, or paid for
        std::int32_t stage;
        std::int32_t parent;
        std::int32_t next;   // another node of the same state
        std::int32_t drive;  // ticks of the edge driven in; 0: by waiting or serving a stage
        bool is_beaten;
    };
    struct Slot {
        std::uint64_t state;
        Tick least;  // time and prices of that node together
        std::uint32_t generation;
        std::int32_t node;  // the latest of this state
    };
    static constexpr Slot unused{0, 0, 0, -1};

    SearchEnd search(std::int64_t most_states, const StopCondition& is_over);
    void begin(const SearchRequest& errand);
    void measure_stages(const Trip& trip);
    Tick least_end() const;
    Tick free_end(std::span<const BookedBy> before) const;
    bool is_worth_aiming() const;
    SearchEnd aim(const StopCondition& is_over);
    Tick rest(VertexId vertex, std::int32_t stage) const;
    void expand(std::int32_t node);
    void finish(std::int32_t node);
    void serve(std::int32_t node);
    void stay_on(std::int32_t node);
    void drive(std::int32_t node, EdgeId edge);
    void drive_between(Node candidate, Tick way, Tick latest, Tick approach);
    void drive_across(const Node& soonest, Tick way, Tick latest, Tick approach);
    Tick price_of_entry(const Node& candidate, Tick approach) const;
    Tick price_of_swaps(const Node& candidate) const;
    Tick price(RobotId robot) const;
    void reach(const Node& candidate, Tick way);
    bool is_known(const Node& candidate, std::int32_t first);
    void next_generation();
    Slot& slot_of(const Node& node);
    void enlarge_slots();
    std::int32_t n_stages() const { return static_cast<std::int32_t>(trip_->n_stages()); }

    Roads roads_;
    BookingRules rules_;
    const Trip* trip_ = nullptr;
    const BookingTable* bookings_ = nullptr;
    std::span<const Tick> prices_;
    Tick limit_ = never;
    std::vector<Tick> to_go_;      // from each stage's vertex to completion
    std::int32_t first_last_ = 0;  // from this stage on, all are at the last vertex
    std::vector<Node> nodes_;
    OpenList open_;
    std::vector<Slot> slots_;    // open addressing
    std::size_t mask_ = 0;       // the first so many slots are in use; a search starts with few
    Tick least_drive_ = 1;       // on any edge
    Tick least_f_ = 0;           // of any track, because of who comes to the last vertex
    bool is_aiming_ = false;     // at a track with that f
    bool has_one_label_ = true;  // a state is known by one node only, not by all that may pay
    Tick first_f_ = 0;
    Tick greed_ = 0;
    std::uint32_t generation_ = 0;
    std::int32_t goal_ = -1;
    std::int64_t n_expanded_ = 0;
};

}  // namespace rightofway
