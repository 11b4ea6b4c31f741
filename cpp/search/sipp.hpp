// Safe interval path planning (SIPP): the best track of one robot among bookings of other robots.
//
// The steps as published; the numbers stand beside the code (sipp.cpp):
//
//      A*:
//   1      insert the start, home in its first gap at tick 0, into OPEN
//   2      while OPEN is not empty: s <- the state of OPEN with the least f = g + h
//   3          if s is the goal: return
//   4          expand s: insert its successors into OPEN
//      the successors of s:
//   5      for each edge m out of the vertex of s:
//   6          start <- the time of s + the ticks of m
//   7          latest <- the end of the gap of s, until which the robot can stay there
//   8          if start is after latest: continue
//   9          for each gap i of the head of m:
//  10              if i begins after latest, or ends before start: continue
//  11              t <- the earliest arrival in i without collision
//  12              if there is none: continue
//  13              (head of m, i) is a successor at t, unless it was reached as early before
//
// What is added has files of its own. search_states.hpp: the states reached, one node or several
// for each. sipp_stages.cpp: the itinerary is a list of stages (stops, work, turns, way home), and
// a move of the search drives, waits or serves the next stage. sipp_prices.cpp: a track may overlap
// the bookings of another robot and pays the price of that robot; the search minimizes completion
// time plus prices. Example: with prices far above any time, it finds the track with the fewest
// conflicts.
//
// If another robot books the last vertex late, no track is complete before that booking ends or is
// paid for, and A* would expand every state up to that tick. So the search *aims* first: tracks
// that are complete at exactly that tick are equally good, and a greedy search, nearest to the end
// first, looks for one of them within a limited number of states (sipp_stages.cpp).
//
// Where robots have sizes, a drive also needs its edge to be free of bookings: within one gap of
// the head, the earliest drive that does is the best.
//
// The last visit may have an earliest start. Then a robot may still pass the last vertex before:
// "entered late enough to stay" is one more gap there, from which nothing follows but the end.
//
// Where stages have times (problem.hpp), work waits for its earliest begin, and a later arrival is
// still never better, because a robot can wait in its gap. A visit may serve several stages and
// turns once. If ends of stages cost, A* minimizes these costs and the weighted completion time. A
// robot that ends anywhere completes with its last work: from there on its cost is fixed, and a
// state keeps every node that is earlier or cheaper than the others.
//
// Closures are bookings of nobody: they have no price and swap with no robot. Surcharges of edges
// count as costs, as prices do.
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
#include "search/search_states.hpp"

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
    Tick latest = never;  // greatest completion time, whatever is paid [ticks]
    Tick rest_price =
        0;  // of ending at a vertex that other robots want, for one that ends anywhere
    Tick stays_from = 0;           // earliest start of the last visit's booking
    Tick ends_from = 0;            // least completion time
    Tick starts_at = 0;            // from when on the robot is at its home
    std::int32_t last_gap = none;  // the gap in which the last visit ends; none: that without end
};

class SafeIntervalSearch {
  public:
    // Borrows the roads.
    SafeIntervalSearch(const Roads& roads, const BookingRules& rules);

    // Calls `is_over` every few hundred states.
    SearchEnd run(const SearchRequest& request, const StopCondition& is_over);

    // The track of the last search; empty if the search found none.
    void track(std::vector<Visit>& visits) const;
    // When the robot of the last search ends its track, its last work included.
    Tick completion() const { return states_[goal_].ready; }
    Tick cost() const { return value(states_[goal_], 0); }

    // Prepares `rest` for a trip. Borrows the trip.
    void measure(const Trip& trip) {
        trip_ = &trip;
        measure_stages(trip);
    }
    // The least ticks from a vertex, entered along an edge (-1: none), to completion, alone on the
    // roads; -1 if no path exists.
    Tick rest(VertexId vertex, EdgeId edge, std::int32_t stage) const {
        return stage == n_stages() || !trip_->with_turns ? rest(vertex, stage)
                                                         : trip_->with_turns->from(edge, stage);
    }

    // The number of states expanded by all searches: effort, independent of the clock.
    std::int64_t n_expanded() const { return n_expanded_; }

