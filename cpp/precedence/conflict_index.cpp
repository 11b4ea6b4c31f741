#include "precedence/conflict_index.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace rightofway {
namespace {

// Each pair of visits at one vertex counts at most `conflict_cap` and one swap: 2^30 pairs stay
// well within 2^63.
constexpr std::int64_t most_pairs = std::int64_t{1} << 30;

Booking booked(VisitId visit, const Routes& routes, const Timetable& timetable) {
    const Tick start = timetable.enter(visit) - routes.approach(visit);
    const Tick end = routes.is_last(visit) ? never : timetable.leave(visit) + routes.headway();
    return {start, end};
}

constexpr auto any_robot = [](RobotId) { return true; };

}  // namespace

ConflictIndex::ConflictIndex(const Routes& routes)
    : routes_(routes), bookings_(routes), moves_(routes) {
    if (bookings_.n_pairs() > most_pairs) {
        throw std::overflow_error("robots: " + std::to_string(bookings_.n_pairs()) +
                                  " pairs of their visits share a vertex, more than " +
                                  std::to_string(most_pairs) +
                                  " cannot be counted (plan fewer laps or fewer robots at once)");
    }
}

Tick ConflictIndex::add(VisitId visit, const Timetable& timetable) {
    if (!bookings_.booking(visit).is_empty()) {
        return 0;
    }
    move(visit, timetable);
    return weight(visit);
}

Tick ConflictIndex::remove(VisitId visit) {
    const Tick removed = weight(visit);
    bookings_.set(visit, no_booking);
    moves_.clear(visit);
    return removed;
}

void ConflictIndex::move(VisitId visit, const Timetable& timetable) {
    if (routes_.is_active(routes_.robot(visit))) {
        bookings_.set(visit, booked(visit, routes_, timetable));
        moves_.set(visit, timetable.enter(visit));
    }
}

template <class Accept>
Tick ConflictIndex::weight_where(VisitId visit, Accept&& accept) const {
    Tick total = 0;
    const auto count = [&](const auto& other, Tick, Tick weight) {
        total += accept(other.robot) ? weight : 0;
    };
    bookings_.for_each_overlap(visit, count);
    moves_.for_each_swap(visit, count);
    return total;
}

Tick ConflictIndex::weight(VisitId visit) const { return weight_where(visit, any_robot); }

Tick ConflictIndex::weight(VisitId visit, std::span<const std::uint8_t> mask) const {
    return weight_where(visit, [mask](RobotId robot) { return mask[robot] != 0; });
}

template <class Accept>
std::optional<Conflict> ConflictIndex::earliest_where(VisitId visit, Accept&& accept) const {
    std::optional<Conflict> best;
    const auto consider = [&](ConflictKind kind) {
        return [&, kind](const auto& other, Tick tick, Tick) {
            if (accept(other.robot) && (!best || tick <= best->tick)) {
                const Conflict found = conflict(visit, other.visit, tick, kind);
                best = best ? std::min(*best, found) : found;
            }
        };
    };
    bookings_.for_each_overlap(visit, consider(ConflictKind::vertex));
    moves_.for_each_swap(visit, consider(ConflictKind::swap));
    return best;
}

std::optional<Conflict> ConflictIndex::earliest(VisitId visit) const {
    return earliest_where(visit, any_robot);
}

std::optional<Conflict> ConflictIndex::earliest(VisitId visit, RobotId other) const {
    return earliest_where(visit, [other](RobotId robot) { return robot == other; });
}

Conflict ConflictIndex::conflict(VisitId visit, VisitId other, Tick tick, ConflictKind kind) const {
    const auto [a, b] = std::minmax(visit, other);  // visits are numbered robot by robot
    return {tick, routes_.robot(a), routes_.robot(b), a, b, kind};
}

}  // namespace rightofway
