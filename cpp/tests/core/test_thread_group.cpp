#include <doctest/doctest.h>

#include <atomic>
#include <stdexcept>

#include "core/thread_group.hpp"

namespace rightofway {
namespace {

TEST_CASE("what a thread throws comes back when all have ended, and only once") {
    std::atomic<int> n_ended = 0;
    std::atomic<bool> has_failed = false;
    ThreadGroup threads;
    threads.start([] { throw std::runtime_error("broken"); }, [&] { has_failed = true; });
    for (int k = 0; k < 3; ++k) {
        threads.start(
            [&] {
                while (!has_failed) {
                    std::this_thread::yield();
                }
                ++n_ended;
            },
            [] {});
    }
    CHECK_THROWS_AS(threads.join(), std::runtime_error);
    CHECK(n_ended == 3);
    CHECK_NOTHROW(threads.join());
}

TEST_CASE("where the calling thread throws, the others are joined") {
    std::atomic<bool> is_stopped = false;
    std::atomic<bool> has_ended = false;
    const auto fail_beside_a_thread = [&] {
        struct Stop {
            std::atomic<bool>& flag;
            ~Stop() { flag = true; }
        };
        ThreadGroup threads;
        const Stop stop{is_stopped};  // before the threads are joined
        threads.start(
            [&] {
                while (!is_stopped) {
                    std::this_thread::yield();
                }
                has_ended = true;
            },
            [] {});
        throw std::runtime_error("broken");
    };
    CHECK_THROWS_AS(fail_beside_a_thread(), std::runtime_error);
    CHECK(has_ended);
}

}  // namespace
}  // namespace rightofway
