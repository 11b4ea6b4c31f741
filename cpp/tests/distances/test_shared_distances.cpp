#include <doctest/doctest.h>

#include "crossing.hpp"
#include "distances/shared_distances.hpp"

namespace rightofway {
namespace {

using test::Crossing;

TEST_CASE("a robot alone needs the way there in its own ticks") {
    const Crossing crossing(5);
    const Problem problem(crossing.arrays(), {0, false});
    SharedDistances distances(problem);
    CHECK(distances.alone(0) == 4);
    CHECK(distances.alone(1) == 12);
    CHECK(problem.drive(1, 0, 1) == 3);
    CHECK(problem.drive(1, 0, 7) == -1);
}

TEST_CASE("tables are shared, narrow where edges are alike, and forgotten when memory is short") {
    const Crossing crossing(5);
    const Problem problem(crossing.arrays(), {});
    const RobotId slow = 1;
    SharedDistances distances(problem, 120);
    const auto first = distances.to(0, slow);
    CHECK(first->bytes() == 50);
    CHECK(first->view(distances.scale(slow)).from(24) == 24);
    CHECK(distances.to(0, slow) == first);
    distances.to(1, slow);
    distances.to(2, slow);
    CHECK(distances.to(0, slow) != first);
    CHECK(first->view(3).from(1) == 3);
}

TEST_CASE("where edges differ, a table is for one pace") {
    Crossing crossing(3);
    crossing.classes.front() = 1;  // from 0 to 1
    crossing.paces = {1, 9, 2, 9};
    crossing.n_classes = 2;
    const Problem problem(crossing.arrays(), {});
    SharedDistances distances(problem);
    CHECK(distances.to(1, 0)->view(distances.scale(0)).from(0) == 3);
    CHECK(distances.to(1, 1)->view(distances.scale(1)).from(0) == 6);
}

}  // namespace
}  // namespace rightofway
