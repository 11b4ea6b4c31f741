#include "lns/adaptive_choice.hpp"

#include <algorithm>

namespace rightofway {
namespace {

constexpr double memory = 0.97;    // of a record, from use to use
constexpr double curiosity = 0.3;  // the share of effort that is even

constexpr double memory_of_groups = 0.99;
constexpr double least_of_group = 0.1;  // of the effort of a group

double draw_share(Random& random) { return static_cast<double>(random.next() >> 11) * 0x1.0p-53; }

}  // namespace

AdaptiveChoice::AdaptiveChoice(std::size_t n_options)
    : records_(n_options), weights_(n_options, 1.0 / static_cast<double>(n_options)) {}

std::size_t AdaptiveChoice::draw(Random& random) const {
    double left = draw_share(random);
    std::size_t option = 0;
    while (option + 1 < weights_.size() && (left -= weights_[option]) >= 0) {
        ++option;
    }
    return option;
}

void AdaptiveChoice::learn(std::size_t option, double gain, double effort) {
    Record& record = records_[option];
    record.gain = memory * record.gain + gain;
    record.effort = memory * record.effort + effort;
    record.n_uses = memory * record.n_uses + 1;
}

void AdaptiveChoice::settle() {
    const auto n = static_cast<double>(records_.size());
    double total_gain = 0;
    double total_effort = 1;
    double total_uses = 1;
    for (const Record& record : records_) {
        total_gain += record.gain;
        total_effort += record.effort;
        total_uses += record.n_uses;
    }
    // All options begin with a tenth of an average record: each is like the average at first.
    const double prior = total_effort / n * 0.1 + 1;
    const double prior_gain = prior * (total_gain + 1e-9) / total_effort;
    const double prior_uses = prior * total_uses / total_effort;
    double sum = 0;
    for (std::size_t k = 0; k < records_.size(); ++k) {
        weights_[k] = (records_[k].gain + prior_gain) / (records_[k].effort + prior);
        sum += weights_[k];
    }
    double draws = 0;
    for (std::size_t k = 0; k < records_.size(); ++k) {
        const double share = (1 - curiosity) * weights_[k] / sum + curiosity / n;
        weights_[k] = share * (records_[k].n_uses + prior_uses) / (records_[k].effort + prior);
        draws += weights_[k];
    }
    for (double& weight : weights_) {
        weight /= draws;
    }
}

bool EffortShares::draw(Random& random) const { return draw_share(random) < second_; }

void EffortShares::learn(bool is_second, double gain, double effort) {
    Record& record = records_[is_second ? 1 : 0];
    record.gain = memory_of_groups * record.gain + gain;
    record.effort = memory_of_groups * record.effort + effort;
    record.n_uses = memory_of_groups * record.n_uses + 1;
}

void EffortShares::settle() {
    const auto& [first, second] = records_;
    const double rate = first.gain / first.effort;
    const double rate_of_second = second.gain / second.effort;
    const double sum = rate + rate_of_second;
    const bool has_gain = first.gain + second.gain >= 1;
    const double share =
        has_gain ? std::clamp(rate_of_second / sum, least_of_group, 1 - least_of_group) : 0.5;
    const double uses = (1 - share) * first.n_uses / first.effort;
    const double uses_of_second = share * second.n_uses / second.effort;
    second_ = uses_of_second / (uses + uses_of_second);
}

}  // namespace rightofway
