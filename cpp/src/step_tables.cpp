#include "rightofway/step_tables.hpp"

#include <limits>
#include <new>
#include <numeric>
#include <stdexcept>
#include <string>

#include "rightofway/reject.hpp"

namespace rightofway {
namespace {

constexpr StepTables::TableId none = -1;
constexpr std::size_t block_cells = std::size_t{1} << 23;

}  // namespace

StepTables::StepTables(const Graph& graph)
    : arriving_(graph.indptr.size(), 0),
      source_(graph.indices.size()),
      by_target_(static_cast<std::size_t>(graph.n_vertices()), none) {
    for (const VertexId head : graph.indices) {
        ++arriving_[head + 1];
    }
    std::partial_sum(arriving_.begin(), arriving_.end(), arriving_.begin());
    std::vector<EdgeId> next(arriving_.begin(), arriving_.end() - 1);
    for (VertexId v = 0; v < graph.n_vertices(); ++v) {
        for (const VertexId head : graph.heads(v)) {
            source_[next[head]++] = v;
        }
    }
}

StepTables::TableId StepTables::table_of(VertexId target) {
    require_id("target", target, n_vertices());
    if (by_target_[target] == none) {
        by_target_[target] = static_cast<TableId>(tables_.size());
        tables_.push_back({new_cells(), {target}, 0});
        tables_.back().cells[target] = 1;
    }
    return by_target_[target];
}

// Tables come from large blocks: the system hands these out zeroed, page by page as they are used.
std::uint16_t* StepTables::new_cells() {
    const auto size = static_cast<std::size_t>(n_vertices());
    const std::size_t per_block = std::max<std::size_t>(1, block_cells / size);
    if (free_in_block_ == 0) {
        void* block = std::calloc(per_block * size, sizeof(std::uint16_t));
        if (block == nullptr) {
            throw std::bad_alloc();
        }
        blocks_.emplace_back(static_cast<std::uint16_t*>(block));
        free_in_block_ = per_block;
    }
    return blocks_.back().get() + (per_block - free_in_block_--) * size;
}

std::int32_t StepTables::search_on(TableId id, VertexId from) {
    Table& table = tables_[id];
    while (!table.frontier.empty()) {
        next_level(table);
        if (table.cells[from] != 0) {
            return table.cells[from] - 1;
        }
    }
    return unreachable;
}

void StepTables::next_level(Table& table) {
    constexpr std::int32_t most = std::numeric_limits<std::uint16_t>::max() - 1;
    if (++table.depth > most) {
        throw std::overflow_error("steps: more than " + std::to_string(most) + " to a target");
    }
    const auto cell = static_cast<std::uint16_t>(table.depth + 1);
    scratch_.clear();
    for (const VertexId v : table.frontier) {
        for (EdgeId k = arriving_[v]; k < arriving_[v + 1]; ++k) {
            if (table.cells[source_[k]] == 0) {
                table.cells[source_[k]] = cell;
                scratch_.push_back(source_[k]);
            }
        }
    }
    table.frontier.assign(scratch_.begin(), scratch_.end());
}

}  // namespace rightofway
