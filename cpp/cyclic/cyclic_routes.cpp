#include "cyclic/cyclic_routes.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "core/reject.hpp"

namespace rightofway {
namespace {

// Upper limit of a lap in ticks, so that no sum of laps overflows.
constexpr Tick longest_lap = Tick{1} << 40;

// The most visits of one robot in a window: 2^24 of them take about 1 GB.
constexpr Tick most_visits = Tick{1} << 24;
constexpr Tick longest_window = Tick{1} << 56;

void check_lengths(const LapArrays& arrays) {
    const auto& first = arrays.first_place;
    const std::size_t n_places = arrays.vertex.size();
    for (std::size_t r = 1; r < first.size(); ++r) {
        if (std::int64_t{first[r]} < std::int64_t{first[r - 1]} + 2) {
            reject_entry("first_place", r, first[r],
                         "is not 2 above the entry before it (a lap leads away and back)");
        }
    }
    require_lists("first_place", first, n_places, "places");
    require_length("least", arrays.least.size(), n_places);
    require_length("approach", arrays.approach.size(), n_places);
    require_length("first_least", arrays.first_least.size(), first.size() - 1);
    if (arrays.headway < 0 || arrays.headway > longest_lap) {
        reject("headway", arrays.headway, "is not in 0.." + std::to_string(longest_lap));
    }
}

}  // namespace

CyclicRoutes::CyclicRoutes(const LapArrays& arrays)
    : first_place_(arrays.first_place.begin(), arrays.first_place.end()),
      vertex_(arrays.vertex.begin(), arrays.vertex.end()),
      least_(arrays.least.begin(), arrays.least.end()),
      approach_(arrays.approach.begin(), arrays.approach.end()),
      first_least_(arrays.first_least.begin(), arrays.first_least.end()),
      headway_(arrays.headway),
      vertex_row_(arrays.vertex_row.begin(), arrays.vertex_row.end()),
      edge_row_(arrays.edge_row.begin(), arrays.edge_row.end()),
      lists_(arrays.lists) {
    check_lengths(arrays);
    if (books_edges()) {
        check_rows();
    }
    for (RobotId r = 0; r < n_robots(); ++r) {
        check(r);
    }
    number_vertices();
    for (RobotId r = 0; r < n_robots(); ++r) {
        Tick sum = 0;
        for (const Tick ticks : leasts(r)) {
            within_.push_back(sum);
            sum += ticks;
        }
        within_.push_back(sum);
        if (sum > longest_lap) {
            reject_entry("least", index(first_place_[index(r)]), sum,
                         "ticks in all make a lap too long (use a larger tick)");
        }
    }
}

void CyclicRoutes::check(RobotId robot) const {
    if (first_least_[index(robot)] <= 0 || first_least_[index(robot)] > longest_lap) {
        reject_entry("first_least", index(robot), first_least_[index(robot)],
                     "is not positive, or too long");
    }
    for (std::int32_t k = first_place_[index(robot)]; k < first_place_[index(robot + 1)]; ++k) {
        const std::size_t at = index(k);
        if (vertex_[at] < 0) {
            reject_entry("vertex", at, vertex_[at], "is negative");
        }
        if (least_[at] <= 0 || least_[at] > longest_lap) {
            reject_entry("least", at, least_[at], "is not positive, or too long");
        }
        if (approach_[at] < 0 || approach_[at] > longest_lap) {
            reject_entry("approach", at, approach_[at], "is negative, or too long");
        }
    }
}

// The ids may be sparse; memory goes by the vertices visited.
void CyclicRoutes::number_vertices() {
    id_.assign(vertex_.begin(), vertex_.end());
    std::sort(id_.begin(), id_.end());
    id_.erase(std::unique(id_.begin(), id_.end()), id_.end());
    for (VertexId& vertex : vertex_) {
        vertex =
            static_cast<VertexId>(std::lower_bound(id_.begin(), id_.end(), vertex) - id_.begin());
    }
}

void CyclicRoutes::check_rows() const {
    require_length("vertex_row", vertex_row_.size(), vertex_.size());
    require_length("edge_row", edge_row_.size(), vertex_.size());
    require_ids("vertex_row", vertex_row_, n_rows());
    require_ids("edge_row", edge_row_, n_rows());
}

bool CyclicRoutes::excludes(std::int32_t row, std::int32_t other) const {
    if (row == none) {
        return false;
    }
    const auto rows = excluded(row);
    return rows.size() == 1 ? rows.front() == other
                            : std::binary_search(rows.begin(), rows.end(), other);
}

std::optional<IncompatiblePair> CyclicRoutes::incompatible(CyclicVisit i, bool i_leaves,
                                                           CyclicVisit j, bool j_leaves) const {
    if (excludes(vertex_row(i), vertex_row(j))) {  // starts before all else, ends with it
        return IncompatiblePair{i, j, ExcludingBookings::vertices()};
    }
    IncompatiblePair pair{i, j, {}};
    if (j_leaves && excludes(vertex_row(i), edge_row(j))) {
        pair.bookings.add(false, true);
    }
    if (i_leaves && excludes(edge_row(i), vertex_row(j))) {
        pair.bookings.add(true, false);
    }
    if (i_leaves && j_leaves && excludes(edge_row(i), edge_row(j))) {
        pair.bookings.add(true, true);
    }
    return pair.bookings.empty() ? std::nullopt : std::optional(pair);
}

Tick CyclicRoutes::unimpeded_enter(CyclicVisit visit) const {
    if (visit.number == 0) {
        return 0;
    }
    const RobotId r = visit.robot;
    const Tick* within = &within_[index(first_place_[index(r)] + r)];
    const Tick later = visit.number / length(r) * within[length(r)] + within[place_in_lap(visit)];
    return later - within[1] + first_least_[index(r)];
}

std::int32_t CyclicRoutes::n_visits_in(CyclicVisit visit, Tick ticks) const {
    const RobotId r = visit.robot;
    const Tick* within = &within_[index(first_place_[index(r)] + r)];
    const std::int32_t place = place_in_lap(visit);
    if (ticks > longest_window || ticks / within[length(r)] > most_visits / length(r)) {
        throw std::overflow_error("lag: the laps of robot " + std::to_string(r) + " in " +
                                  std::to_string(ticks) + " ticks are more than " +
                                  std::to_string(most_visits) + " visits (use a shorter lag)");
    }
    const Tick until = within[place] + ticks;
    const Tick* end = within + length(r) + 1;
    const auto rest = std::lower_bound(within, end, until % within[length(r)]) - within;
    return static_cast<std::int32_t>(until / within[length(r)] * length(r) + rest) - place;
}

}  // namespace rightofway
