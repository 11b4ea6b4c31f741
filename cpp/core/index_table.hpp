// Finds the index of a key among keys that are kept elsewhere: open addressing, memory reused.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/types.hpp"

namespace rightofway {

// The hash of some numbers and one more.
inline std::uint64_t mix_in(std::uint64_t hash, std::int64_t part) {
    hash = (hash ^ static_cast<std::uint64_t>(part)) * 0x9E3779B97F4A7C15U;
    return hash ^ (hash >> 29);
}

class IndexTable {
  public:
    void clear() {
        mask_ = first_size - 1;
        size_ = 0;
        std::fill(slots_.begin(), slots_.begin() + first_size, Slot{0, none});
    }

    // The index of the key with this hash for which `is_same(index)` holds; `fresh`, which is kept,
    // if there is none.
    template <class IsSame>
    std::int32_t find_or_add(std::uint64_t hash, std::int32_t fresh, const IsSame& is_same) {
        if (2 * (size_ + 1) > mask_) {
            enlarge();
        }
        std::size_t k = place(hash);
        for (; slots_[k].index != none; k = (k + 1) & mask_) {
            if (slots_[k].hash == hash && is_same(slots_[k].index)) {
                return slots_[k].index;
            }
        }
        slots_[k] = {hash, fresh};
        ++size_;
        return fresh;
    }

  private:
    static constexpr std::ptrdiff_t first_size = 256;

    struct Slot {
        std::uint64_t hash;
        std::int32_t index;
    };

    std::size_t place(std::uint64_t hash) const {
        return static_cast<std::size_t>((hash * 0x9E3779B97F4A7C15U) >> 20) & mask_;
    }

    void enlarge() {
        const std::size_t before = mask_ + 1;
        moved_.assign(slots_.begin(), slots_.begin() + static_cast<std::ptrdiff_t>(before));
        mask_ = 4 * before - 1;
        slots_.resize(std::max(slots_.size(), mask_ + 1));
        std::fill(slots_.begin(), slots_.begin() + static_cast<std::ptrdiff_t>(mask_ + 1),
                  Slot{0, none});
        for (const Slot& one : moved_) {
            if (one.index != none) {
                std::size_t k = place(one.hash);
                while (slots_[k].index != none) {
                    k = (k + 1) & mask_;
                }
                slots_[k] = one;
            }
        }
    }

    std::vector<Slot> slots_ = std::vector<Slot>(first_size, Slot{0, none});
    std::vector<Slot> moved_;
    std::size_t mask_ = first_size - 1;
    std::size_t size_ = 0;
};

}  // namespace rightofway
