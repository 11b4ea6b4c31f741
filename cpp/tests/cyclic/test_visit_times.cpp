#include <doctest/doctest.h>

#include <vector>

#include "cyclic/visit_times.hpp"

namespace rightofway {
namespace {

using Ticks = std::vector<Tick>;

TEST_CASE("past enters follow from the visits that had to wait") {
    // A robot that drives from 0 over 1 to 2 and back: a tick for each edge, and one for each turn.
    const std::vector<std::int32_t> first_place{0, 4};
    const std::vector<VertexId> vertex{0, 1, 2, 1};
    const Ticks least{2, 1, 2, 1};
    const Ticks approach(vertex.size(), 0);
    const Ticks first_least{1};
    const CyclicRoutes routes{{first_place, vertex, least, approach, first_least, 0}};
    VisitTimes waits{routes};
    for (const Tick tick : {1, 5, 7, 8, 10, 14}) {
        waits.add(0, tick);
    }
    CHECK(waits.enter({0, 5}) == 10);
    CHECK(waits.enter({0, 6}) == 14);
    CHECK(waits.late(0).size() == 2);
    waits.truncate(0, 6);
    waits.add(0, 11);
    CHECK(waits.enter({0, 6}) == 11);
    CHECK(waits.late(0).size() == 1);
}

}  // namespace
}  // namespace rightofway
