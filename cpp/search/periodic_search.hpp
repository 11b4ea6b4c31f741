// A round trip on any route among periodic bookings.
//
// A* on safe intervals (Phillips & Likhachev, "SIPP: Safe interval path planning for dynamic
// environments", ICRA 2011). A state is (vertex, gap, stage); an earlier enter into a gap is never
// worse than a later one. Time is unrolled. Any visit to the vertex of the next stage may serve it.
//
// The trip closes as in periodic_bookings.hpp: it is home again in the gap that it started from, at
// most a period later; otherwise its start is moved by as much. The earliest return from a later
// start is never earlier, so the search is complete among all routes.
#pragma once

#include <cstdint>
#include <vector>

#include "core/open_list.hpp"
#include "core/search_end.hpp"
#include "core/types.hpp"
#include "distances/trip.hpp"
#include "search/periodic_bookings.hpp"

namespace rightofway {

// The visits of a trip that was found: as `Visits`, and when each is entered.
struct PeriodicRoundTrip {
    std::vector<VertexId> vertex;
    std::vector<Tick> dwell;
    std::vector<Tick> drive;
    std::vector<Tick> enter;
};

class PeriodicSearch {
  public:
    // Borrows both. The last stage of a trip is at its home; a vertex without an entry in a stage's
    // table is not entered on the way to that stage.
    PeriodicSearch(const Roads& roads, const PeriodicBookings& circle);

    // Finds a route and its enters; false as `PeriodicBookings::search`. Among gaps of its home
    // those that begin after the phase come first; in the first that is possible it is home again
    // as early as it can be. Throws std::invalid_argument if roads and circle do not fit together.
    bool run(const Trip& trip, Tick phase, PeriodicRoundTrip& found, const StopCondition& is_over);

  private:
    struct Node {
        Tick enter;
        PeriodicBookings::Gap gap;
        VertexId vertex;
        std::int32_t stage;  // how many are served before it
        std::int32_t from;
        std::int32_t drive;
        std::int32_t next;  // another node of the same vertex
    };
    bool close_from(const PeriodicBookings::Gap& home, Tick start, PeriodicRoundTrip& found);
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
    const PeriodicBookings& circle_;
    const Trip* trip_ = nullptr;
    const StopCondition* is_over_ = nullptr;
    std::vector<Tick> to_go_;  // from the enter of each stage's vertex to being home again
    std::vector<Node> nodes_;
    OpenList open_;  // least time of return first, then the least rest
    Tick start_ = 0;
    std::vector<std::int32_t> at_;   // the latest node of each vertex
    std::vector<VertexId> touched_;  // which of these there are
    std::int32_t goal_ = -1;
    bool is_stopped_ = false;
    std::int64_t n_expanded_ = 0;
};

}  // namespace rightofway
