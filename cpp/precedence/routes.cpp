#include "precedence/routes.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

#include "core/reject.hpp"

namespace rightofway {
namespace {

// An earliest time is the length of a path with each visit at most once, so no time exceeds the sum
// of all durations. The limit is far below `never`: sums of two times never overflow.
constexpr Tick horizon = Tick{1} << 60;

void check_first_visit(std::span<const VisitId> first_visit, std::size_t n_visits) {
    if (first_visit.empty()) {
        throw std::invalid_argument("first_visit: its length is 0, but must be at least 1");
    }
    if (first_visit.front() != 0) {
        reject_entry("first_visit", 0, first_visit.front(), "must be 0");
    }
    for (std::size_t r = 1; r < first_visit.size(); ++r) {
        if (first_visit[r] <= first_visit[r - 1]) {
            reject_entry("first_visit", r, first_visit[r],
                         "is not above the entry before it (every robot has a visit)");
        }
    }
    if (static_cast<std::size_t>(first_visit.back()) != n_visits) {
        reject_entry("first_visit", first_visit.size() - 1, first_visit.back(),
                     "is not the number of visits, " + std::to_string(n_visits));
    }
}

void check_lengths(const RouteArrays& arrays) {
    const std::size_t n_visits = arrays.vertex.size();
    if (n_visits > static_cast<std::size_t>(std::numeric_limits<VisitId>::max())) {
        throw std::invalid_argument("vertex: more visits than int32 can number");
    }
    check_first_visit(arrays.first_visit, n_visits);
    require_length("least", arrays.least.size(), n_visits);
    require_length("approach", arrays.approach.size(), n_visits);
    require_length("active", arrays.active.size(), arrays.first_visit.size() - 1);
    if (arrays.headway < 0 || arrays.headway > horizon) {
        reject("headway", arrays.headway, "is not in 0.." + std::to_string(horizon));
    }
}

}  // namespace

Routes::Routes(const RouteArrays& arrays)
    : first_visit_(arrays.first_visit.begin(), arrays.first_visit.end()),
      vertex_(arrays.vertex.begin(), arrays.vertex.end()),
      least_(arrays.least.begin(), arrays.least.end()),
      approach_(arrays.approach.begin(), arrays.approach.end()),
      headway_(arrays.headway),
      swaps_conflict_(arrays.swaps_conflict),
      active_(arrays.active.begin(), arrays.active.end()) {
    check_lengths(arrays);
    number_robots();
    for (RobotId r = 0; r < n_robots(); ++r) {
        check_robot(r);
    }
    check_horizon();
    incompatible_ = IncompatibleVisits(robot_, arrays.rows);
    closures_ = VisitClosures(arrays.closures, vertex_.size());
}

void Routes::number_robots() {
    robot_.resize(vertex_.size());
    longest_approach_.resize(active_.size());
    for (RobotId r = 0; r < n_robots(); ++r) {
        const VisitId first = first_of(r);
        const VisitId end = last_of(r) + 1;
        std::fill(robot_.begin() + first, robot_.begin() + end, r);
        longest_approach_[index(r)] =
            *std::max_element(approach_.begin() + first, approach_.begin() + end);
    }
}

void Routes::check_robot(RobotId robot) const {
    for (VisitId x = first_of(robot); x <= last_of(robot); ++x) {
        if (vertex_[index(x)] < 0) {
            reject_entry("vertex", index(x), vertex_[index(x)], "is negative");
        }
        if (!is_first(x) && vertex_[index(x)] == vertex_[index(x - 1)]) {
            reject_entry("vertex", index(x), vertex_[index(x)],
                         "is the vertex of the visit before it (make them one visit)");
        }
        if (!is_last(x) && least_[index(x)] <= 0) {
            reject_entry("least", index(x), least_[index(x)], "is not positive");
        }
        if (approach_[index(x)] < 0) {
            reject_entry("approach", index(x), approach_[index(x)], "is negative");
        }
        if (is_first(x) && approach_[index(x)] != 0) {
            reject_entry("approach", index(x), approach_[index(x)], "must be 0 on a first visit");
        }
    }
}

void Routes::check_horizon() const {
    Tick left = horizon;
    for (VisitId x = 0; x < n_visits(); ++x) {
        const Tick least = is_last(x) ? 0 : least_[index(x)];
        for (const Tick duration : {least, headway_, approach_[index(x)]}) {
            if (duration > left) {
                reject_entry("least", index(x), least_[index(x)],
                             "and the durations before it add up beyond 2^60 (use a larger tick)");
            }
            left -= duration;
        }
    }
}

}  // namespace rightofway