  private:
    SearchEnd search(std::int64_t most_states, const StopCondition& is_over);
    void begin(const SearchRequest& request);
    void measure_stages(const Trip& trip);
    void measure_times(const Trip& trip);
    Tick least_end() const;
    Tick free_end(std::span<const BookedBy> before) const;
    bool is_worth_aiming() const;
    SearchEnd aim(const StopCondition& is_over);
    // The least ticks from a vertex to completion, -1 if no path exists.
    Tick rest(VertexId vertex, std::int32_t stage) const {
        if (stage == n_stages()) {
            return 0;
        }
        const Tick way = trip_->to_stage[index(stage)].from(vertex);
        return way < 0 ? way : way + to_go_[index(stage)];
    }
    Tick rest(const SearchNode& node) const { return rest(node.vertex, node.edge, node.stage); }
    // The least cost of a track by way of a node: f = g + h.
    Tick value(const SearchNode& node, Tick way) const {
        return has_times_ ? value_in_time(node, way) : node.ready + way + node.cost;
    }
    Tick value_in_time(const SearchNode& node, Tick way) const;
    bool is_in_time(const SearchNode& node) const;
    // Whether the robot has completed, and looks for a vertex to stay at.
    bool has_completed(const SearchNode& node) const {
        return completes_before_end_ && node.stage + 1 >= n_stages();
    }
    // Whether the cost rises by a tick with each tick.
    bool costs_time(const SearchNode& node) const { return !costs_ends_ && !has_completed(node); }
    void expand(std::int32_t node);
    void finish(std::int32_t node);
    void serve(std::int32_t node);
    void finish_in_time(SearchNode after);
    void serve_in_time(std::int32_t node);
    bool pay_until(SearchNode& node, Tick tick) const;
    Tick completion_cost(Tick tick) const {
        return costs_ends_ ? trip_->times.weight * tick : tick;
    }
    void stay_on(std::int32_t node);
    void drive(std::int32_t node, EdgeId edge);
    void drive_between(SearchNode candidate, Tick way, Tick latest, Tick approach,
                       std::span<const BookedBy> along);
    void drive_across(const SearchNode& soonest, Tick way, Tick latest, Tick approach,
                      std::span<const BookedBy> along);
    Tick free_drive(std::span<const BookedBy> along, Tick tick, Tick drive) const;
    Tick price_of_drive(std::span<const BookedBy> along, Tick tick, Tick drive) const;
    Tick price_of_entry(const SearchNode& candidate, Tick approach) const;
    // With headway or booking ahead, a swap is a vertex conflict already.
    Tick price_of_swaps(const SearchNode& candidate) const {
        return rules_.headway > 0 || rules_.books_ahead ? 0 : price_of_swaps_at(candidate);
    }
    Tick price_of_swaps_at(const SearchNode& candidate) const;
    Tick price_of_all(std::span<const BookedBy> bookings, Tick start) const;
    Tick price(RobotId robot) const {
        return prices_.empty() || robot == nobody ? never : prices_[index(robot)];
    }
    bool is_at_end(const SearchNode& node) const;
    bool may_stay_at_once() const { return stays_from_ <= 0 && ends_from_ <= 0; }
    Tick earliest_stay(const SearchNode& candidate, Tick approach) const;
    void stay_between(SearchNode candidate, Tick way, Tick latest, Tick approach,
                      std::span<const BookedBy> along);
    void reach(const SearchNode& candidate, Tick way);
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
    Tick latest_ = never;
    Tick rest_price_ = 0;
    Tick stays_from_ = 0;
    Tick ends_from_ = 0;
    Tick starts_at_ = 0;
    std::int32_t last_gap_ = none;
    bool has_times_ = false;             // stages have times
    bool completes_before_end_ = false;  // the robot ends anywhere
    bool costs_ends_ = false;            // ends of stages cost
    std::vector<Tick> to_go_;            // least ticks from each stage's vertex to completion
    std::vector<Tick> soonest_;    // least completion by the earliest begins from each stage on
    std::vector<Tick> in_time_;    // latest arrival at each stage's vertex
    std::int32_t first_last_ = 0;  // first of the final stages at the last vertex
    SearchStates states_;
    OpenList open_;
    Tick least_drive_ = 1;       // least ticks of any edge
    Tick least_f_ = 0;           // bound from the bookings of the last vertex
    bool is_aiming_ = false;     // looks for a track with f = least_f_
    bool has_one_label_ = true;  // one node per state, no Pareto set of (time, cost)
    Tick first_f_ = 0;
    Tick greed_ = 0;
    std::int32_t goal_ = -1;
    std::int64_t n_expanded_ = 0;
};

}  // namespace rightofway
