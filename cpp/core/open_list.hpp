// The open list of a search: a priority queue of nodes, least key first.
//
// A 4-ary heap: half as deep as a binary heap, and the children of a node share a cache line.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/types.hpp"

namespace rightofway {

class OpenList {
  public:
    struct Entry {
        std::uint64_t key;
        std::int32_t node;  // breaks ties, so the order is total
    };

    // Packs two numbers into one key: order by `first`, then by `second`. Plans stay far below the
    // bounds; larger numbers are clipped, which changes only the order.
    static std::uint64_t key(Tick first, Tick second) {
        constexpr int bits = 26;
        constexpr Tick most_first = (Tick{1} << (63 - bits)) - 1;
        constexpr Tick most_second = (Tick{1} << bits) - 1;
        return (static_cast<std::uint64_t>(std::min(first, most_first)) << bits) |
               static_cast<std::uint64_t>(std::min(second, most_second));
    }

    bool empty() const { return heap_.empty(); }
    void clear() { heap_.clear(); }

    void push(std::uint64_t key, std::int32_t node) {
        const Entry entry{key, node};
        std::size_t k = heap_.size();
        heap_.push_back(entry);
        while (k > 0 && is_before(entry, heap_[(k - 1) / 4])) {
            heap_[k] = heap_[(k - 1) / 4];
            k = (k - 1) / 4;
        }
        heap_[k] = entry;
    }

    Entry pop() {
        const Entry top = heap_.front();
        const Entry last = heap_.back();
        heap_.pop_back();
        const std::size_t n = heap_.size();
        std::size_t k = 0;
        for (std::size_t child = 1; child < n; child = 4 * k + 1) {
            std::size_t least = child;
            for (std::size_t other = child + 1; other < std::min(child + 4, n); ++other) {
                least = is_before(heap_[other], heap_[least]) ? other : least;
            }
            if (!is_before(heap_[least], last)) {
                break;
            }
            heap_[k] = heap_[least];
            k = least;
        }
        if (n > 0) {
            heap_[k] = last;
        }
        return top;
    }

  private:
    static bool is_before(const Entry& left, const Entry& right) {
        return left.key != right.key ? left.key < right.key : left.node < right.node;
    }

    std::vector<Entry> heap_;
};

}  // namespace rightofway
