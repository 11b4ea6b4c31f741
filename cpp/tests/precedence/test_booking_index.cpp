#include <tuple>

#include "example.hpp"
#include "precedence/booking_index.hpp"

namespace rightofway::test {
namespace {

using Overlap = std::tuple<VisitId, Tick, Tick>;  // with whom, from when, how much

std::vector<Overlap> overlaps(const BookingIndex& index, VisitId visit) {
    std::vector<Overlap> found;
    index.for_each_overlap(visit, [&](const BookingIndex::Slot& other, Tick tick, Tick weight) {
        found.emplace_back(other.visit, tick, weight);
    });
    return found;
}

// Vertex 7 is visited by 0 and 2 of the first robot, 3 of the second and 4 of the third.
BookingIndex at_seven() {
    const Routes routes = Example({{7, 1, 7}, {7}, {7, 1}}).routes();
    return BookingIndex(routes);
}

TEST_CASE("bookings of one vertex by different robots overlap in the ticks they share") {
    BookingIndex index = at_seven();
    index.set(0, {0, 10});
    index.set(3, {4, 6});
    index.set(4, {9, 30});
    CHECK(overlaps(index, 0) == std::vector<Overlap>{{3, 4, 2}, {4, 9, 1}});
    CHECK(overlaps(index, 3) == std::vector<Overlap>{{0, 4, 2}});
}

TEST_CASE("bookings that only touch do not overlap") {
    BookingIndex index = at_seven();
    index.set(0, {0, 4});
    index.set(3, {4, 6});
    CHECK(overlaps(index, 0).empty());
}

TEST_CASE("a robot never disturbs itself") {
    BookingIndex index = at_seven();
    index.set(0, {0, 10});
    index.set(2, {5, never});
    CHECK(overlaps(index, 0).empty());
}

TEST_CASE("an overlap without end counts a large constant, whenever it begins") {
    BookingIndex index = at_seven();
    index.set(2, {3, never});
    index.set(3, {5, never});
    CHECK(overlaps(index, 2) == std::vector<Overlap>{{3, 5, conflict_cap}});
}

TEST_CASE("a visit without a booking overlaps nothing, not even a booking without end") {
    BookingIndex index = at_seven();
    index.set(2, {3, never});
    CHECK(index.booking(3).is_empty());
    CHECK(overlaps(index, 3).empty());
    CHECK(overlaps(index, 2).empty());
}

TEST_CASE("pairs of visits of different robots are counted vertex by vertex") {
    // Four visits at 7, of which two belong to the first robot; two visits at 1.
    CHECK(at_seven().n_pairs() == 6 - 1 + 1);
}

}  // namespace
}  // namespace rightofway::test
