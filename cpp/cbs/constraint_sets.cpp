#include "cbs/constraint_sets.hpp"

#include <algorithm>
#include <utility>

namespace rightofway {
namespace {

std::uint64_t hash_of(std::span<const Constraint> constraints) {
    std::uint64_t hash = 0;
    for (const Constraint& one : constraints) {
        for (const std::int64_t part : {std::int64_t{one.row}, one.start, one.end}) {
            hash = (hash ^ static_cast<std::uint64_t>(part)) * 0x9E3779B97F4A7C15U;
            hash ^= hash >> 29;
        }
    }
    return hash;
}

}  // namespace

SetId ConstraintSets::with(SetId set, const Constraint& added) {
    std::vector<Constraint> larger = sets_[index(set)];
    const auto place = std::lower_bound(larger.begin(), larger.end(), added);
    if (place != larger.end() && *place == added) {
        return set;
    }
    larger.insert(place, added);
    const std::uint64_t hash = hash_of(larger);
    const auto [first, last] = known_.equal_range(hash);
    for (auto other = first; other != last; ++other) {
        if (sets_[index(other->second)] == larger) {
            return other->second;
        }
    }
    const auto id = static_cast<SetId>(sets_.size());
    sets_.push_back(std::move(larger));
    known_.emplace(hash, id);
    return id;
}

}  // namespace rightofway
