// Roadmaps drawn on whole numbers for the tests of robots with sizes, and the rows that exclude
// each other on them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/row_finder.hpp"

namespace rightofway::test {

// Rows are the vertices, then the lanes in their order; robots have one size.
struct DrawnLanes {
    std::vector<EdgeId> indptr{0};
    std::vector<VertexId> heads;
    std::vector<double> x;
    std::vector<double> y;
    std::vector<std::uint32_t> limbs;
    std::vector<double> distance;
    std::vector<std::uint32_t> distance_limbs;

    // Lanes are given from tail to head, by rising tails.
    DrawnLanes(const std::vector<std::pair<std::uint32_t, std::uint32_t>>& places,
               const std::vector<std::pair<VertexId, VertexId>>& lanes, std::uint32_t apart)
        : distance{static_cast<double>(apart)}, distance_limbs{apart} {
        for (const auto& [right, up] : places) {
            x.push_back(right);
            y.push_back(up);
            limbs.insert(limbs.end(), {right, up});
            const auto tail = static_cast<VertexId>(indptr.size()) - 1;
            for (const auto& lane : lanes) {
                if (lane.first == tail) {
                    heads.push_back(lane.second);
                }
            }
            indptr.push_back(static_cast<EdgeId>(heads.size()));
        }
    }

    RowFinder finder() const {
        return RowFinder({{indptr, heads}, x, y, limbs, 1, distance, distance_limbs});
    }
};

// Two lanes that cross, A-B and C-D: rows 0 to 3 are the vertices A to D, rows 4 to 7 the edges
// A-B, B-A, C-D and D-C.
inline DrawnLanes crossing_lanes() {
    return {{{0, 20}, {40, 20}, {20, 0}, {20, 40}}, {{0, 1}, {1, 0}, {2, 3}, {3, 2}}, 10};
}

}  // namespace rightofway::test
