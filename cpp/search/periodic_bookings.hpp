// Bookings on a circle: who has booked which vertex when, period after period, and the next robot's
// way round it.
//
// Time is a circle as long as the period. Robots that repeat something close their tracks: the
// visit after the last is the first, a period later. What lies between the bookings of a vertex is
// a gap, and it comes again every period. A route is fixed; along it, being in a gap earlier is
// never worse than later, so the search goes from visit to visit and keeps the earliest enter of
// each gap it can reach (safe intervals, on a line of visits).
//
// The track closes if the robot is home again, in the gap that it started from, no later than a
// period after it entered it. If it is later, it starts as much later: either a start is found
// that meets itself, or the gap is over and the next one is tried. So the search is complete for
// its route, but for homes that nobody else visits: there all phases are possible, and one is
// given.
//
// Phillips & Likhachev, "SIPP: Safe interval path planning for dynamic environments", ICRA 2011.
// Serafini & Ukovich, "A mathematical model for periodic scheduling problems", SIAM Journal on
// Discrete Mathematics 2, 1989.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/search_end.hpp"
#include "core/types.hpp"

namespace rightofway {

// The visits of one period of one robot; after the last comes the first. Borrowed.
struct Round {
    std::span<const VertexId> vertex;
    std::span<const Tick> dwell;  // how long each lasts at least, without the drive that follows
    std::span<const Tick> drive;  // into each one; above 0
};

class PeriodicBookings {
  public:
    // What lies between two bookings of a vertex, on unrolled time.
    struct Gap {
        Tick start;
        Tick end;
        RobotId before;  // who leaves the vertex when it starts, none if nobody ever does
        RobotId after;   // who comes to it when it ends
        bool operator==(const Gap&) const = default;
    };

    // Throws std::invalid_argument if a number is out of its range.
    PeriodicBookings(VertexId n_vertices, Tick period, Tick headway, bool books_ahead);

    VertexId n_vertices() const { return static_cast<VertexId>(at_.size()); }
    Tick period() const { return period_; }
    Tick headway() const { return headway_; }
    bool books_ahead() const { return books_ahead_; }
    // The same tick in the first period.
    Tick fold(Tick tick) const;

    // Books all visits of a robot, entered at these ticks. Throws std::invalid_argument if the
    // arrays do not fit, the robot is there already, or a booking overlaps another's (nothing is
    // booked then).
    void add(RobotId robot, const Round& round, std::span<const Tick> enter);

    // Takes back all bookings of a robot.
    void remove(RobotId robot);

    // Finds ticks at which a robot can enter the visits of its round; false if there are none
    // (from homes that others visit too), or none from this phase (from other homes), or if
    // `is_over` said so. Among gaps of its home those that begin after the phase come first.
    bool search(const Round& round, Tick phase, std::vector<Tick>& enter,
                const StopCondition& is_over);

    // Calls use(gap) for each gap of a vertex that begins before `to` and ends after `from`, in
    // order, until it returns false. Gaps may be empty where one robot follows another at once.
    template <class Use>
    void for_each_gap(VertexId vertex, Tick from, Tick to, Use&& use) const;

    // When a robot that waits in one gap enters another, driving at least until `soonest` and at
    // most until `last`, and books the way there `approach` ahead; `never` if it never can.
    Tick enters(const Gap& here, const Gap& there, Tick soonest, Tick last, Tick approach) const;

    // Which visit of its round the last search has reached: what comes next is where it got stuck.
    std::size_t reached() const { return reached_; }

  private:
    struct Booking {
        Tick start;  // in [0, period)
        Tick end;    // at most a period later
        RobotId robot;
    };
    // The earliest enter into a gap of one visit's vertex.
    struct Stay {
        Tick enter;
        Gap gap;
        std::int32_t from;  // its predecessor among the stays of the visit before
    };

    // The first booking of a row that starts at a tick or after it.
    static std::vector<Booking>::const_iterator first_from(const std::vector<Booking>& row,
                                                           Tick tick);
    Booking folded(const Round& round, std::span<const Tick> enter, std::size_t k,
                   RobotId robot) const;
    bool is_free(VertexId vertex, const Booking& booking) const;
    Tick run(const Round& round, const Gap& home, Tick start, Tick latest);
    void go_on(const Round& round, std::size_t k, std::int32_t from, Tick latest);
    void arrive(std::size_t k, const Stay& stay);
    bool close_from(const Round& round, const Gap& home, Tick start, std::vector<Tick>& enter,
                    const StopCondition& is_over);
    void trace(const Round& round, std::int32_t last, std::vector<Tick>& enter) const;

    Tick period_;
    Tick headway_;
    bool books_ahead_;
    std::vector<std::vector<Booking>> at_;                            // of each vertex, by start
    std::unordered_map<RobotId, std::vector<VertexId>> vertices_of_;  // each once
    std::vector<Tick> rest_;                // from each visit's enter to the end of the round
    std::vector<std::vector<Stay>> stays_;  // of each visit, one more for home again
    std::int32_t closing_ = nobody;
    std::size_t reached_ = 0;
};

template <class Use>
void PeriodicBookings::for_each_gap(VertexId vertex, Tick from, Tick to, Use&& use) const {
    const auto& row = at_[static_cast<std::size_t>(vertex)];
    if (row.empty()) {
        use(Gap{-never, never, nobody, nobody});
        return;
    }
    // The first gap is that before the first booking that starts at `from` or after it.
    const Tick turn = from - fold(from);
    auto k = static_cast<std::size_t>(first_from(row, from - turn) - row.begin());
    for (Tick shift = turn;; ++k) {
        if (k == row.size()) {
            k = 0;
            shift += period_;
        }
        const Booking& before = k > 0 ? row[k - 1] : row.back();
        const Tick start = before.end + shift - (k > 0 ? 0 : period_);
        if (start > to || !use(Gap{start, row[k].start + shift, before.robot, row[k].robot})) {
            return;
        }
    }
}

}  // namespace rightofway
