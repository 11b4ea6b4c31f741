// Adaptive random choice among options: the probability of an option follows its recent gain
// divided by its effort.
//
// Ropke & Pisinger, "An adaptive large neighborhood search heuristic for the pickup and delivery
// problem with time windows", Transportation Science 2006 (weights).
#pragma once

#include <cstddef>
#include <vector>

#include "core/random.hpp"

namespace rightofway {

class AdaptiveChoice {
  public:
    explicit AdaptiveChoice(std::size_t n_options);

    std::size_t draw(Random& random) const;

    // Records gain and effort of an option; `settle` updates the weights.
    void learn(std::size_t option, double gain, double effort);
    void settle();

  private:
    struct Record {
        double gain = 0;
        double effort = 0;
    };

    std::vector<Record> records_;
    std::vector<double> weights_;
};

}  // namespace rightofway
