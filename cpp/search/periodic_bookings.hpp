// Bookings of vertices with or without a period, and the times of one more robot's given visits.
//
// Safe intervals (Phillips & Likhachev, "SIPP: Safe interval path planning for dynamic
// environments", ICRA 2011) on a fixed sequence of visits. A *gap* is the time between two bookings
// of a vertex. An earlier enter into a gap is never worse than a later one, so the search expands
// visit by visit and keeps the earliest enter into each reachable gap.
//
// With a period P, each booking and each gap repeats every P ticks (Serafini & Ukovich, "A
// mathematical model for periodic scheduling problems", SIAM Journal on Discrete Mathematics 2,
// 1989). The visits of a robot repeat, too: the first visit follows the last visit. The track
// closes if the robot enters its start gap again at most P ticks after its start. If the robot
// returns d ticks too late, the search moves the start by d and repeats, until the track closes or
// the gap ends; then it tries the next gap. The search is complete for its visits, with one
// exception: if no other robot visits the first vertex, each phase is possible, and only the given
// phase is tried.
//
// Without a period, time is a line; example: the ticks around the closing of a simulated run.
//
// Where robots have sizes, bookings are in rows (see Resources in problem.hpp). A robot marks all
// rows that its bookings exclude, and a search reads the rows that it needs: that of each vertex,
// and for each drive that of the edge. Marks of several robots may overlap; the gaps of a row are
// between its joined marks.
#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/excluded_rows.hpp"
#include "core/search_end.hpp"
#include "core/types.hpp"

namespace rightofway {

// The latest tick of a periodic search, and below 0 the earliest: no sum of two overflows.
constexpr Tick latest_tick = Tick{1} << 60;

// Consecutive visits of one robot. Borrowed.
struct Visits {
    std::span<const VertexId> vertex;
    std::span<const Tick> dwell;  // least duration of each visit, without the next drive
    std::span<const Tick> drive;  // ticks of the drive into each visit; above 0
    // Where robots have sizes, `vertex` holds rows, and this the rows of the edges driven into each
    // visit; else empty.
    std::span<const std::int32_t> edge = {};

    std::int32_t edge_into(std::size_t k) const { return edge.empty() ? none : edge[k]; }
};

class PeriodicBookings {
  public:
    // The time between two bookings of a vertex, on unrolled time.
    struct Gap {
        Tick start;
        Tick end;
        RobotId before;  // leaves the vertex at `start`; nobody if the gap has no start
        RobotId after;   // enters the vertex at `end`; nobody if the gap has no end
        bool operator==(const Gap&) const = default;
    };

    // Throws std::invalid_argument if an argument is out of range.
    PeriodicBookings(std::int32_t n_rows, std::optional<Tick> period, Tick headway,
                     bool books_ahead, const ExcludedRows& rows = {});

    std::int32_t n_rows() const { return static_cast<std::int32_t>(at_.size()); }
    bool has_sizes() const { return !lists_.is_identity(); }
    bool has_period() const { return period_ != never; }
    Tick period() const { return period_; }  // `never`: no period
    Tick headway() const { return headway_; }
    bool books_ahead() const { return books_ahead_; }
    // The tick modulo the period, in [0, period).
    Tick fold(Tick tick) const;

    // Books visits with these enters. With a period: the last visit lasts until the first visit
    // repeats, and the robot may have no bookings; returns false and books nothing if a booking
    // overlaps a booking of another robot. Without a period: the last visit lasts until `leave`, a
    // robot may book several times, and bookings may overlap (no gap between them). Throws
    // std::invalid_argument, with nothing booked, if the arguments do not fit.
    bool add(RobotId robot, const Visits& visits, std::span<const Tick> enter,
             std::optional<Tick> leave = std::nullopt);

    // Removes all bookings of a robot.
    void remove(RobotId robot);

    // The robots with a booking (with sizes: a mark) in one of these rows that overlaps [from, to),
    // each once. With a period, a booking counts in the period of its start.
    std::vector<RobotId> users(std::span<const std::int32_t> rows, Tick from, Tick to) const;

    // Finds the enters of one period of repeated visits. Tries the gaps of the first vertex in
    // order, from the gap at `phase` on. False if no enters exist (none from `phase`, if no other
    // robot books the first vertex) or if `is_over` became true.
    bool search(const Visits& visits, Tick phase, std::vector<Tick>& enter,
                const StopCondition& is_over);

    // Finds the earliest enters where the first visit begins at `from` and the last visit begins by
    // `until` and lasts until `leave`. False if none exist.
    bool connect(const Visits& visits, Tick from, Tick until, Tick leave, std::vector<Tick>& enter,
                 const StopCondition& is_over = {});

    // The last visit that the latest search could enter; the search failed at the next visit.
    std::size_t reached() const { return reached_; }

    // Calls use(gap) for each gap of a row that begins before `to` and ends after `from`, in
    // order, until `use` returns false. A gap is empty if one robot follows another at once.
    template <class Use>
    void for_each_gap(std::int32_t row, Tick from, Tick to, Use&& use) const;

    // The enter of a robot that drives from gap `here` into gap `there`, in [soonest, last], with
    // the booking `approach` ticks ahead, along an edge with a row or `none`; `never` if no enter
    // is possible.
    Tick enters(const Gap& here, const Gap& there, Tick soonest, Tick last, Tick approach,
                std::int32_t edge) const;

  private:
    struct Booking {
        Tick start;  // in [0, period)
        Tick end;    // at most start + period
        RobotId robot;
        bool operator<(const Booking& other) const {
            return start != other.start ? start < other.start : robot < other.robot;
        }
    };
    // The earliest enter into a gap of one visit's vertex.
    struct Stay {
        Tick enter;
        Gap gap;
        std::int32_t from;  // index of the parent among the stays of the visit before
    };

    Tick approach(const Visits& visits, std::size_t k) const {
        return books_ahead_ ? visits.drive[k] : 0;
    }
    using Row = std::vector<Booking>;

    const Row& gaps_of(std::int32_t row) const;
    void join(std::int32_t row) const;
    bool is_free(std::int32_t row, const Booking& booking) const;
    Tick drives(std::int32_t edge, Tick enter, Tick last, Tick ticks) const;
    void prepare(const Visits& visits, std::size_t last);
    bool close_from(const Visits& visits, const Gap& home, Tick start, std::vector<Tick>& enter,
                    const StopCondition& is_over);
    const std::vector<Stay>& spread(const Visits& visits, std::size_t last, const Stay& first,
                                    Tick latest, const StopCondition& is_over);
    void trace(std::size_t last, const Stay& stay, std::vector<Tick>& enter) const;

    Tick period_;
    Tick headway_;
    bool books_ahead_;
    std::vector<Row> at_;  // bookings or marks of each row, sorted by start
    std::unordered_map<RobotId, std::vector<std::int32_t>> rows_of_;  // each once
    ExcludedRows lists_;
    mutable std::vector<Row> joined_;               // marks joined, with sizes only
    mutable std::vector<std::uint8_t> is_changed_;  // since the marks were joined
    std::vector<Tick> rest_;                        // least ticks from each enter to the last enter
    std::vector<std::vector<Stay>> stays_;          // of each visit, then of visit 0 a period later
    std::size_t reached_ = 0;
};

template <class Use>
void PeriodicBookings::for_each_gap(std::int32_t of, Tick from, Tick to, Use&& use) const {
    const Row& row = gaps_of(of);
    const bool wraps = has_period() && !row.empty();
    Tick shift = wraps ? from - fold(from) : 0;
    // The first gap ends at the first booking with start >= `from`.
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
