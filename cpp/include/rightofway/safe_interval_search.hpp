// The earliest track of one robot among the bookings of the others (safe interval path planning).
//
// A state is (vertex, gap, stage): in one gap between the bookings of one vertex, being there
// earlier is never worse than later, for whoever is early can wait. So each state is expanded once,
// at its earliest time. What the robot has to do (stops, work, turning, the way home) is a list of
// stages; serving the next one is a move like any other and costs nothing extra.
//
// Phillips & Likhachev, "SIPP: Safe interval path planning for dynamic environments", ICRA 2011.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "rightofway/booking_table.hpp"
#include "rightofway/graph.hpp"
#include "rightofway/search_end.hpp"
#include "rightofway/types.hpp"

namespace rightofway {

// What one robot has to do. The stage tables hold, for each stage, the least ticks from every
// vertex to the stage's vertex, -1 where there is no way.
struct Trip {
    VertexId home;
    std::span<const VertexId> stage_vertex;
    std::span<const Tick> stage_dwell;  // work, and turning but in the last stage
    std::span<const std::int32_t> edge_ticks;
    std::vector<std::span<const std::int32_t>> stage_tables;
};

// How bookings are made of times; see conflict.hpp.
struct BookingRules {
    Tick headway;
    bool books_ahead;  // a vertex is booked from when the robot starts to drive there
};

struct FoundTrack {
    std::vector<VertexId> vertices;
    std::vector<Tick> enter;
};

class SafeIntervalSearch {
  public:
    // Borrows all that it is given. Throws std::invalid_argument where arrays do not fit together.
    SafeIntervalSearch(const Graph& graph, const BookingTable& bookings, const BookingRules& rules,
                       const Trip& trip);

    // `is_over` is asked every few thousand states whether to stop.
    SearchEnd run(const std::function<bool()>& is_over);
    FoundTrack track() const;

  private:
    struct Node {
        VertexId vertex;
        std::int32_t gap;
        std::int32_t stage;
        std::int32_t parent;
        std::int32_t next_here;  // the next node of the same vertex and stage
        bool is_closed;
        bool by_drive;  // entered by an edge, not by serving a stage
        Tick enter;
        Tick ready;  // from when the robot may drive on
    };
    struct Open {
        Tick f;
        Tick rest;
        std::int64_t order;  // makes the order total: first pushed, first out
        std::int32_t node;
        Tick ready;
    };

    static bool is_later(const Open& left, const Open& right);
    void check(const Trip& trip) const;
    Tick rest(VertexId vertex, std::int32_t stage) const;
    void expand(std::int32_t node);
    void serve(std::int32_t node);
    void drive(std::int32_t node, EdgeId edge);
    void reach(const Node& candidate);
    std::int32_t find(const Node& candidate) const;
    std::int32_t n_stages() const { return static_cast<std::int32_t>(trip_.stage_vertex.size()); }

    Graph graph_;
    const BookingTable& bookings_;
    BookingRules rules_;
    const Trip& trip_;
    std::vector<Tick> to_go_;  // from each stage's vertex to completion, its dwell included
    std::vector<std::int32_t> first_here_;  // of each (stage, vertex): its latest node
    std::vector<Node> nodes_;
    std::vector<Open> open_;
    std::int64_t n_pushed_ = 0;
    std::int32_t goal_ = -1;
};

}  // namespace rightofway
