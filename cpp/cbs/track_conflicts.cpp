#include "cbs/track_conflicts.hpp"

#include <algorithm>
#include <tuple>
#include <unordered_map>

namespace rightofway {
// Let robot k of a cycle of two or more enter at tick + x[k], 0 <= x[k] < drive[k]; each enters the
// vertex that the next robot leaves as it enters its own next vertex. If all x are equal, this is
// the swap or rotation itself. Otherwise some robot k enters before the next robot leaves, x[k] <
// x[k + 1]; the next robot is there since it began to drive, at tick + x[k + 1] - drive[k + 1] or
// before, which is before tick. So the two stays overlap, and no plan breaks all constraints.
Constraint against_move(const Problem& problem, EdgeId edge, Tick tick) {
    return {problem.n_vertices() + edge, tick - 1, tick};
}

void ConflictFinder::take(RobotId robot, const ConstrainedTrack& track) {
    robot_ = robot;
    track_ = &track;
    marks_.clear();
    for (const RowBooking& booking : track.bookings) {
        if (!problem_.has_sizes()) {
            marks_.push_back({booking.row, booking.row, booking.time});
            continue;
        }
        for (const std::int32_t row : problem_.excluded(booking.row)) {
            marks_.push_back({row, booking.row, booking.time});
        }
    }
    if (problem_.has_sizes()) {
        std::sort(marks_.begin(), marks_.end(), [](const Mark& left, const Mark& right) {
            return std::tuple(left.row, left.time.start, left.own) <
                   std::tuple(right.row, right.time.start, right.own);
        });
    }
}

// Where bookings of incompatible rows overlap, both hold the last tick of the overlap. Two robots
// that book these rows at that tick break the rules, whatever else they do: at least one of them
// does not, in any plan. Of all ticks of the overlap, the last one delays both robots the most.
void ConflictFinder::meet(RobotId other, const ConstrainedTrack& track,
                          std::vector<TrackConflict>& conflicts) const {
    auto mark = marks_.begin();
    for (const RowBooking& booking : track.bookings) {
        mark = std::partition_point(mark, marks_.end(),
                                    [&](const Mark& one) { return one.row < booking.row; });
        for (auto one = mark; one != marks_.end() && one->row == booking.row; ++one) {
            if (one->time.start >= booking.time.end || booking.time.start >= one->time.end) {
                continue;
            }
            if (targets_ && (one->time.end >= never) != (booking.time.end >= never)) {
                conflicts.push_back(meet_at_end(*one, other, booking));
                continue;
            }
            Tick tick = std::min(one->time.end, booking.time.end) - 1;
            if (tick >= never - 1) {  // both are there for ever
                tick = std::max(one->time.start, booking.time.start);
            }
            conflicts.push_back(
                {.robot = {robot_, other},
                 .constraint = {{{one->own, tick, tick + 1}, {booking.row, tick, tick + 1}}},
                 .since = std::max(one->time.start, booking.time.start)});
        }
    }
    if (problem_.may_follow()) {
        meet_swaps(other, track, conflicts);
    }
}

// Where one robot stays for ever, the other one passes its last vertex, or what excludes that: if
// it does so at the last tick of the overlap or later, the first robot's last visit begins later
// still. All visits that pass later are one constraint.
TrackConflict ConflictFinder::meet_at_end(const Mark& own, RobotId other,
                                          const RowBooking& booking) const {
    const Tick tick = std::min(own.time.end, booking.time.end) - 1;
    const Constraint ends{Constraint::last_visit, tick, tick + 1};
    if (own.time.end >= never) {
        return {.robot = {robot_, other}, .constraint = {ends, {booking.row, tick, never}}};
    }
    return {.robot = {robot_, other}, .constraint = {{{own.own, tick, never}, ends}}};
}

void ConflictFinder::meet_swaps(RobotId other, const ConstrainedTrack& track,
                                std::vector<TrackConflict>& conflicts) const {
    auto own = track_->moves.begin();
    for (const Move& move : track.moves) {
        while (own != track_->moves.end() && own->enter < move.enter) {
            ++own;
        }
        if (own == track_->moves.end()) {
            return;
        }
        // A robot enters one vertex at an instant.
        if (own->enter == move.enter && own->tail == move.head && own->head == move.tail) {
            conflicts.push_back({.robot = {robot_, other},
                                 .constraint = {against_move(problem_, own->edge, move.enter),
                                                against_move(problem_, move.edge, move.enter)}});
        }
    }
}

Rotation find_rotation(const Problem& problem, std::span<const RobotId> robots,
                       std::span<const ConstrainedTrack* const> tracks) {
    struct Mover : Move {
        std::size_t robot;
    };
    std::vector<Mover> movers;
    for (std::size_t k = 0; k < robots.size(); ++k) {
        for (const Move& move : tracks[k]->moves) {
            movers.push_back({move, k});
        }
    }
    const auto is_before = [](const Mover& left, const Mover& right) {
        return std::tuple(left.enter, left.tail) < std::tuple(right.enter, right.tail);
    };
    std::sort(movers.begin(), movers.end(), is_before);
    // At one instant, follow each robot to the one that leaves the vertex that it enters.
    for (const Mover& first : movers) {
        Rotation rotation;
        const Mover* next = &first;
        do {
            rotation.robots.push_back(robots[next->robot]);
            rotation.constraints.push_back(against_move(problem, next->edge, next->enter));
            const Mover wanted{{next->enter, none, next->head, none}, 0};
            const auto place = std::lower_bound(movers.begin(), movers.end(), wanted, is_before);
            const bool is_match =
                place != movers.end() && place->enter == wanted.enter && place->tail == wanted.tail;
            next = is_match ? &*place : nullptr;
        } while (next != nullptr && next != &first && rotation.robots.size() <= robots.size());
        if (next == &first) {
            return rotation;
        }
    }
    return {};
}

}  // namespace rightofway
