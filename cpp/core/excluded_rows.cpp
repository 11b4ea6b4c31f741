#include "core/excluded_rows.hpp"

#include "core/reject.hpp"
#include "core/types.hpp"

namespace rightofway {

void require_excluded_rows(const ExcludedRows& rows) {
    const auto& first = rows.first;
    const auto& excluded = rows.excluded;
    require_lists("first", first, excluded.size());
    const std::size_t n_rows = first.size() - 1;
    for (std::size_t row = 0; row < n_rows; ++row) {
        const auto begin = index(first[row]);
        const auto end = index(first[row + 1]);
        std::int64_t before = -1;
        for (std::size_t k = begin; k < end; ++k) {
            if (excluded[k] < 0 || static_cast<std::size_t>(excluded[k]) >= n_rows) {
                require_ids("excluded", excluded, static_cast<std::int64_t>(n_rows));
            }
            if (excluded[k] <= before) {
                reject_entry("excluded", k, excluded[k],
                             "is not above the entry before it (rows of a list rise)");
            }
            before = excluded[k];
        }
    }
}

}  // namespace rightofway
