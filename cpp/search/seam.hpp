// Where a stretch of a run is closed to a circle: bookings around that seam, on a line of time, and
// how a robot gets through from its last lap before it to its first lap after it.
//
// Far from the seam nothing changes, so only what is booked near it is looked at, however long the
// circle is. Of a robot that makes some more laps there all visits are known; what is looked for is
// when they begin. Along that line, being in a gap earlier is never worse than later, so the search
// keeps the earliest enter of each gap it can reach (safe intervals, as in circle.hpp).
//
// Phillips & Likhachev, "SIPP: Safe interval path planning for dynamic environments", ICRA 2011.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/types.hpp"

namespace rightofway {

class Seam {
  public:
    // Visits one behind the other; borrowed.
    struct Stretch {
        std::span<const VertexId> vertex;
        std::span<const Tick>
            dwell;  // how long each lasts at least, without the drive that follows
        std::span<const Tick> drive;  // into each one; above 0
    };

    // Throws std::invalid_argument if a number is out of its range.
    Seam(VertexId n_vertices, Tick headway, bool books_ahead);

    // Books visits that begin at these ticks and end where the next begins, the last at `leave`.
    // Nothing is checked but numbers: overlaps are looked for by is_free and connect.
    void add(RobotId robot, const Stretch& stretch, std::span<const Tick> enter, Tick leave);

    // Takes back what a robot has booked at these vertices.
    void remove(RobotId robot, std::span<const VertexId> vertices);

    // Finds when visits can begin among the bookings, as early as they can: the first begins at
    // `from` and the last by `until`, and that lasts until `leave`. False if there is no way.
    bool connect(const Stretch& stretch, Tick from, Tick until, Tick leave,
                 std::vector<Tick>& enter);

    // Who has booked a vertex between two ticks, each once.
    std::vector<RobotId> users(VertexId vertex, Tick from, Tick to) const;

    // Which visit the last search has reached: what comes next is where it got stuck.
    std::size_t reached() const { return reached_; }

    VertexId n_vertices() const { return static_cast<VertexId>(at_.size()); }

  private:
    struct Booking {
        Tick start;
        Tick end;
        RobotId robot;
    };
    struct Gap {
        Tick start;
        Tick end;
        RobotId before;
        RobotId after;
    };
    struct Stay {
        Tick enter;
        Gap gap;
        std::int32_t from;
    };

    static bool is_earlier(const Booking& left, const Booking& right);
    template <class Use>
    void for_each_gap(VertexId vertex, Tick from, Tick to, Use&& use) const;
    void go_on(const Stretch& stretch, std::size_t k, std::int32_t from, Tick latest);
    Tick enters(const Gap& here, const Gap& there, Tick soonest, Tick last, Tick approach) const;
    void arrive(std::size_t k, const Stay& stay);
    Tick approach(const Stretch& stretch, std::size_t k) const {
        return books_ahead_ ? stretch.drive[k] : 0;
    }

    Tick headway_;
    bool books_ahead_;
    std::vector<std::vector<Booking>> at_;  // of each vertex, by start
    std::vector<Tick> rest_;                // from each visit's enter to the last one's
    std::vector<std::vector<Stay>> stays_;  // of each visit
    std::size_t reached_ = 0;
};

}  // namespace rightofway
