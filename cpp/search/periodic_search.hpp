// Search for a round trip of one robot, on any route, among periodic bookings.
//
// A* on safe intervals (Phillips & Likhachev, "SIPP: Safe interval path planning for dynamic
// environments", ICRA 2011). A state is (vertex, gap, stage); an earlier enter into a gap is never
// worse than a later one. Time is unrolled. Any visit at the vertex of the next stage may serve it.
// Where turning takes time, the edge driven in is a part of the state, and a trip begins with the
// heading with which it ends: each edge that leads home is tried as the last one.
//
// The trip closes as in periodic_bookings.hpp: the robot is home in its start gap at most a period
// later. If the return is d ticks too late, the start moves by d. A later start never returns
// earlier, so the search is complete among all routes.
#pragma once

#include <cstdint>
#include <vector>

#include "core/open_list.hpp"
#include "core/search_end.hpp"
#include "core/types.hpp"
#include "distances/trip.hpp"
#include "search/periodic_bookings.hpp"

namespace rightofway {

// The visits of a round trip, as in `Visits`, with the enter of each visit.
struct PeriodicRoundTrip {
    std::vector<VertexId> vertex;
    std::vector<Tick> dwell;
    std::vector<Tick> drive;
    std::vector<Tick> enter;
};

class PeriodicSearch {
  public:
    // Borrows both. The last stage of a trip is at its home. On the way to a stage the robot enters
    // only vertices with a distance in the stage's table.
    PeriodicSearch(const Roads& roads, const PeriodicBookings& bookings);

    // Finds a route and its enters; false as in `PeriodicBookings::search`. Tries the gaps of the
    // home in order, from the gap at `phase` on; in the first possible gap the return is earliest.
    // Throws std::invalid_argument if roads and bookings do not fit together. The turns of the trip
    // are of these roads. Where robots have
    // sizes, the robot's rows begin at `first_row`.
    bool run(const Trip& trip, Tick phase, PeriodicRoundTrip& found, const StopCondition& is_over,
             std::int32_t first_row = 0);

  private:
    struct Node {
        Tick enter;
        PeriodicBookings::Gap gap;
        VertexId vertex;
        std::int32_t stage;  // number of stages served before this visit
        std::int32_t from;
        EdgeId edge;  // driven in; `none` in the first visit where turning takes no time
        std::int32_t drive;
        std::int32_t next;  // next node in the list of this vertex
    };
    bool close_from(const PeriodicBookings::Gap& home, Tick start, EdgeId last,
                    PeriodicRoundTrip& found);
    std::vector<EdgeId> last_edges() const;
    Tick earliest_return(const PeriodicBookings::Gap& home, Tick start, Tick latest);
    void expand(std::int32_t from, Tick latest);
    void drive(std::int32_t from, EdgeId edge, std::int32_t stage, Tick dwell, Tick latest);
    void reach(const Node& node);
    std::uint64_t key(const Node& node) const;
    Tick rest(VertexId vertex, std::int32_t stage) const;
    Tick dwell_of(std::int32_t stage) const;
    std::int32_t last_stage() const { return static_cast<std::int32_t>(trip_->n_stages()) - 1; }
    void trace(PeriodicRoundTrip& found) const;

    Roads roads_;
    const PeriodicBookings& bookings_;
    const Trip* trip_ = nullptr;
    const StopCondition* is_over_ = nullptr;
    std::int32_t first_row_ = 0;
    std::vector<Tick> to_go_;  // least ticks from the enter of each stage's vertex to home
    std::vector<Node> nodes_;
    OpenList open_;  // least return first, then least remaining ticks
    Tick start_ = 0;
    EdgeId last_edge_ = none;        // that leads home; `none`: any
    std::vector<std::int32_t> at_;   // head of each vertex's list of nodes
    std::vector<VertexId> touched_;  // vertices with a list
    std::int32_t goal_ = -1;
    bool is_stopped_ = false;
    std::int64_t n_expanded_ = 0;
};

}  // namespace rightofway
