#include <doctest/doctest.h>

#if __has_include(<pthread.h>)
#include <pthread.h>

#include <functional>

#include "fleets.hpp"
#include "lacam/lacam.hpp"

namespace rightofway {
namespace {

constexpr VertexId n_robots = 10'000;

// Robots on all vertices of a corridor but the last; each is to go one vertex on, and the first to
// choose pushes all others.
test::Fleet queue(std::int32_t edge_ticks) {
    std::vector<test::Robot> robots;
    for (VertexId v = 0; v < n_robots; ++v) {
        robots.push_back({v, {{v + 1}}, edge_ticks});
    }
    return {test::corridor(n_robots + 1), robots};
}

// Runs in a thread with the stack that threads have on macOS: 512 kB.
void run_on_a_small_stack(std::function<void()> work) {
    constexpr std::size_t stack = std::size_t{512} << 10;
    pthread_attr_t attributes;
    REQUIRE(pthread_attr_init(&attributes) == 0);
    REQUIRE(pthread_attr_setstacksize(&attributes, stack) == 0);
    pthread_t thread{};
    const auto call = [](void* given) -> void* {
        (*static_cast<std::function<void()>*>(given))();
        return nullptr;
    };
    REQUIRE(pthread_create(&thread, &attributes, call, &work) == 0);
    REQUIRE(pthread_join(thread, nullptr) == 0);
    pthread_attr_destroy(&attributes);
}

TEST_CASE("a queue of 10 000 robots that push each other needs no deep stack") {
    for (const std::int32_t edge_ticks : {1, 2}) {  // in steps, and with clocks
        const test::Fleet fleet = queue(edge_ticks);
        const Problem problem = fleet.problem();
        REQUIRE(problem.moves_in_steps() == (edge_ticks == 1));
        SearchEnd end = SearchEnd::stopped;
        run_on_a_small_stack([&] {
            StepTables tables(problem.graph());
            SpaceUtilization paths(problem, tables);
            end = Lacam(problem, tables, paths, 0).run(test::no_deadline, 100 * n_robots);
        });
        CHECK(end == SearchEnd::found);
    }
}

}  // namespace
}  // namespace rightofway
#endif
