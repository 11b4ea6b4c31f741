// Asks a stop condition from within a long loop, at most every few milliseconds.
#pragma once

#include <chrono>
#include <cstdint>

#include "core/search_end.hpp"

namespace rightofway {

class Poll {
  public:
    // Borrows the condition; an empty one is never asked.
    explicit Poll(const StopCondition& is_over) : is_over_(is_over) {}

    // To be called at each step of the loop, with a number of steps if that is a long one. Whether
    // the loop has to stop, if it can; what the condition throws ends it in any case.
    bool operator()(std::uint32_t n_steps = 1) {
        n_steps_ += n_steps;
        if (n_steps_ < steps_between_looks) {
            return false;
        }
        n_steps_ = 0;
        return is_over_ && is_due() && is_over_();
    }

  private:
    static constexpr std::uint32_t steps_between_looks = 256;
    static constexpr auto between_questions = std::chrono::milliseconds(5);

    bool is_due() {
        const auto now = std::chrono::steady_clock::now();
        if (now < next_question_) {
            return false;
        }
        next_question_ = now + between_questions;
        return true;
    }

    const StopCondition& is_over_;
    std::uint32_t n_steps_ = 0;
    std::chrono::steady_clock::time_point next_question_;
};

}  // namespace rightofway
