#include "rightofway/step_tables.hpp"

#ifdef __linux__
#include <sys/mman.h>
#endif

#include <algorithm>
#include <limits>
#include <new>
#include <numeric>
#include <stdexcept>
#include <string>
#include <thread>

#include "rightofway/reject.hpp"

namespace rightofway {
namespace {

constexpr StepTables::TableId none = -1;
constexpr std::size_t cells_per_line = 32;
constexpr std::size_t first_block_cells = std::size_t{1} << 19;
constexpr std::size_t most_block_cells = std::size_t{1} << 25;
constexpr std::int32_t most_steps = std::numeric_limits<std::uint16_t>::max() - 1;
constexpr std::size_t legs_between_questions = 64;
constexpr std::size_t least_for_a_thread = 16;

constexpr std::size_t whole_lines(std::size_t cells) {
    return (cells + cells_per_line - 1) / cells_per_line * cells_per_line;
}

// Robots read from all over their tables: with small pages, most of the time goes to finding these.
void ask_for_large_pages([[maybe_unused]] void* block, [[maybe_unused]] std::size_t bytes) {
#if defined(__linux__) && defined(MADV_HUGEPAGE)
    constexpr std::size_t large = std::size_t{1} << 21;
    constexpr std::size_t worth_it = 8 * large;
    const auto first = (reinterpret_cast<std::uintptr_t>(block) + large - 1) / large * large;
    const auto end = (reinterpret_cast<std::uintptr_t>(block) + bytes) / large * large;
    if (bytes >= worth_it) {
        madvise(reinterpret_cast<void*>(first), end - first, MADV_HUGEPAGE);
    }
#endif
}

}  // namespace

StepTables::StepTables(const Graph& graph)
    : place_(static_cast<std::size_t>(graph.n_vertices()), none),
      arriving_(graph.indptr.size(), 0),
      source_(graph.indices.size()),
      by_target_(place_.size(), none) {
    find_places(graph);
    for (const VertexId head : graph.indices) {
        ++arriving_[place_[head] + 1];
    }
    std::partial_sum(arriving_.begin(), arriving_.end(), arriving_.begin());
    std::vector<EdgeId> next(arriving_.begin(), arriving_.end() - 1);
    for (VertexId v = 0; v < graph.n_vertices(); ++v) {
        for (const VertexId head : graph.heads(v)) {
            source_[next[place_[head]]++] = place_[v];
        }
    }
}

// Patches of as many vertices as a line holds, each grown from the first vertex left over.
void StepTables::find_places(const Graph& graph) {
    Place n_placed = 0;
    std::vector<VertexId> patch;
    for (VertexId first = 0; first < graph.n_vertices(); ++first) {
        if (place_[first] != none) {
            continue;
        }
        patch.assign(1, first);
        place_[first] = n_placed++;
        for (std::size_t k = 0; k < patch.size(); ++k) {
            for (const VertexId head : graph.heads(patch[k])) {
                if (place_[head] == none && n_placed % cells_per_line != 0) {
                    place_[head] = n_placed++;
                    patch.push_back(head);
                }
            }
        }
    }
}

StepTables::TableId StepTables::table_of(VertexId target) {
    require_id("target", target, n_vertices());
    if (by_target_[target] == none) {
        by_target_[target] = static_cast<TableId>(cells_.size());
        cells_.push_back(new_cells());
        searches_.push_back({{place_[target]}, 0});
        cells_.back()[place_[target]] = 1;
    }
    return by_target_[target];
}

// Tables come from blocks that the system hands out zeroed, and mostly page by page as they are
// used. Each is twice as large as the one before.
StepTables::Cell* StepTables::new_cells() {
    const std::size_t size = whole_lines(place_.size());
    if (n_free_ < size) {
        const std::size_t wanted = std::min(
            first_block_cells << std::min<std::size_t>(blocks_.size(), 6), most_block_cells);
        const std::size_t n_cells = std::max(wanted / size, std::size_t{1}) * size;
        void* block = std::calloc(n_cells + cells_per_line, sizeof(Cell));
        if (block == nullptr) {
            throw std::bad_alloc();
        }
        blocks_.emplace_back(static_cast<Cell*>(block));
        ask_for_large_pages(block, n_cells * sizeof(Cell));
        const std::size_t offset = reinterpret_cast<std::uintptr_t>(block) / sizeof(Cell);
        next_cells_ = blocks_.back().get() + whole_lines(offset) - offset;
        n_free_ = n_cells;
    }
    n_free_ -= size;
    next_cells_ += size;
    return next_cells_ - size;
}

std::int32_t StepTables::search_on(TableId table, VertexId from) {
    while (!searches_[table].frontier.empty()) {
        next_level(table, scratch_);
        if (const Cell cell = cells_[table][place_[from]]; cell != 0) {
            return cell - 1;
        }
    }
    return unreachable;
}

// Each thread has tables of its own.
void StepTables::search_all(std::span<const Request> requests) {
    const auto search_share = [&](std::size_t share, std::size_t n_shares) {
        std::vector<Place> scratch;
        for (const auto& [table, from] : requests) {
            if (static_cast<std::size_t>(table) % n_shares != share) {
                continue;
            }
            const Search& search = searches_[table];
            while (cells_[table][place_[from]] == 0 && !search.frontier.empty() &&
                   search.depth < most_steps) {
                next_level(table, scratch);
            }
        }
    };
    const std::size_t n_shares = std::clamp<std::size_t>(std::thread::hardware_concurrency(), 1,
                                                         1 + requests.size() / least_for_a_thread);
    std::vector<std::jthread> threads;
    for (std::size_t share = 1; share < n_shares; ++share) {
        threads.emplace_back(search_share, share, n_shares);
    }
    search_share(0, n_shares);
}

void StepTables::next_level(TableId table, std::vector<Place>& scratch) {
    Search& search = searches_[table];
    if (++search.depth > most_steps) {
        throw std::overflow_error("steps: more than " + std::to_string(most_steps) +
                                  " to a target");
    }
    Cell* const cells = cells_[table];
    const auto cell = static_cast<Cell>(search.depth + 1);
    scratch.clear();
    for (const Place place : search.frontier) {
        for (EdgeId k = arriving_[place]; k < arriving_[place + 1]; ++k) {
            if (cells[source_[k]] == 0) {
                cells[source_[k]] = cell;
                scratch.push_back(source_[k]);
            }
        }
    }
    search.frontier.assign(scratch.begin(), scratch.end());
}

SearchEnd reach_all(const Goals& goals, StepTables& tables, const std::function<bool()>& is_over) {
    std::vector<StepTables::Request> legs;
    for (RobotId r = 0; r < goals.n_robots(); ++r) {
        VertexId place = goals.home[r];
        for (std::int32_t s = goals.first_stage[r]; s < goals.first_stage[r + 1]; ++s) {
            legs.push_back({tables.table_of(goals.stage_vertex[s]), place});
            place = goals.stage_vertex[s];
        }
    }
    for (std::size_t first = 0; first < legs.size(); first += legs_between_questions) {
        const auto some =
            std::span(legs).subspan(first, std::min(legs_between_questions, legs.size() - first));
        tables.search_all(some);
        for (const StepTables::Request& leg : some) {
            if (tables.steps(leg.table, leg.from) == StepTables::unreachable) {
                return SearchEnd::proven_none;
            }
        }
        if (some.size() == legs_between_questions && is_over()) {
            return SearchEnd::stopped;
        }
    }
    return SearchEnd::found;
}

}  // namespace rightofway
