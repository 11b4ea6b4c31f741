#include "precedence/rights_of_way.hpp"

namespace rightofway {
namespace {

void cut(std::int32_t& head, std::vector<std::int32_t>& next, std::int32_t right) {
    std::int32_t* link = &head;
    while (*link != right) {
        link = &next[index(*link)];
    }
    *link = next[index(right)];
}

}  // namespace

std::int32_t RightsOfWay::find(VisitId first, VisitId second) const {
    for (std::int32_t k = latest_of_first_[index(first)]; k != none; k = next_of_first_[index(k)]) {
        if (rights_[index(k)].second == second) {
            return k;
        }
    }
    return none;
}

std::int32_t RightsOfWay::give(VisitId first, VisitId second) {
    rights_.push_back({first, second});
    holds_.push_back(0);
    next_of_first_.push_back(none);
    next_of_second_.push_back(none);
    const auto right = static_cast<std::int32_t>(rights_.size()) - 1;
    link(right);
    return right;
}

void RightsOfWay::forget_latest() {
    unlink(static_cast<std::int32_t>(rights_.size()) - 1);
    rights_.pop_back();
    holds_.pop_back();
    next_of_first_.pop_back();
    next_of_second_.pop_back();
}

void RightsOfWay::link(std::int32_t right) {
    const auto& [first, second] = rights_[index(right)];
    next_of_first_[index(right)] = latest_of_first_[index(first)];
    latest_of_first_[index(first)] = right;
    next_of_second_[index(right)] = latest_of_second_[index(second)];
    latest_of_second_[index(second)] = right;
    holds_[index(right)] = 1;
}

void RightsOfWay::unlink(std::int32_t right) {
    const auto& [first, second] = rights_[index(right)];
    cut(latest_of_first_[index(first)], next_of_first_, right);
    cut(latest_of_second_[index(second)], next_of_second_, right);
    holds_[index(right)] = 0;
}

std::vector<RightOfWay> RightsOfWay::list() const {
    std::vector<RightOfWay> held;
    for (std::size_t k = 0; k < rights_.size(); ++k) {
        if (holds_[k] != 0) {
            held.push_back(rights_[k]);
        }
    }
    return held;
}

}  // namespace rightofway
