// What long searches are asked now and then: is the time over, has the user had enough?
#pragma once

#include <nanobind/nanobind.h>

#include <chrono>
#include <optional>

namespace rightofway::bind {

class Deadline {
  public:
    // So many seconds from now; never, without.
    explicit Deadline(std::optional<double> seconds) {
        if (seconds) {
            at_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                     std::chrono::duration<double>(*seconds));
        }
    }

    // Asked while the GIL is released: takes it to look for Ctrl-C.
    bool operator()() const {
        const nanobind::gil_scoped_acquire acquired;
        if (PyErr_CheckSignals() != 0) {
            throw nanobind::python_error();
        }
        return at_ && Clock::now() > *at_;
    }

  private:
    using Clock = std::chrono::steady_clock;
    std::optional<Clock::time_point> at_;
};

}  // namespace rightofway::bind
