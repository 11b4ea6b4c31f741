// Distance tables made when first asked for, shared by all who go to one place, and given up when
// memory gets short.
//
// Where all edges are equally long, one table of edge counts, two bytes a vertex, serves robots of
// every speed. A table is quickly made anew, so it is no loss to forget the ones made longest ago;
// whoever still reads a table keeps it alive.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "distances/alt_distance.hpp"
#include "distances/distance_tables.hpp"
#include "distances/distance_view.hpp"
#include "problem/trip.hpp"

namespace rightofway {

struct DistanceTable {
    std::vector<std::uint16_t> narrow;
    std::vector<std::int32_t> wide;  // where the narrow one does not do

    DistanceView view(Tick scale) const {
        return narrow.empty() ? DistanceView(wide.data(), scale)
                              : DistanceView(narrow.data(), scale);
    }
    std::size_t bytes() const { return 2 * narrow.size() + 4 * wide.size(); }
};

class SharedDistances {
  public:
    // Borrows the roads. Keeps at most so many bytes of tables, and always the latest one.
    SharedDistances(const Roads& roads, std::size_t budget);

    // A table to the target, in units of `scale`, for robots of that pace. May be called by several
    // threads at once.
    std::shared_ptr<const DistanceTable> to(VertexId target, std::span<const std::int32_t> pace);

    // The ticks from one vertex to another for a robot of that pace, -1 where no way leads there;
    // without keeping a table, where all edges are equally long.
    Tick between(VertexId from, VertexId target, std::span<const std::int32_t> pace);

    // What one unit of the tables takes a robot of that pace.
    Tick scale(std::span<const std::int32_t> pace) const {
        return is_uniform_ && !pace.empty() ? pace.front() : 1;
    }

  private:
    struct Key {
        VertexId target;
        std::int32_t pace;
        bool operator==(const Key&) const = default;
    };
    struct Hash {
        std::size_t operator()(const Key& key) const {
            return static_cast<std::size_t>(key.target) * 1009U +
                   static_cast<std::size_t>(key.pace);
        }
    };

    std::int32_t number_of(std::span<const std::int32_t> pace);
    std::shared_ptr<const DistanceTable> make(VertexId target,
                                              std::span<const std::int32_t> pace) const;

    Roads roads_;
    DistanceTables tables_;
    bool is_uniform_;
    std::size_t budget_;
    std::mutex ways_mutex_;
    std::optional<AltDistance> ways_;  // made when first asked for
    std::mutex mutex_;
    std::vector<std::vector<std::int32_t>> paces_;
    std::unordered_map<Key, std::shared_ptr<const DistanceTable>, Hash> known_;
    std::deque<Key> by_age_;
    std::size_t bytes_ = 0;
};

}  // namespace rightofway
