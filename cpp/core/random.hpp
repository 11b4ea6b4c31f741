// A random number generator with equal output on every machine and with every standard library.
//
// Steele, Lea & Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014 (SplitMix64).
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace rightofway {

class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed) {}

    // An independent stream for each pair (use, index) of one seed.
    Random(std::uint64_t seed, std::uint64_t use, std::uint64_t index)
        : state_(mix(mix(seed + 1) ^ mix(2 * use + 1)) ^ mix(~index)) {}

    std::uint64_t next() {
        skip(1);
        return mix(state_);
    }

    // The number that `next` returns after `n` skipped numbers.
    std::uint64_t after(std::uint64_t n) const { return mix(state_ + (n + 1) * step); }
    void skip(std::uint64_t n) { state_ += n * step; }

    // A random integer in 0 .. n - 1.
    std::size_t below(std::size_t n) { return static_cast<std::size_t>(next() % n); }

    template <class T>
    void shuffle(std::vector<T>& values) {
        for (std::size_t k = values.size(); k > 1; --k) {
            std::swap(values[k - 1], values[below(k)]);
        }
    }

  private:
    static constexpr std::uint64_t step = 0x9E3779B97F4A7C15U;

    static std::uint64_t mix(std::uint64_t z) {
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
        return z ^ (z >> 31);
    }

    std::uint64_t state_;
};

}  // namespace rightofway
