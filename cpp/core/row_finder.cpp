#include "core/row_finder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "core/reject.hpp"

namespace rightofway {
namespace {

// Cells along an axis, at most, so that the number of a cell fits 64 bits.
constexpr double most_cells = 1 << 20;
// Cells are this much wider than the distances that they are for: more than rounding moves points.
constexpr double margin = 1 + 1e-6;
constexpr std::int64_t border = 3;  // free cells beside each row of cells

constexpr double longest = 1e100;

constexpr double rounding = std::numeric_limits<double>::epsilon() / 2;
// A coordinate is off by 2 roundings, a difference of two by 6, the sum of two products of
// differences by 16 times the differences; this is four times as much.
constexpr double doubtful = 64 * rounding;

void sort_unique(std::vector<std::int32_t>& values) {
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
}

// Throws unless all are lengths: numbers that are not negative, and whose squares are finite.
void require_lengths(const char* name, std::span<const double> values) {
    for (std::size_t k = 0; k < values.size(); ++k) {
        if (!(values[k] >= 0 && values[k] <= longest)) {
            throw std::invalid_argument(std::string(name) + "[" + std::to_string(k) +
                                        "]: " + std::to_string(values[k]) +
                                        " is no length (give 0 to 1e100)");
        }
    }
}

}  // namespace

RowFinder::Cells::Cells(std::vector<std::pair<std::int64_t, std::int32_t>> entries) {
    std::sort(entries.begin(), entries.end());
    entry.reserve(entries.size());
    for (const auto& [cell, number] : entries) {
        if (key.empty() || key.back() != cell) {
            key.push_back(cell);
            first.push_back(static_cast<std::int32_t>(entry.size()));
        }
        entry.push_back(number);
    }
    first.push_back(static_cast<std::int32_t>(entry.size()));
}

RowFinder::RowFinder(const DrawingArrays& arrays)
    : indptr_(arrays.graph.indptr.begin(), arrays.graph.indptr.end()),
      heads_(arrays.graph.indices.begin(), arrays.graph.indices.end()),
      graph_{indptr_, heads_},
      x_(arrays.x.begin(), arrays.x.end()),
      y_(arrays.y.begin(), arrays.y.end()),
      limbs_(arrays.limbs.begin(), arrays.limbs.end()),
      n_limbs_(static_cast<std::size_t>(std::max(arrays.n_limbs, 1))),
      distance_(arrays.distance.begin(), arrays.distance.end()),
      distance_limbs_(arrays.distance_limbs.begin(), arrays.distance_limbs.end()),
      n_sizes_(arrays.n_sizes) {
    require_graph(graph_, "heads");
    const auto n_vertices = static_cast<std::size_t>(graph_.n_vertices());
    require_range("n_sizes", n_sizes_, 1, 1 << 15);
    const auto n_pairs = index(n_sizes_) * index(n_sizes_);
    require_length("x", x_.size(), n_vertices);
    require_length("y", y_.size(), n_vertices);
    require_length("limbs", limbs_.size(), 2 * n_vertices * n_limbs_);
    require_length("distance", distance_.size(), n_pairs);
    require_length("distance_limbs", distance_limbs_.size(), n_pairs * n_limbs_);
    require_lengths("x", x_);
    require_lengths("y", y_);
    require_lengths("distance", distance_);
    require_range("rows", static_cast<std::int64_t>(n_sizes_) * n_resources(), 0,
                  std::numeric_limits<std::int32_t>::max() - 1);
    index_zones(arrays);
    index_chains(arrays);
    if (*std::max_element(distance_.begin(), distance_.end()) > 0) {
        if (!arrays.is_grid) {
            index_lanes();
        }
        index_places();
    }
    may_exclude_edges_ =
        !lanes_.empty() || std::any_of(zone_of_.begin(), zone_of_.end(), [&](const auto& one) {
            return one.first >= graph_.n_vertices();
        });
    // Value-initialized: no row is known.
    rows_ = std::make_unique<std::atomic<const std::int32_t*>[]>(index(n_rows()));
}

RowFinder::~RowFinder() {
    for (std::int32_t row = 0; row < n_rows(); ++row) {
        delete[] rows_[index(row)].load(std::memory_order_relaxed);
    }
}

void RowFinder::index_zones(const DrawingArrays& arrays) {
    if (arrays.zone_first.empty()) {
        return;
    }
    require_lists("zone_first", arrays.zone_first, arrays.zone_member.size());
    require_ids("zone_member", arrays.zone_member, n_resources());
    for (std::size_t z = 0; z + 1 < arrays.zone_first.size(); ++z) {
        const auto begin = index(arrays.zone_first[z]);
        const auto count = index(arrays.zone_first[z + 1]) - begin;
        const auto members = arrays.zone_member.subspan(begin, count);
        for (const std::int32_t member : members) {
            zone_of_.emplace_back(member, static_cast<std::int32_t>(z));
        }
        zones_.emplace_back(members.begin(), members.end());
    }
    std::sort(zone_of_.begin(), zone_of_.end());
}

// A chain has the resources that its vertices and the edges between them are, both ways.
void RowFinder::index_chains(const DrawingArrays& arrays) {
    if (arrays.chain_first.empty()) {
        return;
    }
    require_lists("chain_first", arrays.chain_first, arrays.chain_vertex.size());
    require_ids("chain_vertex", arrays.chain_vertex, graph_.n_vertices());
    chain_inside_.assign(index(graph_.n_vertices()), none);
    for (std::size_t c = 0; c + 1 < arrays.chain_first.size(); ++c) {
        const auto begin = index(arrays.chain_first[c]);
        const auto count = index(arrays.chain_first[c + 1]) - begin;
        const auto vertices = arrays.chain_vertex.subspan(begin, count);
        const auto chain = static_cast<std::int32_t>(c);
        for (std::size_t k = 0; k < vertices.size(); ++k) {
            chain_of_.emplace_back(vertices[k], chain);
            if (k > 0 && k + 1 < vertices.size()) {
                chain_inside_[index(vertices[k])] = chain;
            }
            const EdgeId edge = k == 0 ? none : graph_.edge(vertices[k - 1], vertices[k]);
            if (edge >= 0) {
                chain_of_.emplace_back(graph_.n_vertices() + edge, chain);
            }
        }
        chains_.emplace_back(vertices.begin(), vertices.end());
    }
    std::sort(chain_of_.begin(), chain_of_.end());
}

void RowFinder::index_lanes() {
    lane_of_.assign(heads_.size(), none);
    for (VertexId tail = 0; tail < graph_.n_vertices(); ++tail) {
        for (EdgeId e = indptr_[index(tail)]; e < indptr_[index(tail + 1)]; ++e) {
            const VertexId head = heads_[index(e)];
            const EdgeId back = graph_.edge(head, tail);
            if (back >= 0 && head < tail) {
                lane_of_[index(e)] = lane_of_[index(back)];
                continue;
            }
            lane_of_[index(e)] = static_cast<std::int32_t>(lanes_.size());
            lanes_.push_back({tail, head, e, back});
        }
    }
}

// Puts the vertices and the pieces of lanes into cells.
void RowFinder::index_places() {
    double length = 0;
    for (const Lane& lane : lanes_) {
        length += std::sqrt(square(lane.a, lane.b));
    }
    const double mean = lanes_.empty() ? 0 : length / static_cast<double>(lanes_.size());
    for (std::size_t v = 0; v < x_.size(); ++v) {
        extent_ = std::max({extent_, x_[v], y_[v]});
    }
    const double largest = *std::max_element(distance_.begin(), distance_.end());
    side_ = margin * std::max({largest, mean / 2, extent_ / most_cells});
    width_ = static_cast<std::int64_t>(extent_ / side_) + 1 + 2 * border;
    std::vector<std::pair<std::int64_t, std::int32_t>> entries;
    for (VertexId v = 0; v < graph_.n_vertices(); ++v) {
        entries.emplace_back(row_of_cells(y_[index(v)]) * width_ + column(x_[index(v)]), v);
    }
    vertices_ = Cells(std::move(entries));
    entries.clear();
    for (std::int32_t lane = 0; lane < static_cast<std::int32_t>(lanes_.size()); ++lane) {
        for_each_middle(lane, [&](double x, double y) {
            entries.emplace_back(row_of_cells(y) * width_ + column(x), lane);
        });
    }
    pieces_ = Cells(std::move(entries));
}

std::int64_t RowFinder::column(double x) const {
    return static_cast<std::int64_t>(std::floor(x / side_)) + border;
}

std::int64_t RowFinder::row_of_cells(double y) const {
    return static_cast<std::int64_t>(std::floor(y / side_)) + border;
}

// Calls `use` with the middle of each piece of a lane; pieces are no longer than a cell.
template <class Use>
void RowFinder::for_each_middle(std::int32_t lane, const Use& use) const {
    const auto a = index(lanes_[index(lane)].a);
    const auto b = index(lanes_[index(lane)].b);
    const double dx = x_[b] - x_[a];
    const double dy = y_[b] - y_[a];
    const auto count =
        std::max<std::int64_t>(1, std::llround(std::ceil(margin * std::hypot(dx, dy) / side_)));
    for (std::int64_t k = 0; k < count; ++k) {
        const double share = (static_cast<double>(k) + 0.5) / static_cast<double>(count);
        use(x_[a] + share * dx, y_[a] + share * dy);
    }
}

// Calls `use` with the entries of the cells that are at most some rings away from a point.
template <class Use>
void RowFinder::for_each_near(const Cells& cells, double x, double y, std::int64_t rings,
                              const Use& use) const {
    for (std::int64_t row = row_of_cells(y) - rings; row <= row_of_cells(y) + rings; ++row) {
        const std::int64_t middle = row * width_ + column(x);
        auto cell = std::lower_bound(cells.key.begin(), cells.key.end(), middle - rings);
        for (; cell != cells.key.end() && *cell <= middle + rings; ++cell) {
            const auto k = static_cast<std::size_t>(cell - cells.key.begin());
            for (std::int32_t e = cells.first[k]; e < cells.first[k + 1]; ++e) {
                use(cells.entry[index(e)]);
            }
        }
    }
}

std::span<const std::int32_t> RowFinder::of(std::int32_t row) const {
    auto& place = rows_[index(row)];
    const std::int32_t* known = place.load(std::memory_order_acquire);
    if (known == nullptr) {
        const std::vector<std::int32_t> rows = found(row);
        auto list = std::make_unique<std::int32_t[]>(rows.size() + 1);
        list[0] = static_cast<std::int32_t>(rows.size());
        std::copy(rows.begin(), rows.end(), list.get() + 1);
        // Another thread may have found the same meanwhile: then its list stays.
        if (place.compare_exchange_strong(known, list.get(), std::memory_order_acq_rel)) {
            known = list.release();
            n_found_.fetch_add(1, std::memory_order_relaxed);
        }
    }
    return {known + 1, static_cast<std::size_t>(known[0])};
}

std::vector<std::int32_t> RowFinder::found(std::int32_t row) const {
    const std::int32_t size = row / n_resources();
    const std::int32_t resource = row % n_resources();
    std::vector<std::int32_t> rows;
    const std::int32_t chain = resource < graph_.n_vertices() && !chain_inside_.empty()
                                   ? chain_inside_[index(resource)]
                                   : none;
    if (chain == none) {
        add_own(size, resource, rows);
    } else {  // the whole chain is booked for as long as a robot drives along it
        const std::vector<VertexId>& vertices = chains_[index(chain)];
        for (std::size_t k = 0; k < vertices.size(); ++k) {
            add_own(size, vertices[k], rows);
            const EdgeId edge = k == 0 ? none : graph_.edge(vertices[k - 1], vertices[k]);
            if (edge >= 0) {
                add_own(size, graph_.n_vertices() + edge, rows);
            }
        }
    }
    add_chains(rows);
    sort_unique(rows);
    return rows;
}

void RowFinder::add_own(std::int32_t size, std::int32_t resource,
                        std::vector<std::int32_t>& rows) const {
    add_zones(resource, rows);
    if (resource < graph_.n_vertices()) {
        add_vertex(size, resource, rows);
    } else if (!lanes_.empty()) {
        add_lane(size, lane_of_[index(resource - graph_.n_vertices())], rows);
    }
}

// What excludes a part of a chain, excludes all vertices between its ends.
void RowFinder::add_chains(std::vector<std::int32_t>& rows) const {
    if (chains_.empty()) {
        return;
    }
    sort_unique(rows);
    std::vector<std::pair<std::int32_t, std::int32_t>> touched;  // (size class, chain)
    for (const std::int32_t row : rows) {
        const std::int32_t part = row % n_resources();
        auto own = std::lower_bound(chain_of_.begin(), chain_of_.end(), std::pair{part, 0});
        for (; own != chain_of_.end() && own->first == part; ++own) {
            touched.emplace_back(row / n_resources(), own->second);
        }
    }
    std::sort(touched.begin(), touched.end());
    touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
    for (const auto& [size, chain] : touched) {
        const std::vector<VertexId>& vertices = chains_[index(chain)];
        for (std::size_t k = 1; k + 1 < vertices.size(); ++k) {
            rows.push_back(size * n_resources() + vertices[k]);
        }
    }
}

void RowFinder::add_zones(std::int32_t resource, std::vector<std::int32_t>& rows) const {
    auto own = std::lower_bound(zone_of_.begin(), zone_of_.end(), std::pair{resource, 0});
    for (; own != zone_of_.end() && own->first == resource; ++own) {
        for (const std::int32_t member : zones_[index(own->second)]) {
            for (std::int32_t other = 0; member != resource && other < n_sizes_; ++other) {
                rows.push_back(other * n_resources() + member);
            }
        }
    }
}

// A vertex excludes itself, vertices near to it, and lanes that pass it.
void RowFinder::add_vertex(std::int32_t size, VertexId vertex,
                           std::vector<std::int32_t>& rows) const {
    for (std::int32_t other = 0; other < n_sizes_; ++other) {
        rows.push_back(other * n_resources() + vertex);
    }
    const double x = x_[index(vertex)];
    const double y = y_[index(vertex)];
    for_each_near(vertices_, x, y, 1, [&](VertexId near) {
        for (std::int32_t other = 0; near != vertex && other < n_sizes_; ++other) {
            if (are_nearer(vertex, near, size * n_sizes_ + other)) {
                rows.push_back(other * n_resources() + near);
            }
        }
    });
    std::vector<std::int32_t> lanes;
    for_each_near(pieces_, x, y, 2, [&](std::int32_t lane) { lanes.push_back(lane); });
    sort_unique(lanes);
    for (const std::int32_t lane : lanes) {
        for (std::int32_t other = 0; other < n_sizes_; ++other) {
            if (passes(vertex, lanes_[index(lane)], size * n_sizes_ + other)) {
                add_edges(other, lane, rows);
            }
        }
    }
}

// A lane excludes vertices that it passes, and lanes that it crosses.
void RowFinder::add_lane(std::int32_t size, std::int32_t lane,
                         std::vector<std::int32_t>& rows) const {
    const Lane& own = lanes_[index(lane)];
    std::vector<std::int32_t> vertices;
    std::vector<std::int32_t> lanes;
    for_each_middle(lane, [&](double x, double y) {
        for_each_near(vertices_, x, y, 2, [&](VertexId near) { vertices.push_back(near); });
        for_each_near(pieces_, x, y, 1, [&](std::int32_t near) { lanes.push_back(near); });
    });
    sort_unique(vertices);
    for (const VertexId vertex : vertices) {
        for (std::int32_t other = 0; other < n_sizes_; ++other) {
            if (passes(vertex, own, size * n_sizes_ + other)) {
                rows.push_back(other * n_resources() + vertex);
            }
        }
    }
    sort_unique(lanes);
    for (const std::int32_t near : lanes) {
        if (near == lane || !cross(own, lanes_[index(near)])) {
            continue;
        }
        for (std::int32_t other = 0; other < n_sizes_; ++other) {
            if (distance_[index(size * n_sizes_ + other)] > 0) {
                add_edges(other, near, rows);
            }
        }
    }
}

void RowFinder::add_edges(std::int32_t other_size, std::int32_t lane,
                          std::vector<std::int32_t>& rows) const {
    const std::int32_t first = other_size * n_resources() + graph_.n_vertices();
    rows.push_back(first + lanes_[index(lane)].edge);
    if (lanes_[index(lane)].back != none) {
        rows.push_back(first + lanes_[index(lane)].back);
    }
}

double RowFinder::square(VertexId one, VertexId other) const {
    const double dx = x_[index(one)] - x_[index(other)];
    const double dy = y_[index(one)] - y_[index(other)];
    return dx * dx + dy * dy;
}

// How far off the sum of two products may be, of differences of this sum.
double RowFinder::doubt(double differences) const { return doubtful * extent_ * differences; }

Whole RowFinder::exact(VertexId vertex, std::size_t axis) const {
    const std::span<const std::uint32_t> limbs(limbs_);
    return Whole(limbs.subspan((2 * index(vertex) + axis) * n_limbs_, n_limbs_));
}

Whole RowFinder::exact_square(VertexId one, VertexId other) const {
    const Whole dx = exact(one, 0) - exact(other, 0);
    const Whole dy = exact(one, 1) - exact(other, 1);
    return dx * dx + dy * dy;
}

Whole RowFinder::exact_side(VertexId vertex, const Lane& lane) const {
    return (exact(lane.b, 0) - exact(lane.a, 0)) * (exact(vertex, 1) - exact(lane.a, 1)) -
           (exact(lane.b, 1) - exact(lane.a, 1)) * (exact(vertex, 0) - exact(lane.a, 0));
}

// The square of the least distance of two size classes.
Whole RowFinder::exact_limit(std::int32_t pair) const {
    const std::span<const std::uint32_t> limbs(distance_limbs_);
    const Whole root(limbs.subspan(index(pair) * n_limbs_, n_limbs_));
    return root * root;
}

// Whether two vertices are nearer to each other than a pair of size classes may be.
bool RowFinder::are_nearer(VertexId one, VertexId other, std::int32_t pair) const {
    const double distance = distance_[index(pair)];
    if (distance <= 0) {
        return false;
    }
    const double excess = square(one, other) - distance * distance;
    const double differences =
        std::abs(x_[index(one)] - x_[index(other)]) + std::abs(y_[index(one)] - y_[index(other)]);
    if (std::abs(excess) > doubt(differences) + doubtful * distance * distance) {
        return excess < 0;
    }
    return exact_square(one, other) < exact_limit(pair);
}

// The sign of the scalar product of the ways from `from` to a vertex and to `to`.
int RowFinder::sign_of_along(VertexId vertex, VertexId from, VertexId to) const {
    const double dx = x_[index(to)] - x_[index(from)];
    const double dy = y_[index(to)] - y_[index(from)];
    const double wx = x_[index(vertex)] - x_[index(from)];
    const double wy = y_[index(vertex)] - y_[index(from)];
    const double along = dx * wx + dy * wy;
    if (std::abs(along) > doubt(std::abs(dx) + std::abs(dy) + std::abs(wx) + std::abs(wy))) {
        return along > 0 ? 1 : -1;
    }
    return ((exact(to, 0) - exact(from, 0)) * (exact(vertex, 0) - exact(from, 0)) +
            (exact(to, 1) - exact(from, 1)) * (exact(vertex, 1) - exact(from, 1)))
        .sign();
}

// Whether a lane comes nearer to a vertex than a pair of size classes may be, and its ends do not.
bool RowFinder::passes(VertexId vertex, const Lane& lane, std::int32_t pair) const {
    const double distance = distance_[index(pair)];
    if (distance <= 0 || vertex == lane.a || vertex == lane.b) {
        return false;
    }
    const double dx = x_[index(lane.b)] - x_[index(lane.a)];
    const double dy = y_[index(lane.b)] - y_[index(lane.a)];
    const double wx = x_[index(vertex)] - x_[index(lane.a)];
    const double wy = y_[index(vertex)] - y_[index(lane.a)];
    const double length = std::hypot(dx, dy);
    const double differences = std::abs(dx) + std::abs(dy) + std::abs(wx) + std::abs(wy);
    const double excess = std::abs(dx * wy - dy * wx) - distance * length;
    const double open = doubt(differences + distance) + doubtful * distance * length;
    if (excess > open) {
        return false;
    }
    if (sign_of_along(vertex, lane.a, lane.b) <= 0 || sign_of_along(vertex, lane.b, lane.a) <= 0 ||
        are_nearer(vertex, lane.a, pair) || are_nearer(vertex, lane.b, pair)) {
        return false;
    }
    if (excess < -open) {
        return true;
    }
    const Whole side = exact_side(vertex, lane);
    return side * side < exact_limit(pair) * exact_square(lane.a, lane.b);
}

// The sign of the side of a lane on which a vertex lies.
int RowFinder::side(VertexId vertex, const Lane& lane) const {
    const double dx = x_[index(lane.b)] - x_[index(lane.a)];
    const double dy = y_[index(lane.b)] - y_[index(lane.a)];
    const double wx = x_[index(vertex)] - x_[index(lane.a)];
    const double wy = y_[index(vertex)] - y_[index(lane.a)];
    const double value = dx * wy - dy * wx;
    if (std::abs(value) > doubt(std::abs(dx) + std::abs(dy) + std::abs(wx) + std::abs(wy))) {
        return value > 0 ? 1 : -1;
    }
    return exact_side(vertex, lane).sign();
}

bool RowFinder::lie_on_both_sides(const Lane& line, VertexId one, VertexId other) const {
    const int first = side(one, line);
    return first != 0 && first == -side(other, line);
}

// Whether two lanes cross in a point that is an end of neither.
bool RowFinder::cross(const Lane& one, const Lane& other) const {
    if (one.a == other.a || one.a == other.b || one.b == other.a || one.b == other.b) {
        return false;
    }
    return lie_on_both_sides(one, other.a, other.b) && lie_on_both_sides(other, one.a, one.b);
}

}  // namespace rightofway
