// The track of least priced cost of one robot: its cost, and a price for each tick at which it
// books a vertex, or arrives along an edge, that has a price at that tick.
//
// A search over visits, A*: a node is a stage, a vertex and the tick at which the robot is there. A
// robot drives on at once, or so late that it misses one more priced tick of the next vertex; any
// other wait can take place in the next vertex at no higher price.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/open_list.hpp"
#include "core/search_end.hpp"
#include "distances/trip.hpp"
#include "problem/problem.hpp"

namespace rightofway {

// Costs and prices are in parts of a tick.
inline constexpr Tick parts_per_tick = 1024;

// The prices of one place by tick.
class PricesOfPlace {
  public:
    struct Entry {
        Tick tick;
        Tick price = 0;
        double mean = 0;     // of how many robots too many there were, recent ones first
        std::int32_t n = 0;  // how many robots are there
    };

    std::vector<Entry>& entries() { return entries_; }
    const std::vector<Entry>& entries() const { return entries_; }
    // The first entry at a tick or later.
    std::size_t from(Tick tick) const;
    // The ticks that have a price, in order; the sums of the prices before each, and of all.
    const std::vector<Tick>& ticks() const { return ticks_; }
    const std::vector<Tick>& sums() const { return sums_; }
    // The first priced tick at a tick or later.
    std::size_t priced_from(Tick tick) const {
        return index(std::lower_bound(ticks_.begin(), ticks_.end(), tick) - ticks_.begin());
    }
    // The sum of the prices of the ticks in [start, end).
    Tick of(Tick start, Tick end) const { return before(end) - before(start); }
    // The sum of the prices of all earlier ticks.
    Tick before(Tick tick) const { return sums_[priced_from(tick)]; }
    // After a change of entries: takes over their prices.
    void add_up();

  private:
    std::vector<Entry> entries_;  // by tick
    std::vector<Tick> ticks_;
    std::vector<Tick> sums_{0};
};

// Prices of vertices, and of lanes where two robots may swap.
class Prices {
  public:
    explicit Prices(const Problem& problem);

    PricesOfPlace& at(VertexId vertex) { return vertices_[index(vertex)]; }
    const PricesOfPlace& at(VertexId vertex) const { return vertices_[index(vertex)]; }
    // The prices of both directions of a lane, by the tick of the arrival.
    PricesOfPlace& along(EdgeId edge) { return lanes_[index(lane_[index(edge)])]; }
    const PricesOfPlace& along(EdgeId edge) const { return lanes_[index(lane_[index(edge)])]; }
    bool has_lanes() const { return !lane_.empty(); }

    std::vector<PricesOfPlace>& vertices() { return vertices_; }
    std::vector<PricesOfPlace>& lanes() { return lanes_; }

  private:
    std::vector<PricesOfPlace> vertices_;
    std::vector<std::int32_t> lane_;  // of each edge; empty where bookings exclude swaps
    std::vector<PricesOfPlace> lanes_;
};

struct PricedVisit {
    Tick enter;
    VertexId vertex;
    EdgeId edge;  // driven along to get there; -1 for the first
};

struct PricedTrack {
    std::vector<PricedVisit> visits;
    Tick cost = 0;  // completion time and surcharges by the robot's weight, without prices
};

class PricedSearch {
  public:
    // Borrows the problem.
    explicit PricedSearch(const Problem& problem);

    // Replaces the track of a robot by one of least priced cost, unless it is one; an empty track
    // is replaced. Closures and turns on the spot are not looked at: such tracks cost no less.
    // False: stopped.
    bool improve(RobotId robot, const Trip& trip, const Prices& prices, PricedTrack& track,
                 const StopCondition& is_over);

    // The cost of a track and the prices that it pays.
    Tick priced(const Prices& prices, const PricedTrack& track) const;
    // When the visit of a track books its vertex.
    Booking booking(RobotId robot, const PricedTrack& track, std::size_t visit) const;

  private:
    struct Node {
        Tick enter;
        Tick g;
        VertexId vertex;
        EdgeId edge;
        std::int32_t stage;
        std::int32_t parent;
        bool is_worse = false;  // than another one of the same stage and vertex
        Tick apart = 0;         // what it has paid apart from waiting at its vertex
    };
    // A node of a stage and vertex that no other one is as good as.
    struct Label {
        Tick enter;
        Tick apart;
        std::int32_t node;
    };

    void push(const Node& node, Tick h);
    void drive(const Trip& trip, const Prices& prices, std::int32_t from, EdgeId edge);
    Tick least_to_go(const Trip& trip, std::int32_t stage, VertexId vertex) const;

    const Problem& problem_;
    std::vector<Node> nodes_;
    OpenList open_;
    std::vector<std::vector<Label>> labels_;  // by stage and vertex; later ones have paid less
    std::vector<std::size_t> touched_;
    std::vector<Tick> later_;  // what is to come after the way to each stage [ticks]
    RobotId robot_ = nobody;
    Tick weight_ = 1;
    Tick upper_ = never;
    Tick origin_ = 0;
};

}  // namespace rightofway
