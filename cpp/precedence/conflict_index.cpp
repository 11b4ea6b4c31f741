#include "precedence/conflict_index.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace rightofway {
namespace {

// A pair of visits at one vertex weighs at most `conflict_cap` plus one swap: 2^30 pairs stay far
// below 2^63.
constexpr std::int64_t most_pairs = std::int64_t{1} << 30;

template <class Accept>
std::vector<VisitId> visits_where(const Routes& routes, Accept&& accept) {
    std::vector<VisitId> visits;
    for (VisitId x = 0; x < routes.n_visits(); ++x) {
        if (accept(x)) {
            visits.push_back(x);
        }
    }
    return visits;
}

constexpr auto any_robot = [](RobotId) { return true; };

}  // namespace

// Vertex ids may be sparse: ids are compared, never used as indices.
template <class Value>
template <class Key, class OtherKey>
ConflictIndex::Groups<Value>::Groups(const Routes& routes, std::vector<VisitId> visits, Key key,
                                     OtherKey other_key)
    : slot_of(static_cast<std::size_t>(routes.n_visits()), none) {
    std::stable_sort(visits.begin(), visits.end(),
                     [&](VisitId left, VisitId right) { return key(left) < key(right); });
    const auto place = [&](auto visit) {
        return static_cast<std::int32_t>(visit - visits.begin());
    };
    for (const VisitId x : visits) {
        const auto begin = std::partition_point(
            visits.begin(), visits.end(), [&, k = other_key(x)](VisitId y) { return key(y) < k; });
        const auto end = std::partition_point(
            begin, visits.end(), [&, k = other_key(x)](VisitId y) { return !(k < key(y)); });
        const RobotId robot = routes.robot(x);
        const auto own =
            std::partition_point(begin, end, [&](VisitId y) { return routes.robot(y) < robot; });
        const auto own_end =
            std::partition_point(own, end, [&](VisitId y) { return routes.robot(y) == robot; });
        slot_of[index(x)] = static_cast<std::int32_t>(slots.size());
        slots.push_back({Value{}, x, robot});
        others.push_back({place(begin), place(own), place(own_end), place(end)});
    }
}

ConflictIndex::ConflictIndex(const Routes& routes)
    : routes_(routes),
      stays_(
          routes, visits_where(routes, [](VisitId) { return true; }),
          [&](VisitId x) { return routes.vertex(x); }, [&](VisitId x) { return routes.vertex(x); }),
      enters_(
          routes, visits_where(routes, [&](VisitId x) { return routes.may_swap(x); }),
          [&](VisitId x) { return std::pair(routes.vertex(x - 1), routes.vertex(x)); },
          [&](VisitId x) { return std::pair(routes.vertex(x), routes.vertex(x - 1)); }) {
    for (auto& slot : enters_.slots) {
        slot.value = never;
    }
    std::int64_t n_pairs = 0;
    for (const auto& range : stays_.others) {
        n_pairs += range.end - range.own_end;  // each pair of visits once
    }
    if (n_pairs > most_pairs) {
        throw std::overflow_error("robots: " + std::to_string(n_pairs) +
                                  " pairs of their visits share a vertex, more than " +
                                  std::to_string(most_pairs) +
                                  " cannot be counted (plan fewer laps or fewer robots at once)");
    }
}

Tick ConflictIndex::add(VisitId visit, const Timetable& timetable) {
    if (stay(visit).starts[0] != never) {
        return 0;
    }
    move(visit, timetable);
    return weight(visit);
}

Tick ConflictIndex::remove(VisitId visit) {
    const Tick removed = weight(visit);
    *stays_.find(visit) = {};
    if (Tick* const enter = enters_.find(visit)) {
        *enter = never;
    }
    return removed;
}

void ConflictIndex::move(VisitId visit, const Timetable& timetable) {
    if (!routes_.is_active(routes_.robot(visit))) {
        return;
    }
    Stay& stay = *stays_.find(visit);
    stay.starts[0] = timetable.enter(visit) - routes_.approach(visit);
    if (!routes_.is_last(visit)) {
        stay.starts[1] = timetable.leave(visit) - routes_.approach(visit + 1);
        stay.end = timetable.leave(visit) + routes_.headway();
    }
    if (Tick* const enter = enters_.find(visit)) {
        *enter = timetable.enter(visit);
    }
}

template <class Use>
void ConflictIndex::for_each_conflict(VisitId visit, Use&& use) const {
    if (routes_.has_sizes()) {
        for (const IncompatibleVisit& other : routes_.incompatible(visit)) {
            const Stay& own = stay(visit);
            const Stay& its = stay(other.visit);
            const Tick begin = other.bookings.begin(own.starts, its.starts);
            if (const Tick weight = overlap({begin, own.end}, {begin, its.end}); weight > 0) {
                use(Other{other.visit, routes_.robot(other.visit)}, begin, weight,
                    ConflictKind::vertex);
            }
        }
        return;
    }
    const Booking own = stay(visit).booking();
    stays_.for_each_other(visit, [&](const auto& other) {
        const Booking its = other.value.booking();
        if (const Tick weight = overlap(own, its); weight > 0) {
            use(other, std::max(own.start, its.start), weight, ConflictKind::vertex);
        }
    });
    if (enters_.slot_of[index(visit)] == none) {
        return;
    }
    const Tick enter = enters_.slots[index(enters_.slot_of[index(visit)])].value;
    enters_.for_each_other(visit, [&](const auto& other) {
        if (other.value == enter && enter != never) {
            use(other, enter, swap_weight, ConflictKind::swap);
        }
    });
}

template <class Accept>
Tick ConflictIndex::weight_where(VisitId visit, Accept&& accept) const {
    Tick total = 0;
    for_each_conflict(visit, [&](const auto& other, Tick, Tick weight, ConflictKind) {
        total += accept(other.robot) ? weight : 0;
    });
    return total;
}

Tick ConflictIndex::weight(VisitId visit) const { return weight_where(visit, any_robot); }

Tick ConflictIndex::weight(VisitId visit, std::span<const std::uint8_t> mask) const {
    return weight_where(visit, [mask](RobotId robot) { return mask[index(robot)] != 0; });
}

template <class Accept>
std::optional<Conflict> ConflictIndex::earliest_where(VisitId visit, Accept&& accept) const {
    std::optional<Conflict> best;
    for_each_conflict(visit, [&](const auto& other, Tick tick, Tick, ConflictKind kind) {
        if (accept(other.robot) && (!best || tick <= best->tick)) {
            const auto [a, b] = std::minmax(visit, other.visit);  // numbered robot by robot
            const Conflict found{tick, routes_.robot(a), routes_.robot(b), a, b, kind};
            best = best ? std::min(*best, found) : found;
        }
    });
    return best;
}

std::optional<Conflict> ConflictIndex::earliest(VisitId visit) const {
    return earliest_where(visit, any_robot);
}

std::optional<Conflict> ConflictIndex::earliest(VisitId visit, RobotId other) const {
    return earliest_where(visit, [other](RobotId robot) { return robot == other; });
}

}  // namespace rightofway
