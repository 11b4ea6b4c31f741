#include "core/task_crew.hpp"

#include <utility>

#include "core/thread_group.hpp"

namespace rightofway {
namespace {

constexpr auto between_questions = std::chrono::milliseconds(10);

}  // namespace

void TaskCrew::run(std::size_t n_tasks, const Work& work, const StopCondition& is_over) {
    next_task_ = 0;
    is_stopped_ = false;
    thrown_ = nullptr;
    const auto take_tasks = [&](std::size_t worker, const StopCondition& must_stop) {
        for (std::size_t k = next_task_++; k < n_tasks && !must_stop(); k = next_task_++) {
            work(worker, k, must_stop);
        }
    };
    const auto stop = [this] { is_stopped_ = true; };
    ThreadGroup others;
    try {
        for (std::size_t worker = 1; worker < n_workers_; ++worker) {
            const auto take_some = [&, worker] {
                take_tasks(worker, [this] { return is_stopped_.load(); });
            };
            others.start(take_some, stop);
        }
        take_tasks(0, [&] { return ask(is_over); });
    } catch (...) {
        stop();
        thrown_ = std::current_exception();
    }
    try {
        others.join();
    } catch (...) {
        if (!thrown_) {
            thrown_ = std::current_exception();
        }
    }
}

bool TaskCrew::ask(const StopCondition& is_over) {
    if (!is_stopped_ && std::chrono::steady_clock::now() - asked_ > between_questions) {
        asked_ = std::chrono::steady_clock::now();
        try {
            if (is_over()) {  // never back to false: a failing thread may have stopped the run
                is_stopped_ = true;
            }
        } catch (...) {
            thrown_ = std::current_exception();
            is_stopped_ = true;
        }
    }
    return is_stopped_;
}

void TaskCrew::pass_on() {
    if (thrown_) {
        std::rethrow_exception(std::exchange(thrown_, nullptr));
    }
}

}  // namespace rightofway
