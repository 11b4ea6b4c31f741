#include "precedence/incompatible_visits.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>

#include "core/excluded_rows.hpp"
#include "core/reject.hpp"

namespace rightofway {
namespace {

// 2^28 pairs take 2 GB.
constexpr std::size_t most_incompatible_pairs = std::size_t{1} << 28;

struct BookedBy {
    VisitId visit;
    std::uint8_t is_edge;
};

}  // namespace

IncompatibleVisits::IncompatibleVisits(std::span<const RobotId> robot, const BookedRows& rows) {
    if (rows.lists.is_identity()) {
        return;
    }
    const auto n_visits = static_cast<VisitId>(robot.size());
    const std::int32_t n_rows = rows.lists.n_rows();
    require_length("vertex_row", rows.vertex.size(), robot.size());
    require_length("edge_row", rows.edge.size(), robot.size());
    require_ranges("vertex_row", rows.vertex, none, n_rows - 1);
    require_ranges("edge_row", rows.edge, none, n_rows - 1);
    for (std::size_t x = 0; x < robot.size(); ++x) {
        const bool is_last = x + 1 == robot.size() || robot[x + 1] != robot[x];
        if (is_last && rows.edge[x] != none) {
            reject_entry("edge_row", x, rows.edge[x],
                         "must be -1: no edge is driven out of a last visit");
        }
    }
    std::unordered_map<std::int32_t, std::vector<BookedBy>> booked;  // few of all rows
    const auto rows_of = [&](VisitId x) {
        return std::array{rows.vertex[index(x)], rows.edge[index(x)]};
    };
    for (VisitId x = 0; x < n_visits; ++x) {
        for (std::uint8_t is_edge = 0; is_edge < 2; ++is_edge) {
            if (rows_of(x)[is_edge] != none) {
                booked[rows_of(x)[is_edge]].push_back({x, is_edge});
            }
        }
    }
    first_.reserve(robot.size() + 1);
    first_.push_back(0);
    std::vector<IncompatibleVisit> found;
    for (VisitId x = 0; x < n_visits; ++x) {
        found.clear();
        for (std::uint8_t is_edge = 0; is_edge < 2; ++is_edge) {
            const std::int32_t row = rows_of(x)[is_edge];
            if (row == none) {
                continue;
            }
            for (const std::int32_t excluded : rows.lists.of(row)) {
                const auto there = booked.find(excluded);
                if (there == booked.end()) {
                    continue;
                }
                for (const BookedBy& other : there->second) {
                    if (robot[index(other.visit)] != robot[index(x)]) {
                        found.push_back({other.visit, {}});
                        found.back().bookings.add(is_edge != 0, other.is_edge != 0);
                    }
                }
            }
        }
        std::sort(found.begin(), found.end(),
                  [](const auto& left, const auto& right) { return left.visit < right.visit; });
        for (const IncompatibleVisit& one : found) {
            if (others_.size() > first_.back() && others_.back().visit == one.visit) {
                others_.back().bookings.add(one.bookings);
            } else {
                others_.push_back(one);
            }
        }
        first_.push_back(others_.size());
        if (others_.size() > most_incompatible_pairs) {
            throw std::overflow_error("robots: more than " +
                                      std::to_string(most_incompatible_pairs) +
                                      " pairs of their visits are too near to each other (plan "
                                      "fewer laps or fewer robots at once)");
        }
    }
}

}  // namespace rightofway
