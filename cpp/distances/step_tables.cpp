#include "distances/step_tables.hpp"

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

#include "core/reject.hpp"
#include "core/reverse_graph.hpp"
#include "core/thread_group.hpp"

namespace rightofway {
namespace {

constexpr std::size_t first_block_size = std::size_t{1} << 20;
constexpr std::size_t most_block_size = std::size_t{1} << 26;
// The greatest distance of a vertex from the first vertex of its line [edges].
constexpr std::int32_t line_radius = 15;
// The most vertices that are looked at to fill a line; bounds the time on dense graphs.
constexpr std::size_t most_for_a_line = 2048;
constexpr std::int32_t most_steps = std::numeric_limits<std::uint16_t>::max() - 1;
constexpr std::size_t requests_between_questions = 64;
constexpr std::size_t least_for_a_thread = 16;

// Whether some edge has no opposite edge.
bool has_one_way(const Graph& graph) {
    const std::vector<EdgeId> opposite = find_opposite_edges(graph);
    return std::find(opposite.begin(), opposite.end(), none) != opposite.end();
}

// Reads scatter over all tables; with small pages, page lookups take most of the time.
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
    : is_wide_(has_one_way(graph)),
      place_(static_cast<std::size_t>(graph.n_vertices()), none),
      source_(graph.indices.size()),
      by_target_(place_.size(), none) {
    find_places(graph);
    arriving_.assign(static_cast<std::size_t>(size_) + 1, 0);
    const ReverseGraph reverse(graph);
    for (VertexId v = 0; v < graph.n_vertices(); ++v) {
        arriving_[index(place_[index(v)] + 1)] = static_cast<EdgeId>(reverse.tails(v).size());
    }
    std::partial_sum(arriving_.begin(), arriving_.end(), arriving_.begin());
    for (VertexId v = 0; v < graph.n_vertices(); ++v) {
        const auto tails = reverse.tails(v);
        std::transform(tails.begin(), tails.end(),
                       source_.begin() + arriving_[index(place_[index(v)])],
                       [this](VertexId tail) { return place_[index(tail)]; });
    }
}

// Each line takes the first vertex without a place and its nearest vertices without a place.
void StepTables::find_places(const Graph& graph) {
    const Place cell_size = is_wide_ ? 2 : 1;
    std::vector<VertexId> reached;
    std::vector<VertexId> reached_from(place_.size(), none);  // by the search of this first vertex
    for (VertexId first = 0; first < graph.n_vertices(); ++first) {
        if (place_[index(first)] != none) {
            continue;
        }
        Place next = size_ + (is_wide_ ? 0 : 2);
        size_ += line_size;
        reached.assign(1, first);
        reached_from[index(first)] = first;
        std::size_t end_of_level = 1;
        std::int32_t distance = 0;
        for (std::size_t k = 0; k < reached.size() && k < most_for_a_line && next < size_; ++k) {
            if (k == end_of_level) {
                end_of_level = reached.size();
                if (++distance > line_radius) {
                    break;
                }
            }
            if (place_[index(reached[k])] == none) {
                place_[index(reached[k])] = next;
                next += cell_size;
            }
            for (const VertexId head : graph.heads(reached[k])) {
                if (reached_from[index(head)] != first) {
                    reached_from[index(head)] = first;
                    reached.push_back(head);
                }
            }
        }
    }
}

StepTables::TableId StepTables::table_of(VertexId target) {
    require_id("target", target, n_vertices());
    if (by_target_[index(target)] == none) {
        by_target_[index(target)] = static_cast<TableId>(cells_.size());
        cells_.push_back(new_cells());
        searches_.push_back({{place_[index(target)]}, 0});
        is_wide_ ? write<true>(cells_.back(), place_[index(target)], 0)
                 : write<false>(cells_.back(), place_[index(target)], 0);
    }
    return by_target_[index(target)];
}

template <bool is_wide>
void StepTables::write(Byte* table, Place place, std::int32_t steps) {
    if constexpr (is_wide) {
        *reinterpret_cast<std::uint16_t*>(table + place) = static_cast<std::uint16_t>(steps + 1);
    } else {
        if (base(table, place) == 0) {  // breadth-first order: the first count is the least
            *reinterpret_cast<std::uint16_t*>(table + place / line_size * line_size) =
                static_cast<std::uint16_t>(steps + 1);
        }
        table[place] = static_cast<Byte>(steps + 2 - base(table, place));
    }
}

// Takes a table from a block of zeroed memory, which the system mostly provides page by page at the
// first use. Each block is twice as large as the block before.
StepTables::Byte* StepTables::new_cells() {
    const auto size = static_cast<std::size_t>(size_);
    if (n_free_ < size) {
        const std::size_t wanted =
            std::min(first_block_size << std::min<std::size_t>(blocks_.size(), 6), most_block_size);
        n_free_ = std::max(wanted / size, std::size_t{1}) * size;
        void* block = std::calloc(n_free_ + line_size, 1);
        if (block == nullptr) {
            throw std::bad_alloc();
        }
        blocks_.emplace_back(static_cast<Byte*>(block));
        ask_for_large_pages(block, n_free_);
        const auto past_line = reinterpret_cast<std::uintptr_t>(block) % line_size;
        next_cells_ = blocks_.back().get() + (line_size - past_line) % line_size;
    }
    n_free_ -= size;
    next_cells_ += size;
    return next_cells_ - size;
}

std::int32_t StepTables::search_on(TableId table, VertexId from) {
    search_up_to(table, from, reached_);
    if (const std::int32_t steps = read(cells_[index(table)], place_[index(from)]); steps >= 0) {
        return steps;
    }
    if (!searches_[index(table)].frontier.empty()) {
        throw std::overflow_error("robots: more than " + std::to_string(most_steps) +
                                  " edges lead to a place (use a coarser map)");
    }
    return unreachable;
}

// No two threads share a table.
void StepTables::search_all(std::span<const Request> requests) {
    const auto search_share = [&](std::size_t share, std::size_t n_shares) {
        std::vector<Place> reached;
        for (const auto& [table, from] : requests) {
            if (static_cast<std::size_t>(table) % n_shares == share) {
                search_up_to(table, from, reached);
            }
        }
    };
    const std::size_t n_shares = std::clamp<std::size_t>(std::thread::hardware_concurrency(), 1,
                                                         1 + requests.size() / least_for_a_thread);
    ThreadGroup others;
    for (std::size_t share = 1; share < n_shares; ++share) {
        others.start([&, share] { search_share(share, n_shares); }, [] {});
    }
    search_share(0, n_shares);
    others.join();
}

// Counts level by level until the count of a vertex is known, no vertex is left, or the next count
// would not fit. Most of the time of a first plan is spent here, so the inner loop asks for the
// kind of table once, and `reached` has room for all vertices from the beginning.
void StepTables::search_up_to(TableId table, VertexId from, std::vector<Place>& reached) {
    is_wide_ ? search_up_to<true>(table, from, reached) : search_up_to<false>(table, from, reached);
}

template <bool is_wide>
void StepTables::search_up_to(TableId table, VertexId from, std::vector<Place>& reached) {
    Search& search = searches_[index(table)];
    Byte* const cells = cells_[index(table)];
    const auto is_known = [cells](Place place) {
        return is_wide ? *reinterpret_cast<const std::uint16_t*>(cells + place) != 0
                       : cells[place] != 0;
    };
    reached.resize(place_.size());
    std::copy(search.frontier.begin(), search.frontier.end(), reached.begin());
    // Of its own: a byte that is written may be part of anything that the compiler does not know.
    const EdgeId* const arriving = arriving_.data();
    const Place* const sources = source_.data();
    Place* const queue = reached.data();
    const Place wanted = place_[index(from)];
    std::int32_t depth = search.depth;
    std::size_t end = search.frontier.size();
    std::size_t next = 0;
    while (!is_known(wanted) && next < end && depth < most_steps) {
        ++depth;
        for (const std::size_t end_of_level = end; next < end_of_level; ++next) {
            const EdgeId* const edges = arriving + queue[next];
            for (EdgeId k = edges[0]; k < edges[1]; ++k) {
                const Place source = sources[k];
                if (!is_known(source)) {
                    write<is_wide>(cells, source, depth);
                    queue[end++] = source;
                }
            }
        }
    }
    search.depth = depth;
    search.frontier.assign(reached.begin() + static_cast<std::ptrdiff_t>(next),
                           reached.begin() + static_cast<std::ptrdiff_t>(end));
}

SearchEnd reach_all(const Problem& problem, StepTables& tables, const StopCondition& is_over) {
    std::vector<StepTables::Request> legs;
    for (RobotId r = 0; r < problem.n_robots(); ++r) {
        VertexId place = problem.home(r);
        for (std::int32_t s = problem.first_stage(r); s < problem.first_stage(r + 1); ++s) {
            legs.push_back({tables.table_of(problem.stage_vertex(s)), place});
            place = problem.stage_vertex(s);
        }
    }
    for (std::size_t first = 0; first < legs.size(); first += requests_between_questions) {
        const auto some = std::span(legs).subspan(
            first, std::min(requests_between_questions, legs.size() - first));
        tables.search_all(some);
        for (const StepTables::Request& leg : some) {
            if (tables.steps(leg.table, leg.from) == StepTables::unreachable) {
                return SearchEnd::proven_none;
            }
        }
        if (some.size() == requests_between_questions && is_over()) {
            return SearchEnd::stopped;
        }
    }
    return SearchEnd::found;
}

}  // namespace rightofway
