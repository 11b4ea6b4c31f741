// A thread pool for independent tasks.
//
// Each thread takes the next task until none is left. The calling thread works, too. Only the
// calling thread evaluates the stop condition, which may need the interpreter and may throw.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <exception>
#include <functional>

#include "core/search_end.hpp"

namespace rightofway {

class TaskCrew {
  public:
    // Does one task; returns early once `is_over` is true.
    using Work =
        std::function<void(std::size_t worker, std::size_t task, const StopCondition& is_over)>;

    explicit TaskCrew(std::size_t n_workers) : n_workers_(n_workers) {}

    // Does tasks 0 .. n_tasks - 1, or the first of them if `is_over` says so. An exception of
    // `is_over` or of a task on any thread means the same and is kept, so that the caller can tidy
    // up before it calls `pass_on`.
    void run(std::size_t n_tasks, const Work& work, const StopCondition& is_over);

    // Whether `is_over` stopped the last run.
    bool is_stopped() const { return is_stopped_; }

    // Rethrows the exception that the last run kept, if any; only once.
    void pass_on();

  private:
    bool ask(const StopCondition& is_over);

    std::size_t n_workers_;
    std::atomic<std::size_t> next_task_ = 0;
    std::atomic<bool> is_stopped_ = false;
    std::exception_ptr thrown_;
    std::chrono::steady_clock::time_point asked_;  // kept between runs: runs may be short
};

}  // namespace rightofway
