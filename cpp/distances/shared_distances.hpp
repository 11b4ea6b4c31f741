// A cache of distance tables: computed at the first request, shared by all robots with one target.
//
// With edges of equal length, one table of edge counts (2 bytes per vertex) serves robots of every
// speed. Above the memory budget the oldest tables are dropped, because a table is quick to
// compute; a reader's shared pointer keeps its table alive.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <unordered_map>
#include <vector>

#include "distances/alt_distance.hpp"
#include "distances/distance_tables.hpp"
#include "distances/turning_table.hpp"
#include "problem/problem.hpp"

namespace rightofway {

struct DistanceTable {
    std::vector<std::uint16_t> narrow;
    std::vector<std::int32_t> wide;  // if `narrow` does not fit

    DistanceView view(Tick scale) const {
        return narrow.empty() ? DistanceView(wide.data(), scale)
                              : DistanceView(narrow.data(), scale);
    }
    std::size_t bytes() const { return 2 * narrow.size() + 4 * wide.size(); }
};

class SharedDistances {
  public:
    // Borrows the problem. Keeps at most `budget` bytes of tables, and always the latest table.
    explicit SharedDistances(const Problem& problem, std::size_t budget = std::size_t{256} << 20);

    const Problem& problem() const { return problem_; }

    // The table of a target, in units of `scale`, for a robot and all robots of its pace. Any
    // vertex is the target `none`. Thread-safe.
    std::shared_ptr<const DistanceTable> to(VertexId target, RobotId robot);

    // The least ticks of a robot from a vertex to the target, -1 if no path exists. Needs no table
    // if all edges have equal length.
    Tick between(VertexId from, VertexId target, RobotId robot);

    // The table of a robot that turns in some time, else null; null, too, if the tables of all
    // robots would exceed the memory budget. Thread-safe.
    std::shared_ptr<const TurningTable> with_turns(RobotId robot);

    // The completion time of a robot that drives alone, -1 if it cannot reach a stage; stages end
    // however late. Cached;
    // thread-safe.
    Tick alone(RobotId robot);
    // The least end of the work of each stage, by robots that drive alone and stages that wait for
    // those of other robots; however late. Without ways the ends mean nothing.
    std::vector<Tick> least_ends();
    // Fills the cache of `alone` from the distances of a problem with the same trips.
    void take_alone(std::span<const Tick> alone);

    // The robot's ticks per unit of the tables.
    Tick scale(RobotId robot) const {
        const auto pace = problem_.pace(robot);
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

    std::shared_ptr<const DistanceTable> make(VertexId target, RobotId robot) const;
    Tick least_completion(RobotId robot);

    const Problem& problem_;
    DistanceTables tables_;
    bool is_uniform_;
    std::size_t budget_;
    std::mutex ways_mutex_;
    std::optional<AltDistance> ways_;  // made at the first request
    std::mutex mutex_;
    std::unordered_map<Key, std::shared_ptr<const DistanceTable>, Hash> known_;
    std::deque<Key> by_age_;
    std::size_t bytes_ = 0;
    std::unordered_map<RobotId, std::shared_ptr<const TurningTable>> turning_;
    std::vector<std::atomic<Tick>> alone_;  // value + 2; 0: not computed
};

}  // namespace rightofway
