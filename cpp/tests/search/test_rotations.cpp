#include <doctest/doctest.h>

#include <vector>

#include "search/rotations.hpp"

namespace rightofway {
namespace {

// A ring of four vertices, driven both ways.
struct Ring {
    std::vector<EdgeId> indptr{0, 2, 4, 6, 8};
    std::vector<VertexId> heads{1, 3, 2, 0, 3, 1, 0, 2};
    BookingTable table{4};
    Graph graph{indptr, heads};

    // A robot drives from one vertex to another at a tick.
    void move(RobotId robot, VertexId tail, VertexId head, Tick tick) {
        table.insert(tail, {0, tick}, robot);
        table.insert(head, {tick, never}, robot);
    }
    RobotId ahead(const InstantMove& move) const {
        return find_rotation_ahead(graph, table, 0, move);
    }
};

TEST_CASE("a move that closes a circle of three others names the robot ahead of it") {
    Ring ring;
    ring.move(5, 1, 2, 4);
    ring.move(6, 2, 3, 4);
    ring.move(7, 3, 0, 4);
    CHECK(ring.ahead({0, 1, 4}) == 5);
    CHECK(ring.ahead({0, 1, 4, 6}) == nobody);  // without the bookings of one of them
    CHECK(ring.ahead({0, 1, 5}) == nobody);     // at another instant
}

TEST_CASE("a queue, and a robot that comes the other way, close no circle") {
    Ring queue;
    queue.move(5, 1, 2, 4);
    queue.move(6, 2, 3, 4);
    CHECK(queue.ahead({0, 1, 4}) == nobody);
    Ring swap;
    swap.move(5, 1, 0, 4);
    CHECK(swap.ahead({0, 1, 4}) == nobody);
}

TEST_CASE("a circle of others without the robot ends the walk") {
    Ring ring;
    ring.move(5, 1, 2, 4);
    ring.move(6, 2, 1, 4);
    CHECK(ring.ahead({0, 1, 4}) == nobody);
}

}  // namespace
}  // namespace rightofway
