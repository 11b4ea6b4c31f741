// The rows from which a booking of each row excludes other robots: for points, and for sizes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "core/row_finder.hpp"

namespace rightofway {

// A booking of row r excludes others from the rows of its list, which rise. Borrowed. Without a
// finder a row excludes itself: so it is for points, whose vertices come first and whose edges
// exclude nothing, because both ends are booked.
struct ExcludedRows {
    const RowFinder* finder = nullptr;
    std::int32_t n_own = std::numeric_limits<std::int32_t>::max();  // rows that exclude themselves

    bool is_identity() const { return finder == nullptr; }
    // Rows that have a list of their own, 0 for points.
    std::int32_t n_rows() const { return finder == nullptr ? 0 : finder->n_rows(); }
    // The list of a row; that of a point is the variable `row` itself.
    std::span<const std::int32_t> of(const std::int32_t& row) const {
        if (finder != nullptr) {
            return finder->of(row);
        }
        return {&row, static_cast<std::size_t>(row < n_own)};
    }
    std::span<const std::int32_t> of(std::int32_t&&) const = delete;
};

}  // namespace rightofway
