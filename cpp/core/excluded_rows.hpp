// The rows from which a booking of each row excludes other robots, and the one check of these
// lists.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace rightofway {

// A booking of row r excludes others from the rows excluded[first[r]] .. excluded[first[r + 1] -
// 1]; see Resources in problem.hpp. Borrowed, empty where no robot has a size.
struct ExcludedRows {
    std::span<const std::int32_t> first;
    std::span<const std::int32_t> excluded;
};

// Throws std::invalid_argument, naming array, index and value, unless `first` rises from 0 to the
// length of `excluded`, and each list rises and has rows of `first` only.
void require_excluded_rows(const ExcludedRows& rows);

}  // namespace rightofway
