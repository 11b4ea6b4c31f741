#include "cyclic/cyclic_routes.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "core/reject.hpp"

namespace rightofway {
namespace {

// A lap takes no longer than this, so that no sum of laps overflows.
constexpr Tick longest_lap = Tick{1} << 40;

template <class T>
std::vector<T> copy(std::span<const T> source) {
    return std::vector<T>(source.begin(), source.end());
}

void check_lengths(const LapArrays& arrays) {
    const auto& first = arrays.first_place;
    if (first.empty() || first.front() != 0) {
        throw std::invalid_argument("first_place: does not begin with 0");
    }
    for (std::size_t r = 1; r < first.size(); ++r) {
        if (first[r] < first[r - 1] + 2) {
            reject_entry("first_place", r, first[r],
                         "is not 2 above the entry before it (a lap leads away and back)");
        }
    }
    const std::size_t n_places = arrays.vertex.size();
    require_length("vertex", n_places, static_cast<std::size_t>(first.back()));
    require_length("least", arrays.least.size(), n_places);
    require_length("approach", arrays.approach.size(), n_places);
    require_length("first_least", arrays.first_least.size(), first.size() - 1);
    if (arrays.headway < 0 || arrays.headway > longest_lap) {
        reject("headway", arrays.headway, "is not in 0.." + std::to_string(longest_lap));
    }
}

}  // namespace

CyclicRoutes::CyclicRoutes(const LapArrays& arrays)
    : first_place_(copy(arrays.first_place)),
      vertex_(copy(arrays.vertex)),
      least_(copy(arrays.least)),
      approach_(copy(arrays.approach)),
      first_least_(copy(arrays.first_least)),
      headway_(arrays.headway) {
    check_lengths(arrays);
    n_vertices_ = vertex_.empty() ? 0 : *std::max_element(vertex_.begin(), vertex_.end()) + 1;
    for (RobotId r = 0; r < n_robots(); ++r) {
        check(r);
        Tick sum = 0;
        for (const Tick ticks : leasts(r)) {
            within_.push_back(sum);
            sum += ticks;
        }
        within_.push_back(sum);
        if (sum > longest_lap) {
            reject_entry("least", static_cast<std::size_t>(first_place_[r]), sum,
                         "ticks in all make a lap too long (use a larger tick)");
        }
    }
}

void CyclicRoutes::check(RobotId robot) const {
    if (first_least_[robot] <= 0 || first_least_[robot] > longest_lap) {
        reject_entry("first_least", static_cast<std::size_t>(robot), first_least_[robot],
                     "is not positive, or too long");
    }
    for (std::int32_t k = first_place_[robot]; k < first_place_[robot + 1]; ++k) {
        const auto index = static_cast<std::size_t>(k);
        if (vertex_[k] < 0) {
            reject_entry("vertex", index, vertex_[k], "is negative");
        }
        if (least_[k] <= 0 || least_[k] > longest_lap) {
            reject_entry("least", index, least_[k], "is not positive, or too long");
        }
        if (approach_[k] < 0 || approach_[k] > longest_lap) {
            reject_entry("approach", index, approach_[k], "is negative, or too long");
        }
    }
}

Tick CyclicRoutes::unimpeded_enter(CyclicVisit visit) const {
    if (visit.number == 0) {
        return 0;
    }
    const RobotId r = visit.robot;
    const Tick* within = &within_[first_place_[r] + r];
    const Tick later = visit.number / length(r) * within[length(r)] + within[place_in_lap(visit)];
    return later - within[1] + first_least_[r];
}

std::int32_t CyclicRoutes::n_visits_in(CyclicVisit visit, Tick ticks) const {
    const RobotId r = visit.robot;
    const Tick* within = &within_[first_place_[r] + r];
    const std::int32_t place = place_in_lap(visit);
    const Tick until = within[place] + ticks;
    const Tick* end = within + length(r) + 1;
    const auto rest = std::lower_bound(within, end, until % within[length(r)]) - within;
    return static_cast<std::int32_t>(until / within[length(r)] * length(r) + rest) - place;
}

}  // namespace rightofway
