// Bookings of vertices with a period or none, and when one more robot can make given visits.
//
// Safe intervals (Phillips & Likhachev, "SIPP: Safe interval path planning for dynamic
// environments", ICRA 2011) on a fixed sequence of visits. A *gap* is the time between two bookings
// of a vertex. An earlier enter into a gap is never worse than a later one, so the search goes from
// visit to visit and keeps the earliest enter into each gap that it can reach.
//
// With a period P time is a circle: all bookings come again every P ticks, and so do all gaps
// (Serafini & Ukovich, "A mathematical model for periodic scheduling problems", SIAM Journal on
// Discrete Mathematics 2, 1989). A robot that repeats its visits closes its track: after the last
// visit comes the first one, P ticks later. The track closes if the robot enters the gap that it
// started from, P ticks later, at most P ticks after its start. If it enters that gap later, its
// start is moved by as much; either a start is found that meets itself, or the gap ends and the
// next gap is tried. So the search is complete for its visits, except from a vertex that no other
// robot visits: any phase is possible there, and only the given one is tried.
//
// Without a period time is a line, for instance around the tick at which a simulated run is closed
// to a circle.
#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/search_end.hpp"
#include "core/types.hpp"

namespace rightofway {

// Consecutive visits of one robot. Borrowed.
struct Visits {
    std::span<const VertexId> vertex;
    std::span<const Tick> dwell;  // least duration of each, without the drive that follows
    std::span<const Tick> drive;  // into each; above 0
};

class PeriodicBookings {
  public:
    // The time between two bookings of a vertex, on unrolled time.
    struct Gap {
        Tick start;
        Tick end;
        RobotId before;  // leaves the vertex at the start; nobody if the gap has no start
        RobotId after;   // enters it at the end; nobody if the gap has no end
        bool operator==(const Gap&) const = default;
    };

    // Throws std::invalid_argument if a number is out of its range.
    PeriodicBookings(VertexId n_vertices, std::optional<Tick> period, Tick headway,
                     bool books_ahead);

    VertexId n_vertices() const { return static_cast<VertexId>(at_.size()); }
    bool has_period() const { return period_ != never; }
    Tick period() const { return period_; }  // `never` without one
    Tick headway() const { return headway_; }
    bool books_ahead() const { return books_ahead_; }
    // The same tick in the first period.
    Tick fold(Tick tick) const;

    // Books visits that begin at these ticks. With a period, the last one lasts until the first one
    // comes again, and the robot must not have bookings yet; false, with nothing booked, if a
    // booking overlaps another robot's. Without, it lasts until `leave`; a robot may book more than
    // once, and overlaps are allowed: they leave no gap. Throws std::invalid_argument if the robot
    // has bookings already, or the arrays do not fit (nothing is booked then).
    bool add(RobotId robot, const Visits& visits, std::span<const Tick> enter,
             std::optional<Tick> leave = std::nullopt);

    // Removes all bookings of a robot.
    void remove(RobotId robot);

    // The robots whose bookings of any of these vertices overlap [from, to), each once. With a
    // period bookings count in the period that they start in.
    std::vector<RobotId> users(std::span<const VertexId> vertices, Tick from, Tick to) const;

    // Finds ticks at which a robot can enter the visits of one period, after the last of which
    // comes the first. False if there are none (if others book the first vertex, too), or none from
    // this phase (if no other does), or if `is_over` said so. Gaps of the first vertex that begin
    // after the phase come first.
    bool search(const Visits& visits, Tick phase, std::vector<Tick>& enter,
                const StopCondition& is_over);

    // Finds the earliest ticks for visits of which the first begins at `from` and the last by
    // `until`, and the last lasts until `leave`. False if there are none.
    bool connect(const Visits& visits, Tick from, Tick until, Tick leave, std::vector<Tick>& enter);

    // The last visit that the latest search could enter: the next one is where it got stuck.
    std::size_t reached() const { return reached_; }

    // Calls use(gap) for each gap of a vertex that begins before `to` and ends after `from`, in
    // order, until it returns false. Gaps may be empty where one robot follows another at once.
    template <class Use>
    void for_each_gap(VertexId vertex, Tick from, Tick to, Use&& use) const;

    // When a robot that waits in one gap enters another, driving at least until `soonest` and at
    // most until `last`, and books the way there `approach` ahead; `never` if it cannot.
    Tick enters(const Gap& here, const Gap& there, Tick soonest, Tick last, Tick approach) const;

  private:
    struct Booking {
        Tick start;  // in [0, period)
        Tick end;    // at most a period later
        RobotId robot;
        bool operator<(const Booking& other) const {
            return start != other.start ? start < other.start : robot < other.robot;
        }
    };
    // The earliest enter into a gap of one visit's vertex.
    struct Stay {
        Tick enter;
        Gap gap;
        std::int32_t from;  // its predecessor among the stays of the visit before
    };

    Tick approach(const Visits& visits, std::size_t k) const {
        return books_ahead_ ? visits.drive[k] : 0;
    }
    bool is_free(VertexId vertex, const Booking& booking) const;
    void prepare(const Visits& visits, std::size_t last);
    bool close_from(const Visits& visits, const Gap& home, Tick start, std::vector<Tick>& enter,
                    const StopCondition& is_over);
    const std::vector<Stay>& spread(const Visits& visits, std::size_t last, const Stay& first,
                                    Tick latest);
    void trace(std::size_t last, const Stay& stay, std::vector<Tick>& enter) const;

    Tick period_;
    Tick headway_;
    bool books_ahead_;
    std::vector<std::vector<Booking>> at_;                            // of each vertex, by start
    std::unordered_map<RobotId, std::vector<VertexId>> vertices_of_;  // each once
    std::vector<Tick> rest_;                // from each visit's enter to that of the last one
    std::vector<std::vector<Stay>> stays_;  // of each visit, and of the first one a period later
    std::size_t reached_ = 0;
};

template <class Use>
void PeriodicBookings::for_each_gap(VertexId vertex, Tick from, Tick to, Use&& use) const {
    const auto& row = at_[static_cast<std::size_t>(vertex)];
    const bool wraps = has_period() && !row.empty();
    Tick shift = wraps ? from - fold(from) : 0;
    // The first gap is that before the first booking that starts at `from` or after it.
    auto next = std::lower_bound(row.begin(), row.end(), from - shift,
                                 [](const Booking& one, Tick tick) { return one.start < tick; });
    for (;; ++next) {
        Gap gap{-never, never, nobody, nobody};
        if (wraps && next == row.end()) {
            next = row.begin();
            shift += period_;
        }
        if (next != row.begin()) {
            gap.start = std::prev(next)->end + shift;
            gap.before = std::prev(next)->robot;
        } else if (wraps) {
            gap.start = row.back().end + shift - period_;
            gap.before = row.back().robot;
        }
        if (next != row.end()) {
            gap.end = next->start + shift;
            gap.after = next->robot;
        }
        if (gap.start > to || (gap.start <= gap.end && !use(gap)) || next == row.end()) {
            return;
        }
    }
}

}  // namespace rightofway
