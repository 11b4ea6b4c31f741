#include <doctest/doctest.h>

#include <stdexcept>
#include <vector>

#include "precedence/timetable.hpp"
#include "precedence/visit_closures.hpp"

namespace rightofway {
namespace {

using Ints = std::vector<std::int32_t>;
using Ticks = std::vector<Tick>;

// Three visits of a robot, each 4 ticks after the one before; headway 1. The vertex of visit 1 is
// closed from 6 to 9, the edge into visit 2 from 10 to 12 and from 14 on.
struct Line {
    Ints first_closed{0, 0, 0, 1, 1, 1, 3};
    Ticks from{6, 10, 14};
    Ticks until{9, 12, never};
    Ticks drive{0, 4, 4};

    VisitClosureArrays closures() const { return {first_closed, from, until, drive}; }
    Routes routes() const {
        static const Ints first{0, 3};
        static const Ints vertex{0, 1, 2};
        static const Ticks least{4, 4, 0};
        static const Ticks approach{0, 0, 0};
        static const std::vector<std::uint8_t> active{1};
        return Routes({first, vertex, least, approach, 1, true, active, {}, closures()});
    }
};

TEST_CASE("a booking starts at the end of the closures that it overlaps") {
    const VisitClosures closed(Line{}.closures(), 3);
    CHECK(closed.free_at(1, 2, 6) == 2);  // ends as the closure begins
    CHECK(closed.free_at(1, 2, 7) == 9);
    CHECK(closed.free_at(1, 9, never) == 9);
    CHECK(closed.free_at(0, 0, never) == 0);  // nothing is closed
    CHECK(closed.free_along(2, 5, 5) == 5);
    CHECK(closed.free_along(2, 6, 5) == never);  // too long for the time from 12 to 14
    CHECK(closed.free_along(2, 6, 2) == 6);
    CHECK(closed.free_along(2, 9, 2) == 12);
    CHECK(closed.free_stay(1, 5, 2) == 9);
}

TEST_CASE("arrays that do not fit together are refused") {
    Line line;
    line.until[0] = 6;
    CHECK_THROWS_WITH(VisitClosures(line.closures(), 3),
                      "closed_until[0]: 6 is not after closed_from");
    CHECK_THROWS_AS(VisitClosures(Line{}.closures(), 2), std::invalid_argument);
}

TEST_CASE("a timetable keeps clear of closures, or there is none") {
    Line line;  // visit 1 is at its vertex from 4 to 9, headway included
    CHECK_THROWS_AS(Timetable(line.routes()), std::invalid_argument);
    line.from[2] = 40;
    line.until[2] = 50;
    const Routes routes = line.routes();
    const Timetable timetable(routes);
    CHECK(timetable.enter(1) == 9);   // after the closure of its vertex
    CHECK(timetable.enter(2) == 16);  // the drive from 9 to 13 would meet that from 10 to 12
}

}  // namespace
}  // namespace rightofway
