// Small systems for the tests: routes written as lists of vertices, one tick per step unless said
// otherwise. Visits are numbered robot by robot, so the second robot's first visit has the number
// of the first robot's visits.
#pragma once

#include <doctest/doctest.h>

#include <cstdint>
#include <initializer_list>
#include <span>
#include <vector>

#include "precedence/routes.hpp"

namespace rightofway::test {

struct Example {
    std::vector<VisitId> first_visit{0};
    std::vector<VertexId> vertex;
    std::vector<Tick> least;
    std::vector<Tick> approach;
    Tick headway = 0;
    bool swaps_conflict = true;
    std::vector<std::uint8_t> active;

    Example(std::initializer_list<std::vector<VertexId>> routes) {
        for (const std::vector<VertexId>& route : routes) {
            vertex.insert(vertex.end(), route.begin(), route.end());
            first_visit.push_back(static_cast<VisitId>(vertex.size()));
            active.push_back(1);
        }
        least.assign(vertex.size(), 1);
        approach.assign(vertex.size(), 0);
    }

    // A robot books its next vertex as soon as it starts to move.
    Example& book_both() {
        approach.assign(vertex.size(), 1);
        for (const VisitId first : std::span(first_visit).first(active.size())) {
            approach[index(first)] = 0;
        }
        return *this;
    }

    RouteArrays arrays() const {
        return {first_visit, vertex, least, approach, headway, swaps_conflict, active};
    }
    Routes routes() const { return Routes(arrays()); }
};

template <class T>
std::vector<T> listed(std::span<const T> values) {
    return std::vector<T>(values.begin(), values.end());
}

using Ticks = std::vector<Tick>;
using Visits = std::vector<VisitId>;

}  // namespace rightofway::test
