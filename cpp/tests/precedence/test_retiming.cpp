#include <doctest/doctest.h>

#include "fleets.hpp"
#include "precedence/retiming.hpp"

namespace rightofway {
namespace {

using Ticks = std::vector<Tick>;

TEST_CASE("waits that nothing asks for are left out, and work is kept") {
    test::Fleet fleet{test::corridor(), {{0, {{1, 5}, {2}}, 2}}};
    Tracks tracks{{0, 3}, {0, 1, 2}, {0, 10, 20}};
    retime(fleet.problem(), tracks);
    CHECK(tracks.enter == Ticks{0, 2, 9});
}

TEST_CASE("the order at each vertex is kept, with headway and booking ahead") {
    test::Fleet fleet{test::corridor(), {{0, {{2}}, 2}, {1, {{3}}}}, {1, true}};
    Tracks tracks{{0, 3, 6}, {0, 1, 2, 1, 2, 3}, {0, 20, 30, 0, 5, 9}};
    retime(fleet.problem(), tracks);
    // Robot 1 leaves vertex 1 at 1; then headway 1, and two ticks to drive.
    CHECK(tracks.enter == Ticks{0, 4, 6, 0, 1, 2});
}

TEST_CASE("a rotation is brought forward as a whole") {
    const test::Roads ring{3, {{0, 1}, {1, 2}, {2, 0}}};
    test::Fleet fleet{ring, {{0, {{1}}}, {1, {{2}}, 4}, {2, {{0}}, 2}}};
    Tracks tracks{{0, 2, 4, 6}, {0, 1, 1, 2, 2, 0}, {0, 9, 0, 9, 0, 9}};
    retime(fleet.problem(), tracks);
    CHECK(tracks.enter == Ticks{0, 4, 0, 4, 0, 4});
}

TEST_CASE("a robot that comes back to a vertex does not wait for itself") {
    test::Fleet fleet{test::corridor(), {{0, {{1}, {0}}}}};
    Tracks tracks{{0, 3}, {0, 1, 0}, {0, 3, 8}};
    retime(fleet.problem(), tracks);
    CHECK(tracks.enter == Ticks{0, 1, 2});
}

TEST_CASE("a long retiming can be interrupted") {
    test::Fleet fleet{test::corridor(600), {{0, {{599}}}}};
    Tracks tracks{{0, 600}, {}, {}};
    for (VertexId v = 0; v < 600; ++v) {
        tracks.vertex.push_back(v);
        tracks.enter.push_back(2 * v);
    }
    CHECK_THROWS_AS(retime(fleet.problem(), tracks, test::interrupted), std::runtime_error);
}

}  // namespace
}  // namespace rightofway
