// Distance tables made when first asked for, shared by all who go to one place, and given up when
// memory gets short.
//
// Where all edges are equally long, one table of edge counts, two bytes a vertex, serves robots of
// every speed. A table is quickly made anew, so it is no loss to forget the ones made longest ago;
// whoever still reads a table keeps it alive.
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
#include "problem/problem.hpp"

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
    // Borrows the problem. Keeps at most so many bytes of tables, and always the latest one.
    explicit SharedDistances(const Problem& problem, std::size_t budget = std::size_t{256} << 20);

    const Problem& problem() const { return problem_; }

    // A table to the target, in units of `scale`, for a robot and all of its pace. May be called by
    // several threads at once.
    std::shared_ptr<const DistanceTable> to(VertexId target, RobotId robot);

    // The ticks that a robot needs from one vertex to another, -1 where no way leads there; without
    // keeping a table, where all edges are equally long.
    Tick between(VertexId from, VertexId target, RobotId robot);

    // The least completion of a robot without the others, -1 if it cannot get to a stage.
    // Remembered, and may be asked by several threads at once.
    Tick alone(RobotId robot);
    // The same of all robots, found by other distances of a problem with the same trips.
    void take_alone(std::span<const Tick> alone);

    // The ticks that one unit of the tables takes a robot.
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
    std::optional<AltDistance> ways_;  // made when first asked for
    std::mutex mutex_;
    std::unordered_map<Key, std::shared_ptr<const DistanceTable>, Hash> known_;
    std::deque<Key> by_age_;
    std::size_t bytes_ = 0;
    std::vector<std::atomic<Tick>> alone_;  // plus 2; 0 until it is asked for
};

}  // namespace rightofway
