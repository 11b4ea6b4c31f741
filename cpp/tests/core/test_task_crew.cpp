#include <doctest/doctest.h>

#include <atomic>
#include <new>
#include <stdexcept>

#include "core/task_crew.hpp"

namespace rightofway {
namespace {

bool never_over() { return false; }

TEST_CASE("a task that throws on another thread ends the run, and the caller hears of it") {
    TaskCrew crew(4);
    std::atomic<bool> has_thrown = false;
    std::atomic<std::size_t> n_done = 0;
    const auto work = [&](std::size_t worker, std::size_t, const StopCondition& must_stop) {
        if (worker == 3) {
            has_thrown = true;
            throw std::bad_alloc();
        }
        while (!has_thrown && !must_stop()) {  // else this thread may do all the tasks
        }
        ++n_done;
    };
    crew.run(1'000'000, work, never_over);
    CHECK(crew.is_stopped());
    CHECK(n_done < 1'000'000);
    CHECK_THROWS_AS(crew.pass_on(), std::bad_alloc);
    CHECK_NOTHROW(crew.pass_on());
}

TEST_CASE("a task that throws on the calling thread ends the run on all threads") {
    TaskCrew crew(4);
    std::atomic<bool> has_thrown = false;
    const auto work = [&](std::size_t worker, std::size_t, const StopCondition& must_stop) {
        if (worker == 0) {
            has_thrown = true;
            throw std::runtime_error("broken");
        }
        while (!has_thrown || !must_stop()) {
        }
    };
    crew.run(1'000'000, work, never_over);
    CHECK(crew.is_stopped());
    CHECK_THROWS_AS(crew.pass_on(), std::runtime_error);
}

TEST_CASE("a crew that has failed can work again") {
    TaskCrew crew(2);
    const auto fail = [](std::size_t, std::size_t, const StopCondition&) {
        throw std::runtime_error("broken");
    };
    crew.run(1, fail, never_over);
    std::atomic<std::size_t> n_done = 0;
    crew.run(
        100, [&](std::size_t, std::size_t, const StopCondition&) { ++n_done; }, never_over);
    CHECK(n_done == 100);
    CHECK_FALSE(crew.is_stopped());
    CHECK_NOTHROW(crew.pass_on());
}

}  // namespace
}  // namespace rightofway
