#include "distances/shared_distances.hpp"

#include <algorithm>

namespace rightofway {

SharedDistances::SharedDistances(const Roads& roads, std::size_t budget)
    : roads_(roads),
      tables_(roads.graph.indptr, roads.graph.indices),
      is_uniform_(std::all_of(roads.length_class.begin(), roads.length_class.end(),
                              [](std::int32_t one) { return one == 0; })),
      budget_(budget) {}

std::shared_ptr<const DistanceTable> SharedDistances::to(VertexId target,
                                                         std::span<const std::int32_t> pace) {
    Key key{target, 0};
    {
        const std::lock_guard lock(mutex_);
        key.pace = is_uniform_ ? 0 : number_of(pace);
        if (const auto found = known_.find(key); found != known_.end()) {
            return found->second;
        }
    }
    auto table = make(target, pace);
    const std::lock_guard lock(mutex_);
    if (known_.emplace(key, table).second) {
        by_age_.push_back(key);
        bytes_ += table->bytes();
    }
    while (bytes_ > budget_ && by_age_.size() > 1) {
        const auto oldest = known_.find(by_age_.front());
        bytes_ -= oldest->second->bytes();
        known_.erase(oldest);
        by_age_.pop_front();
    }
    return table;
}

Tick SharedDistances::between(VertexId from, VertexId target, std::span<const std::int32_t> pace) {
    if (!is_uniform_) {
        return to(target, pace)->view(1).from(from);
    }
    const std::lock_guard lock(ways_mutex_);
    if (!ways_) {
        ways_.emplace(roads_.graph, tables_);
    }
    const std::int32_t steps = ways_->between(from, target);
    return steps == AltDistance::no_way ? -1 : scale(pace) * steps;
}

std::int32_t SharedDistances::number_of(std::span<const std::int32_t> pace) {
    const auto known = std::find_if(paces_.begin(), paces_.end(), [&](const auto& one) {
        return std::equal(one.begin(), one.end(), pace.begin(), pace.end());
    });
    const auto number = static_cast<std::int32_t>(known - paces_.begin());
    if (known == paces_.end()) {
        paces_.emplace_back(pace.begin(), pace.end());
    }
    return number;
}

std::shared_ptr<const DistanceTable> SharedDistances::make(
    VertexId target, std::span<const std::int32_t> pace) const {
    auto table = std::make_shared<DistanceTable>();
    if (is_uniform_) {
        if (tables_.steps_to(target, table->narrow)) {
            return table;
        }
        table->narrow = {};
    }
    std::vector<std::int32_t> ticks(roads_.length_class.size(), 1);
    if (!is_uniform_) {
        std::transform(roads_.length_class.begin(), roads_.length_class.end(), ticks.begin(),
                       [&](std::int32_t one) { return pace[static_cast<std::size_t>(one)]; });
    }
    table->wide = tables_.to(target, ticks);
    return table;
}

}  // namespace rightofway
