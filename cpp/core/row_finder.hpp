// Finds the rows from which a booking of a row excludes other robots, when it is first asked.
//
// A fleet uses few rows of a large roadmap: those that its robots book. A grid of cells holds the
// vertices and the lanes, as the middles of their pieces; a row asks the cells around it. Doubles
// decide what they can decide; integers of any size decide the rest, so that the answer is exact.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/graph.hpp"
#include "core/types.hpp"
#include "core/whole.hpp"

namespace rightofway {

// The roadmap and the sizes of a fleet. K size classes, from the smallest.
struct DrawingArrays {
    Graph graph;
    // Coordinates from the least ones: position v is x[v], y[v] [length unit], and exactly the
    // number in limbs[(2 v + axis) * n_limbs] .. + n_limbs - 1, in multiples of one length.
    std::span<const double> x;
    std::span<const double> y;
    std::span<const std::uint32_t> limbs;
    std::int32_t n_limbs = 1;
    // For classes i and j, at i * K + j: the least distance of two robots, 0 if both are points;
    // exactly, in as many limbs as coordinates.
    std::span<const double> distance;
    std::span<const std::uint32_t> distance_limbs;
    std::int32_t n_sizes = 1;
    // Zone z has the resources zone_member[zone_first[z]] .. [zone_first[z + 1] - 1].
    std::span<const std::int32_t> zone_first = {};
    std::span<const std::int32_t> zone_member = {};
    // Chain c is driven without a stop along the vertices chain_vertex[chain_first[c]] ..
    // [chain_first[c + 1] - 1]. Those between its ends are on no other chain.
    std::span<const std::int32_t> chain_first = {};
    std::span<const std::int32_t> chain_vertex = {};
    // Whether lanes join the vertices of a grid: then they pass no vertex and cross no lane.
    bool is_grid = false;
};

class RowFinder {
  public:
    // Copies the arrays. Throws std::invalid_argument if they do not fit together.
    explicit RowFinder(const DrawingArrays& arrays);
    ~RowFinder();
    RowFinder(const RowFinder&) = delete;
    RowFinder& operator=(const RowFinder&) = delete;

    // Row size * (V + E) + resource, for all size classes.
    std::int32_t n_rows() const { return n_sizes_ * n_resources(); }
    std::int32_t n_resources() const {
        return graph_.n_vertices() + static_cast<std::int32_t>(heads_.size());
    }
    // Whether a list may have an edge: on a grid, only of zones.
    bool may_exclude_edges() const { return may_exclude_edges_; }
    // How many rows have been asked for so far.
    std::int64_t n_found() const { return n_found_.load(std::memory_order_relaxed); }
    // The rows that a row excludes, in increasing order. From any thread.
    std::span<const std::int32_t> of(std::int32_t row) const;

  private:
    // The ends of a lane, and its edges: the second is `none` where it is driven one way.
    struct Lane {
        VertexId a;
        VertexId b;
        EdgeId edge;
        EdgeId back;
    };
    // Numbers by cell: those of cell c are entry[first[c]] .. entry[first[c + 1] - 1].
    struct Cells {
        std::vector<std::int64_t> key;  // of the cells that hold any, rising
        std::vector<std::int32_t> first;
        std::vector<std::int32_t> entry;

        explicit Cells(std::vector<std::pair<std::int64_t, std::int32_t>> entries = {});
    };

    void index_lanes();
    void index_places();
    void index_zones(const DrawingArrays& arrays);
    void index_chains(const DrawingArrays& arrays);
    std::int64_t column(double x) const;
    std::int64_t row_of_cells(double y) const;
    template <class Use>
    void for_each_middle(std::int32_t lane, const Use& use) const;
    template <class Use>
    void for_each_near(const Cells& cells, double x, double y, std::int64_t rings,
                       const Use& use) const;
    std::vector<std::int32_t> found(std::int32_t row) const;
    void add_own(std::int32_t size, std::int32_t resource, std::vector<std::int32_t>& rows) const;
    void add_chains(std::vector<std::int32_t>& rows) const;
    void add_zones(std::int32_t resource, std::vector<std::int32_t>& rows) const;
    void add_vertex(std::int32_t size, VertexId vertex, std::vector<std::int32_t>& rows) const;
    void add_lane(std::int32_t size, std::int32_t lane, std::vector<std::int32_t>& rows) const;
    void add_edges(std::int32_t other_size, std::int32_t lane,
                   std::vector<std::int32_t>& rows) const;

    bool are_nearer(VertexId one, VertexId other, std::int32_t pair) const;
    bool passes(VertexId vertex, const Lane& lane, std::int32_t pair) const;
    bool cross(const Lane& one, const Lane& other) const;
    bool lie_on_both_sides(const Lane& line, VertexId one, VertexId other) const;
    int side(VertexId vertex, const Lane& lane) const;
    int sign_of_along(VertexId vertex, VertexId from, VertexId to) const;
    Whole exact(VertexId vertex, std::size_t axis) const;
    Whole exact_square(VertexId one, VertexId other) const;
    Whole exact_side(VertexId vertex, const Lane& lane) const;
    Whole exact_limit(std::int32_t pair) const;
    double square(VertexId one, VertexId other) const;
    double doubt(double products) const;

    std::vector<EdgeId> indptr_;
    std::vector<VertexId> heads_;
    Graph graph_;
    std::vector<double> x_;
    std::vector<double> y_;
    std::vector<std::uint32_t> limbs_;
    std::size_t n_limbs_;
    std::vector<double> distance_;
    std::vector<std::uint32_t> distance_limbs_;
    std::int32_t n_sizes_;
    std::vector<Lane> lanes_;
    std::vector<std::int32_t> lane_of_;  // of each edge
    std::vector<std::vector<std::int32_t>> zones_;
    std::vector<std::pair<std::int32_t, std::int32_t>> zone_of_;  // (resource, zone), sorted
    std::vector<std::vector<VertexId>> chains_;
    std::vector<std::pair<std::int32_t, std::int32_t>> chain_of_;  // (resource, chain), sorted
    std::vector<std::int32_t> chain_inside_;  // of each vertex the chain between whose ends it is
    double extent_ = 0;                       // the largest coordinate
    double side_ = 1;                         // of a cell, and longest piece
    std::int64_t width_ = 1;                  // cells in a row
    Cells vertices_;
    Cells pieces_;
    bool may_exclude_edges_ = true;
    mutable std::atomic<std::int64_t> n_found_{0};
    // A row that was found: how many entries it has, and these.
    mutable std::unique_ptr<std::atomic<const std::int32_t*>[]> rows_;
};

}  // namespace rightofway
