// The rows from which a booking of each row excludes other robots, and the one check of these
// lists.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace rightofway {

// A booking of row r excludes others from the rows excluded[first[r]] .. excluded[first[r + 1] -
// 1]. Borrowed. Without arrays a row excludes itself: so it is for points, whose vertices come
// first and whose edges exclude nothing, because both ends are booked.
struct ExcludedRows {
    std::span<const std::int32_t> first = {};
    std::span<const std::int32_t> excluded = {};
    std::int32_t n_own = std::numeric_limits<std::int32_t>::max();  // rows that exclude themselves

    bool is_identity() const { return first.empty(); }
    // The list of a row; that of a point is the variable `row` itself.
    std::span<const std::int32_t> of(const std::int32_t& row) const {
        if (is_identity()) {
            return {&row, static_cast<std::size_t>(row < n_own)};
        }
        const auto r = static_cast<std::size_t>(row);
        return excluded.subspan(static_cast<std::size_t>(first[r]),
                                static_cast<std::size_t>(first[r + 1] - first[r]));
    }
    std::span<const std::int32_t> of(std::int32_t&&) const = delete;
};

// Throws std::invalid_argument, naming array, index and value, unless `first` rises from 0 to the
// length of `excluded`, and each list rises and has rows of `first` only.
void require_excluded_rows(const ExcludedRows& rows);

}  // namespace rightofway
