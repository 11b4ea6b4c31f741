#include <doctest/doctest.h>

#include <numeric>
#include <string>
#include <vector>

#include "crossing.hpp"
#include "lns/fleet_search.hpp"

namespace rightofway {
namespace {

using test::Crossing;
using test::no_deadline;

std::vector<RobotId> all_robots(const Problem& problem) {
    std::vector<RobotId> order(static_cast<std::size_t>(problem.n_robots()));
    std::iota(order.begin(), order.end(), 0);
    return order;
}

GivenTracks given(const Tracks& tracks) {
    return {tracks.first_visit, tracks.vertex, tracks.enter};
}

template <class Call>
std::string fault_of(const Call& call) {
    try {
        call();
    } catch (const std::invalid_argument& fault) {
        return fault.what();
    }
    return "";
}

TEST_CASE("a plan is made, improved, given to another search, and restored there") {
    const Crossing crossing(6);
    const Problem problem(crossing.arrays(), {0, false});
    FleetSearch first(problem, 1, 1);
    REQUIRE(first.prioritize(all_robots(problem), 10'000, no_deadline, no_deadline));
    const Tick cost = first.cost();
    CHECK(first.improve(200, 200, no_deadline, no_deadline) > 0);
    CHECK(first.cost() < cost);

    FleetSearch second(problem, 2, 1);
    REQUIRE(second.prioritize(all_robots(problem), 10'000, no_deadline, no_deadline));
    CHECK(second.cost() == cost);
    const Tracks better = first.tracks();
    CHECK(second.restore(given(better), no_deadline) > 0);
    CHECK(second.cost() < cost);
    second.start(given(better));
    CHECK(second.cost() == first.cost());
    CHECK(second.tracks().enter == better.enter);
}

TEST_CASE("robots without a track get one, and no other robots are named") {
    const Crossing crossing(5);
    const Problem problem(crossing.arrays(), {0, true});
    FleetSearch search(problem, 1, 1);
    REQUIRE(search.prioritize(all_robots(problem), 10'000, no_deadline, no_deadline));
    Tracks tracks = search.tracks();
    const auto n_first = static_cast<std::ptrdiff_t>(tracks.first_visit[1]);
    tracks.vertex.erase(tracks.vertex.begin(), tracks.vertex.begin() + n_first);
    tracks.enter.erase(tracks.enter.begin(), tracks.enter.begin() + n_first);
    for (std::size_t r = 1; r < tracks.first_visit.size(); ++r) {
        tracks.first_visit[r] -= static_cast<VisitId>(n_first);
    }
    search.start(given(tracks));
    const std::vector<RobotId> second{1};
    const std::vector<RobotId> nothing;
    CHECK(fault_of([&] { search.repair(second, 1000, no_deadline); }) ==
          "order[0]: 1 is a robot that has a track");
    CHECK(fault_of([&] { search.repair(nothing, 1000, no_deadline); }) ==
          "order: 0 is a robot without a track, and left out");
    const std::vector<RobotId> missing{0};
    CHECK(search.repair(missing, 10'000, no_deadline));
}

TEST_CASE("earlier tracks are taken over as far as they fit, and others are planned around them") {
    const Crossing crossing(5);
    const Problem problem(crossing.arrays(), {0, true});
    FleetSearch search(problem, 1, 1);
    REQUIRE(search.prioritize(all_robots(problem), 10'000, no_deadline, no_deadline));
    const Tracks tracks = search.tracks();
    const Tick cost = search.cost();
    const std::vector<RobotId> nothing;
    CHECK(search.take_over(given(tracks), nothing, no_deadline).empty());
    CHECK(search.cost() == cost);

    Tracks cut = tracks;  // without that of robot 0
    const VisitId n_dropped = cut.first_visit[1];
    cut.vertex.erase(cut.vertex.begin(), cut.vertex.begin() + n_dropped);
    cut.enter.erase(cut.enter.begin(), cut.enter.begin() + n_dropped);
    for (std::size_t r = 1; r < cut.first_visit.size(); ++r) {
        cut.first_visit[r] -= n_dropped;
    }
    CHECK(search.take_over(given(cut), nothing, no_deadline) == std::vector<RobotId>{0});
    const std::vector<RobotId> missing{0};
    CHECK(search.take_over(given(cut), missing, no_deadline).empty());
    CHECK(search.cost() <= cost);
}

TEST_CASE("tracks that do not fit are refused with array, index and value") {
    const Crossing crossing(4);
    const Problem problem(crossing.arrays(), {0, false});
    FleetSearch search(problem, 1, 1);
    const std::vector<std::int32_t> too_few{0, 1};
    const std::vector<VertexId> vertex{0};
    const std::vector<Tick> enter{0};
    CHECK(fault_of([&] {
              search.start({too_few, vertex, enter});
          }) == "first_visit: its length is 2, but must be 7");
    std::vector<std::int32_t> one(7, 1);
    one[0] = 0;
    CHECK(fault_of([&] {
              search.start({one, vertex, enter});
          }) == "vertices[0]: 0 is not the home of robot 0, 4");
    const std::vector<VertexId> home{4};
    const std::vector<Tick> late{3};
    CHECK(fault_of([&] {
              search.start({one, home, late});
          }) == "enter[0]: 3 must be 0 on a first visit");
    CHECK(fault_of([&] { search.improve(1, 1, no_deadline, no_deadline); }) ==
          "improve: 0 is a robot without a track (start, prioritize or repair first)");
    CHECK(fault_of([&] { FleetSearch(problem, 1, 0); }) == "n_threads: 0 is not in 1..1024");
}

}  // namespace
}  // namespace rightofway
