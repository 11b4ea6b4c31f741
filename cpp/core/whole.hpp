// Integers of any size, for the few comparisons that doubles leave open.
#pragma once

#include <algorithm>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rightofway {

// Sign and magnitude; the limbs of 32 bits begin with the least, and the last one is not 0.
class Whole {
  public:
    Whole() = default;
    explicit Whole(std::span<const std::uint32_t> limbs) : limbs_(limbs.begin(), limbs.end()) {
        trim();
    }

    int sign() const { return limbs_.empty() ? 0 : (is_negative_ ? -1 : 1); }

    friend Whole operator-(const Whole& a, const Whole& b) {
        Whole opposite = b;
        opposite.is_negative_ = !b.is_negative_ && !b.limbs_.empty();
        return a + opposite;
    }

    friend Whole operator+(const Whole& a, const Whole& b) {
        Whole sum;
        if (a.is_negative_ == b.is_negative_) {
            sum.limbs_ = added(a.limbs_, b.limbs_);
            sum.is_negative_ = a.is_negative_;
        } else if (compared(a.limbs_, b.limbs_) >= 0) {
            sum.limbs_ = subtracted(a.limbs_, b.limbs_);
            sum.is_negative_ = a.is_negative_;
        } else {
            sum.limbs_ = subtracted(b.limbs_, a.limbs_);
            sum.is_negative_ = b.is_negative_;
        }
        sum.trim();
        return sum;
    }

    friend Whole operator*(const Whole& a, const Whole& b) {
        Whole product;
        product.limbs_.assign(a.limbs_.size() + b.limbs_.size(), 0);
        for (std::size_t i = 0; i < a.limbs_.size(); ++i) {
            std::uint64_t carry = 0;
            for (std::size_t j = 0; j < b.limbs_.size(); ++j) {
                carry += product.limbs_[i + j] + std::uint64_t{a.limbs_[i]} * b.limbs_[j];
                product.limbs_[i + j] = static_cast<std::uint32_t>(carry);
                carry >>= 32;
            }
            product.limbs_[i + b.limbs_.size()] = static_cast<std::uint32_t>(carry);
        }
        product.is_negative_ = a.is_negative_ != b.is_negative_;
        product.trim();
        return product;
    }

    friend std::strong_ordering operator<=>(const Whole& a, const Whole& b) {
        return (a - b).sign() <=> 0;
    }
    friend bool operator==(const Whole& a, const Whole& b) { return (a - b).sign() == 0; }

  private:
    using Limbs = std::vector<std::uint32_t>;

    static int compared(const Limbs& a, const Limbs& b) {
        if (a.size() != b.size()) {
            return a.size() < b.size() ? -1 : 1;
        }
        for (std::size_t k = a.size(); k-- > 0;) {
            if (a[k] != b[k]) {
                return a[k] < b[k] ? -1 : 1;
            }
        }
        return 0;
    }

    static Limbs added(const Limbs& a, const Limbs& b) {
        Limbs sum(std::max(a.size(), b.size()) + 1);
        std::uint64_t carry = 0;
        for (std::size_t k = 0; k < sum.size(); ++k) {
            carry += (k < a.size() ? a[k] : 0U) + std::uint64_t{k < b.size() ? b[k] : 0U};
            sum[k] = static_cast<std::uint32_t>(carry);
            carry >>= 32;
        }
        return sum;
    }

    // Of a magnitude that is not the smaller one.
    static Limbs subtracted(const Limbs& a, const Limbs& b) {
        Limbs rest(a.size());
        std::uint64_t borrow = 0;
        for (std::size_t k = 0; k < a.size(); ++k) {
            const std::uint64_t taken = (k < b.size() ? b[k] : 0U) + borrow;
            borrow = a[k] < taken ? 1 : 0;
            rest[k] = static_cast<std::uint32_t>((borrow << 32) + a[k] - taken);
        }
        return rest;
    }

    void trim() {
        while (!limbs_.empty() && limbs_.back() == 0) {
            limbs_.pop_back();
        }
        is_negative_ = is_negative_ && !limbs_.empty();
    }

    Limbs limbs_;
    bool is_negative_ = false;
};

}  // namespace rightofway
