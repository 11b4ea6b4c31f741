// Threads that are joined on every way out of a block; an exception of a thread is rethrown.
//
// An exception that leaves a thread ends the program, and so does a thread that nobody joins. Here
// the first exception waits for the calling thread. (std::jthread only joins, and libc++ on Apple
// systems has lacked it for years.)
#pragma once

#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace rightofway {

class ThreadGroup {
  public:
    ThreadGroup() = default;
    ThreadGroup(const ThreadGroup&) = delete;
    ThreadGroup& operator=(const ThreadGroup&) = delete;
    ~ThreadGroup() { join_all(); }

    // Does the work in a thread of its own. `on_failure()` follows an exception of the work, in
    // that thread; it may stop the others, and does not throw.
    template <class Work, class OnFailure>
    void start(Work work, OnFailure on_failure) {
        threads_.emplace_back(
            [this, work = std::move(work), on_failure = std::move(on_failure)]() mutable {
                try {
                    work();
                } catch (...) {
                    keep(std::current_exception());
                    on_failure();
                }
            });
    }

    // Waits for all threads, and then rethrows the first exception of their work, if any.
    void join() {
        join_all();
        if (thrown_) {
            std::rethrow_exception(std::exchange(thrown_, nullptr));
        }
    }

  private:
    void join_all() {
        for (std::thread& thread : threads_) {
            thread.join();
        }
        threads_.clear();
    }

    void keep(std::exception_ptr thrown) {
        const std::lock_guard lock(mutex_);
        if (!thrown_) {
            thrown_ = std::move(thrown);
        }
    }

    std::mutex mutex_;
    std::exception_ptr thrown_;
    std::vector<std::thread> threads_;
};

}  // namespace rightofway
