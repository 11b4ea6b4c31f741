// Small graphs for the tests of searches, and tables of how far it is from everywhere.
#pragma once

#include <initializer_list>
#include <stdexcept>
#include <utility>
#include <vector>

#include "core/graph.hpp"
#include "distances/distance_tables.hpp"

namespace rightofway::test {

// Vertices 0 .. n - 1, joined both ways.
struct Roads {
    std::vector<EdgeId> indptr{0};
    std::vector<VertexId> heads;

    Roads(VertexId n, std::initializer_list<std::pair<VertexId, VertexId>> joined) {
        for (VertexId v = 0; v < n; ++v) {
            for (const auto& [one, other] : joined) {
                if (one == v || other == v) {
                    heads.push_back(one == v ? other : one);
                }
            }
            indptr.push_back(static_cast<EdgeId>(heads.size()));
        }
    }

    Graph graph() const { return {indptr, heads}; }
    std::vector<std::int32_t> ticks() const { return std::vector<std::int32_t>(heads.size(), 1); }
    std::vector<std::int32_t> table(VertexId target) const {
        return DistanceTables(indptr, heads).to(target, ticks());
    }
};

// 0 - 1 - 2 - 3
inline Roads corridor() { return {4, {{0, 1}, {1, 2}, {2, 3}}}; }

// 0 - 1 - 2, and a bay, 3, at 1
inline Roads corridor_with_bay() { return {4, {{0, 1}, {1, 2}, {1, 3}}}; }

// A corridor of any length.
inline Roads corridor(VertexId n) {
    Roads roads(0, {});
    for (VertexId v = 0; v < n; ++v) {
        for (const VertexId head : {v - 1, v + 1}) {
            if (head >= 0 && head < n) {
                roads.heads.push_back(head);
            }
        }
        roads.indptr.push_back(static_cast<EdgeId>(roads.heads.size()));
    }
    return roads;
}

inline bool no_deadline() { return false; }

// What a user's interrupt does.
inline bool interrupted() { throw std::runtime_error("enough"); }

}  // namespace rightofway::test
