#include "cbs/constraint_sets.hpp"

#include <algorithm>
#include <utility>

#include "core/index_table.hpp"

namespace rightofway {
namespace {

std::uint64_t hash_of(std::span<const Constraint> constraints) {
    std::uint64_t hash = 0;
    for (const Constraint& one : constraints) {
        for (const std::int64_t part : {std::int64_t{one.row}, one.start, one.end}) {
            hash = mix_in(hash, part);
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
