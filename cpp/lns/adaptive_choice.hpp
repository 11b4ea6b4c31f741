// Adaptive weights of ALNS: a neighbourhood gets a share of the effort that grows with its recent
// gain for the effort. Large neighbourhoods need several times the effort of small ones: shares of
// the draws would spend most of it on them.
//
// Ropke & Pisinger, "An adaptive large neighborhood search heuristic for the pickup and delivery
// problem with time windows", Transportation Science 2006 (weights).
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/random.hpp"

namespace rightofway {

class AdaptiveChoice {
  public:
    explicit AdaptiveChoice(std::size_t n_options);

    std::size_t draw(Random& random) const;

    // Notes what an option has brought; the weights take that up when `settle` is called.
    void learn(std::size_t option, double gain, double effort);
    void settle();

  private:
    struct Record {
        double gain = 0;
        double effort = 0;
        double n_uses = 0;
    };

    std::vector<Record> records_;
    std::vector<double> weights_;
};

// A choice between two groups of options whose uses need unlike effort. Each group gets a share of
// all effort in the ratio of what the groups bring for their effort, and at least a tenth.
class EffortShares {
  public:
    // True for the second group.
    bool draw(Random& random) const;

    void learn(bool is_second, double gain, double effort);
    void settle();

  private:
    struct Record {
        double gain = 0;
        double effort = 1;
        double n_uses = 1;
    };

    std::array<Record, 2> records_{};
    double second_ = 0.5;  // the probability of the second group
};

}  // namespace rightofway
