#include <doctest/doctest.h>

#include <optional>
#include <stdexcept>
#include <vector>

#include "tours/line_work.hpp"
#include "tours/tour_search.hpp"

namespace rightofway {
namespace {

using Ids = std::vector<std::int32_t>;

Ids stops_of(const TourSearch& search, RobotId robot) {
    const auto stops = search.best().tour(robot).stops();
    return {stops.begin(), stops.end()};
}

TEST_CASE("one robot serves jobs in the order of least service") {
    // From 0: to 2 and then to 5 takes 2 + 5 ticks; the other way round 5 + 8.
    const auto problem = make_line({{{{5}}}, {{{2}}}}, {{.start = 0}}, TourObjective::service);
    TourSearch search(*problem, 1);
    CHECK(search.construct({}));
    search.improve(20, {});
    CHECK(stops_of(search, 0) == Ids{1, 0});
    CHECK(search.best().cost() == TourCost{0, 0, 7, 5});
}

TEST_CASE("loads of two jobs are on board at once where the capacity allows") {
    // Pickups at 1 and 2, deliveries at 4 and 5: with capacity 2 all on one way, 5 ticks.
    const std::vector<LineJob> jobs{{{{1, 0, 1}, {4, 0, -1}}}, {{{2, 0, 1}, {5, 0, -1}}}};
    const auto flowtime_with = [&](std::int32_t capacity) {
        const auto problem = make_line(jobs, {{.capacity = capacity}}, TourObjective::flowtime);
        TourSearch search(*problem, 1);
        search.construct({});
        search.improve(50, {});
        return search.best().cost().value;
    };
    CHECK(flowtime_with(2) == 5);
    // With capacity 1: 0 to 1, 4, back to 2, 5.
    CHECK(flowtime_with(1) == 9);
}

TEST_CASE("a job waits for the end of a job of another robot") {
    // Robot 1 at 20 could be at 18 at tick 2; the job before it ends at 3 + 4.
    const auto problem = make_line({{{{3, 4}}}, {{{18}}, never, {0}}},
                                   {{.start = 0}, {.start = 20}}, TourObjective::service);
    TourSearch search(*problem, 1);
    search.construct({});
    search.improve(50, {});
    CHECK(stops_of(search, 0) == Ids{0});
    CHECK(stops_of(search, 1) == Ids{1});
    CHECK(search.best().tour(1).times().begin == std::vector<Tick>{7});
}

TEST_CASE("a job is compared on all robots, and the best tours stay") {
    // From 0 to 5 and from 20 to 5.
    const auto problem =
        make_line({{{{5}}}, {{{18}}}}, {{.start = 0}, {.start = 20}}, TourObjective::service);
    TourSearch search(*problem, 1);
    search.construct({});
    // 5 ticks before or after nothing; after 18 at 2 another 13; 2 is what the other job costs.
    CHECK(search.compare_robots(0) == std::vector<std::optional<std::int64_t>>{2 + 5, 2 + 15, 2});
    CHECK(search.best().cost() == TourCost{0, 0, 7, 7});
    CHECK(search.compare_robots(0) == search.compare_robots(0));
}

TEST_CASE("jobs that wait for each other are refused") {
    CHECK_THROWS_AS(
        make_line({{{{3}}, never, {1}}, {{{4}}, never, {0}}}, {{}}, TourObjective::service),
        std::invalid_argument);
}

TEST_CASE("a charge is as long as the rest of the tour needs") {
    // 16 places out and back and a reserve of 2 need 18; there are 9, so 9 / 4 rounded up.
    const auto problem =
        make_line({{{{8}}}}, {{.start = 0, .end = 0, .soc = 9}}, TourObjective::flowtime);
    TourSearch search(*problem, 1);
    search.construct({});
    const TourTimes& times = search.best().tour(0).times();
    REQUIRE(times.charges.size() == 1);
    CHECK(times.charges[0].place == 0);
    CHECK(times.charges[0].ticks == 3);
    CHECK(times.completion == 19);
}

TEST_CASE("reasons of unserved jobs tell ways, times and batteries apart") {
    const auto problem = make_line({{{{10, 0, 0, 0, 9}}}, {{{19}}}, {{{1}}, never, {0}}, {{{1}}}},
                                   {{.soc = 20}}, TourObjective::service);
    TourSearch search(*problem, 1);
    search.construct({});
    CHECK(search.explain(0) == UnservedReason::latest);
    CHECK(search.explain(1) == UnservedReason::battery);
    CHECK(search.explain(2) == UnservedReason::after);
    CHECK(search.best().serves(3));
}

TEST_CASE("a job that has begun is served before heavier ones") {
    const std::vector<LineJob> jobs{{{{6, 0, 0, 0, 6}}}, {{{0, 6}}, never, {}, 0}};
    const auto problem = make_line(jobs, {{}}, TourObjective::service);
    TourSearch search(*problem, 1);
    search.construct({});
    CHECK(search.best().cost().n_missing == 0);
}

TEST_CASE("the best tours depend on the steps, not on the calls") {
    std::vector<LineJob> jobs;
    for (std::int32_t k = 0; k < 12; ++k) {
        jobs.push_back({{{(7 * k) % 20, 1}, {(11 * k + 3) % 20, 2}}, 20 + k});
    }
    const auto problem = make_line(jobs, {{}, {.start = 9}}, TourObjective::service);
    TourSearch once(*problem, 5);
    TourSearch often(*problem, 5);
    once.construct({});
    often.construct({});
    once.improve(300, {});
    for (int k = 0; k < 30; ++k) {
        often.improve(10, {});
    }
    CHECK(once.best().cost() == often.best().cost());
    CHECK(stops_of(once, 0) == stops_of(often, 0));
}

}  // namespace
}  // namespace rightofway
